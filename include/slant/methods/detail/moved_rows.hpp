// SPDX-License-Identifier: MIT
//
// B U = 0, which the Schur complement contact algorithm takes from its projector for granted: an
// application of Q and a minimisation over range(U) must move no row of B. A projector that moves
// one leads out of B u ≤ c unseen, whatever the load is.
#pragma once

#include <slant/concepts/bad_input.hpp>
#include <slant/concepts/vector_algebra.hpp>
#include <slant/methods/constraint_rows.hpp>

#include <cstddef>
#include <limits>
#include <vector>

namespace slant::detail {

/// Does Q show U, body by body, as a conjugate_projector does?
template <class Q>
concept has_columns_of_bodies = requires(Q const& q, index i) {
  { q.bodies() } -> std::convertible_to<index>;
  { q.u(i).innerVector(i) };
};

/// The first row of B that a column of U moves, −1 if there is none: |b_iᵀu| > 32 ε |b_i|ᵀ|u|.
template <class S, class Q>
[[nodiscard]] index row_moved_by_columns(constraint_rows<S> const& rows, Q const& q) {
  using std::abs;
  std::vector<index> cluster_of(static_cast<std::size_t>(rows.unknowns()), -1);
  std::vector<index> place(static_cast<std::size_t>(rows.unknowns()), -1);
  for (std::size_t k = 0; k < rows.clusters().size(); ++k) {
    auto const& unknowns = rows.clusters()[k].unknowns;
    for (std::size_t i = 0; i < unknowns.size(); ++i) {
      cluster_of[static_cast<std::size_t>(unknowns[i])] = static_cast<index>(k);
      place[static_cast<std::size_t>(unknowns[i])] = static_cast<index>(i);
    }
  }
  using vector_type = typename constraint_rows<S>::vector_type;
  vector_type sums = vector_type::Zero(rows.count()), sizes = sums;
  for (index i = 0; i < q.bodies(); ++i) {
    auto const& u = q.u(i);
    using entry = typename std::remove_cvref_t<decltype(u)>::InnerIterator;
    for (index j = 0; j < u.cols(); ++j) {
      bool meets = false;
      auto const for_each_term = [&](auto f) {
        for (entry e(u, j); e; ++e) {
          auto const at = static_cast<std::size_t>(e.row());
          if (cluster_of[at] < 0) continue;
          meets = true;
          auto const& part = rows.clusters()[static_cast<std::size_t>(cluster_of[at])];
          for (std::size_t r = 0; r < part.rows.size(); ++r) {
            f(part.rows[r], part.e(place[at], static_cast<index>(r)) * e.value());
          }
        }
      };
      for_each_term([&](index row, S const& term) {
        sums[row] += term;
        sizes[row] += abs(term);
      });
      if (!meets) continue;
      index moved = -1;
      for_each_term([&](index row, S const&) {
        S const noise = S(32) * std::numeric_limits<S>::epsilon() * sizes[row];
        if (moved < 0 && !(abs(sums[row]) <= noise)) moved = row;
      });
      if (moved >= 0) return moved;
      for_each_term([&](index row, S const&) { sums[row] = sizes[row] = S(0); });
    }
  }
  return -1;
}

/// Throws bad_input unless B U = 0, if Q shows U.
template <class S, class Q>
void check_projector([[maybe_unused]] constraint_rows<S> const& rows, [[maybe_unused]] Q const& q) {
  if constexpr (has_columns_of_bodies<Q>) {
    index const row = row_moved_by_columns(rows, q);
    if (row < 0) return;
    throw bad_input("projector", "one that moves row " + show(row) + " of B",
                    "that of a U with B U = 0");
  }
}

/// Does q = Q p move a row of B, b_iᵀ(q − p) ≠ 0? Asked of projectors that do not show U; what is
/// within 1024 ε of its terms counts as zero. `scratch` has room for q − p, `sizes` for the rows.
template <class S, class Q, class V>
[[nodiscard]] bool moves_rows(constraint_rows<S> const& rows, Q const&, V const& p, V const& q,
                              V& scratch, typename constraint_rows<S>::vector_type& sizes) {
  if constexpr (has_columns_of_bodies<Q>) {
    return false;
  } else {
    bool moved = false;
    rows.for_each_product(p, [&](index i, S const&, S const& size) { sizes[i] = size; });
    vectors::difference(q, p, scratch);
    rows.for_each_product(scratch, [&](index i, S const& value, S const& size) {
      using std::abs;
      S const noise = S(1024) * std::numeric_limits<S>::epsilon() * (size + sizes[i]);
      if (!(abs(value) <= noise)) moved = true;
    });
    return moved;
  }
}

}  // namespace slant::detail
