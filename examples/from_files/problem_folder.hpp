// SPDX-License-Identifier: MIT
//
// A contact problem with Tresca friction from a folder of text files [K (14)–(21)]:
//
//   min ½ uᵀK u − fᵀu + Σ gᵢ ‖(T u)ᵢ‖   subject to   N u ≤ d
//
//   K.mtx  n_u × n_u   symmetric positive definite, stored as general or symmetric
//   N.mtx  m × n_u     normal displacement of the m contact nodes
//   T.mtx  m × n_u or 2m × n_u, rows 2i, 2i+1 of node i; absent: no friction
//   f.txt  n_u         load
//   d.txt  m           gap; inf: the node never meets the obstacle
//   g.txt  m           slip bound (a force) >= 0; inf: the node sticks; present exactly with T.mtx
//
// or with Coulomb friction, ‖λ_t,i‖ <= Fᵢ λ_ν,i: without g.txt, or whatever it holds, and with
//
//   F.txt  m           friction coefficient >= 0; a file anywhere
#pragma once

#include <Eigen/SparseCore>
#include <filesystem>
#include <slant/concepts/bad_input.hpp>
#include <slant/contact/contact_data.hpp>
#include <slant/io/matrix_market.hpp>
#include <slant/io/text_vector.hpp>
#include <string>
#include <system_error>

namespace from_files {

/// The problem above, numbers as they stand in the files. Sizes agree and the contact data are
/// valid; that K is symmetric and definite is for its factorisation to find out.
struct problem {
  Eigen::SparseMatrix<double> K;         ///< n_u × n_u, both triangles
  slant::contact::data<double> contact;  ///< N, T, f, d, g
};

struct coulomb_problem {
  problem body;       ///< with slip bounds 0
  Eigen::VectorXd F;  ///< m friction coefficients
};

namespace detail {

inline bool is_there(std::filesystem::path const& file) {
  std::error_code error;
  // Not exists(), which would take a dangling link for an absent file.
  return std::filesystem::symlink_status(file, error).type() !=
         std::filesystem::file_type::not_found;
}

/// The folder as it stands in messages.
inline void require_folder(std::filesystem::path const& folder) {
  std::error_code error;
  if (std::filesystem::is_directory(folder, error)) return;
  throw slant::bad_input(
      slant::detail::printable(folder), is_there(folder) ? "not a folder" : "no such folder",
      "a folder with K.mtx, N.mtx, f.txt, d.txt and, for friction, T.mtx, g.txt, or with W.mtx, "
      "q.txt, mu.txt");
}

/// All but g; T only if there is friction, else without rows.
[[nodiscard]] inline problem read_body(std::filesystem::path const& folder, bool friction) {
  require_folder(folder);
  problem p;
  p.K = slant::read_matrix_market(folder / "K.mtx");
  // Now and not by the factorisation, because the other sizes are judged by this one.
  slant::detail::check_size("columns of K", p.K.cols(), p.K.rows(), "as many as rows,");
  auto& c = p.contact;
  c.N = slant::read_matrix_market(folder / "N.mtx");
  if (c.N.rows() == 0) c.validate();  // refuses N, before the others are measured by it
  c.f = slant::read_text_vector(folder / "f.txt", {.size = p.K.rows()});
  c.d = slant::read_text_vector(folder / "d.txt", {.size = c.N.rows(), .allow_infinity = true});
  c.T.resize(0, p.K.cols());
  if (!friction) return p;
  c.T = slant::read_matrix_market(folder / "T.mtx");
  // contact::data takes no rows for no friction; a file without rows is a mistake.
  if (c.T.rows() == 0) throw slant::bad_input("rows of T", "0", "as many as N has, or twice that");
  return p;
}

/// Friction needs both T.mtx and g.txt.
inline bool has_friction(std::filesystem::path const& folder) {
  bool const has_T = is_there(folder / "T.mtx");
  bool const has_g = is_there(folder / "g.txt");
  if (has_T && !has_g)
    throw slant::bad_input(slant::detail::printable(folder / "g.txt"), "no such file",
                           "slip bounds, since T.mtx is there");
  if (has_g && !has_T)
    throw slant::bad_input(slant::detail::printable(folder / "T.mtx"), "no such file",
                           "tangential displacements, since g.txt is there");
  return has_T;
}

}  // namespace detail

/// Reads and checks the problem in a folder. Throws slant::bad_input: for a file that cannot be
/// read it names file, line, value and expectation; for numbers that make no contact problem the
/// letter of the file and the place in it, counted from 0.
[[nodiscard]] inline problem read_problem_folder(std::filesystem::path const& folder) {
  detail::require_folder(folder);
  bool const friction = detail::has_friction(folder);
  problem p = detail::read_body(folder, friction);
  auto& c = p.contact;
  if (friction)
    c.g = slant::read_text_vector(folder / "g.txt", {.size = c.N.rows(), .allow_infinity = true});
  c.validate();
  return p;
}

/// The problem with Coulomb friction: g is 0, the coefficients are apart. Throws as above.
[[nodiscard]] inline coulomb_problem read_coulomb_folder(std::filesystem::path const& folder,
                                                         std::filesystem::path const& F) {
  coulomb_problem p{.body = detail::read_body(folder, true), .F = {}};
  auto& c = p.body.contact;
  p.F = slant::read_text_vector(F, {.size = c.N.rows()});
  for (slant::index i = 0; i < p.F.size(); ++i) {
    if (p.F[i] < 0)
      throw slant::bad_input(slant::detail::printable(F),
                             slant::detail::show(p.F[i]) + " at node " + slant::detail::show(i),
                             "numbers >= 0");
  }
  c.g.setZero(c.N.rows());
  c.validate();
  return p;
}

}  // namespace from_files
