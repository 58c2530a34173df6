// SPDX-License-Identifier: MIT
#include "block_vectors.hpp"

#include <slant/multilevel/parts/dense_factor.hpp>
#include <slant/multilevel/parts/galerkin.hpp>
#include <support/testing.hpp>

namespace dense_factor_test {

using namespace test::evaluated;
using slant::block_matrix;
using slant::detail::dense_factor;
using slant::detail::whole_blocks;

/// B Bᵀ with B of n × rank pseudo-random entries.
MatrixXd gram(int n, int rank, unsigned random = 7) {
  MatrixXd B(n, rank);
  for (Eigen::Index k = 0; k < B.size(); ++k) {
    random = random * 1664525u + 1013904223u;
    B.data()[k] = double(random) / 4294967296.0 - 0.5;
  }
  return B * B.transpose();
}

template <int N, class T>
MatrixXd inverse_by_factor(MatrixXd const& K, double& lowest) {
  block_matrix<N, T> const A{Eigen::SparseMatrix<double>(K.sparseView())};
  dense_factor<N, T> f(A.nodes());
  lowest = f.factor(A, A, whole_blocks{});
  MatrixXd M(K.rows(), K.cols());
  for (Eigen::Index j = 0; j < K.cols(); ++j) {
    auto x = test::packed<N, T>(VectorXd::Unit(K.rows(), j));
    f.solve(x.data(), x.data());
    M.col(j) = test::unpacked<N, T>(x);
  }
  return M;
}

template <int N, class T>
void check_definite() {
  for (int const nodes : {1, 2, 5}) {
    int const n = N * nodes;
    MatrixXd const K = gram(n, n) + MatrixXd::Identity(n, n);
    double lowest = 0;
    MatrixXd const M = inverse_by_factor<N, T>(K, lowest);
    double const ε = 1e3 * double(std::numeric_limits<T>::epsilon());
    CHECK((M * K - MatrixXd::Identity(n, n)).norm() <= ε * n);
    CHECK(lowest > 0);
  }
}

TEST_CASE("the inverse of definite matrices") {
  check_definite<1, double>();
  check_definite<2, float>();
  check_definite<3, float>();
  check_definite<6, double>();
}

template <int N, class T>
void check_semidefinite() {
  int const n = 4 * N;
  for (int const rank : {0, 1, n / 2, n - 1}) {
    MatrixXd const K = gram(n, rank);
    double lowest = 0;
    MatrixXd const M = inverse_by_factor<N, T>(K, lowest);
    double const ε = 1e4 * double(std::numeric_limits<T>::epsilon());
    CHECK(M.allFinite());
    CHECK((M - M.transpose()).norm() <= ε * M.norm());
    CHECK((K * M * K - K).norm() <= ε * (1 + M.norm() * K.norm()) * K.norm());
    CHECK(test::eigenvalues_of(0.5 * (M + M.transpose()))[0] >= -ε * M.norm());
    CHECK(lowest >= -ε);
  }
}

TEST_CASE("generalised inverses of semidefinite matrices, of any rank") {
  check_semidefinite<3, float>();
  check_semidefinite<6, double>();
}

template <int N>
void check_small() {
  using matrix = Eigen::Matrix<double, N, N>;
  double const ε = 1e-12;
  for (int rank = 0; rank <= N; ++rank) {
    matrix const a = gram(N, rank, 3);
    matrix x = a;
    double least[N], scale[N];
    for (int c = 0; c < N; ++c) {
      scale[c] = a(c, c);
      least[c] = ε * a(c, c);
    }
    double const lowest = slant::detail::invert_semidefinite<N>(x.data(), least, scale);
    CHECK((x - x.transpose()).norm() <= 1e-10 * x.norm());
    CHECK((a * x * a - a).norm() <= 1e-8 * a.norm());
    CHECK((x * a * x - x).norm() <= 1e-8 * x.norm());
    int kept = 0;
    for (int c = 0; c < N; ++c) kept += x.col(c).norm() > 0 ? 1 : 0;
    CHECK(kept == rank);
    CHECK(lowest >= -ε);
    if (rank == N) CHECK(lowest > ε);
  }
}

TEST_CASE("one block: inverses of principal submatrices, of any rank") {
  check_small<1>();
  check_small<2>();
  check_small<3>();
  check_small<6>();
}

TEST_CASE("one block: unknowns below their limit are left out, negative pivots are told") {
  Eigen::Matrix3d a = Vector3d(4, 1e-9, 2).asDiagonal();
  a(0, 2) = a(2, 0) = 1;
  double const least[] = {0, 1e-6, 0}, scale[] = {4, 1, 2};
  Eigen::Matrix3d x = a;
  CHECK(slant::detail::invert_semidefinite<3>(x.data(), least, scale) == doctest::Approx(1e-9));
  Eigen::Matrix3d expected = Eigen::Matrix3d::Zero();
  expected(0, 0) = 2 / 7.0;
  expected(2, 2) = 4 / 7.0;
  expected(0, 2) = expected(2, 0) = -1 / 7.0;
  CHECK((x - expected).norm() <= 1e-15);
  a(0, 2) = a(2, 0) = 4;
  CHECK(slant::detail::invert_semidefinite<3>(a.data(), least, scale) == doctest::Approx(-1));
}

TEST_CASE("what a face leaves of an unknown up to rounding is left out") {
  // On the line along t, of which the first component is a rounding error.
  Vector3d const t = Vector3d(1e-9, 0.6, -0.8);
  block_matrix<3, float> const free{
      Eigen::SparseMatrix<double>(MatrixXd::Identity(3, 3).sparseView())};
  block_matrix<3, float> const A{
      Eigen::SparseMatrix<double>(MatrixXd(t * t.transpose()).sparseView())};
  dense_factor<3, float> f(1);
  f.factor(A, free, whole_blocks{});
  auto x = test::packed<3, float>(t);
  f.solve(x.data(), x.data());
  CHECK(t.dot(test::unpacked<3, float>(x)) == doctest::Approx(1));
}

TEST_CASE("a negative pivot is told; factoring anew does not allocate") {
  MatrixXd K = MatrixXd::Identity(6, 6);
  K(0, 5) = K(5, 0) = 2;
  double lowest = 0;
  inverse_by_factor<3, double>(K, lowest);
  CHECK(lowest == doctest::Approx(-3));
  block_matrix<3> const A{Eigen::SparseMatrix<double>(MatrixXd::Identity(6, 6).sparseView())};
  dense_factor<3, double> f(2);
  slant::testing::allocation_guard guard;
  f.factor(A, A, whole_blocks{});
  auto const allocations = guard.count();
  CHECK(allocations == 0);
}

}  // namespace dense_factor_test
