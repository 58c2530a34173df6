// SPDX-License-Identifier: MIT
#include <slant/problems/equality_constraints.hpp>
#include <slant/testing/laws.hpp>

#include <support/dense_of.hpp>
#include <support/testing.hpp>

namespace equality_constraints_test {

using namespace test::evaluated;

MatrixXd rows() {
  MatrixXd G(3, 6);
  G << 1, 2, 0, 0, 1, 0,  //
      0, 1, 1, 0, 0, 3,   //
      2, 0, 0, -1, 0, 1;
  return G;
}

TEST_CASE("P, Q and the point next to the origin, as from a dense pseudoinverse") {
  MatrixXd const G = rows();
  VectorXd const e{{1.0, -2.0, 0.5}};
  slant::equality_constraints const constraints(sparse(G.sparseView()), e);
  MatrixXd const pseudo = test::pseudo_inverse(G);
  auto const P = constraints.kernel_projector();
  auto const Q = constraints.range_projector();
  CHECK((test::dense_of(Q) - pseudo * G).norm() <= 1e-14);
  CHECK((test::dense_of(P) + pseudo * G - MatrixXd::Identity(6, 6)).norm() <= 1e-14);
  CHECK((constraints.nearest() - pseudo * e).norm() <= 1e-14);
  VectorXd const v = VectorXd::LinSpaced(6, -1, 2);
  CHECK((G.transpose() * constraints.multipliers(v) - pseudo * G * v).norm() <= 1e-14);
  slant::testing::check_operator_laws(P);
  slant::testing::check_operator_laws(Q);
  CHECK(constraints.redundant().empty());

  VectorXd y(6);
  auto w = slant::workspace(P, v);
  CHECK(test::allocations_of([&] { P.apply(v, y, w); }) == 0);
}

TEST_CASE("redundant rows in any units are named and left out; contradictions are refused") {
  MatrixXd G(6, 6);
  G << rows(), 1e150 * (rows().row(0) + rows().row(2)), MatrixXd::Zero(1, 6),
      -1e-150 * rows().row(1);
  VectorXd e{{1.0, -2.0, 0.5, 1.5e150, 0.0, 2e-150}};
  sparse const sparse_G = G.sparseView(1, 0);
  slant::equality_constraints const constraints(sparse_G, e);
  CHECK(constraints.rows() == 6);
  CHECK(constraints.redundant().size() == 3);
  slant::equality_constraints const plain(sparse(rows().sparseView()), VectorXd(e.head(3)));
  CHECK((constraints.nearest() - plain.nearest()).norm() <= 1e-12);
  slant::testing::check_operator_laws(constraints.kernel_projector());
  VectorXd const v = VectorXd::LinSpaced(6, -1, 2);
  CHECK((G.transpose() * constraints.multipliers(v) -
         test::dense_of(constraints.range_projector()) * v)
            .norm() <= 1e-12);

  auto const complaint = [&](int row, double value) -> std::string {
    VectorXd wrong = e;
    wrong[row] = value;
    return test::complaint(
        [&] { slant::equality_constraints const contradiction(sparse_G, wrong); });
  };
  CHECK(complaint(4, 1e-3) ==
        "e[4]: got 0.001, expected 0, which other rows of G imply for this one");
  CHECK(complaint(3, 1.6e150).find("which other rows of G imply") != std::string::npos);
  CHECK(complaint(0, std::numeric_limits<double>::infinity()) ==
        "e[0]: got inf, expected a finite number");
  CHECK_THROWS_AS(slant::equality_constraints(sparse_G, VectorXd(5)), slant::bad_input);
  auto const one_row = [](double entry, double value) {
    sparse const row = MatrixXd::Constant(1, 2, entry).sparseView(1, 0);
    return SLANT_COMPLAINT(slant::equality_constraints(row, VectorXd{{value}}));
  };
  CHECK(one_row(1.5e308, 1) ==
        "length of row 0 of G: got inf, expected a finite number with a finite reciprocal");
  CHECK(one_row(1e-309, 0).starts_with("length of row 0 of G: got 1.4"));
  CHECK(one_row(1e-160, 1e160).starts_with("e over the length of its row of G[0]: got inf"));
}

TEST_CASE("rows next to each other are refused by name, not dropped; agreement is judged by row") {
  auto const complaint = [](MatrixXd const& G, VectorXd const& e, VectorXd const& error) {
    return test::complaint(
        [&] { slant::equality_constraints const constraints(sparse(G.sparseView()), e, error); });
  };
  MatrixXd const close{{1.0, 0.0, 0.0}, {1.0, 5e-8, 0.0}};
  CHECK(complaint(close, VectorXd{{1.0, 1.0 + 5e-8}}, VectorXd::Zero(2)).find("G: got row ") == 0);

  // A row of zeros has nothing to do with the size of other rows, nor have tiny equations.
  MatrixXd const zero{{1.0, 0.0}, {0.0, 0.0}}, twice{{1.0, 0.0}, {2.0, 0.0}};
  VectorXd const none = VectorXd::Zero(2);
  MatrixXd const apart{{1, 0}, {0, 1}, {0, 1}};
  CHECK(complaint(apart, VectorXd{{1e20, 0, 1}}, VectorXd::Zero(3)).find("e[2]: got 1") == 0);
  CHECK(complaint(zero, VectorXd{{1.0, 1e-8}}, none).find("e[1]: got 1e-08") == 0);
  CHECK(complaint(zero, VectorXd{{1.0, 1e-8}}, VectorXd{{0.0, 1e-7}}) == "nothing thrown");
  CHECK(complaint(twice, VectorXd{{1e-18, -2e-18}}, none).find("e[") == 0);
  CHECK(complaint(twice, VectorXd{{1e-18, 2e-18}}, none) == "nothing thrown");
  CHECK(complaint(twice, VectorXd{{1e-18, -2e-18}}, VectorXd{{1e-17, 0.0}}) == "nothing thrown");
}

TEST_CASE("no rows at all") {
  slant::equality_constraints const constraints(sparse(0, 4), VectorXd(0));
  CHECK(test::dense_of(constraints.kernel_projector()) == MatrixXd::Identity(4, 4));
  CHECK(constraints.nearest() == VectorXd::Zero(4));
  CHECK(constraints.meets(VectorXd::Ones(4), 0.0));
}

TEST_CASE("rows are met relative to their terms, up to rounding") {
  MatrixXd const G{{1.0, 0.0, 0.0}, {0.0, 1.0, 1e-9}, {0.0, 1.0, 1.0}};
  slant::equality_constraints const c(sparse(G.sparseView()), VectorXd{{0.0, 1e-9, 1.0}});
  CHECK(c.meets(VectorXd{{1e-17, 0.0, 1.0}}, 0.0));  // a row whose terms vanish
  CHECK(!c.meets(VectorXd{{1e-8, 0.0, 1.0}}, 1e-7));
  CHECK(!c.meets(VectorXd{{1e152, 0.0, 1e160}}, 1e-9));
  CHECK(c.meets(VectorXd{{0.0, 1e-12, 1.0}}, 1e-3));
  CHECK(!c.meets(VectorXd{{0.0, 1e-12, 1.0}}, 1e-4));  // small beside ‖x‖, not beside its row
  CHECK(!c.meets(VectorXd{{0.0, std::numeric_limits<double>::quiet_NaN(), 1.0}}, 1e-3));
}

}  // namespace equality_constraints_test
