// SPDX-License-Identifier: MIT
#include <slant/slant.hpp>

#include <support/testing.hpp>
#include "made_programs.hpp"

namespace energy_error_test {

TEST_CASE("relative errors: of a solution that is zero, of one about which nothing is known") {
  CHECK(slant::energy_error<double>{.bound = 0, .size = 0}.relative() == 0);
  CHECK(slant::energy_error<double>{.bound = 1, .size = 3, .proven = true}.relative() == 0.5);
  CHECK(slant::energy_error<double>{.bound = 1, .size = 3}.relative() == 1);
  CHECK(std::isinf(slant::energy_error<double>{.bound = 2, .size = 1}.relative()));
  // An estimate just below the size at a point 1e13 solutions away: nothing is known.
  CHECK(std::isinf(slant::energy_error<double>{.bound = 1 - 1e-6, .size = 1}.relative()));
  CHECK(std::isinf(slant::energy_error<double>{}.relative()));
  double const nan = std::numeric_limits<double>::quiet_NaN();
  CHECK(std::isnan(slant::error_bound_of_root(nan, 0.0)));
  CHECK(std::isnan(slant::error_bound_of_root(0.0, nan)));
  double const inf = std::numeric_limits<double>::infinity();
  CHECK(slant::error_bound_of_root(inf, inf) == inf);
  CHECK(slant::error_bound_of_root(inf, 0.0) == inf);
  CHECK(slant::error_bound_of_root(0.0, inf) == inf);
  CHECK(slant::error_bound_of_root(0.0, 0.0) == 0);
  CHECK(slant::error_bound_of_root(2.0, 0.0) == doctest::Approx(2));
  CHECK(slant::error_bound_of_root(0.0, 2.0) == doctest::Approx(2));
  CHECK(slant::error_bound_of_root(1e-200, 1e-150) >= 1e-150);
  CHECK(slant::error_bound_of_root(1e200, 1e150) >= 1e200);
}

TEST_CASE("energy_error_below: kprgp stops by the error, asked only where it may say yes") {
  std::mt19937 random(5);
  auto const p = test::make_program(4, 3, random);
  auto const qp = test::program(p);
  auto const M = slant::matrix<slant::self_adjoint, slant::positive_definite>(p.inverse);
  slant::energy_certificate certificate(qp, slant::dominates_inverse(M));
  int asked = 0;
  auto const count = [&](VectorXd const& x) {
    ++asked;
    return certificate(x);
  };
  VectorXd const x0 = VectorXd::Zero(p.b.size());
  auto const run = slant::solve(slant::kprgp{qp}, x0,
                                slant::energy_error_below(1e-9, count) || slant::at_most(20000));
  CHECK(run.status == slant::status::converged);
  CHECK(run.reason.find("relative energy error") != std::string::npos);
  CHECK(test::energy_norm(p.A, run.x() - p.solution) <= 1e-9 * test::energy_norm(p.A, p.solution));
  CHECK(asked < 12);
  CHECK(asked < run.iterations());
}

TEST_CASE("energy_error_below: what the certificate denies is no success") {
  std::mt19937 random(5);
  auto const p = test::make_program(2, 1, random);
  auto const qp = test::program(p);
  auto const hopeless = [](VectorXd const&) {
    return slant::energy_error<double>{.bound = 0.5, .size = 1};
  };
  auto const run = slant::solve(slant::kprgp{qp}, test::zeros(p.b.size()),
                                slant::energy_error_below(1e-6, hopeless) || slant::at_most(5000));
  CHECK(run.status != slant::status::converged);
  CHECK_THROWS_AS(slant::energy_error_below(-1.0, hopeless), slant::bad_input);
  CHECK_THROWS_AS(slant::energy_error_below(1.5, hopeless), slant::bad_input);
}

}  // namespace energy_error_test
