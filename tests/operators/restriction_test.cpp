// SPDX-License-Identifier: MIT
#include <slant/operators/operators.hpp>
#include <slant/testing/archetypes.hpp>
#include <slant/testing/laws.hpp>

#include <support/testing.hpp>
#include "operators/dense_oracle.hpp"

namespace restriction_test {

using namespace test::evaluated;
namespace archetype = slant::testing::archetype;

MatrixXd rows_of_identity(std::vector<int> const& components, int n) {
  MatrixXd r = MatrixXd::Zero(static_cast<int>(components.size()), n);
  for (std::size_t i = 0; i < components.size(); ++i) r(static_cast<int>(i), components[i]) = 1;
  return r;
}

TEST_CASE("restriction gathers, its adjoint scatters") {
  std::vector<int> const components{4, 0, 3};
  slant::restriction const r(6, components);
  CHECK(test::matches(r, rows_of_identity(components, 6), 0));
  slant::testing::check_operator_laws(r);
  slant::testing::check_operator_laws(r, archetype::vector(VectorXd()));
  CHECK(slant::restriction(3, {}).rows() == 0);
}

TEST_CASE("a restricted operator is R A Rᵀ") {
  MatrixXd const m = test::random_dense(6, 6, 1);
  std::vector<int> const components{5, 1, 2, 3};
  MatrixXd const r = rows_of_identity(components, 6);
  auto const a = slant::restricted(m, components);
  CHECK(test::matches(a, MatrixXd(r * m * r.transpose())));
  CHECK(test::matches(slant::restricted(m, {5, 1, 2, 3}), MatrixXd(r * m * r.transpose())));
  static_assert(slant::has_adjoint_accumulate<decltype(a), VectorXd>);
  slant::testing::check_operator_laws(a);
}

TEST_CASE("closure") {
  using namespace slant;
  MatrixXd const m = test::random_spd(5, 2);
  std::vector<int> const components{0, 4};
  auto const a = restricted(matrix<self_adjoint, positive_definite>(m), components);
  static_assert(spd_operator<decltype(a), VectorXd>);
  testing::check_operator_laws(a);
  static_assert(laws_of<decltype(restricted(matrix(m), components))> == law_set{});
}

TEST_CASE("archetypes") {
  archetype::linear_operator const part(test::random_dense(4, 4, 5));
  auto const a = slant::restricted(part, std::vector<int>{2, 0});
  static_assert(!slant::has_adjoint<decltype(a), archetype::vector>);
  slant::testing::check_operator_laws(a, archetype::vector(VectorXd()));
}

TEST_CASE("components must be different and exist") {
  using slant::bad_input;
  auto const reason = [](std::vector<int> const& components) {
    return SLANT_COMPLAINT(slant::restriction(4, components));
  };
  CHECK(reason({1, 4}) ==
        "components[1]: got 4, expected a component of the vector (>= 0 and less than its size)");
  CHECK(reason({-1}) ==
        "components[0]: got -1, expected a component of the vector (>= 0 and less than its size)");
  CHECK(reason({2, 0, 2}) == "components[2]: got 2, expected different components");
  CHECK(SLANT_COMPLAINT(slant::restricted(MatrixXd(MatrixXd::Ones(2, 3)), std::vector<int>{0})) ==
        "A: got 2 x 3, expected a square operator");
}

TEST_CASE("a slice has consecutive components, and puts them back among zeros") {
  auto const s = slant::slice(5, 1, 3);
  CHECK(test::matches(s, rows_of_identity({1, 2, 3}, 5), 0));
  static_assert(slant::has_accumulate<decltype(s), VectorXd> && decltype(s)::full_row_rank);
  static_assert(slant::has_adjoint_accumulate<decltype(s), VectorXd>);
  slant::testing::check_operator_laws(s);
  VectorXd x{{1, 2, 3, 4, 5}};
  s.segment(x).setConstant(7);
  CHECK(x == VectorXd{{1, 7, 7, 7, 5}});
}

TEST_CASE("a product passes the segment of a slice on if the factor takes it; nothing allocates") {
  MatrixXd const a{{1, 2, 3}, {4, 5, 6}};
  auto const p = slant::product(a, slant::slice(5, 1, 3));
  auto const q = slant::any_operator<VectorXd>(slant::matrix(a)) * slant::slice(5, 1, 3);
  VectorXd const x{{1, 2, 3, 4, 5}};
  VectorXd y(2);
  auto w = slant::workspace(q, x);
  CHECK(test::allocations_of([&] { slant::apply(q, x, y, w); }) == 0);
  CHECK(y == a * x.segment(1, 3));
  auto v = slant::workspace(p, x);
  CHECK(test::allocations_of([&] { slant::apply_add(p, 1.0, x, y, v); }) == 0);
  CHECK(y == 2 * a * x.segment(1, 3));
  slant::testing::check_operator_laws(p);
  archetype::vector z(VectorXd::Zero(2));
  slant::apply(p, archetype::vector(x), z);
  CHECK(z.local() == y / 2);
}

TEST_CASE("slices that reach too far are refused") {
  CHECK(SLANT_COMPLAINT(slant::slice(5, 6, 0)) == "first: got 6, expected a number in [0, 5]");
  CHECK(SLANT_COMPLAINT(slant::slice(5, 2, 4)) == "count: got 4, expected a number in [0, 3]");
  CHECK_THROWS_AS(static_cast<void>(slant::slice(-1, 0, 0)), slant::bad_input);
}

}  // namespace restriction_test
