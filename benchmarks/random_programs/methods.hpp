// SPDX-License-Identifier: MIT
//
// The methods that take half lines × intervals × discs × ellipses × cones × Rᵏ, in a form that all
// share: a random program and a request go in, an outcome comes out. All are stopped by the same
// rule, the energy error that a certificate estimates; they start at 0, without a preconditioner,
// and are told that A is positive semidefinite, no more.
#pragma once

#include <slant/certificates/energy_certificate.hpp>
#include <slant/certificates/energy_error.hpp>
#include <slant/iteration/solve.hpp>
#include <slant/iteration/stopping.hpp>
#include <slant/operators/matrix.hpp>
#include <slant/problems/separable_qp.hpp>

#include <limits>
#include <oracle/random_programs.hpp>
#include <span>
#include <string_view>
#include <support/program_sets.hpp>

namespace random_programs {

struct request {
  double tolerance = 1e-8;
  slant::index steps = 3000;  ///< limits of a run
  slant::index applications = 20000;
};

struct outcome {
  slant::status status = slant::status::running;
  slant::index iterations = 0;
  slant::index applications = 0;
  Eigen::VectorXd x{};                                        ///< in Λ
  double claimed = std::numeric_limits<double>::quiet_NaN();  ///< relative energy error
};

using problem =
    decltype(slant::separable_qp{slant::matrix<slant::self_adjoint, slant::positive_semidefinite>(
                                     std::declval<Eigen::MatrixXd const&>()),
                                 std::declval<Eigen::VectorXd const&>(),
                                 test::set_of(std::declval<oracle::random_program const&>())});

/// A random program as the library sees it. Refers to p.
struct prepared {
  oracle::random_program const& p;
  problem qp;
  explicit prepared(oracle::random_program const& program)
      : p(program),
        qp(slant::matrix<slant::self_adjoint, slant::positive_semidefinite>(program.A), program.b,
           test::set_of(program)) {}
};

struct method {
  std::string_view name;
  outcome (*run)(prepared const&, request const&);
};

[[nodiscard]] std::span<method const> active_set_methods();  ///< active_set_methods.cpp
[[nodiscard]] std::span<method const> modified_methods();    ///< modified_methods.cpp
[[nodiscard]] std::span<method const> newton_methods();      ///< newton_methods.cpp
[[nodiscard]] std::span<method const> natural_methods();     ///< natural_methods.cpp
[[nodiscard]] std::span<method const> multiplier_methods();  ///< multiplier_methods.cpp

/// The run of a method from y0; back(y) is the point that an iterate stands for.
template <class Method, class Back>
[[nodiscard]] outcome run_until(Method const& m, Eigen::VectorXd const& y0, prepared const& p,
                                request const& r, Back const& back) {
  slant::energy_certificate certificate(p.qp);
  auto const error_of = [&](Eigen::VectorXd const& y) { return certificate(back(y)); };
  auto const report =
      slant::solve(m, y0,
                   slant::energy_error_below(r.tolerance, error_of) || slant::at_most(r.steps) ||
                       slant::at_most_applications(r.applications));
  outcome o;
  o.status = report.status;
  o.iterations = report.iterations();
  o.applications = report.state.work.operator_applications;
  o.x = slant::project(p.qp.set(), back(report.state.x));
  if (o.x.allFinite()) o.claimed = certificate(o.x).relative();
  return o;
}

template <class Method>
[[nodiscard]] outcome run_from_zero(Method const& m, prepared const& p, request const& r) {
  return run_until(m, Eigen::VectorXd(Eigen::VectorXd::Zero(p.p.size())), p, r,
                   [](Eigen::VectorXd const& x) -> Eigen::VectorXd const& { return x; });
}

}  // namespace random_programs
