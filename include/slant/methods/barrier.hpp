// SPDX-License-Identifier: MIT
//
// What the inequalities f(x) ≤ 0 of a product of blocks contribute to an interior-point method at a
// point with slacks z = −f(x) > 0 and multipliers ν > 0 [K §3.2.1, §3.2.3]:
//
//     G = ∇f(x),   D₂₂ = N⁻¹Z,   W = Σ ν_i ∇²f_i + G D₂₂⁻¹ Gᵀ,   P_SC = diag(A) + W.
//
// J_SC = A + W. All of W and P_SC is made of small blocks, one for each block of the set with an
// inequality; free blocks have no row, no multiplier, no slack and no entry here.
//
// Units. f of a disc is a square of lengths, that of an ellipse a pure number. Each f_i is divided
// by a power of two σ_i such that z_i is of the order of the distance to the boundary; multipliers
// are then forces, whatever form a block gives to its inequality.
//
// W is semidefinite even where an f_i is not convex: with z = −f(x), ν_i (∇²f_i + ∇f_i ∇f_iᵀ/z_i)
// is ν_i z_i times the Hessian of −log(−f_i), and that is convex for cones as well.
#pragma once

#include <slant/base/vector_algebra.hpp>
#include <slant/concepts/bad_input.hpp>
#include <slant/concepts/linear_operator.hpp>
#include <slant/concepts/vector.hpp>
#include <slant/methods/parts/curved_minimum.hpp>
#include <slant/methods/parts/lorentz_pairs.hpp>
#include <slant/methods/parts/recession.hpp>
#include <slant/operators/block.hpp>
#include <slant/operators/block_diagonal.hpp>
#include <slant/operators/declare.hpp>
#include <slant/operators/diagonal.hpp>
#include <slant/operators/identity.hpp>
#include <slant/operators/letter.hpp>
#include <slant/operators/product.hpp>
#include <slant/operators/small_blocks.hpp>
#include <slant/operators/sum.hpp>
#include <slant/slanting/inequality_jacobian.hpp>

#include <Eigen/Core>

#include <memory>
#include <type_traits>
#include <utility>
#include <vector>

namespace slant {

/// The inequalities of a set with their derivatives at a point. Rows: one per inequality, in the
/// order of the blocks.
template <scalar S = double>
class barrier {
 public:
  using column = Eigen::Matrix<S, Eigen::Dynamic, 1>;
  using curvature_operator = small_blocks<S>;
  using stiffness_operator = small_blocks<S, laws<positive_semidefinite>>;
  using preconditioner_operator = small_blocks<S, laws<positive_semidefinite>>;

  /// Room for the blocks of a set; allocates.
  template <class C>
  explicit barrier(C const& set)
      : layout_(std::make_shared<detail::inequality_layout const>(set)),
        jacobian_(layout_),
        curvature_(layout_->cols()),
        stiffness_(layout_->cols()),
        preconditioner_(layout_->cols()),
        per_unit_(column::Zero(layout_->rows())),
        outside_(column::Zero(layout_->cols())) {
    slant::visit_blocks(set, [this](auto const& block, auto const& place) {
      using block_type = std::remove_cvref_t<decltype(block)>;
      if constexpr (single_point<block_type>) hold(place);
      if constexpr (detail::inequalities_of<block_type> > 0) {
        index const stride = place.size() > 1 ? place.component(1) - place.component(0) : 1;
        curvature_.append(place.size(), place.component(0), stride);
        stiffness_.append(place.size(), place.component(0), stride);
        preconditioner_.append(place.size(), place.component(0), stride);
      }
    });
  }

  /// Number of inequalities; some of them may be without a bound and then count for nothing.
  [[nodiscard]] index rows() const noexcept { return layout_->rows(); }
  /// 1/σ, 0 for an inequality without a bound.
  [[nodiscard]] column& per_unit() noexcept { return per_unit_; }
  [[nodiscard]] column const& per_unit() const noexcept { return per_unit_; }
  /// G ᵀ, in units σ.
  [[nodiscard]] inequality_jacobian<S> const& jacobian() const noexcept { return jacobian_; }
  /// Σ ν_i ∇²f_i.
  [[nodiscard]] curvature_operator const& curvature() const noexcept { return curvature_; }
  /// W.
  [[nodiscard]] stiffness_operator const& stiffness() const noexcept { return stiffness_; }
  /// P_SC⁻¹; 0 on components of single points.
  [[nodiscard]] preconditioner_operator const& preconditioner() const noexcept {
    return preconditioner_;
  }

