// SPDX-License-Identifier: MIT
#include <slant/operators/operators.hpp>
#include <slant/slanting/slanting.hpp>

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
  CHECK(at_y(-p) == -plus);
  CHECK(at_y(3.0 * p) == 3 * plus);
  CHECK(at_y(2 * p) == 2 * plus);
  CHECK(at_y(slant::positive(0.5) * p) == plus / 2);
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
  out << F << "\n" << F.slant(y) << "\n" << -(2 * A * slant::positive_part(x + b));
  CHECK(out.str() ==
        "x ↦ x − max(0, x − 0.5 (A x − c))   (2 → 2)\n"
        "I − diag (I − 0.5 A)   (2 × 2, no laws)\n"
        "x ↦ −2 A max(0, x + c)   (2 → 2)");
}

TEST_CASE("temporaries are owned, variables referenced") {
  auto const f = [] { return slant::identity_map(3) - 2.0 * slant::positive_part(3); }();
  VectorXd const y{{1.0, -2.0, 4.0}};
  CHECK(slant::evaluate(f, y) == VectorXd{{-1.0, -2.0, -4.0}});
  auto const p = slant::positive_part(3);
  auto const g = p + p;
  CHECK(&g.term<0>() == &p);
}

TEST_CASE("operators of slant and Eigen matrices keep their own arithmetic") {
  MatrixXd const a = MatrixXd::Identity(2, 2);
  static_assert(!slant::slanting_map<MatrixXd>);
  CHECK(MatrixXd(a * a).isIdentity());
  CHECK(MatrixXd(2.0 * a - a).isIdentity());
}

}  // namespace arithmetic_test
