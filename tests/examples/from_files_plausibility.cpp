// SPDX-License-Identifier: MIT
//
// from_files on data that are valid and look wrong, and on bodies that supports do not hold.
#include <contact/loose_brick.hpp>
#include "problem_files.hpp"

namespace from_files_plausibility {
namespace {

using namespace examples_test;
using nlohmann::json;

fem::contact_scene<3> brick() {
  return fem::make_steel_brick({.k = 2, .load = fem::brick_load::press});
}

/// The brick without its clamp, as contact holds it: pressed and pushed, with a slip bound.
fem::contact_scene<3> loose_brick(double push, double slip) {
  test::loose_brick const loose(1, {-push, 0, 0}, slip);
  auto scene = brick();
  scene.mesh = loose.mesh;
  scene.K = loose.K;
  scene.f = loose.data.f;
  scene.N = loose.data.N;
  scene.T = loose.data.T;
  scene.d = loose.data.d;
  scene.g = loose.data.g;
  return scene;
}

/// A file with the coordinates, and the option that names it.
std::string put_coordinates(problem_files const& files, fem::contact_scene<3> const& scene) {
  std::string text = "%%MatrixMarket matrix array real general\n3 " +
                     std::to_string(scene.mesh.node_count()) + "\n";
  for (Eigen::Index i = 0; i < scene.mesh.nodes.size(); ++i)
    text += std::to_string(scene.mesh.nodes(i)) + "\n";
  files.put("x.mtx", text);
  return " --coordinates " + word((files.input() / "x.mtx").string());
}

/// Solved with one warning of this kind, refused with --strict.
void check_warned(fem::contact_scene<3> const& scene, std::string const& kind, int index) {
  CAPTURE(kind);
  problem_files const files(scene);
  auto const ran = files.solve();
  REQUIRE(is_one_line(ran.out));
  json const result = json::parse(ran.out);
  REQUIRE(result["warnings"].size() == 1);
  json const& warning = result["warnings"][0];
  CHECK(warning["kind"] == kind);
  CHECK(warning["index"] == index);
  std::string const text = warning["text"].get<std::string>();
  CHECK(ran.err == "from_files: warning: " + text + "\n");
  problem_files const again(scene);
  check_refusal(again, "--strict", "--strict: " + text);
}

}  // namespace

TEST_CASE("from_files: warnings in the report and on standard error, refusals with --strict") {
  problem_files const sound(brick());
  json const result = solved(sound, "--strict");
  CHECK(result["warnings"].empty());
  CHECK(result["warnings"].is_array());

  auto scene = brick();
  scene.N *= 1000;
  check_warned(scene, "other_units", 0);
  // Lifted off: known when it is solved, and refused then.
  scene = brick();
  scene.f = -scene.f;
  check_warned(scene, "no_contact", 0);
}

TEST_CASE("from_files: a body that contact and friction hold, without supports") {
  auto const scene = loose_brick(0.3, 0.05);
  problem_files const files(scene);
  json const result = solved(files, put_coordinates(files, scene));
  CHECK(result["status"] == "converged");
  CHECK(result["method"] == "floating");
  CHECK(result["solved_by"] == "proximal_point");
  CHECK(result["energy_error"].get<double>() <= 1e-8);
  CHECK(result["energy_error_proven"] == false);
  CHECK(result["kkt_residual"].get<double>() < 1e-6);
  REQUIRE(result["free_motions"].size() == 1);
  CHECK(result["free_motions"][0]["text"] ==
        "body 0 (unknowns 0 to 107) can move along x, y and z and turn about x, y and z");
  CHECK(result["free_motions"][0]["motions"] == 6);
  CHECK(files.read("lambda.txt").head(12).sum() == doctest::Approx(3));
  check_refusal(files.solve("--method kprgp"), ": body 0 (unknowns 0 to 107) has 6 free motions");

  problem_files const sliding(loose_brick(0.3, 0.01));
  auto const ran = sliding.solve(put_coordinates(sliding, scene));
  CHECK(ran.status == 1);
  json const slid = json::parse(ran.out);
  CHECK(slid["status"] == "unbounded");
  CHECK(slid["reason"] ==
        "neither contact nor friction holds the bodies under this load: body 0 (unknowns 0 to 107) "
        "moves along -x");
  problem_files const smooth(loose_brick(0, 0.01));
  smooth.remove("T.mtx");
  smooth.remove("g.txt");
  CHECK(solved(smooth)["energy_error"].get<double>() <= 1e-8);

  sliding.put("F.txt", "1\n1\n1\n1\n1\n1\n1\n1\n1\n1\n1\n1\n");
  check_refusal(sliding.solve("--coulomb " + word((sliding.input() / "F.txt").string())),
                ": body 0 (unknowns 0 to 107) has 6 free motions");
}

TEST_CASE(
    "from_files: coordinates that do not fit; the interior-point method with a slip bound 0") {
  problem_files const files(brick());
  auto const with = [&](std::string const& text, std::string const& expected) {
    files.put("x.mtx", text);
    check_refusal(files.solve("--coordinates " + word((files.input() / "x.mtx").string())),
                  expected);
  };
  with("%%MatrixMarket matrix array real general\n1 2\n1\n2\n",
       "got 1, expected 2 or 3 coordinates");
  with("%%MatrixMarket matrix array real general\n3 1\n1\n2\n3\n",
       "got 3, expected the coordinates of a node for each of its unknowns, 162");
  auto scene = brick();
  scene.g[2] = 0;
  problem_files const smooth(scene);
  auto const ran = smooth.solve("--method interior_point");
  CHECK(ran.status == 0);
  CHECK(contains(ran.out, "\"status\":\"converged\""));
}

}  // namespace from_files_plausibility
