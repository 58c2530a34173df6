// SPDX-License-Identifier: MIT
//
// A start for contact that is solved for the displacements: the same problem on the next coarser
// level of multigrid, to a percent. From zero the front of what opens and slides moves some nodes a
// Newton step, so that steps grow with the mesh; from there they do not.
//
// Level 1 knows aggregates of nodes. Where Q R are the near kernel on an aggregate, R of level 1, the
// mean motion of its contact nodes is ū = T w, T = B̄ R⁻¹ with B̄ the mean of their rows of the near
// kernel, normal and tangents. In unknowns w = E w' with E = [T⁺, Z], Z orthonormal onto the kernel
// of T, the first components of w' are ū: bounds and friction are again blocks of single nodes,
//
//     minimise  ½ w'ᵀ(EᵀPᵀK P E)w' − (EᵀPᵀf)ᵀw' + φ'(w'),      gaps the least ones, slip bounds added up,
//
// and that problem, on the levels that follow, starts from its own next one. What has come of it is
// prolonged; a node is held as its aggregate is, and the first step does not ask whether that is
// right.
//
// Between two bodies the motion is that of the one less that of the other: ū = T w_I + Σ T_J w_J with
// aggregates J of the other body, and E of w' in place of w_I takes T_J w_J away. With prolongations
// of the user the aggregate of a coarse node are the nodes that owe it most, and Q R translations.
#pragma once

#include <slant/base/scaling.hpp>
#include <slant/concepts/bad_input.hpp>
#include <slant/contact/primal.hpp>
#include <slant/methods/envelope_newton.hpp>
#include <slant/multilevel/multigrid.hpp>
#include <slant/operators/matrix.hpp>
#include <slant/problems/separable_qp.hpp>

#include <Eigen/Core>
#include <Eigen/QR>
#include <Eigen/SparseCore>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <map>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

namespace slant::contact::detail {

/// √(uᵀK u) of u and K u, whose squares may be beyond the range of the numbers.
template <class X, class Y>
[[nodiscard]] auto energy_norm(Eigen::MatrixBase<X> const& u, Eigen::MatrixBase<Y> const& Ku) {
  using S = typename X::Scalar;
  using std::sqrt;
  S const length = unit_near(S(u.cwiseAbs().maxCoeff()));
  S const force = unit_near(S(Ku.cwiseAbs().maxCoeff()));
  S const square = (u / length).dot(Ku / force);
  return square > S(0) ? S(sqrt(square) * sqrt(length) * sqrt(force)) : S(0);
}

/// The solution of the coarse problem, and the z to begin with on the fine level.
template <class S>
class nested_start {
 public:
  using vector_type = Eigen::VectorX<S>;
  using matrix_type = Eigen::MatrixX<S>;
  using sparse_type = Eigen::SparseMatrix<S>;
  using rows_type = Eigen::SparseMatrix<S, Eigen::RowMajor>;
  using contact = typename surface_function<S>::contact;

  /// Solves the coarse problem of min ½ vᵀK v − fᵀv + φ(v), v = G u, with the multigrid M of these
  /// candidates of the near kernel in u; without rows G is the identity. Nothing if there is none
  /// worth it.
  nested_start(vector_type const& f, surface_function<S> const& φ, slant::multigrid<S> const& M,
               matrix_type const& candidates, rows_type const& G)
      : φ_(&φ), tangents_(φ.tangents()) {
    aggregation const& a = M.aggregates();
    if (a.count == 0 || f.size() < smallest || candidates.cols() == 0) return;
    if (M.sizes().size() == 2 && !M.factors_last_level()) return;  // there is no level below
    matrix_type R = M.coarse_kernel();
    width_ = R.cols();
    if (R.rows() != a.count * width_ || width_ < 1 + tangents_) return;
    of_ = a.of;
    node_size_ = M.node_size();
    choose_frames(candidates, G, R, a.count);
    if (list_.empty() || are_entangled()) return;
    sparse_type K = M.coarse_matrix();
    vector_type g = M.restricted(f);
    sparse_type E;      // without rows where it is the identity
    rows_type inverse;  // E⁻¹
    if (!frames_.empty()) {
      mix(K.rows(), E, inverse);
      g = vector_type(E.transpose() * g);
    }
    if (has_pairs_) {
      K = congruent(K, E);
    } else {
      turn(K);
    }
    surface_function<S> const surface(K.rows(), tangents_, list_);
    try {
      solve(K, g, surface, M, R, inverse);
      if (!frames_.empty()) coarse_ = vector_type(E * coarse_);
      displacement_ = M.prolonged(coarse_);
      found_ = displacement_.allFinite();
    } catch (bad_input const&) {
      found_ = false;  // a start is a help, no condition
    }
  }

