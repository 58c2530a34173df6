// SPDX-License-Identifier: MIT
#include "coulomb.hpp"

#include <slant/contact/coulomb.hpp>
#include <slant/contact/optimality.hpp>
#include <slant/contact/preconditioner.hpp>
#include <slant/contact/tresca.hpp>
#include <slant/factorizations/factorize.hpp>

namespace from_files {

namespace {

namespace contact = slant::contact;

template <class Friction>
[[nodiscard]] solution solve_with(Friction friction, coulomb_problem const& p, settings const& s) {
  auto const begin = clock::now();
  auto const factor = slant::factorize(p.body.K);
  contact::dual problem(friction, factor, p.body.contact);
  contact::coulomb_radii family(problem, contact::coefficients(p.F));
  auto const M = contact::lumped_preconditioner(p.body.K, problem.constraints());
  solution result;
  result.run = run_on_dual(contact::coulomb(family, M, {.goal = s.tolerance}), problem.zero(), s);
  result.u = problem.displacement(result.run.λ);
  result.take_times(begin);
  result.factorization = factor.name();
  auto law = p.body.contact;
  law.g = p.F.cwiseProduct(result.run.λ.head(p.F.size()).cwiseMax(0));
  bool const is_number = result.run.λ.allFinite();
  if (!is_number) law.g.setZero();  // the residual is no number either
  result.kkt_residual = contact::check_optimality(p.body.K, law, result.u, result.run.λ).residual();
  return result;
}

}  // namespace

solution solve_coulomb(coulomb_problem const& p, settings const& s) {
  return p.body.contact.tangents() == 1 ? solve_with(contact::friction_line{}, p, s)
                                        : solve_with(contact::friction_disc{}, p, s);
}

}  // namespace from_files
