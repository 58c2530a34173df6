// SPDX-License-Identifier: MIT
//
// The error of a point as the solution of a quadratic program min ½ xᵀA x − bᵀx over x ∈ Λ, or with
// a function φ(x) added, in the energy norm, by the inequality of energy_error.hpp:
//
//     energy_certificate{qp, dominates_inverse(M)}    a bound, up to the rounding of a few sums: δ
//                                                     from an operator M ⪰ A⁻¹
//     energy_certificate{qp}, {qp, M}                 an estimate: newton_estimate.hpp, with
//                                                     ‖rest‖_{A⁻¹} from conjugate gradients
//                                                     (dual_norm.hpp), which see A⁻¹ from below
#pragma once

#include <slant/base/vector_algebra.hpp>
#include <slant/certificates/dual_norm.hpp>
#include <slant/certificates/energy_error.hpp>
#include <slant/certificates/newton_estimate.hpp>
#include <slant/concepts/bad_input.hpp>
#include <slant/concepts/linear_operator.hpp>
#include <slant/concepts/vector.hpp>
#include <slant/krylov/spectrum.hpp>
#include <slant/operators/diagonal.hpp>
#include <slant/operators/identity.hpp>
#include <slant/problems/quadratic_program.hpp>
#include <slant/sets/block_queries.hpp>

#include <concepts>
#include <optional>
#include <type_traits>

namespace slant {

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

/// certificate(x) → energy_error of P_Λ(x), with a function of x as it is, where φ is finite. Refers
/// to the problem and keeps a copy of M. One application of A and one of M with
/// `dominates_inverse(M)`, which gives a bound up to rounding; else some 10 of each, for conjugate
/// gradients preconditioned by M, and an estimate. Without M they are preconditioned by diag(A)⁻¹
/// where A gives its diagonal or has no more than 64 rows, for as many applications: unknowns in
/// units of their own would else hide the error from the estimate.
template <class QP, class M = identity_operator>
class energy_certificate : detail::certificate_preconditioner<typename QP::vector_type, M> {
  using base = detail::certificate_preconditioner<typename QP::vector_type, M>;
  using base::m_, base::stiffness_, base::typical_, base::size_of_load_, base::most_,
      base::preconditioner;
  using typename base::preconditioner_type;

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
  explicit energy_certificate(QP const&&) = delete;
  energy_certificate(QP const&&, M const&) = delete;
  energy_certificate(QP const&&, dominating_inverse<M>) = delete;

  [[nodiscard]] energy_error<scalar> operator()(vector_type const& x0) {
    if constexpr (quadratic_program<QP>) {
      slant::project(qp_->set(), slant::local(x0), slant::local(x_));
    } else {
      vectors::copy(x0, x_);
    }
    slant::apply(qp_->a(), x_, g_, a_workspace_);
    ++applications_;
    scalar const size = detail::root_of_product(x_, g_);
    vectors::subtract(qp_->b(), g_);
    if (!dominates_) {
      return estimated_error<scalar>(is_definite, size, size_of_load_, estimate(),
                                     detail::rounding_of(x_, stiffness_));
    }
    auto const balanced = balance(function_of(*qp_), x_, g_, stiffness_, g_);
    slant::apply(m_, g_, norm_.z, norm_.of_m);
    return {.bound = error_bound_of_root<scalar>(detail::root_of_product(g_, norm_.z),
                                                 balanced.root_of_gap),
            .size = size};
  }
  /// Applications of A so far.
  [[nodiscard]] index applications() const { return applications_ + newton_.applications(); }

 private:
  static constexpr bool is_definite = declares_positive_definite<typename QP::operator_type>;
  /// With functions only for an A that may be singular, whose ‖·‖_{A⁻¹} is infinite off its range:
  /// the other estimate is cheaper.
  static constexpr bool has_faces = (quadratic_program<QP> || !is_definite) &&
                                    has_block_slants<typename QP::set_type, local_t<vector_type>>;

  energy_certificate(QP const& qp, M const& m, bool dominates)
      : base(m, qp.b()),
        qp_(&qp),
        dominates_(dominates),
        a_workspace_(workspace(qp.a(), qp.b())),
        norm_(preconditioner(), qp.b()),
        newton_(qp, preconditioner()) {
    detail::check_size("rows of M", index(m.rows()), qp.size(), "the size of the problem,");
    auto const mean = mean_diagonal(qp.a(), qp.b());
    applications_ +=
        mean.applications + this->learn(qp.a(), mean.value, qp.b(), x_, g_, a_workspace_);
  }

  /// Of a set without faces nothing but the gap and the gradient is known.
  struct no_newton {
    no_newton(QP const&, preconditioner_type const&) {}
    [[nodiscard]] index applications() const { return 0; }
  };
  using newton_type =
      typename std::conditional_t<has_faces,
                                  std::type_identity<newton_estimate<QP, preconditioner_type>>,
                                  std::type_identity<no_newton>>::type;

  /// What A x − b was computed from, for an A that may be singular.
  [[nodiscard]] std::optional<gradient_size<scalar>> sizes() const {
    if constexpr (is_definite) return {};
    return gradient_size<scalar>{slant::norm(x_), slant::norm(qp_->b())};
  }

  [[nodiscard]] scalar norm_of(vector_type const& d) {
    if (!(slant::norm(d) > scalar(0))) return slant::norm(d);
    auto const e =
        dual_norm(qp_->a(), preconditioner(), d, most_, false, a_workspace_, norm_, sizes());
    applications_ += e.applications;
    return e.value;
  }

  /// From x and g.
  [[nodiscard]] scalar estimate() {
    if constexpr (has_faces) {
      scalar const bound = newton_({x_, g_, stiffness_, typical_, most_, sizes()}, preconditioner(),
                                   a_workspace_, [&](vector_type const& d) { return norm_of(d); });
      if (detail::is_finite(bound)) return bound;
    }
    auto const balanced = balance(function_of(*qp_), x_, g_, stiffness_, g_);
    return error_bound_of_root<scalar>(norm_of(g_), balanced.root_of_gap);
  }

  QP const* qp_;
  bool dominates_;
  index applications_ = 0;
  vector_type x_ = qp_->b(), g_ = x_;
  workspace_t<typename QP::operator_type, vector_type> a_workspace_;
  dual_norm_workspace<vector_type, preconditioner_type> norm_;
  newton_type newton_;
};

}  // namespace slant
