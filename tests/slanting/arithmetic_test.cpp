// SPDX-License-Identifier: MIT
#include <slant/operators/operators.hpp>
#include <slant/slanting/slanting.hpp>
#include <slant/testing/archetypes.hpp>
#include <slant/testing/laws.hpp>

#include <support/testing.hpp>
#include "slanting_support.hpp"

namespace arithmetic_test {

namespace client {

/// A client's function opts in by its base.
struct doubling : slant::slanting_base {
  [[nodiscard]] slant::index rows() const { return 3; }
  [[nodiscard]] slant::index cols() const { return 3; }
  void value(VectorXd const& y, VectorXd& f) const { f = 2 * y; }
  [[nodiscard]] auto slant(VectorXd const&) const {
    return slant::matrix(MatrixXd(2 * MatrixXd::Identity(3, 3)));
  }
};

}  // namespace client

TEST_CASE("formulas say what they say on paper") {
  VectorXd const y{{1.0, -2.0, 4.0}};
  slant::identity_map const id(3);
  auto const p = slant::positive_part(3);
  MatrixXd const a = slanting_support::random_matrix(3, 3, 1);
  auto const at_y = [&](auto const& f) { return slant::evaluate(f, y); };
  VectorXd const plus{{1.0, 0.0, 4.0}};

  CHECK(at_y(id + p) == y + plus);
  CHECK(at_y(id - p) == y - plus);
  CHECK(at_y(y - (y + p)) == -plus);
  CHECK(at_y(3.0 * p) == 3 * plus);
  CHECK(at_y(slant::positive(0.5) * p) == plus / 2);
  CHECK(at_y(slant::any_sign(-2.5) * p) == -2.5 * plus);
  CHECK(at_y(p * (-id)) == VectorXd{{0.0, 2.0, 0.0}});  // composition
  CHECK((at_y(a * p) - a * plus).norm() <= 1e-15);
  CHECK((at_y(p * a) - VectorXd((a * y).cwiseMax(0))).norm() <= 1e-15);
  CHECK((at_y(slant::matrix(a) * p) - a * plus).norm() <= 1e-15);
  CHECK(at_y(slant::restriction(3, {2, 0}) * p) == VectorXd{{4.0, 1.0}});  // some rows
  CHECK(at_y(id - 2 * p + client::doubling{}) == 3 * y - 2 * plus);
}

TEST_CASE("formulas print themselves and their slanting operators") {
  MatrixXd const m = slanting_support::random_spd(2, 1);
  VectorXd const b = VectorXd::Ones(2), y{{1.0, -2.0}};
  slant::identity_map const x(2);
  auto const A = slant::op<"A", slant::self_adjoint, slant::positive_definite>(m);
  auto const F = x - slant::positive_part(2) * (x - 0.5 * (A * x - b));
  std::ostringstream out;
  out << F << "\n"
      << F.slant(y) << "\n"
      << -(2 * A * slant::positive_part(x + b)) << "\n"
      << A * (-slant::min(A * x, x)) - slant::max(x, x) << "\n"
      << x - slant::fischer_burmeister(-A * x, x) << "\n"
      << (A + slant::identity(2)) * slant::positive_part(2);
  CHECK(out.str() ==
        "x ↦ x − max(0, x − 0.5 (A x − c))   (2 → 2)\n"
        "I − diag (I − 0.5 A)   (2 × 2, no laws)\n"
        "x ↦ −2 A max(0, x + c)   (2 → 2)\n"
        "x ↦ A (−min(A x, x)) − max(x, x)   (2 → 2)\n"
        "x ↦ x − φ_FB(−A x, x)   (2 → 2)\n"
        "x ↦ (A + I) max(0, x)   (2 → 2)");
}

TEST_CASE("temporaries are owned, variables referenced") {
  auto const f = [] { return slant::identity_map(3) - 2.0 * slant::positive_part(3); }();
  VectorXd const y{{1.0, -2.0, 4.0}};
  CHECK(slant::evaluate(f, y) == VectorXd{{-1.0, -2.0, -4.0}});
  auto const p = slant::positive_part(3);
  CHECK(&(p + p).term<0>() == &p);
}

TEST_CASE("operators of slant and Eigen matrices keep their own arithmetic") {
  MatrixXd const a = MatrixXd::Identity(2, 2);
  static_assert(!slant::slanting_map<MatrixXd>);
  CHECK(MatrixXd(a * a).isIdentity());
  CHECK(MatrixXd(2.0 * a - a).isIdentity());
}

TEST_CASE("laws of F° follow from those of the parts and from the signs of numbers") {
  MatrixXd const m = slanting_support::random_spd(3, 1);
  auto const definite =
      slant::linear(slant::matrix<slant::self_adjoint, slant::positive_definite>(m));
  auto const p = slant::positive_part(3);
  auto const slope = [](auto const& f) { return f.slant(test::zeros(3)); };
  auto const sum = slope(definite + p);
  auto const sum_with_any = slope(slant::linear(m) + p);
  auto const difference = slope(slant::identity_map(3) - p);
  auto const multiple = slope(2.0 * p);
  auto const of_any_sign = slope(slant::any_sign(2.0) * p);
  auto const negative = slope(-p);
  static_assert(slant::spd_operator<decltype(sum), VectorXd>);
  static_assert(!slant::declares_self_adjoint<decltype(sum_with_any)>);
  static_assert(slant::declares_self_adjoint<decltype(difference)>);
  static_assert(!slant::declares_positive_semidefinite<decltype(difference)>);
  static_assert(slant::declares_positive_semidefinite<decltype(multiple)>);
  static_assert(slant::declares_self_adjoint<decltype(of_any_sign)>);
  static_assert(!slant::declares_positive_semidefinite<decltype(of_any_sign)>);
  static_assert(slant::declares_self_adjoint<decltype(negative)>);
  static_assert(!slant::declares_positive_semidefinite<decltype(negative)>);
}

TEST_CASE("parts of which nothing is known but the concept") {
  namespace archetype = slant::testing::archetype;
  archetype::slanting_function const f(2);
  archetype::vector const y(VectorXd{{1.0, -2.0}});
  auto const check = [&](auto const& g, VectorXd const& expected) {
    CHECK(slant::evaluate(g, y).local() == expected);
    slant::testing::check_slanting_laws(g, y);
  };
  check(slant::add(f, f), VectorXd{{3.0, 2.0}});
  check(slant::subtract(f, slant::identity_map(2)), VectorXd{{0.5, 3.0}});
  check(slant::scale(0.5, f), VectorXd{{0.75, 0.5}});
}

TEST_CASE("value and renewal allocate nothing") {
  auto const p = slant::positive_part(50);
  auto const y = slanting_support::random_vector(50, 1);
  slanting_support::check_renewal(p + p, y);
  slanting_support::check_renewal(p - (-p), y);
  slanting_support::check_renewal(-(-(p + p)), y);
}

TEST_CASE("sizes that do not fit, and numbers that are none or not positive, are refused") {
  auto const p = slant::positive_part(3);
  CHECK(SLANT_COMPLAINT(slant::add(p, slant::positive_part(2))) ==
        "g.rows(): got 2, expected 3 (f.rows())");
  CHECK(SLANT_COMPLAINT(slant::subtract(p, slant::linear(MatrixXd(3, 4)))) ==
        "g.cols(): got 4, expected 3 (f.cols())");
  CHECK(SLANT_COMPLAINT(slant::scale(infinity, p)) == "c: got inf, expected a finite number");
  CHECK(SLANT_COMPLAINT(slant::scale(0, p)) ==
        "c: got 0, expected a number > 0 in front of a function; for others write "
        "-(c * f) or any_sign(c) * f");
}

// A function with all members but without the mark: factories take it, operators do not.
struct unmarked {
  [[nodiscard]] slant::index rows() const { return 1; }
  [[nodiscard]] slant::index cols() const { return 1; }
  [[nodiscard]] VectorXd value(VectorXd const& y) const { return y; }
  [[nodiscard]] auto slant(VectorXd const& y) const { return slant::identity_operator(y.size()); }
};
struct marked : unmarked, slant::slanting_base {};
struct only_marked : slant::slanting_base {};

static_assert(slant::slanting_part<unmarked> && !slant::slanting_map<unmarked>);
static_assert(slant::slanting_part<marked> && slant::slanting_map<marked>);
static_assert(!slant::slanting_part<only_marked> && !slant::slanting_map<only_marked>);
static_assert(slant::slanting_map<marked const&> && slant::slanting_part<marked&&>);
static_assert(sizeof(marked) == sizeof(unmarked));

}  // namespace arithmetic_test
