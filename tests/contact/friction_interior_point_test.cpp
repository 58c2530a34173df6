// SPDX-License-Identifier: MIT
#include <slant/contact/friction/friction_interior_point.hpp>

#include "contact/friction_scenes.hpp"
#include "support/allocation_guard.hpp"
#include "support/folders.hpp"

#include <slant/contact/friction/friction_gauss_seidel.hpp>
#include <slant/contact/friction/verify.hpp>
#include <slant/io/friction_folder.hpp>

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace friction_interior_point_test {

template <int N>
using blocks = slant::contact::friction_blocks<N, double>;
template <int N>
using method = slant::contact::friction_interior_point<N, double>;
using options = slant::contact::friction_interior_options<double>;
static_assert(slant::iterative_method<method<3>, Eigen::VectorXd>);

struct outcome {
  Eigen::VectorXd r, inside;
  slant::contact::friction_error<double> error;
  slant::status status;
  slant::index steps, factorizations, sparse, evaluations;
};

template <int N>
outcome run(test::friction_problem const& p, double tolerance, options const& o) {
  blocks<N> const b(p);
  method<N> const m(b, o);
  auto s = m.start(Eigen::VectorXd::Zero(b.size()));
  while (s.status == slant::status::running && s.iteration < 300 &&
         !s.best_error.at_most(tolerance)) {
    m.step(s);
  }
  return {b.force(s.best), b.force(s.x),     s.best_error, s.status,
          s.iteration,     s.factorizations, s.sparse,     s.evaluations};
}
outcome run(test::friction_problem const& p, double tolerance, options o = {}) {
  o.small = std::min(o.small, tolerance / 100);
  return p.dimension() == 2 ? run<2>(p, tolerance, o) : run<3>(p, tolerance, o);
}

TEST_CASE("interior point: every state of one contact, in any units") {
  auto cases = test::single_solution_cases();
  cases.push_back(test::redundant_case());
  for (auto const& c : cases) {
    CAPTURE(c.name);
    for (double const compliance : {1., 1e100, 1e-100}) {
      for (double const velocity : {1., 1e100, 1e-100}) {
        auto p = c.problem;
        p.W *= compliance;
        p.q *= velocity;
        auto const s = run(p, 1e-11);
        CHECK(s.error.at_most(1e-11));
        CHECK(s.steps <= 40);
        CHECK(s.evaluations == 1 + s.steps);
        Eigen::VectorXd const r = s.r * (compliance / velocity);
        if (!c.infinitely_many) CHECK((r - c.r[0]).norm() <= 1e-8 * (1 + r.norm()));
        // Never on the boundary: strictly positive, and within the cone.
        for (slant::index i = 0; i < p.contacts(); ++i) {
          CHECK(s.inside[i * p.dimension()] > 0);
          CHECK(s.inside.segment(i * p.dimension() + 1, p.dimension() - 1).stableNorm() <=
                p.mu[i] * s.inside[i * p.dimension()] * (1 + 1e-14));
        }
      }
    }
  }
  auto const three = run(test::three_solutions_case().problem, 1e-11);
  double nearest = 1;
  for (auto const& r : test::three_solutions_case().r) {
    nearest = std::min(nearest, (three.r - r).norm());
  }
  CHECK(nearest <= 1e-8);
}

TEST_CASE("interior point: contacts of simulations, by the independent check") {
  for (auto const* name : {"FC3D_Example1", "FrictionContact3D_RR_1c",
                           "GFC3D_Example00_badly_scaled", "GFC3D_TwoRods1", "Rover4396",
                           "Rover4609", "Rover11035", "Confeti-ex13-4contact-Fc3D-SBM"}) {
    CAPTURE(name);
    auto const p = slant::read_friction_problem(test::data("friction") / name);
    auto const s = run(p, 1e-8);
    CHECK(s.error.at_most(1e-8));
    auto const check = slant::contact::verify(p, s.r);
    CHECK(check.unit_free_map <= 1.01e-8);  // what its states measure; solve_friction looks further
    CHECK(check.unit_free_penetration <= 1.01e-8);
  }
}

TEST_CASE("interior point: the forces of Gauss–Seidel where they are unique") {
  for (double const mu : {0., 0.3, 3.}) {
    auto const p = test::random_friction(12, 3, mu, 5);
    blocks<3> const b(p);
    slant::contact::friction_gauss_seidel<3, double> const sweeping(b);
    auto g = sweeping.start(Eigen::VectorXd::Zero(b.size()));
    while (g.iteration < 1000 && !g.best_error.at_most(1e-13)) sweeping.step(g);
    auto const s = run(p, 1e-12);
    CHECK(s.error.at_most(1e-12));
    CHECK((s.r - b.force(g.best)).norm() <= 1e-9 * s.r.norm());
  }
}

TEST_CASE("interior point: contacts with and without friction, friction of any size") {
  auto p = test::random_friction(10, 3, 0.5, 11);
  for (slant::index i = 0; i < 10; i += 2) p.mu[i] = 0;
  auto const s = run(p, 1e-11);
  CHECK(s.error.at_most(1e-11));
  for (slant::index i = 0; i < 10; i += 2) CHECK(s.r.segment<2>(3 * i + 1).isZero(0));
  for (double const mu : {1e-200, 1e-9, 10., 1e4}) {
    CAPTURE(mu);
    auto const one = test::make_friction_problem(
        Eigen::Matrix3d::Identity(), Eigen::Vector3d(-1, 1, 0), Eigen::VectorXd::Constant(1, mu));
    auto const r = run(one, 1e-8);
    CHECK(r.error.at_most(1e-8));
    CHECK((r.r - Eigen::Vector3d(1, mu > 1 ? -1 : -mu, 0)).norm() <= 1e-7);
  }
}

TEST_CASE("interior point: a full matrix takes no memory after the first step, a sparse stays so") {
  auto const p = test::random_friction(12, 3, 0.4, 3);
  blocks<3> const b(p);
  method<3> const m(b);
  auto s = m.start(Eigen::VectorXd::Zero(b.size()));
  m.step(s);
  slant::testing::allocation_guard guard;
  for (int k = 0; k < 5; ++k) m.step(s);
  auto const allocations = guard.count();
  CHECK(allocations == 0);
  CHECK(s.iteration == 6);
  CHECK(s.factorizations == 6);
  CHECK(s.factored_rows == 6 * 36);
  CHECK(s.sparse == 0);
  auto const chain = run(test::chain_friction(60), 1e-10);
  CHECK(chain.error.at_most(1e-10));
  CHECK(chain.sparse == chain.factorizations);
  CHECK(chain.factorizations == chain.steps);
}

TEST_CASE("interior point: without a solution it ends, and rests") {
  using Eigen::Matrix3d, Eigen::Vector3d;
  for (auto const& p : {test::no_solution_case(2).problem, test::no_solution_case(3).problem,
                        test::make_friction_problem(Matrix3d::Zero(), Vector3d(-1, 0, 0),
                                                    Eigen::VectorXd::Constant(1, 0.5))}) {
    auto const s = run(p, 1e-8);
    CHECK((s.status == slant::status::stalled || s.status == slant::status::breakdown));
    CHECK(s.steps < 300);
    CHECK(s.r.allFinite());
    CHECK(!s.error.at_most(1e-8));
  }
  auto const p = test::no_solution_case(3).problem;
  blocks<3> const b(p);
  method<3> const m(b, {.patience = 5});
  auto s = m.start(Eigen::VectorXd::Zero(3));
  for (int k = 0; k < 300; ++k) m.step(s);
  auto const last = s.iteration;
  m.step(s);
  CHECK(s.iteration == last);
  CHECK(last < 300);
}

TEST_CASE("interior point: no contacts, bad options and starts") {
  auto const none = run<3>(test::friction_problem{}, 1e-8, {});
  CHECK(none.r.size() == 0);
  auto const p = test::chain_friction(2);
  blocks<3> const b(p);
  auto const bad = [&](options const& o, char const* name) {
    CHECK_THROWS_WITH_AS(method<3>(b, o), doctest::Contains(name), slant::bad_input);
  };
  bad({.small = 0}, "small");
  bad({.fraction = 1}, "fraction");
  bad({.balance = std::numeric_limits<double>::infinity()}, "balance");
  bad({.largest_aim = std::nan("")}, "largest_aim");
  bad({.proximal = -1}, "proximal");
  bad({.patience = 0}, "patience");
  CHECK_THROWS_AS(static_cast<void>(method<3>(b).start(Eigen::VectorXd::Zero(5))),
                  slant::bad_input);
}

}  // namespace friction_interior_point_test
