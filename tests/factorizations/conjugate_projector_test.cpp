// SPDX-License-Identifier: MIT
#include <slant/factorizations/factorizations.hpp>
#include <slant/testing/archetypes.hpp>
#include <slant/testing/laws.hpp>

#include <support/testing.hpp>
#include "operators/dense_oracle.hpp"

namespace conjugate_projector_test {

using namespace test::evaluated;
namespace archetype = slant::testing::archetype;

/// Chains of springs, each of n unknowns, free at both ends: semidefinite, a body each.
sparse chains(int bodies, int n) {
  MatrixXd k = MatrixXd::Zero(bodies * n, bodies * n);
  for (int b = 0; b < bodies; ++b) {
    for (int i = 0; i + 1 < n; ++i) {
      double const stiffness = 1 + 0.3 * i + b;
      int const at = b * n + i;
      k(at, at) += stiffness;
      k(at + 1, at + 1) += stiffness;
      k(at, at + 1) -= stiffness;
      k(at + 1, at) -= stiffness;
    }
  }
  return k.sparseView();
}
/// The injection of some unknowns.
sparse injection(int n, std::vector<int> const& unknowns) {
  sparse u(n, static_cast<int>(unknowns.size()));
  for (int j = 0; j < u.cols(); ++j) u.insert(unknowns[static_cast<std::size_t>(j)], j) = 1;
  u.makeCompressed();
  return u;
}
MatrixXd oracle(MatrixXd const& k, MatrixXd const& u) {
  MatrixXd const solved = test::solutions_of(u.transpose() * k * u, u.transpose() * k);
  return MatrixXd::Identity(k.rows(), k.rows()) - u * solved;
}

TEST_CASE("Q = I − U (UᵀKU)⁻¹UᵀK and its adjoint, bodies mixed up in U") {
  sparse const k = chains(3, 5);
  sparse const u = injection(15, {11, 1, 6, 2, 12, 3, 7, 8});
  auto const q = slant::conjugate_projector(k, u);
  CHECK(q.bodies() == 3);
  CHECK(test::matches(q, oracle(k, u), 100));
  slant::testing::check_operator_laws(q);
  slant::testing::check_conjugacy_laws(q, slant::matrix(k));
  static_assert(slant::declares_projector<decltype(q)> && !slant::is_self_adjoint<decltype(q)>);

  VectorXd const in_range = u * VectorXd::LinSpaced(8, 1, 2);
  VectorXd y(15);
  slant::apply(q, in_range, y);
  CHECK(y.norm() <= 1e-14 * in_range.norm());
}

TEST_CASE("U need not be an injection, and may tie bodies together") {
  sparse const k = chains(2, 4);
  MatrixXd u = MatrixXd::Zero(8, 3);
  u.col(0) << 0, 1, 2, 0, 0, 0, 0, 0;
  u.col(1) << 0, 0, 1, 0, 0, 0, 1, 0;  // of both bodies
  u.col(2) << 0, 0, 0, 0, 0, 1, 0, 0;
  auto const q = slant::conjugate_projector(k, sparse(u.sparseView()));
  CHECK(q.bodies() == 1);
  CHECK(test::matches(q, oracle(k, u), 100));
  slant::testing::check_operator_laws(q);
  slant::testing::check_conjugacy_laws(q, slant::matrix(k));
}

TEST_CASE("nothing to project, everything to project") {
  sparse const k = chains(1, 4);
  auto const none = slant::conjugate_projector(k, sparse(4, 0));
  CHECK(none.bodies() == 0);
  CHECK(test::matches(none, MatrixXd(MatrixXd::Identity(4, 4)), 0));
  sparse const definite = MatrixXd(MatrixXd(k) + MatrixXd::Identity(4, 4)).sparseView();
  auto const all = slant::conjugate_projector(definite, injection(4, {0, 1, 2, 3}));
  CHECK(test::spelt_out(all).norm() <= 1e-14);
}

TEST_CASE("the minimum of the energy over range(U) [D (4)]") {
  sparse const k = chains(2, 5);
  sparse const u = injection(10, {1, 2, 3, 6, 7});
  auto const q = slant::conjugate_projector(k, u);
  VectorXd const b = test::random_column(10, 3);
  VectorXd x = VectorXd::Zero(10);
  auto w = slant::workspace(q, b);
  q.add_minimiser(1.0, b, x, w);
  MatrixXd const kuu = u.transpose() * k * u;
  CHECK((x - u * kuu.llt().solve(u.transpose() * b)).norm() <= 1e-14 * x.norm());
  // What is left is not seen by range(U), and Qᵀ keeps it [D (5)].
  VectorXd const r = b - k * x;
  CHECK((u.transpose() * r).norm() <= 1e-14 * b.norm());
  VectorXd y(10);
  slant::apply_adjoint(q, r, y);
  CHECK((y - r).norm() <= 1e-14 * b.norm());
}

TEST_CASE("other vectors, other scalars, other factorisations; no allocation") {
  sparse const k = chains(2, 5);
  sparse const u = injection(10, {1, 2, 3, 6, 7});
  auto const q = slant::conjugate_projector(k, u);
  slant::testing::check_operator_laws(q, archetype::vector(VectorXd()));
  slant::testing::check_conjugacy_laws(q, archetype::psd_operator(MatrixXd(k)),
                                       archetype::vector(VectorXd()));
  using other = Eigen::SparseMatrix<long double>;
  auto const precise =
      slant::conjugate_projector(other(k.cast<long double>()), other(u.cast<long double>()));
  CHECK(test::matches(precise, oracle(k, u).cast<long double>().eval(), 1e6));
  auto const dense = slant::conjugate_projector(
      k, u, [](auto const& m) { return slant::dense_ldlt<double>(MatrixXd(m)); });
  CHECK(test::matches(dense, oracle(k, u), 100));

  VectorXd const x = test::random_column(10, 4);
  VectorXd y(10);
  auto w = slant::workspace(q, x);
  slant::testing::allocation_guard guard;
  q.apply(x, y, w);
  q.apply_adjoint(x, y, w);
  q.add_minimiser(1.0, x, y, w);
  auto const allocations = guard.count();
  CHECK(allocations == 0);
}

TEST_CASE("data that do not fit are named") {
  sparse const k = chains(1, 3);
  auto const message = [&](sparse const& matrix, sparse const& u) {
    return SLANT_COMPLAINT(slant::conjugate_projector(matrix, u));
  };
  CHECK(message(k, injection(4, {1})) == "U: got 4 x 1, expected 3 rows (the rows of K)");
  CHECK(message(k.leftCols(2), injection(3, {1})).starts_with("K: got 3 x 2"));
  CHECK(message(k, sparse(3, 1)) == "U[0]: got an empty column, expected columns of full rank");
  // A free body that U holds nowhere.
  CHECK(message(k, injection(3, {0, 1, 2}))
            .starts_with("U: got a U'KU of body 0 that cannot be factored (K: got pivot 2"));
  sparse skew = k;
  skew.coeffRef(0, 1) = 3;
  CHECK(message(skew, injection(3, {1})).starts_with("K(1, 0): got -1, expected a symmetric"));
  sparse negative = k;
  negative.coeffRef(2, 2) = -1;
  CHECK(message(negative, injection(3, {1})) ==
        "K(2, 2): got -1, expected a number >= 0 on the diagonal of a semidefinite matrix");
  negative.coeffRef(2, 2) = 0;
  CHECK(message(negative, injection(3, {1})) ==
        "K(2, 2): got 0, expected a number > 0, since row 2 has other entries");
  sparse hole = k;
  hole.coeffRef(1, 1) = std::numeric_limits<double>::quiet_NaN();
  CHECK(message(hole, injection(3, {1})).starts_with("K(1, 1): got nan"));
}

TEST_CASE("parts that do not fit each other are named") {
  using factors = slant::ldlt<double>;
  using parts_type = std::vector<slant::detail::conjugate_part<double, factors>>;
  sparse const k = chains(2, 3);
  sparse const one = injection(6, {1}), two = injection(6, {4});
  auto const part = [&](sparse const& u, sparse const& ku) {
    return slant::detail::conjugate_part<double, factors>{u, ku,
                                                          factors(sparse(u.transpose() * k * u))};
  };
  auto const message = [](parts_type const& parts) {
    return test::complaint(
        [&] { (void)slant::conjugate_projector_operator<double, factors>(6, parts); });
  };
  CHECK(message({part(one, k * one), part(one, k * one)}) ==
        "parts[1]: got row 1 of 0, expected parts without common rows");
  CHECK(message({part(one, sparse(6, 2))}) == "K U[0]: got 6 x 2, expected 6 x 1");
  slant::conjugate_projector_operator<double, factors> const good(
      6, parts_type{part(one, k * one), part(two, k * two)});
  CHECK(test::matches(good, oracle(k, injection(6, {1, 4})), 100));
}

/// Applies matrices that need not be a projector and its adjoint.
struct liar {
  MatrixXd q, adjoint;
  [[nodiscard]] Eigen::Index rows() const { return q.rows(); }
  [[nodiscard]] Eigen::Index cols() const { return q.cols(); }
  void apply(VectorXd const& x, VectorXd& y) const { y.noalias() = q * x; }
  void apply_adjoint(VectorXd const& x, VectorXd& y) const { y.noalias() = adjoint * x; }
};

TEST_CASE("the law checks find projectors that are not conjugate") {
  MatrixXd const k = test::random_spd(6, 1);
  auto const matrix = slant::matrix(k);
  MatrixXd const u = test::random_dense(6, 2, 2);
  MatrixXd const honest = oracle(k, u);
  CHECK(slant::testing::conjugacy_breaches(liar{honest, honest.transpose()}, matrix).empty());

  // A projector along range(U), but orthogonal in another inner product.
  MatrixXd const other = oracle(MatrixXd::Identity(6, 6), u);
  auto const found = slant::testing::conjugacy_breaches(liar{other, other.transpose()}, matrix);
  REQUIRE(found.size() == 2);
  CHECK(found[0].law == "conjugacy, K Q x = Q'K x");
  CHECK(found[1].law == "conjugacy, K Q x = Q'K Q x");

  // Twice an honest one satisfies the first law and not the second.
  auto const twice =
      slant::testing::conjugacy_breaches(liar{2 * honest, 2 * honest.transpose()}, matrix);
  REQUIRE(twice.size() == 1);
  CHECK(twice[0].law == "conjugacy, K Q x = Q'K Q x");

  auto const small = slant::testing::conjugacy_breaches(liar{honest, honest.transpose()},
                                                        slant::matrix(MatrixXd(k.topRows(5))));
  REQUIRE(small.size() == 1);
  CHECK(small[0].law == "sizes");
}

}  // namespace conjugate_projector_test
