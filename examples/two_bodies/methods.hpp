// SPDX-License-Identifier: MIT
//
// The methods in the tables of two bodies, with step lengths β/σ_max as in the lecture.
#pragma once

#include <slant/methods/kprgp.hpp>
#include <support/named_method.hpp>
#include <tuple>
#include <utility>

namespace two_bodies {

/// KPRGP with intervals is the lecture's AS.
[[nodiscard]] inline auto kprgp(char const* name, double β) {
  return examples::named_method{name, [β](auto qp, double σ) {
                                  return slant::kprgp{std::move(qp), {.step_length = β / σ}};
                                }};
}

/// Columns beside [K Table 5].
[[nodiscard]] inline auto plane_methods() {
  return std::tuple{kprgp("KPRGP 1.9", 1.9), kprgp("KPRGP 15", 15)};
}

/// Columns beside [K Table 6].
[[nodiscard]] inline auto space_methods() {
  return std::tuple{kprgp("KPRGP 1.9", 1.9)};
}

}  // namespace two_bodies
