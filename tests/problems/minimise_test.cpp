// SPDX-License-Identifier: MIT
#include <slant/methods/solve_program.hpp>
#include <slant/operators/diagonal.hpp>
#include <slant/problems/minimise.hpp>
#include <slant/sets/contact_sets.hpp>

#include <doctest/doctest.h>

#include <sstream>
#include <type_traits>

namespace minimise_test {

using Eigen::VectorXd;

TEST_CASE("a program as on paper is separable_qp, with parts kept by the same rule") {
  VectorXd const d{{1.0, 2.0, 4.0}}, b{{-1.0, 4.0, 8.0}};
  auto const A = slant::diagonal<slant::positive_definite>(d);
  auto const set = slant::half_lines(3);
  auto const program = slant::minimise(slant::quadratic(A, b)).over(set);
  using twin = decltype(slant::separable_qp{A, b, set});
  static_assert(std::is_same_v<decltype(program), twin const>);
  CHECK(&program.a() == &A);
  CHECK(&program.b() == &b);
  CHECK(&program.set() == &set);
  auto const owner =
      slant::minimise(slant::quadratic(slant::identity(3), VectorXd(b))).over(slant::half_lines(3));
  CHECK(owner.b() == b);
  CHECK_THROWS_WITH_AS(
      static_cast<void>(slant::minimise(slant::quadratic(A, b)).over(slant::half_lines(2))),
      "dimension of the set: got 2, expected the size of b, 3", slant::bad_input);
}

TEST_CASE("a solved program prints what was done") {
  VectorXd const d{{1.0, 2.0, 4.0}}, b{{-1.0, 4.0, 8.0}};
  auto const run = slant::solve(
      slant::minimise(slant::quadratic(slant::diagonal<slant::positive_definite>(d), b))
          .over(slant::half_lines(3)),
      1e-8);
  CHECK((run.x() - VectorXd{{0.0, 2.0, 2.0}}).norm() <= 1e-14);
  std::ostringstream out;
  out << run;
  CHECK(out.str().starts_with("converged: relative energy error "));
  CHECK(out.str().find("\n  unknowns               3\n") != std::string::npos);
  CHECK(out.str().find(std::to_string(run.steps) + " of symmetric_newton\n") != std::string::npos);
  CHECK(out.str().find("applications of A      " +
                       std::to_string(run.work.operator_applications)) != std::string::npos);
}

}  // namespace minimise_test
