// SPDX-License-Identifier: MIT
//
// The inner problems of augmented Lagrangian methods for min q(x) over x ∈ Λ, G x = e:
//
//     L(x, ν, ρ) = ½ xᵀ(P A P + ρ Q) x − (P (b − A x̄) + ρ x̄ − ν)ᵀx + const,     x ∈ Λ,
//
// P, Q and x̄ those of equality_constraints, ν = Gᵀμ. On the affine space x = P x + x̄, so A may be
// replaced by P A P there; its spectrum and that of ρ Q then do not mix: the penalty adds the one
// eigenvalue ρ, and P A P does not depend on the choice of a generalised inverse in A [K ref 44].
#pragma once

#include <slant/base/vector_algebra.hpp>
#include <slant/concepts/linear_operator.hpp>
#include <slant/concepts/vector.hpp>
#include <slant/krylov/spectrum.hpp>
#include <slant/operators/declare.hpp>
#include <slant/operators/product.hpp>
#include <slant/operators/sum.hpp>

#include <Eigen/SparseCore>

#include <algorithm>
#include <cmath>
#include <concepts>
#include <utility>

namespace slant {

/// The projectors Q and P and the point x̄ of an affine space of vectors V, as equality_constraints
/// has them.
template <class C, class V>
concept affine_space = requires(C const& c, V const& v) {
  { c.size() } -> std::convertible_to<index>;
  { c.range_projector() } -> psd_operator<V>;
  { c.kernel_projector() } -> psd_operator<V>;
  { c.nearest() } -> std::convertible_to<V const&>;
};

/// An affine space that knows independent rows of length 1, as equality_constraints does.
template <class C, class V>
concept affine_space_with_rows = affine_space<C, V> && requires(C const& c) {
  { c.unit_rows() } -> std::same_as<Eigen::SparseMatrix<scalar_t<V>> const&>;
} && std::same_as<V, Eigen::Matrix<scalar_t<V>, Eigen::Dynamic, 1>>;

/// P A P; refers to both arguments.
template <class A, class C>
[[nodiscard]] auto projected_hessian(A const& a, C const& constraints) {
  return congruence(constraints.kernel_projector(), a);
}

/// P A P + ρ Q; refers to both. Definite if A is. Throws bad_input unless 0 < ρ < ∞.
template <class A, class C, class S>
[[nodiscard]] auto augmented_hessian(A const& a, C const& constraints, S const& ρ) {
  auto whole =
      sum(projected_hessian(a, constraints), scaled(positive(ρ), constraints.range_projector()));
  if constexpr (declares_positive_definite<A>) {
    return declare<positive_definite>(std::move(whole));
  } else {
    return whole;
  }
}

namespace detail {

/// Is x̄ the only point of the affine space? Told by spaces that know their independent rows.
template <class C>
[[nodiscard]] bool is_one_point(C const& c) {
  if constexpr (requires { c.unit_rows().rows(); }) {
    return index(c.unit_rows().rows()) == index(c.size());
  } else {
    return false;
  }
}

/// ‖A v‖/‖v‖ for v of ones: what rounding errors of P A P are small against.
template <class A, class V>
[[nodiscard]] auto size_on_ones(A const& a, V const& prototype) {
  using S = scalar_t<V>;
  V v = like(prototype, slant::local(prototype).size()), image = v;
  vectors::fill(S(1), v);
  slant::apply(a, v, image);
  S const length = norm(v);
  return length > S(0) ? S(norm(image) / length) : S(0);
}

/// Mean of diag(P A P), or what A is on ones where that may consist of rounding errors of A.
template <class A, class C, class V>
[[nodiscard]] auto projected_mean_diagonal(A const& a, C const& c, V const& prototype)
    -> diagonal_mean<scalar_t<V>> {
  using S = scalar_t<V>;
  diagonal_mean<S> mean{size_on_ones(a, prototype), 1};
  if (is_one_point(c)) return mean;
  auto const of_a = estimated_mean_diagonal(projected_hessian(a, c), prototype, {});
  mean.applications += of_a.applications;
  S const noise = S(32) * detail::epsilon<S>() * mean.value;
  if (of_a.value > noise) {
    mean.value = of_a.value;
  } else if (!(of_a.value >= -noise)) {  // ones may be in the kernel of A
    auto const whole = mean_diagonal(a, prototype);
    mean.applications += whole.applications;
    check_mean_diagonal(of_a.value, S(32) * detail::epsilon<S>() * whole.value);
  }
  return mean;
}

/// The linear term at x̄.
template <class V>
struct load_at_nearest {
  V projected;  ///< P (b − A x̄)
  V opposed;    ///< −Q (b − A x̄), a multiplier that leaves b − A x̄ as it is
};

/// P (b − A x̄) is zero where it consists of rounding errors of b and A x̄, which would be taken for
/// a load otherwise. One application of A.
template <class QP, class C>
[[nodiscard]] auto projected_load(QP const& qp, C const& c)
    -> load_at_nearest<typename QP::vector_type> {
  using S = typename QP::scalar;
  using std::sqrt;
  load_at_nearest<typename QP::vector_type> load{qp.b(), qp.b()};
  typename QP::vector_type rest = qp.b();
  slant::apply(qp.a(), c.nearest(), rest);
  S const terms = norm(qp.b()) + norm(rest);
  vectors::difference(qp.b(), rest, rest);
  slant::apply(c.kernel_projector(), rest, load.projected);
  vectors::difference(load.projected, rest, load.opposed);
  auto const n = static_cast<S>(static_cast<double>(slant::global_size(qp.b())));
  if (norm(load.projected) <= S(32) * sqrt(n) * detail::epsilon<S>() * terms) {
    vectors::set_zero(load.projected);
  }
  return load;
}

/// What ‖r̃‖ is small against: ‖P (b − A x̄)‖, or the size of A times that of x where this is less,
/// because constraints absorb much of b (the load of a gap that is far from closing). Not less
/// than what its rounding errors leave to be told.
template <class S>
[[nodiscard]] S gradient_scale(S const& load, S const& a_size, S const& x_size) {
  using std::sqrt;
  S const least = S(64) * sqrt(detail::epsilon<S>()) * load;
  S const of_x = a_size * x_size;
  return load > S(0) ? std::max<S>(std::min<S>(load, of_x), least) : of_x;
}

/// μ of G x = e from ν = Gᵀμ + a part in range Gᵀ of the gradient: that gradient A x − b + Gᵀμ has
/// no component in range Gᵀ. `offset` is Q x − x̄. One application of A.
template <class QP, class C, class V>
[[nodiscard]] auto equality_multipliers(QP const& qp, C const& c, V const& x, V const& offset,
                                        V const& ν) {
  V feasible = x, v = x;
  vectors::subtract(offset, feasible);  // P x + x̄
  slant::apply(qp.a(), feasible, v);
  vectors::difference(ν, v, v);
  vectors::add(qp.b(), v);
  return c.multipliers(v);
}

}  // namespace detail

}  // namespace slant
