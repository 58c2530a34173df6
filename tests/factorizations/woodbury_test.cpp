// SPDX-License-Identifier: MIT
#include <slant/factorizations/factorizations.hpp>
#include <slant/operators/syntax.hpp>
#include <slant/testing/laws.hpp>

#include <support/testing.hpp>
#include "krylov/spd_matrices.hpp"
#include "operators/dense_oracle.hpp"

namespace woodbury_test {

using namespace test::evaluated;
TEST_CASE("the inverse of K + U C Uᵀ, at any scale") {
  for (double const unit : {1.0, 1e100, 1e-100}) {
    CAPTURE(unit);
    MatrixXd const k = unit * test::random_spd(9, 1), u = test::random_dense(9, 3, 2),
                   c = unit * test::random_spd(3, 3);
    auto const a = slant::woodbury(slant::inverse(slant::ldlt(k.sparseView())), u, c);
    static_assert(slant::spd_operator<decltype(a), VectorXd>);
    MatrixXd const expected = MatrixXd(k / unit + u * (c / unit) * u.transpose()).inverse() / unit;
    VectorXd const x = test::random_column(9, 4);
    VectorXd y(9);
    slant::apply(a, x, y);
    CHECK((y - expected * x).norm() <= 1e-12 * (expected * x).norm());
    if (unit == 1) slant::testing::check_operator_laws(a, x, {.roundings = 1000});
  }
}

template <class A> concept has_inverse = requires(A const& a) { inverse(a); };

TEST_CASE("a formula is recognised where its letters know what is needed") {
  using slant::op;
  VectorXd const d{{1.0, 2.0, 4.0, 3.0}};
  MatrixXd const u = test::random_dense(4, 2, 2), c = test::random_spd(2, 3);
  auto const D = op<"D">(slant::diagonal<slant::positive_definite>(d));
  auto const U = op<"U">(u);
  auto const C = op<"C", slant::self_adjoint, slant::positive_definite>(c);
  auto const A = D + U * C * adjoint(U);
  auto const inverse_of_A = inverse(A);
  static_assert(slant::spd_operator<decltype(inverse_of_A), VectorXd>);
  VectorXd const x = test::random_column(4, 4);
  VectorXd y(4), z(4);
  slant::apply(A, x, y);
  slant::apply(inverse_of_A, y, z);
  CHECK((z - x).norm() <= 1e-13 * x.norm());
  static_assert(!has_inverse<decltype(op<"K">(MatrixXd(4, 4)) + U * C * adjoint(U))>);
  static_assert(!has_inverse<decltype(D + U * C * U)>);
  static_assert(!has_inverse<decltype(D + 2 * U * C * adjoint(U))>);
}

TEST_CASE("bad input") {
  MatrixXd const k = test::random_spd(4, 1), u = test::random_dense(4, 2, 2);
  auto const inverse = slant::inverse(slant::dense_ldlt(k));
  auto const woodbury = [&](MatrixXd const& U, MatrixXd const& C) {
    return SLANT_COMPLAINT(slant::woodbury(inverse, U, C));
  };
  CHECK(woodbury(u.topRows(3), MatrixXd::Identity(2, 2)) ==
        "U: got 3 x 2, expected 4 rows (the size of K)");
  CHECK(woodbury(u, MatrixXd::Identity(3, 3)) == "C: got 3 x 3, expected 2 x 2 (the columns of U)");
  CHECK(woodbury(u, -MatrixXd::Identity(2, 2)) ==
        "C: got a matrix with the complaint (K: got pivot 0 (row 0) = -1, expected a symmetric "
        "positive definite matrix), expected a symmetric positive definite matrix");
  MatrixXd broken = u;
  broken(3, 1) = std::numeric_limits<double>::quiet_NaN();
  CHECK(woodbury(broken, MatrixXd::Identity(2, 2)) == "U(3, 1): got nan, expected a finite number");
}

}  // namespace woodbury_test
