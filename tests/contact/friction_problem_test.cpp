// SPDX-License-Identifier: MIT
#include <slant/contact/friction/friction_problem.hpp>
#include <slant/contact/friction_law.hpp>
#include <support/testing.hpp>

namespace friction_problem_test {

using namespace test::evaluated;
using problem = slant::contact::friction_problem<double>;
using slant::contact::asymmetry;
using slant::contact::require_symmetric;

problem identity(int n, int contacts) {
  problem p{.W = Eigen::SparseMatrix<double>(n, n),
            .q = VectorXd::Ones(n),
            .mu = VectorXd::Constant(contacts, 0.5)};
  p.W.setIdentity();
  return p;
}

std::string complaint(problem const& p) {
  return SLANT_COMPLAINT(p.validate());
}

TEST_CASE("sizes tell the dimension") {
  CHECK(identity(4, 2).dimension() == 2);
  CHECK(identity(6, 2).dimension() == 3);
  CHECK(identity(6, 2).contacts() == 2);
  CHECK(problem{}.dimension() == 3);
  CHECK(complaint(problem{}) == "nothing thrown");
  CHECK(complaint(identity(6, 2)) == "nothing thrown");
}

TEST_CASE("what is not valid is named") {
  auto const refused = [](char const* part, auto change) {
    problem p = identity(6, 2);
    change(p);
    CAPTURE(part);
    CHECK(complaint(p).find(part) != std::string::npos);
  };
  refused("size of q", [](auto& p) { p.q.conservativeResize(5); });
  refused("rows of W", [](auto& p) { p.W.resize(5, 6); });
  refused("columns of W", [](auto& p) { p.W.resize(6, 7); });
  refused("q[3]", [](auto& p) { p.q[3] = std::nan(""); });
  refused("mu[1]: got -0.1", [](auto& p) { p.mu[1] = -0.1; });
  refused("mu[1]", [&](auto& p) { p.mu[1] = infinity; });
  refused("W(2, 2)", [&](auto& p) { p.W.coeffRef(2, 2) = infinity; });
}

Eigen::SparseMatrix<double> sparse(MatrixXd const& A) {
  return A.sparseView();
}

TEST_CASE("asymmetry: the largest difference over the largest entry") {
  Eigen::Matrix3d A;
  A << 4, 1, 0, 1.5, -8, 0, 0, 2, 3;
  CHECK(asymmetry(sparse(A)) == 0.25);
  CHECK(asymmetry(sparse(A + A.transpose())) == 0);
  CHECK(asymmetry(sparse(1e-300 * A)) == doctest::Approx(0.25));
  CHECK(asymmetry(sparse(0x1p1020 * A)) == 0.25);
  CHECK(asymmetry(sparse(A - A.transpose())) == 2);
  CHECK(asymmetry(sparse(Eigen::Matrix3d::Zero())) == 0);
  CHECK(asymmetry(sparse(MatrixXd(0, 0))) == 0);
  for (double const bad : {std::nan(""), std::numeric_limits<double>::infinity()}) {
    Eigen::Matrix3d B = A;
    B(0, 1) = bad;
    CHECK(std::isnan(asymmetry(sparse(B))));
    CHECK_THROWS_AS(require_symmetric("W", sparse(B)), slant::bad_input);
  }
  CHECK_THROWS_WITH_AS((void)asymmetry(sparse(MatrixXd::Zero(2, 3))),
                       "columns of W: got 3, expected as many as rows, 2", slant::bad_input);
}

TEST_CASE("asymmetry: what rounding does to H M^-1 H' is allowed, more is not") {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> number(-1, 1);
  auto const draw = [&] { return number(random); };
  MatrixXd const H = MatrixXd::NullaryExpr(60, 20, draw);
  VectorXd const m = VectorXd::NullaryExpr(20, [&] { return 2 + draw(); });
  MatrixXd W = (H * m.cwiseInverse().asDiagonal()) * H.transpose();
  CHECK(asymmetry(sparse(W)) > 0);
  CHECK_NOTHROW(require_symmetric("W", sparse(W)));
  W(3, 7) += 1e-5 * W.cwiseAbs().maxCoeff();
  double const found = asymmetry(sparse(W));
  CHECK(found == doctest::Approx(1e-5).epsilon(1e-3));
  CHECK(SLANT_COMPLAINT(require_symmetric("W.mtx", sparse(W)))
            .starts_with("W.mtx: got a matrix of asymmetry " + slant::detail::show(found) +
                         ", expected a symmetric one, max |W - W^T| <= "));
}

TEST_CASE("coefficients that depend on the slip are looked at whenever they are asked for") {
  auto const F = contact::slip_dependent(3, [](slant::index i, double s) {
    return i == 0 ? std::numeric_limits<double>::infinity() : i == 1 ? 0.25 - s : NAN;
  });
  CHECK(F(0, 1.0) == std::numeric_limits<double>::infinity());  // sticks
  CHECK(F(1, 0.25) == 0);
  CHECK(SLANT_COMPLAINT(F(1, 0.75)) ==
        "f[1]: got -0.5, expected a friction coefficient >= 0 for the slip 0.75");
  CHECK(SLANT_COMPLAINT(F(2, 0.5)) ==
        "f[2]: got nan, expected a friction coefficient >= 0 for the slip 0.5");
}

TEST_CASE("coefficients out of range are refused") {
  CHECK(SLANT_COMPLAINT(contact::coefficients(VectorXd{{0.1, -0.2}})) ==
        "F[1]: got -0.2, expected a finite number >= 0");
  CHECK(
      SLANT_COMPLAINT(contact::coefficients(VectorXd{{std::numeric_limits<double>::infinity()}})) ==
      "F[0]: got inf, expected a finite number >= 0");
  CHECK(SLANT_COMPLAINT(
            contact::orthotropic_coefficients(VectorXd{{0.1, 0.2}}, VectorXd{{0.3, NAN}})) ==
        "F2[1]: got nan, expected a finite number >= 0");
  CHECK(SLANT_COMPLAINT(contact::orthotropic_coefficients(VectorXd{{0.1, 0.2}}, VectorXd{{0.3}}))
            .starts_with("F2: got 1"));
}

}  // namespace friction_problem_test
