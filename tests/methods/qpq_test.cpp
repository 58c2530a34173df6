// SPDX-License-Identifier: MIT
#include "example_one.hpp"
#include "mixture.hpp"

#include <slant/iteration/iterates.hpp>
#include <slant/iteration/solve.hpp>
#include <slant/methods/kprgp.hpp>
#include <slant/operators/counted.hpp>

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <limits>
#include <oracle/dense_newton.hpp>
#include <support/allocation_guard.hpp>

namespace qpq_test {

using Eigen::VectorXd;
double const σ_max = 4 + 2 * std::cos(std::acos(-1.0) / 13);

/// Products printed for QPQ beside those of KPRGP [K Table 1].
struct printed {
  double Γ;
  int products;
};
constexpr std::array<printed, 11> table{{{100, 43},
                                         {10, 41},
                                         {5, 39},
                                         {1, 32},
                                         {0.5, 37},
                                         {0.4, 40},
                                         {0.2, 48},
                                         {0.1, 41},
                                         {0.05, 38},
                                         {0.01, 36},
                                         {0.001, 36}}};

TEST_CASE("Example 1: within a third of the printed products, and never fewer than KPRGP") {
  test::example_one<double> const p;
  test::example_one_solution<double> const solution;
  auto const qp = slant::separable_qp{p.a(), p.b, p.set()};
  auto const stop = slant::reduced_gradient_below(1e-6) || slant::at_most(200);
  int total = 0, printed_total = 0;
  for (auto const& row : table) {
    CAPTURE(row.Γ);
    slant::kprgp_options<double> const o{.proportioning = row.Γ, .step_length = 1 / σ_max};
    auto const r = slant::solve(slant::qpq{qp, o}, p.zero(), stop);
    REQUIRE(r.converged());
    CHECK((r.x() - solution.x).norm() <= 1e-5 * solution.x.norm());
    auto const products = int(r.state.work.operator_applications);
    CHECK(3 * std::abs(products - row.products) <= row.products);
    CHECK(products >=
          slant::solve(slant::kprgp{qp, o}, p.zero(), stop).state.work.operator_applications);
    total += products;
    printed_total += row.products;
  }
  CHECK(std::abs(total - printed_total) <= printed_total / 10);
}

// [K Figure 4]: QPQ stagnates earlier than KPRGP. Released from a curved boundary, a block leaves
// it by half the square of its error, which is below the rounding errors when the error is √ε.
TEST_CASE("the discontinuous conditions end at an accuracy of about √ε, and say so") {
  test::example_one<double> const p;
  test::example_one_solution<double> const solution;
  auto const qp = slant::separable_qp{p.a(), p.b, p.set()};
  auto const stop = slant::reduced_gradient_below(1e-12) || slant::at_most(20000);
  auto const r = slant::solve(slant::qpq{qp, {.patience = 200}}, p.zero(), stop);
  CHECK(r.status == slant::status::stalled);
  CHECK((r.x() - solution.x).norm() <= 1e-7 * solution.x.norm());
  CHECK(slant::solve(slant::kprgp{qp}, p.zero(), stop).converged());
}

TEST_CASE("bounds and intervals only: to the last digits, agreeing with dense Newton") {
  auto const M = test::with_spectrum(test::log_spaced(20, 100));
  VectorXd const b = 3 * test::random_vector(20, 5);
  auto const A = test::spd(M);
  auto const set = slant::cartesian(slant::half_lines(10), slant::intervals(VectorXd{{0.1, 1e-3}}),
                                    slant::free_components(8));
  oracle::dense_qp plain{M, b.cast<long double>(), {}, {}};
  for (Eigen::Index i = 0; i < 10; ++i) plain.intervals.push_back({i, 0});
  plain.intervals.push_back({10, -0.1, 0.1});
  plain.intervals.push_back({11, -1e-3, 1e-3});
  auto const reference = oracle::solve_dense(plain);
  auto const counting = slant::counted(A);
  auto const qp = slant::separable_qp{counting, b, set};
  auto const r = slant::solve(slant::qpq{qp}, VectorXd(VectorXd::Zero(20)),
                              slant::reduced_gradient_below(1e-12) || slant::at_most(1000));
  REQUIRE(r.converged());
  CHECK((r.x() - reference.x.cast<double>()).norm() <= 1e-10 * r.x().norm());
  CHECK(counting.applications() ==
        r.state.work.operator_applications + r.state.work.setup_applications);
}

TEST_CASE("q falls with every step, iterates are feasible, nothing is allocated") {
  test::mixture const p(1000);
  auto const A = test::spd(p.A);
  auto const set = p.set();
  slant::qpq const method{slant::separable_qp{A, p.b, set}};
  auto s = method.start(VectorXd(100 * test::random_vector(20, 9)));
  double last = std::numeric_limits<double>::infinity();
  bool seen[3] = {false, false, false};
  for (int k = 0; k < 100; ++k) {
    slant::testing::allocation_guard guard;
    method.step(s);
    auto const allocations = guard.count();
    CHECK(allocations == 0);
    CHECK(set.contains(s.x));
    double const q = s.x.dot(0.5 * (p.A * s.x) - p.b);
    CHECK(q <= last + 1e-13 * std::abs(last));
    last = q;
    seen[int(s.last_step)] = true;
  }
  CHECK((seen[0] && seen[1] && seen[2]));
}

}  // namespace qpq_test
