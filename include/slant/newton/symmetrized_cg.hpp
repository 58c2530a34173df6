// SPDX-License-Identifier: MIT
//
// Conjugate gradients for Newton systems (I − G (I − ρA)) dy = −F that can be symmetrised
// (slanting/symmetrized.hpp):
//
//     H s = G (ρA − I) F,     H = G (I − G) + ρ G A G,     dy = G s − F,
//
// preconditioned by M ≈ G⁺, block by block (slant_preconditioner).
//
// The residual of the symmetric system is that of Newton's, exactly: with dy = G s − F
//
//     H s − G (ρA − I) F = G (s − (I − ρA) dy) = F + F° dy,
//
// so stopping on ‖F + F° dy‖ ≤ η ‖F‖ costs nothing but the norm that CG computes anyway.
//
// Products by A: one an iteration and one for the right-hand side; a warm start costs one more.
#pragma once

#include <slant/base/entries.hpp>
#include <slant/base/vector_algebra.hpp>
#include <slant/concepts/laws.hpp>
#include <slant/concepts/linear_operator.hpp>
#include <slant/concepts/vector.hpp>
#include <slant/krylov/cg.hpp>
#include <slant/newton/direction.hpp>
#include <slant/operators/declare.hpp>
#include <slant/operators/small_blocks.hpp>
#include <slant/sets/cartesian.hpp>
#include <slant/sets/slants.hpp>
#include <slant/slanting/symmetrized.hpp>

#include <cstddef>
#include <type_traits>
#include <utility>

namespace slant {

// --- slant preconditioner ------------------------------------------------------------------------
//
// A preconditioner for H = G (I − G) + ρ G A G, the symmetrised Newton operator: M ≈ G⁺, block by
// block,
//
//     M_i = (G_i + √ε tr(G_i) I)⁻¹,     M_i = I where G_i = 0.
//
// On range(G), where the iteration lives, M^½ H M^½ is (I − G) + ρ G^½ A G^½ up to √ε. Since
// 0 ⪯ G ⪯ I its eigenvalues lie between min(1, ρσ_min) and max(1, ρσ_max): it is never worse
// conditioned than A if ρ is in [1/σ_max, 1/σ_min], whereas the eigenvalues of H are as small as
// those of G, that is radius/distance for a point far outside of a disc. No product by A is needed.
//
// A slanting operator whose blocks are not accessible is not preconditioned: M = I.

namespace detail {

/// G with its blocks replaced by M_i: nothing is known about the blocks of G.
template <class G>
struct range_inverse {
  static constexpr bool known = false;
};

template <class S, int N, class Layout, bool Identity>
struct range_inverse<block_diagonal_slant<S, N, Layout, Identity>> {
  static constexpr bool known = true;
  using slant_type = block_diagonal_slant<S, N, Layout, Identity>;

  static void assign(slant_type const& g, slant_type& m) {
    if constexpr (!Identity) {
      for (index i = 0; i < g.block_count(); ++i) m.assign(i, inverted(g.block(i)));
    }
  }

 private:
  using matrix_type = typename slant_type::matrix_type;

  static matrix_type inverted(matrix_type const& g) {
    using std::sqrt;
    S trace(0);
    for (int i = 0; i < N; ++i) trace += g.coeff(i, i);
    if (!(trace > S(0))) return matrix_type::Identity();
    if constexpr (N == 1) {
      return matrix_type::Constant(S(1) / trace);
    } else {
      // In units of the trace: a block may be as small as radius/distance is.
      S const shift = sqrt(detail::epsilon<S>());
      auto const shifted = from_entries<matrix_type>([&](int i, int j) -> S {
        return g.coeff(i, j) * (S(1) / trace) + (i == j ? shift : S(0));
      });
      matrix_type const inverse = definite_inverse(shifted);
      return from_entries<matrix_type>([&](int i, int j) -> S {
        return (inverse.coeff(i, j) + inverse.coeff(j, i)) * (S(1) / (S(2) * trace));
      });
    }
  }
};

template <class... Parts>
struct range_inverse<direct_sum_slant<Parts...>> {
  static constexpr bool known = (range_inverse<Parts>::known && ...);
  using slant_type = direct_sum_slant<Parts...>;

