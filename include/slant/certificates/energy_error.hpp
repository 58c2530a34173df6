// SPDX-License-Identifier: MIT
//
// How far a point is from the solution, in the energy norm: a bound that needs no knowledge of the
// solution, for
//
//     minimise  q(x) = ½ xᵀA x − bᵀx   over   x ∈ Λ,        A symmetric positive definite.
//
// Let x ∈ Λ, g = A x − b, and x* the solution with g* = A x* − b, e = ‖x − x*‖_A. For every s with
// a finite support value γ = sᵀx + σ_Λ(−s) ≥ 0 and
//
//     e² = (g − g*)ᵀ(x − x*) ≤ gᵀ(x − x*)              −g* is normal to Λ at x*
//        = (g − s)ᵀ(x − x*) + sᵀx − sᵀx*
//        ≤ δ e + γ,                                    δ = ‖g − s‖_{A⁻¹},  −sᵀx* ≤ σ_Λ(−s)
//
// so that   e ≤ ½ (δ + √(δ² + 4γ)).   With s = g this is the square root of the duality gap, with
// −s the normal next to −g it is the reduced gradient in the norm of A⁻¹; normal_part.hpp chooses
// block by block. If only an approximate gradient ĝ with ‖g − ĝ‖_{A⁻¹} ≤ ε is known, δ + ε stands
// for δ.
//
// With a convex function φ in place of the indicator of Λ the same holds for γ = φ(x) + φ*(−s) + sᵀx.
//
// energy_certificate.hpp evaluates it for a quadratic program, contact/certificate.hpp for contact
// with a stiffness matrix; both know when the result is a bound and when it is an estimate.
//
// Where A is only semidefinite the same inequalities hold for d = g − s in the range of A; x* is
// then any solution. What rounding leaves of d outside of the range is not counted: the error is
// that of a program whose b differs by as much.
#pragma once

#include <slant/base/scaling.hpp>
#include <slant/base/vector_algebra.hpp>
#include <slant/certificates/normal_part.hpp>
#include <slant/concepts/bad_input.hpp>
#include <slant/concepts/vector.hpp>
#include <slant/iteration/solve.hpp>
#include <slant/iteration/stopping.hpp>
#include <slant/sets/proximal_step.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <type_traits>
#include <utility>

namespace slant {

/// What is known of ‖x − x*‖_A.
template <class S>
struct energy_error {
  S bound = std::numeric_limits<S>::infinity();  ///< of ‖x − x*‖_A
  S size{0};            ///< ‖x‖_A, what the error is relative to up to the error itself
  bool proven = false;  ///< a bound in floating point; else an estimate

