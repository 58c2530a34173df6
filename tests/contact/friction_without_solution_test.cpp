// SPDX-License-Identifier: MIT
//
// How solve_friction ends where it finds no solution: because there is none, or none in the range
// of numbers, or at its limits.
#include "contact/friction_scenes.hpp"

#include <slant/contact/friction/verify.hpp>
#include <slant/contact/solve_friction.hpp>

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <string>

namespace friction_without_solution_test {

using slant::contact::friction_method;
using slant::contact::solve_friction;
using slant::contact::verify;
using test::all_methods;

TEST_CASE("solve_friction: without a solution it ends with a status, for every method") {
  for (slant::index const dimension : {2, 3}) {
    auto const c = test::no_solution_case(dimension);
    for (auto const method : all_methods) {
      auto const s =
          solve_friction(c.problem, {.method = method, .sweeps = 5000, .newton_steps = 200});
      CHECK(!s.converged());
      CHECK((s.status == slant::status::iteration_limit || s.status == slant::status::stalled ||
             s.status == slant::status::breakdown));
      CHECK(s.r.allFinite());
      CHECK(s.work.newton_steps <= 200);
      CHECK(s.work.sweeps <= 5000);
      CHECK(s.error.worst() > 1e-8);
      CHECK(s.reason.find(to_string(method)) != std::string::npos);
      CHECK(s.reason.find("unit-free natural map ") != std::string::npos);
      CHECK(s.reason.find("largest at contact 0") != std::string::npos);
    }
  }
  auto nothing = test::chain_friction(1);
  nothing.W.setZero();  // no force prevents the penetration
  CHECK(!solve_friction(nothing, {.sweeps = 1000, .newton_steps = 100}).converged());
}

TEST_CASE("solve_friction: forces without bound are no solution, and the search for them ends") {
  using Eigen::Matrix3d, Eigen::Vector3d, Eigen::Vector4d, Eigen::VectorXd;
  VectorXd const one = VectorXd::Constant(1, 0.5), two = VectorXd::Constant(2, 0.5);
  Matrix3d const flat = Vector3d(0, 1, 1).asDiagonal();
  Eigen::Matrix4d wedge = Eigen::Matrix4d::Identity();
  wedge(0, 2) = wedge(2, 0) = -1;
  for (auto const& p : {test::make_friction_problem(Matrix3d::Zero(), Vector3d(-1, 0, 0), one),
                        test::make_friction_problem(flat, Vector3d(-1, 1, 0), one),
                        test::make_friction_problem(wedge, Vector4d(-1, 0, -1, 0), two),
                        test::make_friction_problem(wedge, Vector4d(-1, 0, 1 - 1e-6, 0), two)}) {
    for (auto const method : all_methods) {
      for (double const start : {0., 1e17}) {
        VectorXd r = VectorXd::Zero(p.q.size());
        for (slant::index i = 0; i < p.contacts(); ++i) r[i * p.dimension()] = start;
        auto const s = solve_friction(p, {.method = method, .sweeps = 20000}, r);
        CHECK(!s.converged());
        CHECK(s.status != slant::status::running);
        CHECK(s.r.allFinite());
      }
    }
    auto const s = solve_friction(p);
    CHECK(s.status == slant::status::stalled);  // no limit was reached
    CHECK(s.work.sweeps < 300000);
    CHECK(s.work.newton_steps < 3000);
  }
}

TEST_CASE("solve_friction: friction without bound, and hardly any") {
  for (double const mu : {1e9, 1e-200}) {
    auto const p = test::make_friction_problem(
        Eigen::Matrix3d::Identity(), Eigen::Vector3d(-1, 1, 0), Eigen::VectorXd::Constant(1, mu));
    for (auto const method : all_methods) {
      // From inside of a cone that is nearly a half space it is too far to a force.
      if (mu > 1 && method == friction_method::interior_point) continue;
      auto const s = solve_friction(p, {.method = method});
      CHECK(s.converged());
      CHECK((s.r - Eigen::Vector3d(1, mu > 1 ? -1 : 0, 0)).norm() <= 1e-8);
    }
  }
  auto rough = test::random_friction(10, 3, 1e9, 3);  // all that are closed stick
  auto const s = solve_friction(rough);
  CHECK(s.converged());
  CHECK(verify(rough, s.r).slip == 0);
  for (slant::index i = 0; i < 10; ++i) {
    CHECK(s.u[3 * i] >= -1e-8 * rough.q.norm());
    if (s.r[3 * i] > 1e-6) CHECK(s.u.segment<3>(3 * i).norm() <= 1e-8 * rough.q.norm());
  }
}

TEST_CASE("solve_friction: results outside of the range of numbers are a breakdown") {
  for (double const sign : {1., -1.}) {
    auto const p = test::make_friction_problem(
        std::pow(10., -200 * sign) * Eigen::Matrix3d::Identity(),
        -std::pow(10., 200 * sign) * Eigen::Vector3d::UnitX(), Eigen::VectorXd::Constant(1, 0.5));
    auto const s = solve_friction(p);
    CHECK(s.status == slant::status::breakdown);
    CHECK(s.reason.find("range of numbers") != std::string::npos);
  }
}

TEST_CASE("solve_friction: no method does more than its limits") {
  auto const p = test::no_solution_case(3).problem;
  for (auto const method : all_methods) {
    for (slant::index const most : {0, 1, 7, 25, 101}) {
      auto const s = solve_friction(p, {.method = method, .sweeps = most, .newton_steps = most});
      CHECK(s.work.sweeps <= most);
      CHECK(s.work.newton_steps <= most);
      CHECK(!s.converged());
    }
  }
  auto const large = std::numeric_limits<slant::index>::max();
  auto const s = solve_friction(p, {.first_sweeps = large,
                                    .further_sweeps = large,
                                    .sweeps = 1000,
                                    .newton_steps = 100,
                                    .attempt = large});
  CHECK(s.work.sweeps <= 1000);
  CHECK(s.work.newton_steps <= 100);
}

}  // namespace friction_without_solution_test
