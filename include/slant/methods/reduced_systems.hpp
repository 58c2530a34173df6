// SPDX-License-Identifier: MIT
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
#pragma once

#include <slant/methods/parts/barrier.hpp>
#include <slant/operators/block.hpp>
#include <slant/operators/declare.hpp>
#include <slant/operators/diagonal.hpp>
#include <slant/operators/letter.hpp>
#include <slant/operators/sum.hpp>

#include <utility>

namespace slant {

/// J_SC = A + W; refers to the barrier, and to A if it is an lvalue.
template <class A, class S>
[[nodiscard]] auto schur_system(A&& a, barrier<S> const& b) {
  return sum(std::forward<A>(a), b.stiffness());
}
template <class A, class S>
void schur_system(A&& a, barrier<S> const&& b) = delete;

/// D₂₂ = N⁻¹Z for multipliers > 0; `unit` is theirs.
template <class M, class Z, class S>
[[nodiscard]] auto complementarity_diagonal(M const& ν, Z const& z, S const& unit) {
  using column = typename barrier<S>::column;
  return column((slant::local(z).array() / slant::local(ν).array() / unit).matrix());
}

/// J_AM for D₂₂; refers to the barrier, and to A if it is an lvalue.
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

/// P_AM⁻¹ by elimination of the second row: x = P_SC⁻¹ (r₁ + G D₂₂⁻¹ r₂), ν = D₂₂⁻¹ (Gᵀ x − r₂).
template <class S>
class augmented_preconditioner {
 public:
  using column = typename barrier<S>::column;
  static constexpr law_set laws = slant::laws<self_adjoint>;

  struct temporaries {
    column head, tail, gradient;
  };

  /// Refers to the barrier.
  augmented_preconditioner(barrier<S> const& b, column d22) : barrier_(&b), d22_(std::move(d22)) {}
  augmented_preconditioner(barrier<S> const&& b, column d22) = delete;

  [[nodiscard]] index rows() const { return barrier_->stiffness().rows() + barrier_->rows(); }
  [[nodiscard]] index cols() const { return rows(); }

  template <class X>
  [[nodiscard]] temporaries workspace(X const&) const {
    index const n = barrier_->stiffness().rows();
    return {column(n), column(barrier_->rows()), column(n)};
  }
  template <class X, class Y>
  void apply(X const& x, Y& y, temporaries& w) const {
    auto const& from = slant::local(x);
    auto& to = slant::local(y);
    index const n = w.head.size(), m = w.tail.size();
    w.gradient = from.head(n);
    w.tail = from.tail(m).cwiseQuotient(d22_);
    barrier_->jacobian().apply_adjoint_add(S(1), w.tail, w.gradient);
    barrier_->preconditioner().apply(w.gradient, w.head);
    barrier_->jacobian().apply(w.head, w.tail);
    to.head(n) = w.head;
    to.tail(m) = (w.tail - from.tail(m)).cwiseQuotient(d22_);
  }

 private:
  barrier<S> const* barrier_;
  column d22_;
};

}  // namespace slant
