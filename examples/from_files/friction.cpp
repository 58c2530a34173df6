// SPDX-License-Identifier: MIT
#include "friction.hpp"

#include <chrono>
#include <slant/contact/friction/verify.hpp>
#include <slant/io/friction_folder.hpp>

#include "friction_methods.hpp"
#include "problem_folder.hpp"

namespace from_files {

namespace {

namespace contact = slant::contact;

[[nodiscard]] nlohmann::ordered_json figures(contact::violation<double> const& worst) {
  return {{"value", worst.value}, {"relative", worst.relative}, {"contact", worst.contact}};
}

/// What the checker says: first what the verdict is based on, then what depends on the units of the
/// data.
[[nodiscard]] nlohmann::ordered_json figures(contact::friction_check<double> const& check) {
  return {{"unit_free_map", check.unit_free_map},
          {"unit_free_rounding", check.unit_free_rounding},
          {"unit_free_penetration", check.unit_free_penetration},
          {"worst", figures(check.worst)},
          {"natural_map", check.natural_map},
          {"relative_natural_map", check.relative_natural_map},
          {"rounding", check.rounding},
          {"relative_rounding", check.relative_rounding},
          {"outside_cone", figures(check.outside_cone)},
          {"outside_dual", figures(check.outside_dual)},
          {"penetration", figures(check.penetration)},
          {"complementarity", figures(check.complementarity)},
          {"propulsion", figures(check.propulsion)},
          {"dissipation", check.dissipation},
          {"open", check.open},
          {"stick", check.stick},
          {"slip", check.slip}};
}

}  // namespace

bool holds_friction_problem(std::filesystem::path const& folder) {
  bool const body = detail::is_there(folder / "K.mtx");
  // Without a matrix the other files tell which one is missing.
  if (!detail::is_there(folder / "W.mtx"))
    return !body && (detail::is_there(folder / "q.txt") || detail::is_there(folder / "mu.txt"));
  if (body)
    throw slant::bad_input(slant::detail::printable(folder), "both W.mtx and K.mtx",
                           "contacts in local coordinates (W.mtx) or a body (K.mtx)");
  return true;
}

void list_friction_methods() {
  print_methods(friction_methods);
}

int solve_friction_folder(arguments const& a) {
  if (!a.coefficients.empty())
    throw slant::bad_input("--coulomb", a.coefficients.string(),
                           "nothing, since DIR holds W.mtx, whose coefficients are in mu.txt");
  if (a.start != "zero" && a.start != "automatic")
    throw slant::bad_input("--start", a.start, "zero, since DIR holds W.mtx: contacts alone");
  auto const& method = method_named(friction_methods, a.method);
  auto const problem = slant::read_friction_problem(
      a.folder, {.asymmetry = a.symmetric ? contact::asymmetric_data::refused
                                          : contact::asymmetric_data::used_as_given});
  auto files = places_for(a, {"r.txt", "u.txt"});

  auto const begin = std::chrono::steady_clock::now();
  auto const run =
      method.run(problem, {.tolerance = a.tolerance, .max_iterations = a.max_iterations});
  double const seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  auto const check = contact::verify(problem, run.r);
  bool const is_finite = run.r.allFinite() && run.u.allFinite();
  if (!is_finite) files.reset();
  if (files) files->write(run.r, run.u);
  return deliver(a,
                 {{"status", slant::to_string(run.status)},
                  {"reason", run.reason},
                  {"method", method.name},
                  {"solved_by", contact::to_string(run.solved_by)},
                  {"sweeps", run.work.sweeps},
                  {"products", run.work.products},
                  {"newton_steps", run.work.newton_steps},
                  {"interior_steps", run.work.interior_steps},
                  {"factorizations", run.work.factorizations},
                  {"seconds", seconds},
                  {"check", figures(check)},
                  {"tolerance", a.tolerance},
                  {"contacts", problem.contacts()},
                  {"dimension", problem.dimension()},
                  {"asymmetry", contact::asymmetry(problem.W)}},
                 run.converged() && is_finite, files);
}

}  // namespace from_files
