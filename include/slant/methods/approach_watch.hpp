// SPDX-License-Identifier: MIT
//
// Does a method still get anywhere whose iterates satisfy its constraints only in the limit? It has
// to become better than ever now and then, and to come nearer to the constraints unless it is there
// up to rounding: a method of multipliers goes on for ever where nothing is feasible.
#pragma once

#include <slant/concepts/scalar.hpp>

#include <algorithm>
#include <limits>

namespace slant {

/// Counts steps without progress.
template <class S>
class approach_watch {
 public:
  /// Has the error not been smaller than ever, or the distance from the constraints not a tenth
  /// smaller, for `patience` steps? Both are relative.
  [[nodiscard]] bool stalled(index iteration, S const& error, S const& distance, index patience) {
    if (error < smallest_error_) {
      smallest_error_ = error;
      last_progress_ = iteration;
    }
    if (is_near(distance) || distance < S(0.9) * smallest_distance_) {
      smallest_distance_ = std::min(smallest_distance_, distance);
      last_approach_ = iteration;
    }
    return iteration - std::min(last_progress_, last_approach_) >= patience;
  }

  /// Is the distance one that rounding errors of the whole run may explain?
  [[nodiscard]] static bool is_near(S const& distance) {
    using std::sqrt;
    return distance <= sqrt(std::numeric_limits<S>::epsilon());
  }

 private:
  S smallest_error_ = std::numeric_limits<S>::infinity();
  S smallest_distance_ = std::numeric_limits<S>::infinity();
  index last_progress_ = 0;
  index last_approach_ = 0;
};

}  // namespace slant
