// SPDX-License-Identifier: MIT
//
// What a Newton step of the dual problem says of the error where contact/certificate.hpp does not
// show the goal: certificates/newton_estimate.hpp, with the displacements' bound for the norm of
// what the step leaves over. The certificate charges a point inside of Λ its gap, of which the
// error is the square; the step goes to the face first, where there is none. So iterates of
// interior-point methods are judged like those on a face. An estimate: nothing is proven by it.
#pragma once

#include <slant/certificates/newton_estimate.hpp>
#include <slant/concepts/linear_operator.hpp>
#include <slant/concepts/vector.hpp>
#include <slant/contact/certificate.hpp>

#include <utility>

namespace slant::contact {

/// Sharpens a certificate of the scene whose dual problem is qp, A ≈ M⁻¹; refers to all three.
/// Costs some 12 products by A a call.
template <class QP, class M>
class newton_certificate {
 public:
  using vector_type = typename QP::vector_type;
  using scalar = typename QP::scalar;

  /// `units`: d where the unknowns x of qp are λ = d ∘ x; empty: λ itself.
  newton_certificate(QP const& qp, M const& m, certificate<scalar>& c, vector_type units = {})
      : qp_(&qp),
        m_(&m),
        certificate_(&c),
        d_(units.size() > 0 ? std::move(units) : vector_type::Ones(qp.size()).eval()),
        newton_(qp, m),
        of_a_(workspace(qp.a(), d_)) {
    // About 1/diag A; an empty row is held by nothing and asked for nothing.
    inverse_diagonal_ = c.stiffness().cwiseQuotient(d_).cwiseQuotient(d_);
    scalar sum(0);
    for (scalar& entry : inverse_diagonal_) {
      if (!slant::detail::is_finite(entry)) entry = scalar(1);
      sum += scalar(1) / entry;
    }
    // A short step to the face: from a long one Newton's step would have to come back.
    if (sum > scalar(0)) ρ_ = scalar(qp.size()) / sum / scalar(1024);
  }
  newton_certificate(QP const&&, M const&, certificate<scalar>&, vector_type = {}) = delete;

  /// The last certificate, which was that of λ ∈ Λ, or what the step says if that is less.
  [[nodiscard]] energy_error<scalar> const& operator()(vector_type const& λ) {
    if (!certificate_->gradient().allFinite()) return certificate_->estimated(scalar(-1));
    x_ = λ.cwiseQuotient(d_);
    gradient_ = certificate_->gradient().cwiseProduct(d_);
    auto const norm = [&](vector_type const& d) {
      return certificate_->extended_norm(d.cwiseQuotient(d_));
    };
    return certificate_->estimated(
        newton_({x_, gradient_, inverse_diagonal_, ρ_, 12,
                 gradient_size<scalar>{slant::norm(x_), slant::norm(qp_->b())}, false},
                *m_, of_a_, norm));
  }
  /// Products by A so far.
  [[nodiscard]] index applications() const { return newton_.applications(); }

 private:
  QP const* qp_;
  M const* m_;
  certificate<scalar>* certificate_;
  vector_type d_, inverse_diagonal_, x_, gradient_;
  newton_estimate<QP, M> newton_;
  workspace_t<typename QP::operator_type, vector_type> of_a_;
  scalar ρ_{1};
};

}  // namespace slant::contact
