// SPDX-License-Identifier: MIT
//
// What the program coulomb presses, drags and releases: the steel brick on its foundation, or two
// bricks on top of each other.
#pragma once

#include <fem/steel_brick.hpp>
#include <fem/two_bricks.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

namespace coulomb {

/// A scene with its two loads.
struct loaded_scene {
  std::string title;
  fem::contact_scene<3> scene;
  Eigen::VectorXd press;  ///< presses the sides together
  Eigen::VectorXd drag;   ///< a traction on top, along the contact side
};

/// `brick` with 3k × k × k cells, or `bricks` with k × (k−1) × (k−1) cells each.
[[nodiscard]] inline loaded_scene make_scene(std::string_view model, int k) {
  Eigen::Vector3d const along(0.35, 0.15, 0);
  if (model == "brick") {
    loaded_scene s{"Steel brick on a foundation", fem::make_steel_brick({.k = k}), {}, {}};
    s.press = s.scene.f;
    s.drag = Eigen::VectorXd::Zero(s.press.size());
    fem::add_tractions<3>(fem::make_brick_mesh(k, Eigen::Vector3d(3, 1, 1)), s.scene.unknowns,
                          {{fem::brick_side::top, along}}, s.drag);
    return s;
  }
  loaded_scene s{"Two bricks", fem::make_two_bricks(k), {}, {}};
  // The upper one comes first: its mesh alone numbers its nodes as the scene does.
  auto const upper = fem::make_box_mesh<3>({k, k - 1, k - 1}, {2000, 1000, 1000}, {0, 0, 1000});
  s.press = s.drag = Eigen::VectorXd::Zero(s.scene.f.size());
  fem::add_tractions<3>(upper, s.scene.unknowns, {{{2, true}, {0, 0, -1}}}, s.press);
  fem::add_tractions<3>(upper, s.scene.unknowns, {{{2, true}, along}}, s.drag);
  return s;
}

/// Shares of both loads at a time in [0, 3]: pressed until 1, dragged until 2, released from the
/// drag until 3. Friction holds back what was dragged.
struct load_share {
  double press;
  double drag;
};
[[nodiscard]] constexpr load_share share_at(double time) {
  if (time <= 1) return {time, 0};
  if (time <= 2) return {1, time - 1};
  return {1, 3 - time};
}

}  // namespace coulomb
