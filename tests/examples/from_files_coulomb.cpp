// SPDX-License-Identifier: MIT
//
// from_files on bodies with Coulomb friction.
#include <oracle/dense_contact_reference.hpp>
#include "problem_files.hpp"

namespace from_files_coulomb {
namespace {

using namespace examples_test;
using nlohmann::json;

/// F.txt beside the problem, and the option that names it.
std::string put_coefficients(problem_files const& files, VectorXd const& F) {
  slant::write_text_vector(files.input() / "F.txt", F);
  return "--coulomb " + word((files.input() / "F.txt").string());
}

/// The result is the solution of Tresca's problem with the slip bounds F λ_ν: then it is one with
/// Coulomb friction.
template <int D>
void check_fixed_point(problem_files const& files, fem::contact_scene<D> scene, VectorXd const& F) {
  VectorXd const λ = files.read("lambda.txt");
  scene.g = F.cwiseProduct(λ.head(F.size()).cwiseMax(0));
  auto const reference =
      oracle::solve_contact({scene.K, scene.N, scene.T, scene.f, scene.d, scene.g});
  CHECK(oracle::energy_error(scene.K, files.read("u.txt"), reference.u) < 1e-6);
  VectorXd const exact = reference.multipliers();
  CHECK((λ - exact).norm() < 1e-5 * exact.norm());
}

fem::contact_scene<3> brick() {
  return fem::make_steel_brick({.k = 2, .load = fem::brick_load::lift});
}

}  // namespace

TEST_CASE("from_files: Coulomb friction on a brick, coefficients by place") {
  auto const scene = brick();
  problem_files const files(scene);
  files.remove("g.txt");  // has no meaning here
  VectorXd const F = VectorXd::LinSpaced(scene.N.rows(), 0, 0.6);
  json const result = solved(files, put_coefficients(files, F));
  CHECK(result["status"] == "converged");
  CHECK(result["method"] == "coulomb");
  CHECK(result["solved_by"] == "newton");
  CHECK(result["tangents_per_node"] == 2);
  CHECK(result["kkt_residual"].get<double>() < 1e-6);
  CHECK(files.files_written() == 2);
  check_fixed_point(files, scene, F);
}

TEST_CASE("from_files: Coulomb friction in the plane, by every method, to few and to all digits") {
  auto const scene = plane_scene();
  problem_files const files(scene);
  VectorXd const F = VectorXd::Constant(scene.N.rows(), 0.4);
  std::string const option = put_coefficients(files, F) + " --method ";
  using pair = std::pair<std::string, std::string>;
  for (auto const& [method, solved_by] : {pair{"coulomb", "newton"}, pair{"newton", "newton"},
                                          pair{"radii", "radii"}, pair{"cones", "cones"}}) {
    CAPTURE(method);
    auto const ran = files.solve(option + method + " --tolerance 1e-10");
    CHECK(ran.status == 0);
    json const result = json::parse(ran.out);
    CHECK(result["method"] == method);
    CHECK(result["solved_by"] == solved_by);
    CHECK(result["tangents_per_node"] == 1);
    check_fixed_point(files, scene, F);
    auto const early = files.solve(option + method + " --max-iterations 1");
    if (method == "coulomb") {  // what chooses for itself goes on without factors
      CHECK(early.status == 0);
    } else {
      CHECK(early.status == 1);
      CHECK(json::parse(early.out)["status"] == "iteration_limit");
      CHECK(json::parse(early.out)["iterations"] == 1);
    }
    (void)files.solve(option + method + " --tolerance 0");
    check_fixed_point(files, scene, F);
  }
}

TEST_CASE("from_files: coefficients that cannot be used") {
  auto const scene = brick();
  VectorXd const F = VectorXd::Constant(scene.N.rows(), 0.3);
  problem_files const files(scene);
  VectorXd wrong = F;
  wrong[3] = -0.25;
  check_refusal(files, put_coefficients(files, wrong),
                "F.txt: got -0.25 at node 3, expected numbers >= 0");
  check_refusal(files, put_coefficients(files, F.head(5)),
                "F.txt:6: got the end of the file after 5 numbers, expected 18 numbers");
  check_refusal(files, put_coefficients(files, VectorXd::Constant(20, 0.3)),
                "F.txt:19: got number 19, expected 18 numbers");
  std::string const option = put_coefficients(files, F);
  for (std::string const bad : {"nan", "inf"}) {
    files.put("F.txt", bad + "\n");
    check_refusal(files, option, "F.txt:1: got '" + bad + "', expected a finite number");
  }
  slant::write_text_vector(files.input() / "F.txt", F);
  check_refusal(files, option + " --method kprgp",
                "--method: got kprgp, expected one of coulomb, newton, radii, cones, as --coulomb");
  check_refusal(files, option + " --max-iterations 0",
                "--max-iterations: got 0, expected at least 1");
  check_refusal(files, option + " --start qpc", "--start: got qpc, expected zero");
  files.remove("T.mtx");
  check_refusal(files, option, "T.mtx: got no such file");
}

}  // namespace from_files_coulomb
