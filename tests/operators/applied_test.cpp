// SPDX-License-Identifier: MIT
#include <slant/testing/archetypes.hpp>

#include <support/testing.hpp>
#include "operators/letters.hpp"

namespace applied_test {

using namespace test::evaluated;
TEST_CASE("A * x is what Eigen computes, wherever it is written to") {
  SLANT_TEST_LETTERS;
  auto const A = B * Kinv * adjoint(B) + 0.5 * slant::identity(m);
  MatrixXd const full = o.B * o.K.inverse() * o.B.transpose() + 0.5 * MatrixXd::Identity(m, m);
  VectorXd const x = VectorXd::LinSpaced(m, -1, 1);
  VectorXd const b = VectorXd::Ones(m);
  VectorXd y = A * x;
  CHECK((y - full * x).norm() < 1e-12);
  y += A * x;
  CHECK((y - 2 * full * x).norm() < 1e-12);
  y -= A * x;
  CHECK((y - full * x).norm() < 1e-12);
  y = A * (x - b) + b;
  CHECK((y - full * (x - b) - b).norm() < 1e-12);
  y.setZero();
  y.head(m) += B * (Kinv * (adjoint(B) * x));
  CHECK((y - full * x + 0.5 * x).norm() < 1e-12);
  VectorXd two(2 * m);
  two.head(m) = x;
  two.tail(m) = A * two.head(m);
  CHECK((two.tail(m) - full * x).norm() < 1e-12);
  CHECK((o.C * (A * x) - o.C * full * x).norm() < 1e-12);  // Eigen's product with A x

  Eigen::Matrix2f const f = Eigen::Vector2f(1, 2).asDiagonal();
  Eigen::Vector2f const h = (op<"F">(f) * 2.5) * Eigen::Vector2f(1, 2);
  CHECK(h == Eigen::Vector2f(2.5F, 10));
  Eigen::Vector2f const g = (1e50 * op<"F">(f) / 1e49) * Eigen::Vector2f(1, 2);
  CHECK(g == Eigen::Vector2f(10, 40));
  Vector3d const short_x(1, 2, 3);  // of another size than A x, which its type does not know
  CHECK((op<"L">(o.B.leftCols(3)) * short_x - b).isApprox(o.B.leftCols(3) * short_x - b, 1e-14));
}

TEST_CASE("overlap of x and y and wrong sizes are refused") {
  SLANT_TEST_LETTERS;
  VectorXd y = VectorXd::Ones(n);
  CHECK_THROWS_AS(y = S * y, slant::bad_input);
  CHECK_THROWS_AS(y += S * y, slant::bad_input);
  CHECK(y == VectorXd::Ones(n));
  VectorXd two = VectorXd::Ones(2 * n);
  CHECK_THROWS_AS(two.segment(1, n) = S * two.head(n), slant::bad_input);
  CHECK_THROWS_AS(two.tail(n) = S * two.segment(1, n), slant::bad_input);
  CHECK(two == VectorXd::Ones(2 * n));
  CHECK_THROWS_AS((void)(S * two), slant::bad_input);
  // Rows of a matrix by columns lie between each other and share nothing.
  MatrixXd rows = MatrixXd::Ones(2, n);
  rows.row(0).transpose() = S * rows.row(1).transpose();
  CHECK(rows.row(0).transpose() == VectorXd(S * VectorXd::Ones(n)));
  CHECK_THROWS_AS((rows.row(1).transpose() = S * rows.row(1).transpose()), slant::bad_input);
}

/// Three neighbouring components of seven.
struct middle {
  [[nodiscard]] Eigen::Index rows() const { return 3; }
  [[nodiscard]] Eigen::Index cols() const { return 7; }
  void apply(auto const& x, auto& y) const { y = x.segment(2, 3); }
  [[nodiscard]] auto segment(auto const& x) const { return x.segment(2, 3); }
};

TEST_CASE("with a workspace nothing is allocated, nor a segment copied") {
  SLANT_TEST_LETTERS;
  auto const R3 = op<"R">(middle{});
  auto const A = full_row_rank(B) * Kinv * adjoint(B) - 0.5 * slant::identity(m);
  auto const F = o.C.leftCols(3) * R3;
  VectorXd const x = VectorXd::LinSpaced(m, -1, 1), z = VectorXd::LinSpaced(n, -1, 1);
  VectorXd y(m), v(o.p);
  auto w = slant::workspace(A, x);
  auto u = slant::workspace(F, z);
  u.between[0].setConstant(7);
  CHECK(test::allocations_of([&] {
          y = (A * x).in(w);
          slant::apply_add(A, 2.0, x, y, w);
          slant::apply(F, z, v, u);
        }) == 0);
  CHECK((v - o.C.leftCols(3) * z.segment(2, 3)).norm() < 1e-14);
  CHECK(u.between[0] == VectorXd::Constant(3, 7));  // R z was read in place
}

TEST_CASE("vectors and scalars of others") {
  using slant::testing::archetype::spd_operator;
  using V = slant::testing::archetype::vector;
  spd_operator const t(MatrixXd::Identity(2, 2));
  auto const T = slant::op<"T">(t);
  auto const A = T + T * T * T;
  static_assert(slant::spd_operator<decltype(A), V>);
  static_assert(!slant::linear_operator<decltype(A), VectorXd>);
  CHECK(A.rows() == 2);
}

}  // namespace applied_test
