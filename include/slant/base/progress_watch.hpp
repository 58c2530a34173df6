// SPDX-License-Identifier: MIT
//
// Stagnation test of descent methods. ‖r̃‖ may rise for a long time while q falls, and falls on when
// q has no more digits to lose, so either is progress:
//
//     ‖r̃‖ < (1 − share) × its value at the last progress,   or   q lower by more than rounding
//
// within `patience` steps. A value lower by some units in the last place is none: at the rounding
// floor there is always another one. With the share √ε a slow method passes: half of the digits of ‖r̃‖
// may stay the same for `patience` steps, and any fall of q is enough that is not a rounding error.
//
// Once ‖r̃‖ has been below `floor`, what its rounding errors may amount to, nothing but a halving
// counts, and the time for it is half of what it took to get there: a run ends after a small
// multiple of the steps that were of use.
#pragma once

#include <slant/concepts/vector.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace slant {

/// Counts steps without progress.
template <class S>
class progress_watch {
 public:
  progress_watch() : progress_watch(S(0)) {}
  /// A share of less than √ε is √ε.
  explicit progress_watch(S share)
      : share_(std::max<S>(share, root(std::numeric_limits<S>::epsilon()))) {}

  /// Has there been no progress for `patience` steps? energy() → {q, its rounding error} is asked
  /// only if ‖r̃‖ has not fallen for so long. floor: what ‖r̃‖ may be without being an error of x; 0
  /// if that is unknown.
  [[nodiscard]] bool stalled(index iteration, S const& norm_now, index patience, auto energy,
                             S const& floor = S(0)) {
    if (norm_now <= floor && !at_floor_) {
      at_floor_ = true;
      patience_at_floor_ = 16 + iteration / 2;
      last_norm_ = norm_now;
      since_ = iteration;
    }
    S const share = at_floor_ ? S(0.5) : share_;
    S const enough = last_norm_ - share * last_norm_;
    if (norm_now < enough || last_norm_ > std::numeric_limits<S>::max()) {
      last_norm_ = norm_now;
      since_ = iteration;
    }
    if (at_floor_) patience = std::min(patience, patience_at_floor_);
    if (iteration - since_ <= patience) return false;
    auto const [q, noise] = energy();
    if (!(q < smallest_energy_ - noise)) return true;
    smallest_energy_ = q;
    since_ = iteration;
    return false;
  }
  /// The same where ‖r̃‖, or what stands for it, alone is looked at.
  [[nodiscard]] bool stalled(index iteration, S const& norm_now, index patience,
                             S const& floor = S(0)) {
    return stalled(
        iteration, norm_now, patience,
        [] { return std::pair(std::numeric_limits<S>::infinity(), S(0)); }, floor);
  }

  /// Goes on after another method has had its turn, unless the floor has been reached.
  void begin_again(index iteration) {
    if (at_floor_) return;
    last_norm_ = smallest_energy_ = std::numeric_limits<S>::infinity();
    since_ = iteration;
  }
  /// Has ‖r̃‖ been below `floor`?
  [[nodiscard]] bool at_floor() const { return at_floor_; }
  /// q is another function, or measured in another unit, from now on.
  void forget_energy() { smallest_energy_ = std::numeric_limits<S>::infinity(); }

 private:
  static S root(S const& v) {
    using std::sqrt;
    return sqrt(v);
  }

  S share_;
  S last_norm_ = std::numeric_limits<S>::infinity();        // at the last progress
  S smallest_energy_ = std::numeric_limits<S>::infinity();  // when last asked
  index since_ = 0;                                         // the last step that got somewhere
  index patience_at_floor_ = 0;
  bool at_floor_ = false;
};

}  // namespace slant
