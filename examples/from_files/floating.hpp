// SPDX-License-Identifier: MIT
//
// Bodies that supports do not hold: K is singular by their free motions.
#pragma once

#include <nlohmann/json.hpp>
#include <slant/concepts/bad_input.hpp>
#include <slant/contact/free_motions.hpp>

#include "problem_folder.hpp"

namespace from_files {

/// The free motions that made a factorisation refuse K; none if that has another reason.
[[nodiscard]] slant::contact::free_motions<double> motions_behind(
    slant::bad_input const& refusal, problem const& p,
    slant::contact::node_layout<double> const& layout);

/// What the report says of free motions.
[[nodiscard]] nlohmann::ordered_json report_motions(
    slant::contact::free_motions<double> const& motions);

}  // namespace from_files
