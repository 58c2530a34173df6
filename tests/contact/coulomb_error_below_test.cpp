// SPDX-License-Identifier: MIT
#include <slant/contact/coulomb/coulomb_certificate.hpp>

#include "coulomb_scenes.hpp"
#include "counting_factor.hpp"
#include "spring_scenes.hpp"

#include <slant/contact/coulomb/coulomb.hpp>
#include <slant/contact/coulomb/coulomb_newton.hpp>
#include <slant/contact/optimality.hpp>
#include <slant/contact/preconditioners.hpp>
#include <slant/iteration/solve.hpp>

#include <doctest/doctest.h>
#include <support/optimised.hpp>

#include <string>

namespace coulomb_error_below_test {

using Eigen::VectorXd;
using slant::status;
namespace contact = slant::contact;

/// What a method has said, and what is true of it.
struct verdict {
  slant::status how;
  std::string reason;
  double kkt;  ///< residual of Tresca's conditions with the bounds F λ_ν, relative
};

/// Each method alone: f(name, verdict by a residual, verdict by coulomb_error_below).
template <class F>
void with_each_method(Eigen::SparseMatrix<double> const& K, contact::data<double> const& c,
                      double tolerance, F const& f) {
  test::counting_factor const factor{K};
  contact::dual problem(contact::friction_disc{}, factor, c);
  VectorXd const μ = VectorXd::Constant(c.nodes(), 0.3);
  contact::coulomb_certificate certificate(problem, factor, K, c, μ, tolerance);
  contact::coulomb_radii radii(problem, contact::coefficients(μ));
  contact::coulomb_cones cones(problem, μ);
  auto const M = contact::lumped_preconditioner(K, problem.constraints());
  auto const C = contact::lumped_preconditioner(K, cones.constraints());
  auto const same = [](VectorXd const& x) { return x; };
  auto const ordered = [&](VectorXd const& x) { return cones.by_directions(x); };
  auto const judge = [&](auto const& r, auto const& λ_of) {
    VectorXd const λ = λ_of(r.x());
    auto tresca = c;
    tresca.g = μ.cwiseProduct(λ.head(μ.size()).cwiseMax(0));
    double const kkt = contact::check_optimality(K, tresca, problem.displacement(λ), λ).residual();
    return verdict{r.status, r.reason, kkt};
  };
  auto const run = [&](char const* name, auto const& method, auto const& residual,
                       auto const& λ_of) {
    auto const check = [&](VectorXd const& x) { return certificate(λ_of(x)); };
    auto const by_residual =
        judge(slant::solve(method, problem.zero(), residual || slant::at_most(300)), λ_of);
    auto const by_error =
        judge(slant::solve(method, problem.zero(),
                           contact::coulomb_error_below(tolerance, check) || slant::at_most(300)),
              λ_of);
    f(name, by_residual, by_error);
  };
  auto const gradient = slant::reduced_gradient_below(tolerance);
  auto const residual = slant::residual_below(tolerance);
  run("radii", contact::coulomb(radii, M), gradient, same);
  run("cones", contact::coulomb(cones, C), gradient, ordered);
  double const ρ = contact::residual_step(cones).length;
  auto const alart_curnier = contact::coulomb_residual(cones, ρ);
  run("newton", contact::coulomb_newton(alart_curnier), residual, ordered);
  auto const de_saxce = contact::de_saxce_residual(cones, ρ);
  run("de Saxce", contact::coulomb_newton(de_saxce), residual, ordered);
}

/// The residual alone is wrong by `wrong` at least; the rule is not, and solves if it can.
void check_scene(Eigen::SparseMatrix<double> const& K, contact::data<double> const& c, double wrong,
                 bool attainable) {
  with_each_method(K, c, 1e-8, [&](char const* name, verdict const& residual, verdict const& rule) {
    CAPTURE(name);
    CAPTURE(rule.reason);
    CHECK(residual.how == status::converged);
    CHECK(residual.kkt >= wrong);
    CHECK(rule.how == (attainable ? status::converged : status::stalled));
    if (rule.how == status::converged) CHECK(rule.kkt <= 1e-7);
    CHECK(rule.reason.find("Coulomb's law violated by ") == 0);
    CHECK(rule.reason.find(attainable ? ", at most 1e-08" : "; asked was 1e-08") !=
          std::string::npos);
  });
}

TEST_CASE("a slender brick, by each method alone: converged is true" *
          doctest::skip(!test::is_optimised)) {
  auto const s = fem::make_steel_brick(
      {.k = 1, .load = fem::brick_load::lift, .size = Eigen::Vector3d(300, 1, 1)});
  check_scene(s.K, test::contact_data(s), 1e-4, true);
}

TEST_CASE("a thin brick: more than rounding allows is asked for, and no method says that it is" *
          doctest::skip(!test::is_optimised)) {
  auto const s = fem::make_steel_brick(
      {.k = 1, .load = fem::brick_load::lift, .size = Eigen::Vector3d(3, 1, 1e-4)});
  check_scene(s.K, test::contact_data(s), 1e-5, false);
}

TEST_CASE("a block that hardly anything holds: not every method solves it, none says so wrongly" *
          doctest::skip(!test::is_optimised)) {
  auto const s = test::spring_block<3>(1, 1e-6);
  int solved = 0;
  with_each_method(s.K, s.contact, 1e-8,
                   [&](char const* name, verdict const&, verdict const& rule) {
                     CAPTURE(name);
                     CAPTURE(rule.reason);
                     if (rule.how != status::converged) return;
                     ++solved;
                     CHECK(rule.kkt <= 1e-7);
                   });
  CHECK(solved >= 1);
}

}  // namespace coulomb_error_below_test
