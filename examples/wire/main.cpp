// SPDX-License-Identifier: MIT
//
// The wire [T §4.1, K Ex 2]: an elastic string over a plane and through a tube, solved by KPRGP;
// the numbers of active bounds and circles beside those printed in [T].
#include <cmath>
#include <cstdio>
#include <fem/active_counts.hpp>
#include <fem/string_1d.hpp>
#include <fem/wire_counts.hpp>
#include <optional>
#include <slant/iteration/solve.hpp>
#include <slant/methods/kprgp.hpp>
#include <slant/operators/matrix.hpp>
#include <slant/problems/separable_qp.hpp>
#include <slant/sets/cartesian.hpp>
#include <slant/sets/contact_sets.hpp>
#include <string>
#include <support/command_line.hpp>
#include <vector>

namespace {

struct settings {
  Eigen::Index unknowns = 256;
  std::optional<double> lower{};
  std::optional<double> radius{};
  double tolerance = 1e-9;
  slant::index max_iterations = 1000000;
};

/// What stands in the tables for this wire, if it was printed.
std::optional<fem::active_counts> printed_counts(double l, double g, Eigen::Index unknowns) {
  for (auto const& row : fem::printed_wire_counts)
    for (std::size_t entry = 0; entry < row.bounds.size(); ++entry)
      if (row.l == l && row.g == g && row.unknowns(entry) == unknowns &&
          row.bounds[entry] != fem::wire_counts::not_printed)
        return fem::active_counts{row.bounds[entry], row.circles[entry]};
  return std::nullopt;
}

/// "39:25", active and free constraints of one kind.
std::string ratio(int active, Eigen::Index m) {
  return std::to_string(active) + ":" + std::to_string(m - active);
}

/// Solves one wire and prints its row. True if it converged, to the printed counts if there are
/// any.
bool solve_row(fem::wire<> const& wire, double l, double g, settings const& s) {
  Eigen::Index const m = wire.m;
  auto const set = slant::cartesian(slant::half_lines(Eigen::VectorXd::Constant(m, l).eval()),
                                    slant::discs(Eigen::VectorXd::Constant(m, g).eval()),
                                    slant::free_components(m));
  auto const qp = slant::separable_qp{
      slant::matrix<slant::self_adjoint, slant::positive_definite>(wire.A), wire.b, set};
  // The eigenvalues of tridiag(−1, 2, −1)/h lie below 4/h: no product is spent on a bound.
  double const α = 1.9 * wire.h() / 4;
  auto const report =
      slant::solve(slant::kprgp{qp, {.step_length = α}}, Eigen::VectorXd::Zero(4 * m).eval(),
                   slant::reduced_gradient_below(s.tolerance) || slant::at_most(s.max_iterations));
  auto const counts = fem::count_active(set, wire.A, wire.b, report.x());
  auto const printed = printed_counts(l, g, 4 * m);
  std::printf("%6g %6g  %9s %9s  %9s %9s  %9td  %s\n", l, g, ratio(counts.bounds, m).c_str(),
              printed ? ratio(printed->bounds, m).c_str() : "-", ratio(counts.circles, m).c_str(),
              printed ? ratio(printed->circles, m).c_str() : "-",
              report.state.work.operator_applications, slant::to_string(report.status).data());
  std::fflush(stdout);
  return report.converged() && (!printed || counts == *printed);
}

int solve_wires(settings const& s) {
  auto const wire = fem::make_wire(s.unknowns / 4);
  std::printf("wire, %td unknowns: %td bounds, %td circles; KPRGP to a relative accuracy of %g\n\n",
              s.unknowns, wire.m, wire.m, s.tolerance);
  std::printf("                  bounds active:free   circles active:free\n");
  std::printf("     l      g       ours   printed       ours   printed   products  status\n");
  if (s.lower || s.radius) {
    return solve_row(wire, s.lower.value_or(0), s.radius.value_or(1), s) ? examples::succeeded
                                                                         : examples::not_converged;
  }
  bool all = true;
  for (auto const& row : fem::printed_wire_counts) all = solve_row(wire, row.l, row.g, s) && all;
  std::printf("\n%s\n", all ? "all counts that were printed are reproduced"
                            : "some runs did not converge or differ from the printed counts");
  return all ? examples::succeeded : examples::not_converged;
}

}  // namespace

int main(int argc, char** argv) {
  examples::command_line app(
      "The wire over a plane and through a tube. Without --lower and --radius: all printed cases.",
      "wire");
  settings s;
  app.option("--unknowns", s.unknowns, "number of unknowns, a multiple of 4",
             examples::expects<long long>("a multiple of 4, at least 4",
                                          [](long long n) { return n >= 4 && n % 4 == 0; }));
  app.option(
      "--lower", s.lower, "lower bound of the second component on the first half",
      examples::expects<double>("a number below infinity", [](double l) { return l < HUGE_VAL; }));
  app.option("--radius", s.radius, "radius of the tube on the second half",
             examples::expects<double>("a number >= 0", [](double g) { return g >= 0; }));
  app.option("--tolerance", s.tolerance, "relative norm of the reduced gradient",
             examples::expects_tolerance());
  app.option("--max-iterations", s.max_iterations, "steps at most", examples::expects_at_least(0));
  return app.run(argc, argv, [&] { return solve_wires(s); });
}
