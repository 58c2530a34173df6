// SPDX-License-Identifier: MIT
//
// The blocks of a set that are sections of the Lorentz cone L = {p : ‖p_t‖ ≤ p_0}, x ∈ Λᵢ ⟺
// p = T x + t ∈ L (discs, balls, ellipses, second-order cones and their images), each with a force
// y ∈ L of its own in a primal-dual interior-point method:
//
//     A x − b − Σ Tᵀy = 0,   p ∘ y = μ e,   p, y ∈ L,   e = (1, 0).
//
// A multiplier ν of ‖p_t‖² − p_0² ≤ 0 would only know forces along the gradient at x: what is left
// of A x − b along a curved boundary could fall no faster than x turns, and x, next to that
// boundary, cannot turn. y takes any direction, and A x − b − Σ Tᵀy falls by 1 − α in a step α.
//
// Scaling of Nesterov and Todd ("Self-scaled barriers and interior-point methods for convex
// programming", 1997): the symmetric W with W y = W⁻¹p = λ, W L = L. The step Δx, Δy solves
//
//     W⁻¹TΔx + WΔy = c − λ,   c = σμ λ⁻¹ − λ \ (d_p ∘ d_y),
//
// where d_p = W⁻¹TΔx and d_y = WΔy of an earlier step are the second-order correction of Mehrotra
// ("On the implementation of a primal-dual interior point method", 1992). So Δx sees the matrix
// TᵀW⁻²T and the force TᵀW⁻¹c. The formulas are those of Vandenberghe ("The CVXOPT linear and
// quadratic cone program solvers", 2010, §4).
//
// Next to a curved boundary, W is a boost along w̄_t, and p and y lose the parts (1 − σ)/2 (1, ∓w̄_t)
// of λ ≈ √μ e, w̄_t taken of length 1, whatever else they do. So the part λ_⊥ of λ across w̄_t, by
// which p and y differ in direction, is left with d_p ∘ d_y = −(1 − σ)/2 √μ (d_p + d_y)_⊥: of the
// linear step (1 − σ)/2 of it in every step, and of A x − b along the boundary as much, however
// fast μ falls. That second-order term is known before the step is: with c_⊥ = −λ_⊥ for −σλ_⊥
// nothing is left. Where W is no boost, y vanishes as a whole and −σλ_⊥ is right; |w̄_t|²/w̄_0² leads
// from the one to the other.
//
// Near the boundary p_0 − ‖p_t‖ has no digits left. det p = p_0² − ‖p_t‖² comes from the inequality
// of the block, which is accurate there; det y goes from step to step, as that of λ + α d_y, which
// is well inside.
#pragma once

#include <slant/base/entries.hpp>
#include <slant/base/scaling.hpp>
#include <slant/concepts/bad_input.hpp>
#include <slant/sets/blocks.hpp>
#include <slant/sets/second_order_cone.hpp>
#include <slant/slanting/inequality_jacobian.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <type_traits>
#include <utility>
#include <vector>

namespace slant {

/// A block of fixed size that is a section of the Lorentz cone.
template <class Block>
concept lorentz_block = has_static_dimension<Block> && has_lorentz_form<Block, point_t<Block>>;

namespace detail {

/// Number of entries of p.
template <class Block>
inline constexpr int lorentz_entries =
    decltype(std::declval<Block const&>().lorentz_matrix())::RowsAtCompileTime;

}  // namespace detail

/// Where the data of the sections of L stand, one after the other as the blocks are visited.
class lorentz_place {
 public:
  template <int Entries>
  struct position {
    static constexpr int M = Entries;
    std::size_t first;   ///< of the entries of y
    std::size_t number;  ///< of the block among these
    index row;           ///< of its first inequality
  };

  template <class Block>
  [[nodiscard]] position<detail::lorentz_entries<Block>> next(index row) {
    std::size_t const first = first_;
    first_ += std::size_t(detail::lorentz_entries<Block>);
    return {first, number_++, row};
  }

