// SPDX-License-Identifier: MIT
//
// The work of KPRGP on the model problems, in products with A:
//
//     kprgp_products example_1       eleven proportioning constants Γ beside the printed products
//     kprgp_products wire [N]        active constraints beside the printed ones, up to N unknowns
//     kprgp_products brick [K...]    error against work, three loads; the reference is the dense
//                                    one of tests/oracle, which shares no code with KPRGP
//
// prints comma-separated values. Exit status 1 if a run does not converge, a printed count is
// missed, or a brick does not come within 1e-6 of its reference in the energy norm.

#include <slant/contact/dual.hpp>
#include <slant/factorizations/factorize.hpp>
#include <slant/iteration/solve.hpp>
#include <slant/methods/kprgp.hpp>
#include <slant/operators/matrix.hpp>

#include <fem/active_counts.hpp>
#include <fem/steel_brick.hpp>
#include <fem/string_1d.hpp>
#include <fem/wire_counts.hpp>
#include <oracle/dense_contact_reference.hpp>
#include <tridiagonal/example_1.hpp>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

namespace {

using vector = Eigen::VectorXd;
using clock_type = std::chrono::steady_clock;

double seconds_since(clock_type::time_point start) {
  return std::chrono::duration<double>(clock_type::now() - start).count();
}

vector zero(Eigen::Index n) {
  return vector::Zero(n);
}

/// [K Ex 1]. α̃ = 1/σ_max as there; the last row is what kprgp does without options.
bool example_one() {
  auto const A = example_1::matrix();
  vector const b = example_1::right_hand_side();
  vector const g = example_1::radii();
  auto const set = slant::discs<slant::planar>(g);
  auto const qp =
      slant::separable_qp{slant::matrix<slant::self_adjoint, slant::positive_definite>(A), b, set};
  auto const stop = slant::reduced_gradient_below(1e-6) || slant::at_most(1000);
  vector const reference =
      slant::solve(slant::kprgp{qp}, zero(12), slant::reduced_gradient_below(1e-15)).x();
  auto const error = [&](vector const& x) { return (x - reference).norm() / reference.norm(); };
  double const σ_max = 4 + 2 * std::cos(std::acos(-1.0) / 13);

  bool good = true;
  std::printf("gamma,step_length_times_sigma_max,products,printed,ratio,relative_error\n");
  for (auto const& row : example_1::printed) {
    auto const r = slant::solve(
        slant::kprgp{qp, {.proportioning = row.Γ, .step_length = 1 / σ_max}}, zero(12), stop);
    good = good && r.converged();
    auto const products = r.state.work.operator_applications;
    std::printf("%g,1,%td,%d,%.2f,%.1e\n", row.Γ, products, row.products,
                double(products) / row.products, error(r.x()));
  }
  auto const r = slant::solve(slant::kprgp{qp, {.step_length = 1.9 / σ_max}}, zero(12), stop);
  std::printf("1,1.9,%td,,,%.1e\n", r.state.work.operator_applications, error(r.x()));
  return good && r.converged();
}

/// [T Tables 4.1, 4.2], [K Table 2], up to the given number of unknowns.
bool wires(int most_unknowns) {
  bool good = true;
  std::printf(
      "l,g,unknowns,active_bounds,printed_bounds,active_circles,printed_circles,products,"
      "seconds\n");
  for (auto const& row : fem::printed_wire_counts) {
    for (std::size_t e = 0; e < row.bounds.size() && row.unknowns(e) <= most_unknowns; ++e) {
      if (row.bounds[e] == fem::wire_counts::not_printed) continue;
      auto const wire = fem::make_wire(row.m(e));
      auto const set = slant::cartesian(slant::half_lines(vector::Constant(wire.m, row.l).eval()),
                                        slant::discs(vector::Constant(wire.m, row.g).eval()),
                                        slant::free_components(wire.m));
      auto const A = slant::matrix<slant::self_adjoint, slant::positive_definite>(wire.A);
      auto const start = clock_type::now();
      // The eigenvalues of tridiag(−1, 2, −1)/h lie below 4/h.
      auto const r = slant::solve(
          slant::kprgp{slant::separable_qp{A, wire.b, set}, {.step_length = 1.9 * wire.h() / 4}},
          zero(4 * wire.m), slant::reduced_gradient_below(1e-9) || slant::at_most(1000000));
      double const seconds = seconds_since(start);
      auto const counts = fem::count_active(set, wire.A, wire.b, r.x());
      good = good && r.converged() && counts.bounds == row.bounds[e] &&
             counts.circles == row.circles[e];
      std::printf("%g,%g,%d,%d,%d,%d,%d,%td,%.4f\n", row.l, row.g, row.unknowns(e), counts.bounds,
                  row.bounds[e], counts.circles, row.circles[e], r.state.work.operator_applications,
                  seconds);
      std::fflush(stdout);
    }
  }
  return good;
}

/// Iterate at the moment when the reduced gradient first fell below a tolerance.
struct snapshot {
  double tolerance;
  slant::index products;
  double seconds;
  vector λ;
};

bool brick(int k, fem::brick_load load) {
  auto const scene = fem::make_steel_brick({.k = k, .load = load});
  auto const reference =
      oracle::solve_contact({scene.K, scene.N, scene.T, scene.f, scene.d, scene.g});

  auto const begin = clock_type::now();
  auto const factor = slant::factorize(scene.K);
  slant::contact::data<double> const data{scene.N, scene.T, scene.f, scene.d, scene.g};
  slant::contact::dual const dual(slant::contact::friction_disc{}, factor, data);
  double const setup_seconds = seconds_since(begin);

  std::vector<snapshot> snapshots;
  double tolerance = 1e-3;
  auto const start = clock_type::now();
  auto const photographer = [&](auto const& s) {
    auto const products = s.work.operator_applications + s.work.setup_applications;
    while (tolerance > 0.5e-9 && s.reduced_gradient_norm <= tolerance * s.gradient_scale) {
      snapshots.push_back({tolerance, products, seconds_since(start), s.x});
      tolerance /= 10;
    }
  };
  auto const r =
      slant::solve(slant::kprgp{dual.qp()}, dual.zero(),
                   slant::reduced_gradient_below(1e-9) || slant::at_most(200000), photographer);

  double smallest = std::numeric_limits<double>::infinity();
  for (auto const& s : snapshots) {
    vector const u = dual.displacement(s.λ);
    double const error = oracle::energy_error(scene.K, u, reference.u);
    smallest = std::fmin(smallest, error);
    std::printf("%s,%d,%td,%td,%s,%g,%td,%.3f,%.4f,%.2e\n", fem::name_of(load).data(), k,
                scene.K.rows(), scene.contact_count(), factor.name().data(), s.tolerance,
                s.products, setup_seconds, s.seconds, error);
  }
  std::fflush(stdout);
  return r.converged() && smallest <= 1e-6;
}

bool bricks(std::vector<int> const& sizes) {
  std::printf(
      "load,k,unknowns,contact_nodes,factorization,tolerance,products,setup_seconds,solve_seconds,"
      "energy_error\n");
  bool good = true;
  for (auto const load : fem::brick_loads) {
    for (int const k : sizes) good = brick(k, load) && good;
  }
  return good;
}

}  // namespace

int main(int argc, char** argv) {
  std::string const name = argc > 1 ? argv[1] : "";
  std::vector<int> numbers;
  for (int i = 2; i < argc; ++i) numbers.push_back(std::atoi(argv[i]));
  bool good = false;
  if (name == "example_1") {
    good = example_one();
  } else if (name == "wire") {
    good = wires(numbers.empty() ? 256 : numbers[0]);
  } else if (name == "brick") {
    good = bricks(numbers.empty() ? std::vector{4, 6, 8} : numbers);
  } else {
    std::fprintf(stderr, "usage: kprgp_products example_1 | wire [N] | brick [K...]\n");
    return 2;
  }
  return good ? 0 : 1;
}
