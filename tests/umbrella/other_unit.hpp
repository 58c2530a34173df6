// SPDX-License-Identifier: MIT
//
// What the second translation unit of this test hands to the first.
#pragma once

#include <slant/slant.hpp>

namespace umbrella {

/// The smallest contact problem with every part of its type visible: one pressure, one friction
/// disc.
using forces = decltype(slant::cartesian(slant::half_line{}, slant::ball<2>{}));

/// Projection onto `forces`, compiled in the other unit.
[[nodiscard]] Eigen::Vector3d project_elsewhere(Eigen::Vector3d const& x);

/// Where the function objects of the library are, seen from the other unit.
struct addresses {
  void const* apply;
  void const* project;
  void const* evaluate;
};
[[nodiscard]] addresses addresses_elsewhere();

/// A library exception, thrown in the other unit.
[[noreturn]] void refuse_elsewhere();

}  // namespace umbrella
