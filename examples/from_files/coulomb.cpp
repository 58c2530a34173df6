// SPDX-License-Identifier: MIT
#include "coulomb.hpp"

#include <slant/contact/certified_coulomb.hpp>
#include <slant/contact/optimality.hpp>
#include <utility>

namespace from_files {

namespace {

namespace contact = slant::contact;

[[nodiscard]] contact::coulomb_method method_of(coulomb_kind kind) {
  switch (kind) {
    case coulomb_kind::newton:
      return contact::coulomb_method::newton;
    case coulomb_kind::radii:
      return contact::coulomb_method::radii;
    case coulomb_kind::cones:
      return contact::coulomb_method::cones;
    default:
      return contact::coulomb_method::automatic;
  }
}

[[nodiscard]] std::string name_of(std::string_view method) {
  if (method == "cones" || method == "solve_friction") return std::string(method);
  return method == "Newton" ? "newton" : "radii";
}

template <class Friction>
[[nodiscard]] solution solve_with(Friction friction, coulomb_problem const& p, coulomb_kind kind,
                                  coulomb_settings const& s) {
  auto const begin = clock::now();
  contact::certified_coulomb_options<double> o;
  o.layout = s.layout;
  o.tolerance = s.tolerance;
  o.method = method_of(kind);
  if (s.max_iterations) o.newton_steps = o.outer_steps = *s.max_iterations;
  auto found = contact::certified_coulomb(friction, p.body.K, p.body.contact, p.F, o);
  solution result;
  result.run = {.status = found.status,
                .reason = std::move(found.reason),
                .iterations = found.steps,
                .work = found.work,
                .started = begin,
                .λ = std::move(found.λ)};
  result.solved_by = name_of(found.method);
  result.u = std::move(found.u);
  result.factorization = std::move(found.factorization);
  // That of Tresca's problem with the slip bounds F λ_ν; the reason has the violation of the law.
  result.error = found.error.frozen;
  result.condition = found.condition;
  result.take_times(begin);
  auto law = p.body.contact;
  law.g = p.F.cwiseProduct(result.run.λ.head(p.F.size()).cwiseMax(0));
  bool const is_number = result.run.λ.allFinite();
  if (!is_number) law.g.setZero();  // the residual is no number either
  result.kkt_residual = contact::check_optimality(p.body.K, law, result.u, result.run.λ).residual();
  return result;
}

}  // namespace

solution solve_coulomb(coulomb_problem const& p, coulomb_kind kind, coulomb_settings const& s) {
  return p.body.contact.tangents() == 1 ? solve_with(contact::friction_line{}, p, kind, s)
                                        : solve_with(contact::friction_disc{}, p, kind, s);
}

}  // namespace from_files
