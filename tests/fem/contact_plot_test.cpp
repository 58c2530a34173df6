// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <fem/brick_mesh.hpp>
#include <fem/plots/contact_plot.hpp>
#include <io/io_support.hpp>

namespace contact_plot_test {

bool contains(std::string const& text, std::string const& part) {
  return text.find(part) != std::string::npos;
}

// Made up: the first node is open with friction, then one that sticks and one that slips; the
// others are open. No matrix is needed for this.
fem::contact_field<3> some_field(int k) {
  auto const mesh = fem::make_brick_mesh(k);
  fem::contact_field<3> field;
  field.side = {.centre = {1.5, 0.5}, .lower = {0, 0}, .upper = {3, 1}};
  for (int const node : mesh.nodes_on(fem::brick_side::bottom))
    if (!mesh.on(fem::brick_side::left, node))
      field.patches.push_back(fem::patch_of<3>(mesh, fem::brick_side::bottom, node));
  auto const m = static_cast<Eigen::Index>(field.patches.size());
  field.normal = Eigen::VectorXd::Zero(m);
  field.friction = Eigen::MatrixXd::Zero(2, m);
  field.slip_bound = Eigen::VectorXd::Constant(m, 0.3);
  field.state.assign(field.patches.size(), fem::contact_state::open);
  field.at_slip_bound.assign(field.patches.size(), false);
  field.at_slip_bound[0] = true;
  field.friction.col(0) << 0.3, 0;
  field.state[1] = fem::contact_state::stick;
  field.normal[1] = 1.5;
  field.state[2] = fem::contact_state::slip;
  return field;
}

TEST_CASE("the script holds a row per node and the counts of the states") {
  auto const script =
      fem::contact_script("c.png", some_field(1), {.title = "It's", .stress_unit = "kPa"});
  // Nodes of one cell: x = 1 and y = 0 first; the middle of its rectangle, the rectangle, pressure,
  // friction, state, friction at its bound.
  CHECK(contains(script, "$nodes << EOD\n1 0.25 0.5 1.5 0 0.5 0 0.3 0 1\n"));
  CHECK(contains(script, "'open  4'"));
  CHECK(contains(script, "'stick  1'"));
  CHECK(contains(script, "'slip  1'"));
  CHECK(contains(script, "'It''s'"));
  CHECK(contains(script, "'Contact pressure [kPa]'"));
  CHECK(contains(script, "set cbrange [0:1.5]"));
  CHECK(contains(script, "set xrange [0:3]"));
}

TEST_CASE("finer meshes have fewer arrows than nodes") {
  auto const arrows = [](int k) {
    auto const script = fem::contact_script("c.png", some_field(k), {});
    auto const from = script.find("$arrows << EOD\n");
    auto const to = script.find("EOD\n", from + 15);
    return std::count(script.begin() + static_cast<std::ptrdiff_t>(from) + 15,
                      script.begin() + static_cast<std::ptrdiff_t>(to), '\n');
  };
  CHECK(arrows(2) == 18);
  CHECK(arrows(15) <= 40 * 14);
  CHECK(arrows(15) >= 20 * 7);
}

TEST_CASE("the contact becomes a PNG where gnuplot is installed") {
  io_test::temporary_folder const folder;
  auto const result = fem::contact_plot(folder / "c.png", some_field(2));
  CHECK(result.written == (io_test::get(folder / "c.png").starts_with("\x89PNG")));
  bool const missing = contains(result.message, "was not found");
  CHECK(result.written != missing);  // a script that gnuplot refuses is neither
}

}  // namespace contact_plot_test