  /// z = −f(x)/σ, 1 where there is no bound; whether all are numbers > 0.
  template <class C, class X, class Z>
  [[nodiscard]] bool slacks(C const& set, X const& x, Z& z) const {
    auto& out = slant::local(z);
    index row = 0;
    bool inside = true;
    slant::visit_blocks(set, [&](auto const& block, auto const& place) {
      constexpr int k = detail::inequalities_of<std::remove_cvref_t<decltype(block)>>;
      if constexpr (k > 0) {
        auto const f = block.inequality(place.value(x));
        for (index i = 0; i < k; ++i, ++row) {
          bool const bound = per_unit_.coeff(row) > S(0);
          out.coeffRef(row) = bound ? S(-f.coeff(i) * per_unit_.coeff(row)) : S(1);
          inside = inside && out.coeff(row) > S(0);
        }
      }
    });
    return inside;
  }

  /// G at x.
  template <class C, class X>
  void linearise(C const& set, X const& x) {
    jacobian_.renew(set, x);
    jacobian_.scale_rows(per_unit_);
  }

  /// Σ ν_i ∇²f_i, W and P_SC⁻¹ at x, where G is, for the diagonal d of A. `unit` is that of ν.
  template <class C, class X, class M, class Z, class D>
  void assemble(C const& set, X const& x, M const& ν, Z const& z, S const& unit, D const& d) {
    assemble(set, x, ν, z, unit, d, no_pairs{});
  }
  /// The same where bounded sections of the Lorentz cone have W from their pairs.
  template <class C, class X, class M, class Z, class D, class Pairs>
  void assemble(C const& set, X const& x, M const& ν, Z const& z, S const& unit, D const& d,
                Pairs const& pairs) {
    lorentz_place of_pairs;
    auto const& multipliers = slant::local(ν);
    auto const& slack = slant::local(z);
    auto const& diagonal = slant::local(d);
    index row = 0, entry = 0, number = 0;
    slant::visit_blocks(set, [&](auto const& block, auto const& place) {
      using block_type = std::remove_cvref_t<decltype(block)>;
      constexpr int n = static_dimension_of<block_type>;
      constexpr int k = detail::inequalities_of<block_type>;
      if constexpr (k > 0) {
        using square = Eigen::Matrix<S, n, n>;
        Eigen::Matrix<S, k, 1> forces, weights;
        for (int i = 0; i < k; ++i) {
          forces[i] = unit * multipliers.coeff(row + i);
          weights[i] = forces[i] * per_unit_.coeff(row + i);
        }
        square w = block.inequality_hessian(place.value(x), weights);
        curvature_.template block<n>(number) = w;
        for (int i = 0; i < k; ++i) {
          S const stiff = forces[i] / slack.coeff(row + i);
          S const* const g = jacobian_.entries().data() + entry + n * i;
          for (int c = 0; c < n; ++c) {
            for (int r = 0; r < n; ++r) w.data()[r + n * c] += (stiff * g[r]) * g[c];
          }
        }
        replace_by_pairs(block, pairs, of_pairs, row, unit, w);
        stiffness_.template block<n>(number) = w;
        for (int j = 0; j < n; ++j) w.data()[j + n * j] += diagonal.coeff(place.component(j));
        preconditioner_.template block<n>(number) = detail::definite_inverse(w);
        row += k;
        entry += k * n;
        ++number;
      }
    });
    outside_ = diagonal.cwiseInverse();
    keep_fixed(outside_);
    preconditioner_.assign_outside(outside_);
  }

  /// Counts the components of a block as those of a single point.
  template <class Place>
  void hold(Place const& place) {
    for (index j = 0; j < place.size(); ++j) fixed_.push_back(place.component(j));
  }
  /// Zero on the components of single points.
  template <class V>
  void keep_fixed(V& v) const {
    auto& entries = slant::local(v);
    for (index const i : fixed_) entries.coeffRef(i) = S(0);
  }

 private:
  struct no_pairs {};

  /// W of a block from its pairs, where it has some.
  template <class B, class Pairs, class W>
  static void replace_by_pairs(B const& block, Pairs const& pairs, lorentz_place& of_pairs,
                               index row, S const& unit, W& w) {
    if constexpr (std::is_same_v<Pairs, lorentz_pairs<S>> && lorentz_block<B>) {
      auto const at = of_pairs.template next<B>(row);
      if (pairs.bound(at.number)) w = detail::multiple_of(unit, pairs.stiffness(block, at));
    }
  }

