// SPDX-License-Identifier: MIT
//
// Contacts with Coulomb friction in local coordinates, as simulations of many bodies hand them
// over: velocities u and forces r of the contacts, contact by contact [n, t₁(, t₂)],
//
//     u = W r + q,    r ∈ K_μ,    u + μ‖u_t‖ n ∈ K_μ*,    (u + μ‖u_t‖ n)ᵀ r = 0,
//
// K_μ = {‖r_t‖ <= μ r_n}, K_μ* its dual cone (de Saxcé and Feng, 1998). W is the Delassus operator:
// symmetric positive semidefinite up to the rounding of those who wrote it, often of low rank.
#pragma once

#include <slant/concepts/bad_input.hpp>
#include <slant/concepts/checks.hpp>
#include <slant/concepts/scalar.hpp>

#include <Eigen/Core>
#include <Eigen/SparseCore>

namespace slant::contact {

/// The problem at the top of this file. Units: u and q velocities (or gaps and displacements), r
/// forces (or impulses), W their ratio.
template <scalar S = double>
struct friction_problem {
  using scalar = S;
  using vector_type = Eigen::Matrix<S, Eigen::Dynamic, 1>;

  Eigen::SparseMatrix<S> W{};  ///< n × n, n = contacts · dimension
  vector_type q{};             ///< n: velocities without contact forces
  vector_type mu{};            ///< friction coefficient of each contact, >= 0

  [[nodiscard]] index contacts() const { return mu.size(); }
  /// 2 or 3: components of each contact; 3 where there is no contact.
  [[nodiscard]] index dimension() const { return mu.size() > 0 ? q.size() / mu.size() : 3; }

  /// Throws bad_input naming the member, its value and what was expected.
  [[gnu::cold]] void validate() const {
    if (mu.size() == 0 ? q.size() != 0 : q.size() != 2 * mu.size() && q.size() != 3 * mu.size()) {
      throw bad_input(
          "size of q", slant::detail::show(index(q.size())),
          "2 or 3 times the number of coefficients mu, " + slant::detail::show(index(mu.size())));
    }
    slant::detail::check_size("rows of W", index(W.rows()), index(q.size()), "as q,");
    slant::detail::check_size("columns of W", index(W.cols()), index(q.size()), "as q,");
    slant::detail::check_finite("q", q);
    for (index i = 0; i < mu.size(); ++i) {
      if (!(mu[i] >= S(0) && slant::detail::is_finite(mu[i]))) {
        throw bad_input("mu[" + slant::detail::show(i) + "]", slant::detail::show(mu[i]),
                        "a finite number >= 0");
      }
    }
    for (index j = 0; j < W.outerSize(); ++j) {
      for (typename Eigen::SparseMatrix<S>::InnerIterator e(W, j); e; ++e) {
        if (!slant::detail::is_finite(e.value())) {
          throw bad_input(
              "W(" + slant::detail::show(index(e.row())) + ", " + slant::detail::show(j) + ")",
              slant::detail::show(e.value()), "a finite number");
        }
      }
    }
  }
};

}  // namespace slant::contact
