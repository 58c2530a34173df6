// SPDX-License-Identifier: MIT
//
// The points and directions at which the laws of a set are sampled: many scales, axes, the boundary
// and its close neighbourhood.
#pragma once

#include <slant/testing/detail/set_probe.hpp>

#include <cstdint>
#include <random>
#include <vector>

namespace slant::testing::detail {

/// Random numbers and directions, the same on every platform.
template <class S>
class set_sampler {
  using dense = typename set_probe<S>::dense;

 public:
  explicit set_sampler(set_probe<S> const& probe) : probe_(probe), engine_(probe.options.seed) {}

  /// Uniform in [−1, 1].
  [[nodiscard]] S number() {
    constexpr std::int32_t half = 1 << 30;
    return S(static_cast<std::int32_t>(engine_() >> 1U) - half) / S(half);
  }
  [[nodiscard]] dense box() {
    dense v(probe_.size);
    for (index i = 0; i < v.size(); ++i) v[i] = number();
    return v;
  }
  [[nodiscard]] index below(index n) { return static_cast<index>(engine_()) % n; }

  /// A direction of length about 1: random, sparse, or ± a coordinate axis.
  [[nodiscard]] dense direction(int kind) {
    dense v = box();
    if (kind % 3 == 1)
      v = (number() < S(0) ? S(-1) : S(1)) * dense::Unit(v.size(), below(v.size()));
    if (kind % 3 == 2) {
      for (index i = 0; i < v.size(); ++i) v[i] = number() < S(0) ? S(0) : v[i];
    }
    return v;
  }

  /// Points to try: see the top of the file.
  [[nodiscard]] std::vector<dense> points() {
    S const scales[] = {S(1), S(10), S(1) / S(10), S(1000), S(1) / S(1000)};
    std::vector<dense> list{dense(dense::Zero(probe_.size))};
    for (int k = 1; k < probe_.options.points; ++k) {
      dense const x = S(probe_.options.size) * scales[k % 5] * direction(k / 5 % 3);
      dense const y = probe_.project(x);
      switch (k % 4) {
        case 0:
          list.push_back(y);
          break;  // on the boundary
        case 1:
          list.push_back(y + (x - y) / S(1 << 12));
          break;  // close to it
        case 2:
          list.push_back(y + (y - x) * S(number()));
          break;  // on both sides
        default:
          list.push_back(x);
          break;
      }
    }
    return list;
  }

 private:
  set_probe<S> const& probe_;
  std::mt19937 engine_;
};

}  // namespace slant::testing::detail
