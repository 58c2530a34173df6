// SPDX-License-Identifier: MIT
#include <oracle/dense_newton.hpp>

namespace oracle {

Eigen::MatrixXd scaled_jacobian(dense_qp const& qp, real_vector const& z,
                                Eigen::VectorXd const& ρ) {
  Eigen::MatrixXd J = qp.A;
  for (auto const& c : qp.intervals) {
    if (z[c.at] >= c.lower && z[c.at] <= c.upper) continue;
    J.row(c.at).setZero();
    J(c.at, c.at) = 1 / ρ[c.at];
  }
  for (auto const& c : qp.circles) {
    real const length = std::hypot(z[c.first], z[c.second]);
    if (!(length > c.radius)) continue;
    double const cosine = static_cast<double>(z[c.first] / length);
    double const sine = static_cast<double>(z[c.second] / length);
    Eigen::Matrix2d G;  // τ (I − e eᵀ)
    G << sine * sine, -sine * cosine, -sine * cosine, cosine * cosine;
    G *= static_cast<double>(c.radius / length);
    Eigen::Matrix<double, 2, Eigen::Dynamic> both(2, qp.size());
    both << qp.A.row(c.first), qp.A.row(c.second);
    both = G * both;
    Eigen::Matrix2d const rest = (Eigen::Matrix2d::Identity() - G) / ρ[c.first];
    both.col(c.first) += rest.col(0);
    both.col(c.second) += rest.col(1);
    J.row(c.first) = both.row(0);
    J.row(c.second) = both.row(1);
  }
  return J;
}

real_vector projected_gradients(dense_qp const& qp, real_vector const& start,
                                Eigen::VectorXd const& ρ, int count) {
  // In the metric of 1/ρ the largest eigenvalue of A is at most the row sum norm of ρA.
  double const L = (ρ.asDiagonal() * qp.A).cwiseAbs().rowwise().sum().maxCoeff();
  Eigen::VectorXd const b = qp.b.cast<double>();
  Eigen::VectorXd x = start.cast<double>();
  Eigen::VectorXd y = x;
  double t = 1;
  for (int i = 0; i < count; ++i) {
    Eigen::VectorXd const free_step = y - ρ.cwiseProduct(qp.A * y - b) / L;
    Eigen::VectorXd const next = qp.project(free_step.cast<real>()).cast<double>();
    bool const wrong_way = (y - next).cwiseQuotient(ρ).dot(next - x) > 0;
    double const t_next = wrong_way ? 1 : (1 + std::sqrt(1 + 4 * t * t)) / 2;
    y = wrong_way ? next : Eigen::VectorXd(next + (t - 1) / t_next * (next - x));
    t = t_next;
    x = next;
  }
  return x.cast<real>();
}

template newton_report solve_dense<dense_lu>(dense_qp const&, real_vector const&);
template newton_report solve_dense<dense_lu>(dense_qp const&);

}  // namespace oracle
