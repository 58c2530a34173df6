// SPDX-License-Identifier: MIT
//
// The active set J of B u ≤ c, and the projections that belong to it:
//
//     V Vᵀr      the part of r in ker B^J: with orthonormal V = (U, V₀) the projector of [D (v)]
//     onto the tangent cone { d : b_iᵀd ≤ 0 for all tight rows i }, with the multipliers of
//                r = Bᵀλ + d, λ ≥ 0 on tight rows
//     onto { u : B u ≤ c }
//
// all of them cluster by cluster, by least squares with independent rows only (row_basis.hpp), so
// that redundant and repeated rows do no harm.
#pragma once

#include <slant/concepts/laws.hpp>
#include <slant/concepts/vector_algebra.hpp>
#include <slant/methods/constraint_rows.hpp>
#include <slant/methods/detail/nearest_point.hpp>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

namespace slant {

/// Working room and active set of constraint_rows<S>; allocates at construction only.
template <class S>
class active_rows {
 public:
  using scalar = S;
  using rows_type = constraint_rows<S>;
  using vector_type = typename rows_type::vector_type;

  explicit active_rows(rows_type const& rows) : active_(static_cast<std::size_t>(rows.count()), 0) {
    for (auto const& part : rows.clusters()) {
      index const n = part.e.rows();
      index const m = part.e.cols();
      rooms_.push_back({{n, m}, {n, m}, vector_type(n), vector_type(m)});
    }
  }

  /// Is row i in J?
  [[nodiscard]] bool contains(index i) const { return active_[static_cast<std::size_t>(i)] != 0; }
  /// Number of rows in J.
  [[nodiscard]] index size() const {
    return static_cast<index>(std::count(active_.begin(), active_.end(), 1));
  }

  /// J ← { i : in(i) }. Returns the number of rows that came or went.
  template <class In>
  index assign(rows_type const& rows, In in) {
    index changes = 0;
    for (std::size_t k = 0; k < rooms_.size(); ++k) {
      auto const& part = rows.clusters()[k];
      index changed = 0;
      for (index const i : part.rows) {
        unsigned char const now = in(i) ? 1 : 0;
        auto& before = active_[static_cast<std::size_t>(i)];
        changed += now != before ? 1 : 0;
        before = now;
      }
      if (changed == 0) continue;
      changes += changed;
      auto& basis = rooms_[k].basis;
      basis.clear();
      for (std::size_t j = 0; j < part.rows.size(); ++j) {
        if (contains(part.rows[j])) basis.append(part.e, static_cast<index>(j));
      }
    }
    return changes;
  }

  /// φ = V Vᵀr.
  template <class V>
  void project_on_kernel(rows_type const& rows, V const& r, V& φ) {
    vectors::copy(r, φ);
    for (std::size_t k = 0; k < rooms_.size(); ++k) {
      room& w = rooms_[k];
      if (w.basis.size() == 0) continue;
      gather(rows.clusters()[k].unknowns, r, w.x);
      w.basis.take_out(w.x, w.a);
      scatter(rows.clusters()[k].unknowns, w.x, φ);
    }
  }

  /// d = the projection of r onto the tangent cone, λ the multipliers; all rows of J count as
  /// tight.
  template <class V>
  void project_on_cone(rows_type const& rows, V const& r, V& d, vector_type& λ) {
    auto const bound = [&](index i) {
      return contains(i) ? S(0) : std::numeric_limits<S>::infinity();
    };
    vectors::copy(r, d);
    (void)nearest(rows, d, λ, bound, [&](auto const& part) {
      return std::any_of(part.rows.begin(), part.rows.end(), [&](index i) { return contains(i); });
    });
  }

  /// u ← the nearest point of { B u ≤ c }; false if there is none. λ is scratch.
  template <class V>
  [[nodiscard]] bool project_on_set(rows_type const& rows, V& u, vector_type& λ) {
    return nearest(
        rows, u, λ, [&](index i) { return rows.c()[i]; }, [](auto const&) { return true; });
  }

 private:
  struct room {
    detail::row_basis<S> basis;       // of the rows of J
    detail::nearest_point<S> inside;  // of projections with inequalities
    vector_type x;
    vector_type a;
  };

  template <class V, class Bound, class Needed>
  [[nodiscard]] bool nearest(rows_type const& rows, V& u, vector_type& λ, Bound bound,
                             Needed needed) {
    λ.setZero();
    bool found = true;
    for (std::size_t k = 0; k < rooms_.size(); ++k) {
      auto const& part = rows.clusters()[k];
      if (!needed(part)) continue;
      auto& w = rooms_[k].inside;
      gather(part.unknowns, u, w.x);
      for (std::size_t j = 0; j < part.rows.size(); ++j) {
        w.bounds[static_cast<index>(j)] = bound(part.rows[j]);
      }
      if (!w.find(part.e)) found = false;
      scatter(part.unknowns, w.x, u);
      for (std::size_t j = 0; j < part.rows.size(); ++j) {
        λ[part.rows[j]] = w.λ[static_cast<index>(j)];
      }
    }
    return found;
  }

  template <class V>
  static void gather(std::vector<index> const& unknowns, V const& v, vector_type& x) {
    auto const& entries = slant::local(v);
    for (std::size_t k = 0; k < unknowns.size(); ++k) {
      x[static_cast<index>(k)] = entries.coeff(unknowns[k]);
    }
  }
  template <class V>
  static void scatter(std::vector<index> const& unknowns, vector_type const& x, V& v) {
    auto& entries = slant::local(v);
    for (std::size_t k = 0; k < unknowns.size(); ++k) {
      entries.coeffRef(unknowns[k]) = x[static_cast<index>(k)];
    }
  }

  std::vector<unsigned char> active_;
  std::vector<room> rooms_;
};

namespace detail {

/// C = V Vᵀ of an active set as an operator, for the time of a call; it works in the room of the
/// active set, so that only one thread may apply it.
template <class S>
class kernel_projector {
 public:
  static constexpr law_set laws = slant::laws<slant::self_adjoint, slant::projector>;

  kernel_projector(constraint_rows<S> const& rows, active_rows<S>& active)
      : rows_(rows), active_(active) {}
  [[nodiscard]] index rows() const { return rows_.unknowns(); }
  [[nodiscard]] index cols() const { return rows_.unknowns(); }
  template <class X>
  void apply(X const& x, X& y) const {
    active_.project_on_kernel(rows_, x, y);
  }

 private:
  constraint_rows<S> const& rows_;
  active_rows<S>& active_;
};

}  // namespace detail

}  // namespace slant
