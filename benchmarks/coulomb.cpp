// SPDX-License-Identifier: MIT
//
// Coulomb friction against Tresca's problem at the slip bounds that it ends with:
//
//     coulomb brick [F [K...]]     the steel brick, three loads; default 0.3 6 8 10 12
//     coulomb models [F...]        two bricks in space, two plates in the plane; default 0 0.3 1 2
//
// prints comma-separated values: products with A until the relative error of λ in the energy norm
// is at most 1e-8, those of the start (unconstrained_start) included, of
//
//     Newton          semismooth Newton on the residual of Alart and Curnier, GMRES
//     de Saxcé        the same on de Saxcé's natural map
//     radii           successive approximations: Tresca's problem with the slip bounds F λ_ν
//     cones           successive approximations: convex cone problems with the shifts μ‖u_t‖
//
// and of what a user gets who does not choose, to the residual that it is asked for,
//
//     default         the methods of certified_coulomb at its tolerance 1e-8, a residual of 1e-10;
//                     all products, those of set-up too, without those of the certificate
//
// and their ratio to those of Tresca's problem by the symmetric Newton method. Exit status 1
//
//     if a run does not get there, so that solutions do not agree to 1e-8: all are measured
//         against that of Newton's method to the last digits (`cones` for F > 1 excepted, which
//         are no contraction there)
//     if that solution and the one of de Saxcé's map, also to the last digits, differ by more
//     with `brick`, if the default, Newton or de Saxcé take more than 1.6 times as many products
//
// Successive approximations take more than 1.6 times as many on most loads, being of linear
// convergence with a restart in every step: their ratios are printed and not judged.

#include <slant/contact/certified_coulomb.hpp>
#include <slant/contact/contact_data.hpp>
#include <slant/contact/coulomb/coulomb.hpp>
#include <slant/factorizations/static_condensation.hpp>
#include <slant/iteration/solve.hpp>
#include <slant/methods/symmetric_newton.hpp>
#include <slant/methods/unconstrained_start.hpp>
#include <slant/operators/identity.hpp>

#include <fem/steel_brick.hpp>
#include <fem/two_bricks.hpp>
#include <fem/two_plates.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <string>
#include <vector>

