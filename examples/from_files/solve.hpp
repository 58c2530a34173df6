// SPDX-License-Identifier: MIT
//
// From the problem of a folder to its solution, with the time and the work that it took.
#pragma once

#include <limits>
#include <slant/contact/optimality.hpp>
#include <slant/contact/tresca.hpp>
#include <slant/factorizations/factorize.hpp>
#include <string>
#include <string_view>
#include <utility>

#include "methods.hpp"
#include "problem_folder.hpp"
#include "solution.hpp"

namespace from_files {

namespace detail {

/// What it means for u that the dual problem has no minimum.
[[nodiscard]] inline std::string contradiction(slant::contact::data<double> const& c) {
  bool const sticks = (c.g.array() == std::numeric_limits<double>::infinity()).any();
  return std::string("no u satisfies N u <= d") + (sticks ? " and T u = 0 where g is inf" : "") +
         ", so the multipliers grow without bound";
}

/// λ = 0, or where the first method ends; its outcome then.
template <class Dual>
[[nodiscard]] outcome find_start(problem const& p, Dual const& dual, settings const& s) {
  settings rough = s;
  rough.tolerance = 0.1;
  if (s.start == start_point::qpc) {
    return run_on_dual(slant::qpc{dual.qp()}, dual.zero(), rough);
  }
  if (s.start == start_point::interior_point) {
    return run_interior_point(p, dual, dual.zero(), rough);
  }
  return {.status = slant::status::converged,
          .reason = {},
          .iterations = 0,
          .work = {},
          .started = clock::now(),
          .λ = dual.zero()};
}

/// Is there no point in going on from where a run has ended?
[[nodiscard]] inline bool hopeless(slant::status s) {
  return s == slant::status::unbounded || s == slant::status::breakdown;
}

template <class Friction>
[[nodiscard]] solution solve_with(Friction friction, problem const& p, std::string_view method,
                                  settings const& s) {
  auto const begin = clock::now();
  auto const factor = slant::factorize(p.K);
  slant::contact::dual const dual(friction, factor, p.contact);
  solution result;
  outcome const start = find_start(p, dual, s);
  with_method(method, [&](auto const& chosen) {
    if (hopeless(start.status)) {
      result.run = start;
      return;
    }
    result.run = chosen.run(friction, p, dual, start.λ, s);
    result.run.work.operator_applications += start.work.operator_applications;
    result.run.work.setup_applications += start.work.setup_applications;
  });
  if (result.run.status == slant::status::unbounded) result.run.reason = contradiction(p.contact);
  result.u = dual.displacement(result.run.λ);
  result.take_times(begin);
  result.factorization = factor.name();
  result.kkt_residual =
      slant::contact::check_optimality(p.K, p.contact, result.u, result.run.λ).residual();
  return result;
}

}  // namespace detail

/// Solves with the method of that name. The friction law is that of T: no disc is compiled into a
/// frictionless solver. Throws slant::bad_input if K is not symmetric positive definite (naming the
/// entry or the pivot) or if there is no such method.
[[nodiscard]] inline solution solve(problem const& p, std::string_view method, settings const& s) {
  switch (p.contact.tangents()) {
    case 0:
      return detail::solve_with(slant::contact::frictionless{}, p, method, s);
    case 1:
      return detail::solve_with(slant::contact::friction_line{}, p, method, s);
    default:
      return detail::solve_with(slant::contact::friction_disc{}, p, method, s);
  }
}

}  // namespace from_files
