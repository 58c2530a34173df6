// SPDX-License-Identifier: MIT
//
// A multiple of an operator. The sign of c is part of the type, its value is not:
//
//     scaled(2.0, A)                  keeps the laws of A; where A is semidefinite c must be > 0
//                                     (>= 0 if A is not definite), which is checked
//     scaled(positive(2.0), A)        the same, checked whatever A is
//     scaled(any_sign(-2.0), A)       self-adjoint if A is, and no more
#pragma once

#include <slant/base/vector_algebra.hpp>
#include <slant/operators/composition.hpp>
#include <slant/operators/matrix.hpp>

#include <type_traits>
#include <utility>

namespace slant {

/// A number known to be positive.
template <class S>
class positive_factor {
 public:
  /// Throws bad_input unless 0 < c < ∞.
  explicit positive_factor(S c) : value_(std::move(c)) {
    if (!(value_ > S(0)) || !detail::is_finite(value_)) {
      throw bad_input("c", detail::show(value_), "a finite number > 0");
    }
  }
  [[nodiscard]] S const& value() const noexcept { return value_; }

 private:
  S value_;
};

/// Marks c as positive. Throws bad_input unless 0 < c < ∞.
template <class S>
  requires scalar<S> || std::is_integral_v<S>
[[nodiscard]] positive_factor<S> positive(S c) {
  return positive_factor<S>(std::move(c));
}

/// A number of which nothing is promised.
template <class S>
struct any_sign_factor {
  S value;
};

/// Marks c as a number of any sign: any_sign(c) * A is self-adjoint if A is, and no more.
/// Throws bad_input if c is NaN or infinite.
template <class S>
  requires scalar<S> || std::is_integral_v<S>
[[nodiscard]] any_sign_factor<S> any_sign(S c) {
  if (!detail::is_finite(c)) throw bad_input("c", detail::show(c), "a finite number");
  return {c};
}

/// The factor 1/c, which is rounded where it is used: in the scalar of the vectors.
template <class S>
struct reciprocal_factor {
  S denominator;
};

namespace detail {

/// Throws bad_input unless c has the sign that keeps an operator semidefinite, or definite.
template <class S>
void require_keeping_sign(S const& c, bool definite) {
  if (c > S(0) || (!definite && c == S(0))) return;
  throw bad_input("c", show(c),
                  definite ? "a number > 0 in front of a definite operator; for others write "
                             "-(c * A) or any_sign(c) * A"
                           : "a number >= 0 in front of a semidefinite operator; for others write "
                             "-(c * A) or any_sign(c) * A");
}

/// A factor in the scalar T.
template <class T, class S>
[[nodiscard]] T factor_in(S const& c) {
  return static_cast<T>(c);
}
template <class T, class S>
[[nodiscard]] T factor_in(reciprocal_factor<S> const& c) {
  return T(1) / static_cast<T>(c.denominator);
}

/// Throws bad_input if 1/c is not finite.
template <class S>
[[nodiscard]] reciprocal_factor<S> inverse_factor(S const& c) {
  if constexpr (!std::is_integral_v<S>) {
    if (!is_finite(S(S(1) / c))) {
      throw bad_input("c", show(c), "a number with a finite reciprocal");
    }
  }
  return {c};
}
template <class S>
[[nodiscard]] S inverse_factor(reciprocal_factor<S> const& c) {
  return c.denominator;
}

}  // namespace detail

/// y = c A x. A is `Operator const&` (referenced) or an operator type (owned).
template <class S, class A, bool Positive>
class scaled_operator {
  using part = std::remove_cvref_t<A>;

 public:
  static constexpr law_set laws = detail::scaled_laws(laws_of<A>, Positive);

  /// c is finite, and >= 0, if A is definite > 0, if Positive; slant::scaled checks it.
  scaled_operator(S c, held<A> a) : c_(std::move(c)), a_(std::move(a)) {}

  [[nodiscard]] index rows() const { return a_.get().rows(); }
  [[nodiscard]] index cols() const { return a_.get().cols(); }
  /// c, a number or (of an inverse) a reciprocal_factor.
  [[nodiscard]] S const& factor() const noexcept { return c_; }

