// SPDX-License-Identifier: MIT
#include "block_vectors.hpp"
#include "grids.hpp"

#include <slant/multilevel/block_matrix.hpp>
#include <slant/multilevel/parts/envelope_factor.hpp>
#include <slant/multilevel/parts/galerkin.hpp>
#include <slant/testing/laws.hpp>

#include <fem/steel_brick.hpp>
#include <support/testing.hpp>

namespace block_matrix_test {

using namespace test::evaluated;
using slant::block_matrix;
using test::packed;
using test::unpacked;

/// Definite, 6 × 6 blocks of which some are missing and some have holes.
sparse sample(int nodes) {
  int const n = 6 * nodes;
  MatrixXd K = MatrixXd::Zero(n, n);
  for (int i = 0; i < n; ++i) {
    K(i, i) = 8 + i % 5;
    for (int j = 0; j < i; ++j) {
      bool const near = (i / 6 - j / 6) % 3 != 2;
      if (near && (7 * i + 3 * j) % 4 == 0) K(i, j) = K(j, i) = 0.1 * ((5 * i + j) % 7 - 3.0);
    }
  }
  return K.sparseView();
}

template <int N, class T>
void check_against_eigen(sparse const& K) {
  block_matrix<N, T> const A(K);
  // The reference is one in double.
  double const ε = 64 * std::max(double(std::numeric_limits<T>::epsilon()),
                                 std::numeric_limits<double>::epsilon());
  REQUIRE(A.rows() == K.rows());
  MatrixXd const dense(K);
  CHECK((test::dense(A) - dense).norm() <= ε * dense.norm());

  // D, L from the dense matrix, sweeps by solves with them.
  auto const n = K.rows();
  MatrixXd D = MatrixXd::Zero(n, n), L = MatrixXd::Zero(n, n), inverse = D;
  for (Eigen::Index i = 0; i < n; i += N) {
    D.block<N, N>(i, i) = dense.block<N, N>(i, i);
    L.block(i, 0, N, i) = dense.block(i, 0, N, i);
    inverse.block<N, N>(i, i) = dense.block<N, N>(i, i).inverse();
  }
  auto const inverses = test::block_inverses<N, T>(inverse);
  VectorXd const b = VectorXd::LinSpaced(n, -1, 2), start = VectorXd::LinSpaced(n, 1, -3);
  auto const close = [&](std::vector<T> const& x, VectorXd const& expected) {
    CHECK((unpacked<N, T>(x) - expected).norm() <= ε * (expected.norm() + b.norm()));
  };
  auto x = packed<N, T>(start), r = packed<N, T>(start);
  auto const pb = packed<N, T>(b);
  A.multiply(x.data(), r.data());
  close(r, dense * start);

  VectorXd const once = test::solution_of(D + L, b);
  A.forwards_from_zero(inverses.data(), pb.data(), x.data(), r.data());
  close(x, once);
  close(r, b - dense * once);
  x = packed<N, T>(start);
  A.backwards(inverses.data(), pb.data(), x.data(), r.data());
  VectorXd const back = test::solution_of(D + L.transpose(), b - L * start);
  close(x, back);
  close(r, L.transpose() * back);
  A.complete_product(x.data(), r.data());
  close(r, dense * back);
}

TEST_CASE("products, residuals and sweeps against dense algebra") {
  for (int const nodes : {1, 2, 7}) {
    sparse const K = sample(nodes);
    check_against_eigen<3, float>(K);
    check_against_eigen<3, double>(K);
    check_against_eigen<6, float>(K);
    check_against_eigen<2, double>(K);
    check_against_eigen<1, double>(K);
    check_against_eigen<3, long double>(K);
  }
  check_against_eigen<3, float>(fem::make_steel_brick({.k = 2}).K / 2e5);
}

TEST_CASE("the laws of an operator") {
  slant::testing::check_operator_laws(block_matrix<3>(sample(5)));
  slant::testing::check_operator_laws(block_matrix<6, float>(sample(5)), Eigen::VectorXf(30));
}

TEST_CASE("an uncompressed matrix, a row-major one, a factor") {
  sparse K = sample(4);
  MatrixXd const dense(K);
  K.uncompress();
  CHECK(test::dense(block_matrix<3>(K)) == dense);
  CHECK(test::dense(block_matrix<3>(Eigen::SparseMatrix<double, Eigen::RowMajor>(K))) == dense);
  CHECK(test::dense(block_matrix<3>(K, 0.25)) == 0.25 * dense);
  CHECK(block_matrix<3>(sparse(0, 0)).rows() == 0);
}

TEST_CASE("blocks without an entry are not stored") {
  sparse K(12, 12);
  K.setIdentity();
  K.coeffRef(4, 9) = K.coeffRef(9, 4) = 0.5;
  block_matrix<3> const A(K);
  CHECK(A.blocks() == 6);
  CHECK(test::dense(A) == MatrixXd(K));
}

TEST_CASE("nothing allocates") {
  block_matrix<3, float> const A(sample(6));
  auto x = packed<3, float>(VectorXd::Ones(36)), b = x, r = x;
  auto const inverses = test::block_inverses<3, float>(MatrixXd::Identity(36, 36));
  slant::testing::allocation_guard guard;
  A.multiply(b.data(), r.data());
  A.forwards_from_zero(inverses.data(), b.data(), x.data(), r.data());
  A.backwards(inverses.data(), b.data(), x.data(), r.data());
  A.complete_product(x.data(), r.data());
  auto const allocations = guard.count();
  CHECK(allocations == 0);
}

TEST_CASE("what cannot be used is named") {
  sparse K = sample(2);
  CHECK_THROWS_AS(block_matrix<3>(sparse(3, 6)), slant::bad_input);
  CHECK_THROWS_WITH_AS(block_matrix<3>(sparse(4, 4)), "K: got 4 rows, expected a multiple of 3",
                       slant::bad_input);
  K.coeffRef(3, 4) = 2;
  CHECK_THROWS_AS(block_matrix<3>{K}, slant::bad_input);
  K.coeffRef(3, 4) = K.coeffRef(4, 3) = std::numeric_limits<double>::infinity();
  CHECK_THROWS_WITH_AS(block_matrix<3>{K}, "K(4, 3): got inf, expected a finite number",
                       slant::bad_input);
  K.coeffRef(3, 4) = K.coeffRef(4, 3) = 1;
  CHECK_NOTHROW(block_matrix<3>{K});
  K.coeffRef(3, 4) *= 1 + 4e-16;  // as assembly from many parts leaves it
  CHECK_NOTHROW(block_matrix<3>{K});
  K.coeffRef(3, 4) *= 1 + 1e-9;
  CHECK_THROWS_AS(block_matrix<3>{K}, slant::bad_input);
}

using slant::detail::envelope;
using slant::detail::envelope_factor;
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
  envelope_factor<N, T> f{envelope(A)};
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

TEST_CASE("factors keep to the envelope, in whatever order the nodes of a mesh come") {
  // Two strips of 3 × 20 nodes of two unknowns, number 7 k mod 120 the k-th of them.
  MatrixXd K = 5 * MatrixXd::Identity(240, 240);
  auto const couple = [&](int k, int l) {
    int const i = 2 * (7 * k % 120), j = 2 * (7 * l % 120);
    K.block<2, 2>(i, j) << 0.2, -0.4, 0.3, 0.1;
    K.block<2, 2>(j, i) = K.block<2, 2>(i, j).transpose();
  };
  for (int k = 0; k < 120; ++k) {
    if (k % 3 != 2) couple(k, k + 1);
    if (k % 60 < 57) couple(k, k + 3);
  }
  block_matrix<2> const A{Eigen::SparseMatrix<double>(K.sparseView())};
  CHECK(envelope(A).work(2) <= 120 * 5 * 5 / 2 * 8);
  double lowest = 0;
  MatrixXd const I = inverse_by_factor<2, double>(K, lowest) * K;
  CHECK((I - MatrixXd::Identity(240, 240)).norm() <= 1e-11);
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
  envelope_factor<3, float> f{envelope(A)};
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
  envelope_factor<3, double> f{envelope(A)};
  slant::testing::allocation_guard guard;
  f.factor(A, A, whole_blocks{});
  auto const allocations = guard.count();
  CHECK(allocations == 0);
}

}  // namespace block_matrix_test
