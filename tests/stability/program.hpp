// SPDX-License-Identifier: MIT
//
// Quadratic programs and contact problems as plain data, each with the adversity that it stands
// for:
//
//     min ½ xᵀA x − bᵀx,   x_i ≥ lower_i,   low_j ≤ x_j ≤ high_j,   ‖(x_k, x_k+1)‖ ≤ radius_k,
//
// the unknowns in this order. In contact, A = B K⁻¹Bᵀ and b = B K⁻¹f − c are left to the method and
// to the reference, each in its own way; lower = 0, no intervals, radius = g.
#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <cstdint>
#include <string>

namespace stability {

struct program {
  std::string adversity{};  ///< such as "slenderness"
  double parameter = 0;     ///< how much of it
  std::string variant{};    ///< load, seed or kind: tells programs of one adversity apart

  // without contact
  Eigen::MatrixXd A{};
  Eigen::VectorXd b{};
  Eigen::VectorXd lower{}, low{}, high{}, radius{};

  // in contact; N is m × n_u, T is 2m × n_u, d are gaps, radius are the slip bounds
  Eigen::SparseMatrix<double> K{}, N{}, T{};
  Eigen::VectorXd f{}, d{};
  Eigen::MatrixXd nodes{};  ///< coordinates, a column each
  Eigen::VectorXi first{};  ///< the first unknown of each node, -1 where it is held

  [[nodiscard]] bool contact() const { return K.rows() > 0; }
  [[nodiscard]] Eigen::Index size() const { return lower.size() + low.size() + 2 * radius.size(); }
  [[nodiscard]] std::string name() const;
  /// The program without contact whose data are the nearest floats.
  [[nodiscard]] program rounded() const;
};

/// Numbers that are the same on every machine: splitmix64.
class dice {
 public:
  explicit dice(std::uint64_t seed) : state_(seed) {}
  [[nodiscard]] double uniform(double from, double to) {
    state_ += 0x9e3779b97f4a7c15U;
    std::uint64_t z = state_;
    z = (z ^ (z >> 30U)) * 0xbf58476d1ce4e5b9U;
    z = (z ^ (z >> 27U)) * 0x94d049bb133111ebU;
    z ^= z >> 31U;
    return from + (to - from) * (static_cast<double>(z >> 11U) * 0x1p-53);
  }

 private:
  std::uint64_t state_;
};

}  // namespace stability
