// SPDX-License-Identifier: MIT
#include <slant/operators/operators.hpp>
#include <slant/testing/archetypes.hpp>
#include <slant/testing/laws.hpp>

#include <ranges>
#include <support/testing.hpp>
#include "operators/dense_oracle.hpp"

namespace range_sum_test {

using namespace test::evaluated;
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

}  // namespace range_sum_test
