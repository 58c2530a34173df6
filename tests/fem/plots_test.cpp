// SPDX-License-Identifier: MIT
//
// Pictures: the script is well-formed and holds the numbers, and gnuplot, where it is installed,
// makes a PNG of it.
#include <doctest/doctest.h>

#include <cmath>
#include <fem/brick_mesh.hpp>
#include <fem/plots/contact_line_plot.hpp>
#include <fem/plots/contact_plot.hpp>
#include <fem/plots/gnuplot.hpp>
#include <fem/plots/history_plot.hpp>
#include <fem/steel_brick.hpp>
#include <fem/two_plates.hpp>
#include <initializer_list>
#include <io/io_support.hpp>
#include <string>

namespace plots_test {

using io_test::temporary_folder;

bool contains(std::string const& text, std::string const& part) {
  return text.find(part) != std::string::npos;
}

void check_holds(std::string const& script, std::initializer_list<char const*> parts) {
  for (auto const* part : parts) {
    CAPTURE(part);
    CHECK(contains(script, part));
  }
}

/// Made up: the first node sticks, the second slips, the others are open.
fem::contact_field<2> line_field() {
  auto const scene = fem::make_two_plates(1);
  Eigen::VectorXd const u = Eigen::VectorXd::Zero(scene.K.rows());
  auto field = fem::make_contact_field(scene, u, Eigen::VectorXd(Eigen::Vector3d(2, 1, 0)),
                                       Eigen::VectorXd(Eigen::Vector3d(-0.25, 1.7e7, 0)));
  field.state[0] = fem::contact_state::stick;
  field.state[1] = fem::contact_state::slip;
  return field;
}

/// Made up: open with friction, then a node that sticks and one that slips; the others are open.
fem::contact_field<3> side_field(int k) {
  auto const mesh = fem::make_brick_mesh(k);
  fem::contact_field<3> field;
  field.side = {.centre = {1.5, 0.5}, .lower = {0, 0}, .upper = {3, 1}};
  for (int const node : mesh.nodes_on(fem::brick_side::bottom))
    if (!mesh.on(fem::brick_side::left, node))
      field.patches.push_back(fem::patch_of<3>(mesh, fem::brick_side::bottom, node));
  auto const m = static_cast<Eigen::Index>(field.patches.size());
  field.normal = 1.5 * Eigen::VectorXd::Unit(m, 1);
  field.friction = Eigen::MatrixXd::Zero(2, m);
  field.friction(0, 0) = 0.3;
  field.slip_bound = Eigen::VectorXd::Constant(m, 0.3);
  field.state.assign(field.patches.size(), fem::contact_state::open);
  field.state[1] = fem::contact_state::stick;
  field.state[2] = fem::contact_state::slip;
  field.at_slip_bound.assign(field.patches.size(), false);
  field.at_slip_bound[0] = true;
  return field;
}

TEST_CASE("histories: what a logarithmic axis cannot show is left out; Newton steps are stars") {
  std::vector<fem::history_series> series{
      {"first", {{0, 1}, {1, 0}, {2, std::nan("")}, {3, INFINITY}, {4, 1e-3}, {5, -1}}},
      {"second", {{0, 1}, {3, 0.5}, {9, 1e-5}}, {{0, 1}, {9, 1e-5}, {12, 0}}},
      {"nothing", {{0, 0}}}};
  auto const script = fem::history_script("h.png", series, {});
  check_holds(script, {"$series0 << EOD\n0 1\n4 0.001\nEOD\n", "$series2 << EOD\nEOD\n", "'first'",
                       "$stars1 << EOD\n0 1\n9 1e-05\nEOD\n", "title 'second: Newton steps'"});
  CHECK_FALSE(contains(script, "'nothing'"));  // gnuplot refuses empty data
  CHECK_FALSE(contains(script, "$stars0"));
  fem::subtract(series[1], -3.5);
  CHECK(series[1].points[0].residual == 4.5);
  CHECK(series[1].newton_steps[0].residual == 4.5);
  CHECK(fem::history_script("h.png", {}, {}).empty());
  CHECK_FALSE(fem::history_plot("h.png", {{"only zero", {{1, 0}}}}).written);
}

TEST_CASE("pictures become a PNG where gnuplot is installed") {
  temporary_folder const folder;
  auto const check = [&](fem::plot_result const& result, char const* file) {
    CHECK(result.written == (io_test::get(folder / file).starts_with("\x89PNG")));
    // A script that gnuplot refuses is neither.
    CHECK(result.written != contains(result.message, "was not found"));
  };
  check(fem::contact_plot(folder / "line.png", line_field()), "line.png");
  check(fem::contact_plot(folder / "side.png", side_field(2)), "side.png");
  check(fem::history_plot(
            folder / "h.png",
            {{"one", {{0, 1}, {10, 1e-8}}}, {"two_{x}", {{0, 1}, {20, 1e-6}}, {{20, 1e-6}}}},
            {.title = "it's a title"}),
        "h.png");
  CHECK_FALSE(fem::contact_plot(folder / "d.png", fem::contact_field<2>{}).written);
}

TEST_CASE("text becomes one gnuplot string, whatever it contains") {
  CHECK(fem::gnuplot_string("plain") == "'plain'");
  CHECK(fem::gnuplot_string("it's `rm` \"x\"") == "'it''s `rm` \"x\"'");
  CHECK(fem::gnuplot_string("two\nlines") == "'two lines'");
}

TEST_CASE(
    "a gnuplot that is missing, fails or draws nothing is a message, and the script is there") {
  temporary_folder const folder;
  for (auto const& [program, message] :
       {std::pair{"no-such-gnuplot", "no-such-gnuplot was not found"},
        {"false", "status 1"},
        {"true", ""}}) {
    io_test::put(folder / "a.png", "old picture");
    auto const result = fem::run_gnuplot(folder / "a.png", "plot x\n", program);
    CHECK_FALSE(result.written);
    CHECK(contains(result.message, message));
    CHECK_FALSE(std::filesystem::exists(folder / "a.png"));
    CHECK(io_test::get(folder / "a.gp") == "plot x\n");
  }
  CHECK(contains(fem::run_gnuplot(folder / "none/a.png", "plot x\n", "true").message,
                 "cannot write"));
}

TEST_CASE("the program runs in the folder of the picture, however that is called") {
  temporary_folder const folder;
  auto const odd = folder / "it's a $(folder)";
  std::filesystem::create_directory(odd);
  io_test::put(odd / "draw", "#!/bin/sh\ncat \"$1\" > drawn.png\n");
  std::filesystem::permissions(odd / "draw", std::filesystem::perms::owner_all);
  auto const result = fem::run_gnuplot(odd / "drawn.png", "content", (odd / "draw").string());
  CHECK(result.written);
  CHECK(io_test::get(odd / "drawn.png") == "content");
}

}  // namespace plots_test
