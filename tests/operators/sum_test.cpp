// SPDX-License-Identifier: MIT
#include <slant/operators/operators.hpp>
#include <slant/operators/range_sum.hpp>
#include <slant/testing/archetypes.hpp>
#include <slant/testing/laws.hpp>

#include <support/testing.hpp>
#include "operators/dense_oracle.hpp"

namespace sum_test {

using namespace test::evaluated;
namespace archetype = slant::testing::archetype;

TEST_CASE("a sum is the sum of the matrices") {
  auto const s = test::random_sparse(4, 4, 1);
  MatrixXd const m = test::random_dense(4, 4, 2);
  auto const a = slant::sum(s, m, slant::identity(4));
  CHECK(test::matches(a, MatrixXd(MatrixXd(s) + m + MatrixXd::Identity(4, 4))));
  static_assert(slant::has_accumulate<decltype(a), VectorXd>);
  static_assert(slant::has_adjoint_accumulate<decltype(a), VectorXd>);
  static_assert(slant::has_diagonal<decltype(a), VectorXd>);
  static_assert(slant::has_columns<decltype(a), MatrixXd>);
  static_assert(slant::applies_to_many<decltype(a), MatrixXd>);
  slant::testing::check_operator_laws(a);
  slant::testing::check_operator_laws(
      slant::sum(test::random_sparse(3, 5, 3), test::random_dense(3, 5, 4)));
  MatrixXd const d = test::random_spd(3, 5);
  slant::testing::check_operator_laws(
      slant::sum(slant::matrix<slant::self_adjoint, slant::positive_definite>(d),
                 slant::matrix<slant::self_adjoint, slant::positive_semidefinite>(d)));
}

TEST_CASE("terms without apply_add work through a temporary, and the sum has no apply_add") {
  MatrixXd const m = test::random_dense(4, 4, 6);
  archetype::linear_operator const a(m);
  auto const s = slant::sum(a, a, slant::identity(4));
  archetype::vector const x(test::random_column(4, 7));
  archetype::vector y(VectorXd::Zero(4));
  slant::apply(s, x, y);
  CHECK((y.local() - (2 * m * x.local() + x.local())).norm() < 1e-14);
  static_assert(!slant::has_accumulate<decltype(s), archetype::vector>);
  static_assert(!slant::has_adjoint<decltype(s), archetype::vector>);
  static_assert(!slant::has_diagonal<decltype(s), archetype::vector>);
  static_assert(!slant::linear_operator<decltype(s), VectorXd>);
  slant::testing::check_operator_laws(s, x);

  archetype::operator_with_adjoint const b(m);
  auto const t = slant::sum(b, b);
  static_assert(slant::has_adjoint<decltype(t), archetype::vector>);
  static_assert(!slant::has_adjoint_accumulate<decltype(t), archetype::vector>);
  slant::testing::check_operator_laws(t, x);
}

TEST_CASE("lvalues are referenced, rvalues owned") {
  VectorXd d = VectorXd::Ones(2);
  auto const diagonal = slant::diagonal(d);
  auto const make = [&] { return slant::sum(diagonal, slant::identity(2)); };
  auto const s = make();  // owns the identity, refers to the diagonal
  d[0] = 5;
  CHECK(test::matches(s, MatrixXd(VectorXd(VectorXd::Ones(2) + d).asDiagonal()), 0));
  auto const copy = s;
  auto const moved = make();
  CHECK(test::matches(copy, test::spelt_out(moved), 0));
}

TEST_CASE("expressions may be applied to and segments written") {
  MatrixXd const m = test::random_dense(3, 3, 8);
  auto const a = slant::sum(m, slant::identity(3));
  VectorXd const x = test::random_column(6, 9);
  VectorXd y = VectorXd::Zero(6);
  auto w = slant::workspace(a, VectorXd(3));
  auto target = y.tail(3);
  slant::apply(a, x.head(3) - x.tail(3), target, w);
  CHECK((y.tail(3) - (m * (x.head(3) - x.tail(3)) + x.head(3) - x.tail(3))).norm() < 1e-14);
  CHECK(y.head(3).isZero(0));
}

TEST_CASE("sizes must agree") {
  CHECK(SLANT_COMPLAINT(
            slant::sum(slant::identity(3), MatrixXd(MatrixXd::Ones(3, 3)), slant::identity(4))) ==
        "A3: got 4 x 4, expected 3 x 3 (the size of A1)");
  CHECK(SLANT_COMPLAINT(slant::difference(MatrixXd(MatrixXd::Ones(3, 2)), slant::identity(3))) ==
        "B: got 3 x 3, expected 3 x 2 (the size of A)");
}

TEST_CASE("a difference is a sum with a negative multiple, which works through a temporary, too") {
  MatrixXd const m = test::random_dense(4, 4, 4);
  archetype::operator_with_adjoint const a(m);
  auto const d = slant::difference(slant::identity(4), a);
  static_assert(!slant::has_accumulate<decltype(d), archetype::vector>);
  static_assert(!slant::has_adjoint_accumulate<decltype(d), archetype::vector>);
  archetype::vector const x(test::random_column(4, 5));
  archetype::vector y(VectorXd::Zero(4));
  slant::apply(d, x, y);
  CHECK((y.local() - (x.local() - m * x.local())).norm() < 1e-14);
  slant::testing::check_operator_laws(d, x);
}

TEST_CASE("a sum over a range is the sum of the matrices") {
  std::vector<MatrixXd> matrices;
  MatrixXd total = MatrixXd::Zero(3, 4);
  for (unsigned k = 1; k <= 5; ++k) {
    matrices.push_back(test::random_dense(3, 4, k));
    total += matrices.back();
  }
  auto const a = slant::sum(matrices);
  CHECK(test::matches(a, total));
  CHECK(&a.term(2).get() == &matrices[2]);  // referenced
  static_assert(slant::has_accumulate<decltype(a), VectorXd>);
  slant::testing::check_operator_laws(a);
  auto const owner = slant::sum(std::vector<MatrixXd>(matrices));
  CHECK(test::matches(owner, total));
  // A view that dies takes nothing from what it shows, and leaves no reference to it.
  auto const copies = slant::sum(std::views::all(matrices));
  CHECK(test::matches(copies, total));
  CHECK(matrices.front().size() == 12);
  CHECK(&copies.term(2).get() != &matrices[2]);
}

TEST_CASE("subdomains: Σ BᵢKᵢ⁻¹Bᵢᵀ of a view is definite") {
  std::vector<MatrixXd> k, b;
  MatrixXd total = MatrixXd::Zero(3, 3);
  for (unsigned i = 1; i <= 4; ++i) {
    k.push_back(test::random_spd(4 + int(i), i));
    b.push_back(test::random_dense(3, 4 + int(i), 10 + i));
    total += b.back() * k.back() * b.back().transpose();
  }
  auto terms = std::views::iota(std::size_t(0), k.size()) | std::views::transform([&](auto i) {
                 return slant::congruence(
                     slant::full_row_rank(b[i]),
                     slant::matrix<slant::self_adjoint, slant::positive_definite>(k[i]));
               });
  auto const a = slant::sum(terms);
  static_assert(slant::spd_operator<decltype(a), VectorXd>);
  CHECK(test::matches(a, total));
  slant::testing::check_operator_laws(a);
}

TEST_CASE("archetypes, and bad input") {
  namespace archetype = slant::testing::archetype;
  MatrixXd const m = test::random_dense(3, 3, 5);
  std::vector<archetype::operator_with_adjoint> const twice{archetype::operator_with_adjoint(m),
                                                            archetype::operator_with_adjoint(m)};
  slant::testing::check_operator_laws(slant::sum(twice),
                                      archetype::vector(test::random_column(3, 6)));
  CHECK(SLANT_COMPLAINT(slant::sum(std::vector<MatrixXd>{})) ==
        "range: got no operator, expected at least one");
  std::vector<MatrixXd> const unlike{MatrixXd::Ones(2, 2), MatrixXd::Ones(2, 3)};
  CHECK(SLANT_COMPLAINT(slant::sum(unlike)) == "A2: got 2 x 3, expected 2 x 2 (the size of A1)");
}

}  // namespace sum_test
