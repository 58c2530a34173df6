// SPDX-License-Identifier: MIT
//
// Contact without friction as a problem with bounds:
//
//     minimise  ½ uᵀKu − fᵀu   over   N u ≤ d        becomes
//     minimise  ½ vᵀ(HKH)v − (Hf)ᵀv   over   l ≤ v ≤ h,     v = H u,
//
// H orthogonal and symmetric, the identity where rows of N have one entry (an obstacle parallel to
// a coordinate plane, a membrane); see bounded coordinates below. K is never factored: the
// problem is for methods that work on u, such as symmetric_newton{problem.qp(), M} with the
// multigrid M of the same matrix.
#pragma once

#include <slant/base/matrix_entries.hpp>
#include <slant/concepts/bad_input.hpp>
#include <slant/contact/contact_data.hpp>
#include <slant/operators/matrix.hpp>
#include <slant/problems/separable_qp.hpp>
#include <slant/sets/contact_sets.hpp>

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace slant::contact::detail {

// --- bounded coordinates -------------------------------------------------------------------------
//
// Coordinates v = H u in which N u ≤ d are bounds of single components. A row with one entry is one
// already. For a row n with more of them H is the Householder reflection of its support that maps
// n/‖n‖ to −sign(n_p) e_p, |n_p| its largest entry [Golub, Van Loan, 5.1.3]: so long as no other
// row has an unknown of that support, n·u ≤ d is a bound of v_p. H is orthogonal and symmetric.

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

namespace slant::contact {

// --- obstacle ------------------------------------------------------------------------------------

/// The problem at the top of this file. Holds all it needs; not movable, and qp() not to be had
/// from a temporary: it refers to this object.
///
///     slant::contact::obstacle problem(K, f, N, d);
///     slant::multigrid M(problem.matrix(), problem.coordinates(rigid_body_modes(nodes)));
///     auto r = slant::solve(slant::symmetric_newton{problem.qp(), M}, problem.zero(), …);
///     auto u = problem.displacement(r.x());
template <class S = double>
class obstacle {
 public:
  using vector_type = Eigen::Matrix<S, Eigen::Dynamic, 1>;
  using matrix_type = Eigen::Matrix<S, Eigen::Dynamic, Eigen::Dynamic>;
  using sparse_type = Eigen::SparseMatrix<S>;
  using row_major_type = Eigen::SparseMatrix<S, Eigen::RowMajor>;

  /// K: n × n, both triangles, definite (which is asserted, not checked); f: n; N: m × n; d: m, +∞
  /// where nothing is ever met. Rows of N have one entry each, or supports that no other row meets.
  /// Throws bad_input naming what does not fit: sizes, numbers that are not finite, a K that is not
  /// symmetric, rows that share unknowns otherwise, bounds that exclude each other.
  obstacle(sparse_type const& K, vector_type const& f, sparse_type const& N, vector_type const& d)
      : obstacle(K, data<S>{N, sparse_type(0, f.size()), f, d, vector_type(0)}) {}
  /// The same of the data of a scene, whose friction is left out of account.
  obstacle(sparse_type const& K, data<S> const& c) : obstacle(K, c, valid(K, c)) {}
  obstacle(obstacle const&) = delete;
  obstacle& operator=(obstacle const&) = delete;

  /// HKH.
  [[nodiscard]] row_major_type const& matrix() const& { return K_; }
  row_major_type const& matrix() const&& = delete;
  /// The problem with bounds; refers to this object.
  [[nodiscard]] auto qp() const& {
    return separable_qp{slant::matrix<self_adjoint, positive_definite>(K_), f_, set_};
  }
  auto qp() const&& = delete;
  /// l ≤ v ≤ h.
  [[nodiscard]] auto const& set() const& { return set_; }
  auto const& set() const&& = delete;
  /// v = 0: methods begin at the feasible point next to it.
  [[nodiscard]] vector_type zero() const { return vector_type::Zero(f_.size()); }
  /// Whether H is not the identity.
  [[nodiscard]] bool reflects() const { return coordinates_.reflects; }

  /// v = H u; of a matrix, that of each column. Throws bad_input for a wrong number of rows.
  template <class V>
  [[nodiscard]] V coordinates(V const& u) const {
    slant::detail::check_size("rows of u", u.rows(), f_.size(), "the size of f,");
    return coordinates_.of(u);
  }
  /// u = H v.
  [[nodiscard]] vector_type displacement(vector_type const& v) const { return coordinates(v); }
  /// The contact forces λ ≥ 0 of the rows of N, f − K u = Nᵀλ at a solution v. Where several rows
  /// bound one component the tightest has the force. One product.
  [[nodiscard]] vector_type multipliers(vector_type const& v) const {
    slant::detail::check_size("v", v.size(), f_.size(), "the size of f,");
    vector_type const r = f_ - K_ * v;
    vector_type λ = vector_type::Zero(static_cast<index>(coordinates_.rows.size()));
    for (index i = 0; i < λ.size(); ++i) {
      auto const& row = coordinates_.rows[static_cast<std::size_t>(i)];
      if (row.component < 0) continue;
      auto const& tightest = row.above ? highest_ : lowest_;
      if (tightest[static_cast<std::size_t>(row.component)] != i) continue;
      if (on_bound(row, v) && (row.above == (r[row.component] > S(0)))) {
        using std::abs;
        λ[i] = abs(r[row.component]) / row.size;
      }
    }
    return λ;
  }

 private:
  struct bounds {
    vector_type lower, upper;
  };
  using set_type = decltype(intervals(std::declval<vector_type>(), std::declval<vector_type>()));

  static detail::bounded_coordinates<S> valid(sparse_type const& K, data<S> const& c) {
    c.validate();
    slant::detail::check_size("rows of K", K.rows(), c.f.size(), "the size of f,");
    slant::detail::require_symmetric_matrix("K", K);
    return detail::bounded_coordinates<S>(c.N);
  }
  obstacle(sparse_type const& K, data<S> const& c, detail::bounded_coordinates<S> coordinates)
      : coordinates_(std::move(coordinates)),
        K_(reflects() ? row_major_type(sparse_type(coordinates_.H * K) * coordinates_.H)
                      : row_major_type(K)),
        f_(coordinates_.of(c.f)),
        lowest_(static_cast<std::size_t>(f_.size()), -1),
        highest_(lowest_),
        bounds_(bounds_of(c.d)),
        set_(intervals(bounds_.lower, bounds_.upper)) {}

  [[nodiscard]] bounds bounds_of(vector_type const& d) {
    S const infinity = std::numeric_limits<S>::infinity();
    bounds b{vector_type::Constant(f_.size(), -infinity),
             vector_type::Constant(f_.size(), infinity)};
    for (index i = 0; i < d.size(); ++i) {
      auto const& row = coordinates_.rows[static_cast<std::size_t>(i)];
      if (row.component < 0 || d[i] == infinity) continue;
      auto const p = static_cast<std::size_t>(row.component);
      S const bound = row.above ? S(d[i] / row.size) : S(-d[i] / row.size);
      if (!slant::detail::is_finite(bound)) {
        throw bad_input("d", slant::detail::show(d[i]),
                        "a gap within the range of the scalar, in units of its row of N")
            .at(i);
      }
      S& there = row.above ? b.upper[row.component] : b.lower[row.component];
      if (row.above ? bound < there : bound > there) {
        there = bound;
        (row.above ? highest_ : lowest_)[p] = i;
      }
      if (b.lower[row.component] > b.upper[row.component]) {
        index const other = (row.above ? lowest_ : highest_)[p];
        throw bad_input("d", slant::detail::show(d[i]),
                        "one that row " + slant::detail::show(other) + " of N does not exclude")
            .at(i);
      }
    }
    return b;
  }
  [[nodiscard]] bool on_bound(detail::bounded_component<S> const& row, vector_type const& v) const {
    S const& x = v[row.component];
    return row.above ? x >= bounds_.upper[row.component] : x <= bounds_.lower[row.component];
  }

  detail::bounded_coordinates<S> coordinates_;
  row_major_type K_;
  vector_type f_;
  std::vector<index> lowest_, highest_;  // the row that bounds a component, or −1
  bounds bounds_;
  set_type set_;
};

template <class S>
obstacle(Eigen::SparseMatrix<S> const&, data<S> const&) -> obstacle<S>;

}  // namespace slant::contact