  static void assign(slant_type const& g, slant_type& m) {
    [&]<std::size_t... I>(std::index_sequence<I...>) {
      (range_inverse<Parts>::assign(g.template part<I>(), m.template part<I>()), ...);
    }(std::index_sequence_for<Parts...>{});
  }
};

}  // namespace detail

/// M for slanting operators of type G; made once, assigned often without allocation.
template <class G>
class slant_preconditioner {
 public:
  static constexpr law_set laws = slant::laws<slant::self_adjoint, slant::positive_definite>;
  /// Whether the blocks of G are accessible.
  static constexpr bool effective = detail::range_inverse<G>::known;

  explicit slant_preconditioner(G const& g) : blocks_(g) { assign(g); }

  /// M for another operator of the same blocks.
  void assign(G const& g) {
    if constexpr (effective) detail::range_inverse<G>::assign(g, blocks_);
  }

  [[nodiscard]] index rows() const { return blocks_.rows(); }
  [[nodiscard]] index cols() const { return blocks_.cols(); }

  /// y = M x.
  template <class X, class Y>
  void apply(X const& x, Y& y) const {
    if constexpr (effective) {
      blocks_.apply(x, y);
    } else {
      vectors::copy(x, y);
    }
  }

 private:
  G blocks_;
};

// --- symmetrized cg ------------------------------------------------------------------------------
//
// H = G (I − G) + ρ G A G is semidefinite. Its kernel is that of G, and right-hand sides lie in
// range(G): there it is definite, ⟨H x, x⟩ ≥ ρ ⟨A G x, G x⟩ > 0, and conjugate gradients need no
// more. The library's CG asks for a promise, which is given here for that reason.

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

  [[gnu::cold]] void validate() const { detail::check_iteration_limit(max_iterations); }

  template <class N, class V>
    requires symmetrizable<N> && linear_operator<N, V>
  [[nodiscard]] auto prepare(N const& newton, V const& f) const {
    using slant_type = std::remove_cvref_t<decltype(slant::slant_of_projection(newton))>;
    auto zero = like(f, slant::local(f).size());
    vectors::set_zero(zero);
    slant_preconditioner<slant_type> m(slant::slant_of_projection(newton));
    auto const h = declare<positive_definite>(slant::symmetrized(newton));
    auto s = cg{h, zero, m}.start(zero);
    return symmetrized_cg_workspace<V, decltype(m), decltype(s)>{std::move(zero), std::move(m),
                                                                 std::move(s)};
  }

  template <class N, class V, class P>
    requires symmetrizable<N> && linear_operator<N, V>
  report_of<V> solve(N const& newton, V const& f, request_of<V> const& request, V& dy, P& p) const {
    using S = scalar_t<V>;
    auto const symmetric = slant::symmetrized(newton);
    auto const h = declare<positive_definite>(symmetric);
    S const target = detail::attainable(request.tolerance) * request.residual_norm;

    symmetric.right_hand_side(f, p.b, p.s.a_workspace);
    if (!detail::is_finite(S(norm(p.b)))) {
      vectors::set_zero(dy);
      return {status::breakdown, request.residual_norm, 0, 1, 0};
    }
    p.preconditioner.assign(slant::slant_of_projection(newton));
    cg const method{h, p.b, p.preconditioner};
    vectors::set_zero(p.s.x);
    method.restart(p.s);
    detail::run_until(method, p.s, target, detail::iteration_limit(max_iterations, f),
                      [](auto const&) {});
    symmetric.step(f, p.s.x, dy, p.s.a_workspace);
    return {detail::verdict_on(p.s, target), p.s.residual_norm, p.s.iteration,
            p.s.work.operator_applications + 1, 0};
  }

  template <class G, class V>
  static consteval void refuse() {
    static_assert(symmetrizable<G>,
                  "symmetrized_cg: F°(y) must be I − P° (I − ρA), A self-adjoint and definite");
  }
};

}  // namespace slant
