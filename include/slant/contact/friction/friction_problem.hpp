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
#include <slant/contact/contact_data.hpp>

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include <limits>

namespace slant::contact {

/// The problem at the top of this file. Units: u and q velocities (or gaps and displacements), r
/// forces (or impulses), W their ratio.
template <scalar S = double>
struct friction_problem {
  using scalar = S;
  using vector_type = Eigen::VectorX<S>;

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
    detail::check_coefficients("mu", mu);
    slant::detail::require_finite_entries("W", W);
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
    slant::detail::for_each_entry(A, [&](index, index, S const& value) {
      S const size = value < S(0) ? S(-value) : value;
      if (most == most && (size > most || size != size)) most = size;
    });
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
  throw bad_input(
      name, "a matrix of asymmetry " + slant::detail::show(found),
      "a symmetric one, max |W - W^T| <= " + slant::detail::brief(allowed) + " max |W|");
}

namespace detail {

/// w of each contact: the largest |entry| of W_ii; where that is 0 the largest of its columns, or
/// what the most compliant contact has, or 1. Such a contact cannot be moved by its own force.
template <class S>
[[nodiscard]] Eigen::VectorX<S> compliances(Eigen::SparseMatrix<S> const& W, index contacts) {
  index const d = contacts > 0 ? W.rows() / contacts : 1;
  Eigen::VectorX<S> w = Eigen::VectorX<S>::Zero(contacts), column = w;
  slant::detail::for_each_entry(W, [&](index i, index j, S const& value) {
    S const size = value < S(0) ? S(-value) : value;
    S& most = i / d == j / d ? w[j / d] : column[j / d];
    if (size > most) most = size;
  });
  S largest(0);
  for (index i = 0; i < contacts; ++i) {
    if (w[i] == S(0)) w[i] = column[i];
    if (w[i] > largest) largest = w[i];
  }
  for (S& entry : w) {
    if (!(entry > S(0))) entry = largest > S(0) ? largest : S(1);
  }
  return w;
}

}  // namespace detail

}  // namespace slant::contact
