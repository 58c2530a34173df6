// SPDX-License-Identifier: MIT
#include <slant/iteration/feasible.hpp>
#include <slant/iteration/solve.hpp>
#include <slant/methods/smalse.hpp>
#include <slant/operators/equality_constraints.hpp>
#include <slant/operators/matrix.hpp>
#include <slant/sets/cartesian.hpp>
#include <slant/sets/contact_sets.hpp>

#include <doctest/doctest.h>

#include <support/allocation_guard.hpp>

#include <random>

namespace smalse_test {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using sparse = Eigen::SparseMatrix<double>;
using slant::status;

MatrixXd random_matrix(Eigen::Index rows, Eigen::Index cols, unsigned seed) {
  std::mt19937 generator(seed);
  std::normal_distribution<double> gaussian;
  return MatrixXd::NullaryExpr(rows, cols, [&] { return gaussian(generator); });
}

/// A problem with a known solution: 4 free components, 8 half lines of which every other one is at
/// its bound, and 6 discs of which every other one slides; 5 equations.
struct known_problem {
  static constexpr int n = 24;
  MatrixXd A, G;
  VectorXd x, b, e, g, μ;

  explicit known_problem(double unit = 1, int rank = n) {
    MatrixXd const root = random_matrix(n, rank, 1);
    A = unit * (root * root.transpose() / n);
    if (rank == n) A.diagonal().array() += 0.1 * unit;
    G = random_matrix(5, n, 2);
    x = random_matrix(n, 1, 3);
    μ = unit * random_matrix(5, 1, 4);
    g = VectorXd::Constant(6, 1.0);
    VectorXd normal = VectorXd::Zero(n);  // of Λ at x
    for (int i = 0; i < 8; ++i) {
      x[4 + i] = i % 2 == 0 ? 0.0 : 0.5 + std::abs(x[4 + i]);
      if (i % 2 == 0) normal[4 + i] = -0.3 - 0.1 * i;
    }
    for (int i = 0; i < 6; ++i) {
      auto disc = x.segment<2>(12 + 2 * i);
      disc *= (i % 2 == 0 ? 1.0 : 0.4) / disc.norm();
      if (i % 2 == 0) normal.segment<2>(12 + 2 * i) = (0.2 + i) * disc;
    }
    b = A * x + G.transpose() * μ + unit * normal;
    e = G * x;
  }
  [[nodiscard]] auto set() const {
    return slant::cartesian(slant::free_components(4), slant::half_lines(8), slant::discs(g));
  }
  [[nodiscard]] auto qp() const {
    return slant::separable_qp{slant::matrix<slant::self_adjoint, slant::positive_semidefinite>(A),
                               b, set()};
  }
  [[nodiscard]] auto constraints() const {
    return slant::equality_constraints(sparse(G.sparseView()), e);
  }
};

auto accurate(double tolerance) {
  return (slant::reduced_gradient_below(tolerance) && slant::feasibility_below(tolerance)) ||
         slant::at_most(200);
}

using newton_options = slant::smalse_options<double, slant::newton_inner<double>>;

TEST_CASE("the known solution with its multipliers, by KPRGP and by Newton's method") {
  known_problem const p;
  auto const qp = p.qp();
  auto const constraints = p.constraints();
  auto const check = [&](auto const& method) {
    auto const r = slant::solve(method, VectorXd(VectorXd::Zero(p.n)), accurate(1e-11));
    CAPTURE(r.reason);
    CHECK(r.converged());
    CHECK((r.x() - p.x).norm() <= 1e-9);
    CHECK((p.G * r.x() - p.e).norm() <= 1e-9);
    CHECK((method.multipliers(r.state) - p.μ).norm() <= 1e-8);
    MESSAGE("outer " << r.iterations() << " inner " << r.state.work.inner_iterations << " products "
                     << r.state.work.operator_applications << " M/rho " << r.state.M / r.state.ρ);
  };
  check(slant::smalse{qp, constraints});
  check(slant::smalse{qp, constraints, newton_options{}});
}

}  // namespace smalse_test
