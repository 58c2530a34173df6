// SPDX-License-Identifier: MIT
//
// The active set J of B u ≤ c, and the projections that belong to it:
//
//     V Vᵀr      the part of r in ker B^J: with orthonormal V = (U, V₀) the projector of [D (v)]
//     onto the tangent cone { d : b_iᵀd ≤ 0 for all tight rows i }, with the multipliers of
//                r = Bᵀλ + d, λ ≥ 0 on tight rows
//     onto { u : B u ≤ c }
//
// all of them cluster by cluster, by least squares with independent rows only (nearest_point.hpp),
// so that redundant and repeated rows do no harm.
#pragma once

#include <slant/base/vector_algebra.hpp>
#include <slant/concepts/bad_input.hpp>
#include <slant/concepts/laws.hpp>
#include <slant/methods/parts/nearest_point.hpp>
#include <slant/problems/polyhedral_qp.hpp>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace slant {

/// Working room and active set of constraint_rows<S>; allocates at construction only.
template <class S>
class active_rows {
 public:
  using scalar = S;
  using rows_type = constraint_rows<S>;
  using vector_type = typename rows_type::vector_type;

  explicit active_rows(rows_type const& rows) : active_(std::size_t(rows.count()), 0) {
    for (auto const& part : rows.clusters()) {
      index const n = part.e.rows();
      index const m = part.e.cols();
      rooms_.push_back({{n, m}, {n, m}, vector_type(n), vector_type(m)});
    }
  }

  /// Is row i in J?
  [[nodiscard]] bool contains(index i) const { return active_[std::size_t(i)] != 0; }
  /// Number of rows in J.
  [[nodiscard]] index size() const { return index(std::count(active_.begin(), active_.end(), 1)); }

  /// J ← { i : in(i) }. Returns the number of rows that came or went.
  template <class In>
  index assign(rows_type const& rows, In in) {
    index changes = 0;
    for (std::size_t k = 0; k < rooms_.size(); ++k) {
      auto const& part = rows.clusters()[k];
      index changed = 0;
      for (index const i : part.rows) {
        unsigned char const now = in(i) ? 1 : 0;
        auto& before = active_[std::size_t(i)];
        changed += now != before ? 1 : 0;
        before = now;
      }
      if (changed == 0) continue;
      changes += changed;
      auto& basis = rooms_[k].basis;
      basis.clear();
      for (std::size_t j = 0; j < part.rows.size(); ++j) {
        if (contains(part.rows[j])) basis.append(part.e, index(j));
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
    auto const bound = [&](index i) { return contains(i) ? S(0) : detail::infinity<S>(); };
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
        w.bounds[index(j)] = bound(part.rows[j]);
      }
      if (!w.find(part.e)) found = false;
      scatter(part.unknowns, w.x, u);
      for (std::size_t j = 0; j < part.rows.size(); ++j) {
        λ[part.rows[j]] = w.λ[index(j)];
      }
    }
    return found;
  }

