// SPDX-License-Identifier: MIT
//
// resume(state, x0) after the linear term and the set have changed: what start(x0) would give.
#include <slant/slant.hpp>

#include <support/minimise.hpp>
#include <support/testing.hpp>
#include "mixture.hpp"

namespace resume_test {

/// Steps of one method, then another b and other discs in the same places, then the two ways on.
template <class Make>
void check_same_as_start(Make make) {
  Eigen::Index const m = 8;
  test::mixture const p(30);
  MatrixXd const dense = p.A.topLeftCorner(2 * m, 2 * m);
  auto const A = slant::counted(test::spd(dense));
  VectorXd b = 4 * test::random_vector(2 * m, 5);
  auto set = slant::discs(VectorXd::Constant(m, 0.5).eval());
  slant::separable_qp const qp{A, b, set};
  auto const method = make(qp);
  auto s = method.start(test::random_vector(2 * m, 7));
  for (int i = 0; i < 5; ++i) method.step(s);

  b = 1e3 * test::random_vector(2 * m, 9);
  set.update(VectorXd::LinSpaced(m, 0, 300).eval());
  VectorXd const x0 = 100 * test::random_vector(2 * m, 11);
  A.reset_counts();
  CHECK(test::allocations_of([&] { method.resume(s, x0); }) == 0);
  CHECK(A.applications() == 1);
  CHECK(s.work.operator_applications == 1);
  CHECK(s.work.setup_applications == 0);
  CHECK(s.iteration == 0);

  auto fresh = method.start(x0);
  for (int i = 0; i < 10; ++i) {
    CAPTURE(i);
    CHECK(s.x == fresh.x);
    CHECK(s.r == fresh.r);
    CHECK(s.unit == fresh.unit);
    CHECK(s.reduced_gradient_norm == fresh.reduced_gradient_norm);
    CHECK(s.gradient_scale == fresh.gradient_scale);
    CHECK(s.iteration == fresh.iteration);
    CHECK(s.status == fresh.status);
    CHECK(s.work.operator_applications == fresh.work.operator_applications);
    method.step(s);
    method.step(fresh);
  }
  // From a state at rest.
  auto end = test::minimise(method, x0, 1e-9, 5000);
  CHECK(end.converged());
  b.setZero();
  method.resume(end.state, x0);
  CHECK(end.state.status == slant::status::converged);
  CHECK(end.state.x.norm() == 0);

  CHECK_THROWS_WITH_AS(method.resume(s, VectorXd::Zero(3)), "x0: got 3, expected the size of b, 16",
                       slant::bad_input);
  CHECK_THROWS_WITH_AS(method.resume(s, VectorXd::Constant(2 * m, std::nan(""))),
                       "x0[0]: got nan, expected a finite number", slant::bad_input);
}

TEST_CASE("symmetric_newton") {
  check_same_as_start([](auto const& qp) { return slant::symmetric_newton{qp}; });
}
TEST_CASE("kprgp") {
  check_same_as_start([](auto const& qp) { return slant::kprgp{qp}; });
}
TEST_CASE("gimssn, whose iterates stay in the set") {
  check_same_as_start([](auto const& qp) { return slant::gimssn{qp}; });
}
TEST_CASE("imssn, whose iterates do not") {
  check_same_as_start([](auto const& qp) { return slant::imssn{qp}; });
}

}  // namespace resume_test
