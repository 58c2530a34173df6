// SPDX-License-Identifier: MIT
#include <slant/operators/operators.hpp>

#include <support/testing.hpp>
#include "operators/dense_oracle.hpp"

namespace as_operator_test {

using namespace test::evaluated;
using sparse = Eigen::SparseMatrix<double>;

static_assert(
    std::is_same_v<slant::part_t<slant::identity_operator&>, slant::identity_operator const&>);
static_assert(std::is_same_v<slant::part_t<slant::identity_operator>, slant::identity_operator>);
static_assert(std::is_same_v<slant::part_t<MatrixXd&>, slant::matrix_operator<MatrixXd const&>>);
static_assert(std::is_same_v<slant::part_t<MatrixXd>, slant::matrix_operator<MatrixXd>>);
static_assert(std::is_same_v<slant::part_t<sparse const&>, slant::matrix_operator<sparse const&>>);
static_assert(!slant::operand<int>);
static_assert(!slant::operand<std::string>);

TEST_CASE("operators pass through, matrices are wrapped") {
  auto const i = slant::identity(3);
  CHECK(&slant::as_operator(i) == &i);
  MatrixXd const m = test::random_dense(3, 3, 1);
  CHECK(&slant::as_operator(m).get() == &m);
  CHECK(test::matches(slant::sum(i, m, m.transpose()),
                      MatrixXd(MatrixXd::Identity(3, 3) + m + m.transpose())));
}

TEST_CASE("a matrix with an entry that is no number is refused wherever it is passed") {
  MatrixXd m = MatrixXd::Identity(3, 3);
  m(1, 0) = std::numeric_limits<double>::infinity();
  CHECK(test::message<slant::bad_input>([&] { (void)slant::sum(slant::identity(3), m); }) ==
        "M(1, 0): got inf, expected a finite number");
}

}  // namespace as_operator_test
