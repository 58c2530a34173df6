// SPDX-License-Identifier: MIT
//
// Intervals: the half line { x : l <= x }, as of a contact pressure that cannot pull;
// { x : l <= x <= u }; and { x : |x| <= g }, the friction set of a node of a plane problem.
#pragma once

#include <slant/concepts/bad_input.hpp>
#include <slant/concepts/face.hpp>
#include <slant/concepts/scalar.hpp>
#include <slant/sets/parts/bounds.hpp>

#include <Eigen/Core>

namespace slant {

// --- half line -----------------------------------------------------------------------------------

/// { x ∈ R : x >= l }.
///
/// Projection max(l, x), exact; slanting function 1 for x >= l, else 0 [K (49)]. l = −∞ is legal.
/// "On the bound" means within 8 ε |l|, ε the machine epsilon; a bound 0 has no band.
/// NaN in, NaN out.
template <scalar S = double>
class half_line {
 public:
  using scalar = S;
  static constexpr int dimension = 1;
  static constexpr int inequalities = 1;
  using vector_type = Eigen::Matrix<S, 1, 1>;
  using matrix_type = Eigen::Matrix<S, 1, 1>;

  half_line() = default;

  /// @throws bad_input if l is NaN or +∞.
  explicit half_line(S const& l) : lower_(l) {
    if (!(l < detail::infinity<S>())) {
      throw bad_input("l", detail::show(l), "a number less than infinity");
    }
  }

  [[nodiscard]] half_line with(S const& l) const { return half_line(l); }
  [[nodiscard]] S const& lower() const { return lower_; }

  [[nodiscard]] vector_type project(auto const& x) const {
    vector_type v = x;
    if (v(0) < lower_) v(0) = lower_;
    return v;
  }

  /// Membership up to the band.
  [[nodiscard]] bool contains(auto const& x) const {
    return detail::at_least(vector_type(x)(0), lower_);
  }

  /// For x in the set: fixed on the bound, free above it.
  [[nodiscard]] block_state state(auto const& x) const {
    vector_type const v = x;
    return v(0) <= lower_ || detail::at_bound(v(0), lower_) ? block_state::fixed
                                                            : block_state::free;
  }

  /// Slanting operator of the projection at x [K (49)].
  [[nodiscard]] matrix_type slant(auto const& x) const {
    vector_type const v = x;
    if (detail::any_nan(v(0))) return v;
    return matrix_type::Constant(v(0) >= lower_ ? S(1) : S(0));
  }

  /// sup{α >= 0 : x + α d in the set} for x in the set; x below l by rounding counts as l.
  [[nodiscard]] S step_to_boundary(auto const& x, auto const& d) const {
    return detail::step_to_bounds<S>(vector_type(x)(0), vector_type(d)(0), lower_,
                                     detail::infinity<S>());
  }

  /// sup of y z over z in the set: y l for y <= 0, otherwise ∞.
  [[nodiscard]] S support(auto const& y) const {
    vector_type const v = y;
    return v(0) > S(0) ? detail::infinity<S>() : detail::support_product(v(0), lower_);
  }

  /// f(x) = l − x <= 0.
  [[nodiscard]] Eigen::Matrix<S, 1, 1> inequality(auto const& x) const {
    return Eigen::Matrix<S, 1, 1>::Constant(lower_ - vector_type(x)(0));
  }

  [[nodiscard]] Eigen::Matrix<S, 1, 1> inequality_gradient(auto const&) const {
    return Eigen::Matrix<S, 1, 1>::Constant(S(-1));
  }

  [[nodiscard]] matrix_type inequality_hessian(auto const&, auto const&) const {
    return matrix_type::Zero();
  }

 private:
  S lower_{0};
};

// --- interval ------------------------------------------------------------------------------------

/// { x ∈ R : l <= x <= u }.
///
/// Projection min(u, max(l, x)), exact. Slanting function 1 for l <= x <= u, else 0 (both ends as
/// in [K (49)]), and 0 everywhere if l = u, where the projection is constant. Infinite ends are
/// legal. "On a bound" means within 8 ε times its size, ε the machine epsilon; a bound 0 has no
/// band. NaN in, NaN out.
template <scalar S = double>
class interval {
 public:
  using scalar = S;
  static constexpr int dimension = 1;
  static constexpr int inequalities = 2;
  using vector_type = Eigen::Matrix<S, 1, 1>;
  using matrix_type = Eigen::Matrix<S, 1, 1>;

