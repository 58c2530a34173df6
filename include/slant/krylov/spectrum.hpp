// SPDX-License-Identifier: MIT
//
// What products by a self-adjoint semidefinite operator tell of its spectrum: the largest
// eigenvalue, from above, and the mean of all.
//
// σ_max. k Lanczos steps from a random vector give a Ritz value θ ≤ σ_max. Kuczyński and Woźniakowski
// (SIAM J. Matrix Anal. Appl. 13, 1992, Theorem 4.2) bound the probability that it is much too
// small:
//
//     P[ θ < (1 − ε) σ_max ]  ≤  1.648 √n exp(−√ε (2k − 1)),
//
// whatever the spectrum. So with √ε = log(1.648 √n / δ) / (2k − 1) the number θ / (1 − ε) is an
// upper bound except with probability δ. Why not power iteration: its bound decays like 1/k, not
// exponentially. Why not θ + ‖residual‖: it guarantees that *an* eigenvalue is near θ, not the
// largest one.
//
// mean(diag A) is the mean of the eigenvalues: the size of A that a typical direction feels, where
// σ_max is what the worst one does. Exact if the operator gives its diagonal; else Hutchinson's
// estimate [Hutchinson 1990],
//
//     mean(diag A) ≈ mean over k random vectors v of ±1 of vᵀA v / n,
//
// unbiased, with the variance 2 Σ_{i≠j} a_ij² / (k n²): for a method that wants the order of
// magnitude a few products do.
#pragma once

#include <slant/base/vector_algebra.hpp>
#include <slant/concepts/bad_input.hpp>
#include <slant/concepts/capabilities.hpp>
#include <slant/concepts/linear_operator.hpp>
#include <slant/concepts/random.hpp>
#include <slant/concepts/scalar.hpp>
#include <slant/concepts/vector.hpp>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace slant::detail {

// --- tridiagonal eigenvalue ----------------------------------------------------------------------
//
// The extreme eigenvalues of a small symmetric tridiagonal matrix, by bisection on its Sturm
// sequence [Barth, Martin, Wilkinson 1967]: λ exceeds all eigenvalues if and only if all pivots of
// the LDLᵀ factorisation of T − λ I are negative. Backward stable in any scalar, and the bound errs
// on the safe side: the upper end of the last interval is returned.

/// Are all eigenvalues of the matrix with diagonal a and off-diagonal b smaller than λ?
template <class S>
[[nodiscard]] bool all_eigenvalues_below(S const& λ, std::vector<S> const& a,
                                         std::vector<S> const& b) {
  S pivot = a[0] - λ;
  for (std::size_t i = 1; pivot < S(0) && i < a.size(); ++i) {
    pivot = a[i] - λ - b[i - 1] * (b[i - 1] / pivot);
  }
  return pivot < S(0);
}

/// Largest eigenvalue of the matrix with diagonal a (n ≥ 1 entries) and off-diagonal b (n − 1
/// entries), to a few ε of the largest entry, never too small by more than the rounding of T.
template <class S>
[[nodiscard]] S largest_tridiagonal_eigenvalue(std::vector<S> const& a, std::vector<S> const& b) {
  using std::abs;
  S lower = a[0], upper = a[0], size(0);  // λ_max is at least a_ii and at most Gershgorin's bound
  for (std::size_t i = 0; i < a.size(); ++i) {
    S radius(0);
    if (i > 0) radius += abs(b[i - 1]);
    if (i + 1 < a.size()) radius += abs(b[i]);
    lower = std::max<S>(lower, a[i]);
    upper = std::max<S>(upper, S(a[i] + radius));
    size = std::max<S>(size, S(abs(a[i]) + radius));
  }
  S const resolution = detail::epsilon<S>() * size;
  while (upper - lower > resolution) {
    S const middle = lower + (upper - lower) / S(2);
    if (!(lower < middle && middle < upper)) break;
    (all_eigenvalues_below(middle, a, b) ? upper : lower) = middle;
  }
  return upper;
}

/// Smallest eigenvalue of the same matrix, never too large by more than the rounding of T.
template <class S>
[[nodiscard]] S smallest_tridiagonal_eigenvalue(std::vector<S> a, std::vector<S> const& b) {
  for (auto& e : a) e = -e;  // −T has the off-diagonal −b, whose signs change no eigenvalue
  return -largest_tridiagonal_eigenvalue(a, b);
}

}  // namespace slant::detail

