// SPDX-License-Identifier: MIT
//
// Bodies in frictionless contact by the Schur complement algorithm, and by two other methods on the
// dual problem.
#pragma once

#include <slant/contact/bodies.hpp>
#include <slant/contact/dual.hpp>
#include <slant/factorizations/ldlt.hpp>
#include <slant/iteration/solve.hpp>
#include <slant/methods/kprgp.hpp>
#include <slant/methods/schur_contact.hpp>
#include <slant/methods/symmetric_newton.hpp>

#include <doctest/doctest.h>

#include <fem/contact_scene.hpp>

namespace bodies_scenes {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using sparse = Eigen::SparseMatrix<double>;
using slant::status;
namespace contact = slant::contact;

struct answer {
  VectorXd u;
  VectorXd λ;
};

inline auto run(contact::bodies<double> const& bodies, double tolerance = 1e-12) {
  auto const qp = bodies.qp();
  return slant::solve(slant::schur_contact{qp}, bodies.zero(),
                      slant::residual_below(tolerance) || slant::at_most(5000));
}

/// The dual problem with a definite K, by two other methods, which must agree.
inline answer by_dual(sparse const& K, VectorXd const& f, sparse const& B, VectorXd const& c) {
  contact::data<double> data;
  data.N = B;
  data.T.resize(0, K.rows());
  data.f = f;
  data.d = c;
  contact::dual const dual(contact::frictionless{}, slant::ldlt(K), data);
  auto const qp = dual.qp();
  auto const newton = slant::solve(slant::symmetric_newton{qp}, dual.zero(),
                                   slant::reduced_gradient_below(1e-13) || slant::at_most(200));
  auto const active = slant::solve(slant::kprgp{qp}, newton.x(),
                                   slant::reduced_gradient_below(1e-12) || slant::at_most(20000));
  REQUIRE(newton.state.reduced_gradient_norm <= 1e-11 * newton.state.gradient_scale);
  CHECK(active.converged());
  return {dual.displacement(newton.x()), newton.x()};
}

inline void compare(contact::bodies<double> const& bodies, answer const& expected) {
  auto const r = run(bodies);
  CAPTURE(r.reason);
  REQUIRE(r.converged());
  VectorXd const u = bodies.displacement(r.x());
  CHECK((u - expected.u).norm() <= 1e-9 * expected.u.norm());
  CHECK((r.state.multipliers() - expected.λ).norm() <= 1e-9 * expected.λ.norm());
  // One factor per body (none, if all of it is constrained), however often the active set has
  // changed.
  CHECK(bodies.factorizations() <= bodies.count() + 2 * bodies.fixed());
}

template <int D>
void compare(fem::contact_scene<D> const& scene) {
  contact::bodies<double> const bodies(scene.K, scene.f, scene.N, scene.d);
  compare(bodies, by_dual(scene.K, scene.f, scene.N, scene.d));
}

}  // namespace bodies_scenes
