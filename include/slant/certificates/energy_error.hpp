// SPDX-License-Identifier: MIT
//
// How far a point is from the solution, in the energy norm: a bound that needs no knowledge of the
// solution, for
//
//     minimise  q(x) = ½ xᵀA x − bᵀx   over   x ∈ Λ,        A symmetric positive definite.
//
// Let x ∈ Λ, g = A x − b, and x* the solution with g* = A x* − b, e = ‖x − x*‖_A. For every s with
// a finite support value γ = sᵀx + σ_Λ(−s) ≥ 0 and
//
//     e² = (g − g*)ᵀ(x − x*) ≤ gᵀ(x − x*)              −g* is normal to Λ at x*
//        = (g − s)ᵀ(x − x*) + sᵀx − sᵀx*
//        ≤ δ e + γ,                                    δ = ‖g − s‖_{A⁻¹},  −sᵀx* ≤ σ_Λ(−s)
//
// so that   e ≤ ½ (δ + √(δ² + 4γ)).   With s = g this is the square root of the duality gap, with
// −s the normal next to −g it is the reduced gradient in the norm of A⁻¹; normal_part.hpp chooses
// block by block. If only an approximate gradient ĝ with ‖g − ĝ‖_{A⁻¹} ≤ ε is known, δ + ε stands
// for δ.
//
// δ needs A⁻¹ or something above it. energy_certificate{qp, dominates_inverse(M)} takes an operator
// M ⪰ A⁻¹: the result is a bound, up to the rounding of a few sums. energy_certificate{qp} and {qp,
// M} find δ by conjugate gradients (dual_norm.hpp), which see A⁻¹ only from below: an estimate.
//
// Where A is only semidefinite the same inequalities hold for d = g − s in the range of A; x* is
// then any solution.
#pragma once

#include <slant/certificates/dual_norm.hpp>
#include <slant/certificates/normal_part.hpp>
#include <slant/concepts/capabilities.hpp>
#include <slant/concepts/checks.hpp>
#include <slant/concepts/distributed.hpp>
#include <slant/concepts/linear_operator.hpp>
#include <slant/concepts/vector.hpp>
#include <slant/krylov/mean_diagonal.hpp>
#include <slant/krylov/unit.hpp>
#include <slant/operators/diagonal.hpp>
#include <slant/operators/identity.hpp>

#include <cmath>
#include <concepts>
#include <limits>
#include <string>
#include <type_traits>
#include <utility>

namespace slant {

/// What is known of ‖x − x*‖_A.
template <class S>
struct energy_error {
  S bound = std::numeric_limits<S>::infinity();  ///< of ‖x − x*‖_A
  S size{0};            ///< ‖x‖_A, what the error is relative to up to the error itself
  bool proven = false;  ///< a bound in floating point; else an estimate

