// SPDX-License-Identifier: MIT
#include "methods/mixture.hpp"

#include <slant/concepts/bad_input.hpp>
#include <slant/operators/counted.hpp>
#include <slant/problems/separable_qp.hpp>

#include <doctest/doctest.h>

#include <cmath>

namespace separable_qp_test {

using Eigen::VectorXd;

TEST_CASE("lvalues are referenced, rvalues owned") {
  auto const A = test::spd(test::with_spectrum(test::log_spaced(3, 2)));
  VectorXd const b = VectorXd::Ones(3);
  auto const set = slant::half_lines(3);
  slant::separable_qp const views{A, b, set};
  CHECK(&views.a() == &A);
  CHECK(&views.b() == &b);
  CHECK(&views.set() == &set);
  CHECK(views.size() == 3);
  slant::separable_qp const owner{A, VectorXd(2 * b), slant::half_lines(3)};
  CHECK(owner.b() == 2 * b);
}

TEST_CASE("the energy costs no product") {
  test::mixture const p(10);
  auto const A = slant::counted(test::spd(p.A));
  slant::separable_qp const qp{A, p.b, p.set()};
  VectorXd const x = test::random_vector(20), r = p.A * x - p.b;
  CHECK(slant::energy(qp, x, r) ==
        doctest::Approx(0.5 * x.dot(p.A * x) - p.b.dot(x)).epsilon(1e-13));
  CHECK(A.applications() == 0);
}

TEST_CASE("sizes that do not match and numbers that are none are named") {
  test::mixture const p(10);
  auto const A = test::spd(p.A);
  using slant::bad_input;
  CHECK_THROWS_WITH_AS((slant::separable_qp{A, VectorXd(VectorXd::Ones(19)), p.set()}),
                       "A.rows(): got 20, expected the size of b, 19", bad_input);
  CHECK_THROWS_WITH_AS((slant::separable_qp{A, p.b, slant::half_lines(21)}),
                       "dimension of the set: got 21, expected the size of b, 20", bad_input);
  VectorXd b = p.b;
  b(4) = std::nan("");
  CHECK_THROWS_WITH_AS((slant::separable_qp{A, b, p.set()}),
                       "b[4]: got nan, expected a finite number", bad_input);
}

}  // namespace separable_qp_test
