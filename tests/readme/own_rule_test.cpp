// SPDX-License-Identifier: MIT
//
// The stopping rule of a client's own that README.md shows; readme.cmake compares the two.
#include <slant/iteration/solve.hpp>
#include <slant/krylov/cg.hpp>
#include <slant/operators/diagonal.hpp>

#include <doctest/doctest.h>

#include <Eigen/Core>
#include <chrono>
#include <string>

struct at_most_seconds : slant::rule {  // the base is for || and &&
  std::chrono::steady_clock::time_point end;
  explicit at_most_seconds(int s)
      : end(std::chrono::steady_clock::now() + std::chrono::seconds(s)) {}
  slant::status operator()(auto const& /*state*/) const {
    bool const over = std::chrono::steady_clock::now() >= end;
    return over ? slant::status::interrupted : slant::status::running;
  }
  std::string reason(auto const& /*state*/) const { return "out of time"; }
};

TEST_CASE("it stops at once or late enough") {
  Eigen::VectorXd const d = Eigen::Vector3d(1, 2, 4), b = Eigen::Vector3d(1, 1, 1);
  Eigen::VectorXd const x0 = Eigen::VectorXd::Zero(3);
  auto const A = slant::diagonal<slant::positive_definite>(d);
  auto const solve_within = [&](int seconds) {
    return slant::solve(slant::cg{A, b}, x0,
                        slant::residual_below(1e-12) || at_most_seconds(seconds));
  };
  CHECK(solve_within(3600).converged());
  auto const run = solve_within(0);
  CHECK(run.status == slant::status::interrupted);
  CHECK(run.reason == "out of time");
  CHECK(run.iterations() == 0);
}
