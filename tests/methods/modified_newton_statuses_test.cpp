// SPDX-License-Identifier: MIT
//
// How runs of MSSN, IMSSN and GIMSSN end when they do not end well.
#include "mixture.hpp"

#include <slant/iteration/solve.hpp>
#include <slant/methods/mssn.hpp>
#include <slant/operators/declare.hpp>
#include <slant/operators/diagonal.hpp>

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <string>

namespace modified_newton_statuses_test {

using Eigen::VectorXd;

TEST_CASE("an accuracy beyond reach ends as stalled or converged, at the floor") {
  test::mixture const p(1e4);
  auto const A = test::spd(p.A);
  auto const qp = slant::separable_qp{A, p.b, p.set()};
  auto const r = slant::solve(slant::gimssn{qp}, VectorXd(VectorXd::Zero(20)),
                              slant::stop_when([](auto const&) { return false; }, ""));
  CHECK((r.status == slant::status::stalled || r.status == slant::status::converged));
  CHECK(r.state.reduced_gradient_norm <= 1e-13 * p.b.norm());
}

/// Well behaved `good` times.
struct fragile {
  static constexpr auto laws = slant::laws<slant::self_adjoint, slant::positive_definite>;
  int good;
  mutable int calls = 0;
  [[nodiscard]] slant::index rows() const { return 2; }
  [[nodiscard]] slant::index cols() const { return 2; }
  void apply(VectorXd const& x, VectorXd& y) const {
    y = x;
    y(1) *= 3;
    if (++calls > good) y(0) = std::nan("");
  }
};

TEST_CASE("a NaN that the operator makes later is a breakdown, not a result") {
  VectorXd const b{{1.0, 2.0}}, zero = VectorXd::Zero(2);
  auto const set = slant::intervals(VectorXd{{2.0, 0.5}});
  for (int good = 0; good < 3; ++good) {
    CAPTURE(good);
    auto const run = [&](auto make) {
      fragile const A{good};
      auto const r = slant::solve(make(slant::separable_qp{A, b, set}), zero,
                                  slant::reduced_gradient_below(1e-10) || slant::at_most(10));
      CHECK(r.status == slant::status::breakdown);
      CHECK(r.reason.find("left the range") != std::string::npos);
    };
    run([](auto const& qp) { return slant::mssn(qp, {.step_length = 0.3}); });
    run([](auto const& qp) { return slant::imssn(qp, {.step_length = 0.3}); });
    run([](auto const& qp) { return slant::gimssn(qp, {.step_length = 0.3}); });
  }
}

TEST_CASE("a face without a minimum: IMSSN breaks down, GIMSSN goes to the boundary") {
  auto const A = slant::declare<slant::self_adjoint, slant::positive_semidefinite>(
      slant::diagonal(VectorXd{{1.0, 0.0}}));
  VectorXd const b{{1.0, 1.0}}, zero = VectorXd::Zero(2);
  auto const set = slant::intervals(VectorXd{{5.0, 5.0}});
  auto const stop = slant::reduced_gradient_below(1e-10) || slant::at_most(100);
  auto const qp = slant::separable_qp{A, b, set};
  auto const i = slant::solve(slant::imssn{qp, {.step_length = 1.9}}, zero, stop);
  CHECK(i.status == slant::status::breakdown);
  CHECK(i.x().allFinite());
  auto const g = slant::solve(slant::gimssn{qp, {.step_length = 1.9}}, zero, stop);
  REQUIRE(g.converged());
  CHECK(g.x()(0) == doctest::Approx(1));
  CHECK(g.x()(1) == 5.0);
}

TEST_CASE("a right-hand side of zero is solved by zero, and bad starts are named") {
  test::mixture const p(30);
  auto const A = test::spd(p.A);
  VectorXd const b = VectorXd::Zero(20);
  auto const set = slant::intervals(VectorXd(VectorXd::Ones(20)));
  auto const qp = slant::separable_qp{A, b, set};
  auto const stop = slant::reduced_gradient_below(1e-10) || slant::at_most(100);
  auto const cold = slant::solve(slant::imssn{qp}, b, stop);
  CHECK(cold.converged());
  CHECK(cold.iterations() == 0);
  auto const warm = slant::solve(slant::gimssn{qp}, VectorXd(VectorXd::Ones(20)), stop);
  CHECK(warm.converged());
  CHECK(warm.x().norm() <= 1e-8);
  slant::mssn const method{qp};
  CHECK_THROWS_AS(static_cast<void>(method.start(VectorXd::Zero(19))), slant::bad_input);
  VectorXd x0 = VectorXd::Zero(20);
  x0(7) = std::numeric_limits<double>::infinity();
  CHECK_THROWS_WITH_AS(static_cast<void>(method.start(x0)),
                       "x0[7]: got inf, expected a finite number", slant::bad_input);
}

TEST_CASE("numbers beyond the range of the scalar are a breakdown") {
  VectorXd const b = VectorXd::Constant(10, 1.5e308);  // finite, but ‖b‖ is not
  slant::separable_qp const qp{
      slant::diagonal<slant::positive_definite>(VectorXd(2 * VectorXd::Ones(10))), b,
      slant::free_components(10)};
  auto const r = slant::solve(slant::imssn{qp}, VectorXd(VectorXd::Zero(10)),
                              slant::reduced_gradient_below(1e-8) || slant::at_most(10));
  CHECK(r.status == slant::status::breakdown);
}

}  // namespace modified_newton_statuses_test
