// SPDX-License-Identifier: MIT
//
// Coulomb friction on the steel brick against Tresca's problem at the slip bounds that it ends
// with:
//
//     coulomb [F [K...]]      default 0.3 6 8 10 12; three loads
//
// prints comma-separated values: products with A from zero until the relative error of λ in the
// energy norm is at most 1e-8, of
//
//     Newton          semismooth Newton on the residual of Alart and Curnier, GMRES
//     de Saxcé        the same on de Saxcé's natural map
//     radii           successive approximations: Tresca's problem with the slip bounds F λ_ν
//     cones           successive approximations: convex cone problems with the shifts μ‖u_t‖
//
// and their ratio to those of Tresca's problem by the symmetric Newton method. Exit status 1 if a
// run does not get there, if Newton takes more than 1.6 times as many, or if
// solutions to the last digits differ by more than 1e-8.

#include <slant/contact/contact_unknowns.hpp>
#include <slant/contact/coulomb.hpp>
#include <slant/contact/coulomb_newton.hpp>
#include <slant/factorizations/static_condensation.hpp>
#include <slant/iteration/solve.hpp>
#include <slant/methods/symmetric_newton.hpp>
#include <slant/operators/identity.hpp>

#include <fem/steel_brick.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

namespace {

namespace contact = slant::contact;
using vector = Eigen::VectorXd;

constexpr double accuracy = 1e-8;  // of λ, in the energy norm
constexpr double goal = 1e-11;     // residual that is more than enough for it
constexpr double most = 1.6;

/// Products until ‖λ − λ*‖_A ≤ accuracy ‖λ*‖_A, as `error` says; 0 if that is not reached.
struct outcome {
  slant::index products = 0;
  slant::index steps = 0;
};
template <class Method, class Error>
outcome run(Method const& method, vector const& start, Error error) {
  auto const accurate = slant::stop_when([&](auto const& s) { return error(s.x) <= accuracy; },
                                         "accurate", slant::status::converged);
  auto const r = slant::solve(method, start, accurate || slant::at_most(300));
  return {r.converged() ? r.state.work.operator_applications : 0, r.iterations()};
}

bool brick(fem::brick_load load, int k, double F) {
  auto const s = fem::make_steel_brick({.k = k, .load = load});
  contact::data<double> const data{s.N, s.T, s.f, s.d, s.g};
  slant::static_condensation const factor(s.K, contact::contact_unknowns(data));
  contact::dual problem(contact::friction_disc{}, factor, data);
  vector const μ = vector::Constant(s.d.size(), F);
  contact::coulomb_cones cones(problem, μ);
  contact::coulomb_radii radii(problem, contact::coefficients(μ));
  slant::identity_operator const I(problem.b().size());
  auto const ρ = contact::residual_step(cones).length;
  auto const alart_curnier = contact::coulomb_residual(cones, ρ);
  auto const de_saxce = contact::de_saxce_residual(cones, ρ);

  auto const exact = [&](auto const& F_) {
    auto const tight = slant::residual_below(1e-13) || slant::at_most(100);
    return slant::solve(contact::coulomb_newton(F_), problem.zero(), tight).x();
  };
  vector const x = exact(alart_curnier);
  vector const λ = cones.by_directions(x);
  auto const energy = [&](vector const& d) {
    vector image(d.size());
    auto const a = problem.a();
    auto w = slant::workspace(a, d);
    slant::apply(a, d, image, w);
    return std::sqrt(std::max(0.0, d.dot(image)));
  };
  double const size = energy(λ);
  auto const error = [&](vector const& y) { return energy(y - λ) / size; };
  auto const local_error = [&](vector const& y) { return error(cones.by_directions(y)); };

  auto const newton =
      run(contact::coulomb_newton(alart_curnier, goal), problem.zero(), local_error);
  auto const natural = run(contact::coulomb_newton(de_saxce, goal), problem.zero(), local_error);
  auto const by_radii = run(contact::coulomb(radii, I, {.goal = goal}), problem.zero(), error);
  auto const by_cones =
      run(contact::coulomb(cones, I, {.goal = goal}), problem.zero(), local_error);
  problem.update_bounds(μ.cwiseProduct(λ.head(μ.size()).cwiseMax(0)));
  slant::symmetric_newton_options<double> o;
  o.forcing.goal = goal;
  auto const tresca = run(slant::symmetric_newton{problem.qp(), o}, problem.zero(), error);

  double const difference = std::max(local_error(exact(de_saxce)), 0.0);
  auto const ratio = [&](outcome const& r) {
    return static_cast<double>(r.products) / static_cast<double>(tresca.products);
  };
  auto const row = [&](char const* method, outcome const& r) {
    std::printf("%s,%d,%g,%s,%td,%td,%.2f\n", fem::name_of(load).data(), k, F, method, r.products,
                r.steps, ratio(r));
  };
  row("Tresca", tresca);
  row("Newton", newton);
  row("de Saxcé", natural);
  row("radii", by_radii);
  row("cones", by_cones);
  std::fflush(stdout);
  bool const all = std::min({tresca.products, newton.products, natural.products, by_radii.products,
                             by_cones.products}) > 0;
  return all && std::max(ratio(newton), ratio(natural)) <= most && difference <= accuracy;
}

}  // namespace

int main(int argc, char** argv) {
  double const F = argc > 1 ? std::atof(argv[1]) : 0.3;
  std::vector<int> sizes;
  for (int i = 2; i < argc; ++i) sizes.push_back(std::atoi(argv[i]));
  if (sizes.empty()) sizes = {6, 8, 10, 12};
  if (!(F >= 0) || *std::min_element(sizes.begin(), sizes.end()) < 1) {
    std::fprintf(stderr, "usage: coulomb [F [K...]]\n");
    return 2;
  }
  std::printf("load,k,F,method,products,steps,over_tresca\n");
  bool good = true;
  for (int const k : sizes) {
    for (auto const load : fem::brick_loads) good = brick(load, k, F) && good;
  }
  return good ? EXIT_SUCCESS : EXIT_FAILURE;
}
