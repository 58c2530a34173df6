// SPDX-License-Identifier: MIT
//
// A problem as files for other libraries (peers/):
//
//     min ½ xᵀA x − bᵀx,   lower ≤ x ≤ upper,   ‖(x_j, x_{j+1})‖ ≤ r  for (j, r) in discs
//
//   problem.txt    lines "name value": scene, size, unknowns, n, operator (dense, sparse, none),
//                  energy_norm of the reference, linear_solve_seconds, formation_seconds (of A and
//                  b), recovery_seconds (from x to displacements)
//   A.f64 or A.mtx   n × n, raw doubles or Matrix Market; b.txt, lower.txt, upper.txt,
//   disc_first.txt, disc_radius.txt, reference_x.txt
//
// and for contact scenes also the primal problem as `./run solve` reads it, with reference_u.txt.
#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <limits>
#include <optional>
#include <slant/io/matrix_market.hpp>
#include <slant/io/text_vector.hpp>
#include <stdexcept>

#include "precision_table.hpp"

namespace benchmarks {

/// Bounds and discs on n unknowns; first nothing is bounded.
struct separable_set {
  Eigen::VectorXd lower, upper;
  Eigen::VectorXd disc_first{}, disc_radius{};

  explicit separable_set(Eigen::Index n)
      : lower(Eigen::VectorXd::Constant(n, -std::numeric_limits<double>::infinity())),
        upper(-lower) {}
  /// Discs of these radii on the pairs that begin with unknown `first`.
  void add_discs(Eigen::Index first, Eigen::VectorXd const& radius) {
    disc_radius = radius;
    disc_first.resize(radius.size());
    for (Eigen::Index i = 0; i < radius.size(); ++i) disc_first[i] = double(first + 2 * i);
  }
};

/// All but the matrix.
struct peer_problem {
  row_labels labels{};
  Eigen::VectorXd b{};
  separable_set set{0};
  Eigen::VectorXd reference{};
  double energy_norm = 0;  ///< what errors are relative to
  double formation_seconds = 0;
  double recovery_seconds = 0;
};

/// Writes the folder; without a matrix peers are told that there is none. Throws slant::bad_input
/// or std::runtime_error for a folder that cannot be written.
inline void write_peer_folder(std::filesystem::path const& folder, peer_problem const& p,
                              std::optional<Eigen::MatrixXd> const& dense,
                              std::optional<Eigen::SparseMatrix<double>> const& sparse) {
  std::filesystem::create_directories(folder);
  std::ofstream text(folder / "problem.txt");
  text.precision(17);
  text << "scene " << p.labels.scene << "\nsize " << p.labels.size << "\nunknowns "
       << p.labels.unknowns << "\nn " << p.b.size() << "\noperator "
       << (dense ? "dense" : (sparse ? "sparse" : "none")) << "\nenergy_norm " << p.energy_norm
       << "\nlinear_solve_seconds " << p.labels.linear_solve_seconds << "\nformation_seconds "
       << p.formation_seconds << "\nrecovery_seconds " << p.recovery_seconds << '\n';
  if (!text.flush()) throw std::runtime_error("cannot write " + folder.string());

  auto const write = [&](char const* name, Eigen::VectorXd const& x) {
    slant::write_text_vector(folder / name, x, {.allow_infinity = true});
  };
  write("b.txt", p.b);
  write("lower.txt", p.set.lower);
  write("upper.txt", p.set.upper);
  write("disc_first.txt", p.set.disc_first);
  write("disc_radius.txt", p.set.disc_radius);
  write("reference_x.txt", p.reference);
  if (sparse)
    slant::write_matrix_market(folder / "A.mtx", *sparse, slant::matrix_market_symmetry::symmetric);
  if (dense) {
    std::ofstream raw(folder / "A.f64", std::ios::binary);
    raw.write(
        reinterpret_cast<char const*>(dense->data()),
        static_cast<std::streamsize>(dense->size()) * static_cast<std::streamsize>(sizeof(double)));
    if (!raw.flush()) throw std::runtime_error("cannot write " + (folder / "A.f64").string());
  }
}

}  // namespace benchmarks
