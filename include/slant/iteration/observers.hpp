// SPDX-License-Identifier: MIT
//
// Observers: they are shown every state and change nothing.
#pragma once

#include <slant/iteration/stopping.hpp>

#include <cmath>
#include <cstdio>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace slant {

/// Records one number per state: history h{[](auto const& s) { return s.reduced_gradient_norm; }};
/// Memory is reserved ahead so that recording does not allocate within the first `capacity` states.
template <class Projection, class Value = double>
class history {
 public:
  explicit history(Projection p, std::size_t capacity = 4096) : projection_(std::move(p)) {
    values_.reserve(capacity);
  }
  template <class State>
  void operator()(State const& s) {
    values_.push_back(static_cast<Value>(projection_(s)));
  }
  [[nodiscard]] std::vector<Value> const& values() const { return values_; }

 private:
  Projection projection_;
  std::vector<Value> values_;
};

/// A progress line on a terminal: "kprgp  step 120  products 133  residual 3.1e-05 → 1.0e-08".
/// The bar is logarithmic in the relative accuracy. Prints at most every `every` states, and
/// nothing at all if the stream is not `enabled` (decide with isatty in the program).
/// Throws bad_input if the tolerance is not in [0, 1) or `every` < 1.
class progress_bar {
 public:
  struct options {
    std::FILE* stream = stderr;  ///< where to draw
    bool enabled = true;         ///< false: stay silent
    index every = 1;             ///< draw every n-th state, n >= 1

    /// Throws bad_input naming the option, its value and what was expected.
    [[gnu::cold]] void validate() const {
      if (every < 1) throw bad_input("every", detail::show(every), "a number of states >= 1");
    }
  };
  progress_bar(std::string title, double tolerance)
      : progress_bar(std::move(title), tolerance, {}) {}
  progress_bar(std::string title, double tolerance, options o)
      : title_(std::move(title)), tolerance_(detail::checked_tolerance(tolerance)), options_(o) {
    options_.validate();
  }
  ~progress_bar() {
    if (drawn_) std::fputc('\n', options_.stream);
  }
  progress_bar(progress_bar const&) = delete;
  progress_bar& operator=(progress_bar const&) = delete;

  template <class State>
    requires has_reduced_gradient_norm<State> || has_residual_norm<State>
  void operator()(State const& s) {
    if (!options_.enabled || s.iteration % options_.every != 0) return;
    double error = 0;
    if constexpr (has_reduced_gradient_norm<State>) {
      error = ratio(s.reduced_gradient_norm, s.gradient_scale);
    } else {
      error = ratio(s.residual_norm, s.residual_scale);
    }
    draw(s.iteration, error);
  }

 private:
  /// 0/0 is 0: nothing to solve, nothing left to do.
  template <class S>
  static double ratio(S value, S scale) {
    return value == S(0) && scale == S(0) ? 0.0 : static_cast<double>(value / scale);
  }
  void draw(index step, double error) {
    constexpr int width = 30;
    // Full when log(error) has come all the way from 1 to the tolerance.
    double done = 1;
    if (!(error <= tolerance_)) {  // also if it is NaN
      done = error < 1 && tolerance_ > 0 ? std::log(error) / std::log(tolerance_) : 0;
    }
    best_ = done > best_ ? done : best_;
    auto const filled = static_cast<int>(best_ * width);
    std::string bar(static_cast<std::size_t>(filled), '#');
    bar.resize(width, '.');
    std::fprintf(options_.stream, "\r%s [%s] step %6td  relative residual %.1e ", title_.c_str(),
                 bar.c_str(), step, error);
    std::fflush(options_.stream);
    drawn_ = true;
  }

  std::string title_;
  double tolerance_;
  options options_;
  double best_ = 0;
  bool drawn_ = false;
};

}  // namespace slant
