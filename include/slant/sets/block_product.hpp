// SPDX-License-Identifier: MIT
//
// A product of blocks of fixed dimensions is itself a block: the half line and the disc of one node
// are a block of three components, of which a power can be made.
#pragma once

#include <slant/concepts/convex_set.hpp>
#include <slant/sets/blocks.hpp>
#include <slant/sets/detail/cartesian_base.hpp>
#include <slant/sets/detail/inequality_count.hpp>

#include <Eigen/Core>

#include <type_traits>

namespace slant {

/// Λ₁ × … × Λ_k of blocks: again a block, of static dimension. Made by `cartesian`.
template <class... Parts>
class block_product : public detail::cartesian_base<Parts...>,
                      public detail::inequality_count<Parts...> {
  using base = detail::cartesian_base<Parts...>;
  using first_type = typename base::template part_type<0>;
  static constexpr bool smooth = detail::all_smooth<Parts...>;

 public:
  static constexpr int dimension = (Parts::dimension + ...);
  static constexpr bool whole_space = (slant::whole_space<Parts> && ...);
  static constexpr bool oblique = (slant::oblique<Parts> || ...);
  using scalar = set_scalar_t<first_type>;
  using vector_type = Eigen::Matrix<scalar, dimension, 1>;
  using matrix_type = Eigen::Matrix<scalar, dimension, dimension>;

  using base::base;

  /// The product of other blocks of the same types: power(cartesian(…), blocks, blocks, …).
  [[nodiscard]] block_product with(Parts const&... parts) const { return block_product(parts...); }

  [[nodiscard]] static constexpr index size() { return dimension; }

  /// Nearest point of the set.
  template <class X>
  [[nodiscard]] auto project(X const& x) const {
    Eigen::Matrix<scalar_t<X>, dimension, 1> y;
    project(x, y);
    return y;
  }
  /// y = P(x); y may be x.
  template <class X, class Y>
  void project(X const& x, Y&& y) const {
    this->for_each_part(
        [&](auto const& part, auto const& p) { detail::project_part(part, p, x, y); });
  }

  /// x ∈ Λ, up to rounding.
  template <class X>
  [[nodiscard]] bool contains(X const& x) const {
    return this->all_parts([&](auto const& part, auto const& p) {
      return part.contains(detail::argument_of(part, p, x));
    });
  }

  /// The slanting operator of the projection at x: block diagonal.
  template <class X>
  [[nodiscard]] auto slant(X const& x) const
    requires base::all_slant
  {
    Eigen::Matrix<scalar_t<X>, dimension, dimension> g;
    g.setZero();
    this->for_each_part([&](auto const& part, auto const& p) {
      constexpr int n = std::remove_cvref_t<decltype(p)>::dimension;
      auto const first = p.component(0);
      g.template block<n, n>(first, first) = part.slant(p.value(x));
    });
    return g;
  }

  /// The inequalities of all parts, one after the other.
  template <class X>
  [[nodiscard]] auto inequality(X const& x) const
    requires smooth
  {
    Eigen::Matrix<scalar_t<X>, block_product::inequalities, 1> f;
    index row = 0;
    this->for_each_part([&](auto const& part, auto const& p) {
      constexpr int k = std::remove_cvref_t<decltype(part)>::inequalities;
      f.template segment<k>(row) = part.inequality(p.value(x));
      row += k;
    });
    return f;
  }
  /// Column i is the gradient of inequality i.
  template <class X>
  [[nodiscard]] auto inequality_gradient(X const& x) const
    requires smooth
  {
    Eigen::Matrix<scalar_t<X>, dimension, block_product::inequalities> g;
    g.setZero();
    index column = 0;
    this->for_each_part([&](auto const& part, auto const& p) {
      using block_type = std::remove_cvref_t<decltype(part)>;
      constexpr int k = block_type::inequalities;
      g.template block<block_type::dimension, k>(p.component(0), column) =
          part.inequality_gradient(p.value(x));
      column += k;
    });
    return g;
  }
  /// Σ ν_i ∇²f_i.
  template <class X, class M>
  [[nodiscard]] auto inequality_hessian(X const& x, M const& multipliers) const
    requires smooth
  {
    Eigen::Matrix<scalar_t<X>, dimension, dimension> h;
    h.setZero();
    index row = 0;
    this->for_each_part([&](auto const& part, auto const& p) {
      using block_type = std::remove_cvref_t<decltype(part)>;
      constexpr int n = block_type::dimension;
      constexpr int k = block_type::inequalities;
      auto const ν = multipliers.template segment<k>(row).eval();
      h.template block<n, n>(p.component(0), p.component(0)) =
          part.inequality_hessian(p.value(x), ν);
      row += k;
    });
    return h;
  }
};

}  // namespace slant
