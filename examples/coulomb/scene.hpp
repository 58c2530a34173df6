// SPDX-License-Identifier: MIT
//
// What the program coulomb presses, drags and releases: the steel brick on its foundation, two
// bricks on top of each other, or two plates.
#pragma once

#include <fem/steel_brick.hpp>
#include <fem/two_bricks.hpp>
#include <fem/two_plates.hpp>
#include <string>
#include <string_view>
#include <utility>

#include "settings.hpp"

namespace coulomb {

/// A scene with its two loads.
template <int D>
struct loaded_scene {
  std::string title;
  std::string_view stress_unit;
  fem::contact_scene<D> scene;
  Eigen::VectorXd press{};  ///< presses the sides together
  Eigen::VectorXd drag{};   ///< drags along the contact side
};

namespace detail {

/// The load of a traction on a mesh whose nodes are the first of the scene.
template <int D>
[[nodiscard]] Eigen::VectorXd load_of(fem::side_traction<D> const& traction,
                                      fem::box_mesh<D> const& mesh,
                                      fem::contact_scene<D> const& scene) {
  Eigen::VectorXd load = Eigen::VectorXd::Zero(scene.f.size());
  fem::add_tractions<D>(mesh, scene.unknowns, {traction}, load);
  return load;
}

}  // namespace detail

/// `brick` with 3k × k × k cells, or `bricks` with k × (k−1) × (k−1) cells each.
[[nodiscard]] inline loaded_scene<3> make_bodies(std::string_view model, int k) {
  Eigen::Vector3d const along(0.35, 0.15, 0);
  if (model == "brick") {
    loaded_scene<3> s{"Steel brick on a foundation", "MPa", fem::make_steel_brick({.k = k})};
    s.press = s.scene.f;
    s.drag = detail::load_of<3>({fem::brick_side::top, along},
                                fem::make_brick_mesh(k, Eigen::Vector3d(3, 1, 1)), s.scene);
    return s;
  }
  loaded_scene<3> s{"Two bricks", "MPa", fem::make_two_bricks(k)};
  // The upper one comes first: its mesh alone numbers its nodes as the scene does.
  auto const upper = fem::make_box_mesh<3>({k, k - 1, k - 1}, {2000, 1000, 1000}, {0, 0, 1000});
  s.press = detail::load_of<3>({{2, true}, {0, 0, -1}}, upper, s.scene);
  s.drag = detail::load_of<3>({{2, true}, along}, upper, s.scene);
  return s;
}

/// 3k × k cells each. Pressed from above; dragged by what tears at the right end of the upper one.
[[nodiscard]] inline loaded_scene<2> make_plates(int k) {
  loaded_scene<2> s{"Two plates", "Pa", fem::make_two_plates(k)};
  auto const upper = fem::make_plate_mesh(k, 1);
  auto const loads = fem::loads_on_plates();
  s.press = detail::load_of<2>(loads.from_above, upper, s.scene);
  s.drag = detail::load_of<2>(loads.at_end, upper, s.scene);
  return s;
}

/// Friction coefficients of the contact nodes, along x and along y; the same if not orthotropic.
struct friction {
  Eigen::VectorXd along;
  Eigen::VectorXd across;
};

/// F(x) = F (1 + v (2x/L − 1)) on a side of the length L, v the variation.
template <int D>
[[nodiscard]] friction friction_of(settings const& s, fem::contact_scene<D> const& scene) {
  Eigen::VectorXd shape(scene.contact_count());
  double const begin = scene.contact_side.lower[0];
  double const length = scene.contact_side.upper[0] - begin;
  for (Eigen::Index i = 0; i < shape.size(); ++i) {
    auto const& patch = scene.contact_patches[static_cast<std::size_t>(i)];
    double const x = (patch.lower[0] + patch.upper[0]) / 2 - begin;
    shape[i] = 1 + s.variation * (2 * x / length - 1);
  }
  Eigen::VectorXd const along = s.friction * shape;
  return {along, s.orthotropic() ? Eigen::VectorXd(s.across * shape) : along};
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
