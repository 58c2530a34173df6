// SPDX-License-Identifier: MIT
//
// Conjugate gradients for Newton systems (I − G (I − ρA)) dy = −F that can be symmetrised
// (slanting/symmetrized.hpp):
//
//     H s = G (ρA − I) F,     H = G (I − G) + ρ G A G,     dy = G s − F,
//
// preconditioned by M ≈ G⁺, block by block (slant_preconditioner.hpp).
//
// The residual of the symmetric system is that of Newton's, exactly: with dy = G s − F
//
//     H s − G (ρA − I) F = G (s − (I − ρA) dy) = F + F° dy,
//
// so stopping on ‖F + F° dy‖ ≤ η ‖F‖ costs nothing but the norm that CG computes anyway.
//
// Products by A: one an iteration and one for the right-hand side; a warm start costs one more.
#pragma once

#include <slant/base/vector_algebra.hpp>
#include <slant/concepts/linear_operator.hpp>
#include <slant/krylov/cg.hpp>
#include <slant/newton/direction.hpp>
#include <slant/newton/slant_preconditioner.hpp>
#include <slant/slanting/symmetrized.hpp>

#include <type_traits>
#include <utility>

namespace slant::detail {

// --- definite on range ---------------------------------------------------------------------------
//
// H = G (I − G) + ρ G A G is semidefinite. Its kernel is that of G, and right-hand sides lie in
// range(G): there it is definite, ⟨H x, x⟩ ≥ ρ ⟨A G x, G x⟩ > 0, and conjugate gradients need no
// more. The library's CG asks for a promise, which is given here for that reason.

/// H as CG meets it.
template <class M>
class definite_on_range {
 public:
  static constexpr law_set laws = slant::laws<slant::self_adjoint, slant::positive_definite>;

  explicit definite_on_range(symmetrized_operator<M> h) : h_(std::move(h)) {}

  [[nodiscard]] index rows() const { return h_.rows(); }
  [[nodiscard]] index cols() const { return h_.cols(); }

  template <class X>
  [[nodiscard]] auto workspace(X const& x) const {
    return h_.workspace(x);
  }
  template <class X, class Y, class W>
  void apply(X const& x, Y& y, W& w) const {
    h_.apply(x, y, w);
  }

 private:
  symmetrized_operator<M> h_;
};

}  // namespace slant::detail

namespace slant {

// --- symmetrized cg ------------------------------------------------------------------------------

/// What symmetrized_cg keeps.
template <class V, class M, class State>
struct symmetrized_cg_workspace {
  V b;               ///< right-hand side G (ρA − I) F
  M preconditioner;  ///< ≈ G⁺
  State s;           ///< that of CG, with the workspace of H
};

/// CG on the symmetrised Newton system; for operators F°(y) that are `symmetrizable`.
struct symmetrized_cg {
  index max_iterations = 0;  ///< in one Newton step; 0: 10 n + 100
  bool warm_start = false;   ///< begin with what a shortened step left over

  /// Throws bad_input naming the option, its value and what was expected.
  [[gnu::cold]] void validate() const { detail::check_iteration_limit(max_iterations); }

  template <class N, class V>
    requires symmetrizable<N> && linear_operator<N, V>
  [[nodiscard]] auto prepare(N const& newton, V const& f) const {
    using slant_type = std::remove_cvref_t<decltype(slant::slant_of_projection(newton))>;
    auto zero = like(f, slant::local(f).size());
    vectors::set_zero(zero);
    slant_preconditioner<slant_type> m(slant::slant_of_projection(newton));
    detail::definite_on_range const h(slant::symmetrized(newton));
    auto s = cg{h, zero, m}.start(zero);
    return symmetrized_cg_workspace<V, decltype(m), decltype(s)>{std::move(zero), std::move(m),
                                                                 std::move(s)};
  }

  template <class N, class V, class P>
    requires symmetrizable<N> && linear_operator<N, V>
  direction_report<scalar_t<V>> solve(N const& newton, V const& f,
                                      direction_request<scalar_t<V>> const& request, V& dy,
                                      P& p) const {
    using S = scalar_t<V>;
    auto const symmetric = slant::symmetrized(newton);
    detail::definite_on_range const h(symmetric);
    S const target = detail::attainable(request.tolerance) * request.residual_norm;

    symmetric.right_hand_side(f, p.b, p.s.a_workspace);
    if (!detail::is_finite(S(norm(p.b)))) {
      vectors::set_zero(dy);
      return {status::breakdown, request.residual_norm, 0, 1, 0};
    }
    p.preconditioner.assign(slant::slant_of_projection(newton));
    cg const method{h, p.b, p.preconditioner};
    vectors::scale(warm_start ? request.leftover : S(0), p.s.x);
    method.restart(p.s);
    detail::run_until(method, p.s, target, detail::iteration_limit(max_iterations, f),
                      [](auto const&) {});
    symmetric.step(f, p.s.x, dy, p.s.a_workspace);
    return {detail::verdict_on(p.s, target), p.s.residual_norm, p.s.iteration,
            p.s.work.operator_applications + 1, 0};
  }

  /// The complaint about operators that it cannot handle.
  template <class G, class V>
  static consteval void refuse() {
    static_assert(symmetrizable<G>,
                  "symmetrized_cg: F°(y) must be I − P° (I − ρA), A self-adjoint and definite");
  }
};

}  // namespace slant
