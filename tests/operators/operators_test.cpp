// SPDX-License-Identifier: MIT
//
// All operators together: every scalar, lifetimes of nested compositions, and no allocation.
#include <slant/factorizations/ldlt.hpp>
#include <slant/operators/operators.hpp>
#include <slant/testing/archetypes.hpp>
#include <slant/testing/laws.hpp>

#include <oracle/precise.hpp>
#include <slanting/slanting_support.hpp>
#include <support/testing.hpp>
#include "operators/dense_oracle.hpp"

namespace operators_test {

using namespace test::evaluated;

/// A composition made from temporaries that are long gone when it is applied.
template <class S>
auto composition(Eigen::SparseMatrix<S> const& b, test::dense<S> const& k) {
  auto dual = slant::congruence(b, slant::inverse(slant::ldlt<S>(k.sparseView())));
  auto shift = slant::scaled(slant::positive(S(2)), slant::identity(b.rows()));
  auto d = slant::diagonal(test::column<S>::LinSpaced(b.rows(), S(0), S(1)));
  return slant::block(
      slant::block_row(slant::sum(std::move(dual), std::move(shift), std::move(d)),
                       slant::product(b, slant::adjoint(b))),
      slant::block_row(slant::zero(b.rows()), slant::restricted(k, std::vector<int>{2, 0, 4})));
}

template <class S>
test::dense<S> composition_dense(test::dense<S> const& b, test::dense<S> const& k,
                                 test::dense<S> const& k_inverse) {
  auto const m = b.rows();
  test::dense<S> a = test::dense<S>::Zero(2 * m, 2 * m);
  a.topLeftCorner(m, m) = b * k_inverse * b.transpose();
  a.topLeftCorner(m, m).diagonal() +=
      test::column<S>::Constant(m, S(2)) + test::column<S>::LinSpaced(m, S(0), S(1));
  a.topRightCorner(m, m) = b * b.transpose();
  int const components[] = {2, 0, 4};
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) a(m + i, m + j) = k(components[i], components[j]);
  return a;
}

/// K⁻¹, for any scalar.
template <class S>
test::dense<S> inverse_of(test::dense<S> const& k) {
  auto const n = k.rows();
  test::dense<S> const id = test::dense<S>::Identity(n, n);
  test::dense<S> inverse(n, n);
  for (slant::index j = 0; j < n; ++j) inverse.col(j) = slanting_support::solve<S>(k, id.col(j));
  return inverse;
}

TEST_CASE("another scalar") {
  using S = oracle::float_50;
  test::dense<S> const k = test::random_spd<S>(5, 1);
  Eigen::SparseMatrix<S> const b = test::random_sparse<S>(3, 5, 2);
  auto const a = composition<S>(b, k);
  CHECK(test::matches(a, composition_dense<S>(b, k, inverse_of<S>(k)), 1000));
}

TEST_CASE("no allocation once the workspace exists") {
  test::dense<double> const k = test::random_spd(5, 1);
  Eigen::SparseMatrix<double> const b = test::random_sparse(3, 5, 2);
  auto const a = composition<double>(b, k);
  VectorXd x = test::random_column(6, 3), y(6);
  auto w = slant::workspace(a, x);
  CHECK(test::allocations_of([&] {
          for (int k_th = 0; k_th < 3; ++k_th, x += 0.1 * y) slant::apply(a, x, y, w);
        }) == 0);
}

TEST_CASE("no allocation for the adjoint, for many right-hand sides, for dense matrices") {
  MatrixXd const m = test::random_dense(40, 40, 4);
  auto const b = test::random_sparse(20, 40, 5);
  auto const a = slant::sum(slant::product(b, m), slant::scaled(2.0, slant::product(b, m, m)),
                            slant::difference(b, slant::product(b, slant::adjoint(m))));
  VectorXd const x = test::random_column(40, 6), z = test::random_column(20, 7);
  VectorXd y(20), u(40);
  MatrixXd const several = test::random_dense(40, 3, 8);
  MatrixXd images(20, 3);
  auto w = slant::workspace(a, x);
  auto w_adjoint = slant::adjoint_workspace(a, z);
  auto w_several = slant::workspace(a, several);
  CHECK(test::allocations_of([&] {
          slant::apply(a, x, y, w);
          slant::apply_adjoint(a, z, u, w_adjoint);
          slant::apply(a, several, images, w_several);
        }) == 0);
  MatrixXd const expected = b * m + 2 * b * m * m + b - b * m.transpose();
  CHECK((y - expected * x).norm() < 1e-12);
  CHECK((u - expected.transpose() * z).norm() < 1e-12);
  CHECK((images - expected * several).norm() < 1e-12);
}

namespace archetype = slant::testing::archetype;

TEST_CASE("the adjoint is the transposed matrix") {
  auto const s = test::random_sparse(4, 6, 1);
  auto const a = slant::adjoint(s);
  CHECK(test::matches(a, MatrixXd(MatrixXd(s).transpose())));
  static_assert(slant::has_accumulate<decltype(a), VectorXd>);
  static_assert(slant::has_adjoint_accumulate<decltype(a), VectorXd>);
  static_assert(slant::has_columns<decltype(a), MatrixXd>);
  slant::testing::check_operator_laws(a);
  CHECK(test::matches(slant::adjoint(a), MatrixXd(s)));
  MatrixXd const square = test::random_dense(5, 5, 2);
  slant::testing::check_operator_laws(slant::adjoint(square));  // the diagonal, too
}

TEST_CASE("archetypes: only what has an adjoint") {
  archetype::vector const x(test::random_column(4, 4));
  MatrixXd const m = test::random_spd(4, 5);
  archetype::operator_with_adjoint const a(m);
  slant::testing::check_operator_laws(slant::adjoint(a), x);
  // self-adjoint operators have it for free
  archetype::spd_operator const b(m);
  auto const t = slant::adjoint(b);
  static_assert(slant::spd_operator<decltype(t), archetype::vector>);
  slant::testing::check_operator_laws(t, x);
  static_assert(!slant::linear_operator<slant::expr::adjoint_view<archetype::linear_operator>,
                                        archetype::vector>);
}

}  // namespace operators_test
