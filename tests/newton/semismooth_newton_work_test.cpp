// SPDX-License-Identifier: MIT
//
// What a Newton step costs: products by A, counted from outside, and no allocation.
#include <slant/iteration/solve.hpp>
#include <slant/newton/semismooth_newton.hpp>

#include <newton/newton_scene.hpp>
#include <support/allocation_guard.hpp>

#include <doctest/doctest.h>

#include <vector>

namespace semismooth_newton_work_test {

using Eigen::VectorXd;

/// A problem whose first step from zero has to be shortened, whatever the solver.
struct scene {
  scene()
      : A(slant::counted(d.definite())),
        F(slant::natural_residual(A, d.b, newton_scene::contact_set(m, 1.5), d.ρ)) {}
  static constexpr int m = 8;
  using counted_type = decltype(slant::counted(std::declval<newton_scene::data>().definite()));
  using function_type = decltype(slant::natural_residual(
      std::declval<counted_type const&>(), VectorXd(), newton_scene::contact_set(1, 1.0), 1.0));

  newton_scene::data d{m};
  counted_type A;
  function_type F;
};

/// Steps until the residual is small; each is shown to check(state before, state, products).
template <class Method, class Check>
void run(scene const& p, Method const& method, VectorXd const& x0, Check check) {
  p.A.reset_counts();
  auto s = method.start(x0);
  CHECK(p.A.applications() == 1 + s.work.setup_applications);
  while (s.status == slant::status::running && s.residual_norm > 1e-12 * s.residual_scale &&
         s.iteration < 40) {
    auto const before = s;
    auto const products = p.A.applications();
    method.step(s);
    check(before, s, p.A.applications() - products);
    CHECK(p.A.applications() == s.work.operator_applications + s.work.setup_applications);
  }
  CHECK(s.residual_norm <= 1e-12 * s.residual_scale);
}

TEST_CASE(
    "symmetrized_cg: one for F, one for the right-hand side, one an iteration, one a halving") {
  scene const p;
  slant::index halvings = 0, inner = 0;
  run(p, slant::semismooth_newton{p.F}, p.d.zero(),
      [&](auto const& before, auto const& s, slant::index products) {
        CHECK(products == 1 + s.inner_iterations + s.trials);
        CHECK(s.work.inner_iterations == before.work.inner_iterations + s.inner_iterations);
        CHECK(s.length == std::ldexp(1.0, int(1 - s.trials)));
        halvings += s.trials - 1;
        inner += s.inner_iterations;
      });
  CHECK(halvings > 0);
  CHECK(inner > 10);
}

TEST_CASE("a warm start costs one more, and only after a shortened step") {
  scene const p;
  slant::index warm = 0;
  run(p, slant::semismooth_newton{p.F, slant::symmetrized_cg{.warm_start = true}}, p.d.zero(),
      [&](auto const& before, auto const& s, slant::index products) {
        bool const shortened = before.iteration > 0 && before.length < 1;
        CHECK(products == 1 + shortened + s.inner_iterations + s.trials);
        warm += shortened;
      });
  CHECK(warm > 0);
}

TEST_CASE("bicgstab_solver: two an iteration, less one if it ends half way") {
  scene const p;
  run(p, slant::semismooth_newton{p.F, slant::bicgstab_solver{}}, p.d.zero(),
      [&](auto const&, auto const& s, slant::index products) {
        CHECK(products <= 2 * s.inner_iterations + s.trials);
        CHECK(products >= 2 * s.inner_iterations - 1 + s.trials);
      });
}

TEST_CASE("direct_solver: the columns of A once a step, and one product for F") {
  scene const p;
  run(p, slant::semismooth_newton{p.F, slant::direct_solver{}}, p.d.zero(),
      [&](auto const&, auto const& s, slant::index products) {
        CHECK(products == s.trials);
        CHECK(s.work.factorizations == s.iteration);
        CHECK(p.A.counts().columns == 24 * s.iteration);
      });
}

TEST_CASE("inexact steps cost less than accurate ones") {
  scene const p;
  auto const stop = slant::residual_below(1e-10) || slant::at_most(60);
  auto const products = [&](auto const& rule) {
    auto const r = slant::solve(
        slant::semismooth_newton{p.F, slant::by_laws{}, slant::halving_line_search{}, rule},
        p.d.zero(), stop);
    CHECK(r.converged());
    return r.state.work.operator_applications;
  };
  auto const accurate = products(slant::fixed_forcing{.tolerance = 1e-12});
  CHECK(products(slant::eisenstat_walker{}) < 0.7 * double(accurate));
  CHECK(products(slant::adaptive_precision{}) < accurate);
}

TEST_CASE("no step allocates, shortened ones included") {
  scene const p;
  auto const check = [&](auto const& method) {
    auto s = method.start(p.d.zero());
    slant::index halvings = 0;
    slant::testing::allocation_guard const guard;
    while (s.status == slant::status::running && s.residual_norm > 1e-10 * s.residual_scale) {
      method.step(s);
      halvings += s.trials - 1;
    }
    auto const allocations = guard.count();
    CHECK(allocations == 0);
    CHECK(s.iteration > 3);
    CHECK(halvings > 0);
  };
  check(slant::semismooth_newton{p.F});
  check(slant::semismooth_newton{p.F, slant::symmetrized_cg{.warm_start = true}});
  check(slant::semismooth_newton{p.F, slant::bicgstab_solver{}, slant::halving_line_search{},
                                 slant::eisenstat_walker{.η_first = 0.1}});
}

}  // namespace semismooth_newton_work_test
