// SPDX-License-Identifier: MIT
//
// from_files on contacts with Coulomb friction in local coordinates.
#include <slant/contact/friction/verify.hpp>
#include <slant/io/friction_folder.hpp>
#include <support/friction_cases.hpp>
#include "problem_files.hpp"

namespace from_files_friction {
namespace {

using namespace examples_test;
using nlohmann::json;

/// A problem in a folder, and one for results.
struct friction_files : problem_files {
  explicit friction_files(test::friction_problem const& p) {
    std::filesystem::create_directories(input());
    slant::write_friction_problem(input(), p);
  }
};

/// What the report says is what the checker makes of the files that were written.
void check_report(problem_files const& files, test::friction_problem const& p, json const& result) {
  VectorXd const r = files.read("r.txt"), u = files.read("u.txt");
  CHECK((u - (p.W * r + p.q)).norm() <= 1e-15 * p.q.norm());
  auto const check = slant::contact::verify(p, r);
  json const& said = result["check"];
  CHECK(said["unit_free_map"] == check.unit_free_map);
  CHECK(said["unit_free_rounding"] == check.unit_free_rounding);
  CHECK(said["unit_free_penetration"] == check.unit_free_penetration);
  CHECK(said["worst"]["contact"] == check.worst.contact);
  CHECK(check.unit_free_map <= 1e-8);
  CHECK(result["reason"].get<std::string>().starts_with("unit-free natural map "));
  CHECK(said["relative_natural_map"] == check.relative_natural_map);
  CHECK(said["outside_cone"]["value"] == check.outside_cone.value);
  CHECK(said["outside_dual"]["relative"] == check.outside_dual.relative);
  CHECK(said["complementarity"]["value"] == check.complementarity.value);
  CHECK(said["open"] == check.open);
  CHECK(said["stick"] == check.stick);
  CHECK(said["slip"] == check.slip);
  CHECK(check.relative_natural_map <= 1e-8);
}

}  // namespace

TEST_CASE("from_files: contacts whose forces are known") {
  for (auto const& c : test::solvable_cases()) {
    CAPTURE(c.name);
    friction_files const files(c.problem);
    json const result = solved(files);
    CHECK(result["status"] == "converged");
    CHECK(result["method"] == "coulomb");
    CHECK(result["contacts"] == c.problem.contacts());
    CHECK(result["dimension"] == c.problem.dimension());
    CHECK(result["asymmetry"] == 0);
    CHECK(files.files_written() == 2);
    check_report(files, c.problem, result);
    if (c.r.size() == 1) CHECK((files.read("r.txt") - c.r[0]).norm() <= 1e-7 * (1 + c.r[0].norm()));
  }
}

TEST_CASE("from_files: every method for contacts by its name") {
  auto const c = test::single_solution_cases().back();
  std::istringstream lines(run("from_files", "--list-methods").out);
  std::string line;
  while (std::getline(lines, line) && line != "Contacts in local coordinates:") continue;
  int methods = 0;
  while (std::getline(lines, line)) {
    std::string const name = line.substr(0, line.find(' '));
    CAPTURE(name);
    if (++methods == 1) CHECK(name == "coulomb");
    friction_files const files(c.problem);
    json const result = solved(files, "--method " + name);
    CHECK(result["method"] == name);
    check_report(files, c.problem, result);
  }
  CHECK(methods >= 2);
}

TEST_CASE("from_files: contacts without solution end with a status") {
  for (slant::index const d : {2, 3}) {
    friction_files const files(test::no_solution_case(d).problem);
    auto const ran = files.solve();
    CHECK(ran.status == 1);
    REQUIRE(is_one_line(ran.out));
    json const result = json::parse(ran.out);
    CHECK(result["status"] != "converged");
    CHECK(result["reason"].get<std::string>() != "");
    CHECK(result["check"]["relative_natural_map"].get<double>() > 1e-2);
  }
}

TEST_CASE("from_files: contacts that cannot be used") {
  auto const c = test::single_solution_cases().front();
  friction_files const files(c.problem);
  check_refusal(files, "--method kprgp", "--method: got kprgp, expected one of coulomb");
  check_refusal(files, "--start qpc", "--start: got qpc, expected zero");
  files.put("mu.txt", "-1\n");
  check_refusal(files, "", "mu.txt: got -1 of contact 0, expected a number >= 0");
  files.put("K.mtx", "no matrix\n");
  check_refusal(files, "", "both W.mtx and K.mtx");
  friction_files const incomplete(c.problem);
  incomplete.remove("W.mtx");
  check_refusal(incomplete, "", "W.mtx: got no such file");

  auto const rover = slant::read_friction_problem(test::data("friction/Rover4396"));
  check_refusal(friction_files(rover), "--symmetric", "W.mtx: got a matrix of asymmetry ");
  check_refusal(small_brick(), "--symmetric", "--symmetric: got ");
}

}  // namespace from_files_friction