  template <class X>
    requires linear_operator<part, plain_t<X>>
  [[nodiscard]] auto workspace(X const& x) const {
    return slant::workspace(a_.get(), x);
  }
  template <class X, class Y, class W>
    requires detail::applies<part, X, Y>
  void apply(X const& x, Y& y, W& w) const {
    slant::apply(a_.get(), x, y, w);
    vectors::scale(factor_as<X>(), y);
  }
  template <class X, class Y, class W>
    requires detail::accumulates<part, X, Y>
  void apply_add(scalar_t<X> α, X const& x, Y& y, W& w) const {
    slant::apply_add(a_.get(), scalar_t<X>(α * factor_as<X>()), x, y, w);
  }

  template <class X>
    requires has_adjoint<part, plain_t<X>>
  [[nodiscard]] auto adjoint_workspace(X const& x) const {
    return slant::adjoint_workspace(a_.get(), x);
  }
  template <class X, class Y, class W>
    requires detail::applies_adjoint<part, X, Y>
  void apply_adjoint(X const& x, Y& y, W& w) const {
    slant::apply_adjoint(a_.get(), x, y, w);
    vectors::scale(factor_as<X>(), y);
  }
  template <class X, class Y, class W>
    requires detail::accumulates_adjoint<part, X, Y>
  void apply_adjoint_add(scalar_t<X> α, X const& x, Y& y, W& w) const {
    slant::apply_adjoint_add(a_.get(), scalar_t<X>(α * factor_as<X>()), x, y, w);
  }

  template <class D>
    requires has_diagonal<part, D>
  void diagonal(D& d) const {
    a_.get().diagonal(d);
    vectors::scale(factor_as<D>(), d);
  }
  template <class Y>
    requires has_columns<part, Y>
  void columns(index first, Y& y) const {
    a_.get().columns(first, y);
    vectors::scale(factor_as<Y>(), y);
  }
  /// c⁻¹A⁻¹. Throws bad_input if c is so small that 1/c is not finite.
  [[nodiscard]] auto inverse() const
    requires(Positive && detail::knows_its_inverse<part>)
  {
    using inverse_part = std::remove_cvref_t<decltype(a_.get().inverse())>;
    using factor_type = decltype(detail::inverse_factor(c_));
    return scaled_operator<factor_type, inverse_part, true>{detail::inverse_factor(c_),
                                                            held<inverse_part>(a_.get().inverse())};
  }

 private:
  template <class X>
  [[nodiscard]] scalar_t<X> factor_as() const {
    return detail::factor_in<scalar_t<X>>(c_);
  }

  S c_;
  held<A> a_;
};

/// c A for a positive factor: keeps definiteness.
template <class S, operand A>
[[nodiscard]] auto scaled(positive_factor<S> c, A&& a) {
  return scaled_operator<S, part_t<A>, true>{
      c.value(), held<part_t<A>>(slant::as_operator(std::forward<A>(a)))};
}

/// c A. Throws bad_input if c is NaN or infinite, or has not the sign that the laws of A need.
template <class S, operand A>
  requires scalar<S> || std::is_integral_v<S>
[[nodiscard]] auto scaled(S c, A&& a) {
  if (!detail::is_finite(c)) throw bad_input("c", detail::show(c), "a finite number");
  constexpr bool keeps = declares_positive_semidefinite<A>;
  if constexpr (keeps) detail::require_keeping_sign(c, declares_positive_definite<A>);
  return scaled_operator<S, part_t<A>, keeps>{
      c, held<part_t<A>>(slant::as_operator(std::forward<A>(a)))};
}

/// c A for a factor of any sign.
template <class S, operand A>
[[nodiscard]] auto scaled(any_sign_factor<S> c, A&& a) {
  return scaled_operator<S, part_t<A>, false>{
      c.value, held<part_t<A>>(slant::as_operator(std::forward<A>(a)))};
}

}  // namespace slant
