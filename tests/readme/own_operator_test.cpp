// SPDX-License-Identifier: MIT
//
// The operator of a client's own that README.md shows; readme.cmake compares the two.
#include <slant/iteration/solve.hpp>
#include <slant/krylov/cg.hpp>

#include <slant/testing/laws.hpp>

#include <doctest/doctest.h>

#include <Eigen/Core>

struct laplacian {  // tridiag(−1, 2, −1), no matrix anywhere
  static constexpr auto laws = slant::laws<slant::self_adjoint, slant::positive_definite>;
  Eigen::Index n;
  Eigen::Index rows() const { return n; }
  Eigen::Index cols() const { return n; }
  void apply(auto const& x, auto& y) const {
    y = 2 * x;
    y.topRows(n - 1) -= x.bottomRows(n - 1);
    y.bottomRows(n - 1) -= x.topRows(n - 1);
  }
};
static_assert(slant::spd_operator<laplacian, Eigen::VectorXd>);

TEST_CASE("my operator keeps its word") {
  slant::testing::check_operator_laws(laplacian{100});
}

TEST_CASE("conjugate gradients take it") {
  Eigen::VectorXd const b = Eigen::VectorXd::Ones(100);
  auto const run = slant::solve(slant::cg{laplacian{100}, b}, Eigen::VectorXd::Zero(100).eval(),
                                slant::residual_below(1e-13) || slant::at_most(200));
  CHECK(run.converged());
  CHECK(run.x()[0] == doctest::Approx(50));  // i (101 − i)/2 at i = 1
}
