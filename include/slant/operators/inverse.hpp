// SPDX-License-Identifier: MIT
//
// The inverse as an operator: of a factorisation, y = K⁻¹x by a solve, or of an operator that knows
// its own inverse. Closure: self-adjoint and definite if K is.
#pragma once

#include <slant/base/held.hpp>
#include <slant/concepts/capabilities.hpp>
#include <slant/concepts/factorization.hpp>
#include <slant/concepts/member_names.hpp>
#include <slant/operators/composition.hpp>

#include <type_traits>
#include <utility>

namespace slant {

/// y = K⁻¹ x. F, a factorisation of K, is `Factorization const&` (referenced) or owned.
template <class F>
class inverse_operator {
  using part = std::remove_cvref_t<F>;

  template <class X, class Y>
  static constexpr bool solves = requires(part const& f, X const& x, Y& y) { f.solve(x, y); } ||
                                 requires(part const& f, X const& x, Y& y,
                                          workspace_t<part, plain_t<X>>& w) { f.solve(x, y, w); };

 public:
  static constexpr law_set laws = detail::inverse_laws(laws_of<F>);

  explicit inverse_operator(held<F> f) : f_(std::move(f)) {}

  [[nodiscard]] index rows() const { return f_.get().rows(); }
  [[nodiscard]] index cols() const { return f_.get().rows(); }
  /// The factorisation itself.
  [[nodiscard]] part const& factors() const noexcept { return f_.get(); }

  template <class X>
    requires factorization<part, plain_t<X>>
  [[nodiscard]] auto workspace(X const& x) const {
    return slant::workspace(f_.get(), x);
  }
  template <class X, class Y, class W>
    requires solves<X, Y>
  void apply(X const& x, Y& y, W& w) const {
    detail::solve_with(f_.get(), x, y, w);
  }
  template <class X, class Y, class W>
    requires factorization<part, plain_t<X>> &&
             requires(part const& f, X const& x, Y& y) { f.solve_adjoint(x, y); }
  void apply_adjoint(X const& x, Y& y, W&) const {
    f_.get().solve_adjoint(x, y);
  }
  /// Solves with unit vectors, where the factorisation takes several right-hand sides.
  template <class Y>
    requires factorization<part, plain_t<Y>>
  void columns(index first, Y& y) const {
    slant::apply(*this, detail::unit_columns(y, rows(), first), y);
  }

 private:
  held<F> f_;
};

namespace detail {

/// What makes an operator, though it may have solve as well.
template <class F> concept operator_like = has_cols<F> && has_apply_member<F>;

/// What tells a factorisation from an operator. (The name is what g++ shows when it is missing.)
template <class F> concept has_solve_member_and_no_apply = has_solve_member<F> && !operator_like<F>;

template <class F> concept factorization_like = has_rows<F> && has_solve_member_and_no_apply<F>;

/// x = K⁻¹b, once: a factorisation that can do without a workspace makes none.
template <class F, class V>
void solve_once(F const& f, V const& b, V& x) {
  if constexpr (has_plain_solve<F, V>) {
    f.solve(b, x);
  } else {
    slant::apply(inverse_operator<F const&>(held<F const&>(f)), b, x);
  }
}

}  // namespace detail

/// A factorisation, or an operator with inverse().
template <class F>
concept invertible =
    has_rows<F> && (detail::has_solve_member_and_no_apply<F> || detail::knows_its_inverse<F>);

/// The inverse of a factored matrix, or of an operator that knows it.
template <class F>
  requires invertible<std::remove_cvref_t<F>>
[[nodiscard]] auto inverse(F&& factors) {
  if constexpr (detail::factorization_like<std::remove_cvref_t<F>>) {
    return inverse_operator<kept_t<F>>{held<kept_t<F>>(std::forward<F>(factors))};
  } else {
    return factors.inverse();
  }
}

}  // namespace slant
