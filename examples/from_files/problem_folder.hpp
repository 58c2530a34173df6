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
#pragma once

#include <Eigen/SparseCore>
#include <cmath>
#include <filesystem>
#include <limits>
#include <slant/io/matrix_market.hpp>
#include <slant/io/text_vector.hpp>
#include <string>
#include <string_view>

namespace from_files {

using sparse_matrix = Eigen::SparseMatrix<double>;

/// The problem above; sizes agree and every number was checked.
struct contact_data {
  sparse_matrix K;            ///< n_u × n_u, both triangles, exactly symmetric
  sparse_matrix N;            ///< m × n_u, m >= 1
  sparse_matrix T;            ///< tangent_dimension·m × n_u
  Eigen::VectorXd f;          ///< n_u, finite
  Eigen::VectorXd d;          ///< m, > −∞
  Eigen::VectorXd g;          ///< m, >= 0; empty without friction
  bool has_friction = false;  ///< T.mtx and g.txt are there
  int tangent_dimension = 0;  ///< 1 (plane) or 2 (space); 0 without friction
};

/// What is taken for rounding: |K_ij − K_ji| <= this · √(K_ii K_jj). The right-hand side bounds the
/// entries of a positive definite matrix in whatever units, so the test has no scale. Element
/// matrices summed in another order stay far below it.
inline constexpr double asymmetry_from_rounding = 1024 * std::numeric_limits<double>::epsilon();

namespace detail {

using slant::bad_input;
using slant::index;
using slant::detail::show;

/// The name of a file of the folder as it stands in messages.
inline std::string named(std::filesystem::path const& file) {
  return slant::detail::printable(file);
}

inline bool is_there(std::filesystem::path const& file) {
  std::error_code error;
  // Not exists(), which would take a dangling link for an absent file.
  return std::filesystem::symlink_status(file, error).type() !=
         std::filesystem::file_type::not_found;
}

/// An entry of K for a message; rows and columns are counted from 1, as in the file.
inline std::string entry(index i, index j, double value) {
  return "K(" + show(i + 1) + "," + show(j + 1) + ") = " + show(value);
}

/// Throws bad_input unless the matrix is square with a positive diagonal and symmetric up to
/// rounding, naming the worst entry; returns it exactly symmetric (the mean of both triangles).
inline sparse_matrix expect_symmetric(std::string const& file, sparse_matrix const& K) {
  if (K.rows() != K.cols() || K.rows() == 0)
    throw bad_input(file, show(K.rows()) + " x " + show(K.cols()),
                    "a square matrix, at least 1 x 1");
  Eigen::VectorXd const diagonal = K.diagonal();
  for (index i = 0; i < diagonal.size(); ++i)
    if (!(diagonal[i] > 0))
      throw bad_input(file, entry(i, i, diagonal[i]),
                      "a positive diagonal, since K is positive definite");

  Eigen::VectorXd const root = diagonal.cwiseSqrt();
  sparse_matrix const mirrored = K.transpose();
  sparse_matrix const difference = K - mirrored;
  double worst = 0;
  index row = 0, col = 0;
  for (index j = 0; j < difference.outerSize(); ++j)
    for (sparse_matrix::InnerIterator e(difference, j); e; ++e)
      if (double const size = std::abs(e.value()) / root[e.row()] / root[j]; size > worst) {
        worst = size;
        row = e.row();
        col = j;
      }
  if (worst > asymmetry_from_rounding)
    throw bad_input(
        file, entry(row, col, K.coeff(row, col)) + " and " + entry(col, row, K.coeff(col, row)),
        "a symmetric matrix up to rounding (this is the worst entry)");
  if (worst == 0) return K;
  return 0.5 * K + 0.5 * mirrored;
}

inline sparse_matrix read_constraint(std::filesystem::path const& file, index unknowns) {
  sparse_matrix A = slant::read_matrix_market(file);
  if (A.cols() != unknowns)
    throw bad_input(named(file), show(A.cols()) + " columns",
                    show(unknowns) + ", the number of unknowns (rows of K.mtx)");
  return A;
}

/// A vector whose entries must be at least `least`, or above it if `least` is −∞.
inline Eigen::VectorXd read_bound(std::filesystem::path const& file, index nodes, double least,
                                  std::string_view expectation) {
  Eigen::VectorXd x = slant::read_text_vector(file, {.size = nodes, .allow_infinity = true});
  for (index i = 0; i < x.size(); ++i)
    if (!(x[i] >= least) || x[i] == -std::numeric_limits<double>::infinity())
      throw bad_input(named(file), show(x[i]) + " as number " + show(i + 1), expectation);
  return x;
}

}  // namespace detail

/// Reads and checks the problem in a folder. Throws slant::bad_input naming the file (and line,
/// where one is at fault), the value and what was expected.
[[nodiscard]] inline contact_data read_problem_folder(std::filesystem::path const& folder) {
  using namespace detail;
  std::error_code error;
  if (!std::filesystem::is_directory(folder, error))
    throw bad_input(named(folder), is_there(folder) ? "not a folder" : "no such folder",
                    "a folder with K.mtx, N.mtx, f.txt, d.txt and, for friction, T.mtx, g.txt");
  contact_data data;
  data.K = expect_symmetric(named(folder / "K.mtx"), slant::read_matrix_market(folder / "K.mtx"));
  index const unknowns = data.K.rows();
  data.N = read_constraint(folder / "N.mtx", unknowns);
  index const nodes = data.N.rows();
  if (nodes < 1)
    throw bad_input(named(folder / "N.mtx"), "0 rows", "at least one row: a contact node");
  data.f = slant::read_text_vector(folder / "f.txt", {.size = unknowns});
  data.d = read_bound(folder / "d.txt", nodes, -std::numeric_limits<double>::infinity(),
                      "gaps above -inf");

  bool const has_T = is_there(folder / "T.mtx");
  bool const has_g = is_there(folder / "g.txt");
  if (has_T && !has_g)
    throw bad_input(named(folder / "g.txt"), "no such file", "slip bounds, since T.mtx is there");
  if (has_g && !has_T)
    throw bad_input(named(folder / "T.mtx"), "no such file",
                    "tangential displacements, since g.txt is there");
  data.has_friction = has_T;
  if (!has_T) {
    data.T.resize(0, unknowns);
    return data;
  }
  data.T = read_constraint(folder / "T.mtx", unknowns);
  if (data.T.rows() != nodes && data.T.rows() != 2 * nodes)
    throw bad_input(named(folder / "T.mtx"), show(data.T.rows()) + " rows",
                    show(nodes) + " (plane) or " + show(2 * nodes) + " (space), since N.mtx has " +
                        show(nodes));
  data.tangent_dimension = data.T.rows() == nodes ? 1 : 2;
  data.g = read_bound(folder / "g.txt", nodes, 0, "slip bounds >= 0");
  return data;
}

}  // namespace from_files
