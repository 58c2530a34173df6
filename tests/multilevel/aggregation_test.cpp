// SPDX-License-Identifier: MIT
#include "block_vectors.hpp"
#include "grids.hpp"

#include <slant/contact/free_motions.hpp>
#include <slant/multilevel/aggregation.hpp>

#include <fem/steel_brick.hpp>
#include <support/testing.hpp>

namespace aggregation_test {

using namespace test::evaluated;
using slant::aggregate;
using slant::block_matrix;
using test::laplacian;

std::vector<int> sizes_of(slant::aggregation const& a) {
  std::vector<int> sizes(static_cast<std::size_t>(a.count), 0);
  for (int const i : a.of)
    if (i >= 0) ++sizes[static_cast<std::size_t>(i)];
  return sizes;
}

TEST_CASE("every node is in one aggregate, and none is empty") {
  auto const a = aggregate(block_matrix<1>(laplacian(9, 7)), 0.1);
  REQUIRE(a.of.size() == 63);
  auto const sizes = sizes_of(a);
  CHECK(std::ranges::all_of(a.of, [&](int i) { return i >= 0 && i < a.count; }));
  CHECK(*std::ranges::min_element(sizes) >= 2);
  CHECK(a.count <= 63 / 3);
}

TEST_CASE("weak couplings do not join: aggregates lie along the strong direction") {
  // Across columns of the grid the coupling is 1e-4 of that along them.
  auto const a = aggregate(block_matrix<1, float>(laplacian(8, 6, 1e-4)), 0.1);
  for (double const unit : {1e-22, 1e22})
    CHECK(aggregate(block_matrix<1, float>(laplacian(8, 6, 1e-4), unit), 0.1).of == a.of);
  for (std::size_t i = 0; i < a.of.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) CHECK((i / 8 == j / 8 || a.of[i] != a.of[j]));
  }
}

TEST_CASE("unknowns of a node stay together; nodes without neighbours are in no aggregate") {
  sparse I(12, 12);
  I.setIdentity();
  I.coeffRef(0, 5) = I.coeffRef(5, 0) = 0.5;
  auto const a = aggregate(block_matrix<3>(I), 0.1);
  CHECK(a.count == 1);
  CHECK(a.of == std::vector<int>{0, 0, -1, -1});
  CHECK(aggregate(block_matrix<1>(sparse(0, 0)), 0.1).count == 0);
}

/// P₀ as a dense matrix.
template <int N, int M>
MatrixXd tentative(slant::aggregation const& a, std::vector<double> const& Q) {
  MatrixXd P = MatrixXd::Zero(N * Eigen::Index(a.of.size()), M * a.count);
  for (std::size_t i = 0; i < a.of.size(); ++i) {
    for (std::size_t q = 0; q < N; ++q) {
      for (std::size_t c = 0; c < M && a.of[i] >= 0; ++c) {
        P(Eigen::Index(N * i + q), Eigen::Index(M) * a.of[i] + Eigen::Index(c)) =
            Q[(i * N + q) * M + c];
      }
    }
  }
  return P;
}

slant::detail::near_kernel<3, 6> kernel_of(MatrixXd const& modes) {
  slant::detail::near_kernel<3, 6> kernel;
  for (Eigen::Index i = 0; i < modes.rows(); ++i)
    for (int c = 0; c < 6; ++c) kernel.blocks.push_back(modes(i, c));
  return kernel;
}

