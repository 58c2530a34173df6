// SPDX-License-Identifier: MIT
//
// Where a membrane touches its obstacles.
//
// A node touches when z = v − ρ r lies strictly beyond the bound, r = A v − b and ρ = 1/A_ii: when
// the reaction, times ρ, exceeds the gap. At the solution one of the two is zero, so this compares
// a rounding error with a quantity of the data; no threshold, no units.
#pragma once

#include <Eigen/Core>
#include <fem/membrane.hpp>

namespace fem {

/// What a node of a membrane does.
enum class membrane_state : int { on_lower = -1, free = 0, on_upper = 1 };

/// State and reaction of all nodes.
template <class S = double>
struct membrane_contact {
  Eigen::VectorXi state;                         ///< membrane_state of each node
  Eigen::Matrix<S, Eigen::Dynamic, 1> reaction;  ///< (A v − b) / (hx hy): of the obstacle, per area

  /// Number of nodes in one state.
  [[nodiscard]] Eigen::Index count(membrane_state s) const {
    return (state.array() == static_cast<int>(s)).count();
  }
};

/// The contact of the shape v. Throws std::invalid_argument if v has not one number per node.
template <class S>
[[nodiscard]] membrane_contact<S> find_contact(membrane<S> const& m,
                                               Eigen::Matrix<S, Eigen::Dynamic, 1> const& v) {
  require(v.size() == m.grid.size(), "v", v.size(), "one number for each interior node");
  Eigen::Matrix<S, Eigen::Dynamic, 1> r(v.size());
  Eigen::Matrix<S, Eigen::Dynamic, 1> d(v.size());
  m.A.apply(v, r);
  m.A.diagonal(d);
  r -= m.b;
  membrane_contact<S> contact{Eigen::VectorXi::Zero(v.size()), r / (m.grid.hx() * m.grid.hy())};
  for (Eigen::Index i = 0; i < v.size(); ++i) {
    S const z = v[i] - r[i] / d[i];
    if (z < m.lower[i]) contact.state[i] = static_cast<int>(membrane_state::on_lower);
    if (z > m.upper[i]) contact.state[i] = static_cast<int>(membrane_state::on_upper);
  }
  return contact;
}

/// ½ vᵀA v − bᵀv.
template <class S>
[[nodiscard]] S membrane_energy(membrane<S> const& m,
                                Eigen::Matrix<S, Eigen::Dynamic, 1> const& v) {
  Eigen::Matrix<S, Eigen::Dynamic, 1> image(v.size());
  m.A.apply(v, image);
  return v.dot(image) / S(2) - m.b.dot(v);
}

}  // namespace fem
