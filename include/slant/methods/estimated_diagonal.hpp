// SPDX-License-Identifier: MIT
//
// diag(A) for a preconditioner: exact where A gives it at no product, else one mean for each part
// of the set, since the parts of a cartesian product are where A changes its scale (pressures and
// wall forces, normal and tangential forces). A part P of n_P unknowns gets Hutchinson's estimate
//
//     d_P = mean over k random v of vᵀA v / n_P,     v = ±1 on P, 0 elsewhere                  (≥
//     0)
//
// Rejected, by measurement (steel brick, k = 6, three loads, products of the interior-point method
// to a relative energy error of 1e-6): the exact diagonal, n products, then 264, 134, 100; signs on
// all unknowns, entry by entry [Bekas, Kokiopoulou, Saad 2007] from 10 products, then 471, 275,
// 174, from 30 then 399, 198, 146; one mean of all from 6 products, then 215, 114, 85; one of each
// part from 6, then 204, 103, 98. Noise from entry to entry costs more than what the entries tell.
#pragma once

#include <slant/concepts/capabilities.hpp>
#include <slant/krylov/mean_diagonal.hpp>
#include <slant/sets/blocks.hpp>

#include <cstddef>
#include <random>
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
  } else if constexpr (requires { set.map(), set.part(); }) {
    visit_parts(set.part(), f);
  } else {
    f(index(0), index(slant::dimension_of(set)));
  }
}

}  // namespace detail

/// d ≈ diag(A), all entries > 0; mean(d) and the products spent, samples for each part. Throws
/// bad_input if a mean is not finite or negative.
template <class A, class C, class V>
  requires psd_operator<A, V>
[[nodiscard]] auto estimate_diagonal(A const& a, C const& set, mean_diagonal_options const& options,
                                     V& d) -> diagonal_mean<scalar_t<V>> {
  using S = scalar_t<V>;
  options.validate();
  index const here = slant::local(d).size();
  V v = like(d, here), image = like(d, here);
  auto const mean_of = [&](S const& sum, S const& count) {
    S const mean = count > S(0) ? S(sum / count) : S(0);
    if (!(mean >= S(0)) || !detail::is_finite(mean)) {
      throw bad_input("A", "mean of the diagonal " + detail::show(mean), "a finite number >= 0");
    }
    return mean;
  };
  slant::local(v).setOnes();
  S const size = inner_product(v, v);
  index applications = 0;
  if constexpr (has_diagonal<A, V>) {
    a.diagonal(d);
  } else {
    auto temporaries = workspace(a, d);
    std::mt19937_64 generator(options.seed);
    detail::visit_parts(set, [&](index first, index count) {
      slant::local(v).setZero();
      slant::local(v).segment(first, count).setOnes();
      S const unknowns = inner_product(v, v);
      S sum(0);
      for (index k = 0; k < options.samples && unknowns > S(0); ++k, ++applications) {
        for (index i = first; i < first + count; ++i) {
          slant::local(v).coeffRef(i) = (generator() >> 63) != 0 ? S(1) : S(-1);
        }
        slant::apply(a, v, image, temporaries);
        sum += inner_product(v, image);
      }
      slant::local(d)
          .segment(first, count)
          .setConstant(mean_of(sum, S(options.samples) * unknowns));
    });
    slant::local(v).setOnes();
  }
  S const mean = mean_of(inner_product(v, d), size);
  // Where A has nothing to say anything will do that has its size.
  S const typical = mean > S(0) ? mean : S(1);
  slant::local(d) = slant::local(d).unaryExpr([&](S const& e) { return e > S(0) ? e : typical; });
  return {mean, applications};
}

}  // namespace slant
