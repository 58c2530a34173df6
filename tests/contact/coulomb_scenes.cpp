// SPDX-License-Identifier: MIT
#include "support/eigen_instances.hpp"

#include "contact/coulomb_scenes.hpp"

#include <algorithm>

namespace test {

dense_dual::dense_dual(Eigen::SparseMatrix<double> const& K,
                       slant::contact::data<double> const& c) {
  Eigen::MatrixXd B(c.N.rows() + c.T.rows(), K.rows());
  B << Eigen::MatrixXd(c.N), Eigen::MatrixXd(c.T);
  Eigen::LLT<Eigen::MatrixXd> const L{Eigen::MatrixXd(K)};
  A = B * L.solve(B.transpose());
  b = B * L.solve(c.f);
  b.head(c.d.size()) -= c.d;
}

std::pair<double, Eigen::VectorXd> nearest_in_cone(double μ, double n, Eigen::VectorXd const& t) {
  double const size = t.norm();
  if (size <= μ * n) return {n, t};
  if (μ * size <= -n) return {0, Eigen::VectorXd::Zero(t.size())};
  double const along = (n + μ * size) / (1 + μ * μ);
  return {along, Eigen::VectorXd(μ * along / size * t)};
}

double natural_map(dense_dual const& p, Eigen::VectorXd const& μ, Eigen::VectorXd const& λ) {
  Eigen::Index const m = μ.size(), k = λ.size() / m - 1;
  Eigen::VectorXd const u = p.A * λ - p.b;
  double const ρ = 1 / p.A.diagonal().maxCoeff();
  double largest = 0;
  for (Eigen::Index i = 0; i < m; ++i) {
    Eigen::VectorXd const ut = u.segment(m + k * i, k), rt = λ.segment(m + k * i, k);
    auto const [n, t] = nearest_in_cone(μ(i), λ(i) - ρ * (u(i) + μ(i) * ut.norm()), rt - ρ * ut);
    largest = std::max({largest, std::fabs(λ(i) - n), (rt - t).cwiseAbs().maxCoeff()});
  }
  return largest / λ.cwiseAbs().maxCoeff();
}

}  // namespace test