  interval() = default;

  /// @throws bad_input if l or u is NaN, l = +∞, u = −∞ or l > u.
  interval(S const& l, S const& u) : lower_(l), upper_(u) {
    if (!(l < detail::infinity<S>())) {
      throw bad_input("l", detail::show(l), "a number less than infinity");
    }
    if (!(u > -detail::infinity<S>())) {
      throw bad_input("u", detail::show(u), "a number greater than -infinity");
    }
    if (l > u) throw bad_input("l", detail::show(l), "a number <= u = " + detail::show(u));
  }

  [[nodiscard]] interval with(S const& l, S const& u) const { return interval(l, u); }
  [[nodiscard]] S const& lower() const { return lower_; }
  [[nodiscard]] S const& upper() const { return upper_; }

  [[nodiscard]] vector_type project(auto const& x) const {
    vector_type v = x;
    if (v(0) < lower_) v(0) = lower_;
    if (v(0) > upper_) v(0) = upper_;
    return v;
  }

  /// Membership up to the band.
  [[nodiscard]] bool contains(auto const& x) const {
    vector_type const v = x;
    return detail::at_least(v(0), lower_) && detail::at_most(v(0), upper_);
  }

  /// For x in the set: fixed on a bound, free between them.
  [[nodiscard]] block_state state(auto const& x) const {
    vector_type const v = x;
    bool const interior = v(0) > lower_ && v(0) < upper_ && !detail::at_bound(v(0), lower_) &&
                          !detail::at_bound(v(0), upper_);
    return interior ? block_state::free : block_state::fixed;
  }

  /// Slanting operator of the projection at x.
  [[nodiscard]] matrix_type slant(auto const& x) const {
    vector_type const v = x;
    if (detail::any_nan(v(0))) return v;
    bool const moves = lower_ < upper_ && v(0) >= lower_ && v(0) <= upper_;
    return matrix_type::Constant(moves ? S(1) : S(0));
  }

  /// sup{α >= 0 : x + α d in the set} for x in the set; x outside by rounding counts as on the
  /// bound.
  [[nodiscard]] S step_to_boundary(auto const& x, auto const& d) const {
    return detail::step_to_bounds<S>(vector_type(x)(0), vector_type(d)(0), lower_, upper_);
  }

  /// sup of y z over z in the set: y u for y >= 0, y l for y <= 0.
  [[nodiscard]] S support(auto const& y) const {
    vector_type const v = y;
    return detail::support_product(v(0), v(0) < S(0) ? lower_ : upper_);
  }

  /// f(x) = (l − x, x − u) <= 0; an infinite end gives −∞.
  [[nodiscard]] Eigen::Matrix<S, 2, 1> inequality(auto const& x) const {
    vector_type const v = x;
    return {lower_ - v(0), v(0) - upper_};
  }

  /// Column i is the gradient of fᵢ.
  [[nodiscard]] Eigen::Matrix<S, 1, 2> inequality_gradient(auto const&) const {
    return {S(-1), S(1)};
  }

  [[nodiscard]] matrix_type inequality_hessian(auto const&, auto const&) const {
    return matrix_type::Zero();
  }

 private:
  S lower_{-1};
  S upper_{1};
};

// --- symmetric interval --------------------------------------------------------------------------

/// { x ∈ R : −g <= x <= g }, an interval in all but its parameter, which is that of the disc of a
/// problem in space. g = 0 and g = ∞ are legal.
template <scalar S = double>
class symmetric_interval : public interval<S> {
 public:
  symmetric_interval() = default;

  /// @throws bad_input if g is NaN or negative.
  explicit symmetric_interval(S const& g) : interval<S>(S(-checked(g)), g) {}

  [[nodiscard]] symmetric_interval with(S const& g) const { return symmetric_interval(g); }
  [[nodiscard]] S const& radius() const { return this->upper(); }

 private:
  [[nodiscard]] static S const& checked(S const& g) {
    if (!(g >= S(0))) throw bad_input("radius", detail::show(g), "a number >= 0");
    return g;
  }
};

}  // namespace slant