 private:
  std::size_t first_ = 0;
  std::size_t number_ = 0;
};

/// The pairs p, y of a set, which is handed to every member again, as barrier's is. Forces are in
/// multiples of the unit that the caller has.
template <scalar S>
class lorentz_pairs {
 public:
  /// Room for the blocks of a set; allocates.
  template <class C>
  explicit lorentz_pairs(C const& set) {
    std::size_t entries = 0, blocks = 0;
    slant::visit_blocks(set, [&](auto const& block, auto const&) {
      using block_type = std::remove_cvref_t<decltype(block)>;
      if constexpr (lorentz_block<block_type>) {
        entries += std::size_t(detail::lorentz_entries<block_type>);
        ++blocks;
      }
    });
    for (auto* v : {&y_, &λ_, &frame_, &dp_, &dy_, &step_}) v->resize(entries, S(0));
    for (auto* v : {&root_p_, &root_y_, &trial_root_}) v->resize(blocks, S(0));
  }

  /// y = ϑ p⁻¹ at x. Blocks whose first 1/σ (barrier.hpp) is 0 have no bound and no force.
  template <class C, class X, class R>
  void begin(C const& set, X const& x, R const& per_unit, S const& ϑ) {
    visit(set, [&](auto const& block, auto const& place, auto const& at) {
      using std::sqrt;
      auto const here = place.value(x);
      S const det = -block.inequality(here)(0);
      bool const bound = per_unit.coeff(at.row) > S(0);
      root_p_[at.number] = bound ? S(sqrt(det)) : S(0);
      root_y_[at.number] = bound ? S(ϑ / root_p_[at.number]) : S(0);
      auto const p = block.lorentz_point(here);
      for (int i = 0; i < at.M; ++i) {
        S const entry = bound ? S(ϑ * (p[i] / det)) : S(0);
        y_[at.first + std::size_t(i)] = i == 0 ? entry : S(-entry);
      }
    });
  }
  /// All forces times a number > 0.
  void raise(S const& factor) {
    for (auto& each : y_) each *= factor;
    for (auto& each : root_y_) each *= factor;
  }

  /// W and λ at x.
  template <class C, class X>
  void scale(C const& set, X const& x) {
    visit_bound(set, [&](auto const& block, auto const& place, auto const& at) {
      using std::sqrt;
      using algebra = algebra_of<decltype(at)>;
      using part = typename algebra::part;
      auto const here = place.value(x);
      S const a = sqrt(S(-block.inequality(here)(0)));
      S const b = root_y_[at.number];
      root_p_[at.number] = a;
      part const p = detail::over(block.lorentz_point(here), a);
      part const y = detail::over(of(at, y_), b);
      S const γ = sqrt((S(1) + algebra::pairing(p, y)) / S(2));
      detail::put_entries(
          detail::over(detail::combination(S(1), p, S(1), algebra::reflected(y)), S(2) * γ),
          &frame_[at.first]);
      S const size = sqrt(a) * sqrt(b), sum = p[0] + y[0] + S(2) * γ;
      part λ = detail::combination(S((γ + y[0]) / sum), p, S((γ + p[0]) / sum), y);
      λ[0] = γ;
      detail::put_entries(detail::multiple_of(size, λ), &λ_[at.first]);
    });
  }

  /// TᵀW⁻²T of the block at a place of `visit`.
  template <class Block, class At>
  [[nodiscard]] auto stiffness(Block const& block, At const& at) const {
    constexpr int n = static_dimension_of<Block>, M = At::M;
    auto const T = block.lorentz_matrix();
    auto const w = of(at, frame_);
    using std::sqrt;
    S const root = sqrt(S(root_y_[at.number] / root_p_[at.number]));
    Eigen::Matrix<S, n, 1> along;  // Tᵀ J w̄
    for (int j = 0; j < n; ++j) {
      along[j] = detail::sum_of<M>([&](int i) -> S {
        return i == 0 ? S((root * T(i, j)) * w[i]) : S(-((root * T(i, j)) * w[i]));
      });
    }
    return detail::from_entries<Eigen::Matrix<S, n, n>>([&](int i, int j) -> S {
      S const JTT = detail::sum_of<M>([&](int k) -> S {
        S const product = (root * T(k, i)) * (root * T(k, j));
        return k == 0 ? product : S(-product);
      });
      return S(2) * along[i] * along[j] - JTT;
    });
  }

