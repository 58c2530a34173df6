// SPDX-License-Identifier: MIT
#include <slant/slant.hpp>

#include <krylov/spd_matrices.hpp>
#include <support/dense_of.hpp>
#include <support/testing.hpp>

namespace reduced_systems_test {

using namespace test::evaluated;
using test::dense_of;

TEST_CASE("both systems and their preconditioners: the spectra of [K Theorems 3 and 4]") {
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
  auto s = method.start(test::zeros(16));
  double worst_without = 0;
  while (s.reduced_gradient_norm > 1e-8 * s.gradient_scale) {
    // The matrices of the next step: those at s.x.
    auto barrier = s.barrier;
    barrier.assemble(set, s.x, s.multipliers, s.slacks, s.unit, s.diagonal);
    VectorXd const d22 = s.slacks.cwiseQuotient(s.multipliers) / s.unit;
    MatrixXd const J_SC = dense_of(slant::schur_system(A, barrier));
    MatrixXd const P_SC_inverse = dense_of(barrier.preconditioner());
    MatrixXd const G = dense_of(barrier.jacobian()).transpose();
    MatrixXd const H = dense_of(barrier.curvature());
    CHECK((J_SC - M - H - G * d22.cwiseInverse().asDiagonal() * G.transpose()).norm() <=
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

    MatrixXd const J_AM = dense_of(slant::augmented_system(A, barrier, d22));
    MatrixXd const P_AM_inverse = dense_of(slant::augmented_preconditioner(barrier, d22));
    auto const m = d22.size();
    MatrixXd J(16 + m, 16 + m);
    J << M + H, G, G.transpose(), -MatrixXd(d22.asDiagonal());
    CHECK((J_AM - J).norm() <= 1e-14 * J.norm());
    // n + m independent eigenvectors: (u, D₂₂⁻¹ Gᵀ u) for u of P_SC⁻¹J_SC, and (0, e_i) for 1.
    MatrixXd vectors = MatrixXd::Identity(16 + m, 16 + m);
    vectors.topLeftCorner(16, 16) = L_inverse.transpose() * of_SC.eigenvectors();
    vectors.bottomLeftCorner(m, 16) =
        d22.cwiseInverse().asDiagonal() * G.transpose() * vectors.topLeftCorner(16, 16);
    VectorXd numbers = VectorXd::Ones(16 + m);
    numbers.head(16) = spectrum;
    for (Eigen::Index j = 0; j < 16 + m; ++j) {
      VectorXd const image = P_AM_inverse * (J_AM * vectors.col(j));
      CHECK((image - numbers(j) * vectors.col(j)).norm() <= 1e-6 * vectors.col(j).norm());
    }

    method.step(s);
    REQUIRE(s.status == slant::status::running);
    REQUIRE(s.iteration < 40);
  }
  CHECK(worst_without > 1e3 * most / least);  // what the preconditioner saves
}

}  // namespace reduced_systems_test
