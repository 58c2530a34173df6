// SPDX-License-Identifier: MIT
//
// Directions of the kernel of a semidefinite K, as conjugate gradients meet them. Where the energy
// has no minimum their directions turn towards the kernel step by step, while steps grow without
// end; in exact arithmetic the last one is K q = 0 [D §3], in floating point nothing is left of r
// by then. So a direction whose curvature is small to half of the digits,
//
//     qᵀKq ≤ √ε qᵀD q,   D = diag(K),
//
// is split into δ and a direction of the kernel, q − δ, δ by conjugate gradients on the same range:
//
//     minimise   ½ δᵀKδ − (K q)ᵀδ   over   δ ∈ range(Q C Qᵀ)
//
// If that leaves a part of q with K (q − δ) = 0 up to rounding, ‖K (q − δ)‖ ≤ c ε ‖D (q − δ)‖,
// there is a kernel; if not, q is as it was. Measured by the diagonal, a soft body beside a stiff
// one is not flat. An operator without a diagonal is measured by the mean of it, by which a soft
// body that is held cannot be told from a free one: then K (q − δ) = 0 must hold exactly.
#pragma once

#include <slant/base/vector_algebra.hpp>
#include <slant/concepts/capabilities.hpp>
#include <slant/concepts/vector.hpp>
#include <slant/krylov/conjugate_directions.hpp>
#include <slant/krylov/spectrum.hpp>

#include <cmath>

namespace slant {

/// Is slope = −rᵀd more than the noise of a consistent right-hand side of the size gradient_size?
template <class V, class S>
[[nodiscard]] bool is_descent(S slope, V const& d, S gradient_size) {
  auto const noise = S(slant::global_size(d)) * detail::epsilon<S>();
  return slope > noise * norm(d) * gradient_size;
}

/// What split has spent and found.
struct kernel_search {
  bool found;         ///< K q = 0 up to rounding, and q ≠ 0
  index products;     ///< with K
  index projections;  ///< applications of Q
};

/// Tells flat directions and splits them. For an operator declared definite it does nothing and
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
        directions_(prototype),
        exact_(slant::diagonal_if_known(k, D_)) {
    if (exact_) {
      detail::check_finite("the diagonal of K", D_);
    } else {
      auto const mean = mean_diagonal(k, prototype);
      vectors::fill(mean.value, D_);
      applications += mean.applications;
    }
  }

  /// Is qᵀKq zero up to rounding?
  [[nodiscard]] bool is_flat(auto const& d) {
    using std::abs;
    return abs(d.curvature) <= scalar(16) * detail::epsilon<scalar>() * size(d);
  }
  /// Is it so small that q may be near a direction of the kernel?
  [[nodiscard]] bool is_nearly_flat(auto const& d) {
    using std::sqrt;
    return !(d.curvature > sqrt(detail::epsilon<scalar>()) * size(d));
  }

  /// ‖D x‖, the size of the forces of which K x is the sum; its rounding errors are ε times that.
  [[nodiscard]] scalar force(V const& x) {
    vectors::multiply(D_, x, image_);
    return norm(image_);
  }

  /// Does K give its diagonal? If not, what is flat is a guess.
  [[nodiscard]] bool is_exact() const noexcept { return exact_; }

  /// Makes d.q ∈ range(Q C Qᵀ) a direction of the kernel that stays in this range, if there is one
  /// near it; else d is as it was. At most `steps` steps, one product and one application of Q and
  /// C each.
  template <class Directions, class K, class WK, class C, class WC, class Q, class WQ>
  [[nodiscard]] kernel_search split(Directions& d, K const& k, WK& wk, C const& c, WC& wc,
                                    Q const& q, WQ& wq, index steps) {
    kernel_search spent{false, 0, 0};
    index passes = 0;
    vectors::copy(d.q, q_);
    vectors::copy(d.Ap, image_of_q_);
    curvature_of_q_ = d.curvature;
    scalar const least = norm(d.q) / scalar(128);
    scalar const enough = scalar(4) * detail::epsilon<scalar>() * force(d.q);
    // δ to the precision of K q, then K q anew: where it has become smaller there are more digits.
    for (scalar before = norm(d.Ap);; before = norm(d.Ap)) {
      spent.projections += take_out(d, k, wk, c, wc, q, wq, steps, least, enough);
      slant::apply(k, d.q, d.Ap, wk);
      spent.products = spent.projections + ++passes;
      if (passes == 3 || !(norm(d.Ap) > scalar(0) && norm(d.Ap) < before / scalar(2))) break;
    }
    d.curvature = inner_product(d.q, d.Ap);
    scalar const noise = scalar(1024) * detail::epsilon<scalar>() * force(d.q);
    spent.found = norm(d.q) > least && is_flat(d) && norm(d.Ap) <= (exact_ ? noise : scalar(0));
    if (!spent.found) restore(d);
    return spent;
  }
  /// d as it was before it was split.
  void restore(auto& d) const {
    vectors::copy(q_, d.q);
    vectors::copy(image_of_q_, d.Ap);
    d.curvature = curvature_of_q_;
  }

 private:
  /// d.q and d.Ap without δ; how many products with K and applications of Q it took.
  template <class Directions, class K, class WK, class C, class WC, class Q, class WQ>
  [[nodiscard]] index take_out(Directions& d, K const& k, WK& wk, C const& c, WC& wc, Q const& q,
                               WQ& wq, index steps, scalar least, scalar enough) {
    index products = 0;
    scalar last = detail::infinity<scalar>();
    directions_.live = false;
    while (products < steps && norm(d.q) > least) {
      slant::apply(c, d.Ap, image_, wc);
      // Below the rounding errors of K q the parts of soft modes still fall, and only they.
      scalar const now = norm(image_);
      if (now == scalar(0) || (now <= enough && !(now < last / scalar(2)))) break;
      last = now;
      directions_.advance(image_);
      directions_.image(k, wk, q, wq);
      ++products;
      if (is_flat(directions_) || !(directions_.curvature > scalar(0))) break;
      scalar const α = inner_product(d.Ap, directions_.q) / directions_.curvature;
      vectors::axpy(-α, directions_.q, d.q);
      vectors::axpy(-α, directions_.Ap, d.Ap);
    }
    return products;
  }

  /// qᵀD q.
  [[nodiscard]] scalar size(auto const& d) {
    vectors::multiply(D_, d.q, image_);
    return inner_product(image_, d.q);
  }

  V D_;           // diag(K)
  V image_ = D_;  // scratch
  V q_ = D_;      // the direction before it was split
  V image_of_q_ = D_;
  projected_directions<V> directions_;
  bool exact_;
  scalar curvature_of_q_{0};
};

template <class V>
class flat_direction<V, true> {
 public:
  flat_direction(auto const&, V const&, index&) {}
  [[nodiscard]] bool is_flat(auto const&) const { return false; }
  [[nodiscard]] bool is_nearly_flat(auto const&) const { return false; }
  [[nodiscard]] bool is_exact() const noexcept { return true; }
  [[nodiscard]] scalar_t<V> force(V const&) const { return scalar_t<V>(0); }
  void restore(auto const&) const {}
  template <class... Parts>
  [[nodiscard]] kernel_search split(Parts const&...) const {
    return {false, 0, 0};
  }
};

}  // namespace slant
