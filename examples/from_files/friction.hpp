// SPDX-License-Identifier: MIT
//
// Contacts with Coulomb friction in local coordinates, from the command line: a folder with W.mtx,
// q.txt and mu.txt (slant/io/friction_folder.hpp). Compiled apart from the bodies.
#pragma once

#include <filesystem>

#include "arguments.hpp"

namespace from_files {

/// Is it contacts in local coordinates that the folder holds? Throws slant::bad_input if it holds a
/// body as well.
[[nodiscard]] bool holds_friction_problem(std::filesystem::path const& folder);

/// Prints their methods, the recommended one first.
void list_friction_methods();

/// Reads, solves, checks, reports, writes; returns the exit status.
[[nodiscard]] int solve_friction_folder(arguments const& a);

}  // namespace from_files
