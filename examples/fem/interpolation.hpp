// SPDX-License-Identifier: MIT
//
// Linear interpolation between the points of two meshes of a line, the building block of the
// prolongations.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include <fem/require.hpp>

namespace fem {

/// A value between two neighbours: (1 − weight) v[left] + weight v[right].
template <class S = double>
struct interpolated {
  std::size_t left;
  std::size_t right;
  S weight;
};

/// Where each of the points `to` lies between the points `from`, which increase. Beyond the first
/// and the last point the line through the outer two is continued, so that linear functions are
/// exact everywhere; of a single point the value is taken. Throws std::invalid_argument if `from`
/// is empty or does not increase.
template <class S>
[[nodiscard]] std::vector<interpolated<S>> interpolate(std::vector<S> const& from,
                                                       std::vector<S> const& to) {
  require(!from.empty(), "from", from.size(), "at least one point");
  for (std::size_t i = 1; i < from.size(); ++i)
    require(from[i - 1] < from[i], "from", from[i], "increasing points");
  std::vector<interpolated<S>> places;
  places.reserve(to.size());
  for (S const& x : to) {
    if (from.size() == 1) {
      places.push_back({0, 0, S(0)});
      continue;
    }
    auto const after = std::upper_bound(from.begin() + 1, from.end() - 1, x);
    auto const right = static_cast<std::size_t>(after - from.begin());
    places.push_back({right - 1, right, (x - from[right - 1]) / (from[right] - from[right - 1])});
  }
  return places;
}

}  // namespace fem
