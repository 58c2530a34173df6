// SPDX-License-Identifier: MIT
//
// A naive solver of Stokes flow with stick–slip walls: bubbles are unknowns like the others, every
// matrix is dense, integrals are sums over the monomials of the barycentric coordinates,
//
//     ∫ φ₀ᵃ φ₁ᵇ φ₂ᶜ = 2V a! b! c! / (a + b + c + 2)!,
//
// and which nodes stick or slip is found by trying all 3ᵐ possibilities.
#pragma once

#include <Eigen/Dense>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

namespace oracle {

struct stokes_wall_node {
  int node;
  Eigen::Vector2d normal;
  Eigen::Vector2d tangent;
  double weight;
  double bound;     ///< g, per length
  double adhesion;  ///< κ
};

struct stokes_problem {
  Eigen::Matrix2Xd nodes;
  Eigen::Matrix3Xi cells;
  double viscosity;
  Eigen::Matrix2Xd force;   ///< f at the nodes, affine on each triangle
  std::vector<bool> fixed;  ///< whose velocity is given
  Eigen::Matrix2Xd given;   ///< that velocity
  std::vector<stokes_wall_node> wall;
};

struct stokes_result {
  Eigen::Matrix2Xd velocity;  ///< per node
  Eigen::VectorXd pressure;
  Eigen::VectorXd tangential;  ///< λ_t, a force per wall node
  Eigen::VectorXd normal;
  std::vector<int> slip;  ///< per wall node: 0 where it sticks, else the sign of u_t
};

class dense_stokes {
 public:
  explicit dense_stokes(stokes_problem problem) : p_(std::move(problem)) {
    n_ = static_cast<int>(p_.nodes.cols());
    t_ = static_cast<int>(p_.cells.cols());
    m_ = static_cast<int>(p_.wall.size());
    size_ = 2 * n_ + 2 * t_ + n_ + 2 * m_;
    assemble();
  }

  /// The solution that fits; none if no possibility does.
  [[nodiscard]] std::optional<stokes_result> solve(double tolerance) const {
    int possibilities = 1;
    for (int i = 0; i < m_; ++i) possibilities *= 3;
    for (int code = 0; code < possibilities; ++code) {
      std::vector<int> slip;  // −1, 0 (stick), 1 per wall node
      for (int i = 0, rest = code; i < m_; ++i, rest /= 3) slip.push_back(rest % 3 - 1);
      Eigen::VectorXd const x = solve_for(slip);
      if (fits(x, slip, tolerance)) return result(x, slip);
    }
    return std::nullopt;
  }

 private:
  [[nodiscard]] int bubble(int cell, int i) const { return 2 * n_ + 2 * cell + i; }
  [[nodiscard]] int pressure(int node) const { return 2 * n_ + 2 * t_ + node; }
  [[nodiscard]] int tangential(int i) const { return 2 * n_ + 2 * t_ + n_ + i; }
  [[nodiscard]] int normal(int i) const { return tangential(m_ + i); }

  /// ∫ of a monomial over a triangle of area 1.
  static double integral(std::array<int, 3> power) {
    auto const factorial = [](int k) { return std::tgamma(k + 1.0); };
    return 2 * factorial(power[0]) * factorial(power[1]) * factorial(power[2]) /
           factorial(power[0] + power[1] + power[2] + 2);
  }
  /// φ_a, or the two other factors of the bubble where a is left out.
  static std::array<int, 3> one(int a) {
    std::array<int, 3> power{};
    power[static_cast<std::size_t>(a)] = 1;
    return power;
  }
  static std::array<int, 3> without(int a) {
    std::array<int, 3> power{1, 1, 1};
    power[static_cast<std::size_t>(a)] = 0;
    return power;
  }
  static std::array<int, 3> times(std::array<int, 3> const& x, std::array<int, 3> const& y) {
    return {x[0] + y[0], x[1] + y[1], x[2] + y[2]};
  }

