// SPDX-License-Identifier: MIT
//
// The equations of one contact for Newton's method, F = 0, and their generalised derivative
// dF = A dr + B du by the chain rule, composed of parts of the library:
//
//     natural map    F = r − P_K(r − ρ û),  û de Saxcé's map of u     A = I − G,   B = ρ G û°
//     Alart–Curnier  F = r − P(r − ρ u),    P of alart_curnier.hpp    A = I − P°,  B = ρ P°
//
// An open contact has G = 0 or P° = 0: F = r, A = I, B = 0.
#pragma once

#include <slant/sets/detail/entries.hpp>
#include <slant/sets/second_order_cone.hpp>
#include <slant/slanting/alart_curnier.hpp>
#include <slant/slanting/de_saxce.hpp>

#include <Eigen/Core>

namespace slant::contact {

/// Which equations Newton's method solves.
enum class friction_equations : unsigned char { natural_map, alart_curnier };

namespace detail {

/// F of one contact, and A and B where they were asked for.
template <int N, class S>
struct friction_map {
  using part_type = Eigen::Matrix<S, N, 1>;
  using block_type = Eigen::Matrix<S, N, N>;

  part_type F;
  block_type A, B;
  bool open = false;  ///< A = I, B = 0

  /// F at (r, u), with A, B and open if `derivative`.
  void look(friction_equations which, S const& μ, S const& ρ, part_type const& r,
            part_type const& u, bool derivative) {
    if (which == friction_equations::natural_map) {
      de_saxce_block<N, S> const velocity(μ);
      compose(second_order_cone<N, S>(μ), ρ, r, velocity.value(u), derivative);
      if (derivative) B = slant::detail::product_of(B, velocity.slant(u));
    } else {
      compose(as_set{alart_curnier_block<N, S>(μ)}, ρ, r, u, derivative);
    }
  }

 private:
  struct as_set {
    alart_curnier_block<N, S> block;
    [[nodiscard]] part_type project(part_type const& z) const { return block.value(z); }
    [[nodiscard]] block_type slant(part_type const& z) const { return block.slant(z); }
  };

  template <class Set>
  void compose(Set const& set, S const& ρ, part_type const& r, part_type const& v,
               bool derivative) {
    using slant::detail::combination;
    part_type const z = combination(S(1), r, S(-ρ), v);
    F = combination(S(1), r, S(-1), set.project(z));
    if (!derivative) return;
    B = set.slant(z);
    open = slant::detail::all_zero(B);
    A = slant::detail::from_entries<block_type>(
        [&](int i, int j) -> S { return S(i == j ? 1 : 0) - B(i, j); });
    for (int k = 0; k < N * N; ++k) B.data()[k] *= ρ;
  }
};

}  // namespace detail
}  // namespace slant::contact
