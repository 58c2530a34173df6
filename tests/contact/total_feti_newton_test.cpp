// SPDX-License-Identifier: MIT
#include "feti_scenes.hpp"
#include "scenes.hpp"

#include <slant/contact/preconditioners.hpp>
#include <slant/methods/constrained_newton.hpp>
#include <slant/operators/any_operator.hpp>

#include <doctest/doctest.h>

#include <support/effort.hpp>

namespace total_feti_newton_test {

using Eigen::VectorXd;
using slant::contact::frictionless;
using slant::contact::total_feti;
using test::decomposed_brick;

using preconditioner =
    slant::any_operator<VectorXd, slant::laws<slant::self_adjoint, slant::positive_semidefinite>>;

TEST_CASE(
    "without preconditioner, lumped and Dirichlet in the face, contact that holds and opens") {
  for (auto const load : {fem::brick_load::pull, fem::brick_load::lift}) {
    decomposed_brick const brick({2, 1, 1}, test::effort(3, 2), load);
    auto const expected =
        test::reference(brick.scene.K, examples::contact_data(brick.scene, false)).u;
    total_feti const problem(frictionless{}, brick.bodies, brick.data(false));
    auto const qp = problem.qp();
    auto const K = slant::contact::block_stiffness(brick.bodies);
    auto const steps_with = [&](preconditioner const& M) {
      slant::constrained_newton const method{qp, problem.constraints(), M};
      VectorXd const u = test::displacement(brick, problem, method);
      CHECK((u - expected).norm() <= 1e-8 * expected.norm());
      auto const r = slant::solve(method, problem.zero(), test::accurate());
      CHECK(r.iterations() <= 15);
      CHECK(r.state.fallback_count == 0);
      return static_cast<double>(r.state.work.inner_iterations);
    };
    double const without = steps_with(preconditioner(slant::identity(qp.size())));
    double const lumped =
        steps_with(preconditioner(slant::contact::lumped_preconditioner(K, problem.rows())));
    double const dirichlet =
        steps_with(preconditioner(slant::contact::dirichlet_preconditioner(K, problem.rows())));
    CAPTURE(without);
    CAPTURE(lumped);
    CAPTURE(dirichlet);
    CHECK(lumped < 0.6 * without);
    CHECK(dirichlet <
          0.6 * without);  // with two cells along an edge not better than the lumped one
  }
}

}  // namespace total_feti_newton_test
