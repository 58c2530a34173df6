// SPDX-License-Identifier: MIT
//
// Where the meshes of the program stokes are, and how they are made.
#pragma once

#include <fem/gmsh_mesh.hpp>
#include <filesystem>
#include <slant/concepts/bad_input.hpp>
#include <string>

#ifndef SLANT_EXAMPLE_MESHES
#define SLANT_EXAMPLE_MESHES "examples/stokes/meshes"
#endif

namespace stokes {

/// The finest mesh of the printed table; the first two are shipped.
inline constexpr int finest_refinement = 4;

[[nodiscard]] inline std::filesystem::path mesh_file(std::filesystem::path const& folder,
                                                     int refinement) {
  return folder / ("channel_" + std::to_string(refinement) + ".msh");
}

/// Reads a mesh. Throws slant::bad_input that names the command which makes it, if there is none.
[[nodiscard]] inline fem::planar_domain read_mesh(std::filesystem::path const& folder,
                                                  int refinement) {
  auto const file = mesh_file(folder, refinement);
  std::error_code error;
  if (!std::filesystem::exists(file, error))
    throw slant::bad_input(
        "--refinement",
        std::to_string(refinement) + " without the file " + slant::detail::printable(file),
        "a mesh; examples/stokes/make_mesh " + std::to_string(refinement) +
            " makes it (needs Gmsh, Debian package gmsh)");
  return fem::read_gmsh(file);
}

}  // namespace stokes
