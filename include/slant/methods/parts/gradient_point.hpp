// SPDX-License-Identifier: MIT
//
// A point of Λ with its gradient and reduced gradient, and the units and scales that go with them:
// what the states of projected gradient methods have in common. For another function φ than the
// indicator of Λ the proximal map prox_{αφ} takes the place of P_Λ. And what these methods are made
// of if they take a preconditioner.
#pragma once

#include <slant/base/held.hpp>
#include <slant/base/report.hpp>
#include <slant/base/scaling.hpp>
#include <slant/base/vector_algebra.hpp>
#include <slant/concepts/bad_input.hpp>
#include <slant/concepts/convex_set.hpp>
#include <slant/concepts/linear_operator.hpp>
#include <slant/concepts/vector.hpp>
#include <slant/krylov/spectrum.hpp>
#include <slant/operators/identity.hpp>
#include <slant/problems/quadratic_program.hpp>
#include <slant/sets/proximal_step.hpp>

#include <algorithm>
#include <concepts>
#include <limits>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>

namespace slant {

// --- reduced gradient ----------------------------------------------------------------------------
//
// The reduced gradient  r̃(x) = (x − P_Λ(x − α r(x))) / α  of [K (30)]: zero exactly at the solution
// of min q over Λ [K Lemma 2], equal to r where the constraints are not felt.

/// r̃ at x with gradient r, and on the way trial = x − α r and projected = P_Λ(trial).
template <class Set, class V>
void reduced_gradient(Set const& set, V const& x, V const& r, scalar_t<V> const& α, V& trial,
                      V& projected, V& reduced) {
  vectors::waxpy(-α, r, x, trial);
  slant::project(set, slant::local(trial), slant::local(projected));
  // Where the projection does nothing r̃ = r, exactly: the quotient would lose ‖x‖ε/α.
  auto const& there = slant::local(projected);
  for (index i = 0; i < index(there.size()); ++i) {
    bool const is_inside = there.coeff(i) == slant::local(trial).coeff(i);
    slant::local(reduced).coeffRef(i) =
        is_inside ? slant::local(r).coeff(i)
                  : scalar_t<V>((slant::local(x).coeff(i) - there.coeff(i)) / α);
  }
}

/// r̃ᵀr over some of the blocks, what a projected gradient step on them can gain. On a curved
/// boundary r̃ is nearly orthogonal to r, and close to the solution the product is lost in `noise`,
/// the rounding errors of r̃ times ‖r‖. Then its lower bound ‖r̃‖² stands for it: x ∈ Λ, so (x −
/// P)ᵀ(z − P) ≤ 0 for z = x − α r.
template <class V>
[[nodiscard]] scalar_t<V> gain(V const& reduced, V const& r, scalar_t<V> const& noise) {
  auto const product = inner_product(reduced, r);
  auto const bound = inner_product(reduced, reduced);
  return product > bound + noise ? product : bound;
}

namespace detail {

/// The status of a state with r̃: converged where it vanishes, breakdown where it is no number.
void judge_reduced_gradient(auto& s) {
  auto const& size = s.reduced_gradient_norm;
  if (size == std::remove_cvref_t<decltype(size)>(0)) s.status = status::converged;
  if (!is_finite(size)) s.status = status::breakdown;
}

template <class Norm, class N>
[[nodiscard, gnu::cold]] std::string accuracy_reached(Norm const& reduced, Norm const& scale,
                                                      N const& rounding) {
  return "relative reduced gradient " + show(reduced) + " / " + show(scale) +
         ", of which rounding errors may be " + show(rounding);
}

/// Throws bad_input unless x0 has as many entries as b, all of them finite.
template <class V>
void check_start_in_set(V const& x0, V const& b) {
  check_size("x0", index(slant::local(x0).size()), index(slant::local(b).size()), "the size of b,");
  check_finite("x0", x0);
}

/// A program with options and a preconditioner M ≈ A⁻¹: what methods that solve linear systems are
/// made of. The identity stands for no preconditioner.
template <class QP, class M, template <class> class Options>
class preconditioned_program {
 public:
  using problem = std::remove_cvref_t<QP>;
  using preconditioner = std::remove_cvref_t<M>;
  using vector_type = typename problem::vector_type;
  using scalar = typename problem::scalar;
  using options = Options<scalar>;

