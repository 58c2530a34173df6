// SPDX-License-Identifier: MIT
#include <slant/methods/barrier.hpp>
#include <slant/methods/interior_point.hpp>
#include <slant/sets/cartesian.hpp>
#include <slant/sets/contact_sets.hpp>
#include <slant/sets/ellipse.hpp>

#include <doctest/doctest.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <krylov/spd_matrices.hpp>

namespace reduced_systems_test {

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// The matrix of an operator, column by column.
template <class A>
MatrixXd dense(A const& a) {
  MatrixXd m(a.rows(), a.cols());
  VectorXd y(a.rows());
  for (Eigen::Index j = 0; j < m.cols(); ++j) {
    VectorXd const e = VectorXd::Unit(a.cols(), j);
    auto w = slant::workspace(a, e);
    slant::apply(a, e, y, w);
    m.col(j) = y;
  }
  return m;
}

TEST_CASE("the spectrum of [K Theorem 4] at every iterate") {
  // 4 bounds, 2 intervals, 3 discs, an ellipse, 2 free: diag(A) between 1 and 30.
  auto const set = slant::cartesian(slant::half_lines(VectorXd{{0.0, -1.0, 0.5, 0.0}}),
                                    slant::intervals(VectorXd{{0.3, 0.1}}),
                                    slant::discs(VectorXd{{0.5, 1.0, 2.0}}),
                                    slant::ellipse<>(1.0, 0.2), slant::free_components(2));
  VectorXd const scale = VectorXd::LinSpaced(16, 1.0, 5.0);
  MatrixXd M =
      scale.asDiagonal() * test::with_spectrum(test::log_spaced(16, 50), 3) * scale.asDiagonal();
  M = (M + M.transpose()).eval() / 2;
  auto const A = test::spd(M);
  VectorXd const b = 5 * test::random_vector(16, 4);
  Eigen::SelfAdjointEigenSolver<MatrixXd> const of_A(M);
  double const least = of_A.eigenvalues()(0) / M.diagonal().maxCoeff();
  double const most = of_A.eigenvalues()(15) / M.diagonal().minCoeff();

  slant::separable_qp const qp{A, b, set};
  slant::interior_point const method{qp};
  auto s = method.start(VectorXd(VectorXd::Zero(16)));
  double worst_without = 0;
  while (s.reduced_gradient_norm > 1e-8 * s.gradient_scale) {
    // The matrices of the next step: those at s.x.
    auto barrier = s.barrier;
    barrier.assemble(set, s.x, s.multipliers, s.slacks, s.unit, s.diagonal,
                     slant::lorentz_pairs<double>(set));
    VectorXd const force = s.unit * s.multipliers;
    MatrixXd const J_SC = M + dense(barrier.stiffness());
    MatrixXd const P_SC_inverse = dense(barrier.preconditioner());
    MatrixXd const G = dense(barrier.jacobian()).transpose();
    MatrixXd H = MatrixXd::Zero(16, 16);
    slant::detail::visit_inequalities(
        set, [&](auto const& block, auto const& p, auto, auto k, Eigen::Index row) {
          Eigen::Matrix<double, k, 1> const ν =
              force.cwiseProduct(barrier.per_unit()).template segment<k>(row);
          H.block(p.component(0), p.component(0), p.size(), p.size()) =
              block.inequality_hessian(p.value(s.x), ν);
        });
    CHECK((J_SC - M - H - G * force.cwiseQuotient(s.slacks).asDiagonal() * G.transpose()).norm() <=
          1e-14 * J_SC.norm());
    MatrixXd const P_SC = J_SC - M + MatrixXd(M.diagonal().asDiagonal());
    CHECK((P_SC * P_SC_inverse - MatrixXd::Identity(16, 16)).norm() <= 1e-15 * P_SC.norm() / least);
    // P_SC = L Lᵀ: the spectrum of P_SC⁻¹J_SC is that of L⁻¹ J_SC L⁻ᵀ.
    MatrixXd const L = P_SC.llt().matrixL();
    MatrixXd const L_inverse = L.triangularView<Eigen::Lower>().solve(MatrixXd::Identity(16, 16));
    Eigen::SelfAdjointEigenSolver<MatrixXd> const of_SC(L_inverse * J_SC * L_inverse.transpose());
    VectorXd const spectrum = of_SC.eigenvalues();
    CHECK(spectrum(0) >= least * (1 - 1e-8));
    CHECK(spectrum(15) <= most * (1 + 1e-8));
    Eigen::SelfAdjointEigenSolver<MatrixXd> const plain(J_SC);
    worst_without = std::max(worst_without, plain.eigenvalues()(15) / plain.eigenvalues()(0));
    method.step(s);
    REQUIRE(s.status == slant::status::running);
    REQUIRE(s.iteration < 40);
  }
  CHECK(worst_without > 1e3 * most / least);  // what the preconditioner saves
}

}  // namespace reduced_systems_test
