// SPDX-License-Identifier: MIT
//
// The work of the published active set methods on the model problems, in products with A until the
// relative reduced gradient is below 1e-4 and 1e-6, at most 5000:
//
//     active_set_products example_1      QPQ for eleven constants Γ beside the printed products
//     active_set_products wire [N]       l = 0, four radii, up to N unknowns (256)
//     active_set_products brick [K...]   three loads (k = 4, 6, 8)
//
// prints comma-separated values; an empty field was not reached. Exit status 1 if GIMSSN or KPRGP,
// which cannot but converge, have not reached 1e-4.

#include <slant/contact/dual.hpp>
#include <slant/factorizations/factorize.hpp>
#include <slant/iteration/solve.hpp>
#include <slant/methods/kprgp.hpp>
#include <slant/methods/mssn.hpp>
#include <slant/operators/matrix.hpp>

#include <fem/steel_brick.hpp>
#include <fem/string_1d.hpp>
#include <tridiagonal/example_1.hpp>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

namespace {

using vector = Eigen::VectorXd;

/// Runs one method and prints its row. True if it came to 1e-4.
template <class Method>
bool run(std::string const& scene, char const* name, Method const& method, vector const& zero) {
  slant::index at[2] = {-1, -1};
  double best = HUGE_VAL;
  double const tolerances[2] = {1e-4, 1e-6};
  auto const watch = [&](auto const& s) {
    best = std::fmin(best, s.reduced_gradient_norm / s.gradient_scale);
    for (int i = 0; i < 2; ++i) {
      if (at[i] < 0 && best <= tolerances[i]) at[i] = s.work.operator_applications;
    }
  };
  auto const r =
      slant::solve(method, zero,
                   slant::reduced_gradient_below(1e-6) || slant::at_most_applications(5000), watch);
  auto const field = [](slant::index n) { return n < 0 ? std::string() : std::to_string(n); };
  std::printf("%s,%s,%s,%s,%td,%td,%.1e,%s\n", scene.c_str(), name, field(at[0]).c_str(),
              field(at[1]).c_str(), r.iterations(), r.state.work.inner_iterations, best,
              slant::to_string(r.status).data());
  std::fflush(stdout);
  return at[0] >= 0;
}

/// All methods with their default options.
template <class QP>
bool compare(std::string const& scene, QP const& qp, vector const& zero) {
  run(scene, "MSSN", slant::mssn{qp}, zero);
  run(scene, "IMSSN", slant::imssn{qp}, zero);
  bool const gimssn = run(scene, "GIMSSN", slant::gimssn{qp}, zero);
  run(scene, "AS-S", slant::as_s(qp), zero);
  bool const kprgp = run(scene, "KPRGP", slant::kprgp{qp}, zero);
  run(scene, "QPQ", slant::qpq{qp}, zero);
  run(scene, "QPC", slant::qpc{qp}, zero);
  return gimssn && kprgp;
}

void print_header() {
  std::printf("scene,method,products_1e-4,products_1e-6,steps,inner_iterations,best,status\n");
}

/// [K Table 1].
bool example_one() {
  constexpr int printed[] = {43, 41, 39, 32, 37, 40, 48, 41, 38, 36, 36};
  auto const A = example_1::matrix();
  vector const b = example_1::right_hand_side(), g = example_1::radii(), zero = vector::Zero(12);
  auto const set = slant::discs<slant::planar>(g);
  auto const qp =
      slant::separable_qp{slant::matrix<slant::self_adjoint, slant::positive_definite>(A), b, set};
  double const σ_max = 4 + 2 * std::cos(std::acos(-1.0) / 13);
  std::printf("gamma,qpq,printed_qpq,kprgp,printed_kprgp\n");
  for (std::size_t i = 0; i < example_1::printed.size(); ++i) {
    slant::kprgp_options<double> const o{.proportioning = example_1::printed[i].Γ,
                                         .step_length = 1 / σ_max};
    auto const stop = slant::reduced_gradient_below(1e-6) || slant::at_most(1000);
    auto const q = slant::solve(slant::qpq{qp, o}, zero, stop);
    auto const k = slant::solve(slant::kprgp{qp, o}, zero, stop);
    std::printf("%g,%td,%d,%td,%d\n", example_1::printed[i].Γ, q.state.work.operator_applications,
                printed[i], k.state.work.operator_applications, example_1::printed[i].products);
  }
  print_header();
  return compare("example 1", qp, zero);
}

bool wires(int most_unknowns) {
  bool good = true;
  print_header();
  for (int n = 32; n <= most_unknowns; n *= 2) {
    for (double g : {1.4, 0.5, 0.1, 0.01}) {
      auto const wire = fem::make_wire(n / 4);
      auto const set = slant::cartesian(slant::half_lines(wire.m),
                                        slant::discs(vector::Constant(wire.m, g).eval()),
                                        slant::free_components(wire.m));
      auto const qp = slant::separable_qp{
          slant::matrix<slant::self_adjoint, slant::positive_definite>(wire.A), wire.b, set};
      char name[64];
      std::snprintf(name, sizeof name, "wire n=%d g=%g", n, g);
      good = compare(name, qp, vector::Zero(n)) && good;
    }
  }
  return good;
}

bool bricks(std::vector<int> const& sizes) {
  bool good = true;
  print_header();
  for (int const k : sizes) {
    for (auto const load : fem::brick_loads) {
      auto const scene = fem::make_steel_brick({.k = k, .load = load});
      slant::contact::data<double> const data{scene.N, scene.T, scene.f, scene.d, scene.g};
      slant::contact::dual const dual(slant::contact::friction_disc{}, slant::factorize(scene.K),
                                      data);
      auto const name = "brick k=" + std::to_string(k) + " " + std::string(fem::name_of(load));
      good = compare(name, dual.qp(), dual.zero()) && good;
    }
  }
  return good;
}

}  // namespace

int main(int argc, char** argv) {
  std::string const name = argc > 1 ? argv[1] : "";
  std::vector<int> numbers;
  for (int i = 2; i < argc; ++i) numbers.push_back(std::atoi(argv[i]));
  if (name == "example_1") return example_one() ? 0 : 1;
  if (name == "wire") return wires(numbers.empty() ? 256 : numbers[0]) ? 0 : 1;
  if (name == "brick") return bricks(numbers.empty() ? std::vector{4, 6, 8} : numbers) ? 0 : 1;
  std::fprintf(stderr, "usage: active_set_products example_1 | wire [N] | brick [K...]\n");
  return 2;
}