  /// The bound over the energy norm of the solution, of which size − bound is a lower bound, and
  /// size − 2 bound where the bound is estimated: far from the solution the two terms nearly agree,
  /// and an estimate a trifle too small would leave a difference that means nothing. ∞ if nothing
  /// of the solution is known, 0 if the bound is 0.
  [[nodiscard]] S relative() const {
    if (bound == S(0)) return S(0);
    S const least = proven ? S(size - bound) : S(size - S(2) * bound);
    return least > S(0) ? S(bound / least) : std::numeric_limits<S>::infinity();
  }
  /// "energy error at most 3e-10 (proven)".
  [[nodiscard]] std::string sentence() const {
    return "relative energy error " + detail::show(relative()) +
           (proven ? ", proven" : ", estimated");
  }
};

/// ½ (δ + √(δ² + 4γ)), rounded upwards; NaN if δ or γ is.
template <class S>
[[nodiscard]] S error_bound(S const& δ, S const& γ) {
  using std::sqrt;
  S const root = S(2) * sqrt(γ);
  S const larger = δ > root ? δ : root, smaller = δ > root ? root : δ;
  if (!(larger > S(0))) return δ + γ;
  S const ratio = smaller / larger;
  return (δ + larger * sqrt(S(1) + ratio * ratio)) / S(2) *
         (S(1) + S(8) * std::numeric_limits<S>::epsilon());
}

/// d = g − s for all blocks of Λ at x, with the sum of the gaps; m holds the stiffness of each
/// component, of the size of diag(A⁻¹), ∞ where nothing resists. d may be g. Whether every gap is
/// free of cancellation is known from the type: `exact`.
template <class S>
struct balanced_gradient {
  S gap{0};
  bool exact = true;
};

template <class C, class X, class G, class M, class D>
[[nodiscard]] auto balance(C const& set, X const& x, G const& g, M const& m, D& d)
    -> balanced_gradient<scalar_t<X>> {
  using S = scalar_t<X>;
  balanced_gradient<S> result;
  index terms = 0;
  if constexpr (std::is_same_v<G, D>) {
    if (&g != &d) slant::local(d) = slant::local(g);
  } else {
    slant::local(d) = slant::local(g);
  }
  slant::visit_blocks(set, [&](auto const& block, auto const& p) {
    using block_type = std::remove_cvref_t<decltype(block)>;
    if constexpr (!whole_space<block_type>) {
      S ρ(0);
      for (index j = 0; j < p.size(); ++j) ρ += slant::local(m).coeff(p.component(j));
      ρ /= S(2 * p.size());
      auto const part = split_gradient(block, p.value(x), p.value(d), ρ);
      p.put(d, part.rest);
      result.gap += part.gap;
      ++terms;
      if constexpr (!has_exact_normal_part<block_type>) result.exact = false;
    }
  });
  result.gap *= S(1) + S(terms + 64) * std::numeric_limits<S>::epsilon();
  return result;
}

/// An operator M ⪰ A⁻¹, with that promise.
template <class M>
struct dominating_inverse {
  M const* inverse;
};
template <class M>
[[nodiscard]] dominating_inverse<M> dominates_inverse(M const& m) {
  return {&m};
}
template <class M>
dominating_inverse<M> dominates_inverse(M const&&) = delete;

/// certificate(x) → energy_error of P_Λ(x). Refers to the problem and to M. One application of A
/// and one of M with `dominates_inverse(M)`, which gives a bound up to rounding; else some 10 of
/// each, for conjugate gradients preconditioned by M, and an estimate. Without M they are
/// preconditioned by diag(A)⁻¹ where A gives its diagonal or has no more than 64 rows, for as many
/// applications: unknowns in units of their own would else hide the error from the estimate.
template <class QP, class M = identity_operator>
class energy_certificate {
 public:
  using vector_type = typename QP::vector_type;
  using scalar = typename QP::scalar;

  /// Without a preconditioner.
  explicit energy_certificate(QP const& qp)
    requires std::same_as<M, identity_operator>
      : energy_certificate(qp, identity_operator(qp.size()), false) {}
  energy_certificate(QP const& qp, M const& m) : energy_certificate(qp, m, false) {}
  energy_certificate(QP const& qp, dominating_inverse<M> m)
      : energy_certificate(qp, *m.inverse, true) {}
  energy_certificate(QP const&&, M const&) = delete;

  [[nodiscard]] energy_error<scalar> operator()(vector_type const& x0) {
    slant::project(qp_->set(), slant::local(x0), slant::local(x_));
    slant::apply(qp_->a(), x_, g_, a_workspace_);
    ++applications_;
    energy_error<scalar> e;
    e.size = root_of(x_, g_);
    slant::local(g_) -= slant::local(qp_->b());
    auto const balanced = balance(qp_->set(), x_, g_, stiffness_, g_);
    scalar δ(0);
    if (dominates_) {
      slant::apply(m_, g_, norm_.z, norm_.of_m);
      δ = root_of(g_, norm_.z);
    } else {
      auto const estimate =
          dual_norm(qp_->a(), preconditioner(), g_, most_, false, a_workspace_, norm_);
      applications_ += estimate.applications;
      δ = estimate.value;
    }
    e.bound = error_bound<scalar>(δ, balanced.gap);
    return e;
  }
  /// Applications of A so far.
  [[nodiscard]] index applications() const { return applications_; }