  [[nodiscard]] bool found() const { return found_; }
  /// Newton steps and cycles on all coarse levels.
  [[nodiscard]] index steps() const { return steps_; }

  /// z for the step length ρ.
  [[nodiscard]] vector_type at(S const& ρ) const {
    vector_type z = displacement_;
    S const beyond = unit_near(S(displacement_.cwiseAbs().maxCoeff()));
    for (contact const& c : φ_->contacts()) {
      int const owner = of_[static_cast<std::size_t>(c.p / node_size_)];
      int const k = owner < 0 ? -1 : number_[static_cast<std::size_t>(owner)];
      S const l = c.gap.lower(), h = c.gap.upper();
      bool const has_l = slant::detail::is_finite(l), has_h = slant::detail::is_finite(h);
      S& normal = z[c.p];
      if (k < 0 || !touches_[static_cast<std::size_t>(k)] || (!has_l && !has_h)) {
        normal = std::clamp<S>(normal, l, h);
      } else if (has_l && (!has_h || normal - l < h - normal)) {
        normal = l - beyond;
      } else {
        normal = h + beyond;
      }
      if (tangents_ == 0) continue;
      S square(0);
      auto const at = [&](index j) -> S& { return z[c.q + j * c.stride]; };
      for (index j = 0; j < tangents_; ++j) square += at(j) * at(j);
      using std::sqrt;
      S const length = sqrt(square);
      bool const sticks = k >= 0 && sticks_[static_cast<std::size_t>(k)];
      for (index j = 0; j < tangents_; ++j) {
        at(j) = sticks || !(length > S(0)) || !slant::detail::is_finite(c.g)
                    ? S(0)
                    : S(at(j) * (S(1) + ρ * c.g / length));
      }
    }
    return z;
  }

 private:
  static constexpr index smallest = 2000;  // unknowns: fewer are solved as fast from zero

  /// E of a node and its inverse, and T_J of nodes of another body.
  struct frame {
    matrix_type E, inverse;
    std::map<index, matrix_type> others{};
  };

  /// The frames of aggregates with contacts, and their contacts.
  void choose_frames(matrix_type const& B, rows_type const& G, matrix_type const& R, index count) {
    // What the motions of each node of level 1 move the contacts of an aggregate by.
    std::vector<std::map<index, matrix_type>> mean(static_cast<std::size_t>(count));
    std::vector<index> members(static_cast<std::size_t>(count), 0);
    std::vector<contact> sums(static_cast<std::size_t>(count));
    constexpr S infinity = std::numeric_limits<S>::infinity();
    for (contact const& c : φ_->contacts()) {
      int const owner = of_[static_cast<std::size_t>(c.p / node_size_)];
      if (owner < 0) continue;
      auto const g = static_cast<std::size_t>(owner);
      if (members[g]++ == 0) sums[g].gap = interval<S>(-infinity, infinity);
      auto const add = [&](index row, index unknown, S const& weight) {
        int const node = of_[static_cast<std::size_t>(unknown / node_size_)];
        if (node < 0) return;
        matrix_type& T = mean[g][node];
        if (T.size() == 0) T = matrix_type::Zero(1 + tangents_, width_);
        T.row(row) += weight * B.row(unknown).head(width_);
      };
      for (index r = 0; r <= tangents_; ++r) {
        index const unknown = r == 0 ? c.p : c.q + (r - 1) * c.stride;
        if (G.rows() == 0) {
          add(r, unknown, S(1));
        } else {
          for (typename rows_type::InnerIterator e(G, unknown); e; ++e) add(r, e.col(), e.value());
        }
      }
      S const l = std::max<S>(sums[g].gap.lower(), c.gap.lower());
      S const h = std::min<S>(sums[g].gap.upper(), c.gap.upper());
      if (l <= h) sums[g].gap = interval<S>(l, h);
      sums[g].g += c.g;
    }
    number_.assign(static_cast<std::size_t>(count), -1);
    for (index i = 0; i < count; ++i) {
      auto const g = static_cast<std::size_t>(i);
      if (members[g] == 0) continue;
      for (auto& [node, T] : mean[g]) {
        T = times_inverse(T / S(members[g]), R.middleRows(node * width_, width_));
      }
      matrix_type const T = std::move(mean[g][i]);
      mean[g].erase(i);
      contact c = sums[g];
      if (T.size() == 0) continue;
      if (!mean[g].empty() || !is_placed(T, i * width_, c)) {
        auto E = frame_of(T);
        if (!E) continue;
        E->others = std::move(mean[g]);
        has_pairs_ = has_pairs_ || !E->others.empty();
        c.p = i * width_;
        c.q = c.p + 1;
        c.stride = 1;
        frames_.emplace_back(i, std::move(*E));
      }
      number_[g] = static_cast<int>(list_.size());
      list_.push_back(c);
    }
  }
  /// Whether rows of T are unit vectors, of unknowns from `first` on: c then acts on these.
  static bool is_placed(matrix_type const& T, index first, contact& c) {
    index place[3] = {0, 0, 0};
    for (index r = 0; r < T.rows(); ++r) {
      index& at = place[r];
      T.row(r).maxCoeff(&at);
      if (T(r, at) != S(1) || T.row(r).cwiseAbs().sum() != S(1)) return false;
    }
    c.p = first + place[0];
    if (T.rows() > 1) c.q = first + place[1];
    if (T.rows() > 2) c.stride = place[2] - place[1];
    return true;
  }

