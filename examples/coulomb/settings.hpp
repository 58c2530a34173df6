// SPDX-License-Identifier: MIT
//
// What the command line of coulomb says.
#pragma once

#include <cmath>
#include <filesystem>
#include <limits>
#include <string>

namespace coulomb {

struct settings {
  std::string model = "brick";
  int k = 6;
  double friction = 0.3;  ///< mean over the contact side
  double variation = 0;   ///< it grows along x by this part of the mean, from - to +
  double across = std::numeric_limits<double>::quiet_NaN();  ///< mean along y; NaN: the same
  std::string method = "coulomb";
  int steps = 8;  ///< of each of the three phases
  double tolerance = 1e-8;
  std::filesystem::path output{};

  [[nodiscard]] bool orthotropic() const { return !std::isnan(across); }
};

/// Two plates; a body in space. Both return the exit status.
[[nodiscard]] int follow_in_plane(settings const& s);
[[nodiscard]] int follow_in_space(settings const& s);

}  // namespace coulomb
