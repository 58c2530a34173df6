// SPDX-License-Identifier: MIT
//
// What the tests of slanting functions share: F°(y) as a dense matrix, a check of what may not
// allocate, and reproducible data.
#pragma once

#include <slant/concepts/slanting_function.hpp>

#include <support/testing.hpp>

namespace slanting_support {

/// The operator as a matrix, column by column; y shows the kind of vector.
template <class G, class V>
[[nodiscard]] auto dense(G const& g, V const& y) {
  using S = slant::scalar_t<V>;
  Eigen::Matrix<S, Eigen::Dynamic, Eigen::Dynamic> m(g.rows(), g.cols());
  auto x = slant::like(y, g.cols());
  auto gx = slant::like(y, g.rows());
  for (slant::index j = 0; j < g.cols(); ++j) {
    slant::local(x).setZero();
    slant::local(x)[j] = S(1);
    slant::apply(g, x, gx);
    m.col(j) = slant::local(gx);
  }
  return m;
}

/// F°(y) as a matrix.
template <class F, class V>
[[nodiscard]] auto dense_slant(F const& f, V const& y) {
  return dense(f.slant(y), y);
}

/// The value, F°(y) renewed and its application allocate nothing; renewed it is as made anew.
template <class F>
void check_renewal(F const& f, VectorXd const& y) {
  VectorXd v(f.rows()), x(f.rows());
  auto w = slant::workspace(f, y);
  auto g = f.slant(VectorXd::Zero(f.cols()).eval());
  auto gw = slant::workspace(g, y);
  slant::testing::allocation_guard const guard;
  slant::evaluate(f, y, v, w);
  slant::update_slant(f, y, g, w);
  slant::update_slant_after_value(f, y, g, w);
  slant::apply(g, y, x, gw);
  auto const allocations = guard.count();
  CHECK(allocations == 0);
  CHECK(dense(g, y) == dense_slant(f, y));
}

/// Of A, a value costs one application, the slant after it none, and each product by the slant one;
/// nothing allocates.
template <class F, class A>
void check_products(F const& f, A const& a, VectorXd const& y) {
  VectorXd v(f.rows()), x(f.rows());
  auto w = slant::workspace(f, y);
  auto g = f.slant(VectorXd::Zero(f.cols()).eval());
  auto gw = slant::workspace(g, y);
  a.reset_counts();
  slant::testing::allocation_guard const guard;
  slant::evaluate(f, y, v, w);
  auto const for_value = a.applications();
  slant::update_slant_after_value(f, y, g, w);
  auto const for_both = a.applications();
  slant::apply(g, y, x, gw);
  auto const allocations = guard.count();
  CHECK(allocations == 0);
  CHECK(for_value == 1);
  CHECK(for_both == 1);
  CHECK(a.applications() == 2);
  CHECK(dense(g, y) == dense_slant(f, y));
}

/// n numbers in [−1, 1].
[[nodiscard]] inline VectorXd random_vector(slant::index n, unsigned seed) {
  std::mt19937 engine(seed);
  std::uniform_real_distribution<double> number(-1, 1);
  return VectorXd::NullaryExpr(n, [&] { return number(engine); });
}

[[nodiscard]] inline MatrixXd random_matrix(slant::index m, slant::index n, unsigned seed) {
  return random_vector(m * n, seed).reshaped(m, n);
}

/// A well-conditioned symmetric positive definite matrix.
[[nodiscard]] inline MatrixXd random_spd(slant::index n, unsigned seed) {
  using namespace test::evaluated;
  MatrixXd const b = random_matrix(n, n, seed);
  return b * b.transpose() + MatrixXd::Identity(n, n);
}

/// A⁻¹ b by Gaussian elimination with row pivoting. Eigen's decompositions take seconds to compile
/// for each scalar.
template <class S>
[[nodiscard]] Eigen::Matrix<S, Eigen::Dynamic, 1> solve(
    Eigen::Matrix<S, Eigen::Dynamic, Eigen::Dynamic> a, Eigen::Matrix<S, Eigen::Dynamic, 1> b) {
  using std::abs;
  auto const n = a.rows();
  for (Eigen::Index k = 0; k < n; ++k) {
    Eigen::Index pivot = k;
    for (Eigen::Index i = k + 1; i < n; ++i)
      if (abs(a(i, k)) > abs(a(pivot, k))) pivot = i;
    for (Eigen::Index j = k; j < n; ++j) std::swap(a(k, j), a(pivot, j));
    std::swap(b[k], b[pivot]);
    for (Eigen::Index i = k + 1; i < n; ++i) {
      S const factor = a(i, k) / a(k, k);
      for (Eigen::Index j = k; j < n; ++j) a(i, j) -= factor * a(k, j);
      b[i] -= factor * b[k];
    }
  }
  for (Eigen::Index k = n; k-- > 0;) {
    for (Eigen::Index j = k + 1; j < n; ++j) b[k] -= a(k, j) * b[j];
    b[k] /= a(k, k);
  }
  return b;
}

}  // namespace slanting_support