  std::shared_ptr<detail::inequality_layout const> layout_;
  inequality_jacobian<S> jacobian_;
  curvature_operator curvature_;
  stiffness_operator stiffness_;
  preconditioner_operator preconditioner_;
  column per_unit_;
  column outside_;
  std::vector<index> fixed_;
};

// --- minimum -------------------------------------------------------------------------------------
//
// The reduced system of an interior-point step [K (43)],
//
//     J_SC t = −g₀,     J_SC = A + W,
//
// by conjugate gradients with the preconditioner P_SC = D + W, D ≈ diag(A). A t comes along, so
// whoever takes the step knows the gradient at its end: one product by A a step of the iteration
// and none besides, also for a start t₀ ≠ 0, whose image is known from the step that made it. Of
// its multiples the one with the least energy is taken, which is never worse than 0.
//
// With M ≈ A⁻¹ at hand the preconditioner is, D ≈ diag(M)⁻¹,
//
//     P⁻¹ = P_SC⁻¹ (D M D + W) P_SC⁻¹:
//
// M where nothing is near its bound (W = 0), W⁻¹ where it is (W → ∞), P_SC⁻¹ for M = D⁻¹, and
// definite in between.

/// The solution t, its image, and what the iteration works in.
template <class V, class M>
class barrier_minimum {
 public:
  using scalar = scalar_t<V>;

  V t;                    ///< the step
  V image = t;            ///< A t
  V direction = t;        ///< the last direction of the iteration
  V direction_image = t;  ///< A times it
  bool flat = false;      ///< it has no curvature

  barrier_minimum(V const& prototype, index n, M const& m)
      : t(like(prototype, n)),
        near_(like(prototype, preconditioned ? n : 0)),
        m_workspace_(workspace(m, prototype)) {
    forget();
  }

  /// No step is known yet.
  void forget() {
    vectors::set_zero(t);
    vectors::set_zero(image);
    known_ = false;
  }

  /// t with ‖g₀ + J_SC t‖ ≤ target, one whose last terms are less than share · ‖t‖_A, or the last
  /// one after at most `most` steps. t has the units of g₀ over those of A; d is the diagonal of D,
  /// trace that of A. `warm`: begins at a multiple of the t that is there.
  template <class A, class WA, class B>
  inner_result<scalar> solve(A const& a, WA& a_workspace, M const& m, B const& barrier, V const& d,
                             V const& g0, scalar const& target, scalar const& share, index most,
                             bool warm, scalar const& trace) {
    auto const end_where = [&](auto const& is_flat, bool from_last) {
      return iterate(a, a_workspace, m, barrier, d, g0, target, share, most, from_last, trace,
                     is_flat);
    };
    auto found = end_where([](scalar const& bend) { return !(bend > scalar(0)); }, warm);
    if constexpr (!declares_positive_definite<A>) {
      if (found.finite) return found;
      // Directions of the kernel whose curvature is that of rounding errors grow without bound.
      index const before = found.iterations;
      forget();
      found = end_where([&](scalar const& bend) { return !(bend > flatness(direction, trace)); },
                        false);
      found.iterations += before;
    }
    return found;
  }

 private:
  static constexpr bool preconditioned = !std::is_same_v<M, identity_operator>;

  template <class A, class WA, class B, class Flat>
  inner_result<scalar> iterate(A const& a, WA& a_workspace, M const& m, B const& barrier,
                               V const& d, V const& g0, scalar const& target, scalar const& share,
                               index most, bool warm, scalar const& trace, Flat const& is_flat) {
    vectors::copy(g0, g_);
    barrier.keep_fixed(g_);
    if (warm && known_) {
      begin_at_multiple(barrier);
    } else {
      forget();
    }
    known_ = true;
    flat = false;
    scalar size = norm(g_), gz(0), recent(0);
    bool finite = detail::is_finite(size);
    index k = 0;
    while (k < most && size > target) {
      precondition(m, barrier, d);
      scalar const next = inner_product(g_, z_);
      finite = finite && detail::is_finite(next);
      if (!(next > scalar(0))) break;
      if (k == 0) {
        vectors::negate(z_, direction);
      } else {
        vectors::waxpby(next / gz, direction, scalar(-1), z_, direction);
      }
      gz = next;
      slant::apply(a, direction, direction_image, a_workspace);
      ++k;
      add_stiffness(barrier, direction, direction_image, z_);
      scalar const bend = inner_product(direction, z_);
      finite = finite && detail::is_finite(bend);
      if (is_flat(bend)) {  // a direction without curvature: the step ends here
        // W is semidefinite up to rounding; is A?
        flat = true;
        finite = finite && -inner_product(direction, direction_image) <=
                               scalar(64) * flatness(direction, trace);
        break;
      }
      scalar const α = gz / bend;
      vectors::axpy(α, direction, t);
      vectors::axpy(α, direction_image, image);
      vectors::axpy(α, z_, g_);
      size = norm(g_);
      if (share > scalar(0)) {
        // In the energy of A: J_SC's is the barrier's, which the first terms have found.
        recent = scalar(0.7) * recent + α * α * inner_product(direction, direction_image);
        if (k > 2 && recent < share * share * inner_product(t, image)) break;
      }
    }
    return {k, size, finite && detail::is_finite(size)};
  }

