// SPDX-License-Identifier: MIT
#include <slant/iteration/solve.hpp>
#include <slant/methods/interior_point.hpp>
#include <slant/operators/diagonal.hpp>
#include <slant/operators/inverse.hpp>
#include <slant/operators/matrix.hpp>

#include <slant/factorizations/dense_ldlt.hpp>
#include <slant/sets/cartesian.hpp>
#include <slant/sets/contact_sets.hpp>

#include <doctest/doctest.h>
#include <cmath>

namespace interior_point_preconditioner_test {

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Half lines and free components; A is a stiff string, whose diagonal says little.
struct problem {
  static constexpr Eigen::Index n = 60;
  MatrixXd M = MatrixXd::Zero(n, n);
  VectorXd b = VectorXd::LinSpaced(n, -0.1, 0.3);

  problem() {
    M.diagonal().setConstant(2);
    M.diagonal(1).setConstant(-1);
    M.diagonal(-1).setConstant(-1);
  }
  [[nodiscard]] auto a() const {
    return slant::matrix<slant::self_adjoint, slant::positive_definite>(M);
  }
  [[nodiscard]] auto set() const {
    return slant::cartesian(slant::half_lines(n / 2), slant::free_components(n / 2));
  }
  [[nodiscard]] auto qp() const { return slant::separable_qp{a(), b, set()}; }
};

auto const accurate = slant::reduced_gradient_below(1e-9) || slant::at_most(60);

TEST_CASE("M = diag(A)⁻¹ is what the method does without M") {
  problem const p;
  VectorXd const zero = VectorXd::Zero(p.n);
  VectorXd const inverse_diagonal = VectorXd::Constant(p.n, 0.5);
  auto const jacobi =
      slant::diagonal<slant::self_adjoint, slant::positive_definite>(inverse_diagonal);
  auto const plain = slant::solve(slant::interior_point{p.qp()}, zero, accurate);
  auto const same = slant::solve(slant::interior_point{p.qp(), jacobi}, zero, accurate);
  REQUIRE(plain.converged());
  REQUIRE(same.converged());
  CHECK(same.iterations() == plain.iterations());
  CHECK(same.state.work.operator_applications == plain.state.work.operator_applications);
  CHECK((same.x() - plain.x()).norm() <= 1e-9 * plain.x().norm());
}

TEST_CASE("M = A⁻¹: without constraints one product solves, with them some do what took many") {
  problem const p;
  VectorXd const zero = VectorXd::Zero(p.n);
  auto const inverse = slant::inverse(slant::dense_ldlt(p.M));
  slant::separable_qp const free{p.a(), p.b, slant::free_components(p.n)};
  auto const at_once = slant::solve(slant::interior_point{free, inverse}, zero, accurate);
  CHECK(at_once.converged());
  CHECK(at_once.state.work.inner_iterations <= 2);
  CHECK((p.M * at_once.x() - p.b).norm() <= 1e-9 * p.b.norm());

  auto const plain = slant::solve(slant::interior_point{p.qp()}, zero, accurate);
  auto const fast = slant::solve(slant::interior_point{p.qp(), inverse}, zero, accurate);
  REQUIRE(plain.converged());
  REQUIRE(fast.converged());
  CHECK(3 * fast.state.work.operator_applications < plain.state.work.operator_applications);
  CHECK((fast.x() - plain.x()).norm() <= 1e-7 * plain.x().norm());
}

TEST_CASE("a preconditioner of another size is named") {
  problem const p;
  auto const small = slant::identity(3);
  CHECK_THROWS_WITH_AS(slant::interior_point(p.qp(), small),
                       "rows of the preconditioner: got 3, expected size 60", slant::bad_input);
}

/// A string, soft where it is free and held tight in a narrow slit where it is pushed: the forces
/// of the start, taken from the mean of all gradients, are too small to keep a Newton step inside.
TEST_CASE("forces that are too small at the start are raised") {
  Eigen::Index const n = 200, bounded = 20;
  MatrixXd M = MatrixXd::Zero(n, n);
  M.diagonal().setConstant(2.0001);
  M.diagonal(1).setConstant(-1);
  M.diagonal(-1).setConstant(-1);
  M.bottomRightCorner(n - bounded, n - bounded) *= 1e-3;
  M(bounded - 1, bounded) = M(bounded, bounded - 1) = -1e-3;
  VectorXd b = VectorXd::Constant(n, 0.01);
  for (Eigen::Index i = 0; i < bounded; ++i) b(i) = std::pow(10, double(i) / double(bounded));
  auto const set = slant::cartesian(slant::intervals(VectorXd::Constant(bounded, 1e-4).eval()),
                                    slant::free_components(n - bounded));
  slant::separable_qp const qp{slant::matrix<slant::self_adjoint, slant::positive_definite>(M), b,
                               set};
  VectorXd const zero = VectorXd::Zero(n);
  auto const solution = slant::solve(slant::interior_point{qp}, zero, accurate);
  REQUIRE(solution.converged());
  // Once the forces have their size, both take the same steps, of 100 and more products each.
  auto const on_the_way = slant::reduced_gradient_below(1e-4) || slant::at_most(60);
  auto const raised = slant::solve(slant::interior_point{qp}, zero, on_the_way);
  auto const left = slant::solve(slant::interior_point{qp, {.raises = 0}}, zero, on_the_way);
  REQUIRE(raised.converged());
  REQUIRE(left.converged());
  CHECK(raised.state.raises == 1);
  CHECK(left.state.raises == 0);
  CHECK(raised.iterations() < left.iterations());
  CHECK(raised.state.work.operator_applications < left.state.work.operator_applications);
  // All are pushed to the end of their slit.
  for (Eigen::Index i = 0; i < bounded; ++i) CHECK(solution.x()(i) == doctest::Approx(1e-4));
}

}  // namespace interior_point_preconditioner_test
