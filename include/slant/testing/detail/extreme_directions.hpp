// SPDX-License-Identifier: MIT
//
// Directions in which a quadratic form ⟨Ax, x⟩ is smallest and largest, by Lanczos with full
// reorthogonalisation. Random vectors alone miss a single negative eigenvalue among many positive
// ones; these do not.
#pragma once

#include <slant/concepts/vector.hpp>
#include <slant/testing/detail/jacobi_eigenvectors.hpp>

#include <algorithm>
#include <limits>
#include <vector>

namespace slant::testing::detail {

/// Unit vectors near the two ends of the spectrum of a symmetric map x ↦ image(x). With as many
/// steps as unknowns they are eigenvectors up to rounding.
template <class V, class Image>
[[nodiscard]] std::vector<V> extreme_directions(Image image, V const& start, index steps) {
  using S = scalar_t<V>;
  steps = std::min<index>(steps, slant::local(start).size());
  S const length = slant::norm(start);
  if (!(length > S(0))) return {};
  std::vector<V> basis;
  std::vector<V> images;
  V next = start;
  slant::local(next) /= length;
  S size(0);
  while (static_cast<index>(basis.size()) < steps) {
    basis.push_back(next);
    images.push_back(image(next));
    next = images.back();
    size = std::max<S>(size, slant::norm(next));
    for (int pass = 0; pass < 2; ++pass) {
      for (V const& b : basis) {
        S const part = slant::inner_product(b, next);
        slant::local(next) -= part * slant::local(b);
      }
    }
    S const rest = slant::norm(next);
    // An invariant subspace: what follows would be rounding errors. (NaN stops, too.)
    if (!(rest > S(16) * std::numeric_limits<S>::epsilon() * size)) break;
    slant::local(next) /= rest;
  }

  auto const n = static_cast<index>(basis.size());
  auto const at = [](auto& list, index i) -> auto& { return list[static_cast<std::size_t>(i)]; };
  small_matrix<S> projected(n);
  for (index i = 0; i < n; ++i) {
    for (index j = 0; j <= i; ++j) {
      S const entry = slant::inner_product(at(basis, j), at(images, i));
      if (!(entry - entry == S(0))) return {};
      projected(i, j) = projected(j, i) = entry;
    }
  }
  auto const weights = jacobi_eigenvectors(projected);
  index least = 0;
  index most = 0;
  for (index i = 1; i < n; ++i) {
    if (projected(i, i) < projected(least, least)) least = i;
    if (projected(i, i) > projected(most, most)) most = i;
  }
  std::vector<V> directions;
  for (index const which : {least, most}) {
    V x = start;
    slant::local(x).setZero();
    for (index j = 0; j < n; ++j) {
      S const weight = weights(which, j);
      slant::local(x) += weight * slant::local(at(basis, j));
    }
    directions.push_back(x);
  }
  return directions;
}

}  // namespace slant::testing::detail
