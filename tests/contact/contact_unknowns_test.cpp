// SPDX-License-Identifier: MIT
#include <slant/contact/contact_data.hpp>

#include <slant/contact/dual.hpp>
#include <slant/contact/preconditioners.hpp>
#include <slant/factorizations/factorize.hpp>
#include <slant/factorizations/static_condensation.hpp>
#include <slant/iteration/solve.hpp>
#include <slant/methods/symmetric_newton.hpp>
#include <slant/methods/unconstrained_start.hpp>
#include <slant/operators/counted.hpp>

#include <doctest/doctest.h>

#include <vector>

#include "scenes.hpp"

namespace contact_unknowns_test {

using Eigen::VectorXd;
namespace contact = slant::contact;
using slant::index;

TEST_CASE("the unknowns of N and T, each once, in order") {
  contact::data<double> c;
  c.N.resize(2, 6);
  c.N.insert(0, 4) = 1;
  c.N.insert(1, 1) = -1;
  c.N.insert(1, 5) = 0;  // an entry that is there and acts on nothing
  c.T.resize(2, 6);
  c.T.insert(0, 4) = 1;
  c.T.insert(1, 2) = 3;
  c.f.setZero(6);
  c.d.setZero(2);
  c.g.setOnes(2);
  CHECK(contact::contact_unknowns(c) == std::vector<index>{1, 2, 4});
  c.g[0] = -1;
  CHECK_THROWS_AS((void)contact::contact_unknowns(c), slant::bad_input);
}

TEST_CASE("the dual problem by condensation: same solution, also from the unconstrained minimum") {
  auto const scene = fem::make_steel_brick({.k = 2, .load = fem::brick_load::lift});
  auto const c = test::contact_data(scene);
  contact::dual const plain(contact::friction_disc{}, slant::factorize(scene.K), c);
  slant::static_condensation const factor(scene.K, contact::contact_unknowns(c));
  contact::dual const condensed(contact::friction_disc{}, factor, c);
  auto const M = contact::lumped_preconditioner(scene.K, plain.constraints());
  CHECK((plain.b() - condensed.b()).norm() <= 1e-13 * plain.b().norm());

  auto const qp = plain.qp();
  auto const rule = slant::reduced_gradient_below(1e-12) || slant::at_most(100);
  auto const r = slant::solve(slant::symmetric_newton{qp, M}, plain.zero(), rule);
  REQUIRE(r.converged());
  auto const a = slant::counted(condensed.a());
  slant::separable_qp const cqp{a, condensed.b(), condensed.set()};
  auto const start = slant::unconstrained_start(cqp, M);
  CHECK(start.applications == a.applications());
  auto const rc = slant::solve(slant::symmetric_newton{cqp, M}, start.x, rule);
  REQUIRE(rc.converged());
  CHECK((r.x() - rc.x()).norm() <= 1e-10 * r.x().norm());
  // Rounded products are counted as others are.
  CHECK(start.applications + rc.state.work.operator_applications +
            rc.state.work.setup_applications ==
        a.applications());
  CHECK((plain.displacement(r.x()) - condensed.displacement(rc.x())).norm() <=
        1e-10 * plain.displacement(r.x()).norm());
}

}  // namespace contact_unknowns_test
