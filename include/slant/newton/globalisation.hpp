// SPDX-License-Identifier: MIT
//
// Globalisations: how far to go along a Newton direction.
//
// Intuition. Like forcing terms they see numbers only. The method evaluates F(y + α dy) for the
// lengths α that it is told, and keeps the value of the accepted one as its next residual: so a
// length that is accepted at once costs nothing.
//
// Minimal definition.
//     first_length()       the first α
//     accepts(point)       is this the next iterate? Never true of a point where ‖F‖ is not finite
//     next_length(point)   the α to try after a refusal; 0: give up
//
// Models. full_step, multiple_root, halving_line_search.
#pragma once

#include <slant/newton/forcing.hpp>

#include <concepts>

namespace slant {

/// A point tried along a direction.
template <class S>
struct search_point {
  index trial = 0;       ///< 0 for the first length
  S length{1};           ///< α
  S residual{0};         ///< ‖F(y + α dy)‖; NaN and ∞ are possible
  S residual_before{0};  ///< ‖F(y)‖
  S linear_residual{0};  ///< ‖F(y) + F°(y) dy‖
};

/// A rule for the length of Newton steps; see the top of this file.
template <class G, class S>
concept globalisation = requires(G const& g, search_point<S> const& p) {
  S(g.first_length());
  { g.accepts(p) } -> std::same_as<bool>;
  { g.next_length(p) } -> std::convertible_to<S>;
};

/// α = 1 always: Newton's method itself. Local convergence.
struct full_step {
  [[nodiscard]] static constexpr int first_length() { return 1; }
  template <class S>
  [[nodiscard]] bool accepts(search_point<S> const& p) const {
    return detail::is_finite(p.residual);
  }
  template <class S>
  [[nodiscard]] S next_length(search_point<S> const&) const {
    return S(0);
  }
};

/// α = m: a root of known multiplicity m is approached quadratically, where α = 1 is linear with
/// the factor 1 − 1/m [Schröder 1870].
struct multiple_root {
  double multiplicity = 2;  ///< m ≥ 1

  [[gnu::cold]] void validate() const {
    detail::check_option("multiplicity", multiplicity,
                         multiplicity >= 1 && detail::is_finite(multiplicity),
                         "a number in [1, ∞)");
  }
  [[nodiscard]] double first_length() const { return multiplicity; }
  template <class S>
  [[nodiscard]] bool accepts(search_point<S> const& p) const {
    return detail::is_finite(p.residual);
  }
  template <class S>
  [[nodiscard]] S next_length(search_point<S> const&) const {
    return S(0);
  }
};

/// α = 1, ½, ¼, … until ‖F(y + α dy)‖ ≤ ‖F‖ − c α (‖F‖ − ‖F + F° dy‖): a fraction c of the
/// decrease that the linear model promises [Eisenstat, Walker 1994].
///
/// Where F is smooth and F° dy = −F nearly, some α is accepted. At a kink it may be that none is:
/// then the run stalls rather than accept an increase, since a monotone sequence ‖F‖ is all that
/// is known to keep it from cycling.
struct halving_line_search {
  double sufficient = 1e-4;  ///< c in (0, 1)
  index max_halvings = 30;   ///< ≥ 0

  [[gnu::cold]] void validate() const {
    detail::check_fraction("sufficient", sufficient);
    detail::check_option("max_halvings", max_halvings, max_halvings >= 0, "a number >= 0");
  }
  [[nodiscard]] static constexpr int first_length() { return 1; }
  template <class S>
  [[nodiscard]] bool accepts(search_point<S> const& p) const {
    S const promised = p.residual_before - p.linear_residual;
    return p.residual <= p.residual_before - S(sufficient) * p.length * promised;
  }
  template <class S>
  [[nodiscard]] S next_length(search_point<S> const& p) const {
    return p.trial < max_halvings ? S(p.length / S(2)) : S(0);
  }
};

}  // namespace slant
