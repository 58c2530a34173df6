// SPDX-License-Identifier: MIT
#include "example_one.hpp"

#include <slant/iteration/solve.hpp>
#include <slant/iteration/stopping.hpp>
#include <slant/methods/interior_point.hpp>
#include <slant/operators/counted.hpp>

#include <doctest/doctest.h>

#include "support/allocation_guard.hpp"

namespace interior_point_test {

TEST_CASE("Example 1: the solution, products counted, every iterate in the interior") {
  test::example_one<double> const p;
  auto const A = slant::counted(p.a());
  auto const set = p.set();
  slant::separable_qp const qp{A, p.b, set};
  slant::interior_point const method{qp};
  auto s = method.start(p.zero());
  // The length of the data. A knows its diagonal, and the middle of all discs is 0.
  CHECK(s.work.setup_applications == 1);
  CHECK(A.applications() == 1);
  while (s.status == slant::status::running && s.reduced_gradient_norm > 1e-10 * s.gradient_scale) {
    method.step(s);
    CHECK(A.applications() == 1 + s.work.operator_applications);
    CHECK(s.work.operator_applications == s.work.inner_iterations);  // none besides those of CG
    for (Eigen::Index i = 0; i < 6; ++i) {
      CHECK(s.x(i) * s.x(i) + s.x(i + 6) * s.x(i + 6) < p.g(i) * p.g(i));
    }
    CHECK(s.multipliers.minCoeff() > 0);
    CHECK(s.slacks.minCoeff() > 0);
    REQUIRE(s.iteration < 40);
  }
  CHECK((s.unit * s.r - (p.A * s.x - p.b)).norm() <= 1e-13 * p.b.norm());
  CHECK(method.refresh(s));
  CHECK_FALSE(method.refresh(s));
  test::example_one_solution<double> const exact;
  CHECK((s.x - exact.x).norm() <= 1e-9 * exact.x.norm());
  CHECK(slant::solve(method, p.zero(), slant::step_below(1e-8) || slant::at_most(60)).converged());
}

TEST_CASE("steps do not allocate") {
  test::example_one<double> const p;
  slant::separable_qp const qp{p.a(), p.b, p.set()};
  slant::interior_point const method{qp};
  auto s = method.start(p.zero());
  slant::testing::allocation_guard guard;
  for (int k = 0; k < 8 && s.status == slant::status::running; ++k) method.step(s);
  auto const allocations = guard.count();
  CHECK(allocations == 0);
}

}  // namespace interior_point_test
