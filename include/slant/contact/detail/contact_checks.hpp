// SPDX-License-Identifier: MIT
//
// The checks of gaps and slip bounds, whether they come with a scene or with a later load step.
#pragma once

#include <slant/concepts/checks.hpp>

#include <Eigen/SparseCore>

#include <limits>
#include <vector>

namespace slant::contact::detail {

/// Throws bad_input unless d has m entries that are numbers or +∞.
template <class V>
void check_gaps(V const& d, index m) {
  slant::detail::check_size("d", d.size(), m, "one gap per row of N,");
  for (index i = 0; i < m; ++i) {
    if (!(d(i) > -std::numeric_limits<scalar_t<V>>::infinity())) {
      throw bad_input("d", slant::detail::show(d(i)), "a number or +inf").at(i);
    }
  }
}

/// A row of zeros says 0 ≤ dᵢ, whatever u is. N may have more rows than d has entries. Throws
/// bad_input for a gap that no displacement opens.
template <class S, class V>
void check_reach(Eigen::SparseMatrix<S> const& N, V const& d) {
  std::vector<bool> is_zero(static_cast<std::size_t>(N.rows()), true);
  for (index j = 0; j < N.outerSize(); ++j) {
    for (typename Eigen::SparseMatrix<S>::InnerIterator e(N, j); e; ++e) {
      if (e.value() != S(0)) is_zero[static_cast<std::size_t>(e.row())] = false;
    }
  }
  for (index i = 0; i < d.size(); ++i) {
    if (is_zero[static_cast<std::size_t>(i)] && d(i) < S(0)) {
      throw bad_input("d", slant::detail::show(d(i)),
                      "a number >= 0, since row " + slant::detail::show(i) +
                          " of N is zero: no displacement opens this gap")
          .at(i);
    }
  }
}

/// Throws bad_input unless g has m entries ≥ 0 or +∞; without tangents it is empty.
template <class V>
void check_slip_bounds(V const& g, index m, bool tangents) {
  if (!tangents) {
    slant::detail::check_size("g", g.size(), 0, "no slip bounds without T,");
    return;
  }
  slant::detail::check_size("g", g.size(), m, "one slip bound per row of N,");
  for (index i = 0; i < m; ++i) {
    if (!(g(i) >= scalar_t<V>(0))) {
      throw bad_input("g", slant::detail::show(g(i)), "a number >= 0 or +inf").at(i);
    }
  }
}

}  // namespace slant::contact::detail
