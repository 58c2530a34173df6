// SPDX-License-Identifier: MIT
#include "methods.hpp"

#include <slant/methods/interior_point.hpp>
#include <slant/methods/solve_program.hpp>
#include <slant/methods/symmetric_newton.hpp>
#include <slant/problems/equilibrated.hpp>

namespace random_programs {

namespace {

auto options(request const& r) {
  slant::symmetric_newton_options<double> o;
  o.forcing.goal = r.tolerance;
  return o;
}

template <class QP>
outcome solved(QP const& qp, request const& r) {
  auto const found = slant::solve(qp, r.tolerance, r.steps);
  return {.status = found.status,
          .iterations = found.iterations(),
          .applications = found.work.operator_applications,
          .x = found.x(),
          .claimed = found.error.relative()};
}

/// The default, which is told what a user knows: whether A is definite.
outcome with_solve(prepared const& p, request const& r) {
  if (!p.p.definite) return solved(p.qp, r);
  auto const A = slant::matrix<slant::self_adjoint, slant::positive_definite>(p.p.A);
  return solved(slant::separable_qp{A, p.p.b, p.qp.set()}, r);
}

outcome with_newton(prepared const& p, request const& r) {
  return run_from_zero(slant::symmetric_newton{p.qp, options(r)}, p, r);
}

outcome with_equilibrated(prepared const& p, request const& r) {
  slant::equilibrated const scaled(p.qp);
  return run_until(slant::symmetric_newton{scaled.qp(), options(r)},
                   Eigen::VectorXd(Eigen::VectorXd::Zero(p.p.size())), p, r,
                   [&](Eigen::VectorXd const& y) { return Eigen::VectorXd(scaled.back(y)); });
}

outcome with_interior_point(prepared const& p, request const& r) {
  return run_from_zero(slant::interior_point{p.qp}, p, r);
}

}  // namespace

std::span<method const> newton_methods() {
  static constexpr method list[]{{"solve", with_solve},
                                 {"symmetric_newton", with_newton},
                                 {"symmetric_newton_equilibrated", with_equilibrated},
                                 {"interior_point", with_interior_point}};
  return list;
}

}  // namespace random_programs
