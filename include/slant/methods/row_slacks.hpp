// SPDX-License-Identifier: MIT
//
// How far u is from each constraint of B u ≤ c, which of them are in the active set J, and which
// one a step along q meets first [D (iv), (xiv)].
//
// A slack c_i − b_iᵀu is a difference of numbers that may have been much larger in an earlier
// iterate than they are at its end; what is smaller than the rounding error of the largest so far
// counts as 0. What an iterate far away has left behind is forgotten where slacks are measured anew
// from u alone.
#pragma once

#include <slant/methods/active_rows.hpp>

#include <algorithm>
#include <limits>

namespace slant {

/// Slacks and active set of constraint_rows<S>; allocates at construction only.
template <class S>
struct row_slacks {
  using rows_type = constraint_rows<S>;
  using vector_type = typename rows_type::vector_type;

  vector_type slack;      ///< c − B u in the units of the rows; +infinity for rows that never act
  vector_type sizes;      ///< the largest |b_i|ᵀ|u| + |c_i| since forget()
  vector_type rates;      ///< b_iᵀq of the rows that q approaches, else 0
  active_rows<S> active;  ///< J
  index changes = 0;      ///< changes of J, however many rows came or went
  index rows_changed = 0;  ///< rows that came or went

  explicit row_slacks(rows_type const& rows)
      : slack(rows.count()),
        sizes(vector_type::Zero(rows.count())),
        rates(vector_type::Zero(rows.count())),
        active(rows) {}

  /// c − B u, 0 where that cannot be told from 0.
  template <class V>
  void measure(rows_type const& rows, V const& u) {
    note_sizes(rows, u);
    slack.setConstant(std::numeric_limits<S>::infinity());
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
    S α1 = std::numeric_limits<S>::infinity();
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
  static S ε() { return std::numeric_limits<S>::epsilon(); }

  template <class In>
  bool change(rows_type const& rows, In in) {
    index const count = active.assign(rows, in);
    rows_changed += count;
    changes += count > 0 ? 1 : 0;
    return count > 0;
  }
};

}  // namespace slant
