// SPDX-License-Identifier: MIT
//
// The Krylov methods ask their archetypes for nothing more than the concepts name, compute with a
// scalar that converts to no other number silently, and do not allocate between the first step and
// the last.
#include <slant/factorizations/dense_ldlt.hpp>
#include <slant/iteration/solve.hpp>
#include <slant/krylov/krylov.hpp>
#include <slant/operators/operators.hpp>
#include <slant/testing/archetypes.hpp>

#include <support/testing.hpp>
#include "spd_matrices.hpp"

namespace krylov_test {

namespace archetype = slant::testing::archetype;

MatrixXd const M = test::with_spectrum(test::log_spaced(6, 10));
VectorXd const solution = test::random_vector(6);
archetype::vector const b(M* solution);
archetype::vector const zero(test::zeros(6));
auto const stop = slant::residual_below(1e-13) || slant::at_most(100);

TEST_CASE("cg, also with a preconditioner") {
  archetype::spd_operator const A(M);
  archetype::spd_operator const inverse(M.inverse());
  auto const plain = slant::solve(slant::cg{A, b}, zero, stop);
  CHECK((plain.x().local() - solution).norm() <= 1e-11);
  auto const preconditioned = slant::solve(slant::cg{A, b, inverse}, zero, stop);
  CHECK((preconditioned.x().local() - solution).norm() <= 1e-11);
  CHECK(preconditioned.iterations() <= 2);
}

TEST_CASE("bicgstab") {
  archetype::linear_operator const A(M);
  auto const r = slant::solve(slant::bicgstab{A, b}, zero, stop);
  CHECK((r.x().local() - solution).norm() <= 1e-11);
}

TEST_CASE("spectral bound") {
  archetype::psd_operator const A(M);
  auto const bound = slant::largest_eigenvalue_bound(A, b);
  CHECK(bound.upper >= 1);
  CHECK(bound.upper <= 1 + 1e-12);
}

TEST_CASE("a scalar without silent conversions") {
  using S = archetype::scalar;
  using vector = Eigen::Matrix<S, Eigen::Dynamic, 1>;
  test::dense<S> const strict = M.cast<S>();
  vector const right = b.local().cast<S>();
  vector const start = vector::Zero(6);
  auto const A = test::spd(strict);
  auto const rule = slant::residual_below(S(1e-13)) || slant::at_most(100);
  auto const check = [&](vector const& x) {
    VectorXd const values = x.unaryExpr([](auto const& x_i) { return x_i.value(); });
    CHECK((values - solution).norm() <= 1e-11);
  };
  check(slant::solve(slant::cg{A, right}, start, rule).x());
  check(slant::solve(slant::bicgstab{A, right}, start, rule).x());
  CHECK(slant::largest_eigenvalue_bound(A, right).upper >= S(1));
}

template <class Method>
std::size_t allocations_of(Method const& method, VectorXd const& x0, int steps) {
  auto s = method.start(x0);
  slant::testing::allocation_guard guard;
  for (int k = 0; k < steps; ++k) method.step(s);
  auto const count = guard.count();
  CHECK(s.iteration == steps);
  return count;
}

TEST_CASE("cg, preconditioned cg and bicgstab do not allocate") {
  auto const stiff = test::with_spectrum(test::log_spaced(40, 1e4));
  auto const K = slant::dense_ldlt(test::with_spectrum(test::log_spaced(60, 100), 3));
  MatrixXd const B = test::random_vector(40 * 60, 4).reshaped(40, 60);
  auto const plain = test::spd(stiff);
  auto const A = slant::sum(plain, slant::congruence(B, slant::inverse(K)));
  auto const preconditioner = slant::scaled(slant::positive(0.5), plain);
  VectorXd const load = test::random_vector(40), x0 = test::random_vector(40, 8);
  CHECK(allocations_of(slant::cg{A, load}, x0, 20) == 0);
  CHECK(allocations_of(slant::cg{A, load, preconditioner}, x0, 20) == 0);
  CHECK(allocations_of(slant::bicgstab{A, load}, x0, 20) == 0);
}

}  // namespace krylov_test
