// SPDX-License-Identifier: MIT
//
// Samples the laws that an operator type declares.
#pragma once

#include <slant/testing/detail/extreme_directions.hpp>
#include <slant/testing/detail/operator_sampler.hpp>

#include <algorithm>
#include <functional>
#include <limits>
#include <utility>
#include <vector>

namespace slant::testing::detail {

/// x ↦ Aᵀx by what there is: self-adjointness, apply_adjoint, or all columns of a small A. Else
/// empty.
template <class V>
[[nodiscard]] std::function<V(V const&)> adjoint_map(operator_sampler<V>& sampler,
                                                     operator_probe<V> const& a) {
  constexpr index small = 200;
  if (a.laws.contains(law::self_adjoint)) return [&](V const& x) { return sampler.image(x); };
  if (a.apply_adjoint) return [&](V const& x) { return sampler.adjoint_image(x); };
  if (a.cols > small) return {};
  std::vector<V> columns;
  for (index j = 0; j < a.cols; ++j) columns.push_back(sampler.image(sampler.unit(a.cols, j)));
  return [columns = std::move(columns)](V const& x) {
    V y = x;
    for (std::size_t j = 0; j < columns.size(); ++j) {
      slant::local(y)[static_cast<index>(j)] = slant::inner_product(columns[j], x);
    }
    return y;
  };
}

/// Directions in which to try laws about ⟨Ax, x⟩: random ones, unit vectors, and the ends of the
/// spectrum of (A + Aᵀ)/2, where that can be applied.
template <class V>
[[nodiscard]] std::vector<V> telling_directions(operator_sampler<V>& sampler,
                                                operator_probe<V> const& a) {
  using S = scalar_t<V>;
  std::vector<V> directions;
  for (int k = 0; k < a.options.samples; ++k) directions.push_back(sampler.random(a.cols));
  for (index const i : sampler.places(a.cols, 16)) directions.push_back(sampler.unit(a.cols, i));
  if (auto const adjoint_image = adjoint_map(sampler, a)) {
    auto const symmetric_part = [&](V const& x) {
      V y = sampler.image(x);
      V const z = adjoint_image(x);
      slant::local(y) = (slant::local(y) + slant::local(z)) / S(2);
      return y;
    };
    for (V& x :
         extreme_directions(symmetric_part, sampler.random(a.cols), a.options.lanczos_steps)) {
      directions.push_back(std::move(x));
    }
  }
  return directions;
}

/// Every law that `a` declares, in one direction x. `size` is an estimate of ‖A‖; y is any other
/// direction.
template <class V>
void check_laws_along(operator_sampler<V>& sampler, operator_probe<V> const& a,
                      scalar_t<V> const& size, V const& x, V const& y) {
  using S = scalar_t<V>;
  V const ax = sampler.image(x);
  S const length = slant::norm(x);
  S const form = slant::inner_product(ax, x);
  S const scale = size * length * length;
  if (a.laws.contains(law::self_adjoint)) {
    S const difference =
        S(slant::inner_product(ax, y)) - S(slant::inner_product(x, sampler.image(y)));
    sampler.expect_small("self_adjoint, <Ax, y> = <x, Ay>", difference,
                         S(size * length * slant::norm(y)));
  }
  if (a.laws.contains(law::positive_definite)) {
    // Zero up to rounding is not positive: here rounding counts against the operator.
    S const rounding =
        std::numeric_limits<S>::epsilon() * S(8 + int(std::min<index>(a.cols, 1000))) * scale;
    if (!(form > rounding)) sampler.report("positive_definite, <Ax, x> > 0", -form, S(0));
  } else if (a.laws.contains(law::positive_semidefinite)) {
    S const bound = sampler.allowed(scale);
    if (!(form >= -bound)) {
      sampler.report("positive_semidefinite, <Ax, x> >= 0", -form, bound);
    }
  }
  if (a.laws.contains(law::projector)) {
    sampler.expect_close("projector, A A x = A x", sampler.image(ax), ax,
                         S(size * (S(1) + size) * length));
  }
  if (a.laws.contains(law::firmly_nonexpansive)) {
    S const square = slant::inner_product(ax, ax);
    S const bound = sampler.allowed(scale * (S(1) + size));
    if (!(form >= square - bound)) {
      sampler.report("firmly_nonexpansive, <Ax, x> >= |Ax|^2", square - form, bound);
    }
  }
}

/// `size` is an estimate of ‖A‖.
template <class V>
void check_declared_laws(operator_sampler<V>& sampler, operator_probe<V> const& a,
                         scalar_t<V> const& size) {
  if (a.laws == law_set{} || a.cols == 0) return;
  auto const directions = telling_directions(sampler, a);
  for (std::size_t k = 0; k < directions.size(); ++k) {
    check_laws_along(sampler, a, size, directions[k], directions[(k + 1) % directions.size()]);
  }
}

}  // namespace slant::testing::detail
