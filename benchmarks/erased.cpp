// SPDX-License-Identifier: MIT
//
// What a method costs on a program whose types are forgotten, beside the same method instantiated
// for them: a membrane of n = 1000 unknowns with half lines, intervals and discs, whose products
// are cheap, so that everything else shows.
//
//     erased METHOD-templated|METHOD-erased REPETITIONS
//
// solves that often and prints steps, products and the sum of the solution. benchmarks/erased.sh
// counts the instructions of a solve as the difference of two runs, in which the set-up cancels.

#include <slant/iteration/solve.hpp>
#include <slant/methods/interior_point.hpp>
#include <slant/methods/kprgp.hpp>
#include <slant/methods/symmetric_newton.hpp>
#include <slant/operators/matrix.hpp>
#include <slant/problems/any_qp.hpp>
#include <slant/sets/cartesian.hpp>
#include <slant/sets/contact_sets.hpp>

#include <Eigen/SparseCore>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

namespace {

using sparse = Eigen::SparseMatrix<double>;

/// Tridiagonal, of condition about 400.
sparse chain(int n) {
  std::vector<Eigen::Triplet<double>> entries;
  for (int i = 0; i < n; ++i) {
    entries.emplace_back(i, i, 2.01);
    if (i + 1 < n) {
      entries.emplace_back(i, i + 1, -1.0);
      entries.emplace_back(i + 1, i, -1.0);
    }
  }
  sparse m(n, n);
  m.setFromTriplets(entries.begin(), entries.end());
  return m;
}

template <class Method>
int repeat(Method const& method, Eigen::VectorXd const& x0, int repetitions) {
  auto const stop = slant::reduced_gradient_below(1e-8) || slant::at_most(5000);
  for (int i = 0; i < repetitions; ++i) {
    auto const run = slant::solve(method, x0, stop);
    if (i == 0) {
      std::printf("%td %td %.17g\n", run.iterations(), run.state.work.operator_applications,
                  run.x().sum());
    }
    if (!run.converged()) return 1;
  }
  return 0;
}

template <class QP>
int solve(std::string const& method, QP const& qp, Eigen::VectorXd const& x0, int repetitions) {
  if (method == "kprgp") return repeat(slant::kprgp{qp}, x0, repetitions);
  if (method == "symmetric_newton") {
    return repeat(slant::symmetric_newton{qp}, x0, repetitions);
  }
  if (method == "interior_point") {
    return repeat(slant::interior_point{qp}, x0, repetitions);
  }
  return 2;
}

}  // namespace

int main(int argc, char** argv) {
  std::string const name = argc > 1 ? argv[1] : "";
  int const repetitions = argc > 2 ? std::atoi(argv[2]) : 0;
  auto const cut = name.rfind('-');
  if (cut == std::string::npos || repetitions < 1) {
    std::fprintf(stderr, "usage: erased METHOD-templated|METHOD-erased REPETITIONS\n");
    return 2;
  }
  int const n = 1000, m = n / 4;
  sparse const K = chain(n);
  Eigen::VectorXd b(n), g(m);
  for (int i = 0; i < n; ++i) b[i] = std::sin(0.05 * i) + 0.3 * std::cos(0.9 * i);
  for (int i = 0; i < m; ++i) g[i] = 0.5 + 0.4 * std::sin(0.1 * i);
  auto const A = slant::matrix<slant::self_adjoint, slant::positive_definite>(K);
  auto const set = slant::cartesian(slant::half_lines(m), slant::intervals(g), slant::discs(g));
  slant::separable_qp const qp{A, b, set};
  Eigen::VectorXd const x0 = Eigen::VectorXd::Zero(n);
  std::string const method = name.substr(0, cut), kind = name.substr(cut + 1);
  if (kind == "templated") return solve(method, qp, x0, repetitions);
  auto const forgotten = slant::erased(qp);
  return solve(method, forgotten, x0, repetitions);
}
