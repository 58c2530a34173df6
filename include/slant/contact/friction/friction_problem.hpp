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
#include <slant/concepts/scalar.hpp>

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include <limits>

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

// --- asymmetry -----------------------------------------------------------------------------------
//
// How far the W of a friction problem is from symmetric. The Delassus operator W = H M⁻¹Hᵀ is
// symmetric; what simulations write down differs by rounding, or by much more where M was applied
// by an iteration. The law of friction does not need symmetry: what to do about it is an option.

/// What is done with a W that is not symmetric beyond rounding.
enum class asymmetric_data : unsigned char {
  used_as_given,
  refused  ///< bad_input with the asymmetry in the message
};

/// max |W_ij − W_ji| / max |W_ij|, between 0 and 2; 0 for a W without entries, NaN for one with
/// entries that are not finite. W is square.
template <class S>
[[nodiscard]] S asymmetry(Eigen::SparseMatrix<S> const& W) {
  slant::detail::check_size("columns of W", index(W.cols()), index(W.rows()), "as many as rows,");
  auto const largest = [](Eigen::SparseMatrix<S> const& A) {
    S most = S(0);
    for (index j = 0; j < A.outerSize(); ++j) {
      for (typename Eigen::SparseMatrix<S>::InnerIterator e(A, j); e; ++e) {
        S const size = e.value() < S(0) ? S(-e.value()) : S(e.value());
        if (size > most || size != size) most = size;
        if (most != most) return most;
      }
    }
    return most;
  };
  S const scale = largest(W);
  if (scale == S(0)) return scale;
  Eigen::SparseMatrix<S> const scaled = W / scale;  // differences of huge entries may overflow
  Eigen::SparseMatrix<S> const mirrored = scaled.transpose();
  return largest(scaled - mirrored);
}

/// The asymmetry that rounding explains: each entry a sum of as many terms as W has rows.
template <class S>
[[nodiscard]] S asymmetry_of_rounding(Eigen::SparseMatrix<S> const& W) {
  return std::numeric_limits<S>::epsilon() * S(index(8 + W.rows()));
}

/// Throws bad_input "name: got a matrix of asymmetry 0.002, expected …" beyond rounding.
template <class S>
void require_symmetric(std::string_view name, Eigen::SparseMatrix<S> const& W) {
  S const found = asymmetry(W), allowed = asymmetry_of_rounding(W);
  if (found <= allowed) return;
  throw bad_input(name, "a matrix of asymmetry " + slant::detail::show(found),
                  "a symmetric one, max |W - W^T| <= " + slant::detail::show(allowed) + " max |W|");
}

}  // namespace slant::contact
