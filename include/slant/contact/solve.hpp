// SPDX-License-Identifier: MIT
//
// Contact with Tresca friction from matrices to displacements, to an accuracy in the energy norm:
//
//     min ½ uᵀK u − fᵀu + Σ gᵢ‖(T u)ᵢ‖   subject to   N u ≤ d,     ‖u − u*‖_K ≤ tolerance · ‖u*‖_K
//
//     condense    K factored with the contact unknowns late factorizations/static_condensation
//     scale       rows of B so that every contact is about equally stiff, by powers of two; not at
//                 all where they are already
//     start       conjugate gradients without the constraints       methods/unconstrained_start
//     solve       symmetric_newton on the dual problem, with the lumped preconditioner
//     certify     ‖u − u*‖_K from K and the data alone              contact/certificate
//     correct     where the certificate asks for more: b is replaced by the one whose gradient, as
//                 the method computes it, is the accurate one of the certificate; Newton's method
//                 goes on to a smaller reduced gradient (iterative refinement of the program)
//
// One certificate is all that a well-conditioned scene costs: one solve with K beyond that for u.
//
// Bodies that supports do not hold, so that K is singular: their free motions are computed and
// named (contact/free_motions), and where contact or friction holds them the same method solves a
// few problems with springs that give way (contact/detail/spring_supports), from where the load
// puts the bodies across their gaps. The error is then that in the seminorm ‖·‖_K, an estimate.
// Where nothing holds them the status is `unbounded`, with the motion along which the energy falls
// for ever.
#pragma once

#include <slant/compiled.hpp>
#include <slant/contact/detail/certified_run.hpp>
#include <slant/contact/detail/spring_supports.hpp>
#include <slant/contact/solve_options.hpp>

#include <Eigen/SparseCore>

#include <concepts>
#include <memory>
#include <type_traits>
#include <utility>

namespace slant::contact {

/// Solves with this friction law, which the data must have: no other one is compiled. Observers see
/// every state of symmetric_newton. Throws bad_input if K is not symmetric positive semidefinite,
/// for data that do not fit, or for options out of range.
template <class Friction, class S, class... Observers>
[[nodiscard]] solution<S> solve(Friction friction, Eigen::SparseMatrix<S> const& K,
                                data<S> const& c, solve_options<S> const& o = {},
                                Observers&&... observers) {
  using run = detail::certified_run<Friction, S>;
  o.validate();
  detail::validated(friction, c, K.rows());
  free_motions<S> motions;
  try {
    return run(friction, K, c, o).run(observers...);
  } catch (bad_input const& refusal) {
    motions = motions_behind(refusal, K, o.layout);
    if (motions.free.empty()) throw;
  }
  auto const with_springs = [&](auto const& held, auto const& scene, auto const& options) {
    return std::make_unique<detail::observed_run<run, S, std::remove_reference_t<Observers>...>>(
        friction, held, scene, options, observers...);
  };
  return detail::spring_supports<S>(K, c, o, std::move(motions), with_springs).run();
}

/// The same with the law that T stands for, one instance for all laws.
template <class S, class... Observers>
[[nodiscard]] solution<S> solve(Eigen::SparseMatrix<S> const& K, data<S> const& c,
                                solve_options<S> const& o = {}, Observers&&... observers) {
  c.validate();
  return solve(friction_of_data{c.tangents()}, K, c, o, observers...);
}

#if SLANT_USES_COMPILED
/// A named law: what is compiled is the instance for all of them.
template <class Friction>
  requires(!std::same_as<Friction, friction_of_data>)
[[nodiscard]] solution<double> solve(Friction friction, Eigen::SparseMatrix<double> const& K,
                                     data<double> const& c, solve_options<double> const& o = {}) {
  return solve(friction_of_data{detail::tangents_of(friction)}, K, c, o);
}

extern template solution<double> solve<friction_of_data, double>(friction_of_data,
                                                                 Eigen::SparseMatrix<double> const&,
                                                                 data<double> const&,
                                                                 solve_options<double> const&);
extern template solution<double> solve<double>(Eigen::SparseMatrix<double> const&,
                                               data<double> const&, solve_options<double> const&);
#endif

}  // namespace slant::contact
