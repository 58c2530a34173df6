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

}  // namespace slant::detail
