// SPDX-License-Identifier: MIT
//
// Solves a contact problem whose matrices are files in a folder, by a method of one's choice, and
// prints one JSON object.
#include <cstdio>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <support/command_line.hpp>

#include "result_files.hpp"
#include "solution.hpp"

namespace {

namespace fs = std::filesystem;

std::map<std::string, from_files::start_point> const starts{
    {"zero", from_files::start_point::zero},
    {"qpc", from_files::start_point::qpc},
    {"interior_point", from_files::start_point::interior_point}};

struct arguments {
  fs::path folder{};
  std::string method{from_files::recommended_method};
  from_files::settings settings{};
  std::string start{"zero"};
  fs::path output{};
  bool list_methods = false;
};

int list_methods() {
  from_files::for_each_method([](auto const& method) {
    std::printf("%-20s %s%s\n", method.name.data(), method.sentence.data(),
                method.name == from_files::recommended_method ? " (recommended)" : "");
  });
  return examples::succeeded;
}

/// One line; what is not finite becomes null.
std::string json_text(arguments const& a, from_files::problem const& p,
                      from_files::solution const& s, bool written) {
  nlohmann::ordered_json json{
      {"status", slant::to_string(s.run.status)},
      {"reason", s.run.reason},
      {"method", a.method},
      {"iterations", s.run.iterations},
      {"operator_applications", s.run.work.operator_applications + s.run.work.setup_applications},
      {"setup_applications", s.run.work.setup_applications},
      {"setup_seconds", s.setup_seconds},
      {"solve_seconds", s.solve_seconds},
      {"kkt_residual", s.kkt_residual},
      {"tolerance", a.settings.tolerance},
      {"unknowns", p.K.rows()},
      {"contact_nodes", p.contact.nodes()},
      {"tangents_per_node", p.contact.tangents()},
      {"factorization", s.factorization},
      {"output", nullptr}};
  if (written) json["output"] = a.output.string();
  // A path may hold bytes that are no text.
  return json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

int solve_folder(arguments const& a) {
  if (a.list_methods) return list_methods();
  if (a.folder.empty())
    throw slant::bad_input("DIR", "nothing", "the folder with the matrices of the problem");
  from_files::with_method(a.method, [](auto const&) {});
  auto const problem = from_files::read_problem_folder(a.folder);
  std::optional<from_files::result_files> files;
  if (!a.output.empty()) files.emplace(a.output);
  from_files::settings settings = a.settings;
  settings.start = starts.at(a.start);
  auto const solution = from_files::solve(problem, a.method, settings);
  if (!solution.is_finite()) files.reset();
  // No result counts before all of it can arrive: files appear only after the report was printed.
  if (files) files->write(solution);
  std::printf("%s\n", json_text(a, problem, solution, files.has_value()).c_str());
  examples::require_printed();
  if (files) files->commit();
  return solution.converged() ? examples::succeeded : examples::not_converged;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app(
      "Contact with Tresca friction: min 1/2 u'Ku - f'u + sum g_i |(Tu)_i|  subject to  Nu <= d.\n"
      "DIR holds K.mtx, N.mtx, f.txt, d.txt and, for friction, T.mtx and g.txt.",
      "from_files");
  app.footer(
      "Prints one JSON object. \"kkt_residual\" is relative and computed from the matrices; "
      "\"operator_applications\" includes \"setup_applications\".\n"
      "Exit status: 0 converged; 1 not converged, for the reason in the JSON object; 2 input "
      "that cannot be used or\noutput that cannot be written, named in one line on standard "
      "error; no file is written then.");
  arguments a;
  app.add_option("DIR", a.folder, "folder with the problem");
  app.add_option("--method", a.method, "name of a method; see --list-methods")
      ->capture_default_str();
  app.add_option(
         "--tolerance", a.settings.tolerance,
         "relative norm of the reduced gradient at which the method stops (ssn, semismooth_newton: "
         "of the\nnatural residual; ssn_primal_dual, ssnm_*: of a step); 0: when rounding lets it "
         "get no further,\nwhich is status \"stalled\" and exit status 1")
      ->capture_default_str()
      ->check(examples::expects_tolerance());
  app.add_option("--start", a.start,
                 "zero, or qpc or interior_point: where that method has reduced the reduced "
                 "gradient to a tenth")
      ->capture_default_str()
      ->check(examples::expects<std::string>(
          "zero, qpc or interior_point",
          [](std::string const& start) { return starts.contains(start); }));
  app.add_option("--max-iterations", a.settings.max_iterations, "steps at most")
      ->capture_default_str()
      ->check(examples::expects_at_least(0));
  app.add_option("--output", a.output,
                 "folder for u.txt and lambda.txt (normal, then tangential forces)")
      ->check(examples::expects_name());
  app.add_flag("--list-methods", a.list_methods, "print the methods and end");
  return examples::run_program(app, argc, argv, [&] { return solve_folder(a); });
}
