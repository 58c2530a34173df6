// SPDX-License-Identifier: MIT
//
// What the methods for equality constraints, SMALSE-M and the constrained Newton method, have in
// common.
#include <slant/methods/methods.hpp>

#include <support/testing.hpp>
#include "equality_scenes.hpp"

namespace equality_methods_test {

using test::accurate;
using test::known_problem;

/// make(program, constraints) is the method.
auto const smalse = [](auto const& qp, auto const& c) { return slant::smalse(qp, c); };
auto const newton = [](auto const& qp, auto const& c) { return slant::constrained_newton(qp, c); };

template <class Make>
auto solved(known_problem const& p, Make const& make) {
  auto const qp = p.qp();
  auto const constraints = p.constraints();
  return slant::solve(make(qp, constraints), test::zeros(p.n), accurate(1e-10));
}

TEST_CASE("as many equations as unknowns: the point that they leave") {
  MatrixXd const root = test::random_matrix(4, 4, 5), A = root * root.transpose();
  MatrixXd const G = test::random_matrix(4, 4, 7);
  VectorXd const b = test::random_matrix(4, 1, 6), x{{1.0, 2.0, 0.5, 3.0}}, e = G * x;
  slant::equality_constraints const constraints(sparse(G.sparseView()), e);
  slant::separable_qp const qp{
      slant::matrix<slant::self_adjoint, slant::positive_semidefinite>(A), b,
      slant::cartesian(slant::free_components(4), slant::half_lines(0), slant::discs(VectorXd()))};
  auto const check = [&](auto const& method, double error) {
    auto const r = slant::solve(method, test::zeros(4), accurate(1e-12));
    CHECK(r.converged());
    CHECK((r.x() - x).norm() <= error);
  };
  check(smalse(qp, constraints), 1e-11);
  check(newton(qp, constraints), 1e-12);
}

TEST_CASE("a load that a bound absorbs does not spoil the accuracy") {
  // x_4 and x_6 are at their bounds; −b there may be as large as it likes.
  auto const check = [](double load, double error, auto const& make) {
    known_problem p;
    p.b[4] -= load;
    p.b[6] -= load / 10;
    auto const r = solved(p, make);
    CHECK(r.converged());
    CHECK((r.x() - p.x).norm() <= error);
  };
  check(1e4, 1e-7, smalse);
  check(1e6, 1e-8, newton);
}

TEST_CASE("constraints that no point of the set satisfies are named") {
  known_problem p;
  p.G.row(0).setZero();
  p.G(0, 4) = p.G(0, 5) = 1;  // x_4 + x_5 = −1, both in half lines
  p.e[0] = -1;
  auto const check = [](auto const& r) {
    CHECK(r.status == slant::status::stalled);
    CHECK(r.state.infeasible);
    CHECK(r.reason == "no point of the set satisfies the equality constraints");
  };
  check(solved(p, smalse));
  auto const r = solved(p, newton);
  check(r);
  CHECK(r.state.fallback_count >= 1);
}

TEST_CASE("a start is projected, a step does not allocate, bad input is refused") {
  known_problem const p;
  auto const qp = p.qp();
  auto const constraints = p.constraints();
  slant::equality_constraints const other(sparse(1, 3), test::zeros(1));
  auto const check = [&](auto const& make) {
    auto const method = make(qp, constraints);
    auto state = method.start(VectorXd::Constant(p.n, -3.0));
    CHECK(qp.set().contains(state.x));
    slant::testing::allocation_guard guard;
    method.step(state);
    method.step(state);
    auto const allocations = guard.count();
    CHECK(allocations == 0);
    CHECK_THROWS_AS(static_cast<void>(make(qp, other)), slant::bad_input);
    CHECK_THROWS_AS(static_cast<void>(method.start(VectorXd::Zero(3))), slant::bad_input);
    return state;
  };
  check(smalse);
  CHECK(check(newton).last_step != slant::constrained_newton_step::fallback);
  CHECK_THROWS_AS((slant::smalse{qp, constraints, {.penalty = 0}}), slant::bad_input);
  CHECK_THROWS_AS((slant::constrained_newton{qp, constraints, {.inner_steps = 0}}),
                  slant::bad_input);
}

}  // namespace equality_methods_test