  /// rhs ← rhs − Σ TᵀW⁻¹c for c = σμ λ⁻¹ turned as at the top of this file; `corrected`: not
  /// turned, less λ \ (d_p ∘ d_y) of the last step.
  template <class C, class V>
  void subtract_target(C const& set, S const& σμ, S const& corrected, V& rhs) {
    visit_bound(set, [&](auto const& block, auto const& place, auto const& at) {
      using algebra = algebra_of<decltype(at)>;
      auto const λ = of(at, λ_);
      S const det = root_p_[at.number] * root_y_[at.number];
      S const next = σμ / det;
      auto c = detail::multiple_of(next, algebra::reflected(λ));
      if (corrected > S(0)) {
        auto const second = algebra::quotient(algebra::product(of(at, dp_), of(at, dy_)), λ);
        c = detail::combination(S(1), c, S(-corrected), second);
      } else if (next < S(1)) {
        turn(at, S(S(1) - next), λ, c);
      }
      detail::put_entries(c, &step_[at.first]);
      subtract(block, place, unscaled(at, c), rhs);
    });
  }

  /// d_p and d_y for the c of the last call of subtract_target and the step Δx.
  template <class C, class X>
  void set_step(C const& set, X const& Δx) {
    visit_bound(set, [&](auto const& block, auto const& place, auto const& at) {
      constexpr int M = std::remove_cvref_t<decltype(at)>::M;
      auto const T = block.lorentz_matrix();
      auto const d = place.value(Δx);
      Eigen::Matrix<S, M, 1> Δp = Eigen::Matrix<S, M, 1>::Zero();
      for (int j = 0; j < static_dimension_of<std::remove_cvref_t<decltype(block)>>; ++j) {
        for (int i = 0; i < M; ++i) Δp[i] += T(i, j) * d[j];
      }
      auto const dp = unscaled(at, Δp);
      for (int i = 0; i < M; ++i) {
        auto const k = at.first + std::size_t(i);
        dp_[k] = dp[i];
        dy_[k] = step_[k] - λ_[k] - dp[i];
      }
    });
  }

  /// sup{α : y + αΔy ∈ L}.
  template <class C>
  [[nodiscard]] S way_out(C const& set) const {
    S most = detail::infinity<S>();
    visit_bound(set, [&](auto const&, auto const&, auto const& at) {
      second_order_cone<std::remove_cvref_t<decltype(at)>::M, S> const L(S(1));
      most = std::min<S>(most, L.step_to_boundary(of(at, λ_), of(at, dy_)));
    });
    return most;
  }

  /// pᵀy at x and y + αΔy to the rows of `products`; the smallest square of an eigenvalue of the λ
  /// there to `least`, if it is smaller. False if one is not inside.
  template <class C, class X, class P>
  [[nodiscard]] bool judge(C const& set, X const& x, S const& α, P& products, S& least) {
    auto& out = slant::local(products);
    bool inside = true;
    visit_bound(set, [&](auto const& block, auto const& place, auto const& at) {
      using std::sqrt;
      using algebra = algebra_of<decltype(at)>;
      auto const here = place.value(x);
      S const det_p = -block.inequality(here)(0);
      auto const λ = detail::combination(S(1), of(at, λ_), α, of(at, dy_));
      S const det_λ = algebra::determinant(λ);
      if (!(det_p > S(0) && det_λ > S(0) && λ[0] > S(0))) {
        inside = false;
        return;
      }
      S const a = sqrt(det_p);
      S const b = sqrt(det_λ) * sqrt(S(root_y_[at.number] / root_p_[at.number]));
      trial_root_[at.number] = b;
      auto const y = unscaled(at, λ);
      S const pairing =
          algebra::pairing(detail::over(block.lorentz_point(here), a), detail::over(y, b));
      S const most =
          sqrt(S((pairing + S(1)) / S(2))) + sqrt(S(std::max<S>(pairing - S(1), S(0)) / S(2)));
      out.coeffRef(at.row) = a * b * pairing;
      least = std::min<S>(least, S(a * b / most / most));
    });
    return inside;
  }

  /// ∇L ← ∇L − Σ Tᵀ(y + αΔy).
  template <class C, class V>
  void subtract_forces(C const& set, S const& α, V& lagrangian) const {
    visit_bound(set, [&](auto const& block, auto const& place, auto const& at) {
      auto y = of(at, y_);
      if (α > S(0)) y = unscaled(at, detail::combination(S(1), of(at, λ_), α, of(at, dy_)));
      subtract(block, place, y, lagrangian);
    });
  }

  /// y ← y + αΔy, for the α of the last call of judge.
  template <class C>
  void accept(C const& set, S const& α) {
    visit_bound(set, [&](auto const&, auto const&, auto const& at) {
      detail::put_entries(unscaled(at, detail::combination(S(1), of(at, λ_), α, of(at, dy_))),
                          &y_[at.first]);
    });
    root_y_ = trial_root_;
  }