 private:
  energy_certificate(QP const& qp, M const& m, bool dominates)
      : qp_(&qp),
        m_(m),
        dominates_(dominates),
        most_(qp.size() < 200 ? qp.size() + 8 : index(200)),
        x_(like(qp.b(), qp.size())),
        g_(like(qp.b(), qp.size())),
        stiffness_(like(qp.b(), qp.size())),
        a_workspace_(workspace(qp.a(), qp.b())),
        norm_(preconditioner(), qp.b()) {
    detail::check_size("rows of M", index(m.rows()), qp.size(), "the size of the problem,");
    set_stiffness();
  }

  static constexpr bool is_plain = std::same_as<M, identity_operator>;
  using diagonal_inverse = diagonal_operator<vector_type const&>;
  using preconditioner_type = std::conditional_t<is_plain, diagonal_inverse, M>;

  /// M, or diag(stiffness) in its place.
  [[nodiscard]] decltype(auto) preconditioner() const {
    if constexpr (is_plain) {
      return diagonal_inverse(held<vector_type const&>(stiffness_));
    } else {
      return (m_);
    }
  }

  /// 1/diag A if A gives it, else the size of A⁻¹ that mean(diag A) or M says.
  void set_stiffness() {
    using A = typename QP::operator_type;
    auto const mean = mean_diagonal(qp_->a(), qp_->b());
    applications_ += mean.applications;
    scalar const typical = mean.value > scalar(0) ? scalar(scalar(1) / mean.value) : scalar(1);
    auto const invert = [&] {
      for (index i = 0; i < slant::local(stiffness_).size(); ++i) {
        auto& entry = slant::local(stiffness_).coeffRef(i);
        entry = entry > scalar(0) ? scalar(scalar(1) / entry) : typical;
      }
    };
    slant::local(stiffness_).setConstant(typical);
    if constexpr (has_diagonal<A, vector_type>) {
      qp_->a().diagonal(stiffness_);
      invert();
    } else if constexpr (is_plain) {
      index const n = slant::local(stiffness_).size();
      if (!slant::everywhere(stiffness_, n == slant::global_size(stiffness_) && n <= 64)) return;
      for (index i = 0; i < n; ++i) {
        slant::local(x_).setZero();
        slant::local(x_).coeffRef(i) = scalar(1);
        slant::apply(qp_->a(), x_, g_, a_workspace_);
        slant::local(stiffness_).coeffRef(i) = slant::local(g_).coeff(i);
      }
      applications_ += n;
      invert();
    }
  }
  /// √(xᵀy) for a product that is ≥ 0 but for rounding.
  static scalar root_of(vector_type const& x, vector_type const& y) {
    using std::sqrt;
    scalar const ux = unit_near(slant::norm(x)), uy = unit_near(slant::norm(y));
    scalar const product = (slant::local(x) / ux).dot(slant::local(y) / uy);
    if (!(product > scalar(0))) return product == product ? scalar(0) : product;
    return scalar(sqrt(product)) * scalar(sqrt(ux)) * scalar(sqrt(uy));
  }

  QP const* qp_;
  M m_;
  bool dominates_;
  index most_;
  index applications_ = 0;
  vector_type x_, g_, stiffness_;
  workspace_t<typename QP::operator_type, vector_type> a_workspace_;
  dual_norm_workspace<vector_type, preconditioner_type> norm_;
};

template <class QP>
energy_certificate(QP const&) -> energy_certificate<QP, identity_operator>;
template <class QP, class M>
energy_certificate(QP const&, M const&) -> energy_certificate<QP, M>;
template <class QP, class M>
energy_certificate(QP const&, dominating_inverse<M>) -> energy_certificate<QP, M>;

}  // namespace slant