  void assemble() {
    M_ = Eigen::MatrixXd::Zero(size_, size_);
    rhs_ = Eigen::VectorXd::Zero(size_);
    for (int cell = 0; cell < t_; ++cell) add_triangle(cell);
    for (int i = 0; i < m_; ++i) {
      auto const& w = p_.wall[static_cast<std::size_t>(i)];
      for (int a = 0; a < 2; ++a) {
        for (int b = 0; b < 2; ++b)
          M_(2 * w.node + a, 2 * w.node + b) += w.weight * w.adhesion * w.tangent[a] * w.tangent[b];
        set_both(tangential(i), 2 * w.node + a, w.tangent[a]);
        set_both(normal(i), 2 * w.node + a, w.normal[a]);
      }
    }
    for (int node = 0; node < n_; ++node) {
      if (!p_.fixed[static_cast<std::size_t>(node)]) continue;
      for (int i = 0; i < 2; ++i) {
        M_.row(2 * node + i).setZero();
        M_(2 * node + i, 2 * node + i) = 1;
        rhs_[2 * node + i] = p_.given(i, node);
      }
    }
  }
  void set_both(int row, int column, double value) {
    M_(row, column) += value;
    M_(column, row) += value;
  }

  void add_triangle(int cell) {
    Eigen::Matrix3d J;  // barycentric coordinates are the solution of J φ = (1, x, y)
    J.row(0).setOnes();
    for (int a = 0; a < 3; ++a) J.col(a).tail<2>() = p_.nodes.col(p_.cells(a, cell));
    double const V = std::abs(J.determinant()) / 2;
    Eigen::Matrix<double, 3, 2> const g = J.inverse().rightCols<2>();
    for (int a = 0; a < 3; ++a) {
      int const row = p_.cells(a, cell);
      for (int b = 0; b < 3; ++b) {
        int const column = p_.cells(b, cell);
        double const stiffness = p_.viscosity * V * g.row(a).dot(g.row(b));
        double const bubbles = 27 * 27 * p_.viscosity * V * g.row(a).dot(g.row(b)) *
                               integral(times(without(a), without(b)));
        for (int i = 0; i < 2; ++i) {
          M_(2 * row + i, 2 * column + i) += stiffness;
          M_(bubble(cell, i), bubble(cell, i)) += bubbles;
          rhs_[2 * row + i] += V * integral(times(one(a), one(b))) * p_.force(i, column);
          // −∫ φ_a ∂_i φ_b and −∫ φ_a ∂_i β, a term of it
          set_both(pressure(row), 2 * column + i, -V * g(b, i) * integral(one(a)));
          set_both(pressure(row), bubble(cell, i),
                   -27 * V * g(b, i) * integral(times(one(a), without(b))));
        }
      }
      for (int i = 0; i < 2; ++i)
        rhs_[bubble(cell, i)] += 27 * V * integral(times(one(a), {1, 1, 1})) * p_.force(i, row);
    }
  }

  [[nodiscard]] Eigen::VectorXd solve_for(std::vector<int> const& slip) const {
    Eigen::MatrixXd M = M_;
    Eigen::VectorXd rhs = rhs_;
    for (int i = 0; i < m_; ++i) {
      int const s = slip[static_cast<std::size_t>(i)];
      if (s == 0) continue;  // u_t = 0 stays
      auto const& w = p_.wall[static_cast<std::size_t>(i)];
      M.row(tangential(i)).setZero();
      M(tangential(i), tangential(i)) = 1;
      rhs[tangential(i)] = s * w.weight * w.bound;
    }
    return M.fullPivLu().solve(rhs);
  }

  [[nodiscard]] bool fits(Eigen::VectorXd const& x, std::vector<int> const& slip,
                          double tolerance) const {
    for (int i = 0; i < m_; ++i) {
      auto const& w = p_.wall[static_cast<std::size_t>(i)];
      double const u_t = w.tangent.dot(x.segment<2>(2 * w.node));
      int const s = slip[static_cast<std::size_t>(i)];
      bool const holds = s == 0 ? std::abs(x[tangential(i)]) <= w.weight * w.bound + tolerance
                                : s * u_t >= -tolerance;
      if (!holds) return false;
    }
    return x.allFinite();
  }

  [[nodiscard]] stokes_result result(Eigen::VectorXd const& x, std::vector<int> const& slip) const {
    return {x.head(2 * n_).reshaped(2, n_), x.segment(pressure(0), n_),
            x.segment(tangential(0), m_), x.segment(normal(0), m_), slip};
  }

  stokes_problem p_;
  int n_{}, t_{}, m_{}, size_{};
  Eigen::MatrixXd M_{};
  Eigen::VectorXd rhs_{};
};

}  // namespace oracle