  /// Throws bad_input for options out of range.
  explicit preconditioned_program(held<QP> qp, options o = {})
    requires std::same_as<preconditioner, identity_operator>
      : qp_(std::move(qp)), m_(identity_operator(qp_.get().size())), options_(std::move(o)) {
    options_.validate();
  }
  /// Throws bad_input if the size of M is not that of the problem, or for options out of range.
  preconditioned_program(held<QP> qp, held<M> m, options o = {})
      : qp_(std::move(qp)), m_(std::move(m)), options_(std::move(o)) {
    check_size("rows of the preconditioner", index(m_.get().rows()), qp_.get().size());
    check_size("columns of the preconditioner", index(m_.get().cols()), qp_.get().size());
    options_.validate();
  }

 protected:
  static constexpr bool preconditioned = !std::same_as<preconditioner, identity_operator>;

  held<QP> qp_;
  held<M> m_;
  options options_;
};

}  // namespace detail

/// A point of the set of a quadratic program QP, or of the domain of φ. Vectors have qp.size() entries.
template <class QP>
struct gradient_point {
  using vector_type = typename QP::vector_type;
  using scalar = typename QP::scalar;

  vector_type x;              ///< in Λ
  vector_type r;              ///< gradient A x − b, in multiples of unit
  vector_type projected = r;  ///< P_Λ(x − α̃ r)
  vector_type reduced = r;    ///< reduced gradient r̃, in multiples of unit
  vector_type trial = r;      ///< scratch
  workspace_t<typename QP::operator_type, vector_type> a_workspace;  ///< temporaries of A

  scalar unit{1};                   ///< of r and r̃, a power of two; see base/scaling.hpp
  scalar step_length{0};            ///< α̃ of the gradient steps
  scalar size_of_b{0};              ///< ‖b‖ / unit
  scalar reduced_gradient_norm{0};  ///< ‖r̃‖
  scalar gradient_scale{0};         ///< ‖r̃‖ at P_Λ(0): what ‖r̃‖ is small against
  index since_refresh = 0;          ///< steps since r was computed from x
  slant::work work{};

  gradient_point(QP const& qp, vector_type const& x0)
      : x(x0), r(like(x0, qp.size())), a_workspace(workspace(qp.a(), x0)) {}

  /// step_length as given, else `factor`/σ_max; σ_max to a few digits, 0 if it was not asked for.
  /// Not inlined: g++ 12 would see *given read where there is none.
  [[nodiscard, gnu::noinline]] scalar set_step_length(QP const& qp,
                                                      std::optional<scalar> const& given,
                                                      scalar const& factor,
                                                      spectral_bound_options const& spectrum = {}) {
    if (given) {
      step_length = *given;
      return scalar(0);
    }
    auto const safe = safe_gradient_step(qp.a(), x, factor, spectrum);
    step_length = safe.length;
    work.setup_applications += safe.applications;
    return safe.σ;
  }

  /// x = P_Λ(x0), r, r̃, units and scales; step_length is known. True if there is no need to go on:
  /// x is then P_Λ(0), where r̃ = 0.
  /// Throws bad_input if A x0 − b is not finite.
  bool begin(QP const& qp, vector_type const& x0) {
    // What ‖r̃‖ has to be small against: its value at the point of Λ next to 0, wherever the run
    // starts. Not ‖b‖, much of which the constraints may absorb.
    vectors::set_zero(trial);
    place(qp, trial);
    gradient_scale = reduced_gradient_norm;
    // No band of rounding errors: ‖x‖ may be that of blocks which have nothing to do with r̃.
    bool const solved = gradient_scale == scalar(0);
    if (!solved && !at_projection(qp, x0)) place(qp, x0);
    detail::check_finite("A x0 - b", r);

    scalar const length_of_b = norm(qp.b());
    unit = unit_near(std::max<scalar>(length_of_b, norm(r)));
    size_of_b = length_of_b / unit;
    vectors::scale(scalar(1) / unit, r);
    vectors::scale(scalar(1) / unit, reduced);
    return solved;
  }

