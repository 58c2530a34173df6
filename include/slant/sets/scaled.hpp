// SPDX-License-Identifier: MIT
//
// Sets blown up or shrunk: scaled(2.0, set) is { 2 z : z ∈ set }.
#pragma once

#include <slant/base/scaling.hpp>
#include <slant/concepts/bad_input.hpp>
#include <slant/sets/blocks.hpp>
#include <slant/sets/parts/image.hpp>

#include <Eigen/Core>

#include <string>
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

// --- block scaled --------------------------------------------------------------------------------
//
// A product of blocks of which each is blown up or shrunk by a factor of its own:
//
//     block_scaled(d, Λ) = { D z : z ∈ Λ },   D = diag(d),
//
// d constant on every block, so that a ball stays a ball and projections stay block by block. The
// change of unknowns x = D z that gives all blocks a similar stiffness needs it: see
// problems/equilibrated.hpp.

namespace detail {

/// x = D z, D diagonal.
template <class S>
class block_dilation {
 public:
  static constexpr bool separable = true;
  using vector_type = Eigen::Matrix<S, Eigen::Dynamic, 1>;

  explicit block_dilation(vector_type d) : d_(std::move(d)) {}

  [[nodiscard]] auto pull(auto const& x) const { return x.cwiseQuotient(d_); }
  [[nodiscard]] auto push(auto const& z) const { return z.cwiseProduct(d_); }
  [[nodiscard]] auto pull_direction(auto const& v) const { return pull(v); }
  [[nodiscard]] auto push_adjoint(auto const& y) const { return push(y); }
  [[nodiscard]] S offset(auto const&) const { return S(0); }
  /// What it is on the block at p.
  [[nodiscard]] dilation<S> at(auto const& p) const {
    return dilation<S>(p.size() > 0 ? d_(p.component(0)) : S(1));
  }

 private:
  vector_type d_;
};

/// Throws bad_input unless d has a finite factor > 0 for each unknown, the same all over a block.
template <class S, class C>
void check_block_factors(Eigen::Matrix<S, Eigen::Dynamic, 1> const& d, C const& set) {
  check_size("d", index(d.size()), slant::dimension_of(set), "the dimension of the set,");
  slant::visit_blocks(set, [&](auto const& block, auto const& p) {
    for (index j = 0; j < p.size(); ++j) {
      S const& factor = d(p.component(j));
      if (!(factor > S(0) && is_finite(factor))) {
        throw bad_input("d(" + std::to_string(p.component(j)) + ")", show(factor),
                        "a finite number > 0");
      }
      if (!whole_space<std::remove_cvref_t<decltype(block)>> && factor != d(p.component(0))) {
        throw bad_input("d(" + std::to_string(p.component(j)) + ")", show(factor),
                        show(d(p.component(0))) + " as for the other unknowns of its block");
      }
    }
  });
}

}  // namespace detail

/// { D z : z ∈ set }, d one factor for each unknown. A set passed as an lvalue is referenced.
/// @throws bad_input unless d has the size of the set, with finite factors > 0 that are the same
/// all over a block (a block that is the whole space may have different ones).
template <class S, class C>
  requires set_part<std::remove_cvref_t<C>> && has_visit<std::remove_cvref_t<C>>
[[nodiscard]] auto block_scaled(Eigen::Matrix<S, Eigen::Dynamic, 1> d, C&& set) {
  using map = detail::block_dilation<S>;
  detail::check_block_factors(d, set);
  return image_product<kept_t<C>, map>(held<kept_t<C>>(std::forward<C>(set)), map(std::move(d)));
}

}  // namespace slant