  /// T with T R = B for an upper triangular R; what R does not see is left out.
  static matrix_type times_inverse(matrix_type const& B, matrix_type const& R) {
    matrix_type T = B;
    for (index c = 0; c < R.cols(); ++c) {
      for (index k = 0; k < c; ++k) T.col(c) -= T.col(k) * R(k, c);
      if (R(c, c) > S(0)) {
        T.col(c) /= R(c, c);
      } else {
        T.col(c).setZero();
      }
    }
    return T;
  }

  /// E = [T⁺, Z]; nothing if the rows of T are nearly dependent.
  static std::optional<frame> frame_of(matrix_type const& T) {
    using std::abs;
    index const m = T.rows(), w = T.cols();
    // What T does not see comes last, where no reflection moves it: an aggregate may not have it.
    std::vector<index> order(static_cast<std::size_t>(w));
    std::iota(order.begin(), order.end(), index(0));
    std::stable_partition(order.begin(), order.end(),
                          [&](index j) { return !T.col(j).isZero(S(0)); });
    matrix_type const seen = T(Eigen::all, order);
    Eigen::HouseholderQR<matrix_type> const qr(seen.transpose());  // Tᵀ = Q₁ R
    matrix_type const R = qr.matrixQR().topRows(std::min(m, w));
    S const size = T.cwiseAbs().maxCoeff();
    for (index r = 0; r < m; ++r) {
      if (r >= w || !(abs(R(r, r)) > S(1e-3) * size)) return std::nullopt;
    }
    matrix_type Q(w, w);
    Q(order, Eigen::all) = qr.householderQ() * matrix_type::Identity(w, w);
    frame f{Q, Q.transpose(), {}};
    f.inverse.topRows(m) = T;
    // T⁺ = Q₁ R⁻ᵀ
    f.E.leftCols(m) = R.template triangularView<Eigen::Upper>()
                          .solve(matrix_type(Q.leftCols(m).transpose()))
                          .transpose();
    return f;
  }

  /// Whether contacts are with aggregates that have contacts of their own, as in the middle of a
  /// stack of bodies.
  [[nodiscard]] bool are_entangled() const {
    return std::any_of(frames_.begin(), frames_.end(), [&](auto const& f) {
      return std::any_of(f.second.others.begin(), f.second.others.end(), [&](auto const& T) {
        return number_[static_cast<std::size_t>(T.first)] >= 0;
      });
    });
  }