  /// The same for another b or Λ, in a point that begin has made: units, scales and counts anew.
  /// x0 must not be x.
  bool begin_again(QP const& qp, vector_type const& x0) {
    unit = scalar(1);
    work = {};
    return begin(qp, x0);
  }

  /// r = (A x − b) / unit; one application, none at x = 0.
  void gradient(QP const& qp) {
    gradient_as_given(qp);
    vectors::scale(scalar(1) / unit, r);
  }

  /// The same in a smaller unit, where that of a start far away is so large that products of r
  /// would vanish in it, or r itself: so the unit is chosen before r is brought into it. True if it
  /// is another one from now on.
  bool gradient_and_unit(QP const& qp) {
    gradient_as_given(qp);
    using std::sqrt;
    bool const keeps_digits = size_of_b >= std::numeric_limits<scalar>::min();
    scalar const length_of_b = keeps_digits ? size_of_b * unit : norm(qp.b());
    scalar const size = std::max<scalar>(length_of_b, norm(r));
    bool const is_small = size < sqrt(detail::epsilon<scalar>()) * unit;
    bool const is_other = is_small && size > scalar(0);
    if (is_other) unit = unit_near(size);
    size_of_b = length_of_b / unit;
    vectors::scale(scalar(1) / unit, r);
    return is_other;
  }

  /// P_Λ(x − α̃ r) and r̃.
  void reduce(QP const& qp) {
    reduced_gradient(step_of(qp), x, r, step_length * unit, trial, projected, reduced);
    reduced_gradient_norm = unit * norm(reduced);
  }

  /// P_Λ, or prox_{αφ} for the step length α of the state.
  [[nodiscard]] decltype(auto) step_of(QP const& qp) const {
    return slant::at_step(function_of(qp), step_length);
  }

  /// q(x) / unit = ½ xᵀ(r − b) / unit, and a bound of its rounding error. No product is spent.
  [[nodiscard]] std::pair<scalar, scalar> energy(QP const& qp) {
    vectors::waxpy(-(scalar(1) / unit), qp.b(), r, trial);
    scalar const noise = scalar(16) * detail::epsilon<scalar>() * norm(x);
    return {inner_product(x, trial) / scalar(2), noise * norm(trial)};
  }

  /// Rounding errors that ‖r̃‖ may consist of.
  [[nodiscard]] scalar rounding() const {
    scalar const of_terms = unit * (size_of_b + norm(r)) + norm(x) / step_length;
    return scalar(32) * detail::epsilon<scalar>() * of_terms;
  }

  /// The accuracy reached, for sentences: "relative reduced gradient 1e-15 / 1, …".
  [[nodiscard, gnu::cold]] std::string accuracy() const;

 private:
  /// r = A x − b.
  void gradient_as_given(QP const& qp) {
    since_refresh = 0;
    if (norm(x) == scalar(0)) {
      vectors::negate(qp.b(), r);
      return;
    }
    slant::apply(qp.a(), x, r, a_workspace);
    ++work.operator_applications;
    vectors::subtract(qp.b(), r);
  }
  /// x = P_Λ(y) with its r and r̃.
  void place(QP const& qp, vector_type const& y) {
    slant::project(step_of(qp), slant::local(y), slant::local(x));
    gradient(qp);
    reduce(qp);
  }
  /// Is x = P_Λ(y)?
  [[nodiscard]] bool at_projection(QP const& qp, vector_type const& y) {
    slant::project(step_of(qp), slant::local(y), slant::local(trial));
    vectors::subtract(x, trial);
    return norm(trial) == scalar(0);
  }
};

template <class QP>
std::string gradient_point<QP>::accuracy() const {
  return detail::accuracy_reached(reduced_gradient_norm, gradient_scale, rounding());
}

}  // namespace slant
