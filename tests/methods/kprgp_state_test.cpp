// SPDX-License-Identifier: MIT
#include "mixture.hpp"

#include <slant/methods/kprgp.hpp>
#include <slant/operators/declare.hpp>

#include <doctest/doctest.h>

namespace kprgp_state_test {

using Eigen::VectorXd;

// P_Λ(x0), its gradient, the parts of the reduced gradient: by their definitions.
TEST_CASE("the first state is that of the projected start") {
  test::mixture const p(30);
  auto const A = test::spd(p.A);
  auto const set = p.set();
  slant::kprgp const method{slant::separable_qp{A, p.b, set}, {.step_length = 0.7}};
  VectorXd const x0 = 3 * test::random_vector(20, 11);
  auto const s = method.start(x0);
  CHECK(s.x == slant::project(set, x0));
  VectorXd const r = p.A * s.x - p.b;
  CHECK((s.unit * s.r - r).norm() <= 1e-14 * r.norm());
  CHECK(s.r.norm() <= 1);
  VectorXd const reduced = (s.x - slant::project(set, VectorXd(s.x - 0.7 * r))) / 0.7;
  CHECK((s.unit * s.reduced - reduced).norm() <= 1e-13 * r.norm());
  CHECK(s.reduced_gradient_norm == doctest::Approx(reduced.norm()).epsilon(1e-12));
  VectorXd free = reduced;
  s.face.keep(reduced, free);
  double const square = s.unit * s.unit;
  CHECK(s.φr * square == doctest::Approx(free.dot(r)).epsilon(1e-11));
  CHECK(s.βr * square == doctest::Approx((reduced - free).dot(r)).epsilon(1e-11));
  VectorXd const origin = slant::project(set, VectorXd(VectorXd::Zero(20)));
  VectorXd const there = slant::project(set, VectorXd(origin - 0.7 * (p.A * origin - p.b)));
  CHECK(s.gradient_scale == doctest::Approx((origin - there).norm() / 0.7));
  CHECK(s.iteration == 0);
  CHECK(s.status == slant::status::running);
  CHECK(s.work.operator_applications == 2);
  CHECK(method.start(VectorXd::Zero(20)).work.operator_applications == 1);
}

}  // namespace kprgp_state_test
