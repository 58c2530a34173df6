// SPDX-License-Identifier: MIT
//
// The methods in the tables of the wire.
#pragma once

#include <slant/methods/kprgp.hpp>
#include <support/named_method.hpp>
#include <tuple>
#include <utility>

namespace wire_tables {

/// Every method makes two columns: from zero, and by nested iteration.
[[nodiscard]] inline auto methods() {
  using examples::named_method;
  return std::tuple{named_method{"KPRGP", [](auto qp, double σ) {
                                   return slant::kprgp{std::move(qp), {.step_length = 1.9 / σ}};
                                 }}};
}

}  // namespace wire_tables
