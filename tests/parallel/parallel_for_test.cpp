// SPDX-License-Identifier: MIT
//
// With OpenMP these tests run with one and with several threads, whose results must be the same to
// the last bit; without, they say that nothing depends on OpenMP.
#include <slant/operators/conjugate_projector.hpp>
#include <slant/operators/detail/parallel_for.hpp>
#include <slant/operators/diagonal_blocks.hpp>
#include <slant/operators/matrix.hpp>

#include <doctest/doctest.h>

#include <stdexcept>
#include <string>
#include <vector>

#include "operators/dense_oracle.hpp"
#ifdef _OPENMP
#include <omp.h>
#endif

namespace parallel_for_test {

using Eigen::VectorXd;

/// f with one thread, and with as many as there can be.
template <class F>
void with_threads(F f) {
#ifdef _OPENMP
  for (int const count : {1, 2, 5}) {
    omp_set_num_threads(count);
    f();
  }
#else
  f();
  f();
#endif
}

TEST_CASE("each round is run once; of several exceptions the first in order is thrown") {
  with_threads([] {
    std::vector<int> rounds(1000, 0);
    slant::detail::parallel_for(1000, 1'000'000,
                                [&](slant::index i) { ++rounds[static_cast<std::size_t>(i)]; });
    CHECK(rounds == std::vector<int>(1000, 1));
    std::string what;
    try {
      slant::detail::parallel_for(100, 1'000'000, [&](slant::index i) {
        if (i % 30 == 17) throw std::runtime_error(std::to_string(i));
      });
    } catch (std::runtime_error const& e) {
      what = e.what();
    }
    CHECK(what == "17");
  });
}

TEST_CASE("a projector of many bodies gives the same bits with any number of threads") {
  int const n = 60, bodies = 12;
  Eigen::SparseMatrix<double> k(n * bodies, n * bodies), u(n * bodies, (n - 4) * bodies);
  for (int b = 0; b < bodies; ++b) {
    Eigen::MatrixXd const block = test::random_spd(n, static_cast<unsigned>(b));
    for (int j = 0; j < n; ++j) {
      for (int i = 0; i < n; ++i) k.insert(n * b + i, n * b + j) = block(i, j);
    }
    for (int j = 0; j + 4 < n; ++j) u.insert(n * b + j, (n - 4) * b + j) = 1;
  }
  VectorXd const x = test::random_column(n * bodies, 3);
  VectorXd first, first_adjoint, first_minimum;
  with_threads([&] {
    auto const q = slant::conjugate_projector(k, u);
    CHECK(q.bodies() == bodies);
    auto w = slant::workspace(q, x);
    VectorXd y(x.size()), z(x.size()), m = VectorXd::Zero(x.size());
    q.apply(x, y, w);
    q.apply_adjoint(x, z, w);
    q.add_minimiser(1.0, x, m, w);
    if (first.size() == 0) {
      first = y;
      first_adjoint = z;
      first_minimum = m;
    }
    CHECK(y == first);
    CHECK(z == first_adjoint);
    CHECK(m == first_minimum);
  });
}

TEST_CASE("many blocks applied give the same bits with any number of threads") {
  slant::index const n = 40, count = 300;  // 24000 rows and columns: enough to wake threads
  std::vector<Eigen::MatrixXd> blocks;
  for (slant::index b = 0; b < count; ++b) {
    blocks.emplace_back(test::random_spd(n, static_cast<unsigned>(b)));
  }
  std::vector<decltype(slant::matrix(Eigen::MatrixXd()))> operators;
  for (auto const& block : blocks) operators.push_back(slant::matrix(Eigen::MatrixXd(block)));
  auto const a = slant::diagonal_blocks(std::move(operators));
  VectorXd const x = test::random_column(n * count, 5);
  VectorXd expected(x.size());
  for (slant::index b = 0; b < count; ++b) {
    expected.segment(n * b, n) = blocks[static_cast<std::size_t>(b)] * x.segment(n * b, n);
  }
  VectorXd first;
  with_threads([&] {
    auto w = slant::workspace(a, x);
    auto wt = slant::adjoint_workspace(a, x);
    VectorXd y(x.size()), z(x.size());
    a.apply(x, y, w);
    a.apply_adjoint(x, z, wt);
    CHECK((y - expected).norm() <= 1e-13 * expected.norm());
    CHECK((z - expected).norm() <= 1e-13 * expected.norm());  // the blocks are symmetric
    if (first.size() == 0) first = y;
    CHECK(y == first);
  });
}

}  // namespace parallel_for_test
