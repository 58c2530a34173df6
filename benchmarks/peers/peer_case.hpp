// SPDX-License-Identifier: MIT
//
// A problem as ../support/peer_folder.hpp has written it, and the error of a solution.
#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <slant/io/matrix_market.hpp>
#include <slant/io/text_vector.hpp>
#include <stdexcept>
#include <string>

#include "../support/peer_folder.hpp"

namespace benchmarks {

/// min ½ xᵀA x − bᵀx over bounds and discs; A is dense or sparse.
struct peer_case {
  std::filesystem::path folder;
  peer_problem problem{};
  bool is_dense = false;
  Eigen::MatrixXd dense{};
  Eigen::SparseMatrix<double> sparse{};

  /// Throws slant::bad_input or std::runtime_error for a folder that is none, or without A.
  explicit peer_case(std::filesystem::path from) : folder(std::move(from)) {
    std::ifstream text(folder / "problem.txt");
    std::map<std::string, std::string> words;
    for (std::string name, value; text >> name >> value;) words[name] = value;
    auto const number = [&](char const* name) { return std::stod(words.at(name)); };
    if (words.empty()) throw std::runtime_error("no problem.txt in " + folder.string());
    problem.labels = {words.at("scene"), words.at("size"), std::stol(words.at("unknowns")),
                      number("linear_solve_seconds")};
    problem.energy_norm = number("energy_norm");
    problem.formation_seconds = number("formation_seconds");
    problem.recovery_seconds = number("recovery_seconds");
    problem.b = vector("b.txt");
    problem.reference = vector("reference_x.txt");
    problem.set.lower = vector("lower.txt");
    problem.set.upper = vector("upper.txt");
    if (std::filesystem::file_size(folder / "disc_first.txt") > 0) {
      problem.set.disc_first = vector("disc_first.txt");
      problem.set.disc_radius = vector("disc_radius.txt");
    }
    is_dense = words.at("operator") == "dense";
    if (is_dense) {
      auto const n = problem.b.size();
      dense.resize(n, n);
      std::ifstream raw(folder / "A.f64", std::ios::binary);
      raw.read(reinterpret_cast<char*>(dense.data()),
               static_cast<std::streamsize>(dense.size()) *
                   static_cast<std::streamsize>(sizeof(double)));
      if (!raw) throw std::runtime_error("A.f64 is too short in " + folder.string());
    } else {
      sparse = slant::read_matrix_market(folder / "A.mtx");
    }
  }

  [[nodiscard]] Eigen::Index size() const { return problem.b.size(); }
  [[nodiscard]] bool has_discs() const { return problem.set.disc_first.size() > 0; }
  [[nodiscard]] char const* formulation() const { return is_dense ? "dense dual" : "separable"; }
  /// A x.
  [[nodiscard]] Eigen::VectorXd times(Eigen::VectorXd const& x) const {
    return is_dense ? Eigen::VectorXd(dense * x) : Eigen::VectorXd(sparse * x);
  }
  /// ‖x − x*‖_A relative to the energy of the reference: for contact that of the displacements,
  /// since u − u* = −K⁻¹Bᵀ(λ − λ*) has in K the norm that λ − λ* has in A.
  [[nodiscard]] double error(Eigen::VectorXd const& x) const {
    Eigen::VectorXd const d = x - problem.reference;
    return std::sqrt(d.dot(times(d))) / problem.energy_norm;
  }
  /// Seconds that every run on A has spent besides: to form A and b, and to get back to u.
  [[nodiscard]] double seconds_elsewhere() const {
    return problem.formation_seconds + problem.recovery_seconds;
  }
  [[nodiscard]] Eigen::VectorXd vector(char const* name) const {
    return slant::read_text_vector(folder / name, {.allow_infinity = true});
  }
};

}  // namespace benchmarks
