// SPDX-License-Identifier: MIT
//
// How a method is run, as README.md shows it; readme.cmake compares the two.
#include <slant/iteration/iterates.hpp>
#include <slant/iteration/observers.hpp>
#include <slant/iteration/solve.hpp>
#include <slant/methods/kprgp.hpp>
#include <slant/operators/diagonal.hpp>
#include <slant/sets/contact_sets.hpp>

#include <doctest/doctest.h>

#include <Eigen/Core>
#include <range/v3/view/take_while.hpp>

TEST_CASE("solve with options and an observer, and the range of iterates") {
  Eigen::VectorXd const d = Eigen::Vector4d(1, 2, 3, 4), b = Eigen::Vector4d(1, -1, 1, 4);
  Eigen::VectorXd const x0 = Eigen::VectorXd::Constant(4, 9);
  auto const A = slant::diagonal<slant::positive_definite>(d);
  auto const qp = slant::separable_qp{A, b, slant::half_lines(4)};
  Eigen::VectorXd x;

  slant::history norms{[](auto const& state) { return state.reduced_gradient_norm; }};
  auto const run = slant::solve(slant::kprgp{qp, {.step_length = 0.4}}, x0,
                                slant::reduced_gradient_below(1e-9) || slant::at_most(500), norms);

  auto const is_coarse = [](auto const& state) { return state.reduced_gradient_norm > 0.1; };
  for (auto const& state :
       slant::iterates(slant::kprgp{qp}, x0) | ranges::views::take_while(is_coarse)) {
    x = state.x;
  }

  CHECK(run.converged());
  CHECK(run.x().isApprox(Eigen::Vector4d(1, 0, 1.0 / 3, 1), 1e-8));
  CHECK(slant::index(norms.values().size()) == run.iterations() + 1);
  CHECK(x.minCoeff() >= 0);
}
