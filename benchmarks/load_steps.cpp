// SPDX-License-Identifier: MIT
//
// Twenty load steps on the steel brick against the first one, and against twenty cold solves:
//
//     load_steps [K...]      default 8 12 16; scenes
//         load               press, the load grows from a twentieth to all of it, g fixed
//         lift               press, and the traction that lifts the right end grows
//         slide              press, and a traction on top grows that drags the brick along the
//                            floor
//
// prints comma-separated values. The first step is charged with all there is to do: factorisation,
// preconditioner, b, iterations, recovery of u; each later one with new data, iterations, recovery;
// a cold solve with new data, iterations from zero with a method of its own, recovery, but not with
// the factorisation. Beside them twenty steps by contact::primal_stepper, levels included, and their
// first one. Seconds are processor seconds of one thread, the smallest of three runs. Every step
// ends with a relative error of λ, or of u, in the energy norm of at most 1e-8, which is checked,
// besides, against solutions to the last digits. Exit status 1 if it does not, or if twenty steps
// take more than three times as long as the first one (of primal_stepper, whose first step
// is a small part of a factorisation: 12 times).

#include <slant/contact/contact_data.hpp>
#include <slant/contact/dual.hpp>
#include <slant/contact/load_stepper.hpp>
#include <slant/contact/preconditioners.hpp>
#include <slant/contact/primal_stepper.hpp>
#include <slant/factorizations/static_condensation.hpp>
#include <slant/methods/symmetric_newton.hpp>
#include <slant/methods/unconstrained_start.hpp>

#include <fem/steel_brick.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <string>
#include <vector>

namespace {

namespace contact = slant::contact;
using vector = Eigen::VectorXd;

constexpr int steps = 20;
constexpr double accuracy = 1e-8;   // of λ, in the energy norm
constexpr double tolerance = 1e-9;  // of the reduced gradient, enough for that
constexpr double most = 3;          // ratio of twenty steps to the first
constexpr double most_iterated = 12;

double processor_seconds() {
  return static_cast<double>(std::clock()) / static_cast<double>(CLOCKS_PER_SEC);
}

/// A brick and its loads.
struct scene {
  std::string name;
  fem::contact_scene<3> brick;
  vector fixed;    // part of f
  vector growing;  // part of f that comes step by step

  [[nodiscard]] vector load(int step) const {
    return fixed + (static_cast<double>(step) / steps) * growing;
  }
};

scene make_scene(std::string name, int k) {
  auto const press = fem::make_steel_brick({.k = k});
  vector const none = vector::Zero(press.f.size());
  if (name == "load") return {std::move(name), press, none, press.f};
  if (name == "lift") {
    auto const lift = fem::make_steel_brick({.k = k, .load = fem::brick_load::lift});
    return {std::move(name), lift, press.f, lift.f - press.f};
  }
  vector drag = none;
  fem::add_tractions<3>(fem::make_brick_mesh(k, Eigen::Vector3d(3, 1, 1)), press.unknowns,
                        {{fem::brick_side::top, Eigen::Vector3d(0.6, 0.2, 0)}}, drag);
  return {std::move(name), press, press.f, drag};
}

slant::symmetric_newton_options<double> newton_options() {
  slant::symmetric_newton_options<double> o;
  o.forcing.goal = tolerance;
  return o;
}

auto stop() {
  return slant::reduced_gradient_below(tolerance) || slant::at_most(100);
}

struct run {
  double first_seconds = 0;
  double all_seconds = 0;
  slant::index first_products = 0;
  slant::index all_products = 0;
  double cold_seconds = 0;
  double error = 0;  // largest relative error in the energy norm
  double iterated_first_seconds = 0;
  double iterated_seconds = 0;
  slant::index iterated_products = 0;
  double iterated_error = 0;
  bool good = true;

