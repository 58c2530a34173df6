// SPDX-License-Identifier: MIT
//
// Problems with equality constraints whose solutions are known.
#pragma once

#include <slant/slant.hpp>

#include <support/testing.hpp>

namespace test {

inline MatrixXd random_matrix(Eigen::Index rows, Eigen::Index cols, unsigned seed) {
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

  /// unit: of A; length: of x.
  explicit known_problem(double unit = 1, int rank = n, double length = 1) {
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
    b = length * (A * x + G.transpose() * μ + unit * normal);
    μ *= length;
    x *= length;
    g *= length;
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

inline auto accurate(double tolerance) {
  return (slant::reduced_gradient_below(tolerance) && slant::feasibility_below(tolerance)) ||
         slant::at_most(400);
}

/// Runs a method from zero and compares with the solution that is known.
template <class Method>
auto check_solution(Method const& method, known_problem const& p, double tolerance = 1e-11) {
  auto const r = slant::solve(method, test::zeros(p.n), accurate(tolerance));
  CAPTURE(r.reason);
  CHECK(r.converged());
  CHECK((r.x() - p.x).stableNorm() <= 100 * tolerance * p.x.stableNorm());
  CHECK((p.G * r.x() - p.e).stableNorm() <= 100 * tolerance * p.x.stableNorm());
  VectorXd const μ = method.multipliers(r.state);
  CHECK((p.G.transpose() * (μ - p.μ)).stableNorm() <=
        1000 * tolerance * (p.G.transpose() * p.μ).stableNorm());
  return r;
}

/// ½ ‖x‖² − 10 x₁ over the quadrant, on the line through (1, 0) that leaves the axis by the angle
/// θ: feasible in (1, 0) and points to the left of it.
struct wedge {
  MatrixXd A = MatrixXd::Identity(2, 2);
  VectorXd b{{10.0, 0.0}};
  slant::equality_constraints<double> constraints;

  explicit wedge(double θ)
      : constraints(sparse(MatrixXd{{std::sin(θ), std::cos(θ)}}.sparseView()),
                    VectorXd(VectorXd::Constant(1, std::sin(θ)))) {}
  [[nodiscard]] auto qp() const {
    return slant::separable_qp{
        slant::matrix<slant::self_adjoint, slant::positive_semidefinite>(A), b,
        cartesian(slant::free_components(0), slant::half_lines(2), slant::discs(VectorXd()))};
  }
};

}  // namespace test
