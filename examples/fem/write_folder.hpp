// SPDX-License-Identifier: MIT
//
// Writes a scene as the folder that the solver of matrices from files reads: K.mtx, N.mtx, T.mtx,
// f.txt, d.txt, g.txt.
#pragma once

#include <fem/contact_scene.hpp>
#include <filesystem>
#include <slant/io/atomic_file.hpp>
#include <slant/io/matrix_market.hpp>
#include <slant/io/text_vector.hpp>

namespace fem {

/// Writes the six files into a folder, which is created if need be; all of them or none. Numbers
/// are written so that reading gives the same bits. Throws slant::bad_input for a folder that
/// cannot be written to, std::filesystem::filesystem_error if it cannot be created,
/// std::system_error if there is no room.
template <int D>
void write_folder(contact_scene<D> const& scene, std::filesystem::path const& folder) {
  std::filesystem::create_directories(folder);
  slant::atomic_files files;
  slant::write_matrix_market(files.add(folder / "K.mtx"), scene.K,
                             slant::matrix_market_symmetry::symmetric);
  slant::write_matrix_market(files.add(folder / "N.mtx"), scene.N);
  slant::write_matrix_market(files.add(folder / "T.mtx"), scene.T);
  slant::write_text_vector(files.add(folder / "f.txt"), scene.f);
  slant::write_text_vector(files.add(folder / "d.txt"), scene.d);
  slant::write_text_vector(files.add(folder / "g.txt"), scene.g);
  files.commit();
}

}  // namespace fem
