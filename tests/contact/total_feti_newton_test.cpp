// SPDX-License-Identifier: MIT
#include "feti_scenes.hpp"
#include "scenes.hpp"

#include <slant/contact/dirichlet_preconditioner.hpp>
#include <slant/contact/preconditioner.hpp>
#include <slant/methods/smalse.hpp>
#include <slant/operators/any_operator.hpp>

#include <doctest/doctest.h>

#include <support/effort.hpp>

namespace total_feti_newton_test {

using Eigen::VectorXd;
using slant::contact::friction_disc;
using slant::contact::total_feti;
using test::decomposed_brick;

using preconditioner =
    slant::any_operator<VectorXd, slant::laws<slant::self_adjoint, slant::positive_semidefinite>>;

TEST_CASE("Newton's method in the face with the lumped and the Dirichlet preconditioner") {
  decomposed_brick const brick({2, 1, 1}, test::effort(3, 2), fem::brick_load::pull);
  auto const expected = test::reference(brick.scene.K, examples::contact_data(brick.scene, true)).u;
  total_feti const problem(friction_disc{}, brick.bodies, brick.data(true));
  auto const qp = problem.qp();
  auto const K = slant::contact::block_stiffness(brick.bodies);
  auto const products_with = [&](auto const& method) {
    VectorXd const u = test::displacement(brick, problem, method);
    CHECK((u - expected).norm() <= 1e-8 * expected.norm());
    auto const r = slant::solve(method, problem.zero(), test::accurate());
    return static_cast<double>(r.state.work.operator_applications);
  };
  auto const preconditioned = [&](preconditioner const& M) {
    slant::smalse_options<double, slant::newton_inner<double, preconditioner>> options;
    options.inner.preconditioner = &M;
    return products_with(slant::smalse{qp, problem.constraints(), options});
  };
  slant::smalse_options<double, slant::newton_inner<double>> const plain;
  double const without = products_with(slant::smalse{qp, problem.constraints(), plain});
  double const lumped =
      preconditioned(preconditioner(slant::contact::lumped_preconditioner(K, problem.rows())));
  double const dirichlet =
      preconditioned(preconditioner(slant::contact::dirichlet_preconditioner(K, problem.rows())));
  CAPTURE(without);
  CAPTURE(lumped);
  CAPTURE(dirichlet);
  CHECK(lumped < 0.8 * without);
  CHECK(dirichlet < lumped);
}

TEST_CASE("the preconditioner for Newton's method has to be given") {
  slant::newton_inner<double, preconditioner> const inner;
  CHECK_THROWS_AS(inner.validate(), slant::bad_input);
}

}  // namespace total_feti_newton_test