  /// The bound over the energy norm of the solution, of which size − bound is a lower bound, and
  /// size − 2 bound where the bound is estimated: far from the solution the two terms nearly agree,
  /// and an estimate a trifle too small would leave a difference that means nothing. ∞ if nothing
  /// of the solution is known, 0 if the bound is 0.
  [[nodiscard]] S relative() const {
    if (bound == S(0)) return S(0);
    S const least = proven ? S(size - bound) : S(size - S(2) * bound);
    return least > S(0) ? S(bound / least) : std::numeric_limits<S>::infinity();
  }
  /// "energy error at most 3e-10 (proven)".
  [[nodiscard, gnu::cold]] std::string sentence() const {
    return "relative energy error " + detail::show(relative()) +
           (proven ? ", proven" : ", estimated");
  }
};

namespace detail {

/// √(a² + b²) for a, b ≥ 0, without the squares.
template <class S>
[[nodiscard]] S root_of_squares(S const& a, S const& b) {
  using std::sqrt;
  S const larger = a > b ? a : b, smaller = a > b ? b : a;
  if (!(larger > S(0)) || !is_finite(larger)) return a + b;
  S const ratio = smaller / larger;
  return larger * S(sqrt(S(S(1) + ratio * ratio)));
}

}  // namespace detail

/// ½ (δ + √(δ² + 4γ)) from δ and √γ, rounded upwards; NaN if one of them is. γ itself is an energy,
/// which may underflow where its root does not.
template <class S>
[[nodiscard]] S error_bound_of_root(S const& δ, S const& root_of_gap) {
  return (δ + detail::root_of_squares<S>(δ, S(2) * root_of_gap)) / S(2) *
         (S(1) + S(8) * std::numeric_limits<S>::epsilon());
}

/// d = g − s for all blocks of Λ at x, with the root of the sum of the gaps; m holds the stiffness
/// of each component, of the size of diag(A⁻¹), ∞ where nothing resists. d may be g. Whether every
/// gap is free of cancellation is known from the type: `exact`.
template <class S>
struct balanced_gradient {
  S root_of_gap{0};
  bool exact = true;
};

template <class C, class X, class G, class M, class D>
[[nodiscard]] auto balance(C const& set, X const& x, G const& g, M const& m, D& d)
    -> balanced_gradient<scalar_t<X>> {
  using S = scalar_t<X>;
  using std::sqrt;
  balanced_gradient<S> result;
  index terms = 0;
  if constexpr (std::is_same_v<G, D>) {
    if (&g != &d) vectors::copy(g, d);
  } else {
    vectors::copy(g, d);
  }
  // Gaps are summed in units in which g is near 1, as they are products of x and g.
  S const unit = unit_near(slant::norm(d));
  S gaps(0);
  slant::visit_blocks(set, [&](auto const& block, auto const& p) {
    using block_type = std::remove_cvref_t<decltype(block)>;
    if constexpr (!whole_space<block_type>) {
      S ρ(0);
      for (index j = 0; j < p.size(); ++j) ρ += slant::local(m).coeff(p.component(j));
      ρ /= S(2 * p.size());
      // A function is in units of x and g; a set knows none of g.
      S const u = function_part<block_type> ? S(1) : unit;
      auto own = p.value(d);
      own /= u;
      auto part = split_gradient(block, p.value(x), own, S(ρ * u));
      part.rest *= u;
      part.gap *= u / unit;
      p.put(d, part.rest);
      gaps += part.gap;
      ++terms;
      if constexpr (!has_exact_normal_part<block_type>) result.exact = false;
    }
  });
  S const ε = std::numeric_limits<S>::epsilon();
  result.root_of_gap = sqrt(gaps) * sqrt(unit) * (S(1) + S(terms + 64) * ε);
  return result;
}

// --- below ---------------------------------------------------------------------------------------
//
// The stopping rule on the error itself: ‖x − x*‖_A ≤ tolerance · ‖x*‖_A as far as a certificate
// shows it, for any method.
//
//     auto const certificate = slant::energy_certificate(qp, M);
//     slant::solve(method, x0, slant::energy_error_below(1e-8, certificate) ||
//     slant::at_most(500));
//
// A certificate costs about as much as a step, so it is asked only where it may say yes: when the
// quantity that the method watches anyway (reduced gradient, residual, step; relative; with the
// violation of equality constraints, if there are any) has fallen to the tolerance, and after a no
// when that has fallen by the factor that was missing. A method that ends by itself is judged too:
// `converged` becomes `stalled` where the certificate disagrees, with the error reached in the
// reason.

/// certificate(x) → energy_error<S>.
template <class Certificate, class V>
concept certifies = requires(Certificate& c, V const& x) {
  { c(x).relative() <= c(x).bound };
};

namespace detail {

/// The quantity that the method watches anyway, relative; 0 if it has none.
template <class S, class State>
[[nodiscard]] S watched_measure(State const& s) {
  auto const ratio = [](auto const& size, auto const& scale) {
    return scale > std::remove_cvref_t<decltype(scale)>(0) ? S(size / scale) : S(0);
  };
  if constexpr (has_reduced_gradient_norm<State> && has_feasibility_norm<State>) {
    return std::max<S>(ratio(s.reduced_gradient_norm, s.gradient_scale),
                       ratio(s.feasibility_norm, s.feasibility_scale));
  } else if constexpr (has_reduced_gradient_norm<State>) {
    return ratio(s.reduced_gradient_norm, s.gradient_scale);
  } else if constexpr (has_residual_norm<State>) {
    return ratio(s.residual_norm, s.residual_scale);
  } else if constexpr (has_step_norm<State>) {
    return ratio(s.step_norm, s.x_norm);
  } else {
    return S(0);
  }
}

/// By what factor that should fall after an error that is too large. Not beyond a hundredth: far
/// from the solution the two have little to do with each other.
template <class S>
[[nodiscard]] S missing_factor(S const& tolerance, S const& error) {
  S const missing = tolerance / error;
  return missing > S(0.01) ? S(missing / S(2)) : S(0.01);
}

}  // namespace detail

/// The rule at the top of this file; the certificate is kept as the library keeps parts. The
/// relative error is that of the last certificate: `error()`.
template <class S, class Certificate>
class energy_error_below : public rule {
 public:
  energy_error_below(S tolerance, Certificate certificate)
      : tolerance_(detail::checked_tolerance(tolerance)),
        threshold_(tolerance),
        certificate_(std::move(certificate)) {}

  template <class State>
    requires certifies<Certificate, std::remove_cvref_t<decltype(std::declval<State>().x)>>
  status operator()(State const& s) {
    S const measure = detail::watched_measure<S>(s);
    bool const at_rest = s.status != status::running;
    if (!at_rest && !(measure <= threshold_)) return status::running;
    if (s.status == status::unbounded) return s.status;  // its direction has been confirmed
    error_ = certificate_(s.x);
    S const relative = error_.relative();
    if (relative <= tolerance_) return status::converged;
    if (at_rest) return s.status == status::converged ? status::stalled : s.status;
    threshold_ = measure * detail::missing_factor<S>(tolerance_, relative);
    return status::running;
  }
  template <class State>
  [[gnu::cold]] std::string reason(State const& s) const {
    if (s.status == status::unbounded) return detail::own_words(s);
    return error_.sentence() + (error_.relative() <= tolerance_ ? ", at most " : "; asked was ") +
           detail::show(tolerance_);
  }
  /// What the last certificate said.
  [[nodiscard]] energy_error<S> const& error() const { return error_; }

 private:
  S tolerance_;
  S threshold_;
  Certificate certificate_;
  energy_error<S> error_{};
};

}  // namespace slant
