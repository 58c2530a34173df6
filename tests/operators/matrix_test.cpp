// SPDX-License-Identifier: MIT
#include <slant/operators/operators.hpp>
#include <slant/testing/archetypes.hpp>
#include <slant/testing/laws.hpp>

#include <support/testing.hpp>
#include "operators/dense_oracle.hpp"

namespace matrix_test {

using row_major_sparse = Eigen::SparseMatrix<double, Eigen::RowMajor>;
using row_major_dense = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

TEST_CASE_TEMPLATE("every storage is the same operator", M, MatrixXd, row_major_dense,
                   Eigen::SparseMatrix<double>, row_major_sparse) {
  Eigen::SparseMatrix<double> const s = test::random_sparse(5, 8, 1);
  M const m(s);
  auto const a = slant::matrix(m);
  CHECK(test::matches(a, MatrixXd(s)));
  slant::testing::check_operator_laws(a);

  M const square(test::random_sparse(6, 6, 2));
  auto const b = slant::matrix(square);
  slant::testing::check_operator_laws(b);  // the diagonal, too
  VectorXd d(6);
  b.diagonal(d);
  CHECK(d == MatrixXd(square).diagonal());
}

TEST_CASE("stored matrices are referenced, temporaries owned, expressions evaluated") {
  MatrixXd m = test::random_dense(3, 3, 3);
  auto const reference = slant::matrix(m);
  CHECK(&reference.get() == &m);
  static_assert(std::is_same_v<decltype(reference), slant::matrix_operator<MatrixXd const&> const>);

  double const* const data = m.data();
  auto const owner = slant::matrix(std::move(m));
  CHECK(owner.get().data() == data);
  static_assert(std::is_same_v<decltype(owner), slant::matrix_operator<MatrixXd> const>);

  auto const expression = owner.get() + owner.get();
  auto const value = slant::matrix(expression);
  static_assert(std::is_same_v<decltype(value), slant::matrix_operator<MatrixXd> const>);
  CHECK(test::matches(value, MatrixXd(2 * owner.get())));

  Eigen::Map<MatrixXd const> const map(data, 3, 3);
  CHECK(slant::matrix(map).get().data() == data);

  Eigen::SparseMatrix<double> const s = test::random_sparse(4, 4, 4);
  CHECK(test::matches(slant::matrix(s + s), MatrixXd(2 * s)));
  CHECK(test::matches(slant::matrix(s.transpose()), MatrixXd(s.transpose())));
}

TEST_CASE("an uncompressed sparse matrix") {
  Eigen::SparseMatrix<double> s(4, 4);
  s.reserve(Eigen::VectorXi::Constant(4, 3));
  s.insert(2, 1) = 5;
  s.insert(0, 3) = -1;
  REQUIRE(!s.isCompressed());
  auto const a = slant::matrix(s);
  CHECK(test::matches(a, MatrixXd(s)));
  slant::testing::check_operator_laws(a);
}

TEST_CASE("rows of every length, by rows and by columns") {
  // Row i has i entries; integers, so that no order of a sum matters.
  constexpr int n = 37;
  MatrixXd dense = MatrixXd::Zero(n, n);
  for (int i = 0; i < n; ++i)
    for (int k = 0; k < i; ++k) dense(i, (7 * i + 11 * k) % n) = 1 + (i + 3 * k) % 5;
  MatrixXd const symmetric = dense + dense.transpose();
  Eigen::SparseMatrix<double> columns = symmetric.sparseView();
  row_major_sparse const rows = dense.sparseView();
  VectorXd const x = VectorXd::LinSpaced(n, 1, n);
  auto const image = [&](auto const& a) {
    VectorXd y = VectorXd::Constant(a.rows(), 0.5);
    slant::apply(a, x, y);
    return y;
  };
  CHECK(image(slant::matrix(rows)) == dense * x);
  CHECK(image(slant::adjoint(slant::matrix(rows))) == dense.transpose() * x);
  CHECK(image(slant::matrix<slant::self_adjoint>(columns)) == symmetric * x);
  VectorXd d(n);
  slant::matrix(columns).diagonal(d);
  CHECK(d == symmetric.diagonal());
  Eigen::SparseVector<double> const row = columns.col(5);
  CHECK(image(slant::adjoint(slant::matrix(row))) == symmetric.col(5).transpose() * x);
  columns.insert(0, 0) = 0;
  columns.uncompress();
  CHECK(image(slant::matrix<slant::self_adjoint>(columns)) == symmetric * x);
}

TEST_CASE("laws are asserted") {
  using namespace slant;
  MatrixXd const k = test::random_spd(4, 5);
  auto const a = matrix<self_adjoint, positive_definite>(k);
  static_assert(spd_operator<decltype(a), VectorXd>);
  static_assert(!self_adjoint_operator<decltype(matrix(k)), VectorXd>);
  testing::check_operator_laws(a);
  auto const b = matrix<self_adjoint>(k, check_symmetry);
  static_assert(self_adjoint_operator<decltype(b), VectorXd>);
  CHECK(SLANT_COMPLAINT(matrix<self_adjoint>(MatrixXd(MatrixXd::Ones(2, 3)))) ==
        "M: got 2 x 3, expected a square operator");
}

TEST_CASE("symmetry is checked on request, relative to the scale of the entries") {
  for (double const scale : {1.0, 1e-150, 1e150}) {
    MatrixXd m = scale * MatrixXd(test::random_spd(5, 6));
    MatrixXd const symmetric = (m + m.transpose()) / 2;
    m = symmetric;
    m(1, 3) *= 1 + 4 * std::numeric_limits<double>::epsilon();
    CHECK_NOTHROW((void)slant::matrix(m, slant::check_symmetry));
    m(1, 3) += 1e-9 * scale;
    m(0, 2) += 2e-9 * scale;
    for (bool const sparse : {false, true}) {
      auto const text = test::complaint([&] {
        if (sparse) {
          (void)slant::matrix(Eigen::SparseMatrix<double>(m.sparseView()), slant::check_symmetry);
        } else {
          (void)slant::matrix(m, slant::check_symmetry);
        }
      });
      // the worst pair
      CHECK((text.rfind("M(0, 2): got ", 0) == 0 || text.rfind("M(2, 0): got ", 0) == 0));
      CHECK(text.find("expected a symmetric matrix, but M(") != std::string::npos);
    }
  }
  Eigen::SparseMatrix<double> one_sided(3, 3);
  one_sided.insert(0, 0) = one_sided.insert(1, 1) = one_sided.insert(2, 2) = 1;
  one_sided.insert(2, 0) = 0.5;
  CHECK(SLANT_COMPLAINT(slant::matrix(one_sided, slant::check_symmetry)) ==
        "M(2, 0): got 0.5, expected a symmetric matrix, but M(0, 2) is 0");
}

TEST_CASE("entries that are no numbers are named") {
  MatrixXd m = MatrixXd::Identity(3, 3);
  m(2, 1) = std::numeric_limits<double>::quiet_NaN();
  CHECK(SLANT_COMPLAINT(slant::matrix(m)) == "M(2, 1): got nan, expected a finite number");
  Eigen::SparseMatrix<double> s(3, 3);
  s.insert(0, 2) = -std::numeric_limits<double>::infinity();
  CHECK(SLANT_COMPLAINT(slant::matrix(s)) == "M(0, 2): got -inf, expected a finite number");
}

TEST_CASE("only vectors of the same scalar, of any kind") {
  using A = slant::matrix_operator<MatrixXd>;
  static_assert(slant::linear_operator<A, VectorXd>);
  static_assert(slant::linear_operator<A, slant::testing::archetype::vector>);
  static_assert(slant::applies_to_many<A, MatrixXd>);
  static_assert(!slant::linear_operator<A, Eigen::VectorXf>);
  static_assert(!slant::has_columns<A, Eigen::MatrixXf>);
  MatrixXd const m = test::random_dense(3, 3, 7);
  slant::testing::check_operator_laws(slant::matrix(m),
                                      slant::testing::archetype::vector(VectorXd()));
}

static_assert(
    std::is_same_v<slant::part_t<slant::identity_operator&>, slant::identity_operator const&>);
static_assert(std::is_same_v<slant::part_t<slant::identity_operator>, slant::identity_operator>);
static_assert(std::is_same_v<slant::part_t<MatrixXd&>, slant::matrix_operator<MatrixXd const&>>);
static_assert(std::is_same_v<slant::part_t<MatrixXd>, slant::matrix_operator<MatrixXd>>);
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
  CHECK(SLANT_COMPLAINT(slant::sum(slant::identity(3), m)) ==
        "M(1, 0): got inf, expected a finite number");
}

}  // namespace matrix_test
