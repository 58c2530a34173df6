// SPDX-License-Identifier: MIT
#include "example_one.hpp"

#include <slant/iteration/solve.hpp>
#include <slant/methods/symmetric_newton.hpp>

#include <doctest/doctest.h>

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <boost/multiprecision/eigen.hpp>
#include <cmath>
#include <vector>

namespace symmetric_newton_example_one_test {

using precise = boost::multiprecision::number<boost::multiprecision::cpp_bin_float<50>,
                                              boost::multiprecision::et_off>;

/// All inner systems solved to the last digit that the scalar has.
template <class S>
slant::symmetric_newton_options<S> exactly(double tolerance) {
  slant::symmetric_newton_options<S> o;
  o.forcing = {.γ = tolerance, .exponent = 2, .η_max = tolerance, .η_first = tolerance};
  return o;
}

TEST_CASE_TEMPLATE("Example 1 in every precision", S, float, precise) {
  test::example_one<S> const p;
  auto const qp = slant::separable_qp{p.a(), p.b, p.set()};
  S const tolerance = S(100) * std::numeric_limits<S>::epsilon();
  auto const r = slant::solve(slant::symmetric_newton{qp}, p.zero(),
                              slant::reduced_gradient_below(tolerance) || slant::at_most(50));
  REQUIRE(r.converged());
  test::example_one_solution<S> const exact;
  CHECK(S((r.x() - exact.x).norm()) <= S(10) * tolerance * S(exact.x.norm()));
  CHECK(r.state.descent.count() == 0);
  CHECK(r.state.work.operator_applications <= (std::is_same_v<S, precise> ? 90 : 40));
}

TEST_CASE("superlinear convergence: the order of the last steps") {
  test::example_one<precise> const p;
  auto const qp = slant::separable_qp{p.a(), p.b, p.set()};
  std::vector<double> logarithms;
  auto const note = [&](auto const& s) {
    using std::log10;
    if (s.residual_norm > precise(0)) {
      logarithms.push_back(static_cast<double>(log10(precise(s.residual_norm / s.gradient_scale))));
    }
  };
  auto const r =
      slant::solve(slant::symmetric_newton{qp, exactly<precise>(1e-49)}, p.zero(),
                   slant::reduced_gradient_below(precise(1e-40)) || slant::at_most(50), note);
  REQUIRE(r.converged());
  auto const n = logarithms.size();
  REQUIRE(n >= 5);
  for (auto k = n - 2; k < n; ++k) {
    // e⁺ = C e^order; two logarithms of errors below 1e-3 tell the order well enough.
    CAPTURE(k);
    REQUIRE(logarithms[k - 1] < -3);
    CHECK(logarithms[k] / logarithms[k - 1] > 1.5);
  }
  // As accurately as the default asks for: order 3/2, in fewer products.
  auto const inexact =
      slant::solve(slant::symmetric_newton{qp}, p.zero(),
                   slant::reduced_gradient_below(precise(1e-40)) || slant::at_most(50));
  CHECK(inexact.converged());
  CHECK(inexact.state.work.operator_applications < r.state.work.operator_applications);
}

}  // namespace symmetric_newton_example_one_test
