// SPDX-License-Identifier: MIT
//
// Conjugate gradients on the range of a semidefinite operator C [D §3], for a semidefinite K:
//
//     minimise   j(x) = ½ xᵀK x − bᵀx   over   x ∈ x₀ + range(C)
//
//     r = K x − b,  p ← C r − γ p,  γ = (C r)ᵀK p / pᵀK p,                        [D (2), (3)]
//                   x ← x − α p,    α = rᵀp / pᵀK p
//
// The minimum is reached where C r = 0. K p = 0 with C r ≠ 0 means that j falls for ever along p:
// status unbounded, and the state has the direction.
//
// With a conjugate projector Q = I − U(UᵀKU)⁻¹UᵀK, range(U) ⊂ range(C), it is the projector
// preconditioning of [D §4]: the exact minimum over range(U) first, then the same with Q C Qᵀ in
// the place of C. Since Qᵀr = r from then on, a step costs one application of Q, of K and of C.
// Where range(U) ⊄ range(C) the minimum over range(U) leads out of x₀ + range(C), and the result is
// that of another problem. That can be seen if C declares to be a projector: then C y = y is
// required of the first step y over range(U). Otherwise it is up to whoever chooses U.
#pragma once

#include <slant/base/diagnosis.hpp>
#include <slant/base/held.hpp>
#include <slant/base/report.hpp>
#include <slant/base/vector_algebra.hpp>
#include <slant/concepts/vector.hpp>
#include <slant/krylov/conjugate_directions.hpp>
#include <slant/krylov/flat_direction.hpp>
#include <slant/krylov/linear_system.hpp>

#include <concepts>
#include <string>
#include <type_traits>
#include <utility>

namespace slant {

/// State of range_cg. The residual is C r; its scale is ‖C b‖, or ‖C r₀‖ if that is 0.
template <class V, class WK, class WC, class WQ, bool Definite>
struct range_cg_state : detail::residual_state<V> {
  using flat_type = flat_direction<V, Definite>;

  WK a_workspace;                               ///< temporaries of K
  WC c_workspace;                               ///< temporaries of C
  WQ q_workspace;                               ///< temporaries of Q
  flat_type flat;                               ///< tells directions of the kernel of K
  V z = this->r;                                ///< C r
  projected_directions<V> directions{this->r};  ///< p, q = Q p, K q, qᵀKq
  V descent = this->r;               ///< where j falls for ever, if the status is unbounded
  bool regular = false;              ///< a kernel was looked for, and j does not fall in it
  bool flat_ended = false;           ///< it stalled on a direction without curvature
  index projector_applications = 0;  ///< of Q, or of U(UᵀKU)⁻¹Uᵀ

  [[nodiscard, gnu::cold]] std::string reason() const {
    switch (this->status) {
      case slant::status::converged:
        return "the gradient vanishes on the range";
      case slant::status::unbounded:
        return "the function decreases for ever along `descent`";
      case slant::status::stalled:
        if (!flat_ended) return "the gradient computed from x has not fallen any more";
        return flat.is_exact() ? "the curvature of the next direction is that of rounding errors, "
                                 "and no kernel was found near it"
                               : "the curvature of the next direction is that of rounding errors, "
                                 "as far as the mean of the diagonal tells; K gives no diagonal";
      case slant::status::breakdown:
        return "a number left the range of the scalar, or an operator is not semidefinite";
      default:
        return std::string(to_string(this->status));
    }
  }
};

/// Arguments that lack something end here and are told so; see base/diagnosis.hpp.
template <class K, class V, class C, class Q = no_projector>
class range_cg : public detail::refused_method<std::remove_cvref_t<V>> {
  using k = detail::questions_about<std::remove_cvref_t<K>, std::remove_cvref_t<V>>;
  using c = detail::questions_about<std::remove_cvref_t<C>, std::remove_cvref_t<V>>;
  static constexpr bool good_vector = vector<std::remove_cvref_t<V>>;

