// SPDX-License-Identifier: MIT
//
// Does a descent method still get anywhere? Rounding errors end every descent; whoever asks for
// more is told so. ‖r̃‖ may rise for a long time while q falls, and falls on when q has no more
// digits to lose: either is progress.
#pragma once

#include <slant/concepts/vector.hpp>

#include <limits>
#include <utility>

namespace slant {

/// Counts steps without progress.
template <class S>
class progress_watch {
 public:
  /// Has there been no progress for `patience` steps? energy() → {q, its rounding error} is asked
  /// only if ‖r̃‖ has not become smaller than ever for so long.
  template <class Energy>
  [[nodiscard]] bool stalled(index iteration, S const& norm_now, index patience, Energy energy) {
    if (norm_now < smallest_norm_) {
      smallest_norm_ = norm_now;
      since_ = iteration;
    }
    if (iteration - since_ <= patience) return false;
    auto const [q, noise] = energy();
    if (!(q < smallest_energy_ - noise)) return true;
    smallest_energy_ = q;
    since_ = iteration;
    return false;
  }
  /// The same where ‖r̃‖, or what stands for it, alone is looked at.
  [[nodiscard]] bool stalled(index iteration, S const& norm_now, index patience) {
    return stalled(iteration, norm_now, patience,
                   [] { return std::pair(std::numeric_limits<S>::infinity(), S(0)); });
  }

 private:
  S smallest_norm_ = std::numeric_limits<S>::infinity();
  S smallest_energy_ = std::numeric_limits<S>::infinity();  // when last asked
  index since_ = 0;                                         // the last step that got somewhere
};

}  // namespace slant
