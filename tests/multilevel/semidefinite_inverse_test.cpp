// SPDX-License-Identifier: MIT
#include <slant/multilevel/parts/dense_factor.hpp>
#include <support/testing.hpp>

namespace semidefinite_inverse_test {

using slant::detail::invert_semidefinite;

/// B Bᵀ with B of N × rank pseudo-random entries.
template <int N>
Eigen::Matrix<double, N, N> gram(int rank) {
  MatrixXd B(N, rank);
  unsigned random = 3;
  for (int k = 0; k < B.size(); ++k) {
    random = random * 1664525u + 1013904223u;
    B.data()[k] = double(random) / 4294967296.0 - 0.5;
  }
  return B * B.transpose();
}

template <int N>
void check() {
  using matrix = Eigen::Matrix<double, N, N>;
  double const ε = 1e-12;
  for (int rank = 0; rank <= N; ++rank) {
    matrix const a = gram<N>(rank);
    matrix x = a;
    double least[N], scale[N];
    for (int c = 0; c < N; ++c) {
      scale[c] = a(c, c);
      least[c] = ε * a(c, c);
    }
    double const lowest = invert_semidefinite<N>(x.data(), least, scale);
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

TEST_CASE("inverses of principal submatrices, of any rank") {
  check<1>();
  check<2>();
  check<3>();
  check<6>();
}

TEST_CASE("unknowns below their limit are left out, negative pivots are told") {
  Eigen::Matrix3d a = Vector3d(4, 1e-9, 2).asDiagonal();
  a(0, 2) = a(2, 0) = 1;
  double const least[] = {0, 1e-6, 0}, scale[] = {4, 1, 2};
  Eigen::Matrix3d x = a;
  CHECK(invert_semidefinite<3>(x.data(), least, scale) == doctest::Approx(1e-9));
  Eigen::Matrix3d expected = Eigen::Matrix3d::Zero();
  expected(0, 0) = 2 / 7.0;
  expected(2, 2) = 4 / 7.0;
  expected(0, 2) = expected(2, 0) = -1 / 7.0;
  CHECK((x - expected).norm() <= 1e-15);
  a(0, 2) = a(2, 0) = 4;
  CHECK(invert_semidefinite<3>(a.data(), least, scale) == doctest::Approx(-1));
}

}  // namespace semidefinite_inverse_test
