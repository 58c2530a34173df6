// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <algorithm>
#include <fem/plots/flow_plot.hpp>
#include <limits>
#include <string>

namespace flow_plot_test {

std::ptrdiff_t rows_of(std::string const& script, std::string const& block) {
  auto const from = script.find(block + " << EOD\n");
  REQUIRE(from != std::string::npos);
  auto const to = script.find("\nEOD\n", from);
  return std::count(script.begin() + static_cast<std::ptrdiff_t>(from),
                    script.begin() + static_cast<std::ptrdiff_t>(to), '\n');
}

/// Made up: three nodes at the bottom of a square are its wall, the second of which slips.
struct some_flow {
  explicit some_flow(int cells) {
    fem::stokes_flow flow;
    flow.domain = fem::make_rectangle({cells, cells}, {1, 1});
    flow.dirichlet = {"left", "top"};
    flow.wall = "bottom";
    flow.slip_bound = [](auto const&) { return 2.0; };
    flow.velocity = [](Eigen::Vector2d const& x) -> Eigen::Vector2d { return {x[1], 0}; };
    scene = fem::make_stokes_scene(flow);
    auto const m = scene.wall_count();
    solution.u = Eigen::VectorXd::Constant(scene.velocity_count(), 0.25);
    solution.tangential = Eigen::VectorXd::Zero(m);
    solution.tangential[1] = scene.g[1];
    solution.normal = Eigen::VectorXd::Zero(m);
    solution.p = Eigen::VectorXd::Zero(scene.pressure_count());
    field = fem::make_wall_field(scene, solution);
    field.state.assign(static_cast<std::size_t>(m), fem::wall_state::stick);
    field.state[1] = fem::wall_state::slip;
  }
  [[nodiscard]] std::string script() const {
    return fem::flow_script("f.png", scene, solution, field, {{0, 0}, {1.01, 1.01}},
                            {{0, 0}, {0.5, 0.5}}, "It's");
  }
  fem::stokes_scene scene{};
  fem::stokes_solution solution{};
  fem::wall_field field{};
};

TEST_CASE("the script holds arrows, a row per wall node and the counts of the states") {
  some_flow const flow(3);
  auto const script = flow.script();
  CHECK(rows_of(script, "$channel") == 16);
  CHECK(rows_of(script, "$wall") == 3);
  CHECK(script.find("title 'stick 2'") != std::string::npos);
  CHECK(script.find("title 'slip 1'") != std::string::npos);
  CHECK(script.find("'It''s'") != std::string::npos);
  CHECK(script.find("title 'bounds'") != std::string::npos);
  // Second node: at the middle of the wall, σ_t = −2 between −2 and 2, slipping.
  CHECK(script.find(" 0.66666667 0 -2 2 -2 1 \n") != std::string::npos);
}

TEST_CASE("finer meshes have no more arrows than can be told apart") {
  CHECK(rows_of(some_flow(60).script(), "$channel") <= 88 * 16);
}

TEST_CASE("without a finite bound there is none in the picture") {
  some_flow flow(3);
  flow.field.bound.setConstant(std::numeric_limits<double>::infinity());
  CHECK(flow.script().find("bounds") == std::string::npos);
}

TEST_CASE("no wall, no picture") {
  some_flow flow(2);
  flow.field = {};
  auto const result = fem::flow_plot("/no/such/folder/f.png", flow.scene, flow.solution, flow.field,
                                     {{0, 0}, {1, 1}}, {{0, 0}, {1, 1}}, "");
  CHECK_FALSE(result.written);
  CHECK(result.message == "no picture: there are no wall nodes");
}

}  // namespace flow_plot_test