  /// w = E w' and w' = E⁻¹w as matrices of n unknowns.
  void mix(index n, sparse_type& E, rows_type& inverse) const {
    index const m = 1 + tangents_;
    std::vector<Eigen::Triplet<S>> from, to;
    std::vector<bool> is_own(static_cast<std::size_t>(n / width_), false);
    auto const put = [&](auto& list, index I, index J, matrix_type const& A) {
      for (index q = 0; q < A.rows(); ++q) {
        for (index c = 0; c < A.cols(); ++c) {
          list.emplace_back(int(I * width_ + q), int(J * width_ + c), A(q, c));
        }
      }
    };
    for (auto const& [I, f] : frames_) {
      is_own[static_cast<std::size_t>(I)] = true;
      put(from, I, I, f.E);
      put(to, I, I, f.inverse);
    }
    for (auto const& [I, f] : frames_) {
      for (auto const& [J, T] : f.others) {
        put(from, I, J, matrix_type(-f.E.leftCols(m) * T));
        put(to, I, J, T);
      }
    }
    for (index j = 0; j < n; ++j) {
      if (is_own[static_cast<std::size_t>(j / width_)]) continue;
      from.emplace_back(int(j), int(j), S(1));
      to.emplace_back(int(j), int(j), S(1));
    }
    E.resize(n, n);
    inverse.resize(n, n);
    E.setFromTriplets(from.begin(), from.end());
    inverse.setFromTriplets(to.begin(), to.end());
  }

  /// K ← EᵀK E, and 1 where an unknown stands for nothing.
  void turn(sparse_type& K) const {
    std::vector<matrix_type const*> E(static_cast<std::size_t>(K.cols() / width_), nullptr);
    for (auto const& [node, f] : frames_) E[static_cast<std::size_t>(node)] = &f.E;
    auto const* const first = K.outerIndexPtr();
    auto const* const inner = K.innerIndexPtr();
    S* const value = K.valuePtr();
    matrix_type block(width_, width_);
    S most(0);
    for (index j = 0; j < K.cols(); ++j) most = std::max<S>(most, K.coeff(j, j));
    for (index J = 0; J < K.cols() / width_; ++J) {
      index const from = J * width_;
      for (index e = 0; e < first[from + 1] - first[from]; e += width_) {
        index const I = inner[first[from] + e] / width_;
        auto const* const left = E[static_cast<std::size_t>(I)];
        auto const* const right = E[static_cast<std::size_t>(J)];
        auto const entry = [&](index q, index c) -> S& { return value[first[from + c] + e + q]; };
        if (left || right) {
          for (index c = 0; c < width_; ++c) {
            for (index q = 0; q < width_; ++q) block(q, c) = entry(q, c);
          }
          if (left) block = matrix_type(left->transpose() * block);
          if (right) block = matrix_type(block * *right);
          for (index c = 0; c < width_; ++c) {
            for (index q = 0; q < width_; ++q) entry(q, c) = block(q, c);
          }
        }
        if (I != J) continue;
        for (index c = 0; c < width_; ++c) {
          if (!(entry(c, c) > S(0))) entry(c, c) = most;
        }
      }
    }
  }

  void solve(sparse_type const& K, vector_type const& f, surface_function<S> const& surface,
             slant::multigrid<S> const& finer, matrix_type const& candidates,
             rows_type const& inverse) {
    auto const M = finer.coarser(K, inverse);
    separable_qp const qp{slant::matrix<self_adjoint, positive_definite>(K), f, surface};
    symmetric_newton_options<S> newton;
    newton.energy_goal = std::numeric_limits<S>::min();
    nested_start const coarser(f, surface, M, candidates, inverse);
    auto const method = [&] { return envelope_newton{qp, M, newton}; };
    auto state = coarser.found() ? method().start_on_face([&](S const& ρ) { return coarser.at(ρ); })
                                 : method().start(vector_type::Zero(f.size()));
    for (index k = 0; k < 40 && state.status == status::running; ++k) {
      S const size = energy_norm(state.x, state.unit * state.r + f);
      newton.energy_goal = std::max<S>(S(0.01) * size, std::numeric_limits<S>::min());
      method().step(state);
    }
    coarse_ = state.x;
    steps_ = state.iteration + coarser.steps();
    for (contact const& c : list_) {
      S const& x = coarse_[c.p];
      touches_.push_back(x <= c.gap.lower() || x >= c.gap.upper());
      bool sticks = tangents_ > 0;
      for (index j = 0; j < tangents_; ++j) sticks = sticks && coarse_[c.q + j * c.stride] == S(0);
      sticks_.push_back(sticks);
    }
  }

  surface_function<S> const* φ_;
  index tangents_;
  index width_ = 0, node_size_ = 1, steps_ = 0;
  std::vector<int> of_, number_;  // the aggregate of a node, and the contact of an aggregate
  std::vector<contact> list_;     // of level 1
  std::vector<std::pair<index, frame>> frames_;
  std::vector<bool> touches_, sticks_;
  vector_type coarse_, displacement_;
  bool has_pairs_ = false, found_ = false;
};

}  // namespace slant::contact::detail
