// SPDX-License-Identifier: MIT
//
// The same quadratic program in unknowns of similar stiffness. With x = D y,
//
//     minimise   ½ yᵀ(D A D) y − (D b)ᵀy   over   y ∈ D⁻¹Λ,        D = diag(d),
//
// where d is one factor for each block. With d = mean(diag A over the block)^(−1/2) every block has
// the stiffness 1: among all such D one that comes within a factor of the number of blocks of the
// smallest condition number of D A D [van der Sluis 1969].
//
// Methods whose steps have one length for all blocks (the gradient steps of kprgp, ρ in the natural
// residual of symmetric_newton) need it where the stiffness of the blocks differs by orders of
// magnitude: bodies of steel and rubber, nodes of very different weights, unknowns of different
// units. They see a separable_qp like any other, and ‖r̃‖ is then measured in roots of energy.
#pragma once

#include <slant/base/held.hpp>
#include <slant/base/vector_algebra.hpp>
#include <slant/concepts/bad_input.hpp>
#include <slant/concepts/capabilities.hpp>
#include <slant/operators/diagonal.hpp>
#include <slant/operators/product.hpp>
#include <slant/problems/separable_qp.hpp>
#include <slant/sets/images.hpp>

#include <algorithm>
#include <cmath>
#include <string>
#include <type_traits>
#include <utility>

namespace slant {

/// d_j = (mean of a over the block of j)^(−1/2), where a = diag(A); where that mean is 0, the
/// geometric mean of the least and the greatest of the others, 1 if there are none.
/// Throws bad_input unless a has the size of the set and finite entries ≥ 0.
template <class C, class S>
[[nodiscard]] auto block_factors(C const& set, Eigen::Matrix<S, Eigen::Dynamic, 1> const& a) {
  using std::sqrt;
  detail::check_size("diagonal", index(a.size()), slant::dimension_of(set),
                     "the dimension of the set,");
  Eigen::Matrix<S, Eigen::Dynamic, 1> d(a.size());
  for (index j = 0; j < a.size(); ++j) {
    if (!(a(j) >= S(0) && detail::is_finite(a(j)))) {
      throw bad_input("diagonal(" + std::to_string(j) + ")", detail::show(a(j)),
                      "a finite number >= 0");
    }
    d(j) = a(j) > S(0) ? S(S(1) / sqrt(a(j))) : S(0);
  }
  slant::visit_blocks(set, [&](auto const& block, auto const& p) {
    if constexpr (!whole_space<std::remove_cvref_t<decltype(block)>>) {
      S sum(0);
      for (index j = 0; j < p.size(); ++j) sum += a(p.component(j)) / S(p.size());
      S const factor = sum > S(0) ? S(S(1) / sqrt(sum)) : S(0);
      for (index j = 0; j < p.size(); ++j) d(p.component(j)) = factor;
    }
  });
  S least(0), most(0);
  for (S const& factor : d) {
    if (factor > S(0) && !(least > S(0) && least <= factor)) least = factor;
    most = std::max<S>(most, factor);
  }
  S const typical = most > S(0) ? S(sqrt(least) * sqrt(most)) : S(1);
  for (S& factor : d) factor = factor > S(0) ? factor : typical;
  return d;
}

/// A quadratic program in unknowns y with x = D y: `auto const scaled = equilibrated(qp);
/// auto r = solve(symmetric_newton{scaled.qp()}, scaled.from(x0), stop); scaled.back(r.x())`.
/// QP is `Problem const&` (referenced) or a problem type (owned).
template <class QP>
class equilibrated {
  using problem = std::remove_cvref_t<QP>;

 public:
  using vector_type = typename problem::vector_type;
  using scalar = typename problem::scalar;
  using factors = Eigen::Matrix<scalar, Eigen::Dynamic, 1>;

  /// d from the diagonal of A, which A must give.
  explicit equilibrated(held<QP> qp)
      : original_(std::move(qp)), d_(factors_of(original_.get())), b_(scaled_b()) {}

  /// d: one factor for each unknown, the same all over a block. For an A that does not give its
  /// diagonal, `block_factors` makes them of an estimate.
  /// Throws bad_input as block_scaled does.
  equilibrated(held<QP> qp, factors d)
      : original_(std::move(qp)), d_(std::move(d)), b_(scaled_b()) {}

  /// D.
  [[nodiscard]] factors const& d() const { return d_; }

  /// min ½ yᵀ(D A D) y − (D b)ᵀy over D⁻¹Λ. References this object.
  [[nodiscard]] auto qp() const& {
    return separable_qp{congruence(diagonal<positive_definite>(d_), original_.get().a()), b_,
                        block_scaled(factors(d_.cwiseInverse()), function_of(original_.get()))};
  }
  auto qp() const&& = delete;  // it would reference what is about to end

  /// y of x.
  [[nodiscard]] vector_type from(vector_type x) const {
    detail::check_size("x", index(slant::local(x).size()), original_.get().size());
    vectors::quotient(x, d_, x);
    return x;
  }
  /// x of y.
  [[nodiscard]] vector_type back(vector_type y) const {
    detail::check_size("y", index(slant::local(y).size()), original_.get().size());
    vectors::multiply(y, d_, y);
    return y;
  }

 private:
  static factors factors_of(problem const& qp) {
    constexpr bool known = may_have_diagonal<typename problem::operator_type, vector_type>;
    static_assert(known,
                  "equilibrated: A must have diagonal(d); without it, give the factors d as second "
                  "argument");
    factors a = factors::Ones(qp.size());
    if constexpr (known) {
      vector_type diagonal_of_a = like(qp.b(), qp.size());
      if (!slant::diagonal_if_known(qp.a(), diagonal_of_a)) {
        throw bad_input("A", "an operator without a diagonal",
                        "diagonal(d), or the factors d as second argument");
      }
      a = slant::local(diagonal_of_a);
    }
    return block_factors(function_of(qp), a);
  }

  [[nodiscard]] vector_type scaled_b() const {
    detail::check_block_factors(d_, function_of(original_.get()));
    vector_type b = original_.get().b();
    vectors::multiply(b, d_, b);
    return b;
  }

  held<QP> original_;
  factors d_;
  vector_type b_;  ///< D b
};

template <class QP>
equilibrated(QP&&) -> equilibrated<kept_t<QP>>;
template <class QP>
equilibrated(QP&&, typename equilibrated<kept_t<QP>>::factors) -> equilibrated<kept_t<QP>>;

}  // namespace slant