namespace {

namespace contact = slant::contact;
using vector = Eigen::VectorXd;

constexpr double accuracy = 1e-8;  // of λ, in the energy norm
constexpr double goal = 1e-11;     // residual that is more than enough for it
constexpr double most = 1.6;

/// Products, those before the method included, until ‖λ − λ*‖_A ≤ accuracy ‖λ*‖_A, as `error` says;
/// 0 if that is not reached.
struct outcome {
  slant::index products = 0;
  slant::index steps = 0;
};
template <class Method, class Error>
outcome run(Method const& method, vector const& start, slant::index before, Error error) {
  auto const accurate = slant::stop_when([&](auto const& s) { return error(s.x) <= accuracy; },
                                         "accurate", slant::status::converged);
  auto const r = slant::solve(method, start, accurate || slant::at_most(300));
  return {r.converged() ? r.state.work.operator_applications + before : 0, r.iterations()};
}

/// A row per method; whether all is as it should be.
template <class Friction, int D>
bool compare(fem::contact_scene<D> const& s, std::string const& name, int k, double F,
             double limit) {
  contact::data<double> const data{s.N, s.T, s.f, s.d, s.g};
  slant::static_condensation const factor(s.K, contact::contact_unknowns(data));
  contact::dual problem(Friction{}, factor, data);
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

  // Every contact sticks still, so that the start keeps its tangential forces.
  auto const start = slant::unconstrained_start(radii.qp());
  vector const local_start = cones.by_contacts(start.x);
  slant::index const before = start.applications;
  auto const newton =
      run(contact::coulomb_newton(alart_curnier, goal), local_start, before, local_error);
  auto const natural =
      run(contact::coulomb_newton(de_saxce, goal), local_start, before, local_error);
  auto const by_radii = run(contact::coulomb(radii, I, {.goal = goal}), start.x, before, error);
  auto const by_cones =
      run(contact::coulomb(cones, I, {.goal = goal}), local_start, before, local_error);
  problem.update_bounds(μ.cwiseProduct(λ.head(μ.size()).cwiseMax(0)));
  slant::symmetric_newton_options<double> o;
  o.forcing.goal = goal;
  auto const tresca = run(slant::symmetric_newton{problem.qp(), o}, start.x, before, error);

  double const difference = local_error(exact(de_saxce));
  // The law alone is the check: the certificate would count its own products.
  contact::coulomb_check const check(problem, μ);
  auto const by_default = contact::detail::solve_by_all_methods(
      problem, μ, {.tolerance = 1e-10},
      [&](vector const& forces, vector const& u) { return check(forces, u).relative; });
  outcome automatic{by_default.work.operator_applications + by_default.work.setup_applications,
                    by_default.steps};
  if (!by_default.converged() || !(error(by_default.λ) <= accuracy)) automatic.products = 0;
  auto const ratio = [&](outcome const& r) {
    return static_cast<double>(r.products) / static_cast<double>(tresca.products);
  };
  auto const row = [&](char const* method, outcome const& r) {
    std::printf("%s,%d,%g,%s,%td,%td,%.2f\n", name.c_str(), k, F, method, r.products, r.steps,
                ratio(r));
  };
  row("Tresca", tresca);
  row("Newton", newton);
  row("de Saxcé", natural);
  row("radii", by_radii);
  row("cones", by_cones);
  row("default", automatic);
  std::fflush(stdout);
  bool const all = std::min({tresca.products, newton.products, natural.products, by_radii.products,
                             automatic.products}) > 0 &&
                   (F > 1 || by_cones.products > 0);
  return all && std::max({ratio(automatic), ratio(newton), ratio(natural)}) <= limit &&
         difference <= accuracy;
}

bool bricks(double F, std::vector<int> const& sizes) {
  bool good = true;
  for (int const k : sizes) {
    for (auto const load : fem::brick_loads) {
      good = compare<contact::friction_disc>(fem::make_steel_brick({.k = k, .load = load}),
                                             std::string(fem::name_of(load)), k, F, most) &&
             good;
    }
  }
  return good;
}

bool models(std::vector<double> const& coefficients) {
  double const none = std::numeric_limits<double>::infinity();
  bool good = true;
  for (double const F : coefficients) {
    good = compare<contact::friction_disc>(fem::make_two_bricks(10), "bricks", 10, F, none) && good;
    good = compare<contact::friction_line>(fem::make_two_plates(24), "plates", 24, F, none) && good;
  }
  return good;
}

}  // namespace

int main(int argc, char** argv) {
  std::string const what = argc > 1 ? argv[1] : "";
  std::vector<double> numbers;
  for (int i = 2; i < argc; ++i) numbers.push_back(std::atof(argv[i]));
  bool good = false;
  bool const possible =
      std::all_of(numbers.begin(), numbers.end(), [](double x) { return x >= 0; });
  if (what == "brick" && possible) {
    double const F = numbers.empty() ? 0.3 : numbers.front();
    std::vector<int> sizes;
    for (std::size_t i = 1; i < numbers.size(); ++i) sizes.push_back(static_cast<int>(numbers[i]));
    if (sizes.empty()) sizes = {6, 8, 10, 12};
    std::printf("load,k,F,method,products,steps,over_tresca\n");
    good = bricks(F, sizes);
  } else if (what == "models" && possible) {
    std::printf("model,k,F,method,products,steps,over_tresca\n");
    good = models(numbers.empty() ? std::vector<double>{0, 0.3, 1, 2} : numbers);
  } else {
    std::fprintf(stderr, "usage: coulomb brick [F [K...]] | models [F...]\n");
    return 2;
  }
  return good ? EXIT_SUCCESS : EXIT_FAILURE;
}
