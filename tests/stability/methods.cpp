// SPDX-License-Identifier: MIT
#include <stability/methods.hpp>

#include <slant/contact/certificate.hpp>
#include <slant/contact/optimality.hpp>
#include <slant/contact/preconditioners.hpp>
#include <slant/operators/matrix.hpp>

#include <exception>
#include <stability/reference.hpp>
#include <support/dense_of.hpp>

namespace stability {

namespace {

program_set make_set(program const& p) {
  return slant::cartesian(slant::half_lines(p.lower), slant::intervals(p.low, p.high),
                          slant::discs(p.radius));
}

}  // namespace

void program_operator::apply(Eigen::VectorXd const& x, Eigen::VectorXd& y) const {
  if (dual_) {
    slant::apply(dual_->a(), x, y);
  } else {
    y.noalias() = *a_ * x;
  }
}

prepared::prepared(program const& p) : p_(p), set_(make_set(p)) {
  if (p.contact()) {
    data_ = {.N = p.N, .T = p.T, .f = p.f, .d = p.d, .g = p.radius};
    factor_.emplace(p.K);
    dual_.emplace(slant::contact::friction_disc{}, slant::ldlt<double>(*factor_), data_);
    inverse_ = slant::contact::lumped_preconditioner(p.K, dual_->constraints()).get();
  }
  auto const n = p.size();
  Eigen::MatrixXd const A = test::dense_of(a());
  dense_ = (A + A.transpose()) / 2;
  if (p.contact()) return;
  inverse_.resize(n, n);
  for (Eigen::Index i = 0; i < n; ++i)
    inverse_.insert(i, i) = dense_(i, i) > 0 ? 1 / dense_(i, i) : 1;
  inverse_.makeCompressed();
}

Eigen::VectorXd prepared::start(start_point from) const {
  auto const n = p_.size();
  Eigen::VectorXd x = Eigen::VectorXd::Zero(n);
  if (from == start_point::far) x.setConstant(1e16);
  if (from == start_point::extreme) x.setConstant(1e300);
  if (from == start_point::boundary) {
    x.head(p_.lower.size()) = p_.lower.cwiseMax(-1e300);
    x.segment(p_.lower.size(), p_.low.size()) = p_.low;
    for (Eigen::Index k = 0; k < p_.radius.size(); ++k)
      x[p_.lower.size() + p_.low.size() + 2 * k] = std::min(p_.radius[k], 1e300);
  }
  return x;
}

Eigen::VectorXd prepared::answer(Eigen::VectorXd const& x) const {
  return dual_ ? dual_->displacement(x) : x;
}

slant::energy_error<double> prepared::error_of(Eigen::VectorXd const& x, double goal) const {
  auto const M = slant::matrix<slant::self_adjoint, slant::positive_semidefinite>(inverse_);
  auto const program = qp();
  if (!dual_) return slant::energy_certificate(program, M)(x);
  slant::contact::certificate<double> certificate(p_.K, data_);
  auto const solve = slant::contact::solver(*factor_);
  auto const forces = slant::cartesian(slant::half_lines(p_.lower.size()), slant::discs(p_.radius));
  Eigen::VectorXd λ = slant::project(set_, x);
  Eigen::VectorXd u = answer(λ);
  auto const error = certificate(forces, λ, u, goal, solve);
  if (!(error.relative() > goal)) return error;
  return slant::contact::newton_certificate(program, M, certificate)(λ);
}

double prepared::kkt(Eigen::VectorXd const& x) const {
  if (!dual_) return natural_residual(p_, x);
  return slant::contact::check_optimality(p_.K, data_, answer(x), x).residual();
}

outcome run(method const& m, prepared const& p, request const& r) {
  outcome o;
  try {
    o = m.run(p, r);
  } catch (slant::bad_input const& e) {
    o.refused = true;
    o.reason = e.what();
  } catch (std::exception const& e) {
    o.crashed = true;
    o.reason = e.what();
  }
  return o;
}

}  // namespace stability
