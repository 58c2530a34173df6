// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <fem/double_obstacle.hpp>
#include <fem/plots/membrane_plot.hpp>
#include <sstream>
#include <string>

namespace membrane_plot_test {

TEST_CASE("the script holds a row per node and the counts of the states") {
  auto const m = fem::make_double_obstacle<>(3, 2);
  Eigen::VectorXd const v = Eigen::VectorXd::LinSpaced(6, 1, 6);
  fem::membrane_contact<> const contact{(Eigen::VectorXi(6) << -1, 0, 1, 0, 0, -1).finished(), v};
  auto const script = fem::membrane_script("m.png", "It's", m, v, contact);
  for (auto const* part :
       {"set output 'm.png'", "title 'It''s'", "0.25 0.33333333 1 -1\n", "0.75 0.66666667 6 -1\n",
        "lower obstacle 2, none 3, upper obstacle 1 nodes", "set xrange [0:1]"}) {
    CAPTURE(part);
    CHECK(script.find(part) != std::string::npos);
  }
}

TEST_CASE("of many nodes every n-th is drawn") {
  auto const m = fem::make_double_obstacle<>(500, 3);
  Eigen::VectorXd const v = Eigen::VectorXd::Zero(1500);
  fem::membrane_contact<> const contact{Eigen::VectorXi::Zero(1500), v};
  std::istringstream script(fem::membrane_script("m.png", "", m, v, contact));
  int rows = 0;
  bool inside = false;
  for (std::string line; std::getline(script, line);) {
    if (line == "EOD") break;
    rows += inside && !line.empty();
    inside = inside || line == "$nodes << EOD";
  }
  CHECK(rows == 3 * 167);
}

}  // namespace membrane_plot_test
