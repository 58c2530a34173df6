// SPDX-License-Identifier: MIT
//
// Coordinates v = H u in which N u ≤ d are bounds of single components. A row with one entry is one
// already. For a row n with more of them H is the Householder reflection of its support that maps
// n/‖n‖ to −sign(n_p) e_p, |n_p| its largest entry [Golub, Van Loan, 5.1.3]: so long as no other
// row has an unknown of that support, n·u ≤ d is a bound of v_p. H is orthogonal and symmetric.
#pragma once

#include <slant/concepts/checks.hpp>

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace slant::contact::detail {

/// One component v_p of a row: sign · size · v_p ≤ d, size > 0.
template <class S>
struct bounded_component {
  index component = -1;  ///< p; −1 for an empty row
  bool above = true;     ///< whether it bounds v_p from above
  S size{1};             ///< ‖n‖
};

/// Why rows of N cannot be made bounds, or nothing: a row with several entries that shares an
/// unknown with another row.
template <class S>
[[nodiscard]] std::optional<std::string> shared_unknown(Eigen::SparseMatrix<S> const& N) {
  std::vector<index> entries(static_cast<std::size_t>(N.rows()), 0);
  auto const visit = [&N](index j, auto f) {
    for (typename Eigen::SparseMatrix<S>::InnerIterator e(N, j); e; ++e) {
      if (e.value() != S(0)) f(static_cast<index>(e.row()));
    }
  };
  for (index j = 0; j < N.cols(); ++j) {
    visit(j, [&](index i) { ++entries[static_cast<std::size_t>(i)]; });
  }
  for (index j = 0; j < N.cols(); ++j) {
    index first = -1;
    std::optional<std::string> found;
    visit(j, [&](index i) {
      bool const several = entries[static_cast<std::size_t>(i)] > 1;
      if (first >= 0 && (several || entries[static_cast<std::size_t>(first)] > 1)) {
        found = "rows " + slant::detail::show(first) + " and " + slant::detail::show(i) +
                " of N share unknown " + slant::detail::show(j);
      }
      first = i;
    });
    if (found) return found;
  }
  return std::nullopt;
}

/// H, if it is not the identity, and the component that each row bounds.
template <class S>
struct bounded_coordinates {
  std::vector<bounded_component<S>> rows;
  Eigen::SparseMatrix<S> H;  ///< n × n, empty if no row has more than one entry
  bool reflects = false;

  /// Throws bad_input if rows share unknowns in a way that H cannot undo.
  explicit bounded_coordinates(Eigen::SparseMatrix<S> const& N)
      : rows(static_cast<std::size_t>(N.rows())) {
    if (auto const why = shared_unknown(N)) {
      throw bad_input("N", *why, "rows of one entry, or of disjoint supports");
    }
    Eigen::SparseMatrix<S, Eigen::RowMajor> const by_rows = N;
    std::vector<Eigen::Triplet<S>> entries;
    std::vector<bool> reflected(static_cast<std::size_t>(N.cols()), false);
    std::vector<std::pair<index, S>> row;
    for (index i = 0; i < N.rows(); ++i) {
      row.clear();
      for (typename Eigen::SparseMatrix<S, Eigen::RowMajor>::InnerIterator e(by_rows, i); e; ++e) {
        if (e.value() != S(0)) row.emplace_back(e.col(), e.value());
      }
      if (row.empty()) continue;
      rows[static_cast<std::size_t>(i)] = reflect(row, entries);
      if (row.size() == 1) continue;
      for (auto const& [j, value] : row) reflected[static_cast<std::size_t>(j)] = true;
    }
    reflects = !entries.empty();
    if (!reflects) return;
    for (index j = 0; j < N.cols(); ++j) {
      if (!reflected[static_cast<std::size_t>(j)]) {
        entries.emplace_back(static_cast<int>(j), static_cast<int>(j), S(1));
      }
    }
    H.resize(N.cols(), N.cols());
    H.setFromTriplets(entries.begin(), entries.end());
  }

  /// H u.
  template <class V>
  [[nodiscard]] V of(V const& u) const {
    if (!reflects) return u;
    return V(H * u);
  }

 private:
  /// The component that the row bounds; its reflection goes to `entries`, the row becomes w.
  static bounded_component<S> reflect(std::vector<std::pair<index, S>>& row,
                                      std::vector<Eigen::Triplet<S>>& entries) {
    using std::abs;
    using std::sqrt;
    std::size_t p = 0;
    for (std::size_t j = 1; j < row.size(); ++j) {
      if (abs(row[j].second) > abs(row[p].second)) p = j;
    }
    S const largest = abs(row[p].second);
    bool const positive = row[p].second > S(0);
    if (row.size() == 1) return {row[p].first, positive, largest};
    S square(0);
    for (auto& [j, value] : row) {
      value /= largest;
      square += value * value;
    }
    S const length = sqrt(square);
    row[p].second += positive ? length : -length;
    S const β = S(1) / (length * (length + S(1)));  // 2/‖w‖²
    for (auto const& [i, w_i] : row) {
      for (auto const& [j, w_j] : row) {
        entries.emplace_back(static_cast<int>(i), static_cast<int>(j),
                             S(i == j ? 1 : 0) - β * w_i * w_j);
      }
    }
    return {row[p].first, !positive, largest * length};
  }
};

}  // namespace slant::contact::detail
