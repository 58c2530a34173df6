// SPDX-License-Identifier: MIT
//
// The methods that can be asked for by name. The first one is recommended, and taken unless another
// is asked for.
#pragma once

#include <array>
#include <slant/methods/kprgp.hpp>
#include <slant/methods/mssn.hpp>
#include <slant/newton/saddle_solvers.hpp>
#include <slant/newton/semismooth_newton.hpp>
#include <string_view>

#include "any_dual.hpp"
#include "newton_methods.hpp"
#include "outcome.hpp"

namespace from_files {

/// A method; run is none for the recommended one: contact::solve takes the problem itself.
struct named_method {
  std::string_view name;
  std::string_view sentence;
  outcome (*run)(problem const&, any_dual const&, Eigen::VectorXd const& λ0, settings const&);
};

/// A method that needs nothing but the dual problem; make(qp) makes it.
template <class Make>
[[nodiscard]] constexpr named_method on_dual(char const* name, char const* sentence, Make) {
  return {name, sentence,
          [](problem const&, any_dual const& dual, Eigen::VectorXd const& λ0, settings const& s) {
            return run_on_dual(Make{}(dual.qp()), λ0, s);
          }};
}

/// SSNM with one of its linear solvers.
template <class Solver>
[[nodiscard]] constexpr named_method thesis(char const* name, char const* sentence, Solver) {
  return {name, sentence,
          [](problem const&, any_dual const& dual, Eigen::VectorXd const& λ0, settings const& s) {
            return run_ssnm(dual, λ0, s, Solver{});
          }};
}

inline constexpr std::array methods{
    named_method{"symmetric_newton",
                 "Semismooth Newton with the curvature of the discs, preconditioned CG inside.",
                 nullptr},
    named_method{"interior_point", "Path following inside the set, preconditioned CG inside.",
                 run_interior_point},
    on_dual("kprgp", "Active sets: CG on a face, gradient projections to change it.",
            [](auto const& qp) { return slant::kprgp{qp}; }),
    on_dual("as", "kprgp by the name that it has on half lines and intervals.",
            [](auto const& qp) { return slant::kprgp{qp}; }),
    on_dual("as_s", "kprgp with the active sets of semismooth Newton.",
            [](auto const& qp) { return slant::as_s(qp); }),
    on_dual("qpq", "Active sets by the discontinuous test that came before kprgp.",
            [](auto const& qp) { return slant::qpq{qp}; }),
    on_dual("qpc", "Polyak's active sets: CG to the minimum of a face before it is changed.",
            [](auto const& qp) { return slant::qpc{qp}; }),
    on_dual("gimssn", "Semismooth Newton without curvature, feasible and monotone.",
            [](auto const& qp) { return slant::gimssn{qp}; }),
    on_dual("imssn", "The same, neither feasible nor monotone.",
            [](auto const& qp) { return slant::imssn{qp}; }),
    on_dual("mssn", "The same with inner systems solved accurately.",
            [](auto const& qp) { return slant::mssn{qp}; }),
    named_method{
        "semismooth_newton",
        "Newton for the natural residual as a composition; inner solver by its laws.",
        [](problem const&, any_dual const& dual, Eigen::VectorXd const& λ0, settings const& s) {
          return run_natural_residual(dual, λ0, s, slant::by_laws{}, slant::halving_line_search{},
                                      slant::eisenstat_walker{});
        }},
    named_method{
        "ssn", "The same with BiCGSTAB and full steps, as in the lecture.",
        [](problem const&, any_dual const& dual, Eigen::VectorXd const& λ0, settings const& s) {
          return run_natural_residual(dual, λ0, s, slant::bicgstab_solver{}, slant::full_step{},
                                      slant::adaptive_precision{});
        }},
    named_method{"ssn_primal_dual",
                 "Newton for displacements and multipliers together, without a factor of K inside.",
                 run_primal_dual},
    thesis("ssnm_a", "Newton for multipliers and their multipliers: Schur complement, BiCGSTAB.",
           slant::schur_bicgstab{}),
    thesis("ssnm_b", "The same: BiCGSTAB on the whole system.", slant::bicgstab_solver{}),
    thesis("ssnm_c", "The same: Schur complement made symmetric, CG.", slant::schur_cg{}),
};

}  // namespace from_files
