// SPDX-License-Identifier: MIT
//
// diag(A) for a preconditioner: exact where A gives it at no product or n products are not more
// than an estimate takes, else one mean for each part of the set, since the parts of a cartesian
// product are where A changes its scale (pressures and wall forces, normal and tangential forces).
// A part P of n_P unknowns gets Hutchinson's estimate
//
//     d_P = mean over k random v of vᵀA v / n_P ≥ 0,     v = ±1 on P, 0 elsewhere
//
// Rejected, by measurement on the bricks: the exact diagonal at n products, an estimate of each
// entry [Bekas, Kokiopoulou, Saad 2007] from 10 to 30 products, and one mean of all. Noise from
// entry to entry costs products, and the exact diagonal saves fewer than the n that it takes.
#pragma once

#include <slant/concepts/capabilities.hpp>
#include <slant/concepts/distributed.hpp>
#include <slant/concepts/random.hpp>
#include <slant/concepts/vector_algebra.hpp>
#include <slant/krylov/mean_diagonal.hpp>
#include <slant/sets/blocks.hpp>

#include <cstddef>
#include <limits>
#include <type_traits>
#include <utility>

namespace slant {

namespace detail {

/// f(first, size) for the components of each part of a cartesian product, or for all of another
/// set.
template <class C, class F>
void visit_parts(C const& set, F const& f) {
  if constexpr (requires { C::part_count; }) {
    [&]<std::size_t... I>(std::index_sequence<I...>) {
      index first = 0;
      auto const one = [&](index size) { f(first, size), first += size; };
      (one(index(slant::dimension_of(set.template part<I>()))), ...);
    }(std::make_index_sequence<C::part_count>{});
  } else if constexpr (requires { set.visit_parts(f); }) {
    set.visit_parts(f);
  } else if constexpr (requires { set.map(), set.part(); }) {
    visit_parts(set.part(), f);
  } else {
    f(index(0), index(slant::dimension_of(set)));
  }
}

}  // namespace detail

/// d ≈ diag(A), all entries > 0; mean(d) and the products spent, samples for each part. Throws
/// bad_input that calls A by its name if a mean is not finite or negative.
template <class A, class C, class V>
  requires psd_operator<A, V>
[[nodiscard]] auto estimate_diagonal(A const& a, C const& set, mean_diagonal_options const& options,
                                     V& d, char const* name = "A") -> diagonal_mean<scalar_t<V>> {
  using S = scalar_t<V>;
  options.validate();
  index const here = slant::local(d).size();
  V v = like(d, here), image = like(d, here);
  auto const mean_of = [&](S const& sum, S const& count) {
    S const mean = count > S(0) ? S(sum / count) : S(0);
    if (!(mean >= S(0)) || !detail::is_finite(mean)) {
      throw bad_input(name, "mean of the diagonal " + detail::show(mean), "a finite number >= 0");
    }
    return mean;
  };
  vectors::fill(S(1), v);
  S const size = inner_product(v, v);
  index applications = 0;
  if (!slant::diagonal_if_known(a, d)) {
    auto temporaries = workspace(a, d);
    index parts = 0;
    detail::visit_parts(set, [&](index, index) { ++parts; });
    bool const exactly =
        slant::everywhere(d, here == slant::global_size(d) && here <= options.samples * parts);
    for (; exactly && applications < here; ++applications) {
      vectors::set_zero(v);
      slant::local(v).coeffRef(applications) = S(1);
      slant::apply(a, v, image, temporaries);
      S const entry = slant::local(image).coeff(applications);
      bool const rounded =
          entry < S(0) && -entry <= S(8) * std::numeric_limits<S>::epsilon() * norm(image);
      slant::local(d).coeffRef(applications) = rounded ? S(0) : mean_of(entry, S(1));
    }
    detail::random_bits bits(options.seed);
    detail::visit_parts(set, [&](index first, index count) {
      if (exactly) return;
      vectors::set_zero(v);
      slant::local(v).segment(first, count).setOnes();
      S const unknowns = inner_product(v, v);
      S sum(0), noise(0);
      for (index k = 0; k < options.samples && unknowns > S(0); ++k, ++applications) {
        for (index i = first; i < first + count; ++i) {
          slant::local(v).coeffRef(i) = bits.coin() ? S(1) : S(-1);
        }
        slant::apply(a, v, image, temporaries);
        sum += inner_product(v, image);
        noise += S(8) * std::numeric_limits<S>::epsilon() * norm(v) * norm(image);
      }
      if (sum < S(0) && -sum <= noise) sum = S(0);
      slant::local(d)
          .segment(first, count)
          .setConstant(mean_of(sum, S(options.samples) * unknowns));
    });
    vectors::fill(S(1), v);
  }
  S const mean = mean_of(inner_product(v, d), size);
  // Where A has nothing to say anything will do that has its size.
  S const typical = mean > S(0) ? mean : S(1);
  slant::local(d) = slant::local(d).unaryExpr([&](S const& e) { return e > S(0) ? e : typical; });
  return {mean, applications};
}

}  // namespace slant
