// SPDX-License-Identifier: MIT
#include "example_one.hpp"

#include <slant/iteration/solve.hpp>
#include <slant/methods/kprgp.hpp>

#include <doctest/doctest.h>
#include <boost/multiprecision/cpp_bin_float.hpp>

#include <cmath>
#include <limits>

namespace kprgp_example_one_test {

using wide = boost::multiprecision::number<boost::multiprecision::cpp_bin_float<50>,
                                           boost::multiprecision::et_off>;

TEST_CASE("the reference fulfils the optimality conditions") {
  test::example_one_solution<wide> const reference;
  CHECK(reference.residual < wide("1e-45"));
  CHECK(reference.feasible_elsewhere);
  CHECK(reference.multipliers.minCoeff() > wide(0));
}

TEST_CASE("example 1: solution to 1e-12 and active discs 2, 3, 5") {
  test::example_one<double> const p;
  test::example_one_solution<wide> const reference;
  auto const qp = slant::separable_qp{p.a(), p.b, p.set()};
  auto const r = slant::solve(slant::kprgp{qp}, p.zero(),
                              slant::reduced_gradient_below(1e-15) || slant::at_most(500));
  REQUIRE(r.converged());
  for (Eigen::Index i = 0; i < 12; ++i) {
    CAPTURE(i);
    CHECK(abs(wide(r.x()(i)) - reference.x(i)) <= wide(1e-12) * reference.x.norm());
  }
  auto const active = slant::face_of(p.set(), r.x());
  for (slant::index i = 0; i < 6; ++i) {
    CAPTURE(i);
    bool const expected = i == 1 || i == 2 || i == 4;
    CHECK((active.state(i) == slant::block_state::sliding) == expected);
  }
}

// α̃ = 1/σ_max as in [K Fig. 4].
TEST_CASE("example 1: products to 1e-6 for the eleven printed Γ") {
  test::example_one<double> const p;
  auto const qp = slant::separable_qp{p.a(), p.b, p.set()};
  double const σ_max = 4 + 2 * std::cos(std::acos(-1.0) / 13);
  for (auto const& [Γ, products] : example_1::printed) {
    CAPTURE(Γ);
    auto const r =
        slant::solve(slant::kprgp{qp, {.proportioning = Γ, .step_length = 1 / σ_max}}, p.zero(),
                     slant::reduced_gradient_below(1e-6) || slant::at_most(500));
    REQUIRE(r.converged());
    CHECK(r.state.work.setup_applications == 0);
    double const ratio = double(r.state.work.operator_applications) / products;
    CHECK(ratio > 0.66);
    CHECK(ratio < 1.34);
  }
}

TEST_CASE_TEMPLATE("example 1 in every precision", S, float, double, long double, wide) {
  test::example_one<S> const p;
  test::example_one_solution<wide> const reference;
  auto const qp = slant::separable_qp{p.a(), p.b, p.set()};
  S const tolerance = S(4) * std::numeric_limits<S>::epsilon();
  auto const r = slant::solve(slant::kprgp{qp}, p.zero(),
                              slant::reduced_gradient_below(tolerance) || slant::at_most(5000));
  REQUIRE(r.converged());
  auto const error = (r.x().template cast<wide>() - reference.x).eval().norm();
  CHECK(error <= wide(16) * wide(std::numeric_limits<S>::epsilon()) * reference.x.norm());
  if constexpr (std::is_same_v<S, wide>) CHECK(error <= wide("1e-30"));
}

}  // namespace kprgp_example_one_test
