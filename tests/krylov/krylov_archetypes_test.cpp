// SPDX-License-Identifier: MIT
//
// The Krylov methods ask their archetypes for nothing more than the concepts name, and compute with
// a scalar that converts to no other number silently.
#include <slant/iteration/solve.hpp>
#include <slant/krylov/krylov.hpp>
#include <slant/testing/archetypes.hpp>

#include <support/testing.hpp>
#include "spd_matrices.hpp"

namespace krylov_archetypes_test {

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

}  // namespace krylov_archetypes_test
