// SPDX-License-Identifier: MIT
//
// The steel brick on a rigid foundation [T §4.2, K Ex 3]: (0,3) × (0,1) × (0,1), E = 2.119e5 MPa,
// ν = 0.277, fixed at x = 0, contact on z = 0 with outer normal (0,0,−1) and no gap. The tractions
// of the original are not printed; the three loads here are ours.
#pragma once

#include <array>
#include <optional>
#include <string_view>
#include <vector>

#include <fem/brick_mesh.hpp>
#include <fem/contact_scene.hpp>

namespace fem {

/// press: pressure on top. pull: also a traction on the right end, forwards and up.
/// lift: a strong upward traction on the right end, which opens about half of the contact.
enum class brick_load { press, pull, lift };

inline constexpr std::array brick_loads{brick_load::press, brick_load::pull, brick_load::lift};

[[nodiscard]] constexpr std::string_view name_of(brick_load load) {
  switch (load) {
    case brick_load::press:
      return "press";
    case brick_load::pull:
      return "pull";
    case brick_load::lift:
      return "lift";
  }
  return "";
}

/// The load of that name, or nothing.
[[nodiscard]] constexpr std::optional<brick_load> brick_load_named(std::string_view name) {
  for (brick_load load : brick_loads)
    if (name_of(load) == name) return load;
  return std::nullopt;
}

/// Tractions (MPa) on the sides of the brick, and Tresca's slip bound (MPa).
struct brick_loading {
  std::vector<side_traction<3>> tractions;
  double slip_bound;
};

/// The loading of that name, times a factor.
[[nodiscard]] inline brick_loading loading_of(brick_load load, double factor = 1) {
  brick_loading loading{{{brick_side::top, factor * Eigen::Vector3d(0, 0, -1)}}, factor * 0.3};
  if (load == brick_load::pull)
    loading.tractions.push_back({brick_side::right, factor * Eigen::Vector3d(0.5, 0, 0.3)});
  if (load == brick_load::lift) {
    loading.tractions.push_back({brick_side::right, factor * Eigen::Vector3d(0.3, 0.2, 1.2)});
    loading.slip_bound = factor * 0.6;
  }
  return loading;
}

/// Everything that can be varied about the brick.
struct steel_brick_options {
  int k = 4;  ///< 3k × k × k cells
  brick_load load = brick_load::press;
  double E = 2.119e5;  ///< MPa
  double nu = 0.277;
  Eigen::Vector3d size{3, 1, 1};
  double load_factor = 1;  ///< multiplies tractions and slip bound
};

/// The discretised brick: n_u = 9k(k+1)² unknowns and m = 3k(k+1) contact nodes.
[[nodiscard]] inline contact_scene<3> make_steel_brick(steel_brick_options const& options) {
  require(std::isfinite(options.load_factor) && options.load_factor > 0, "load_factor",
          options.load_factor, "a positive finite number");
  brick_loading const loading = loading_of(options.load, options.load_factor);
  return make_contact_scene<3>({.mesh = make_brick_mesh(options.k, options.size),
                                .material = lame(options.E, options.nu),
                                .fixed = brick_side::left,
                                .contact = brick_side::bottom,
                                .loads = loading.tractions,
                                .slip_bound = loading.slip_bound});
}

}  // namespace fem