  void take_faster(run const& other) {
    first_seconds = std::min(first_seconds, other.first_seconds);
    all_seconds = std::min(all_seconds, other.all_seconds);
    cold_seconds = std::min(cold_seconds, other.cold_seconds);
    iterated_first_seconds = std::min(iterated_first_seconds, other.iterated_first_seconds);
    iterated_seconds = std::min(iterated_seconds, other.iterated_seconds);
    good = good && other.good;
  }
};

/// Solutions of all steps to the last digits.
struct exact_path {
  std::vector<vector> λ, u;
};

/// Relative errors of λ in the energy norm.
template <class QP>
double largest_error(QP const& qp, std::vector<vector> const& λ, std::vector<vector> const& exact) {
  auto w = slant::workspace(qp.a(), exact.front());
  vector image(exact.front().size());
  auto const energy = [&](vector const& x) {
    slant::apply(qp.a(), x, image, w);
    return std::sqrt(std::max(0.0, x.dot(image)));
  };
  double largest = 0;
  for (std::size_t i = 0; i < λ.size(); ++i) {
    largest = std::max(largest, energy(λ[i] - exact[i]) / energy(exact[i]));
  }
  return largest;
}

/// Twenty steps without factors.
void iterate(scene const& s, std::vector<vector> const& exact, run& r) {
  auto const energy = [&](vector const& u) { return std::sqrt(u.dot(vector(s.brick.K * u))); };
  std::vector<vector> u;
  contact::solve_options<double> o{.tolerance = accuracy};
  o.layout = contact::layout_of(s.brick.mesh.nodes, s.brick.unknowns.first);
  double const begin = processor_seconds();
  contact::primal_stepper stepper(
      s.brick.K, contact::data<double>{s.brick.N, s.brick.T, s.load(1), s.brick.d, s.brick.g}, o);
  for (int i = 1; i <= steps; ++i) {
    auto const& report = stepper.advance({.f = s.load(i)});
    r.good = r.good && report.converged();
    r.iterated_products += report.work.operator_applications;
    u.push_back(report.u);
    if (i == 1) r.iterated_first_seconds = processor_seconds() - begin;
  }
  r.iterated_seconds = processor_seconds() - begin;
  for (std::size_t i = 0; i < u.size(); ++i) {
    r.iterated_error = std::max(r.iterated_error, energy(u[i] - exact[i]) / energy(exact[i]));
  }
}

/// Twenty steps, then the same cold, then without factors; `exact` is computed if it is empty.
run run_scene(scene const& s, exact_path& exact) {
  run r;
  std::vector<vector> λ;
  double displacements = 0;  // to be used: the recovery must not be optimised away
  double const begin = processor_seconds();
  contact::data<double> const data{s.brick.N, s.brick.T, s.load(1), s.brick.d, s.brick.g};
  slant::condensation_options condensation;
  condensation.applications *= steps / 2;  // later steps need half of what the first one does
  condensation.most_memory = 2;
  slant::static_condensation const factor(s.brick.K, contact::contact_unknowns(data), condensation);
  contact::dual problem(contact::friction_disc{}, factor, data);
  auto const qp = problem.qp();
  auto const M = contact::lumped_preconditioner(s.brick.K, problem.constraints());
  contact::load_stepper stepper(problem, slant::symmetric_newton{qp, M, newton_options()}, stop(),
                                slant::unconstrained_start(qp, M).x);
  for (int i = 1; i <= steps; ++i) {
    contact::load_step<double> next;
    if (i > 1) next.f = s.load(i);
    auto const& report = stepper.advance(std::move(next));
    displacements += problem.displacement(report.x()).norm();
    r.good = r.good && report.converged();
    r.all_products += report.work.operator_applications + report.work.setup_applications;
    λ.push_back(report.x());
    if (i == 1) {
      r.first_seconds = processor_seconds() - begin;
      r.first_products = r.all_products;
    }
  }
  r.all_seconds = processor_seconds() - begin;

  double const cold = processor_seconds();
  for (int i = 1; i <= steps; ++i) {
    problem.update_load(s.load(i));
    slant::symmetric_newton const method{qp, M, newton_options()};
    auto const report = slant::solve(method, problem.zero(), stop());
    displacements += problem.displacement(report.x()).norm();
    r.good = r.good && report.converged();
  }
  r.cold_seconds = processor_seconds() - cold;

  for (int i = 1; i <= steps && static_cast<int>(exact.λ.size()) < steps; ++i) {
    problem.update_load(s.load(i));
    auto const report = slant::solve(slant::symmetric_newton{qp, M}, λ[exact.λ.size()],
                                     slant::reduced_gradient_below(1e-13) || slant::at_most(200));
    r.good = r.good && report.converged();
    exact.λ.push_back(report.x());
    exact.u.push_back(problem.displacement(report.x()));
  }
  r.error = largest_error(qp, λ, exact.λ);
  iterate(s, exact.u, r);
  r.good = r.good && std::isfinite(displacements);
  return r;
}

}  // namespace

int main(int argc, char** argv) {
  std::vector<int> sizes;
  for (int i = 1; i < argc; ++i) sizes.push_back(std::atoi(argv[i]));
  if (sizes.empty()) sizes = {8, 12, 16};
  if (*std::min_element(sizes.begin(), sizes.end()) < 1) {
    std::fprintf(stderr, "usage: load_steps [K...]\n");
    return 2;
  }
  std::printf(
      "scene,k,first_seconds,twenty_seconds,ratio,first_products,twenty_products,cold_seconds,"
      "cold_over_warm,energy_error,iterated_first_seconds,iterated_twenty_seconds,iterated_ratio,"
      "iterated_twenty_products,iterated_energy_error\n");
  bool good = true;
  for (int const k : sizes) {
    for (char const* const name : {"load", "lift", "slide"}) {
      scene const s = make_scene(name, k);
      exact_path exact;
      run best = run_scene(s, exact);
      for (int again = 1; again < 3; ++again) best.take_faster(run_scene(s, exact));
      double const ratio = best.all_seconds / best.first_seconds;
      double const later = best.all_seconds - best.first_seconds;
      double const iterated_ratio = best.iterated_seconds / best.iterated_first_seconds;
      std::printf("%s,%d,%.4f,%.4f,%.2f,%td,%td,%.4f,%.2f,%.1e,%.4f,%.4f,%.2f,%td,%.1e\n", name, k,
                  best.first_seconds, best.all_seconds, ratio, best.first_products,
                  best.all_products, best.cold_seconds,
                  best.cold_seconds * (steps - 1) / steps / later, best.error,
                  best.iterated_first_seconds, best.iterated_seconds, iterated_ratio,
                  best.iterated_products, best.iterated_error);
      std::fflush(stdout);
      good = good && best.good && best.error <= accuracy && ratio <= most &&
             best.iterated_error <= accuracy && iterated_ratio <= most_iterated;
    }
  }
  return good ? EXIT_SUCCESS : EXIT_FAILURE;
}
