// SPDX-License-Identifier: MIT
//
// Solves a contact problem whose matrices are files in a folder, by a method of one's choice, and
// prints one JSON object.
#include <cstdio>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <support/command_line.hpp>
#include <utility>

#include "arguments.hpp"
#include "coulomb.hpp"
#include "floating.hpp"
#include "friction.hpp"
#include "solve.hpp"
#include "warnings.hpp"

namespace {

namespace fs = std::filesystem;
using from_files::arguments;

std::map<std::string, from_files::start_point> const starts{
    {"automatic", from_files::start_point::automatic},
    {"zero", from_files::start_point::zero},
    {"qpc", from_files::start_point::qpc},
    {"interior_point", from_files::start_point::interior_point}};

int list_methods() {
  from_files::print_methods(from_files::methods);
  std::printf("\nBodies with Coulomb friction (--coulomb):\n");
  from_files::print_methods(from_files::coulomb_methods);
  std::printf("\nContacts in local coordinates:\n");
  from_files::list_friction_methods();
  return examples::succeeded;
}

/// Reports and writes what came of a body.
int deliver_solution(arguments const& a, from_files::problem const& p, std::string const& method,
                     from_files::solution const& s, from_files::warning_list const& warnings,
                     std::optional<from_files::result_files>& files) {
  if (!s.is_finite()) files.reset();
  if (files) files->write(s.u, s.run.λ);
  nlohmann::ordered_json json{
      {"status", slant::to_string(s.run.status)}, {"reason", s.run.reason}, {"method", method}};
  if (!s.solved_by.empty()) json["solved_by"] = s.solved_by;
  json.update(nlohmann::ordered_json{
      {"iterations", s.run.iterations},
      {"operator_applications", s.run.work.operator_applications + s.run.work.setup_applications},
      {"setup_applications", s.run.work.setup_applications},
      {"setup_seconds", s.setup_seconds},
      {"solve_seconds", s.solve_seconds},
      {"energy_error", s.error.relative()},
      {"energy_error_proven", s.error.proven},
      {"condition_estimate", s.condition},
      {"kkt_residual", s.kkt_residual},
      {"tolerance", a.tolerance},
      {"unknowns", p.K.rows()},
      {"contact_nodes", p.contact.nodes()},
      {"tangents_per_node", p.contact.tangents()},
      {"factorization", s.factorization}});
  if (!s.motions.free.empty()) json["free_motions"] = from_files::report_motions(s.motions);
  json["warnings"] = from_files::report_warnings(warnings);
  return from_files::deliver(a, std::move(json), s.converged() && s.is_finite(), files);
}

from_files::settings settings_of(arguments const& a) {
  from_files::settings s{.tolerance = a.tolerance, .start = starts.at(a.start), .prove = a.prove};
  if (a.max_iterations) s.max_iterations = *a.max_iterations;
  return s;
}

int solve_tresca(arguments const& a) {
  auto const& method = from_files::method_named(from_files::methods, a.method);
  auto const problem = from_files::read_problem_folder(a.folder);
  auto files = from_files::places_for(a, {"u.txt", "lambda.txt"});
  auto const layout = from_files::read_layout(a, problem);
  from_files::check_data(a, problem, layout);
  auto settings = settings_of(a);
  settings.layout = layout;
  try {
    auto const solution = from_files::solve(problem, method, settings);
    auto const warnings = from_files::warnings_about(a, problem, solution, layout);
    return deliver_solution(a, problem,
                            solution.motions.free.empty() ? std::string(method.name) : "floating",
                            solution, warnings, files);
  } catch (slant::bad_input const& refusal) {
    throw slant::contact::with_free_motions(refusal,
                                            from_files::motions_behind(refusal, problem, layout));
  }
}

int solve_coulomb(arguments const& a) {
  auto const& method =
      from_files::method_named(from_files::coulomb_methods, a.method, ", as --coulomb is given");
  if (a.start != "zero" && a.start != "automatic")
    throw slant::bad_input("--start", a.start, "zero, as --coulomb is given");
  if (a.max_iterations && *a.max_iterations < 1)
    throw slant::bad_input("--max-iterations", "0", "at least 1, as --coulomb is given");
  auto const problem = from_files::read_coulomb_folder(a.folder, a.coefficients);
  auto files = from_files::places_for(a, {"u.txt", "lambda.txt"});
  auto const layout = from_files::read_layout(a, problem.body);
  from_files::check_data(a, problem.body, layout);
  try {
    auto const solution = from_files::solve_coulomb(
        problem, method.kind,
        {.tolerance = a.tolerance, .max_iterations = a.max_iterations, .layout = layout});
    auto const warnings = from_files::warnings_about(a, problem.body, solution, layout);
    return deliver_solution(a, problem.body, std::string(method.name), solution, warnings, files);
  } catch (slant::bad_input const& refusal) {
    throw slant::contact::with_free_motions(
        refusal, from_files::motions_behind(refusal, problem.body, layout));
  }
}

int solve_folder(arguments const& a) {
  if (a.list_methods) return list_methods();
  if (a.folder.empty())
    throw slant::bad_input("DIR", "nothing", "the folder with the matrices of the problem");
  if (from_files::holds_friction_problem(a.folder)) return from_files::solve_friction_folder(a);
  if (a.symmetric)
    throw slant::bad_input("--symmetric", "a folder with K.mtx", "a folder with W.mtx");
  return a.coefficients.empty() ? solve_tresca(a) : solve_coulomb(a);
}

}  // namespace

