// SPDX-License-Identifier: MIT
#include <slant/contact/friction/friction_gauss_seidel.hpp>

#include "contact/friction_scenes.hpp"
#include "support/allocation_guard.hpp"

#include <slant/contact/friction/verify.hpp>

#include <doctest/doctest.h>

#include <limits>

namespace friction_gauss_seidel_test {

using blocks = slant::contact::friction_blocks<3, double>;
using method = slant::contact::friction_gauss_seidel<3, double>;
static_assert(slant::iterative_method<method, Eigen::VectorXd>);

TEST_CASE("Gauss–Seidel: redundant contacts, counts, and no allocation in a step") {
  auto const p = test::repeated(test::random_friction(6, 3, 0.4, 21), 3);
  blocks const b(p);
  method m(b);
  auto s = m.start(Eigen::VectorXd::Zero(b.size()));
  slant::testing::allocation_guard guard;
  while (s.iteration < 200 && !s.best_error.at_most(1e-12)) m.step(s);
  auto const allocations = guard.count();
  CHECK(allocations == 0);
  CHECK(s.best_error.at_most(1e-12));
  CHECK(slant::contact::verify(p, b.force(s.best)).relative_natural_map <= 2e-12);
  CHECK(s.sweeps == 20 * s.iteration);
  CHECK(s.evaluations == 1 + 2 * s.iteration);
  CHECK(s.block_products <= s.sweeps * b.block_count());
}

TEST_CASE("Gauss–Seidel: at a solution it rests, without progress it says so") {
  auto const c = test::single_solution_cases().back();
  blocks const b(c.problem);
  method m(b, {.patience = 5});
  auto s = m.start(b.from_force(c.r[0]));
  CHECK(s.error.at_most(1e-14));
  for (int k = 0; k < 20; ++k) m.step(s);
  CHECK(s.status == slant::status::stalled);
  CHECK(s.best_error.at_most(1e-14));
  auto const last = s.iteration;
  m.step(s);
  CHECK(s.iteration == last);
}

TEST_CASE("Gauss–Seidel: a step of no more sweeps than it is given") {
  auto const p = test::random_friction(4, 3, 0.4, 2);
  blocks const b(p);
  method m(b);
  for (slant::index const most : {1, 10, 13, 20}) {
    auto s = m.start(Eigen::VectorXd::Zero(b.size()));
    m.step(s, most);
    CHECK(s.sweeps == most);
    CHECK(s.evaluations == (most <= 10 ? 2 : 3));
  }
}

TEST_CASE("Gauss–Seidel: all that changes is in the state") {
  auto const p = test::random_friction(6, 3, 0.4, 8);
  blocks const b(p);
  method const m(b);
  auto alone = m.start(Eigen::VectorXd::Zero(b.size())), other = alone;
  for (int k = 0; k < 3; ++k) m.step(alone);
  for (int k = 0; k < 3; ++k) m.step(other);  // another run by the same method
  CHECK(alone.x == other.x);
  CHECK(alone.block_products == other.block_products);
}

TEST_CASE("Gauss–Seidel: bad options and starts are named") {
  auto const p = test::chain_friction(2);
  blocks const b(p);
  CHECK_THROWS_WITH_AS(method(b, {.sweeps = 0}), doctest::Contains("sweeps"), slant::bad_input);
  CHECK_THROWS_WITH_AS(method(b, {.full_every = 0}), doctest::Contains("full_every"),
                       slant::bad_input);
  CHECK_THROWS_WITH_AS(method(b, {.growth = 0.5}), doctest::Contains("growth"), slant::bad_input);
  CHECK_THROWS_WITH_AS(method(b, {.shrink = 1}), doctest::Contains("shrink"), slant::bad_input);
  CHECK_THROWS_WITH_AS(method(b, {.slack = 0}), doctest::Contains("slack"), slant::bad_input);
  double const infinity = std::numeric_limits<double>::infinity();
  CHECK_THROWS_WITH_AS(method(b, {.growth = infinity}), doctest::Contains("growth"),
                       slant::bad_input);
  CHECK_THROWS_WITH_AS(method(b, {.slack = infinity}), doctest::Contains("slack"),
                       slant::bad_input);
  CHECK_THROWS_WITH_AS(method(b, {.patience = 0}), doctest::Contains("patience"), slant::bad_input);
  CHECK_THROWS_AS(static_cast<void>(method(b).start(Eigen::VectorXd::Zero(5))), slant::bad_input);
}

}  // namespace friction_gauss_seidel_test
