// SPDX-License-Identifier: MIT
//
// How far the W of a friction problem is from symmetric. The Delassus operator W = H M⁻¹Hᵀ is
// symmetric; what simulations write down differs by rounding, or by much more where M was applied
// by an iteration. The law of friction does not need symmetry: what to do about it is an option.
#pragma once

#include <slant/concepts/checks.hpp>

#include <Eigen/SparseCore>
#include <limits>

namespace slant::contact {

/// What is done with a W that is not symmetric beyond rounding.
enum class asymmetric_data : unsigned char {
  used_as_given,
  refused  ///< bad_input with the asymmetry in the message
};

/// max |W_ij − W_ji| / max |W_ij|, between 0 and 2; 0 for a W without entries. W is square.
template <class S>
[[nodiscard]] S asymmetry(Eigen::SparseMatrix<S> const& W) {
  slant::detail::check_size("columns of W", index(W.cols()), index(W.rows()), "as many as rows,");
  auto const largest = [](Eigen::SparseMatrix<S> const& A) {
    S most = S(0);
    for (index j = 0; j < A.outerSize(); ++j) {
      for (typename Eigen::SparseMatrix<S>::InnerIterator e(A, j); e; ++e) {
        S const size = e.value() < S(0) ? S(-e.value()) : S(e.value());
        if (size > most) most = size;
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
