// SPDX-License-Identifier: MIT
#include "contact/friction_scenes.hpp"

#include <random>

namespace test {

friction_problem random_friction(slant::index contacts, slant::index dimension, double mu,
                                 unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  slant::index const n = contacts * dimension;
  auto const number = [&](auto...) { return normal(random); };
  Eigen::MatrixXd const H = Eigen::MatrixXd::NullaryExpr(n, n, number) / std::sqrt(double(n));
  Eigen::MatrixXd const W = H * H.transpose() + 0.1 * Eigen::MatrixXd::Identity(n, n);
  Eigen::VectorXd q = Eigen::VectorXd::NullaryExpr(n, number);
  for (slant::index i = 0; i < contacts; ++i) q[i * dimension] -= 0.7;
  return make_friction_problem(W, q, Eigen::VectorXd::Constant(contacts, mu));
}

friction_problem repeated(friction_problem const& p, slant::index times) {
  Eigen::MatrixXd const W = Eigen::MatrixXd(p.W).replicate(times, times);
  Eigen::VectorXd const q = p.q.replicate(times, 1), mu = p.mu.replicate(times, 1);
  return make_friction_problem(W, q, mu);
}

friction_problem chain_friction(slant::index contacts) {
  std::vector<Eigen::Triplet<double>> entries;
  Eigen::VectorXd q = Eigen::VectorXd::Zero(3 * contacts);
  for (slant::index i = 0; i < contacts; ++i) {
    for (int a = 0; a < 3; ++a) {
      entries.emplace_back(int(3 * i + a), int(3 * i + a), 2 + 0.1 * a);
      if (i + 1 < contacts) {
        entries.emplace_back(int(3 * i + a), int(3 * i + 3 + a), -0.4);
        entries.emplace_back(int(3 * i + 3 + a), int(3 * i + a), -0.4);
      }
    }
    entries.emplace_back(int(3 * i), int(3 * i + 1), 0.3);
    entries.emplace_back(int(3 * i + 1), int(3 * i), 0.3);
    q[3 * i] = i % 2 == 0 ? -1 - 0.3 * std::sin(double(i)) : 5;
    q[3 * i + 1] = 0.8 * std::sin(3.0 * double(i));
    q[3 * i + 2] = 0.5 * std::cos(5.0 * double(i));
  }
  Eigen::SparseMatrix<double> W(3 * contacts, 3 * contacts);
  W.setFromTriplets(entries.begin(), entries.end());
  return {.W = W, .q = q, .mu = Eigen::VectorXd::Constant(contacts, 0.3)};
}

std::vector<oracle::naive_contact> naive(friction_problem const& p, Eigen::VectorXd const& r) {
  using real = oracle::friction_real;
  return oracle::naive_friction(Eigen::MatrixXd(p.W).cast<real>(), p.q.cast<real>(),
                                p.mu.cast<real>(), r.cast<real>());
}

}  // namespace test
