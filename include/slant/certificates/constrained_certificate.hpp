// SPDX-License-Identifier: MIT
//
// An estimate of the error of a point as the solution of
//
//     minimise   q(x) = ½ xᵀA x − bᵀx   over   x ∈ Λ,   G x = e
//
// in the energy norm. With P, Q and x̄ of equality_constraints, o = Q x − x̄ and ν ∈ range Gᵀ near that
// of the solution x*, the gradient on the affine space is r = P (A (x − o) − b) + ν. For every step D
// with Q D = −o and every ν⁺ ∈ range Gᵀ, r + P A P D + ν⁺ − ν is split into s, balanced by Λ at x
// with the gap γ (energy_error.hpp), and a rest, and the error e = ‖P (x − x*)‖_A is bounded by
//
//     e² ≤ (‖P D‖_A + ‖P rest‖_{(P A P)⁺}) e + γ − (ν⁺ − ν*)ᵀo.
//
// D is the Newton step of constrained_newton (newton_estimate.hpp, on the face that ker G cuts), and
// the last term is of the second order. ‖o‖_A comes on top. The length of D says how far away the
// solution is: where Λ meets the affine space at a small angle that is many times the distance ‖o‖
// from G x = e, which residuals do not tell.
//
//     slant::constrained_certificate certificate(qp, constraints);
//     auto const run = slant::solve(slant::constrained_newton{qp, constraints}, x0,
//         slant::energy_error_below(1e-8, std::ref(certificate)) || slant::at_most(500));
#pragma once

#include <slant/certificates/dual_norm.hpp>
#include <slant/certificates/energy_error.hpp>
#include <slant/certificates/newton_estimate.hpp>
#include <slant/concepts/bad_input.hpp>
#include <slant/concepts/linear_operator.hpp>
#include <slant/operators/diagonal.hpp>
#include <slant/operators/identity.hpp>
#include <slant/problems/augmented_problem.hpp>
#include <slant/problems/cut_face.hpp>
#include <slant/problems/separable_qp.hpp>

#include <concepts>
#include <optional>
#include <type_traits>
#include <utility>

namespace slant {

/// certificate(x, ν) → energy_error of P_Λ(x), an estimate. Refers to the problem and the
/// constraints; M ≈ A⁻¹, of which it keeps a copy, preconditions, without M diag(A)⁻¹ as in
/// energy_certificate. Some 15 applications of A. Infinite, that is unknown, where A has no
/// curvature along what is left of the gradient, and where no step on the face of x meets the
/// equations: that is not the face of x*.
template <class QP, affine_space_with_rows<typename QP::vector_type> C, class M = identity_operator>
class constrained_certificate : detail::certificate_preconditioner<typename QP::vector_type, M> {
  using base = detail::certificate_preconditioner<typename QP::vector_type, M>;
  using base::stiffness_, base::typical_, base::most_, base::preconditioner;
  using typename base::preconditioner_type;

 public:
  using vector_type = typename QP::vector_type;
  using scalar = typename QP::scalar;

  constrained_certificate(QP const& qp, C const& constraints)
    requires std::same_as<M, identity_operator>
      : constrained_certificate(qp, constraints, identity_operator(qp.size())) {}
  /// Throws bad_input if sizes do not match.
  constrained_certificate(QP const& qp, C const& constraints, M const& m)
      : base(m, qp.b()),
        qp_(&qp),
        constraints_(&constraints),
        load_(detail::projected_load(qp, constraints).projected),
        hessian_(projected_hessian(qp.a(), constraints)),
        x_(qp.b()),
        a_workspace_(workspace(qp.a(), qp.b())),
        workspace_(workspace(hessian_, qp.b())),
        of_Q_(workspace(constraints.range_projector(), qp.b())),
        of_P_(workspace(constraints.kernel_projector(), qp.b())),
        projected_{hessian_, load_, qp.set()},
        norm_(preconditioner(), qp.b()),
        newton_(projected_, preconditioner(), cut_face<scalar>(qp.set(), constraints.unit_rows())) {
    detail::check_size("columns of G", index(constraints.size()), qp.size(), "the size of b,");
    detail::check_size("rows of M", index(m.rows()), qp.size(), "the size of the problem,");
    slant::apply(qp.a(), constraints.nearest(), image_of_nearest_, a_workspace_);
    auto const mean = detail::projected_mean_diagonal(qp.a(), constraints, qp.b());
    applications_ += 2 + mean.applications +
                     this->learn(qp.a(), mean.value, qp.b(), x_, gradient_, a_workspace_);
  }
  constrained_certificate(QP const&&, C const&) = delete;
  constrained_certificate(QP const&&, C const&, M const&) = delete;
  constrained_certificate(QP const&, C const&&) = delete;
  constrained_certificate(QP const&, C const&&, M const&) = delete;
  constrained_certificate(constrained_certificate const&) = delete;
  constrained_certificate& operator=(constrained_certificate const&) = delete;

