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
// the factorisation. Seconds are processor seconds of one thread, the smallest of three runs. Every
// step ends with a relative error of λ in the energy norm of at most 1e-8, which is checked,
// besides, against solutions to the last digits. Exit status 1 if it does not, or if twenty steps
// take more than three times as long as the first one.

#include <slant/contact/contact_data.hpp>
#include <slant/contact/dual.hpp>
#include <slant/contact/load_stepper.hpp>
#include <slant/contact/preconditioners.hpp>
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
  bool good = true;
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

/// Twenty steps, then the same cold; `exact` is computed if it is empty.
run run_scene(scene const& s, std::vector<vector>& exact) {
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

  for (int i = 1; i <= steps && static_cast<int>(exact.size()) < steps; ++i) {
    problem.update_load(s.load(i));
    auto const report = slant::solve(slant::symmetric_newton{qp, M}, λ[exact.size()],
                                     slant::reduced_gradient_below(1e-13) || slant::at_most(200));
    r.good = r.good && report.converged();
    exact.push_back(report.x());
  }
  r.error = largest_error(qp, λ, exact);
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
      "cold_over_warm,energy_error\n");
  bool good = true;
  for (int const k : sizes) {
    for (char const* const name : {"load", "lift", "slide"}) {
      scene const s = make_scene(name, k);
      std::vector<vector> exact;
      run best = run_scene(s, exact);
      for (int again = 1; again < 3; ++again) {
        run const r = run_scene(s, exact);
        best.first_seconds = std::min(best.first_seconds, r.first_seconds);
        best.all_seconds = std::min(best.all_seconds, r.all_seconds);
        best.cold_seconds = std::min(best.cold_seconds, r.cold_seconds);
      }
      double const ratio = best.all_seconds / best.first_seconds;
      double const later = best.all_seconds - best.first_seconds;
      std::printf("%s,%d,%.4f,%.4f,%.2f,%td,%td,%.4f,%.2f,%.1e\n", name, k, best.first_seconds,
                  best.all_seconds, ratio, best.first_products, best.all_products,
                  best.cold_seconds, best.cold_seconds * (steps - 1) / steps / later, best.error);
      std::fflush(stdout);
      good = good && best.good && best.error <= accuracy && ratio <= most;
    }
  }
  return good ? EXIT_SUCCESS : EXIT_FAILURE;
}