namespace slant {

/// Result of largest_eigenvalue_bound.
template <class S>
struct spectral_bound {
  S upper;             ///< σ_max ≤ upper, except with the probability asked for
  S ritz;              ///< the largest Ritz value, σ_max ≥ ritz
  S smallest_ritz;     ///< the smallest one, σ_min ≤ smallest_ritz up to rounding; not below 0
  index applications;  ///< products spent
};

/// How hard to try.
struct spectral_bound_options {
  index steps = 60;                 ///< Lanczos steps; more if failure is so small that it takes
                                    ///< them, at most n; each is one product
  double failure = 1e-10;           ///< δ, probability that the bound is not one
  unsigned long long seed = 20161;  ///< of the start vector; the same seed gives the same bound.
                                    ///< A distributed vector wants another one on each process

  [[gnu::cold]] void validate() const {
    if (steps < 2) throw bad_input("steps", detail::show(steps), "at least 2 Lanczos steps");
    detail::check_option("failure", failure, failure > 0 && failure < 1, "a probability in (0, 1)");
  }
};

/// Upper bound of the largest eigenvalue of A, for vectors like `prototype`.
/// Throws bad_input if A x is not finite, or if it shows that A is not semidefinite.
template <class A, class V>
  requires psd_operator<A, V>
[[nodiscard, gnu::cold]] auto largest_eigenvalue_bound(A const& a, V const& prototype,
                                                       spectral_bound_options const& options = {})
    -> spectral_bound<scalar_t<V>> {
  using S = scalar_t<V>;
  options.validate();
  index const here = slant::local(prototype).size(), n = slant::global_size(prototype);
  if (n == 0) return {S(0), S(0), S(0), 0};

  V q = like(prototype, here), w = like(prototype, here), previous = like(prototype, here);
  auto temporaries = workspace(a, prototype);
  detail::normal_numbers gaussian(options.seed);
  for (index i = 0; i < here; ++i) slant::local(q).coeffRef(i) = S(gaussian());
  vectors::divide(norm(q), q);
  vectors::set_zero(previous);

  std::vector<S> diagonal, off_diagonal;
  auto const ε = detail::epsilon<S>();
  // ε ≤ 3/4 wants so many steps at least; with fewer the bound would be more than four times θ.
  double const doubt = std::log(1.648 * std::sqrt(double(n)) / options.failure);
  auto const least = index(std::ceil((doubt / std::sqrt(0.75) + 1) / 2));
  auto const steps = std::min(std::max(options.steps, least), n);
  S scale(0);
  bool exhausted = false;  // an invariant subspace was found: θ is exact
  for (index k = 0; k < steps && !exhausted; ++k) {
    slant::apply(a, q, w, temporaries);
    S const α = inner_product(q, w);
    if (!detail::is_finite(α)) {
      throw bad_input("A", detail::show(α), "finite values of xᵀA x for finite x");
    }
    diagonal.push_back(α);
    vectors::axpy(-α, q, w);
    if (k > 0) vectors::axpy(-off_diagonal.back(), previous, w);
    S const β = norm(w);
    using std::abs;
    scale = std::max<S>(scale, std::max<S>(abs(α), β));
    exhausted = !(β > S(16) * ε * scale);  // noise that passes moves eigenvalues by noise only
    if (exhausted || k + 1 == steps) break;
    off_diagonal.push_back(β);
    vectors::copy(q, previous);
    vectors::copy(w, q);
    vectors::divide(β, q);
  }
  S const θ = detail::largest_tridiagonal_eigenvalue(diagonal, off_diagonal);
  auto const k = index(diagonal.size());
  S const rounding = S(1) + S(4 * std::max<index>(n, 4)) * ε;
  if (θ < S(0)) throw bad_input("A", detail::show(θ), "a positive semidefinite operator");
  S const θ_min =
      std::max<S>(detail::smallest_tridiagonal_eigenvalue(diagonal, off_diagonal), S(0));
  if (exhausted || k == n) return {θ * rounding, θ, θ_min, k};
  double const root = doubt / double(2 * k - 1);
  return {θ * rounding / S(1 - root * root), θ, θ_min, k};
}

namespace detail {

/// Throws bad_input unless a step length, from `what` of A, is a finite number > 0.
template <class S>
void check_step_length(S const& length, char const* what, S const& of_a) {
  if (length > S(0) && is_finite(length)) return;
  throw bad_input("A", std::string(what) + " " + show(of_a),
                  "one whose reciprocal is a finite number > 0");
}

}  // namespace detail

// --- gradient step -------------------------------------------------------------------------------
//
// A safe step of the gradient method x ← P_Λ(x − α r). Every α ∈ (0, 2/σ_max) decreases
// q(x) = ½ xᵀA x − bᵀx. I − α A contracts best with α = 2/(σ_max + σ_min); steps close to 2/σ_max
// are better still where A is ill-conditioned, for few components of r belong to its largest
// eigenvalues.

/// Result of safe_gradient_step.
template <class S>
struct gradient_step {
  S length;            ///< α
  S σ;                 ///< σ_max to a few digits, from below
  index applications;  ///< products spent
};

/// α = min(factor, 2/(1 + θ_min/θ_max)) / (upper bound of σ_max), θ the extreme Ritz values.
/// 1 if A = 0. Throws bad_input if 1/σ_max is not a finite number > 0, or as the bound does.
template <class A, class V>
[[nodiscard]] auto safe_gradient_step(A const& a, V const& prototype, scalar_t<V> factor,
                                      spectral_bound_options const& options = {})
    -> gradient_step<scalar_t<V>> {
  using S = scalar_t<V>;
  auto const bound = largest_eigenvalue_bound(a, prototype, options);
  if (bound.upper == S(0)) return {S(1), S(0), bound.applications};
  S const best = S(2) / (S(1) + bound.smallest_ritz / bound.ritz);
  S const length = std::min<S>(factor, best) / bound.upper;
  detail::check_step_length(length, "largest eigenvalue", bound.upper);
  return {length, bound.ritz, bound.applications};
}

/// Result of mean_diagonal.
template <class S>
struct diagonal_mean {
  S value;             ///< ≥ 0, in units of A
  index applications;  ///< products spent
};

/// How to estimate it, if it must be estimated.
struct mean_diagonal_options {
  index samples = 6;                ///< random vectors, each is one product
  unsigned long long seed = 19905;  ///< the same seed gives the same estimate. A distributed vector
                                    ///< wants another one on each process

