// SPDX-License-Identifier: MIT
//
// The mean of the diagonal of a self-adjoint semidefinite operator, which is the mean of its
// eigenvalues: the size of A that a typical direction feels, where σ_max is what the worst one
// does.
//
// Exact if the operator gives its diagonal. Else Hutchinson's estimate [Hutchinson 1990],
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
#include <slant/concepts/vector.hpp>

namespace slant {

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

/// Mean of diag(A), for vectors like `prototype`. Throws bad_input if it is not finite or negative.
template <class A, class V>
  requires psd_operator<A, V>
[[nodiscard]] auto mean_diagonal(A const& a, V const& prototype,
                                 mean_diagonal_options const& options = {})
    -> diagonal_mean<scalar_t<V>> {
  using S = scalar_t<V>;
  options.validate();
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
    detail::random_bits bits(options.seed);
    for (; applications < options.samples; ++applications) {
      for (index i = 0; i < here; ++i) {
        slant::local(v).coeffRef(i) = bits.coin() ? S(1) : S(-1);
      }
      slant::apply(a, v, image, temporaries);
      sum += inner_product(v, image);
    }
  }
  S const mean = sum / S(applications > 0 ? applications * n : n);
  if (!(mean >= S(0)) || !detail::is_finite(mean)) {
    throw bad_input("A", "mean of the diagonal " + detail::show(mean), "a finite number >= 0");
  }
  return {mean, applications};
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
  if (!(length > S(0)) || !detail::is_finite(length)) {
    throw bad_input("A", "mean of the diagonal " + detail::show(mean.value),
                    "one whose reciprocal is a finite number > 0");
  }
  return {length, mean.applications};
}

}  // namespace slant