  /// ν ∈ range Gᵀ as the states of constrained_newton and smalse have it: the gradient is
  /// P (A x − b) + ν. No allocation, unless equations depend on others on the face.
  [[nodiscard]] energy_error<scalar> operator()(vector_type const& x, vector_type const& ν) {
    detail::check_size("ν", index(slant::local(ν).size()), qp_->size(), "the size of b,");
    slant::project(qp_->set(), x, x_);
    slant::apply(constraints_->range_projector(), x_, offset_, of_Q_);
    offset_ -= constraints_->nearest();
    point_ = x_ - offset_;  // P x + x̄
    gradient_ = point_ - constraints_->nearest();
    slant::apply(qp_->a(), gradient_, image_, a_workspace_);
    ++applications_;
    gradient_ = image_ + image_of_nearest_;
    scalar const size = detail::root_of_product(point_, gradient_);
    slant::apply(constraints_->kernel_projector(), image_, gradient_, of_P_);
    gradient_ += ν - load_;
    scalar const along = detail::is_one_point(*constraints_) ? scalar(0) : estimate();
    return estimated_error<scalar>(declares_positive_definite<typename QP::operator_type>, size,
                                   this->size_of_load_, along + of_offset(),
                                   detail::rounding_of(x_, stiffness_));
  }
  /// Applications of A so far.
  [[nodiscard]] index applications() const { return applications_ + newton_.applications(); }

 private:
  using hessian_type = decltype(slant::projected_hessian(
      std::declval<typename QP::operator_type const&>(), std::declval<C const&>()));
  using projected_qp =
      separable_qp<hessian_type const&, vector_type const&, typename QP::set_type const&>;

  [[nodiscard]] gradient_size<scalar> sizes() const { return {norm(x_), norm(qp_->b())}; }

  /// ‖P d‖_{(P A P)⁺}.
  [[nodiscard]] scalar norm_of(vector_type const& d) {
    slant::apply(constraints_->kernel_projector(), d, image_, of_P_);
    if (!(norm(image_) > scalar(0))) return norm(image_);
    auto const e = dual_norm(hessian_, preconditioner(), image_, most_, false, workspace_, norm_,
                             std::optional(sizes()));
    applications_ += e.applications;
    return e.value;
  }

  /// Of P (x − x*), from x, its offset and its gradient.
  [[nodiscard]] scalar estimate() {
    scalar const size = norm(x_) + norm(constraints_->nearest());
    scalar const bound =
        newton_({.x = x_,
                 .gradient = gradient_,
                 .stiffness = stiffness_,
                 .ρ = typical_,
                 .most = most_,
                 .sizes = sizes(),
                 .offset = &offset_,
                 .size_of_offset = size},
                preconditioner(), workspace_, [&](vector_type const& d) { return norm_of(d); });
    if (detail::is_finite(bound)) return bound;
    // D = 0, where that meets the equations.
    if (!newton_.face().meets(offset_, size)) return bound;
    auto const balanced = balance(qp_->set(), x_, gradient_, stiffness_, gradient_);
    return error_bound_of_root<scalar>(norm_of(gradient_), balanced.root_of_gap);
  }
  [[nodiscard]] scalar of_offset() {
    if (norm(offset_) == scalar(0)) return scalar(0);
    slant::apply(qp_->a(), offset_, image_, a_workspace_);
    ++applications_;
    return detail::root_of_product(offset_, image_);
  }

  QP const* qp_;
  C const* constraints_;
  index applications_ = 0;
  vector_type load_;  // P (b − A x̄)
  hessian_type hessian_;
  vector_type x_, offset_ = x_, point_ = x_, gradient_ = x_, image_ = x_, image_of_nearest_ = x_;
  workspace_t<typename QP::operator_type, vector_type> a_workspace_;
  workspace_t<hessian_type, vector_type> workspace_;
  workspace_t<decltype(std::declval<C const&>().range_projector()), vector_type> of_Q_;
  workspace_t<decltype(std::declval<C const&>().kernel_projector()), vector_type> of_P_;
  projected_qp projected_;
  dual_norm_workspace<vector_type, preconditioner_type> norm_;
  newton_estimate<projected_qp, preconditioner_type, cut_face<scalar>> newton_;
};

}  // namespace slant
