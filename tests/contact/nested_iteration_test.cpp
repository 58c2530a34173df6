// SPDX-License-Identifier: MIT
//
// Nested iteration on a contact problem: prolongation of forces, levels made as they are needed.
#include <slant/iteration/solve.hpp>
#include <slant/methods/kprgp.hpp>

#include <fem/two_plates.hpp>
#include <support/problem_ladder.hpp>
#include <support/testing.hpp>
#include "scenes.hpp"

namespace nested_iteration_test {

TEST_CASE("two plates: the finest solution is the same and costs less") {
  auto problems = examples::make_ladder<2>(fem::make_two_plates);
  examples::named_method const method{
      "KPRGP", [](auto const& problem) {
        return slant::kprgp{problem.qp(), {.step_length = 1.9 / problem.sigma()}};
      }};
  examples::run_limits const limits{.tolerance = 1e-10};
  auto const direct = examples::run_from_zero(method, problems.at(8), limits);
  auto const ladder = problems.ladder(8);
  REQUIRE(ladder.size() == 3);
  CHECK(ladder[0] == &problems.at(2));
  CHECK(ladder[2] == &problems.at(8));
  auto const nested = examples::run_nested(method, ladder, limits);
  CHECK(direct.converged());
  CHECK(nested.converged());
  REQUIRE(nested.levels.size() == 3);
  CHECK((nested.x() - direct.x()).norm() <= 1e-6 * direct.x().norm());
  CHECK(nested.finest().state.work.operator_applications < direct.state.work.operator_applications);

  // The start on the finest mesh is already near the solution, in the energy norm.
  auto const P = fem::contact_prolongation(ladder[1]->scene(), ladder[2]->scene());
  VectorXd const error = P * nested.levels[1].x() - direct.x();
  auto const a = problems.at(8).qp().a();
  CHECK(test::energy_norm(a, error) <= 1e-2 * test::energy_norm(a, direct.x()));
}

}  // namespace nested_iteration_test
