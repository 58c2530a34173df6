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
// −s the normal next to −g it is the reduced gradient in the norm of A⁻¹; normal_part chooses
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

#include <slant/base/double_word.hpp>
#include <slant/base/scaling.hpp>
#include <slant/base/vector_algebra.hpp>
#include <slant/concepts/bad_input.hpp>
#include <slant/concepts/scalar.hpp>
#include <slant/concepts/vector.hpp>
#include <slant/iteration/solve.hpp>
#include <slant/iteration/stopping.hpp>
#include <slant/sets/ball.hpp>
#include <slant/sets/blocks.hpp>
#include <slant/sets/interval.hpp>
#include <slant/sets/proximal_step.hpp>
#include <slant/sets/support.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <string>
#include <type_traits>
#include <utility>

namespace slant {

// --- normal part ---------------------------------------------------------------------------------
//
// The part of a gradient that the constraints balance, block by block.
//
// At x ∈ Λᵢ with the gradient g = (A x − b)ᵢ, any s with a finite support value splits g into
//
//     s,  balanced up to the gap  γ = sᵀx + σ(−s) ≥ 0,      and the rest  d = g − s,
//
// γ = 0 exactly if −s is normal to Λᵢ at x. Both enter the bound of the error
// as m‖d‖² + 4γ, m > 0 the stiffness of the block, the size of A⁻¹ there. Least is the value for
//
//     s = (p − z)/ρ,   z = x − ρ g,   p = P(z),   ρ = m/2,
//
// because 0 ∈ ∂ₛ(m‖g − s‖² + 4 sᵀx + 4 σ(−s)) says x − ρ g + ρ s ∈ ∂σ(−s), and that is p = P(z).
// (With s = g, the duality gap, the bound is the root of a difference of energies; with the nearest
// normal, m → 0, it is the reduced gradient alone. This choice is between the two, block by block.)
//
// Half lines, intervals, balls, points and free blocks evaluate γ without cancellation: s = g − d
// is exact for the computed d on the line, where γ has a relative error of 3ε. On a ball let s be
// the exact multiple, by the computed t, of the exact −z/‖z‖: then d is off by at most 20 ε|g|, and
// the sine between x and z, or 1 − cos inside, by rounding that is added to it. x counts as the
// point of the boundary next to it where it lies there up to rounding: off by less than 9 ε‖x‖,
// of which what no projection leaves, above 2 ε‖x‖, stays in d as the energy of the way there. Any
// other set with a projection gets γ = sᵀ(x − p), where the rounding errors of P remain.
//
// For a function φ in place of the indicator γ = φ(x) + φ*(−s) + sᵀx. The least value belongs to the
// subgradient −s = (z − p)/ρ, p = prox_{ρφ}(z); of a support function that is the point P_Λ(z/ρ), so
// that φ* is 0 there and γ = σ(x) + sᵀx.

/// How the gradient of one block splits.
template <class S, int N>
struct normal_part {
  Eigen::Matrix<S, N, 1> rest;  ///< d = g − s
  S gap{0};                     ///< γ ≥ 0
};

namespace detail {

/// g against one flat bound at the distance h ≥ 0 in the direction of −g; g ≥ 0.
template <class S>
[[nodiscard]] normal_part<S, 1> against_bound(S const& g, S const& h, S const& ρ) {
  normal_part<S, 1> part;
  S const lost = h > S(0) ? S(h / ρ) : S(0);  // an infinite ρ takes all of g
  S const s = lost < g ? S(g - lost) : S(0);
  part.rest(0) = s > S(0) ? lost : g;
  part.gap = s > S(0) && h > S(0) ? S(s * h) : S(0);
  return part;
}

/// g on [l, u] at x.
template <class S>
[[nodiscard]] normal_part<S, 1> between_bounds(S const& x, S const& g, S const& l, S const& u,
                                               S const& ρ) {
  bool const down = g >= S(0);  // −g points at l
  S const h = down ? S(x - l) : S(u - x);
  auto part = against_bound<S>(down ? g : S(-g), h > S(0) ? h : S(0), ρ);
  if (!down) part.rest(0) = -part.rest(0);
  return part;
}

/// Does x count as a point of the sphere ‖x‖ = R?
template <class S, int N>
[[nodiscard]] bool is_on_sphere(Eigen::Matrix<S, N, 1> const& x, S const& R) {
  using std::abs;
  Eigen::Matrix<S, N, 1> const e = x / R;
  return abs(S(e.stableNorm()) - S(1)) <= S(9) * detail::epsilon<S>();
}

/// g on the ball ‖x‖ ≤ R.
template <class S, int N>
[[nodiscard]] normal_part<S, N> in_ball(Eigen::Matrix<S, N, 1> const& x,
                                        Eigen::Matrix<S, N, 1> const& g, S const& R, S const& ρ) {
  using point = Eigen::Matrix<S, N, 1>;
  normal_part<S, N> part;
  part.rest = g;
  S const force = g.stableNorm();
  if (R == S(0)) {
    part.rest.setZero();
    return part;
  }
  if (!is_finite(R) || !(force > S(0)) || !is_finite(force)) return part;
  if (!is_finite(ρ)) {  // all of g is balanced
    part.rest.setZero();
    part.gap = x.dot(g) + R * force;
    return part;
  }
  using std::abs;
  // In units of R and of R/ρ, in which no square leaves the range.
  point const e = x / R, h = g * (ρ / R);
  S const length = e.stableNorm();
  bool const on_sphere = is_on_sphere<S, N>(x, R);
  point const n = on_sphere ? point(e / length) : e;
  point const z = n - h;
  S const size = z.stableNorm();
  if (!(size > S(1)) || !is_finite(size)) return part;
  // t = ‖z‖ − 1 from ‖z‖² − 1 = (‖n‖² − 1) − 2 nᵀh + ‖h‖².
  S const inner = on_sphere ? S(0) : S((length - S(1)) * (length + S(1)));
  S const t =
      size > S(4) ? S(size - S(1)) : S((inner - S(2) * n.dot(h) + h.squaredNorm()) / (size + S(1)));
  if (!(t > S(0))) return part;
  point const direction = z / size;  // −s = (R/ρ) t direction
  part.rest = (R / ρ) * (h + t * direction);
  S const off = length - S(1), rounding = S(2) * detail::epsilon<S>();
  if (on_sphere && abs(off) > rounding) part.rest += (R / ρ) * (off / S(2)) * n;
  // γ = (R²/ρ) t (1 − nᵀz/‖z‖); on the sphere the bracket is sin²/(1 + cos) of the angle, which
  // comes from the tangential part of h.
  S const cosine = n.dot(direction);
  S const eps = detail::epsilon<S>();
  S bracket = S(1) - cosine + S(8) * eps;
  if (on_sphere && cosine > S(0)) {
    S const sine = ((h - n.dot(h) * n).stableNorm() + S(16) * eps * h.stableNorm()) / size;
    bracket = sine * sine / (S(1) + cosine);
  }
  part.gap = bracket > S(0) ? S(R * ((R / ρ) * t) * bracket) : S(0);
  return part;
}

}  // namespace detail

/// x̂ − x for the point x̂ of the sphere ‖x̂‖ = R that x counts as, to a relative accuracy of some ε;
/// 0 for points inside, and on intervals, which have exact ends.
template <class S, int N>
[[nodiscard]] Eigen::Matrix<S, N, 1> to_sphere(Eigen::Matrix<S, N, 1> const& x, S const& R) {
  using point = Eigen::Matrix<S, N, 1>;
  if (N == 1 || !(R > S(0)) || !detail::is_finite(R) || !detail::is_on_sphere<S, N>(x, R)) {
    return point::Zero(x.size());
  }
  S const unit = unit_near(R), r = R / unit;
  point const e = x / unit;
  detail::double_word<S> missing = detail::exact_product<S>(r, r);
  for (index i = 0; i < e.size(); ++i) missing = missing - detail::exact_product<S>(e(i), e(i));
  S const length = e.stableNorm();
  return x * (missing.hi / (length * (r + length)));
}

/// Blocks whose gap is evaluated without cancellation, so that a bound made of it is one.
template <class Block>
inline constexpr bool has_exact_normal_part = whole_space<Block> || single_point<Block>;
template <class S>
inline constexpr bool has_exact_normal_part<half_line<S>> = true;
template <class S>
inline constexpr bool has_exact_normal_part<interval<S>> = true;
template <class S>
inline constexpr bool has_exact_normal_part<symmetric_interval<S>> = true;
template <int N, class S>
inline constexpr bool has_exact_normal_part<ball<N, S>> = true;

namespace detail {

/// σ(x) − vᵀx ≥ 0 for v ∈ Λ.
template <class Block, class S, int N>
[[nodiscard]] S support_gap(Block const& block, Eigen::Matrix<S, N, 1> const& x,
                            Eigen::Matrix<S, N, 1> const& v) {
  if ((x.array() == S(0)).all()) return S(0);
  if constexpr (N > 1 && std::same_as<Block, ball<N, S>>) {
    // ‖x‖ R (1 − eᵀn s) for x = ‖x‖ e, v = R s n, without cancellation: ½‖e − s n‖² + ½(1 − s²).
    S const length = x.stableNorm(), R = block.radius();
    if (R == S(0)) return S(0);
    Eigen::Matrix<S, N, 1> const sn = v / R, off = x / length - sn;
    S const s = sn.stableNorm(), missing = (S(1) - s) * (S(1) + s);
    S const rounding = S(8) * detail::epsilon<S>();
    return R * length * (off.squaredNorm() + (missing > rounding ? missing : S(0))) / S(2);
  } else {
    S const value = block.support(x);
    S const noise = S(32) * detail::epsilon<S>() * x.stableNorm() * v.stableNorm();
    S const gap = value - v.dot(x);
    return gap > noise || !is_finite(gap) ? gap : S(0);
  }
}

}  // namespace detail

/// d and γ at x with the gradient g for a block of a support function; ρ = m/2 > 0, also ∞.
template <class C, class S, int N>
[[nodiscard]] normal_part<S, N> split_gradient(support_function<C> const& block,
                                               Eigen::Matrix<S, N, 1> const& x,
                                               Eigen::Matrix<S, N, 1> const& g, S const& ρ) {
  Eigen::Matrix<S, N, 1> z = -g;
  if (detail::is_finite(ρ)) z += x / ρ;
  Eigen::Matrix<S, N, 1> const v = slant::project(block.part(), z);
  return {g + v, detail::support_gap<std::remove_cvref_t<C>, S, N>(block.part(), x, v)};
}

/// The same for a block of any function, from its proximal map and its values.
template <function_part Block, class S, int N>
[[nodiscard]] normal_part<S, N> split_gradient(Block const& block, Eigen::Matrix<S, N, 1> const& x,
                                               Eigen::Matrix<S, N, 1> const& g, S const& given) {
  S const ρ = detail::is_finite(given) ? given : S(1);  // every ρ has its subgradient
  Eigen::Matrix<S, N, 1> const z = x - ρ * g;
  Eigen::Matrix<S, N, 1> const p = slant::prox(block, ρ, z), v = (z - p) / ρ;
  using std::abs;
  S const at_x = block.value(x), at_p = block.value(p);
  // φ*(v) = vᵀp − φ(p).
  S const gap = at_x - at_p - v.dot(x - p);
  S const noise = S(32) * detail::epsilon<S>() *
                  (abs(at_x) + abs(at_p) + v.stableNorm() * (x.stableNorm() + p.stableNorm()));
  return {(x - p) / ρ, gap > noise || !detail::is_finite(gap) ? gap : S(0)};
}

/// d and γ at x ∈ block with the gradient g; ρ = m/2 > 0, also ∞.
template <class Block, class S, int N>
  requires(!function_part<Block>)
[[nodiscard]] normal_part<S, N> split_gradient(Block const& block, Eigen::Matrix<S, N, 1> const& x,
                                               Eigen::Matrix<S, N, 1> const& g, S const& ρ) {
  if constexpr (whole_space<Block>) {
    return {g, S(0)};
  } else if constexpr (single_point<Block>) {
    return {Eigen::Matrix<S, N, 1>::Zero(), S(0)};
  } else if constexpr (requires { block.lower(), block.upper(); }) {
    return detail::between_bounds<S>(x(0), g(0), block.lower(), block.upper(), ρ);
  } else if constexpr (std::same_as<Block, half_line<S>>) {
    return detail::between_bounds<S>(x(0), g(0), block.lower(), detail::infinity<S>(), ρ);
  } else if constexpr (std::same_as<Block, ball<N, S>> && N == 1) {
    return detail::between_bounds<S>(x(0), g(0), -block.radius(), block.radius(), ρ);
  } else if constexpr (std::same_as<Block, ball<N, S>>) {
    return detail::in_ball<S, N>(x, g, block.radius(), ρ);
  } else {
    if (!detail::is_finite(ρ)) return {g, S(0)};
    Eigen::Matrix<S, N, 1> const z = x - ρ * g;
    Eigen::Matrix<S, N, 1> const p = slant::project(block, z);
    Eigen::Matrix<S, N, 1> const s = (p - z) / ρ;
    // What rounding leaves of x − p where both are the same point of the boundary is no gap.
    S const noise =
        S(32) * detail::epsilon<S>() * s.stableNorm() * (x.stableNorm() + p.stableNorm());
    S const gap = s.dot(x - p);
    return {(x - p) / ρ, gap > noise ? gap : S(0)};
  }
}

/// What is known of ‖x − x*‖_A.
template <class S>
struct energy_error {
  S bound = detail::infinity<S>();  ///< of ‖x − x*‖_A
  S size{0};            ///< ‖x‖_A, what the error is relative to up to the error itself
  bool proven = false;  ///< a bound in floating point; else an estimate

