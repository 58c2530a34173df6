// SPDX-License-Identifier: MIT
#include "operators/letters.hpp"

#include <Eigen/Dense>
#include <Eigen/Eigenvalues>

#include <algorithm>

namespace test {

namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

MatrixXd random(int rows, int cols, unsigned seed) {
  MatrixXd a(rows, cols);
  for (int i = 0; i < a.size(); ++i) {
    seed = seed * 1664525U + 1013904223U;
    a.data()[i] = double(seed >> 8) / double(1U << 23) - 1;
  }
  return a;
}
/// I + c F Fᵀ of the size of F.
MatrixXd definite(int size, unsigned seed) {
  MatrixXd const f = random(size, size, seed);
  return MatrixXd::Identity(size, size) + 0.2 * f * f.transpose();
}

}  // namespace

letter_data::letter_data() : K(definite(n, 1)), S(definite(n, 2)), N(definite(m, 13)) {
  MatrixXd const f = random(n, 3, 3);
  P = f * f.transpose();
  J = f * (f.transpose() * f).inverse() * f.transpose();
  MatrixXd const q = random(n, n, 4);
  Q = q + q.transpose();
  G = random(n, n, 5) + 2 * MatrixXd::Identity(n, n);
  H = random(n, n, 6);
  MatrixXd const t = random(n, n, 8);
  T = definite(n, 7) + t - t.transpose();
  B = random(m, n, 9);
  R = random(m, 2, 10) * random(2, n, 11);
  C = random(p, m, 12);
  d = VectorXd::LinSpaced(n, 0.5, 2);
  e = VectorXd::LinSpaced(n, -1, 2);
}

letter_data const& letters_of_test() {
  static letter_data const data;
  return data;
}

std::string false_laws(MatrixXd const& a, slant::law_set laws) {
  double const size = a.norm();
  double const noise = 1e-11 * (1 + size);
  VectorXd const λ =
      Eigen::SelfAdjointEigenSolver<MatrixXd>(MatrixXd((a + a.transpose()) / 2)).eigenvalues();
  std::string wrong;
  auto const expect = [&](slant::law l, bool holds) {
    if (laws.contains(l) && !holds) wrong.append(slant::expr::law_name(l)).append(" ");
  };
  expect(slant::law::self_adjoint, (a - a.transpose()).norm() <= noise);
  expect(slant::law::positive_semidefinite, λ.minCoeff() >= -noise);
  expect(slant::law::positive_definite, λ.minCoeff() > 1e-7 * size);
  expect(slant::law::projector, (a * a - a).norm() <= noise);
  expect(slant::law::firmly_nonexpansive, Eigen::SelfAdjointEigenSolver<MatrixXd>(
                                              MatrixXd((a + a.transpose()) / 2 - a.transpose() * a))
                                                  .eigenvalues()
                                                  .minCoeff() >= -noise);
  return wrong;
}

double disagreement(results const& r) {
  MatrixXd const& a = r.dense;
  VectorXd const x = argument_x(a.cols());
  VectorXd const z = argument_z(a.rows());
  double largest = 0;
  auto const compare = [&](auto const& got, auto const& expected) {
    if (got.size() > 0) largest = std::max(largest, (got - expected).norm() / (1 + a.norm()));
  };
  compare(r.adjoint, VectorXd(a.transpose() * z));
  compare(r.added, VectorXd(z - 1.5 * a * x));
  compare(r.adjoint_added, VectorXd(x - 1.5 * a.transpose() * z));
  compare(r.diagonal, VectorXd(a.diagonal()));
  if (r.columns.size() > 0) compare(r.columns, MatrixXd(a.middleCols(1, 2)));
  return largest;
}

}  // namespace test
