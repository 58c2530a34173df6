// SPDX-License-Identifier: MIT
//
// Sets blown up or shrunk: scaled(2.0, set) is { 2 z : z ∈ set }.
#pragma once

#include <slant/concepts/bad_input.hpp>
#include <slant/sets/detail/scaling.hpp>
#include <slant/sets/image_block.hpp>
#include <slant/sets/image_product.hpp>

#include <type_traits>
#include <utility>

namespace slant {

namespace detail {

/// x = c z.
template <class S>
class dilation {
 public:
  static constexpr bool separable = true;

  explicit dilation(S const& c) : c_(c) {}

  [[nodiscard]] S const& factor() const { return c_; }

  [[nodiscard]] auto pull(auto const& x) const { return detail::settled(x / c_); }
  [[nodiscard]] auto push(auto const& z) const { return detail::settled(z * c_); }
  [[nodiscard]] auto pull_direction(auto const& d) const { return detail::settled(d / c_); }
  [[nodiscard]] auto push_adjoint(auto const& y) const { return detail::settled(y * c_); }
  [[nodiscard]] S offset(auto const&) const { return S(0); }
  [[nodiscard]] auto push_gradient(auto const& g) const { return (g / c_).eval(); }
  [[nodiscard]] auto push_hessian(auto const& h) const { return (h / c_ / c_).eval(); }
  [[nodiscard]] auto push_slant(auto const& g) const { return g; }

  template <class X, class Z>
  [[nodiscard]] S slop(X const&, Z const& z) const {
    return rounding_band<S>() * z.template lpNorm<1>();
  }
  [[nodiscard]] dilation at(auto const&) const { return *this; }

 private:
  S c_;
};

}  // namespace detail

/// c Λ for a finite c > 0. A product passed as an lvalue is referenced.
/// @throws bad_input if c is not a finite number > 0.
template <class S, class C>
  requires set_part<std::remove_cvref_t<C>> && std::convertible_to<S, set_scalar_t<C>>
[[nodiscard]] auto scaled(S const& c, C&& set) {
  using scalar = set_scalar_t<C>;
  auto const factor = static_cast<scalar>(c);
  if (!(factor > scalar(0) && detail::is_finite(factor))) {
    throw bad_input("c", detail::show(factor), "a finite number > 0");
  }
  return detail::image_of(std::forward<C>(set), detail::dilation<scalar>(factor));
}

}  // namespace slant
