// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <fem/plots/contact_line_plot.hpp>
#include <fem/two_plates.hpp>
#include <io/io_support.hpp>

namespace contact_line_plot_test {

bool contains(std::string const& text, std::string const& part) {
  return text.find(part) != std::string::npos;
}

/// Made up: the first node sticks, the second slips, the others are open.
fem::contact_field<2> some_field() {
  auto const scene = fem::make_two_plates(1);
  Eigen::VectorXd λ(3);
  λ << 2, 1, 0;
  Eigen::VectorXd μ(3);
  μ << -0.25, 1.7e7, 0;
  Eigen::VectorXd const u = Eigen::VectorXd::Zero(scene.K.rows());
  auto field = fem::make_contact_field(scene, u, λ, μ);
  field.state[0] = fem::contact_state::stick;
  field.state[1] = fem::contact_state::slip;
  return field;
}

TEST_CASE("the script holds a row per node and the counts of the states") {
  auto const script =
      fem::contact_script("c.png", some_field(), {.title = "It's", .stress_unit = "kPa"});
  // Place, pressure, friction on the upper plate, slip bound, state.
  CHECK(contains(script, "$nodes << EOD\n1 2 0.25 17000000 1\n2 1 -17000000 17000000 2\n3 0 "));
  CHECK(contains(script, "'open 1'"));
  CHECK(contains(script, "'stick 1'"));
  CHECK(contains(script, "'slip 1'"));
  CHECK(contains(script, "'It''s'"));
  CHECK(contains(script, "'Contact pressure [kPa]'"));
  CHECK(contains(script, "set xrange [0:3]"));
}

TEST_CASE("the panels become a PNG where gnuplot is installed, and need a node") {
  io_test::temporary_folder const folder;
  auto const result = fem::contact_plot(folder / "c.png", some_field());
  CHECK(result.written == (io_test::get(folder / "c.png").starts_with("\x89PNG")));
  CHECK(result.written != contains(result.message, "was not found"));
  CHECK_FALSE(fem::contact_plot(folder / "d.png", fem::contact_field<2>{}).written);
}

}  // namespace contact_line_plot_test