int main(int argc, char** argv) {
  examples::command_line app(
      "Contact with friction from files. DIR holds either\n"
      "  a body with Tresca friction: K.mtx, N.mtx, f.txt, d.txt and, for friction, T.mtx, g.txt:\n"
      "    min 1/2 u'Ku - f'u + sum g_i |(Tu)_i|  subject to  Nu <= d\n"
      "  or with Coulomb friction (--coulomb)\n"
      "  or contacts with Coulomb friction, each [n, t1(, t2)]: W.mtx, q.txt, mu.txt:\n"
      "    u = Wr + q,  |r_t| <= mu r_n,  r orthogonal to u + mu |u_t| n,  u_n >= 0",
      "from_files",
      "Prints one JSON object. For a body \"energy_error\" bounds |u - u*|/|u*| in the energy norm "
      "and\n\"kkt_residual\" is relative; both are computed from the "
      "matrices;\n\"operator_applications\" includes \"setup_applications\". For contacts "
      "\"check\" "
      "holds the violations of the law,\ncomputed from the files and r alone. Bodies that "
      "supports do not hold (\"free_motions\") are solved by the\nrecommended method.\n"
      "Exit status: 0 converged; 1 not converged, for the reason in the JSON object; 2 input "
      "that cannot be used or\noutput that cannot be written, named in one line on standard "
      "error; no file is written then.");
  arguments a;
  app.option("DIR", a.folder, "folder with the problem");
  app.option("--method", a.method,
             "name of a method; see --list-methods; default: the one recommended there");
  app.option(
      "--tolerance", a.tolerance,
      "bodies with Tresca friction: relative error in the energy norm, estimated or, with "
      "--prove, proven;\nwith Coulomb friction: of that, for the slip bounds F lambda_n, and of "
      "the violation of the law;\ncontacts: of the natural map in units of each contact; 0: as "
      "far as rounding allows, with exit\nstatus 1: for a body mostly status \"stalled\"",
      examples::expects_tolerance());
  app.option("--start", a.start,
             "automatic, zero, or qpc or interior_point: where that method has reduced the "
             "reduced gradient to a tenth",
             examples::expects_one_of({"automatic", "zero", "qpc", "interior_point"}));
  app.option("--max-iterations", a.max_iterations, "steps at most, of each method that is tried",
             examples::expects_at_least(0));
  app.option("--coulomb", a.coefficients,
             "file with a friction coefficient F_i >= 0 for each contact node of a body: "
             "Coulomb friction,\n|lambda_t,i| <= F_i lambda_n,i; g.txt is not read",
             examples::expects_name());
  app.flag("--prove", a.prove,
           "prove the bound of the error (bodies with Tresca friction): one more factorisation");
  app.flag("--symmetric", a.symmetric,
           "refuse a W that is not symmetric up to rounding; else it is used as given");
  app.option("--output", a.output,
             "folder for u.txt and lambda.txt (normal, then tangential forces), or r.txt and "
             "u.txt",
             examples::expects_name());
  app.flag("--strict", a.strict,
           "refuse a body about whose data there are warnings (\"warnings\" in the JSON "
           "object, and on standard error)");
  app.option(
      "--coordinates", a.coordinates,
      "file with the coordinates of the nodes of a body, D x p (Matrix Market), each "
      "with D consecutive\nunknowns: messages name directions, more can be checked, and large "
      "bodies are solved by multigrid",
      examples::expects_name());
  app.flag("--list-methods", a.list_methods, "print the methods and end");
  return app.run(argc, argv, [&] { return solve_folder(a); });
}