TEST_CASE("candidates: orthonormal columns whose range has the near kernel, also far away") {
  for (double const away : {0.0, 1e4}) {
    auto const s = fem::make_steel_brick({.k = 3});
    MatrixXd nodes = test::moving_nodes(s);
    nodes.row(1).array() += away;
    auto const n = nodes.cols();
    // Rotations about the origin, however far that is.
    MatrixXd B = MatrixXd::Zero(3 * n, 6);
    for (Eigen::Index i = 0; i < n; ++i) {
      Vector3d const x = nodes.col(i);
      B.block<3, 3>(3 * i, 0).setIdentity();
      for (int c = 0; c < 3; ++c)
        B.block<3, 1>(3 * i, 3 + c) = Vector3d::Unit(c).cross(x) / (1 + away);
    }
    auto const kernel = kernel_of(B);
    auto const a = aggregate(block_matrix<3>(s.K), 0.02);
    REQUIRE(std::ranges::all_of(a.of, [](int i) { return i >= 0; }));
    slant::detail::near_kernel<6, 6> coarse;
    auto const Q = slant::detail::orthonormal_candidates<3, 6, double>(a, kernel, coarse);
    MatrixXd const P = tentative<3, 6>(a, Q);
    MatrixXd R(6 * a.count, 6);
    for (Eigen::Index i = 0; i < R.rows(); ++i)
      for (int c = 0; c < 6; ++c) R(i, c) = coarse.blocks[std::size_t(6 * i + c)];
    double const loss = away > 0 ? 1e-6 : 1e-12;  // squares of candidates that nearly agree
    CHECK((P * R - B).norm() <= loss * B.norm());
    MatrixXd const gram = P.transpose() * P;
    CHECK((gram - MatrixXd(gram.diagonal().asDiagonal())).norm() <= loss * gram.norm());
    CHECK(gram.diagonal().maxCoeff() <= 1 + loss);
  }
}

TEST_CASE("a node by itself has no rotations: these coarse unknowns are left out") {
  slant::aggregation const a{{0, 1, 1}, 2};
  slant::detail::near_kernel<3, 6> B;
  for (double const x : {0.5, 1.0, 2.0}) {
    for (double const v : {1., 0., 0., 0., 0., 0., 0., 1., 0., 0., 0., x, 0., 0., 1., 0., -x, 0.})
      B.blocks.push_back(v);
  }
  slant::detail::near_kernel<6, 6> R;
  auto const P = tentative<3, 6>(a, slant::detail::orthonormal_candidates<3, 6, double>(a, B, R));
  MatrixXd const gram = P.transpose() * P;
  CHECK(gram.diagonal().head(6).sum() == doctest::Approx(3));
  CHECK(gram.diagonal().tail(6).sum() == doctest::Approx(5));  // none about the line of both
}

TEST_CASE("the prolongation is smoothed by a step of Jacobi, by dense algebra") {
  auto const s = fem::make_steel_brick({.k = 2});
  block_matrix<3> const A(sparse(s.K / 2e5));
  MatrixXd const K(s.K / 2e5);
  auto const n = K.rows();
  MatrixXd inverse = MatrixXd::Zero(n, n);
  for (Eigen::Index i = 0; i < n; i += 3) inverse.block<3, 3>(i, i) = K.block<3, 3>(i, i).inverse();
  auto const inverses = test::block_inverses<3, double>(inverse);
  Eigen::GeneralizedSelfAdjointEigenSolver<MatrixXd> const e(K, inverse.inverse());
  std::vector<double> x(A.padded_size()), y(x);
  double const λ = slant::detail::largest_jacobi_eigenvalue(A, inverses.data(), x, y, true);
  CHECK(λ <= (1 + 1e-12) * e.eigenvalues()[n - 1]);
  CHECK(λ >= 0.85 * e.eigenvalues()[n - 1]);

  MatrixXd const modes = slant::contact::rigid_body_modes(test::moving_nodes(s));
  auto const kernel = kernel_of(modes);
  auto const a = aggregate(A, 0.02);
  slant::detail::near_kernel<6, 6> R;
  auto const Q = slant::detail::orthonormal_candidates<3, 6, double>(a, kernel, R);
  MatrixXd const P0 = tentative<3, 6>(a, Q);
  for (double const ω : {0.0, 0.6}) {
    auto const P = slant::detail::smoothed_prolongation<3, 6>(A, inverses.data(), a, Q, ω);
    MatrixXd found = MatrixXd::Zero(n, P0.cols());
    for (int i = 0; i < P.nodes(); ++i) {
      for (int at = P.begin(i); at < P.end(i); ++at)
        for (int k = 0; k < 18; ++k) found(3 * i + k / 6, 6 * P.at(at) + k % 6) = P.block(at)[k];
    }
    CHECK((found - P0 + ω * inverse * K * P0).norm() <= 1e-13 * P0.norm());
  }
}

}  // namespace aggregation_test
