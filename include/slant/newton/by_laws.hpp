// SPDX-License-Identifier: MIT
//
// The linear solver that the laws of F°(y) allow, chosen by the compiler, the first of
//
//     symmetrized_cg      G is symmetrizable: I − P° (I − ρA) with definite A
//     direct_solver       G offers its inverse
//     cg_solver           G is self-adjoint and positive definite
//     direct_solver       G is a matrix, sparse or dense
//     bicgstab_solver     whatever else
#pragma once

#include <slant/newton/direct_solver.hpp>
#include <slant/newton/direction.hpp>
#include <slant/newton/krylov_solvers.hpp>
#include <slant/newton/symmetrized_cg.hpp>

#include <type_traits>

namespace slant {

namespace detail {

template <class G, class V>
[[nodiscard]] consteval auto solver_by_laws() {
  if constexpr (symmetrizable<G>) {
    return std::type_identity<symmetrized_cg>{};
  } else if constexpr (has_inverse<G, V>) {
    return std::type_identity<direct_solver>{};
  } else if constexpr (spd_operator<G, V>) {
    return std::type_identity<cg_solver>{};
  } else if constexpr (solved_cheaply<G, V>) {
    return std::type_identity<direct_solver>{};
  } else {
    return std::type_identity<bicgstab_solver>{};
  }
}

}  // namespace detail

/// The default: stands for one of the solvers above, with its default options. What was chosen is
/// visible as a type, chosen_solver_t<by_laws, G, V>.
struct by_laws {
  template <class G, class V>
  using choice = typename decltype(detail::solver_by_laws<G, V>())::type;

  [[gnu::cold]] void validate() const {}
  template <class Solver>
  [[nodiscard]] explicit operator Solver() const {
    return {};
  }
};

}  // namespace slant