  [[gnu::cold]] void validate() const {
    if (samples < 1) throw bad_input("samples", detail::show(samples), "a number >= 1");
  }
};

namespace detail {

/// Mean of diag(A), which rounding may leave below 0.
template <class A, class V>
[[nodiscard]] auto estimated_mean_diagonal(A const& a, V const& prototype,
                                           mean_diagonal_options const& options)
    -> diagonal_mean<scalar_t<V>> {
  using S = scalar_t<V>;
  index const here = slant::local(prototype).size(), n = slant::global_size(prototype);
  if (n == 0) return {S(0), 0};
  V v = like(prototype, here), image = like(prototype, here);
  S sum(0);
  index applications = 0;
  if (slant::diagonal_if_known(a, image)) {
    vectors::fill(S(1), v);
    sum = inner_product(v, image);
  } else {
    auto temporaries = workspace(a, prototype);
    random_bits bits(options.seed);
    for (; applications < options.samples; ++applications) {
      for (index i = 0; i < here; ++i) {
        slant::local(v).coeffRef(i) = bits.coin() ? S(1) : S(-1);
      }
      slant::apply(a, v, image, temporaries);
      sum += inner_product(v, image);
    }
  }
  return {sum / S(applications > 0 ? applications * n : n), applications};
}

/// Throws bad_input for a mean that is not finite or below −noise.
template <class S>
void check_mean_diagonal(S const& mean, S const& noise = S(0)) {
  if (mean >= -noise && is_finite(mean)) return;
  throw bad_input("A", "mean of the diagonal " + show(mean), "a finite number >= 0");
}

}  // namespace detail

/// Mean of diag(A), for vectors like `prototype`. Throws bad_input if it is not finite or negative.
template <class A, class V>
  requires psd_operator<A, V>
[[nodiscard]] auto mean_diagonal(A const& a, V const& prototype,
                                 mean_diagonal_options const& options = {})
    -> diagonal_mean<scalar_t<V>> {
  options.validate();
  auto const mean = detail::estimated_mean_diagonal(a, prototype, options);
  detail::check_mean_diagonal(mean.value);
  return mean;
}

/// Result of mean_step.
template <class S>
struct mean_step_length {
  S length;            ///< in units of 1/A
  index applications;  ///< products spent
};

/// factor / mean(diag A), 1 if that is zero. Throws bad_input if it is not a finite number > 0, or
/// as mean_diagonal does.
template <class A, class V>
[[nodiscard]] auto mean_step(A const& a, V const& prototype, scalar_t<V> const& factor,
                             mean_diagonal_options const& options = {})
    -> mean_step_length<scalar_t<V>> {
  using S = scalar_t<V>;
  auto const mean = mean_diagonal(a, prototype, options);
  S const length = mean.value > S(0) ? S(factor / mean.value) : S(1);
  detail::check_step_length(length, "mean of the diagonal", mean.value);
  return {length, mean.applications};
}

}  // namespace slant