  static_assert(good_vector,
                "range_cg: b must be a slant::vector; an expression or a view is none");
  static_assert(linear_operator<typename k::whole, typename k::vector_type>,
                "range_cg: K must be a linear operator on vectors like b");
  static_assert(detail::usable_part<typename k::part, typename k::vector_type>,
                "range_cg: a part of K cannot be used on vectors like b");
  static_assert(psd_operator<typename k::promise, typename k::vector_type>,
                "range_cg: K must declare self_adjoint and positive_semidefinite");
  static_assert(linear_operator<typename c::whole, typename c::vector_type>,
                "range_cg: C must be a linear operator on vectors like b");
  static_assert(detail::usable_part<typename c::part, typename c::vector_type>,
                "range_cg: a part of C cannot be used on vectors like b");
  static_assert(psd_operator<typename c::promise, typename c::vector_type>,
                "range_cg: C must declare self_adjoint and positive_semidefinite");
  static_assert(!good_vector ||
                    conjugate_projector_for<std::remove_cvref_t<Q>, typename k::vector_type>,
                "range_cg: Q must have add_minimiser(a, b, y, w), as a conjugate_projector has");

 public:
  using range_cg::refused_method::refused_method;
};

/// The method at the top of this file: solve(range_cg{K, b, C}, zero, residual_below(1e-10)), or
/// range_cg{K, b, C, Q}. Requires psd_operator of K and C. Statuses of its own: converged (C r =
/// 0), unbounded, stalled, breakdown.
template <class K, class V, class C, class Q>
  requires vector<std::remove_cvref_t<V>> &&
           psd_operator<std::remove_cvref_t<K>, std::remove_cvref_t<V>> &&
           psd_operator<std::remove_cvref_t<C>, std::remove_cvref_t<V>> &&
           conjugate_projector_for<std::remove_cvref_t<Q>, std::remove_cvref_t<V>>
class range_cg<K, V, C, Q> : private detail::preconditioned_system<K, V, C> {
  using system = detail::preconditioned_system<K, V, C>;

 public:
  using typename system::operator_type;
  using typename system::scalar;
  using typename system::vector_type;
  using projector_type = std::remove_cvref_t<Q>;
  static constexpr bool projected = !std::same_as<projector_type, no_projector>;
  using state_type = range_cg_state<vector_type, workspace_t<operator_type, vector_type>,
                                    workspace_t<typename system::preconditioner_type, vector_type>,
                                    workspace_t<projector_type, vector_type>,
                                    declares_positive_definite<operator_type>>;

  /// Throws bad_input if sizes do not match or b is not finite.
  range_cg(held<K> k, held<V> b, held<C> c)
    requires(!projected)
      : system(std::move(k), std::move(b), std::move(c)),
        q_(no_projector(slant::local(this->b()).size())) {}
  range_cg(held<K> k, held<V> b, held<C> c, held<Q> q)
      : system(std::move(k), std::move(b), std::move(c)), q_(std::move(q)) {
    detail::check_size("rows of the projector", index(q_.get().rows()),
                       slant::local(this->b()).size());
  }

  /// The state of x0, with a projector that of the minimum over x0 + range(U). Throws bad_input if
  /// x0 or K x0 is not finite or of the wrong size, or if a projector C shows that range(U) is not
  /// in its range.
  [[nodiscard]] state_type start(vector_type const& x0) const {
    detail::check_start(x0, this->b());
    slant::work spent{};
    flat_direction<vector_type, declares_positive_definite<operator_type>> flat(
        this->a(), x0, spent.setup_applications);
    state_type s{{x0},
                 workspace(this->a(), x0),
                 workspace(this->m(), x0),
                 workspace(q_.get(), x0),
                 std::move(flat)};
    s.work = spent;
    vectors::set_zero(s.descent);
    detail::start_residual(this->a(), this->b(), s);
    s.status = status::running;
    slant::apply(this->m(), this->b(), s.z, s.c_workspace);
    s.residual_scale = norm(s.z);
    if constexpr (projected) {
      minimise_inside(s);
      check_range(x0, s);
    }
    note(s);
    if (s.residual_scale == scalar(0)) s.residual_scale = s.residual_norm;
    return s;
  }