  template <class V>
  static void gather(std::vector<index> const& unknowns, V const& v, vector_type& x) {
    auto const& entries = slant::local(v);
    for (std::size_t k = 0; k < unknowns.size(); ++k) {
      x[index(k)] = entries.coeff(unknowns[k]);
    }
  }
  template <class V>
  static void scatter(std::vector<index> const& unknowns, vector_type const& x, V& v) {
    auto& entries = slant::local(v);
    for (std::size_t k = 0; k < unknowns.size(); ++k) {
      entries.coeffRef(unknowns[k]) = x[index(k)];
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

// --- row slacks ----------------------------------------------------------------------------------
//
// How far u is from each constraint of B u ≤ c, which of them are in the active set J, and which
// one a step along q meets first [D (iv), (xiv)].
//
// A slack c_i − b_iᵀu is a difference of numbers that may have been much larger in an earlier
// iterate than they are at its end; what is smaller than the rounding error of the largest so far
// counts as 0. What an iterate far away has left behind is forgotten where slacks are measured anew
// from u alone.

/// Slacks and active set of constraint_rows<S>; allocates at construction only.
template <class S>
struct row_slacks {
  using rows_type = constraint_rows<S>;
  using vector_type = typename rows_type::vector_type;

  vector_type slack;  ///< c − B u in the units of the rows; +infinity for rows that never act
  vector_type sizes;  ///< the largest |b_i|ᵀ|u| + |c_i| since forget()
  vector_type rates = sizes;  ///< b_iᵀq of the rows that q approaches, else 0
  active_rows<S> active;      ///< J
  index changes = 0;          ///< changes of J, however many rows came or went
  index rows_changed = 0;     ///< rows that came or went

  explicit row_slacks(rows_type const& rows)
      : slack(rows.count()), sizes(vector_type::Zero(rows.count())), active(rows) {}

  /// c − B u, 0 where that cannot be told from 0.
  template <class V>
  void measure(rows_type const& rows, V const& u) {
    note_sizes(rows, u);
    slack.setConstant(detail::infinity<S>());
    rows.for_each_product(u, [&](index i, S const& value, S const&) {
      using std::abs;
      S const gap = rows.c()[i] - value;
      slack[i] = abs(gap) <= S(16) * ε() * sizes[i] ? S(0) : gap;
    });
  }
  template <class V>
  void note_sizes(rows_type const& rows, V const& u) {
    rows.for_each_product(u, [&](index i, S const&, S const& size) {
      using std::abs;
      sizes[i] = std::max<S>(sizes[i], size + abs(rows.c()[i]));
    });
  }
  /// No earlier iterate matters any more.
  void forget() { sizes.setZero(); }
  [[nodiscard]] bool is_feasible() const { return (slack.array() >= S(0)).all(); }

  /// Are the rows of J tight at v, which note_sizes has seen?
  template <class V>
  [[nodiscard]] bool are_tight(rows_type const& rows, V const& v) const {
    bool tight = true;
    rows.for_each_product(v, [&](index i, S const& value, S const&) {
      using std::abs;
      if (active.contains(i) && abs(rows.c()[i] - value) > S(16) * ε() * sizes[i]) tight = false;
    });
    return tight;
  }

  /// J = { i : b_iᵀu = c_i }.
  void take_tight(rows_type const& rows) {
    (void)change(rows, [&](index i) { return !(slack[i] > S(0)); });
  }

  /// Rows along which d leaves the constraint leave J, except those with a multiplier; false if
  /// there are none. d is a part of r, whose rounding errors it has.
  template <class V>
  [[nodiscard]] bool leave_along(rows_type const& rows, V const& r, V const& d,
                                 vector_type const& λ) {
    rows.for_each_product(r,
                          [&](index i, S const&, S const& size) { rates[i] = S(32) * ε() * size; });
    rows.for_each_product(d, [&](index i, S const& value, S const&) {
      bool const leaves = value < -rates[i] && !(λ[i] > S(0));
      rates[i] = leaves ? value : S(0);
    });
    return change(rows, [&](index i) { return active.contains(i) && !(rates[i] < S(0)); });
  }

  /// α₁ = min slack_i / (unit b_iᵀq) over rows with b_iᵀq > 0; infinite if there is none. What is
  /// at most noise ‖b_i‖ counts as 0.
  template <class V>
  [[nodiscard]] S first_constraint(rows_type const& rows, V const& q, S const& unit,
                                   S const& noise) {
    S α1 = detail::infinity<S>();
    rates.setZero();
    rows.for_each_product(q, [&](index i, S const& value, S const& size) {
      if (active.contains(i) || !(value > S(32) * ε() * size + noise * rows.length(i))) return;
      rates[i] = unit * value;
      α1 = std::min<S>(α1, std::max<S>(slack[i], S(0)) / rates[i]);
    });
    return α1;
  }
  /// After u ← u + step · q.
  template <class V>
  void advance(rows_type const& rows, V const& q, S const& step) {
    rows.for_each_product(q, [&](index i, S const& value, S const&) { slack[i] -= step * value; });
  }
  /// After a step by α₁: the rows that it has met enter J, also those that are as near.
  void take_blocking(rows_type const& rows, S const& α1) {
    auto const reached = [&](index i) {
      S const before = slack[i] + α1 * rates[i];  // of which what is left is the rounding error
      return rates[i] > S(0) && slack[i] <= S(8) * ε() * before;
    };
    (void)change(rows, [&](index i) { return active.contains(i) || reached(i); });
    for (index i = 0; i < slack.size(); ++i) {
      if (rates[i] > S(0) && active.contains(i)) slack[i] = S(0);
    }
  }

 private:
  static S ε() { return detail::epsilon<S>(); }

  template <class In>
  bool change(rows_type const& rows, In in) {
    index const count = active.assign(rows, in);
    rows_changed += count;
    changes += count > 0 ? 1 : 0;
    return count > 0;
  }
};

}  // namespace slant

namespace slant::detail {

// --- moved rows ----------------------------------------------------------------------------------
//
// B U = 0, which the Schur complement contact algorithm takes from its projector for granted: an
// application of Q and a minimisation over range(U) must move no row of B. A projector that moves
// one leads out of B u ≤ c unseen, whatever the load is.

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
  std::vector<index> cluster_of(std::size_t(rows.unknowns()), -1);
  std::vector<index> place(std::size_t(rows.unknowns()), -1);
  for (std::size_t k = 0; k < rows.clusters().size(); ++k) {
    auto const& unknowns = rows.clusters()[k].unknowns;
    for (std::size_t i = 0; i < unknowns.size(); ++i) {
      cluster_of[std::size_t(unknowns[i])] = index(k);
      place[std::size_t(unknowns[i])] = index(i);
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
          auto const at = std::size_t(e.row());
          if (cluster_of[at] < 0) continue;
          meets = true;
          auto const& part = rows.clusters()[std::size_t(cluster_of[at])];
          for (std::size_t r = 0; r < part.rows.size(); ++r) {
            f(part.rows[r], part.e(place[at], index(r)) * e.value());
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
        S const noise = S(32) * detail::epsilon<S>() * sizes[row];
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
      S const noise = S(1024) * detail::epsilon<S>() * (size + sizes[i]);
      if (!(abs(value) <= noise)) moved = true;
    });
    return moved;
  }
}

}  // namespace slant::detail
