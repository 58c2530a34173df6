// SPDX-License-Identifier: MIT
//
// Motions R α of bodies that K leaves free, along which the energy of contact with Tresca friction
// falls for ever: the proof that there is no solution.
#pragma once

#include <slant/concepts/scalar.hpp>
#include <slant/contact/contact_data.hpp>
#include <slant/contact/detail/stacked_constraints.hpp>
#include <slant/contact/free_motions.hpp>
#include <slant/iteration/iteration.hpp>

#include <Eigen/Eigenvalues>
#include <Eigen/SparseCore>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace slant::contact::detail {

/// Does the energy fall for ever along w = R α: fᵀw > Σ gᵢ‖(T w)ᵢ‖, N w ≤ 0, and (T w)ᵢ = 0 where
/// gᵢ = ∞? The last two hold up to a millionth of the first, over ‖f‖: forces that balance the load
/// after all would add up to a million times as much as that.
template <class S, class V>
[[nodiscard]] bool falls_for_ever(data<S> const& c, V const& w) {
  using vector_type = Eigen::Matrix<S, Eigen::Dynamic, 1>;
  S const size = w.norm(), load = c.f.norm();
  vector_type const normal = c.N * w, slip = c.T * w;
  index const k = c.tangents();
  S fall = c.f.dot(w), opposed(0);
  for (index i = 0; i < c.nodes(); ++i) {
    if (slant::detail::is_finite(c.d[i])) opposed = std::max<S>(opposed, normal[i]);
    if (k == 0) continue;
    S const length = slip.segment(k * i, k).norm();
    if (slant::detail::is_finite(c.g[i]))
      fall -= c.g[i] * length;
    else
      opposed = std::max<S>(opposed, length);
  }
  // What fᵀw may be by rounding alone.
  S const rounding = S(1024) * std::numeric_limits<S>::epsilon() * load * size;
  return fall > rounding && opposed <= S(1e-6) * (fall / load);
}

/// The nearest forces of Λ: λ_ν ≥ 0, and 0 where the gap is infinite; ‖λ_t,i‖ ≤ gᵢ/unit.
template <class S>
void project_forces(data<S> const& c, S const& unit, Eigen::Matrix<S, Eigen::Dynamic, 1>& λ) {
  index const k = c.tangents(), m = c.nodes();
  for (index i = 0; i < m; ++i) {
    if (!(λ[i] > S(0)) || !slant::detail::is_finite(c.d[i])) λ[i] = S(0);
    if (k == 0) continue;
    S const length = λ.segment(m + k * i, k).norm(), most = c.g[i] / unit;
    if (length > most) λ.segment(m + k * i, k) *= most / length;
  }
}

/// A motion along which the energy falls for ever, where there is one: the resultants that no
/// forces balance, w = R α, α = e − G λ with the least ‖e − G λ‖ over λ ∈ Λ, by an accelerated
/// gradient method with restarts [O'Donoghue, Candès 2015]. By the optimality of λ it is αᵀ(G μ − G
/// λ) ≤ 0 for all μ ∈ Λ, so N w ≤ 0 and fᵀw − Σ gᵢ‖(T w)ᵢ‖ = ‖α‖². Ends as soon as w proves that.
template <class S>
[[nodiscard]] Eigen::Matrix<S, Eigen::Dynamic, 1> falling_motion(data<S> const& c,
                                                                 Eigen::SparseMatrix<S> const& R,
                                                                 index steps) {
  using vector_type = Eigen::Matrix<S, Eigen::Dynamic, 1>;
  using dense_type = Eigen::Matrix<S, Eigen::Dynamic, Eigen::Dynamic>;
  Eigen::SparseMatrix<S> const Gt = stacked_constraints(c) * R, G = Gt.transpose();
  vector_type e = R.transpose() * c.f;
  S const unit = e.norm();
  if (!(unit > S(0))) return R * e;
  e /= unit;
  dense_type const gram = dense_type(G * Gt);
  S const L = Eigen::SelfAdjointEigenSolver<dense_type>(gram).eigenvalues().maxCoeff();
  vector_type α = e, w = R * α;
  if (!(L > S(0))) return w;
  vector_type λ = vector_type::Zero(Gt.rows()), y = λ, next = λ;
  S t(1);
  for (index step = 1; step <= steps; ++step) {
    using std::sqrt;
    α = e - G * y;
    next = y + Gt * α / L;
    project_forces(c, unit, next);
    if ((y - next).dot(next - λ) > S(0)) t = S(1);
    S const t_next = (S(1) + sqrt(S(1) + S(4) * t * t)) / S(2);
    y = next + ((t - S(1)) / t_next) * (next - λ);
    t = t_next;
    λ.swap(next);
    if (step % 16 != 0 && step != steps) continue;
    α = e - G * λ;
    w = R * α;
    if (falls_for_ever(c, w)) break;
  }
  return w;
}

/// R of all bodies, n_u × the number of their motions.
template <class S>
[[nodiscard]] Eigen::SparseMatrix<S> kernel_of(free_motions<S> const& motions, index unknowns) {
  std::vector<Eigen::Triplet<S>> entries;
  index column = 0;
  for (auto const& body : motions.free) {
    for (index k = 0; k < body.motions.cols(); ++k, ++column) {
      for (std::size_t j = 0; j < body.unknowns.size(); ++j) {
        entries.emplace_back(static_cast<int>(body.unknowns[j]), static_cast<int>(column),
                             body.motions(static_cast<index>(j), k));
      }
    }
  }
  Eigen::SparseMatrix<S> R(unknowns, column);
  R.setFromTriplets(entries.begin(), entries.end());
  return R;
}

/// Sets the claim that there is no solution, with its proof w; or that it could not be proven.
template <class S, class Result>
void conclude_unbounded(Eigen::SparseMatrix<S> const& K, data<S> const& c,
                        node_layout<S> const& layout, Eigen::Matrix<S, Eigen::Dynamic, 1> w,
                        Result& r) {
  S const size = w.norm();
  if (size > S(0) && slant::detail::is_finite(size)) {
    w /= size;
    if (falls_for_ever(c, w)) {
      r.status = slant::status::unbounded;
      r.reason = "neither contact nor friction holds the bodies under this load: " +
                 name_motion(K, w, layout);
      r.descent = std::move(w);
      return;
    }
  }
  r.status = slant::status::stalled;
  r.reason =
      "no forces of contact and friction were found that balance the load, and no motion along "
      "which the energy falls for ever";
}
/// The same after a search.
template <class S, class Result>
void conclude_unbounded(Eigen::SparseMatrix<S> const& K, data<S> const& c,
                        node_layout<S> const& layout, Result& r) {
  conclude_unbounded(K, c, layout, falling_motion(c, kernel_of(r.motions, K.rows()), index(20000)),
                     r);
}

/// The residual of the optimality conditions (contact/optimality.hpp) that a solution of this
/// tolerance may have: K u has rounding errors of ε ‖K‖ ‖u‖, however far the bodies have moved.
template <class S, class V>
[[nodiscard]] S allowed_residual(Eigen::SparseMatrix<S> const& K, data<S> const& c,
                                 S const& tolerance, V const& u, V const& λ) {
  S const force = std::max<S>(c.f.norm(), (c.N.transpose() * λ.head(c.nodes())).norm());
  S const rounding =
      S(64) * std::numeric_limits<S>::epsilon() * slant::detail::largest_row_sum(K) * u.norm();
  return S(1000) * tolerance + (force > S(0) ? S(rounding / force) : S(0));
}

}  // namespace slant::contact::detail
