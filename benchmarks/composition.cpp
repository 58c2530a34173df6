// SPDX-License-Identifier: MIT
//
// What composing operators costs, against the loop one would write by hand for the same y = A x.
//
//     composition CASE REPETITIONS
//
// applies one version of one case that often and prints the sum of the result, so that the versions
// can be seen to agree. benchmarks/composition.sh counts the instructions of an application as
// the difference of two runs, in which the set-up cancels.

#include <slant/factorizations/ldlt.hpp>
#include <slant/operators/inverse.hpp>
#include <slant/operators/operators.hpp>
#include <slant/operators/product.hpp>
#include <slant/operators/sum.hpp>

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <random>
#include <string>
#include <vector>

namespace {

using sparse = Eigen::SparseMatrix<double>;
using vector = Eigen::VectorXd;

/// Five-point Laplacian of a k × k grid.
sparse laplacian(int k) {
  std::vector<Eigen::Triplet<double>> entries;
  for (int i = 0; i < k * k; ++i) {
    entries.emplace_back(i, i, 4.0);
    if (i % k + 1 < k) {
      entries.emplace_back(i, i + 1, -1.0);
      entries.emplace_back(i + 1, i, -1.0);
    }
    if (i + k < k * k) {
      entries.emplace_back(i, i + k, -1.0);
      entries.emplace_back(i + k, i, -1.0);
    }
  }
  sparse m(k * k, k * k);
  m.setFromTriplets(entries.begin(), entries.end());
  return m;
}

/// A matrix with the given number of entries in each row, at random places.
sparse random_sparse(int rows, int cols, int per_row, unsigned seed) {
  std::mt19937 generator(seed);
  std::uniform_int_distribution<int> column(0, cols - 1);
  std::uniform_real_distribution<double> value(-1.0, 1.0);
  std::vector<Eigen::Triplet<double>> entries;
  for (int i = 0; i < rows; ++i) {
    for (int j = 0; j < per_row; ++j) entries.emplace_back(i, column(generator), value(generator));
  }
  sparse m(rows, cols);
  m.setFromTriplets(entries.begin(), entries.end());
  return m;
}

vector start(Eigen::Index n) {
  return vector::LinSpaced(n, -1.0, 1.0);
}

template <class Operator>
double composed(Operator const& a, Eigen::Index n, long repetitions) {
  vector x = start(n);
  vector y(n);
  auto w = slant::workspace(a, x);
  double total = 0;
  for (long k = 0; k < repetitions; ++k) {
    slant::apply(a, x, y, w);
    x[0] += 1e-3 * y[0];
    total = y.sum();
  }
  return total;
}

struct congruence_case {
  sparse K = laplacian(60);
  sparse B = random_sparse(240, 3600, 3, 1);

  double by_hand(long repetitions) const {
    Eigen::SimplicialLDLT<sparse> const factors(K);
    vector const pivots = factors.vectorD();
    vector x = start(B.rows());
    vector y(B.rows());
    vector before(B.cols());
    vector z(B.cols());
    vector after(B.cols());
    double total = 0;
    for (long k = 0; k < repetitions; ++k) {
      before.noalias() = B.transpose() * x;
      z.noalias() = factors.permutationP() * before;
      factors.matrixL().solveInPlace(z);
      z.array() /= pivots.array();
      factors.matrixU().solveInPlace(z);
      after.noalias() = factors.permutationPinv() * z;
      y.noalias() = B * after;
      x[0] += 1e-3 * y[0];
      total = y.sum();
    }
    return total;
  }
  double by_composition(long repetitions) const {
    return composed(slant::congruence(B, slant::inverse(slant::ldlt(K))), B.rows(), repetitions);
  }
  double by_expression(long repetitions) const {
    auto const b = slant::op<"B">(B);
    auto const kinv = inverse(slant::op<"K">(slant::ldlt(K)));
    return composed(b * kinv * adjoint(b), B.rows(), repetitions);
  }
};

/// Five products of a tall and a wide matrix.
struct sum_case {
  static constexpr int n = 400;
  static constexpr int between = 300;
  std::array<sparse, 5> A;
  std::array<sparse, 5> B;

  sum_case() {
    for (unsigned i = 0; i < 5; ++i) {
      A[i] = random_sparse(n, between, 4, 10 + i);
      B[i] = random_sparse(between, n, 4, 20 + i);
    }
  }
  double by_hand(long repetitions) const {
    vector x = start(n);
    vector y(n);
    vector t(between);
    double total = 0;
    for (long k = 0; k < repetitions; ++k) {
      t.noalias() = B[0] * x;
      y.noalias() = A[0] * t;
      for (unsigned i = 1; i < 5; ++i) {
        t.noalias() = B[i] * x;
        y.noalias() += A[i] * t;
      }
      x[0] += 1e-3 * y[0];
      total = y.sum();
    }
    return total;
  }
  double by_composition(long repetitions) const {
    return composed(slant::sum(slant::product(A[0], B[0]), slant::product(A[1], B[1]),
                               slant::product(A[2], B[2]), slant::product(A[3], B[3]),
                               slant::product(A[4], B[4])),
                    n, repetitions);
  }
  double by_expression(long repetitions) const {
    auto const a = [this](int i) { return +slant::matrix(A[i]); };
    auto const b = [this](int i) { return +slant::matrix(B[i]); };
    return composed(a(0) * b(0) + a(1) * b(1) + a(2) * b(2) + a(3) * b(3) + a(4) * b(4), n,
                    repetitions);
  }
};

}  // namespace

int main(int argc, char** argv) {
  std::string const name = argc == 3 ? argv[1] : "";
  long const repetitions = argc == 3 ? std::atol(argv[2]) : 0;
  double total = 0;
  if (name == "congruence-hand") {
    total = congruence_case().by_hand(repetitions);
  } else if (name == "congruence-slant") {
    total = congruence_case().by_composition(repetitions);
  } else if (name == "congruence-expression") {
    total = congruence_case().by_expression(repetitions);
  } else if (name == "sum-hand") {
    total = sum_case().by_hand(repetitions);
  } else if (name == "sum-slant") {
    total = sum_case().by_composition(repetitions);
  } else if (name == "sum-expression") {
    total = sum_case().by_expression(repetitions);
  } else {
    std::cerr << "usage: composition congruence|sum-hand|slant|expression N\n";
    return 2;
  }
  std::printf("%.17g\n", total);
  return 0;
}
