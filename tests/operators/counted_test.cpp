// SPDX-License-Identifier: MIT
#include <slant/operators/operators.hpp>
#include <slant/operators/timed.hpp>
#include <slant/testing/archetypes.hpp>
#include <slant/testing/laws.hpp>

#include <chrono>
#include <support/testing.hpp>
#include <thread>
#include "operators/dense_oracle.hpp"

namespace counted_test {

TEST_CASE("applications are counted by right-hand sides") {
  MatrixXd const m = test::random_dense(3, 4, 1);
  auto const a = slant::counted(m);
  VectorXd const x = test::random_column(4, 2);
  VectorXd y(3);
  VectorXd z(4);
  auto w = slant::workspace(a, x);
  slant::apply(a, x, y, w);
  slant::apply_add(a, 2.0, x, y, w);
  CHECK(a.counts().applications == 2);
  CHECK((y - 3 * m * x).norm() < 1e-14);

  slant::apply_adjoint(a, y, z);
  CHECK(a.counts().adjoint_applications == 1);

  MatrixXd const many = MatrixXd::Ones(4, 5);
  MatrixXd images(3, 5);
  slant::apply(a, many, images);
  CHECK(a.counts().applications == 7);

  MatrixXd columns(3, 2);
  a.columns(1, columns);
  CHECK(a.counts().columns == 2);
  CHECK(columns == m.middleCols(1, 2));
  CHECK(a.counts().applications == 7);

  a.reset_counts();
  CHECK(a.counts().applications + a.counts().adjoint_applications + a.counts().columns == 0);
}

TEST_CASE("laws and capabilities are those of the operator inside") {
  using namespace slant;
  auto const d = slant::diagonal<positive_definite>(VectorXd(VectorXd::LinSpaced(3, 1, 2)));
  auto const a = counted(d);
  static_assert(laws_of<decltype(a)> == laws_of<decltype(d)>);
  static_assert(has_diagonal<decltype(a), VectorXd> && has_inverse<decltype(a), VectorXd>);
  static_assert(has_columns<decltype(a), MatrixXd> && has_accumulate<decltype(a), VectorXd>);
  testing::check_operator_laws(a);
  // Also what is known at run time only, and what no law says.
  VectorXd e = VectorXd::Zero(3);
  CHECK(diagonal_if_known(counted(op<"L">(any_operator<VectorXd, laws<self_adjoint>>(d))), e));
  CHECK(e == VectorXd::LinSpaced(3, 1, 2));
  static_assert(declares_full_row_rank<decltype(counted(restriction(3, {0, 2})))>);

  namespace archetype = slant::testing::archetype;
  auto const bare = counted(archetype::linear_operator(test::random_dense(3, 3, 3)));
  static_assert(!has_adjoint<decltype(bare), archetype::vector>);
  static_assert(!has_accumulate<decltype(bare), archetype::vector>);
  static_assert(!linear_operator<decltype(bare), VectorXd>);
  testing::check_operator_laws(bare, archetype::vector(VectorXd()));
}

TEST_CASE("copies count together") {
  auto const a = slant::counted(MatrixXd(MatrixXd::Identity(2, 2)));
  auto const copy = a;
  auto const s = slant::sum(copy, a);
  VectorXd y(2);
  slant::apply(s, VectorXd(VectorXd::Ones(2)), y);
  CHECK(a.counts().applications == 2);
  CHECK(copy.counts().applications == 2);
}

TEST_CASE("no application is lost between threads") {
  auto const a = slant::counted(MatrixXd(MatrixXd::Identity(2, 2)));
  VectorXd const x = VectorXd::Ones(2);
  std::vector<VectorXd> results(2, x);
  auto const work = [&](VectorXd& y) {
    for (int k = 0; k < 1000; ++k) slant::apply(a, x, y);
  };
  std::thread other(work, std::ref(results[0]));
  work(results[1]);
  other.join();
  CHECK(a.applications() == 2000);
}

/// The identity, taking at least two milliseconds.
struct slow_identity {
  [[nodiscard]] slant::index rows() const { return 2; }
  [[nodiscard]] slant::index cols() const { return 2; }
  void apply(VectorXd const& x, VectorXd& y) const {
    auto const start = std::chrono::steady_clock::now();
    while (std::chrono::steady_clock::now() - start < std::chrono::milliseconds(2)) {
    }
    y = x;
  }
};

TEST_CASE("time adds up, over copies") {
  auto const a = slant::timed(slow_identity{});
  CHECK(a.seconds() == 0);
  VectorXd y(2);
  slant::apply(a, VectorXd(VectorXd::Ones(2)), y);
  CHECK(a.seconds() >= 2e-3);
  auto const copy = a;
  slant::apply(copy, VectorXd(VectorXd::Ones(2)), y);
  CHECK(a.seconds() >= 4e-3);
  CHECK(copy.seconds() == a.seconds());
}

}  // namespace counted_test
