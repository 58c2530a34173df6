// SPDX-License-Identifier: MIT
//
// from_files on bodies with Coulomb friction.
#include <doctest/doctest.h>

#include <nlohmann/json.hpp>
#include <oracle/dense_contact_reference.hpp>
#include <string>

#include "problem_files.hpp"

namespace {

using examples_test::check_refusal;
using examples_test::problem_files;
using examples_test::solved;
using nlohmann::json;

/// F.txt beside the problem, and the option that names it.
std::string put_coefficients(problem_files const& files, Eigen::VectorXd const& F) {
  slant::write_text_vector(files.input() / "F.txt", F);
  return "--coulomb " + examples_test::word((files.input() / "F.txt").string());
}

/// The result is the solution of Tresca's problem with the slip bounds F λ_ν: then it is one with
/// Coulomb friction.
template <int D>
void check_fixed_point(problem_files const& files, fem::contact_scene<D> scene,
                       Eigen::VectorXd const& F) {
  Eigen::VectorXd const λ = files.read("lambda.txt");
  scene.g = F.cwiseProduct(λ.head(F.size()).cwiseMax(0));
  auto const reference =
      oracle::solve_contact({scene.K, scene.N, scene.T, scene.f, scene.d, scene.g});
  CHECK(oracle::energy_error(scene.K, files.read("u.txt"), reference.u) < 1e-6);
  Eigen::VectorXd const exact = reference.multipliers();
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
  Eigen::VectorXd const F = Eigen::VectorXd::LinSpaced(scene.N.rows(), 0, 0.6);
  json const result = solved(files, put_coefficients(files, F));
  CHECK(result["status"] == "converged");
  CHECK(result["method"] == "coulomb");
  CHECK(result["tangents_per_node"] == 2);
  CHECK(result["kkt_residual"].get<double>() < 1e-6);
  CHECK(files.files_written() == 2);
  check_fixed_point(files, scene, F);
}

TEST_CASE("from_files: Coulomb friction in the plane") {
  auto const scene = examples_test::plane_scene();
  problem_files const files(scene);
  Eigen::VectorXd const F = Eigen::VectorXd::Constant(scene.N.rows(), 0.4);
  CHECK(files.solve(put_coefficients(files, F) + " --tolerance 1e-10").status == 0);
  check_fixed_point(files, scene, F);
}

TEST_CASE("from_files: coefficients that cannot be used") {
  auto const scene = brick();
  Eigen::VectorXd const F = Eigen::VectorXd::Constant(scene.N.rows(), 0.3);
  problem_files const files(scene);
  Eigen::VectorXd wrong = F;
  wrong[3] = -0.25;
  check_refusal(files, put_coefficients(files, wrong),
                "F.txt: got -0.25 at node 3, expected numbers >= 0");
  check_refusal(files, put_coefficients(files, F.head(5)),
                "F.txt:6: got the end of the file after 5 numbers, expected 18 numbers");
  std::string const option = put_coefficients(files, F);
  check_refusal(files, option + " --method kprgp", "--method: got kprgp, expected coulomb");
  check_refusal(files, option + " --start qpc", "--start: got qpc, expected zero");
  files.remove("T.mtx");
  check_refusal(files, option, "T.mtx: got no such file");
}
