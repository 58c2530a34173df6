// SPDX-License-Identifier: MIT
//
// The place to which the load moves bodies without supports before they deform: rigid motions R α,
// R the kernel of K, contacts and friction being springs as stiff as K is at their nodes,
//
//     minimise  −fᵀR α + Σ ½ κᵢ max(0, (N R α − d)ᵢ)² + Σ hᵢ((T R α)ᵢ)
//     hᵢ(t) = ½ κᵢ‖t‖²  up to κᵢ‖t‖ = gᵢ, linear from there on (Huber)
//
// The minimum is as near to the solution of the elastic problem as bodies deform, however wide the
// gaps are. It is a place to start from, and nothing that a verdict depends on.
//
// Algorithm: proximal points, α⁺ = argmin {… + ½ σ‖α − α⁻‖²}, with σ so small that a step reaches
// as far as the gaps are wide; σ falls with every step, until its force is nothing beside the
// load. Each by Newton's method with a search along the line for the exact minimum, which is finite
// for piecewise quadratic functions [Sun 1997]. Costs a few dozen factorisations of the size of α,
// six unknowns a body, and no product with K.
#pragma once

#include <slant/concepts/bad_input.hpp>
#include <slant/concepts/iterative_method.hpp>
#include <slant/concepts/scalar.hpp>
#include <slant/contact/contact_data.hpp>
#include <slant/contact/free_motions.hpp>
#include <slant/contact/solve_options.hpp>
#include <slant/factorizations/factorize.hpp>
#include <slant/operators/inverse.hpp>

#include <Eigen/Eigenvalues>
#include <Eigen/SparseCore>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