  /// z = P⁻¹ g.
  template <class B>
  void precondition(M const& m, B const& barrier, V const& d) {
    if constexpr (preconditioned) {
      slant::apply(barrier.preconditioner(), g_, near_);
      vectors::multiply(d, near_, far_);
      slant::apply(m, far_, z_, m_workspace_);
      vectors::multiply(d, z_, far_);
      barrier.stiffness().apply_add(scalar(1), near_, far_);
      slant::apply(barrier.preconditioner(), far_, z_);
      barrier.keep_fixed(z_);
    } else {
      static_cast<void>(m);
      static_cast<void>(d);
      slant::apply(barrier.preconditioner(), g_, z_);
    }
  }

  /// y = J_SC x for x with the image Ax.
  template <class B>
  void add_stiffness(B const& barrier, V const& x, V const& Ax, V& y) const {
    vectors::copy(Ax, y);
    barrier.stiffness().apply_add(scalar(1), x, y);
    barrier.keep_fixed(y);
  }

  /// t ← θ t with the θ that minimises g₀ᵀt + ½ tᵀJ_SC t, and g with it.
  template <class B>
  void begin_at_multiple(B const& barrier) {
    add_stiffness(barrier, t, image, z_);
    scalar const bend = inner_product(t, z_), slope = -inner_product(g_, t);
    if (!(bend > scalar(0)) || !detail::is_finite(bend) || !detail::is_finite(slope)) {
      forget();
      return;
    }
    scalar const θ = slope / bend;
    vectors::scale(θ, t);
    vectors::scale(θ, image);
    vectors::axpy(θ, z_, g_);
  }

  V g_ = t;               // g₀ + J_SC t
  V z_ = t;               // preconditioned g, then J_SC p
  V near_, far_ = near_;  // parts of the preconditioned g
  workspace_t<M, V> m_workspace_;
  bool known_ = false;
};

// --- reduced systems -----------------------------------------------------------------------------
//
// The two reduced systems of an interior-point step and their preconditioners [K §3.2.3], as
// compositions of operators:
//
//     J_SC = J₁₁ + G D₂₂⁻¹ Gᵀ            P_SC = D₁₁ + G D₂₂⁻¹ Gᵀ          J₁₁ = A + Σ ν_i ∇²f_i
//     J_AM = [ J₁₁   G  ]                P_AM = [ D₁₁   G  ]              D₁₁ = D + Σ ν_i ∇²f_i
//            [ Gᵀ  −D₂₂ ]                       [ Gᵀ  −D₂₂ ]              D₂₂ = N⁻¹Z
//
// The spectrum of P_SC⁻¹J_SC lies in [σ_min(A)/max D, σ_max(A)/min D] at every iterate if D =
// diag(A) [K Theorem 4]; that of P_AM⁻¹J_AM is the same and, besides, the number 1 [K Theorem 3].
//
// interior_point works with the first. Conjugate gradients preconditioned by P_AM, once they have
// solved the second block row, make the steps on x that they make on J_SC: the number of products
// is the same (tests/methods/reduced_systems_test.cpp), vectors are longer and P_AM is not
// definite.

/// J_SC = A + W; refers to the barrier, and to A if it is an lvalue.
template <class A, class S>
[[nodiscard]] auto schur_system(A&& a, barrier<S> const& b) {
  return sum(std::forward<A>(a), b.stiffness());
}
template <class A, class S>
void schur_system(A&& a, barrier<S> const&& b) = delete;

/// J_AM for D₂₂, slacks over multipliers; refers to the barrier, and to A if it is an lvalue.
template <class A, class S>
[[nodiscard]] auto augmented_system(A&& a, barrier<S> const& b,
                                    typename barrier<S>::column const& d22) {
  using column = typename barrier<S>::column;
  return declare<self_adjoint>(
      block(block_row(sum(std::forward<A>(a), b.curvature()), adjoint(b.jacobian())),
            block_row(b.jacobian(), slant::diagonal(column(-d22)))));
}

template <class A, class S>
void augmented_system(A&& a, barrier<S> const&& b, typename barrier<S>::column const& d22) = delete;

/// P_AM⁻¹ = U [P_SC⁻¹, −D₂₂⁻¹] Uᵀ, U = [I, 0; D₂₂⁻¹Gᵀ, I]; refers to the barrier.
template <class S>
[[nodiscard]] auto augmented_preconditioner(barrier<S> const& b,
                                            typename barrier<S>::column const& d22) {
  using column = typename barrier<S>::column;
  column const inverse = d22.cwiseInverse();
  return congruence(
      block(block_row(identity(b.stiffness().rows()), zero(b.stiffness().rows(), b.rows())),
            block_row(product(slant::diagonal(column(inverse)), b.jacobian()), identity(b.rows()))),
      block_diagonal(b.preconditioner(), slant::diagonal(column(-inverse))));
}
template <class S>
void augmented_preconditioner(barrier<S> const&& b, typename barrier<S>::column const&) = delete;

}  // namespace slant
