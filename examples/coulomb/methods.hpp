// SPDX-License-Identifier: MIT
//
// How a load step is solved: by Newton's method for the whole law, by successive approximations
// over Tresca's problems, or by these where Newton's method has failed.
#pragma once

#include <Eigen/SparseCore>
#include <slant/contact/coulomb/coulomb.hpp>
#include <slant/contact/load_stepper.hpp>
#include <slant/contact/preconditioners.hpp>
#include <string>
#include <type_traits>
#include <utility>

#include "scene.hpp"

namespace coulomb {

/// What came of a load step.
struct step_result {
  slant::status status;
  std::string method;
  slant::index products;
  slant::index steps;  ///< of Newton's method, or outer ones
  Eigen::VectorXd λ;   ///< (λ_ν, λ_t)

  [[nodiscard]] bool converged() const { return status == slant::status::converged; }
};

namespace detail {

namespace contact = slant::contact;
using sparse = Eigen::SparseMatrix<double>;

constexpr slant::index newton_steps = 60;
constexpr slant::index outer_steps = 200;

template <class Report>
[[nodiscard]] step_result result_of(Report const& report, std::string method, Eigen::VectorXd λ) {
  return {report.status, std::move(method),
          report.work.operator_applications + report.work.setup_applications, report.iterations(),
          std::move(λ)};
}

/// A stepper by successive approximations from λ0, which refers to the family and to M.
template <class Family, class M>
[[nodiscard]] auto approximations(Family& family, M const& m, double tolerance,
                                  Eigen::VectorXd λ0) {
  return contact::load_stepper(
      family, contact::coulomb(family, m, {.goal = tolerance}),
      slant::reduced_gradient_below(tolerance) || slant::at_most(outer_steps), std::move(λ0));
}

template <class Dual, class Coefficient, class Go>
void by_radii(Dual& problem, sparse const& K, Coefficient const& F, settings const& s,
              Go const& go) {
  contact::coulomb_radii family(problem, F);
  auto const M = contact::lumped_preconditioner(K, problem.constraints());
  auto stepper = approximations(family, M, s.tolerance, problem.zero());
  go([&](contact::load_step<> step) {
    auto const& report = stepper.advance(std::move(step));
    return result_of(report, "radii", report.x());
  });
}

template <class Dual, class Go>
void by_newton(Dual& problem, sparse const& K, Eigen::VectorXd const& F, settings const& s,
               Go const& go) {
  contact::coulomb_cones cones(problem, F);
  auto const residual = contact::coulomb_residual(cones, contact::residual_step(cones).length);
  contact::load_stepper stepper(cones, contact::coulomb_newton(residual, s.tolerance),
                                slant::residual_below(s.tolerance) || slant::at_most(newton_steps));
  Eigen::VectorXd last = problem.zero();
  go([&](contact::load_step<> const& step) {
    auto const& report = stepper.advance(step);
    auto result = result_of(report, "newton", cones.by_directions(report.x()));
    if (!result.converged() && s.method == "coulomb") {
      contact::coulomb_radii family(problem, contact::coefficients(F));
      auto const M = contact::lumped_preconditioner(K, problem.constraints());
      auto second = approximations(family, M, s.tolerance, last);
      auto const& again = second.advance(step);
      slant::index const before = result.products;
      result = result_of(again, "radii", again.x());
      result.products += before;
    }
    if (result.converged()) last = result.λ;
    return result;
  });
}

}  // namespace detail

/// Calls go(advance) with advance(load step) → step_result, by the method of the settings. Each
/// step starts from the one before.
template <class Dual, class Go>
void with_method(settings const& s, Dual& problem, Eigen::SparseMatrix<double> const& K,
                 friction const& F, Go const& go) {
  namespace contact = slant::contact;
  if constexpr (std::is_same_v<typename Dual::friction_type, contact::friction_disc>) {
    if (s.orthotropic()) {
      detail::by_radii(problem, K, contact::orthotropic_coefficients(F.along, F.across), s, go);
      return;
    }
  }
  if (s.method == "radii") {
    detail::by_radii(problem, K, contact::coefficients(F.along), s, go);
  } else {
    detail::by_newton(problem, K, F.along, s, go);
  }
}

}  // namespace coulomb