  void step(state_type& s) const {
    if (s.status != status::running) return;
    auto& d = s.directions;
    d.advance(s.z);
    d.image(this->a(), s.a_workspace, q_.get(), s.q_workspace);
    count(s, 1, 1);
    // Before stalling a kernel is looked for also where none was found before.
    if (s.flat.is_flat(d) || (!s.regular && s.flat.is_nearly_flat(d))) look_for_kernel(s);
    if (s.status != status::running) return;
    if (!(d.curvature > scalar(0)) || s.flat.is_flat(d)) {
      s.flat_ended = s.flat.is_flat(d);
      s.status = s.flat_ended ? status::stalled : status::breakdown;
      return;
    }
    scalar const α = inner_product(s.r, d.q) / d.curvature;
    vectors::axpy(-(s.unit * α), d.q, s.x);
    vectors::axpy(-α, d.Ap, s.r);
    s.updated = true;
    note(s);
    ++s.iteration;
  }

  /// r from x, if steps have been updating it; the next direction is C r itself.
  bool refresh(state_type& s) const {
    s.directions.live = false;
    return detail::refresh_residual(this->a(), this->b(), s, [this](state_type& t) { note(t); });
  }

 private:
  /// The exact minimum over x + range(U), and r there.
  void minimise_inside(state_type& s) const {
    q_.get().add_minimiser(-s.unit, s.r, s.x, s.q_workspace);
    slant::apply(this->a(), s.x, s.r, s.a_workspace);
    vectors::subtract(this->b(), s.r);
    vectors::scale(scalar(1) / s.unit, s.r);
    count(s, 1, 1);
  }

  /// See the top of this file.
  void check_range([[maybe_unused]] vector_type const& x0, [[maybe_unused]] state_type& s) const {
    using C_type = typename system::preconditioner_type;
    if constexpr (declares_projector<C_type> && !std::same_as<C_type, identity_operator>) {
      vectors::difference(s.x, x0, s.descent);
      slant::apply(this->m(), s.descent, s.z, s.c_workspace);
      vectors::subtract(s.descent, s.z);
      auto const ε = detail::epsilon<scalar>();
      scalar const size = norm(s.descent) + norm(s.x);
      vectors::set_zero(s.descent);
      using std::sqrt;
      if (norm(s.z) <= sqrt(ε) * size) return;
      throw bad_input("Q", "range(U) not in range(C): it moves x0 by y with C y != y",
                      "a U within range(C)");
    }
  }

  void note(state_type& s) const {
    slant::apply(this->m(), s.r, s.z, s.c_workspace);
    detail::note_norm(s, norm(s.z));
  }

  /// Unbounded if the direction is near one of the kernel in which j falls.
  void look_for_kernel(state_type& s) const {
    auto& d = s.directions;
    auto const search = s.flat.split(d, this->a(), s.a_workspace, this->m(), s.c_workspace,
                                     q_.get(), s.q_workspace, global_size(s.x));
    count(s, search.products, search.projections);
    s.regular = true;
    if (!search.found) return;
    scalar const slope = inner_product(s.r, d.q);
    scalar const size = (norm(this->b()) + s.flat.force(s.x)) / s.unit;
    using std::abs;
    if (is_descent(scalar(abs(slope)), d.q, size)) {
      s.status = status::unbounded;
      vectors::scale(slope > scalar(0) ? scalar(-1) : scalar(1), d.q, s.descent);
      return;
    }
    s.flat.restore(d);
  }

  static void count(state_type& s, index products, index projections) {
    s.work.operator_applications += products;
    if constexpr (projected) s.projector_applications += projections;
  }

  held<Q> q_;
};

template <class K, class V, class C>
range_cg(K&&, V&&, C&&) -> range_cg<kept_t<K>, kept_t<V>, kept_t<C>>;
template <class K, class V, class C, class Q>
range_cg(K&&, V&&, C&&, Q&&) -> range_cg<kept_t<K>, kept_t<V>, kept_t<C>, kept_t<Q>>;

}  // namespace slant
