// SPDX-License-Identifier: MIT
//
// Example 1 of the lecture [K]: twelve unknowns, six discs, and how the proportioning constant Γ
// changes the work of KPRGP.
#include <cstdio>
#include <range/v3/view/filter.hpp>
#include <slant/iteration/solve.hpp>
#include <slant/methods/kprgp.hpp>
#include <slant/operators/matrix.hpp>
#include <slant/problems/separable_qp.hpp>
#include <slant/sets/block_range.hpp>
#include <slant/sets/contact_sets.hpp>
#include <support/command_line.hpp>

#include "example_1.hpp"

namespace {

int solve_example(double tolerance, double step) {
  Eigen::SparseMatrix<double> const A = example_1::matrix();
  Eigen::VectorXd const b = example_1::right_hand_side(), g = example_1::radii();
  auto const set = slant::discs<slant::planar>(g);  // the pairs are (x_i, x_{i+6})
  auto const qp =
      slant::separable_qp{slant::matrix<slant::self_adjoint, slant::positive_definite>(A), b, set};
  Eigen::VectorXd const zero = Eigen::VectorXd::Zero(12);
  auto const run = [&](double Γ, double accuracy) {
    // A given step length spares the products that would bound the largest eigenvalue.
    double const α = step / example_1::largest_eigenvalue;
    return slant::solve(slant::kprgp{qp, {.proportioning = Γ, .step_length = α}}, zero,
                        slant::reduced_gradient_below(accuracy) || slant::at_most(10000));
  };

  std::printf("Example 1 of [K]: 12 unknowns, 6 discs; KPRGP to a relative accuracy of %g\n\n",
              tolerance);
  std::printf("        Γ  products   printed  status\n");
  bool all_converged = true;
  for (auto const& row : example_1::printed) {
    auto const report = run(row.Γ, tolerance);
    auto const& work = report.state.work;
    all_converged = all_converged && report.converged();
    std::printf("%9g  %8td  %8d  %s\n", row.Γ, work.operator_applications + work.setup_applications,
                row.products, slant::to_string(report.status).data());
  }

  auto const report = run(1, 1e-14);
  auto const discs = slant::blocks(set, report.x());
  auto const is_active = [](auto const& disc) { return disc.state() != slant::block_state::free; };
  std::printf("\nsolution (%s)\n", report.reason.c_str());
  std::printf(" disc    radius                    x_i                x_{i+6}  state\n");
  for (auto const& disc : discs)
    std::printf("%5td  %8g  %21.14g  %21.14g  %s\n", disc.index() + 1, g[disc.index()],
                disc.value()[0], disc.value()[1], is_active(disc) ? "active" : "free");
  std::printf("\nactive set: {");
  char const* separator = "";
  for (auto const& disc : discs | ranges::views::filter(is_active)) {
    std::printf("%s%td", separator, disc.index() + 1);
    separator = ", ";
  }
  std::printf("}\n");
  return all_converged && report.converged() ? examples::succeeded : examples::not_converged;
}

}  // namespace

int main(int argc, char** argv) {
  examples::command_line app(
      "Example 1 of the lecture: products of KPRGP for eleven proportioning constants.",
      "tridiagonal");
  double tolerance = 1e-6;
  double step = 1;
  app.option("--tolerance", tolerance, "relative norm of the reduced gradient",
             examples::expects_tolerance());
  app.option(
      "--step", step, "step length times the bound 6 of the largest eigenvalue",
      examples::expects<double>("a number in (0, 2)", [](double s) { return s > 0 && s < 2; }));
  return app.run(argc, argv, [&] { return solve_example(tolerance, step); });
}