namespace slant::contact::detail {

// --- falling motion ------------------------------------------------------------------------------
//
// Motions R α of bodies that K leaves free, along which the energy of contact with Tresca friction
// falls for ever: the proof that there is no solution.

/// Does the energy fall for ever along w = R α: fᵀw > Σ gᵢ‖(T w)ᵢ‖, N w ≤ 0, and (T w)ᵢ = 0 where
/// gᵢ = ∞? The last two hold up to a millionth of the first, over ‖f‖: forces that balance the load
/// after all would add up to a million times as much as that.
template <class S, class V>
[[nodiscard]] bool falls_for_ever(data<S> const& c, V const& w) {
  using vector_type = Eigen::VectorX<S>;
  S const size = w.stableNorm(), load = c.f.stableNorm();
  vector_type const normal = c.N * w, slip = c.T * w;
  index const k = c.tangents();
  S fall = c.f.dot(w), opposed(0);
  for (index i = 0; i < c.nodes(); ++i) {
    if (slant::detail::is_finite(c.d[i])) opposed = std::max<S>(opposed, normal[i]);
    if (k == 0) continue;
    S const length = slip.segment(k * i, k).stableNorm();
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
void project_forces(data<S> const& c, S const& unit, Eigen::VectorX<S>& λ) {
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
[[nodiscard]] Eigen::VectorX<S> falling_motion(data<S> const& c, Eigen::SparseMatrix<S> const& R,
                                               index steps) {
  using vector_type = Eigen::VectorX<S>;
  using dense_type = Eigen::MatrixX<S>;
  Eigen::SparseMatrix<S> const Gt = stacked_constraints(c) * R, G = Gt.transpose();
  vector_type e = R.transpose() * c.f;
  S const unit = e.stableNorm();
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
        entries.emplace_back(int(body.unknowns[j]), int(column), body.motions(index(j), k));
      }
    }
  }
  Eigen::SparseMatrix<S> R(unknowns, column);
  R.setFromTriplets(entries.begin(), entries.end());
  return R;
}

/// Sets the claim that there is no solution, with its proof w; or that it could not be proven.
template <class S>
void conclude_unbounded(Eigen::SparseMatrix<S> const& K, data<S> const& c,
                        node_layout<S> const& layout, Eigen::VectorX<S> w, solution<S>& r) {
  S const size = w.stableNorm();
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
template <class S>
void conclude_unbounded(Eigen::SparseMatrix<S> const& K, data<S> const& c,
                        node_layout<S> const& layout, solution<S>& r) {
  conclude_unbounded(K, c, layout, falling_motion(c, kernel_of(r.motions, K.rows()), index(20000)),
                     r);
}

// --- rigid position ------------------------------------------------------------------------------

/// The minimisation at the top of this file.
template <class S>
class rigid_position {
 public:
  using vector_type = Eigen::VectorX<S>;
  using sparse_type = Eigen::SparseMatrix<S>;

  /// Refers to the data and to R, which has orthonormal columns.
  rigid_position(sparse_type const& K, data<S> const& c, sparse_type const& R)
      : data_(&c),
        R_(&R),
        e_(R.transpose() * c.f),
        α_(vector_type::Zero(R.cols())),
        anchor_(α_),
        d_(c.d),
        g_(c.g) {
    normalise(K, stacked_constraints(c));
    // What rounding leaves of a load in balance moves nothing.
    S const rounding = S(1024) * std::numeric_limits<S>::epsilon() * c.f.stableNorm();
    if (!(e_.stableNorm() > rounding)) e_.setZero();
  }
  rigid_position(rigid_position const&) = delete;
  rigid_position& operator=(rigid_position const&) = delete;

  /// α; 0 where there are no gaps, and where nothing stops the bodies.
  [[nodiscard]] vector_type operator()() {
    S const length = longest_gap();
    y_.setZero(G_.rows());
    force_.setZero(G_.rows());
    evaluate(y_);
    S force = e_.stableNorm();
    if (!(force > S(0))) force = vector_type(Gt_ * force_).stableNorm();
    if (!(length > S(0)) || !(force > S(0)) || !slant::detail::is_finite(force)) return α_;
    S const least = S(1e-10) * S(κ_.maxCoeff());
    σ_ = std::max<S>(force / (S(16) * length), least);
    for (int step = 0; step < 64; ++step) {
      if (!minimise(S(1e-7) * force)) break;
      vector_type const moved = α_ - anchor_;
      S const distance = moved.stableNorm();
      if (σ_ * distance <= S(1e-6) * force) return α_;
      if (falls_for_ever(*data_, vector_type(*R_ * (moved / distance)))) break;
      anchor_ = α_;
      σ_ = std::max<S>(σ_ / S(8), least);
    }
    return vector_type::Zero(α_.size());
  }

 private:
  /// G = B R with rows b of B divided by their lengths, those of the tangents of a node by the same
  /// one; κ = b diag(K) bᵀ.
  void normalise(sparse_type const& K, sparse_type B) {
    using std::hypot;
    vector_type lengths = vector_type::Zero(B.rows());
    κ_.setZero(B.rows());
    for (index j = 0; j < B.outerSize(); ++j) {
      for (typename sparse_type::InnerIterator b(B, j); b; ++b) {
        lengths(b.row()) = hypot(lengths(b.row()), b.value());
      }
    }
    index const m = data_->nodes(), k = data_->tangents();
    for (index i = m; k == 2 && i < lengths.size(); i += 2) {
      lengths(i) = lengths(i + 1) = hypot(lengths(i), lengths(i + 1)) / hypot(S(1), S(1));
    }
    for (S& length : lengths) {
      if (!(length > S(0))) length = S(1);
    }
    for (index j = 0; j < B.outerSize(); ++j) {
      S const own = K.coeff(j, j);
      for (typename sparse_type::InnerIterator b(B, j); b; ++b) {
        b.valueRef() /= lengths(b.row());
        κ_(b.row()) += b.value() * b.value() * own;
      }
    }
    for (index i = 0; i < m; ++i) {
      d_(i) /= lengths(i);
      if (k > 0) g_(i) *= lengths(m + k * i);
    }
    for (index i = m; k == 2 && i < κ_.size(); i += 2) {
      κ_(i) = κ_(i + 1) = (κ_(i) + κ_(i + 1)) / S(2);
    }
    G_ = B * *R_;
    Gt_ = G_.transpose();
  }

  /// 0 where all gaps are closed.
  [[nodiscard]] S longest_gap() const {
    using std::abs;
    S longest(0);
    for (index i = 0; i < d_.size(); ++i) {
      S const row = vector_type(Gt_.col(i)).stableNorm();
      if (row > S(0) && slant::detail::is_finite(d_(i))) {
        longest = std::max<S>(longest, abs(d_(i)) / row);
      }
    }
    return longest;
  }

  /// Forces of the springs at y = G α.
  void evaluate(vector_type const& y) {
    index const m = data_->nodes(), k = data_->tangents();
    for (index i = 0; i < m; ++i) {
      S const opening = y(i) - d_(i);
      force_(i) = opening > S(0) ? S(κ_(i) * opening) : S(0);
      if (k == 0) continue;
      S most = g_(i);
      auto τ = force_.segment(m + k * i, k);
      τ = κ_(m + k * i) * y.segment(m + k * i, k);
      S const size = τ.stableNorm();
      if (size > most) τ *= most / size;
    }
  }

  /// The second derivatives.
  void bend(sparse_type& H) {
    index const m = data_->nodes(), k = data_->tangents(), p = α_.size();
    entries_.clear();
    auto const put = [&](index i, index j, S const& value) {
      entries_.emplace_back(int(i), int(j), value);
    };
    for (index i = 0; i < m; ++i) {
      if (y_(i) > d_(i)) put(i, i, κ_(i));
      if (k == 0 || !(g_(i) > S(0))) continue;
      index const first = m + k * i;
      S const κ = κ_(first), length = y_.segment(first, k).stableNorm();
      bool const sticks = !(κ * length > g_(i));
      S const stiff = sticks ? κ : S(g_(i) / length);
      for (index a = 0; a < k; ++a) {
        for (index b = 0; b < k; ++b) {
          S value = a == b ? stiff : S(0);
          if (!sticks) value -= stiff * (y_(first + a) / length) * (y_(first + b) / length);
          if (value != S(0)) put(first + a, first + b, value);
        }
      }
    }
    sparse_type W(G_.rows(), G_.rows());
    W.setFromTriplets(entries_.begin(), entries_.end());
    sparse_type const WG = W * G_;
    sparse_type identity(p, p);
    identity.setIdentity();
    H = Gt_ * WG;
    H += sparse_type(H.transpose());
    H = S(0.5) * H + σ_ * identity;
  }

  /// The slope along p at α + t p, q = G p.
  [[nodiscard]] S slope(vector_type const& p, vector_type const& q, S const& t) {
    evaluate(vector_type(y_ + t * q));
    return σ_ * (α_ - anchor_ + t * p).dot(p) - e_.dot(p) + force_.dot(q);
  }

  /// Where the slope is 0, which it falls to from below: regula falsi with halving (Illinois).
  [[nodiscard]] S exact_length(vector_type const& p, vector_type const& q) {
    using std::abs;
    S low(0), high(1), at_low = slope(p, q, low), at_high = slope(p, q, high);
    S const enough = S(1e-3) * abs(at_low);
    for (int k = 0; k < 60 && at_high < -enough; ++k) {
      low = high;
      at_low = at_high;
      high *= S(2);
      at_high = slope(p, q, high);
    }
    if (abs(at_high) <= enough) return high;
    S t = high;
    for (int k = 0, side = 0; k < 100; ++k) {
      t = k % 3 == 2 ? S((low + high) / S(2))
                     : S((low * at_high - high * at_low) / (at_high - at_low));
      S const here = slope(p, q, t);
      if (abs(here) <= enough) break;
      if (here > S(0)) {
        high = t;
        at_high = here;
        if (side == 1) at_low /= S(2);
        side = 1;
      } else {
        low = t;
        at_low = here;
        if (side == -1) at_high /= S(2);
        side = -1;
      }
    }
    return t;
  }

  /// Newton's method up to a gradient of this size; whether it came to an end.
  [[nodiscard]] bool minimise(S const& goal) {
    S const unit = S(64) * std::numeric_limits<S>::epsilon() * S(κ_.maxCoeff());
    for (int step = 0; step < 100; ++step) {
      y_ = G_ * α_;
      evaluate(y_);
      vector_type const gradient = σ_ * (α_ - anchor_) - e_ + Gt_ * force_;
      S const size = gradient.stableNorm();
      if (size <= std::max<S>(goal, unit * y_.stableNorm())) return true;
      if (!slant::detail::is_finite(size)) return false;
      sparse_type H;
      bend(H);
      vector_type p(α_.size());
      try {
        auto const factor = slant::factorize(H);
        slant::apply(inverse(factor), gradient, p);
      } catch (bad_input const&) {
        return false;  // springs too soft beside the contacts
      }
      p = -p;
      vector_type const q = G_ * p;
      α_ += exact_length(p, q) * p;
    }
    return false;
  }

  data<S> const* data_;
  sparse_type const* R_;
  sparse_type G_{}, Gt_{};
  vector_type e_, α_, anchor_, d_, g_;
  vector_type κ_{}, y_{}, force_{};
  std::vector<Eigen::Triplet<S>> entries_{};
  S σ_{0};
};

}  // namespace slant::contact::detail
