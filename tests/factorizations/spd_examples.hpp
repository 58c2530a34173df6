// SPDX-License-Identifier: MIT
//
// Matrices to factor, and what every factorisation must do with them.
#pragma once

#include <slant/operators/inverse.hpp>

#include <support/testing.hpp>

namespace test {

/// Seven-point Laplacian of a k × k × k grid without boundary conditions (a floating body:
/// singular, constants are its kernel), plus `shift` times the identity.
template <class S = double>
Eigen::SparseMatrix<S> grid_laplacian(int k, double shift) {
  std::vector<Eigen::Triplet<S>> entries;
  int const n = k * k * k;
  auto const couple = [&](int i, int j) {
    entries.emplace_back(i, i, S(1));
    entries.emplace_back(j, j, S(1));
    entries.emplace_back(i, j, S(-1));
    entries.emplace_back(j, i, S(-1));
  };
  for (int i = 0; i < n; ++i) {
    entries.emplace_back(i, i, S(shift));
    if (i % k + 1 < k) couple(i, i + 1);
    if ((i / k) % k + 1 < k) couple(i, i + k);
    if (i + k * k < n) couple(i, i + k * k);
  }
  Eigen::SparseMatrix<S> m(n, n);
  m.setFromTriplets(entries.begin(), entries.end());
  return m;
}

/// Every entry of k times the same block.
inline Eigen::SparseMatrix<double> blown_up(Eigen::SparseMatrix<double> const& k,
                                            MatrixXd const& block) {
  auto const m = block.rows();
  Eigen::SparseMatrix<double> result(k.rows() * m, k.cols() * m);
  for (Eigen::Index j = 0; j < k.cols(); ++j) {
    for (Eigen::SparseMatrix<double>::InnerIterator e(k, j); e; ++e) {
      for (Eigen::Index at = 0; at < block.size(); ++at) {
        double const value = e.value() * block.data()[at];
        if (value != 0) result.coeffRef(e.row() * m + at % m, j * m + at / m) = value;
      }
    }
  }
  result.makeCompressed();
  return result;
}

template <class S = double>
Eigen::Matrix<S, Eigen::Dynamic, 1> load(slant::index n) {
  Eigen::Matrix<S, Eigen::Dynamic, 1> b(n);
  for (slant::index i = 0; i < n; ++i) b[i] = S(std::sin(1.0 + double(i)));
  return b;
}

/// ‖K x − b‖ / ‖b‖ for the x that the factorisation computes.
template <class F, class M>
auto residual(F const& factors, M const& k) {
  using S = typename M::Scalar;
  auto const b = load<S>(k.rows());
  Eigen::Matrix<S, Eigen::Dynamic, 1> x(k.rows());
  slant::apply(slant::inverse(factors), b, x);
  return S((k * x - b).norm() / b.norm());
}

/// The complaint about a matrix, or "nothing thrown".
template <class Factor, class M>
std::string complaint(Factor factor, M const& k) {
  return SLANT_COMPLAINT(factor(k));
}

/// Solutions in other units are the same numbers; bit for bit if the units are powers of two.
template <class Factor, class M>
void check_units(Factor factor, M const& k) {
  VectorXd const b = load(k.rows());
  VectorXd x(k.rows());
  slant::apply(slant::inverse(factor(k)), b, x);
  for (int const e : {-600, -331, -1, 7, 600}) {
    double const s = std::ldexp(1.0, e);
    M const scaled = k * s;
    VectorXd y(k.rows());
    slant::apply(slant::inverse(factor(scaled)), b, y);
    CHECK(VectorXd(y * s) == x);
  }
  for (double const s : {1e-150, 1e150, 1e-290, 1e290}) {
    M const scaled = k * s;
    VectorXd const small_load = s < 1 ? VectorXd(b * s) : b;
    VectorXd y(k.rows());
    slant::apply(slant::inverse(factor(scaled)), small_load, y);
    if (s > 1) y *= s;
    CHECK((y - x).norm() <= 1e-12 * x.norm());
  }
}

/// A solve names the argument whose size is wrong, and resizes nothing.
template <class F>
void check_sizes_of_solve(F const& factors) {
  slant::index const n = factors.rows();
  auto const message = [&](slant::index of_b, slant::index of_x, int columns) -> std::string {
    MatrixXd const b = MatrixXd::Ones(of_b, 2);
    MatrixXd x(of_x, columns);
    return test::complaint([&] {
      auto w = slant::workspace(factors, b);
      if constexpr (requires { factors.solve(b, x); }) {
        factors.solve(b, x);
      } else {
        factors.solve(b, x, w);
      }
    });
  };
  std::string const rest =
      " rows, expected " + std::to_string(n) + " (rows() of the factorisation)";
  CHECK(message(n, n, 2) == "nothing thrown");
  CHECK(message(n, 0, 2) == "x: got 0" + rest);
  CHECK(message(n - 1, n, 2) == "b: got " + std::to_string(n - 1) + rest);
  CHECK(message(n, n, 1) == "x: got 1 columns, expected 2 (one for each column of b)");
}

/// What is wrong with a matrix is said, with the entry or pivot and its value.
template <class Factor, class M>
void check_complaints(Factor factor, M const& definite, M const& singular) {
  auto const with = [&](int i, int j, double value) {
    M k = definite;
    k.coeffRef(i, j) = value;
    return complaint(factor, k);
  };
  CHECK(complaint(factor, definite) == "nothing thrown");
  CHECK(complaint(factor, M(definite.leftCols(2))) ==
        "K: got " + std::to_string(definite.rows()) + " x 2, expected a square operator");
  CHECK(with(1, 2, std::numeric_limits<double>::quiet_NaN()) ==
        "K(1, 2): got nan, expected a finite number");
  CHECK(with(3, 3, std::numeric_limits<double>::infinity()) ==
        "K(3, 3): got inf, expected a finite number");
  CHECK(contains(with(4, 5, 0.25), "expected a symmetric matrix, but K("));

  std::string const indefinite = with(6, 6, -2);
  CHECK(contains(indefinite, "K: got pivot "));
  CHECK(contains(indefinite, " = -"));
  CHECK(contains(indefinite, "expected a symmetric positive definite matrix"));
  CHECK(!contains(indefinite, "zero up to rounding"));

  // Its last pivot is pure rounding, of either sign.
  std::string const floating = complaint(factor, singular);
  CHECK(contains(floating, "K: got pivot " + std::to_string(singular.rows() - 1)));
  CHECK(contains(floating, "zero up to rounding"));
  CHECK(contains(complaint(factor, M(singular * 1e-150)), "zero up to rounding"));
  CHECK(contains(complaint(factor, M(singular * 1e150)), "zero up to rounding"));

  M zero = definite;
  zero *= 0.0;
  CHECK(contains(complaint(factor, zero), " = 0, zero up to rounding"));
}

}  // namespace test