  /// y_0 / (2 p_0) at x, the multiplier of the first inequality of a block.
  template <class Block, class Place, class At, class X>
  [[nodiscard]] S multiplier(Block const& block, Place const& place, At const& at,
                             X const& x) const {
    return y_[at.first] / block.lorentz_point(place.value(x))[0] / S(2);
  }
  /// f(row, ‖y + Δy‖/‖y‖) for every pair.
  template <class C, class F>
  void growth(C const& set, F const& f) const {
    visit_bound(set, [&](auto const&, auto const&, auto const& at) {
      S const y = y_[at.first];
      f(at.row, S(y + unscaled(at, of(at, dy_))[0]) / y);
    });
  }

  /// f(block, place, at) for every block that is a section of L, bounded or not; `at` knows where
  /// its data are.
  template <class C, class F>
  void visit(C const& set, F const& f) const {
    lorentz_place next;
    index row = 0;
    slant::visit_blocks(set, [&](auto const& block, auto const& place) {
      using block_type = std::remove_cvref_t<decltype(block)>;
      if constexpr (lorentz_block<block_type>) {
        f(block, place, next.template next<block_type>(row));
      }
      row += detail::inequalities_of<block_type>;
    });
  }
  /// Only those with a bound.
  template <class C, class F>
  void visit_bound(C const& set, F const& f) const {
    visit(set, [&](auto const& block, auto const& place, auto const& at) {
      if (root_y_[at.number] > S(0)) f(block, place, at);
    });
  }
  [[nodiscard]] bool bound(std::size_t number) const { return root_y_[number] > S(0); }
  /// There is no such block in the set.
  [[nodiscard]] bool empty() const { return root_y_.empty(); }

 private:
  template <class At>
  using algebra_of = detail::lorentz_algebra<std::remove_cvref_t<At>::M, S>;
  template <class At>
  using part_of = typename algebra_of<At>::part;

  /// The entries of a block at its place.
  template <class At>
  [[nodiscard]] static part_of<At> of(At const& at, std::vector<S> const& data) {
    return detail::entries_at<At::M>(&data[at.first]);
  }
  /// W⁻¹x = β⁻¹ (2 (Jv)(Jv)ᵀ − J) x,  v = (w̄ + e)/√(2 (w̄_0 + 1)),  β² = √(det p / det y).
  template <class At>
  [[nodiscard]] part_of<At> unscaled(At const& at, part_of<At> const& x) const {
    using std::sqrt;
    using algebra = algebra_of<At>;
    auto v = algebra::reflected(of(at, frame_));
    v[0] += S(1);
    S const along = detail::dot_of(v, x) / v[0];
    S const per_β = sqrt(S(root_y_[at.number] / root_p_[at.number]));
    return detail::combination(S(per_β * along), v, S(-per_β), algebra::reflected(x));
  }
  /// c ← c − f λ_⊥ |w̄_t|²/w̄_0², λ_⊥ the part of λ_t across w̄_t.
  template <class At, class Part>
  void turn(At const& at, S const& f, Part const& λ, Part& c) const {
    constexpr int M = At::M;
    auto const w = of(at, frame_);
    S const along = detail::sum_of<M - 1>([&](int i) -> S { return (w[i + 1] / w[0]) * λ[i + 1]; });
    S const square = detail::sum_of<M - 1>([&](int i) -> S {
      S const ratio = w[i + 1] / w[0];
      return ratio * ratio;
    });
    for (int i = 1; i < M; ++i) c[i] -= f * (square * λ[i] - along * (w[i] / w[0]));
  }
  /// to ← to − Tᵀy.
  template <class Block, class Place, class Y, class V>
  static void subtract(Block const& block, Place const& place, Y const& y, V& to) {
    auto const T = block.lorentz_matrix();
    auto& entries = slant::local(to);
    for (int j = 0; j < static_dimension_of<Block>; ++j) {
      S sum(0);
      for (int i = 0; i < detail::lorentz_entries<Block>; ++i) sum += T(i, j) * y[i];
      entries.coeffRef(place.component(j)) -= sum;
    }
  }

  std::vector<S> y_, λ_;            // forces; scaled pairs
  std::vector<S> frame_;            // w̄
  std::vector<S> dp_, dy_;          // scaled steps
  std::vector<S> step_;             // c
  std::vector<S> root_p_, root_y_;  // √det p, √det y; 0 without a bound
  std::vector<S> trial_root_;       // √det (y + αΔy)
};

}  // namespace slant
