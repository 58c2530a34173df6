// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <algorithm>

#include <fem/plots/slip_history_plot.hpp>
#include <fem/steel_brick.hpp>
#include <string>

namespace slip_history_plot_test {

fem::contact_field<3> field_of(fem::contact_scene<3> const& scene) {
  Eigen::VectorXd const u = Eigen::VectorXd::Zero(scene.f.size());
  Eigen::VectorXd const λ = Eigen::VectorXd::Ones(scene.contact_count());
  return fem::make_contact_field(scene, u, λ,
                                 Eigen::VectorXd(Eigen::VectorXd::Zero(scene.T.rows())));
}

TEST_CASE("states along one line of nodes, and shares of the whole side, by step") {
  auto const scene = fem::make_steel_brick({.k = 1});  // 3 × 2 nodes, the side is 3 × 1
  auto const field = field_of(scene);
  using enum fem::contact_state;
  std::vector<fem::slip_record> const records{{0.5, {stick, stick, stick, stick, stick, stick}},
                                              {1.0, {slip, slip, stick, stick, open, open}}};
  auto const script = fem::slip_history_script("slip.png", field, records, "It's slipping");
  CHECK(script.find("'It''s slipping'") != std::string::npos);
  auto const block = [&](std::string const& name) {
    auto const begin = script.find("$" + name + " << EOD\n") + name.size() + 9;
    return script.substr(begin, script.find("EOD\n", begin) - begin);
  };
  auto const rows = [](std::string const& text) {
    return std::count(text.begin(), text.end(), '\n');
  };
  CHECK(rows(block("line")) == 3 * 2);  // one of two lines of three nodes, two steps
  CHECK(rows(block("shares")) == 2);
  CHECK(block("shares").find("0.25 0 0.5 0 1\n") == 0);
}

TEST_CASE("nothing to draw is a message") {
  auto const field = field_of(fem::make_steel_brick({.k = 1}));
  auto const result = fem::slip_history_plot("slip.png", field, {}, "none");
  CHECK_FALSE(result.written);
  CHECK(result.message.find("no picture") == 0);
}

}  // namespace slip_history_plot_test
