// SPDX-License-Identifier: MIT
//
// The methods for contacts in local coordinates that can be asked for by name.
#pragma once

#include <algorithm>
#include <array>
#include <limits>
#include <optional>
#include <slant/contact/solve_friction.hpp>
#include <string_view>

#include "method_list.hpp"

namespace from_files {

struct friction_settings {
  double tolerance = 1e-8;  ///< of the natural map over ‖q‖
  std::optional<slant::index> max_iterations{};
};

/// A way to solve such a problem; `automatic` is the default of the library.
struct friction_method {
  std::string_view name;
  std::string_view sentence;
  slant::contact::friction_method kind;

  [[nodiscard]] slant::contact::friction_result<double> run(
      slant::contact::friction_problem<> const& p, friction_settings const& s) const {
    slant::contact::friction_options<> o;
    o.method = kind;
    // 0: as far as rounding lets it get.
    o.tolerance = s.tolerance > 0 ? s.tolerance : std::numeric_limits<double>::min();
    if (s.max_iterations) {
      o.first_sweeps = std::min(o.first_sweeps, *s.max_iterations);
      o.sweeps = o.newton_steps = *s.max_iterations;
    }
    return slant::contact::solve_friction(p, o);
  }
};

inline constexpr std::array friction_methods{
    friction_method{"coulomb", "The three below in turn, until one of them has solved the problem.",
                    slant::contact::friction_method::automatic},
    friction_method{"gauss_seidel", "One contact after the other exactly, with extrapolation.",
                    slant::contact::friction_method::gauss_seidel},
    friction_method{"newton", "Semismooth Newton for the natural map, after a few sweeps.",
                    slant::contact::friction_method::newton},
    friction_method{"interior_point", "Primal-dual, from inside of the cones.",
                    slant::contact::friction_method::interior_point},
};

}  // namespace from_files
