// SPDX-License-Identifier: MIT
//
// A safe upper bound of σ_max(A), the largest eigenvalue of a self-adjoint semidefinite operator.
//
// k Lanczos steps from a random vector give a Ritz value θ ≤ σ_max. Kuczyński and Woźniakowski
// (SIAM J. Matrix Anal. Appl. 13, 1992, Theorem 4.2) bound the probability that it is much too
// small:
//
//     P[ θ < (1 − ε) σ_max ]  ≤  1.648 √n exp(−√ε (2k − 1)),
//
// whatever the spectrum. So with √ε = log(1.648 √n / δ) / (2k − 1) the number θ / (1 − ε) is an
// upper bound except with probability δ. Why not power iteration: its bound decays like 1/k, not
// exponentially. Why not θ + ‖residual‖: it guarantees that *an* eigenvalue is near θ, not the
// largest one.
#pragma once

#include <slant/concepts/checks.hpp>
#include <slant/concepts/distributed.hpp>
#include <slant/concepts/linear_operator.hpp>
#include <slant/concepts/random.hpp>
#include <slant/concepts/vector_algebra.hpp>
#include <slant/krylov/tridiagonal_eigenvalue.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

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
    if (!(failure > 0 && failure < 1)) {
      throw bad_input("failure", detail::show(failure), "a probability in (0, 1)");
    }
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
  using std::sqrt;
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
  auto const ε = std::numeric_limits<S>::epsilon();
  // ε ≤ 3/4 wants so many steps at least; with fewer the bound would be more than four times θ.
  double const doubt = std::log(1.648 * std::sqrt(double(n)) / options.failure);
  auto const least = static_cast<index>(std::ceil((doubt / std::sqrt(0.75) + 1) / 2));
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
    exhausted = !(β > S(n) * ε * scale);
    if (exhausted || k + 1 == steps) break;
    off_diagonal.push_back(β);
    vectors::copy(q, previous);
    vectors::copy(w, q);
    vectors::divide(β, q);
  }
  S const θ = detail::largest_tridiagonal_eigenvalue(diagonal, off_diagonal);
  auto const k = static_cast<index>(diagonal.size());
  S const rounding = S(1) + S(4 * n) * ε;
  if (θ < S(0)) throw bad_input("A", detail::show(θ), "a positive semidefinite operator");
  S const θ_min =
      std::max<S>(detail::smallest_tridiagonal_eigenvalue(diagonal, off_diagonal), S(0));
  if (exhausted || k == n) return {θ * rounding, θ, θ_min, k};
  double const root = doubt / double(2 * k - 1);
  return {θ * rounding / S(1 - root * root), θ, θ_min, k};
}

}  // namespace slant
