// SPDX-License-Identifier: MIT
//
// The methods in the tables of the wire: SSNM of the thesis with its linear solvers and parameters,
// from zero only, and ours.
#pragma once

#include <fem/thesis_ssnm.hpp>
#include <slant/methods/kprgp.hpp>
#include <slant/methods/symmetric_newton.hpp>
#include <slant/newton/direct_solver.hpp>
#include <slant/newton/krylov_solvers.hpp>
#include <slant/newton/saddle_solvers.hpp>
#include <slant/newton/semismooth_newton.hpp>
#include <slant/slanting/projection.hpp>
#include <support/named_method.hpp>
#include <tuple>
#include <utility>

namespace wire_tables {

/// The rule of [T]: ‖x⁺ − x‖ ≤ 1e−6 (‖x⁺‖ + 1), and at most 1000 iterations, after which it gives
/// up; here also after twice the largest number of products that is printed for these meshes.
struct thesis_rule {
  [[nodiscard]] auto operator()(examples::run_limits const&) const {
    return slant::step_below(1e-6, 1.0) || slant::at_most(1000) ||
           slant::at_most_applications(26000);
  }
};

/// SSNM of [T] with one of its linear solvers.
template <class Solver>
[[nodiscard]] auto ssnm(char const* name, Solver solver,
                        slant::ssnm_options<double> const& options) {
  return examples::named_method{name,
                                [solver, options](auto const& wire) {
                                  return slant::ssnm{wire.qp(), solver, options};
                                },
                                thesis_rule{}, false};
}

/// Beside Tables 4.1 and 4.2: SSNM "as it is, without any adjustments"; its products are solves.
[[nodiscard]] inline auto direct_methods() {
  return std::tuple{ssnm("SSNM, ours", slant::saddle_direct{}, {.rho = 1})};
}

/// Beside Tables 4.5 and 4.8, in the order of their columns, and C.
[[nodiscard]] inline auto variant_methods() {
  return std::tuple{
      ssnm("A fixed, ours", slant::schur_bicgstab{}, {.rho = 1, .inner_tolerance = 1e-6}),
      ssnm("adaptive", slant::schur_bicgstab{}, fem::thesis_options(0.5, 0.01, 0.9)),
      ssnm("A 0.01", slant::schur_bicgstab{}, fem::thesis_options(1, 0.01, 0.9)),
      ssnm("B 0.01", slant::bicgstab_solver{}, fem::thesis_options(1, 0.01, 0.9)),
      ssnm("B 0.1", slant::bicgstab_solver{}, fem::thesis_options(1, 0.1, 0.9)),
      ssnm("C 0.01", slant::schur_cg{}, fem::thesis_options(1, 0.01, 0.9))};
}

/// ‖F(x)‖, for methods that solve F(x) = 0.
struct residual_rule {
  [[nodiscard]] auto operator()(examples::run_limits const& limits) const {
    return slant::residual_below(limits.tolerance) || slant::at_most(limits.max_iterations);
  }
};

/// Newton's method on the natural residual x − P_Λ(x − ρ (A x − b)) with a sparse direct solver.
/// ρ = 1/diag A, which is 2/σ; twice that is as good, ten times that takes up to 12 nested steps.
[[nodiscard]] inline auto direct_newton() {
  return examples::named_method{
      "SSN direct",
      [](auto const& wire) {
        auto const qp = wire.qp();
        auto A = qp.a();
        auto set = qp.set();
        return slant::semismooth_newton{
            slant::natural_residual(std::move(A), qp.b(), std::move(set), 2 / wire.sigma()),
            slant::sparse_direct_solver{}};
      },
      residual_rule{}};
}

/// Beside every table; each makes two columns: from zero, and by nested iteration.
[[nodiscard]] inline auto our_methods() {
  using examples::named_method;
  return std::tuple{
      named_method{"KPRGP",
                   [](auto const& wire) {
                     return slant::kprgp{wire.qp(), {.step_length = 1.9 / wire.sigma()}};
                   }},
      named_method{
          "Newton",
          [](auto const& wire) {
            return slant::symmetric_newton{wire.qp(), wire.preconditioner(), {.step_factor = 2}};
          }},
      direct_newton()};
}

}  // namespace wire_tables
