// SPDX-License-Identifier: MIT
//
// from_files on problems that can be solved, or at least attempted: statuses, JSON, files.
#include <oracle/dense_contact_reference.hpp>
#include "problem_files.hpp"

namespace from_files {
namespace {

using namespace examples_test;
using nlohmann::json;

/// One spring K = 4 pulled by f = 2 towards an obstacle at 0.25: u = 0.25, λ = 2 − 4 · 0.25 = 1.
struct one_spring : problem_files {
  one_spring() {
    put("K.mtx", coordinate + "1 1 1\n1 1 4\n");
    put("N.mtx", coordinate + "1 1 1\n1 1 1\n");
    put("f.txt", "2\n");
    put("d.txt", "0.25\n");
  }
};

/// Compares the files that were written with the reference solution of the scene.
template <int D>
void check_against_reference(problem_files const& files, fem::contact_scene<D> const& scene,
                             json const& result) {
  oracle::contact_data const data{scene.K, scene.N, scene.T, scene.f, scene.d, scene.g};
  auto const reference = oracle::solve_contact(data);
  VectorXd const u = files.read("u.txt");
  VectorXd const λ = files.read("lambda.txt");
  REQUIRE(λ.size() == scene.N.rows() + scene.T.rows());
  CHECK(oracle::energy_error(scene.K, u, reference.u) < 1e-6);
  VectorXd const exact = reference.multipliers();
  CHECK((λ - exact).norm() < 1e-5 * exact.norm());
  CHECK(oracle::check_contact(data, u.cast<oracle::real>(), λ.cast<oracle::real>()).largest() <
        1e-5);
  CHECK(result["kkt_residual"].get<double>() < 1e-5);
}

}  // namespace

TEST_CASE("from_files: a brick in space") {
  auto const scene = fem::make_steel_brick({.k = 2, .load = fem::brick_load::lift});
  problem_files const files(scene);
  json const result = solved(files);
  CHECK(result["status"] == "converged");
  CHECK(result["method"] == "symmetric_newton");
  CHECK(result["unknowns"] == 162);
  CHECK(result["contact_nodes"] == 18);
  CHECK(result["tangents_per_node"] == 2);
  CHECK(result["iterations"].get<int>() > 3);
  CHECK(result["operator_applications"].get<int>() >=
        result["iterations"].get<int>() + result["setup_applications"].get<int>());
  CHECK(result["setup_seconds"].get<double>() > 0);
  CHECK(result["solve_seconds"].get<double>() > 0);
  CHECK(result["factorization"].get<std::string>() != "");
  CHECK(contains(result["reason"].get<std::string>(), "relative energy error"));
  CHECK(result["energy_error"].get<double>() <= 1e-8);
  CHECK(result["energy_error_proven"] == false);
  CHECK(result["condition_estimate"].get<double>() > 100);
  CHECK(result["output"] == files.output().string());
  CHECK(files.files_written() == 2);
  check_against_reference(files, scene, result);
}

TEST_CASE("from_files: every method by its name, from zero and after a first phase") {
  auto const scene =
      fem::make_steel_brick({.k = test::effort(2, 1), .load = fem::brick_load::press});
  auto const list = run("from_files", "--list-methods").out;
  std::istringstream lines(list);
  int methods = 0;
  for (std::string line; std::getline(lines, line) && !line.empty();) {
    ++methods;
    std::string const name = line.substr(0, line.find(' '));
    CAPTURE(name);
    // Full steps and whole systems without a factor may fail, and say so.
    bool const may_fail = name == "ssnm_b" || name == "ssn";
    std::string const limits =
        " --tolerance 1e-9 --max-iterations " + std::string(may_fail ? "100" : "20000");
    // qpc gets no further than 1e-8 on some discs, from wherever it starts.
    std::vector<std::string> starts{"", " --start qpc"};
    if (name != "qpc") starts.emplace_back(" --start interior_point");
    for (auto const& start : starts) {
      problem_files const files(scene);
      auto const ran = files.solve("--method " + name + start + limits);
      REQUIRE(is_one_line(ran.out));
      json const result = json::parse(ran.out);
      CHECK(result["method"] == name);
      bool const converged = result["status"] == "converged";
      CHECK((converged || may_fail));
      CHECK(ran.status == (converged ? 0 : 1));
      CHECK(result["reason"].get<std::string>() != "");
      if (converged) check_against_reference(files, scene, result);
    }
  }
  CHECK(methods == 16);
}

TEST_CASE("from_files: a bound that is proven") {
  auto const files = small_brick();
  for (auto const* const method : {"symmetric_newton", "kprgp"}) {
    json const result = json::parse(files.solve(std::string("--prove --method ") + method).out);
    CHECK(result["status"] == "converged");
    CHECK(result["energy_error_proven"] == true);
    CHECK(contains(result["reason"].get<std::string>(), "proven"));
  }
}

TEST_CASE("from_files: a body in the plane") {
  auto const scene = plane_scene();
  problem_files const files(scene);
  json const result = solved(files, "--method kprgp --tolerance 1e-10");
  CHECK(result["tangents_per_node"] == 1);
  check_against_reference(files, scene, result);
}

TEST_CASE("from_files: no friction") {
  auto scene = plane_scene();
  problem_files const files(scene);
  files.remove("T.mtx");
  files.remove("g.txt");
  scene.T.resize(0, scene.K.cols());
  scene.g.resize(0);
  json const result = solved(files);
  CHECK(result["tangents_per_node"] == 0);
  check_against_reference(files, scene, result);
}

TEST_CASE("from_files: a known answer, and none asked for in files") {
  one_spring const files;
  CHECK(files.solve().status == 0);
  CHECK(files.read("u.txt")[0] == doctest::Approx(0.25).epsilon(1e-14));
  CHECK(files.read("lambda.txt")[0] == doctest::Approx(1).epsilon(1e-14));

  auto const silent = run("from_files", word(files.input().string()));
  CHECK(silent.status == 0);
  CHECK(json::parse(silent.out)["output"] == nullptr);
}

TEST_CASE("from_files: a run that stops early says so, with its last iterate") {
  auto const files = small_brick();
  for (std::string const limit : {"0", "2"}) {
    auto const ran = files.solve("--max-iterations " + limit);
    CHECK(ran.status == 1);
    CHECK(ran.err == "");
    REQUIRE(is_one_line(ran.out));
    json const result = json::parse(ran.out);
    CHECK(result["status"] == "iteration_limit");
    CHECK(result["iterations"].get<int>() == std::stoi(limit));
    CHECK(result["kkt_residual"].get<double>() > 1e-6);
    CHECK(files.files_written() == 2);
  }
}

TEST_CASE("from_files: a problem without solution is not solved") {
  // u <= 0.5 and -u <= -0.6: the multipliers grow for ever.
  one_spring const files;
  files.put("N.mtx", coordinate + "2 1 2\n1 1 1\n2 1 -1\n");
  files.put("d.txt", "0.5\n-0.6\n");
  for (auto const* const start : {"", "--start zero", "--start qpc", "--start interior_point"}) {
    auto const ran = files.solve(start);
    CHECK(ran.status == 1);
    REQUIRE(is_one_line(ran.out));
    json const result = json::parse(ran.out);
    CHECK(result["status"] == "unbounded");
    CHECK(result["reason"].get<std::string>().starts_with("no u satisfies N u <= d, "));
    CHECK(result["iterations"] <= 10);
  }

  // u = 0 by friction, and -u <= -0.6.
  files.put("N.mtx", coordinate + "1 1 1\n1 1 -1\n");
  files.put("T.mtx", coordinate + "1 1 1\n1 1 1\n");
  files.put("d.txt", "-0.6\n");
  files.put("g.txt", "inf\n");
  json const stuck = json::parse(files.solve().out);
  CHECK(stuck["status"] == "unbounded");
  CHECK(contains(stuck["reason"].get<std::string>(), "N u <= d and T u = 0 where g is inf"));
}

TEST_CASE("from_files: numbers at the end of their range give valid JSON and no wrong answer") {
  one_spring const files;
  files.put("f.txt", "1e300\n");
  files.put("K.mtx", coordinate + "1 1 1\n1 1 1e-300\n");
  auto const ran = files.solve();
  // K⁻¹f is no number: whether that is found before or in the iteration, it is not "converged".
  CHECK((ran.status == 1 || ran.status == 2));
  if (ran.status == 1) CHECK(json::parse(ran.out)["status"] != "converged");
  if (ran.status == 2) {
    CHECK(is_one_line(ran.err));
    CHECK(ran.out == "");
  }
}

TEST_CASE("from_files: numbers may have a plus sign; tolerance 0 ends where rounding does") {
  auto const files = small_brick();
  json const result = json::parse(files.solve("--tolerance +1e-3 --max-iterations +500").out);
  CHECK(result["status"] == "converged");
  CHECK(result["tolerance"] == 1e-3);
  auto const ran = files.solve("--tolerance 0");
  CHECK(ran.status == 1);
  CHECK(json::parse(ran.out)["status"] == "stalled");
  CHECK(json::parse(ran.out)["kkt_residual"].get<double>() < 1e-10);
}

TEST_CASE("from_files: help and the list of methods need no folder") {
  auto const list = run("from_files", "--list-methods");
  CHECK(list.status == 0);
  CHECK(list.err == "");
  CHECK(list.out.starts_with("symmetric_newton "));
  CHECK(contains(list.out, "(recommended)"));
  auto const help = run("from_files", "--help");
  CHECK(help.status == 0);
  CHECK(help.err == "");
  for (auto const* expected : {"--method", "--tolerance", "--start", "--max-iterations", "--output",
                               "--prove", "--list-methods", "Exit status"})
    CHECK(contains(help.out, expected));
}

TEST_CASE("from_files: a folder whose name is no text") {
  io_test::temporary_folder const folder;
  one_spring const files;
  std::string const output = (folder / "caf\xe9").string();  // Latin-1, so no UTF-8
  auto const ran = run("from_files", word(files.input().string()) + " --output " + word(output));
  CHECK(ran.status == 0);
  REQUIRE(is_one_line(ran.out));
  CHECK(contains(json::parse(ran.out)["output"].get<std::string>(), "/caf"));
  CHECK(std::filesystem::exists(output + "/u.txt"));
}

}  // namespace from_files
