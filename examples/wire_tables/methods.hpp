// SPDX-License-Identifier: MIT
//
// The methods in the tables of the wire: SSNM of the thesis with its linear solvers and parameters,
// from zero only, and ours.
#pragma once

#include <fem/thesis_ssnm.hpp>
#include <slant/methods/kprgp.hpp>
#include <slant/methods/symmetric_newton.hpp>
#include <slant/newton/bicgstab_solver.hpp>
#include <slant/newton/saddle_direct.hpp>
#include <slant/newton/schur_bicgstab.hpp>
#include <slant/newton/schur_cg.hpp>
#include <support/named_method.hpp>
#include <tuple>

namespace wire_tables {

/// The rule of [T]: ‖x⁺ − x‖ < 1e-6 (‖x⁺‖ + 1), × after 1000 steps.
struct thesis_rule {
  [[nodiscard]] auto operator()(examples::run_limits const&) const {
    return slant::step_below(1e-6, 1.0) || slant::at_most(1000);
  }
};

/// ρ = 1, r_tol = 0.01, c_fact = 0.9.
template <class Solver>
[[nodiscard]] auto thesis(char const* name, Solver solver) {
  return examples::named_method{
      name,
      [solver](auto const& wire) {
        return slant::ssnm{wire.qp(), solver, fem::thesis_options(1, 0.01, 0.9)};
      },
      thesis_rule{}, false};
}

/// Each of ours makes two columns: from zero, and by nested iteration.
[[nodiscard]] inline auto methods() {
  using examples::named_method;
  return std::tuple{
      thesis("SSNM", slant::saddle_direct{}),
      thesis("A", slant::schur_bicgstab{}),
      thesis("B", slant::bicgstab_solver{}),
      thesis("C", slant::schur_cg{}),
      named_method{"KPRGP",
                   [](auto const& wire) {
                     return slant::kprgp{wire.qp(), {.step_length = 1.9 / wire.sigma()}};
                   }},
      named_method{
          "Newton", [](auto const& wire) {
            return slant::symmetric_newton{wire.qp(), wire.preconditioner(), {.step_factor = 2}};
          }}};
}

}  // namespace wire_tables
