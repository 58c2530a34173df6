// SPDX-License-Identifier: MIT
//
// What blocks ask of the factors by which they are stretched.
#pragma once

#include <slant/concepts/bad_input.hpp>
#include <slant/concepts/scalar.hpp>

#include <Eigen/Core>

#include <string>

namespace slant::detail {

/// Throws bad_input unless the factors of the components from `first` on are all the same: a disc
/// stays a disc.
template <class S, int N>
void require_round_stretch(Eigen::Matrix<S, N, 1> const& s, int first) {
  for (int i = first + 1; i < N; ++i) {
    if (s(i) != s(first)) {
      throw bad_input("factor " + std::to_string(i), show(s(i)),
                      show(s(first)) + " as that of component " + std::to_string(first));
    }
  }
}

/// value · (a/b), which must not vanish or overflow: the metric would be another one.
template <class S>
[[nodiscard]] S stretched_parameter(S const& value, S const& a, S const& b) {
  S const result = value * (a / b);
  if (!is_finite(result) || (result == S(0) && value != S(0))) {
    throw bad_input("d", "a ratio of roots " + show(S(a / b)),
                    "one by which " + show(value) + " can be multiplied");
  }
  return result;
}

}  // namespace slant::detail
