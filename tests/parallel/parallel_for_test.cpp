// SPDX-License-Identifier: MIT
//
// With OpenMP these tests run with one and with several threads, whose results must be the same to
// the last bit; without, they say that nothing depends on OpenMP.
#include <slant/base/parallel_for.hpp>
#include <slant/contact/bodies.hpp>
#include <slant/factorizations/conjugate_projector.hpp>
#include <slant/iteration/solve.hpp>
#include <slant/methods/schur_contact.hpp>
#include <slant/operators/block_diagonal.hpp>
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

#ifdef _OPENMP
TEST_CASE("with OpenMP there are several threads to compare") {
  omp_set_num_threads(5);
  CHECK(omp_get_max_threads() > 1);
  int together = 0;
#pragma omp parallel reduction(+ : together)
  together += 1;
  CHECK(together > 1);
}
#endif

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
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i) k.insert(n * b + i, n * b + j) = block(i, j);
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

TEST_CASE("a whole contact problem gives the same bits with any number of threads") {
  // Chains of springs between each other, of which the ends may touch: 40 bodies of 30 unknowns,
  // some of them free.
  int const n = 30, count = 40;
  std::vector<Eigen::Triplet<double>> entries, contacts;
  for (int i = 0; i < n * count; ++i) {
    if (i % n == 0 && i / n % 3 == 0) entries.emplace_back(i, i, 0.5);
    if (i % n == n - 1) {
      contacts.emplace_back(i / n, i, 1);
      if (i + 1 < n * count) contacts.emplace_back(i / n, i + 1, -1);
      continue;
    }
    double const stiffness = 1 + i % 7;
    entries.emplace_back(i, i, stiffness);
    entries.emplace_back(i + 1, i + 1, stiffness);
    entries.emplace_back(i, i + 1, -stiffness);
    entries.emplace_back(i + 1, i, -stiffness);
  }
  Eigen::SparseMatrix<double> K(n * count, n * count), B(count, n * count);
  K.setFromTriplets(entries.begin(), entries.end());
  B.setFromTriplets(contacts.begin(), contacts.end());
  VectorXd const f = (VectorXd::LinSpaced(n * count, 0, 90).array().sin() + 0.3).matrix();
  VectorXd const c = VectorXd::LinSpaced(count, 0, 2);
  VectorXd first, first_forces;
  with_threads([&] {
    slant::contact::bodies<double> const bodies(K, f, B, c);
    auto const qp = bodies.qp();
    auto const r = slant::solve(slant::schur_contact{qp}, bodies.zero(),
                                slant::residual_below(1e-10) || slant::at_most(2000));
    REQUIRE(r.converged());
    if (first.size() == 0) {
      first = bodies.displacement(r.x());
      first_forces = r.state.multipliers();
      CHECK(first_forces.maxCoeff() > 0);
    }
    CHECK(bodies.displacement(r.x()) == first);
    CHECK(r.state.multipliers() == first_forces);
  });
}

TEST_CASE("many blocks applied give the same bits with any number of threads") {
  slant::index const n = 40, count = 300;  // 24000 rows and columns: enough to wake threads
  std::vector<Eigen::MatrixXd> blocks;
  for (slant::index b = 0; b < count; ++b)
    blocks.emplace_back(test::random_spd(n, static_cast<unsigned>(b)));
  std::vector<decltype(slant::matrix(Eigen::MatrixXd()))> operators;
  for (auto const& block : blocks) operators.push_back(slant::matrix(Eigen::MatrixXd(block)));
  auto const a = slant::diagonal_blocks(std::move(operators));
  VectorXd const x = test::random_column(n * count, 5);
  VectorXd expected(x.size());
  for (slant::index b = 0; b < count; ++b)
    expected.segment(n * b, n) = blocks[static_cast<std::size_t>(b)] * x.segment(n * b, n);
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
