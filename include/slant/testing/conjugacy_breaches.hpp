// SPDX-License-Identifier: MIT
//
// The laws of a conjugate projector, sampled [D (5)]:
//
//     K Q = Qᵀ K Q = Qᵀ K
//
// for a symmetric K; equivalently ⟨K Q x, y − Q y⟩ = 0 for all x, y: what Q keeps is K-orthogonal
// to what it removes. That Q² = Q, and that Qᵀ is its adjoint, is for operator_breaches.
#pragma once

#include <slant/concepts/capabilities.hpp>
#include <slant/testing/detail/operator_sampler.hpp>

#include <algorithm>
#include <vector>

namespace slant::testing {

/// The laws that Q was found to break, each once, with the numbers that show it. Tolerances are
/// multiples of ε max(‖K x‖, ‖K Q x‖) (1 + ‖Q x‖ / ‖x‖)² for the sample x; a U'KU of large
/// condition may need options.roundings.
template <class Q, class K, slant::vector V = Eigen::VectorXd>
  requires has_adjoint<Q, V> && linear_operator<Q, V> && linear_operator<K, V>
[[nodiscard]] std::vector<breach> conjugacy_breaches(Q const& q, K const& k,
                                                     V const& prototype = V(),
                                                     operator_law_options const& options = {}) {
  using S = scalar_t<V>;
  auto const probe = detail::probe_operator<V>(q, options);
  detail::operator_sampler<V> sampler(probe, prototype);
  index const n = index(q.rows());
  if (index(q.cols()) != n || index(k.rows()) != n || index(k.cols()) != n) {
    sampler.report("sizes", "Q and K are not square of the same size");
    return sampler.found();
  }
  auto const image = [&](V const& x) {
    V y = sampler.garbage(n);
    slant::apply(k, x, y);
    return y;
  };
  for (int sample = 0; sample < std::max(options.samples, 1); ++sample) {
    V const x = sampler.random(n);
    V const qx = sampler.image(x);
    V const kx = image(x);
    V const kqx = image(qx);
    S const length = slant::norm(x);
    if (!(length > S(0))) continue;
    S const growth = S(1) + slant::norm(qx) / length;
    S const size = std::max<S>(slant::norm(kx), slant::norm(kqx)) * growth * growth;
    sampler.expect_close("conjugacy, K Q x = Q'K x", kqx, sampler.adjoint_image(kx), size);
    sampler.expect_close("conjugacy, K Q x = Q'K Q x", kqx, sampler.adjoint_image(kqx), size);
  }
  return sampler.found();
}

}  // namespace slant::testing
