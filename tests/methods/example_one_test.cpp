// SPDX-License-Identifier: MIT
//
// Example 1 of the lecture: every method that has no test of its own on it finds the solution, in
// any scalar, with the products that are printed.
#include <slant/slant.hpp>

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <boost/multiprecision/eigen.hpp>
#include <support/minimise.hpp>
#include <support/testing.hpp>
#include "example_one.hpp"

namespace example_one_test {

using wide = boost::multiprecision::number<boost::multiprecision::cpp_bin_float<50>,
                                           boost::multiprecision::et_off>;
double const σ_max = 4 + 2 * std::cos(std::acos(-1.0) / 13);

TEST_CASE("the reference fulfils the optimality conditions") {
  test::example_one_solution<wide> const reference;
  CHECK(reference.residual < wide("1e-45"));
  CHECK(reference.feasible_elsewhere);
  CHECK(reference.multipliers.minCoeff() > wide(0));
}

/// ‖x − x*‖ / ‖x*‖, in wide arithmetic.
template <class V>
wide error_of(V const& x) {
  test::example_one_solution<wide> const reference;
  return (x.template cast<wide>() - reference.x).eval().norm() / reference.x.norm();
}

/// The discs 2, 3, 5 slide, and nothing else is on its boundary.
template <class S, class V>
void check_active(test::example_one<S> const& p, V const& x) {
  auto const active = slant::face_of(p.set(), x);
  for (slant::index i = 0; i < 6; ++i) {
    CAPTURE(i);
    bool const expected = i == 1 || i == 2 || i == 4;
    CHECK((active.state(i) == slant::block_state::sliding) == expected);
  }
}

TEST_CASE_TEMPLATE("KPRGP and the symmetric Newton method in every precision", S, float, double,
                   wide) {
  test::example_one<S> const p;
  auto const qp = slant::separable_qp{p.a(), p.b, p.set()};
  S const ε = std::numeric_limits<S>::epsilon();
  auto const r = test::minimise(slant::kprgp{qp}, p.zero(), S(4) * ε, 5000);
  REQUIRE(r.converged());
  CHECK(error_of(r.x()) <= wide(16) * wide(ε));
  check_active(p, r.x());
  auto const newton = test::minimise(slant::symmetric_newton{qp}, p.zero(), S(100) * ε, 50);
  REQUIRE(newton.converged());
  CHECK(error_of(newton.x()) <= wide(1000) * wide(ε));
  check_active(p, newton.x());
  CHECK(newton.state.descent.count() == 0);
  CHECK(newton.state.work.operator_applications <= (std::is_same_v<S, float> ? 40 : 90));
}

TEST_CASE("QPC: a first phase for other methods, as accurate as asked for") {
  test::example_one<double> const p;
  auto const qp = slant::separable_qp{p.a(), p.b, p.set()};
  for (double const tolerance : {1e-1, 1e-3, 1e-6}) {
    auto const r = test::minimise(slant::qpc{qp}, p.zero(), tolerance, 60);
    REQUIRE(r.converged());
    CHECK(error_of(r.x()) <= wide(10 * tolerance));
  }
}

// α̃ = 1/σ_max as in [K Fig. 4].
TEST_CASE("KPRGP and QPQ: within a third of the printed products, QPQ never with fewer") {
  // Products printed for QPQ beside those of KPRGP [K Table 1], for the same eleven Γ.
  constexpr std::array printed{43, 41, 39, 32, 37, 40, 48, 41, 38, 36, 36};
  test::example_one<double> const p;
  auto const qp = slant::separable_qp{p.a(), p.b, p.set()};
  auto const stop = slant::reduced_gradient_below(1e-6) || slant::at_most(200);
  slant::index total = 0, printed_total = 0;
  for (std::size_t k = 0; k < printed.size(); ++k) {
    auto const& [Γ, products] = example_1::printed[k];
    CAPTURE(Γ);
    slant::kprgp_options<double> const o{.proportioning = Γ, .step_length = 1 / σ_max};
    auto const check = [&](auto const& method, int expected) {
      auto const r = slant::solve(method, p.zero(), stop);
      REQUIRE(r.converged());
      CHECK(error_of(r.x()) <= wide(1e-5));
      CHECK(r.state.work.setup_applications == 0);
      auto const used = r.state.work.operator_applications;
      CHECK(3 * std::abs(used - expected) <= expected);
      return used;
    };
    auto const by_qpq = check(slant::qpq{qp, o}, printed[k]);
    CHECK(by_qpq >= check(slant::kprgp{qp, o}, products));
    total += by_qpq;
    printed_total += printed[k];
  }
  CHECK(std::abs(total - printed_total) <= printed_total / 10);
}

// [K Figure 4]: QPQ stagnates earlier than KPRGP. Released from a curved boundary, a block leaves
// it by half the square of its error, which is below the rounding errors when the error is √ε.
TEST_CASE("QPQ: the discontinuous conditions end at an accuracy of about √ε, and say so") {
  test::example_one<double> const p;
  auto const qp = slant::separable_qp{p.a(), p.b, p.set()};
  auto const stop = slant::reduced_gradient_below(1e-12) || slant::at_most(20000);
  auto const r = slant::solve(slant::qpq{qp, {.patience = 200}}, p.zero(), stop);
  CHECK(r.status == slant::status::stalled);
  CHECK(error_of(r.x()) <= wide(1e-7));
}

TEST_CASE("symmetric Newton method: superlinear convergence, the order of the last steps") {
  test::example_one<wide> const p;
  auto const qp = slant::separable_qp{p.a(), p.b, p.set()};
  auto const stop = slant::reduced_gradient_below(wide(1e-40)) || slant::at_most(50);
  std::vector<double> logarithms;
  auto const note = [&](auto const& s) {
    using std::log10;
    if (s.residual_norm > wide(0))
      logarithms.push_back(static_cast<double>(log10(wide(s.residual_norm / s.gradient_scale))));
  };
  slant::symmetric_newton const exact{
      qp, {.forcing = {.γ = 1e-49, .exponent = 2, .η_max = 1e-49, .η_first = 1e-49}}};
  auto const r = slant::solve(exact, p.zero(), stop, note);
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
  auto const inexact = slant::solve(slant::symmetric_newton{qp}, p.zero(), stop);
  CHECK(inexact.converged());
  CHECK(inexact.state.work.operator_applications < r.state.work.operator_applications);
}

}  // namespace example_one_test
