// SPDX-License-Identifier: MIT
//
// Directions of the kernel of a semidefinite K, as conjugate gradients meet them: K q = 0 up to
// rounding. A curvature qᵀKq is a sum of products that cancel; what is below
//
//     16 ε qᵀD q,   D = diag(K),
//
// cannot be told from zero. Measured by the diagonal, a soft body beside a stiff one is not flat.
//
// A direction that CG finds flat is one up to √ε only, the energy being quadratic. polish takes out
// the rest: δ with K-energy least for q − δ, by conjugate gradients on the same range,
//
//     minimise ½ δᵀKδ − (K q)ᵀδ   over   δ ∈ range(Q C Qᵀ),      q ← q − δ.
#pragma once

#include <slant/concepts/capabilities.hpp>
#include <slant/concepts/distributed.hpp>
#include <slant/krylov/mean_diagonal.hpp>
#include <slant/krylov/projected_directions.hpp>

#include <cmath>
#include <limits>

namespace slant {

/// Is slope = −rᵀd more than the noise of a consistent right-hand side of the size gradient_size?
template <class V, class S>
[[nodiscard]] bool is_descent(S slope, V const& d, S gradient_size) {
  auto const noise = S(slant::global_size(d)) * std::numeric_limits<S>::epsilon();
  return slope > noise * norm(d) * gradient_size;
}

/// What polish has spent and found.
struct polished {
  bool flat;          ///< K q = 0 up to rounding, and q ≠ 0
  index products;     ///< with K
  index projections;  ///< applications of Q
};

/// Tells flat directions and polishes them. For an operator declared definite it does nothing and
/// holds nothing.
template <class V, bool Definite>
class flat_direction {
 public:
  using scalar = scalar_t<V>;

  /// D = diag(K), or the mean of it where K does not give its diagonal. Throws bad_input if that is
  /// not finite. Adds the products spent to `applications`.
  template <class K>
  flat_direction(K const& k, V const& prototype, index& applications)
      : D_(like(prototype, slant::local(prototype).size())),
        image_(like(prototype, slant::local(prototype).size())),
        directions_(prototype) {
    if constexpr (has_diagonal<K, V>) {
      k.diagonal(D_);
      detail::check_finite("the diagonal of K", D_);
    } else {
      auto const mean = mean_diagonal(k, prototype);
      slant::local(D_).setConstant(mean.value);
      applications += mean.applications;
    }
  }

  /// Is qᵀKq zero up to rounding?
  template <class Directions>
  [[nodiscard]] bool is_flat(Directions const& d) {
    return !(d.curvature > scalar(16) * std::numeric_limits<scalar>::epsilon() * size(d));
  }
  /// Is it so small that q may be a direction of the kernel to half of the digits, so that the
  /// minimum along it would be far away?
  template <class Directions>
  [[nodiscard]] bool is_nearly_flat(Directions const& d) {
    using std::sqrt;
    return !(d.curvature > sqrt(std::numeric_limits<scalar>::epsilon()) * size(d));
  }

  /// Makes K q = 0 as exact as it can be, d.q ∈ range(Q C Qᵀ) staying there; d.Ap becomes K q. At
  /// most `steps` steps, one product and one application of Q and C each.
  template <class Directions, class K, class WK, class C, class WC, class Q, class WQ>
  [[nodiscard]] polished polish(Directions& d, K const& k, WK& wk, C const& c, WC& wc, Q const& q,
                                WQ& wq, index steps) {
    scalar const ε = std::numeric_limits<scalar>::epsilon();
    polished spent{true, 0, 0};
    scalar const length = norm(d.q);
    slant::local(image_) = slant::local(D_).cwiseProduct(slant::local(d.q));
    scalar const enough = scalar(4) * ε * norm(image_);
    directions_.live = false;
    for (index i = 0; i < steps; ++i) {
      slant::apply(c, d.Ap, image_, wc);
      if (norm(image_) <= enough) break;
      directions_.advance(image_);
      directions_.image(k, wk, q, wq);
      ++spent.products;
      ++spent.projections;
      if (is_flat(directions_)) break;
      scalar const α = inner_product(d.Ap, directions_.q) / directions_.curvature;
      slant::local(d.q) -= α * slant::local(directions_.q);
      slant::local(d.Ap) -= α * slant::local(directions_.Ap);
    }
    slant::apply(k, d.q, d.Ap, wk);
    ++spent.products;
    d.curvature = inner_product(d.q, d.Ap);
    spent.flat = is_flat(d) && norm(d.q) > length / scalar(2);
    return spent;
  }

 private:
  /// qᵀD q.
  template <class Directions>
  [[nodiscard]] scalar size(Directions const& d) {
    slant::local(image_) = slant::local(D_).cwiseProduct(slant::local(d.q));
    return inner_product(image_, d.q);
  }

  V D_;      // diag(K)
  V image_;  // scratch
  projected_directions<V> directions_;
};

template <class V>
class flat_direction<V, true> {
 public:
  template <class K>
  flat_direction(K const&, V const&, index&) {}
  template <class Directions>
  [[nodiscard]] bool is_flat(Directions const& d) const {
    return !(d.curvature > scalar_t<V>(0));
  }
  template <class Directions>
  [[nodiscard]] bool is_nearly_flat(Directions const& d) const {
    return is_flat(d);
  }
  /// A curvature ≤ 0 of what was declared definite: there is no such direction.
  template <class... Parts>
  [[nodiscard]] polished polish(Parts const&...) const {
    return {false, 0, 0};
  }
};

}  // namespace slant
