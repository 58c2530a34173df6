// SPDX-License-Identifier: MIT
//
// Columns that the tables of bricks and of two bodies share; β is that of a step length β/σ_max.
#pragma once

#include <slant/methods/interior_point.hpp>
#include <slant/methods/kprgp.hpp>
#include <slant/methods/mssn.hpp>
#include <slant/methods/symmetric_newton.hpp>
#include <support/named_method.hpp>

namespace examples {

[[nodiscard]] inline auto kprgp(char const* name, double β) {
  return named_method{name, [β](auto const& problem) {
                        return slant::kprgp{problem.qp(), {.step_length = β / problem.sigma()}};
                      }};
}
[[nodiscard]] inline auto as_s(char const* name, double β) {
  return named_method{name,
                      [β](auto const& problem) {
                        return slant::as_s(problem.qp(), {.step_length = β / problem.sigma()});
                      },
                      reduced_gradient_rule{}, false};
}
[[nodiscard]] inline auto imssn(char const* name, double β) {
  return named_method{name,
                      [β](auto const& problem) {
                        return slant::imssn{problem.qp(), {.step_length = β / problem.sigma()}};
                      },
                      reduced_gradient_rule{}, false};
}
[[nodiscard]] inline auto gimssn(char const* name, double β) {
  return named_method{name,
                      [β](auto const& problem) {
                        return slant::gimssn{problem.qp(), {.step_length = β / problem.sigma()}};
                      },
                      reduced_gradient_rule{}, false};
}
/// Ours, without a preconditioner.
[[nodiscard]] inline auto newton(char const* name) {
  return named_method{name,
                      [](auto const& problem) { return slant::symmetric_newton{problem.qp()}; }};
}
/// Ours, with the lumped preconditioner.
[[nodiscard]] inline auto preconditioned_newton(char const* name) {
  return named_method{name, [](auto const& problem) {
                        return slant::symmetric_newton{problem.qp(), problem.preconditioner()};
                      }};
}
/// Path following, which begins in the middle of the set and so makes nothing of a good start.
[[nodiscard]] inline auto interior_point(char const* name) {
  return named_method{name, [](auto const& problem) { return slant::interior_point{problem.qp()}; },
                      reduced_gradient_rule{}, true, false};
}
/// The same with the lumped preconditioner.
[[nodiscard]] inline auto preconditioned_interior_point(char const* name) {
  return named_method{name,
                      [](auto const& problem) {
                        return slant::interior_point{problem.qp(), problem.preconditioner()};
                      },
                      reduced_gradient_rule{}, true, false};
}
/// Ours, with the Dirichlet preconditioner: it makes accurate inner solves cheap, and they save
/// steps.
[[nodiscard]] inline auto dirichlet_newton(char const* name) {
  return named_method{name, [](auto const& problem) {
                        slant::symmetric_newton_options<double> o;
                        o.forcing.η_max = o.forcing.η_first = 0.1;
                        return slant::symmetric_newton{problem.qp(), problem.dirichlet(), o};
                      }};
}

}  // namespace examples
