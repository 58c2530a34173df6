// SPDX-License-Identifier: MIT
//
// SSN of the lecture [K §3.3.2, Algorithm SSN, (46)–(54)]: Newton's method with full steps and
// BiCGSTAB on nonsymmetric systems, in the variant that is counted in [K Table 6], where u = K⁻¹(f
// − Bᵀλ) is eliminated. Then G of (46) is the natural residual of the dual problem,
//
//     λ − P(λ − ρ (A λ − b)),    A = B K⁻¹Bᵀ,
//
// and a product with A is what [K] counts: two for each step of BiCGSTAB, one for each Newton step.
#pragma once

#include <slant/newton/krylov_solvers.hpp>
#include <slant/newton/semismooth_newton.hpp>
#include <slant/slanting/projection.hpp>

namespace fem {

/// SSN for the dual problem of a contact scene. Inner iterations to the precision of IMSSN,
/// tol⁽ᵏ⁺¹⁾ = min(r_tol err⁽ᵏ⁾/err⁽⁰⁾, c_fact tol⁽ᵏ⁾). ρ in units of 1/A; [K Table 6]
/// has 1.9/σ_max. The problem, a contact::dual or a separable_qp, is referenced.
/// state.work.operator_applications are the products with A.
template <class Problem>
[[nodiscard]] auto make_lecture_ssn(Problem const& problem, double ρ, double r_tol = 0.1,
                                    double c_fact = 0.9) {
  return slant::semismooth_newton{
      slant::natural_residual(problem.a(), problem.b(), problem.set(), ρ), slant::bicgstab_solver{},
      slant::full_step{}, slant::adaptive_precision{.r_tol = r_tol, .c_fact = c_fact}};
}

/// It would be gone before the method looks at it.
template <class Problem>
auto make_lecture_ssn(Problem const&& problem, double ρ, double r_tol = 0.1,
                      double c_fact = 0.9) = delete;

}  // namespace fem