  /// The bound over the energy norm of the solution, of which size − bound is a lower bound, and
  /// size − 2 bound where the bound is estimated: far from the solution the two terms nearly agree,
  /// and an estimate a trifle too small would leave a difference that means nothing. ∞ if nothing
  /// of the solution is known, 0 if the bound is 0.
  [[nodiscard]] S relative() const {
    if (bound == S(0)) return S(0);
    S const least = proven ? S(size - bound) : S(size - S(2) * bound);
    return least > S(0) ? S(bound / least) : detail::infinity<S>();
  }
  /// "relative energy error 3e-10, proven"; where that is infinite, as where x* = 0, with both sizes.
  [[nodiscard, gnu::cold]] std::string sentence() const {
    auto said = "relative energy error " + detail::brief(relative());
    if (!detail::is_finite(relative()) && detail::is_finite(bound)) {
      said +=
          " (" + detail::brief(bound) + " at a point of energy norm " + detail::brief(size) + ")";
    }
    return said + (proven ? ", proven" : ", estimated");
  }
};

/// The error of x from an estimate of it and what rounding the entries of x is worth in the energy
/// norm, ε/2 √(Σ aᵢᵢ xᵢ²); load = √(Σ bᵢ²/aᵢᵢ). Unless A is `definite` x may be far out in its
/// kernel, where xᵀA x and what is relative to it are rounding errors: nothing is known then. A
/// point without energy of which no error is known but the rounding is the solution.
template <class S>
[[nodiscard]] energy_error<S> estimated_error(bool definite, S const& size, S const& load,
                                              S const& estimate, S const& rounding) {
  using std::sqrt;
  S const beside = size > S(0) ? size : load;
  bool const is_far = beside > S(0) && S(8) / sqrt(detail::epsilon<S>()) * rounding >= beside;
  if (!definite && is_far) return {.size = size};
  if (size == S(0) && estimate == S(0)) return {.bound = S(0)};
  return {.bound = S(estimate + rounding), .size = size};
}

/// ½ (δ + √(δ² + 4γ)) from δ and √γ, rounded upwards; NaN if one of them is. γ itself is an energy,
/// which may underflow where its root does not.
template <class S>
[[nodiscard]] S error_bound_of_root(S const& δ, S const& root_of_gap) {
  return (δ + detail::root_of_squares<S>(δ, S(2) * root_of_gap)) / S(2) *
         (S(1) + S(8) * detail::epsilon<S>());
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
      // What nothing resists and nothing pulls says nothing of the others.
      S ρ(0);
      index count = 0;
      for (index j = 0; j < p.size(); ++j) {
        S const entry = slant::local(m).coeff(p.component(j));
        if (!detail::is_finite(entry) && slant::local(d).coeff(p.component(j)) == S(0)) continue;
        ρ += entry;
        ++count;
      }
      ρ = count > 0 ? S(ρ / S(2 * count)) : detail::infinity<S>();
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
  S const ε = detail::epsilon<S>();
  result.root_of_gap =
      sqrt(slant::total(d, gaps)) * sqrt(unit) * (S(1) + (slant::total(d, S(terms)) + S(64)) * ε);
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

/// certificate(x) → energy_error<S>, or certificate(x, ν) for states with a multiplier of equations
/// (constrained_certificate.hpp).
template <class Certificate, class V>
concept certifies = requires(Certificate& c, V const& x) {
  { c(x).relative() <= c(x).bound };
};
template <class Certificate, class State>
concept certifies_with_multiplier = requires(Certificate& c, State const& s) {
  { c(s.x, s.ν).relative() <= c(s.x, s.ν).bound };
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
    requires certifies<Certificate, std::remove_cvref_t<decltype(std::declval<State>().x)>> ||
             certifies_with_multiplier<Certificate, State>
  status operator()(State const& s) {
    S const measure = detail::watched_measure<S>(s);
    bool const at_rest = s.status != status::running;
    if (!at_rest && !(measure <= threshold_)) return status::running;
    if (s.status == status::unbounded) return s.status;  // its direction has been confirmed
    if constexpr (certifies<Certificate, std::remove_cvref_t<decltype(s.x)>>) {
      error_ = certificate_(s.x);
    } else {
      error_ = certificate_(s.x, s.ν);
    }
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
