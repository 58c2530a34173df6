// SPDX-License-Identifier: MIT
//
// The methods for bodies with Coulomb friction that can be asked for by name.
#pragma once

#include <array>
#include <optional>
#include <slant/concepts/scalar.hpp>
#include <slant/contact/node_layout.hpp>
#include <string_view>

#include "method_list.hpp"

namespace from_files {

struct coulomb_settings {
  double tolerance = 1e-8;  ///< relative, of the norm that the method judges itself by
  std::optional<slant::index> max_iterations{};  ///< >= 1, of each of the methods that have a turn
  slant::contact::node_layout<double> layout{};  ///< where the unknowns are; may be unknown
};

/// `automatic` is the default of the library, `newton` and `radii` are its first two parts.
enum class coulomb_kind { automatic, newton, radii, cones };

struct coulomb_method {
  std::string_view name;
  std::string_view sentence;
  coulomb_kind kind;
};

inline constexpr std::array coulomb_methods{
    coulomb_method{"coulomb", "newton, radii where that fails, then solve_friction.",
                   coulomb_kind::automatic},
    coulomb_method{"newton", "Semismooth Newton for the equations of Alart and Curnier, GMRES.",
                   coulomb_kind::newton},
    coulomb_method{"radii", "Fixed points: Tresca's problems with the slip bounds F lambda_n.",
                   coulomb_kind::radii},
    coulomb_method{"cones", "Fixed points: convex problems over cones with the shifts F |u_t|.",
                   coulomb_kind::cones},
};

}  // namespace from_files
