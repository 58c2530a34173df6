// SPDX-License-Identifier: MIT
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
#pragma once

#include <slant/base/entries.hpp>
#include <slant/base/vector_algebra.hpp>
#include <slant/concepts/laws.hpp>
#include <slant/concepts/vector.hpp>
#include <slant/operators/small_blocks.hpp>
#include <slant/sets/cartesian.hpp>
#include <slant/sets/slants.hpp>

#include <Eigen/Core>

#include <cstddef>
#include <limits>
#include <utility>

namespace slant {

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
      S const shift = sqrt(std::numeric_limits<S>::epsilon());
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

}  // namespace slant
