// SPDX-License-Identifier: MIT
#include <slant/factorizations/conjugate_projector.hpp>
#include <slant/iteration/solve.hpp>
#include <slant/krylov/krylov.hpp>
#include <slant/operators/counted.hpp>
#include <slant/testing/archetypes.hpp>

#include <support/testing.hpp>
#include "spd_matrices.hpp"

namespace range_cg_test {

using namespace test::evaluated;
namespace archetype = slant::testing::archetype;

/// The matrix as an operator that promises to be symmetric positive semidefinite.
template <class M>
auto psd(M&& m) {
  return slant::matrix<slant::self_adjoint, slant::positive_semidefinite>(std::forward<M>(m));
}
/// Orthonormal columns.
MatrixXd basis(Eigen::Index n, Eigen::Index m, unsigned seed) {
  return test::orthonormal(test::with_spectrum(VectorXd::LinSpaced(n, 1, double(n)), seed))
      .leftCols(m);
}
auto const stop = slant::residual_below(1e-12) || slant::at_most(200);

/// A lattice of springs without supports, every unknown joined to its neighbours in a ring and to
/// the one across it: the kernel is that of constant vectors.
MatrixXd ring(int n) {
  MatrixXd k = MatrixXd::Zero(n, n);
  auto const join = [&](int i, int j, double stiffness) {
    k(i, i) += stiffness;
    k(j, j) += stiffness;
    k(i, j) -= stiffness;
    k(j, i) -= stiffness;
  };
  for (int i = 0; i < n; ++i) join(i, (i + 1) % n, 1 + i % 5);
  for (int i = 0; i < n / 2; ++i) join(i, i + n / 2, 0.125);
  return k;
}

TEST_CASE("the minimum over the range of a semidefinite C") {
  MatrixXd const m = test::with_spectrum(test::log_spaced(30, 100));
  MatrixXd const v = basis(30, 12, 3);
  MatrixXd const c = v * VectorXd::LinSpaced(12, 0.5, 2).asDiagonal() * v.transpose();
  VectorXd const b = test::random_vector(30), x0 = test::random_vector(30, 5);
  auto const K = psd(m);
  auto const C = psd(MatrixXd((c + c.transpose()) / 2));
  auto const r = slant::solve(slant::range_cg{K, b, C}, x0, stop);
  REQUIRE(r.converged());
  VectorXd const y = test::solution_of(v.transpose() * m * v, v.transpose() * (b - m * x0));
  CHECK((r.x() - (x0 + v * y)).norm() <= 1e-11 * r.x().norm());
  CHECK(r.state.work.operator_applications <= r.iterations() + 2);  // start and refresh
  CHECK(r.state.projector_applications == 0);
}

TEST_CASE("with C = I and a definite K it is cg, bit for bit") {
  auto const A = test::spd(test::with_spectrum(test::log_spaced(20, 50)));
  VectorXd const b = test::random_vector(20);
  VectorXd const zero = VectorXd::Zero(20);
  auto const plain = slant::solve(slant::cg{A, b}, zero, slant::at_most(12));
  auto const range =
      slant::solve(slant::range_cg{A, b, slant::identity_operator(20)}, zero, slant::at_most(12));
  CHECK(plain.x() == range.x());
}

TEST_CASE("a semidefinite K: solvable, and unbounded with its direction") {
  int const n = 24;
  auto const K = psd(ring(n));
  auto const I = slant::identity_operator(n);
  VectorXd b = test::random_vector(n);
  b.array() -= b.mean();
  VectorXd const zero = VectorXd::Zero(n);
  auto const solvable = slant::solve(slant::range_cg{K, b, I}, zero, stop);
  CHECK(solvable.converged());
  CHECK((K.get() * solvable.x() - b).norm() <= 1e-12 * b.norm());

  for (double const push : {1.0, 1e-3, 1e-6}) {
    VectorXd const load = (b.array() + push).matrix();
    auto const r = slant::solve(slant::range_cg{K, load, I}, zero, slant::at_most(200));
    CHECK(r.status == slant::status::unbounded);
    CHECK(r.reason == "the function decreases for ever along `descent`");
    VectorXd const& d = r.state.descent;
    CHECK((K.get() * d).norm() <= 1e-14 * K.get().norm() * d.norm());
    CHECK(load.dot(d) > 0);
    CHECK((d.array() - d.mean()).matrix().norm() <= 1e-13 * d.norm());
  }

  // On a range that the kernel does not meet the same load has a minimum.
  MatrixXd held = MatrixXd::Identity(n, n);
  held(4, 4) = 0;
  VectorXd const load = (b.array() + 1).matrix();
  auto const fixed = slant::solve(slant::range_cg{K, load, psd(held)}, zero, stop);
  CHECK(fixed.converged());
  CHECK(fixed.x()[4] == 0);
}

TEST_CASE("kernels of small and of large stiffness, from the first step on") {
  for (double const scale : {1e-150, 1.0, 1e150}) {
    // A stiff body beside a soft one, the soft one free; the load moves it as a whole.
    MatrixXd k = MatrixXd::Zero(6, 6);
    k.topLeftCorner(3, 3) = 1e9 * (2 * MatrixXd::Identity(3, 3) + MatrixXd::Ones(3, 3));
    k.bottomRightCorner(3, 3) = 3 * MatrixXd::Identity(3, 3) - MatrixXd::Ones(3, 3);
    auto const K = psd(MatrixXd(scale * k));
    VectorXd const load = scale * VectorXd{{0, 0, 0, 1, 1, 1}};
    auto const r = slant::solve(slant::range_cg{K, load, slant::identity_operator(6)},
                                test::zeros(6), slant::at_most(20));
    CHECK(r.status == slant::status::unbounded);
    VectorXd const d = r.state.descent.normalized();
    CHECK((d - VectorXd{{0, 0, 0, 1, 1, 1}} / std::sqrt(3)).norm() <= 1e-13);
  }
}

TEST_CASE("projector preconditioning: the same minimum, sooner; one product and one Q a step") {
  int const n = 200;
  MatrixXd k = ring(n);
  k(0, 0) += 1;
  Eigen::SparseMatrix<double> const sparse = k.sparseView();
  std::vector<int> inside;
  for (int i = 0; i < n; ++i)
    if (i % 10 != 0) inside.push_back(i);
  Eigen::SparseMatrix<double> u(n, static_cast<int>(inside.size()));
  for (int j = 0; j < u.cols(); ++j) u.insert(inside[static_cast<std::size_t>(j)], j) = 1;
  auto const Q = slant::conjugate_projector(sparse, u);
  auto const K = slant::counted(psd(sparse));
  auto const I = slant::identity_operator(n);
  VectorXd const b = test::random_vector(n);
  VectorXd const exact = k.llt().solve(b);
  VectorXd const zero = VectorXd::Zero(n);
  auto const accurate = slant::residual_below(1e-12) || slant::at_most(2000);

  auto const plain = slant::solve(slant::range_cg{K, b, I}, zero, accurate);
  K.reset_counts();
  auto const quick = slant::solve(slant::range_cg{K, b, I, Q}, zero, accurate);
  REQUIRE(plain.converged());
  REQUIRE(quick.converged());
  CHECK((plain.x() - exact).norm() <= 1e-9 * exact.norm());
  CHECK((quick.x() - exact).norm() <= 1e-9 * exact.norm());
  // No more steps than there are unknowns outside U; without the projector many times as many.
  CHECK(quick.iterations() <= 22);
  CHECK(plain.iterations() >= 4 * quick.iterations());
  CHECK(quick.state.projector_applications == quick.iterations() + 1);
  CHECK(K.applications() == quick.state.work.operator_applications);
  CHECK(K.applications() <= quick.iterations() + 2);  // the first residual and refresh
}

TEST_CASE("a soft mode beside a kernel hides neither") {
  MatrixXd k = MatrixXd::Zero(4, 4);
  k.bottomRightCorner(2, 2) << 1, -1, -1, 1;
  for (double const soft : {1e-9, 1e-10, 1e-12}) {
    for (double const push : {0.3, 1e-3, 3.0}) {
      CAPTURE(soft);
      CAPTURE(push);
      k.topLeftCorner(2, 2) << 1 + soft, -1, -1, 1 + soft;
      VectorXd const load{{1, 1, push, push}};
      auto const K = psd(k);
      auto const r = slant::solve(slant::range_cg{K, load, slant::identity_operator(4)},
                                  test::zeros(4), slant::at_most(50));
      CAPTURE(r.reason);
      REQUIRE(r.status == slant::status::unbounded);
      VectorXd const d = r.state.descent.normalized();
      CHECK((d - VectorXd{{0, 0, 1, 1}} / std::sqrt(2)).norm() <= 1e-6);
    }
  }
}

TEST_CASE("without a diagonal nothing soft is taken for a kernel") {
  // Two bodies held by the first, 15 orders of magnitude apart.
  MatrixXd k = MatrixXd::Zero(4, 4);
  k.topLeftCorner(2, 2) << 2, -1, -1, 1;
  k.bottomRightCorner(2, 2) << 2e-15, -1e-15, -1e-15, 1e-15;
  VectorXd const b{{1, 1, 1, 1}};
  VectorXd const zero = VectorXd::Zero(4);
  auto const I = slant::identity_operator(4);
  auto const K = psd(k);
  auto const known = slant::solve(slant::range_cg{K, b, I}, zero, stop);
  REQUIRE(known.converged());
  CHECK((known.x() - VectorXd{{2, 3, 2e15, 3e15}}).norm() <= 1e-9 * 3e15);
  archetype::psd_operator const A(k);
  archetype::psd_operator const C(MatrixXd(MatrixXd::Identity(4, 4)));
  auto const r =
      slant::solve(slant::range_cg{A, archetype::vector(b), C}, archetype::vector(zero), stop);
  CHECK(r.status == slant::status::stalled);
  CHECK(r.reason.ends_with("K gives no diagonal"));
}

TEST_CASE("a projector beside the range is found out where that can be seen") {
  MatrixXd const k{{2, -1, 0}, {-1, 2, -1}, {0, -1, 2}};
  Eigen::SparseMatrix<double> const sparse = k.sparseView();
  Eigen::SparseMatrix<double> u(3, 1);
  u.insert(0, 0) = 1;
  auto const Q = slant::conjugate_projector(sparse, u);
  VectorXd const b = VectorXd::Ones(3);
  VectorXd const zero = VectorXd::Zero(3);
  for (Eigen::Index const held : {0, 2}) {
    MatrixXd c = MatrixXd::Identity(3, 3);
    c(held, held) = 0;
    auto const C = slant::matrix<slant::self_adjoint, slant::projector>(c);
    auto const K = psd(sparse);
    slant::range_cg const method{K, b, C, Q};
    if (held == 0) {
      CHECK_THROWS_WITH_AS((void)method.start(zero),
                           "Q: got range(U) not in range(C): it moves x0 by y with C y != y, "
                           "expected a U within range(C)",
                           slant::bad_input);
    } else {
      auto const r = slant::solve(method, zero, stop);
      REQUIRE(r.converged());
      CHECK((r.x() - VectorXd{{1, 1, 0}}).norm() <= 1e-14);
    }
  }
}

TEST_CASE("no allocation; archetypes; data that do not fit") {
  MatrixXd const m = ring(8);
  auto const K = psd(m);
  auto const I = slant::identity_operator(8);
  VectorXd const b = VectorXd::LinSpaced(8, -1, 1);
  slant::range_cg const method{K, b, I};
  auto s = method.start(test::zeros(8));
  slant::testing::allocation_guard guard;
  for (int i = 0; i < 5; ++i) method.step(s);
  method.refresh(s);
  auto const allocations = guard.count();
  CHECK(allocations == 0);

  archetype::psd_operator const A(m);
  archetype::psd_operator const C(MatrixXd(MatrixXd::Identity(8, 8)));
  archetype::vector const right(b), start(test::zeros(8));
  auto const r = slant::solve(slant::range_cg{A, right, C}, start, stop);
  CHECK(r.converged());
  CHECK((m * r.x().local() - b).norm() <= 1e-12 * b.norm());
  archetype::vector const push(VectorXd(VectorXd::Ones(8)));
  auto const u = slant::solve(slant::range_cg{A, push, C}, start, stop);
  CHECK(u.status == slant::status::unbounded);

  CHECK_THROWS_AS((slant::range_cg{K, b, slant::identity_operator(7)}), slant::bad_input);
}

}  // namespace range_cg_test
