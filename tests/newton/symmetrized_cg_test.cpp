// SPDX-License-Identifier: MIT
#include <slant/newton/symmetrized_cg.hpp>
#include <slant/operators/diagonal.hpp>
#include <slant/testing/archetypes.hpp>

#include <support/testing.hpp>
#include "newton_scene.hpp"

namespace symmetrized_cg_test {

/// The Newton system of a natural residual at a point where bounds and discs are in all states.
struct system {
  explicit system(double smallest_radius)
      : set(newton_scene::contact_set(5, smallest_radius)),
        A(slant::counted(d.definite())),
        F(slant::natural_residual(A, d.b, set, d.ρ)),
        x(slanting_support::random_vector(15, 7)),
        f(slant::evaluate(F, x)),
        G(F.slant(x)),
        dense(slanting_support::dense(G, x)) {
    A.reset_counts();
  }
  using counted_type = decltype(slant::counted(std::declval<newton_scene::data>().definite()));
  using set_type = decltype(newton_scene::contact_set(1, 1.0));
  using function_type = decltype(slant::natural_residual(
      std::declval<counted_type const&>(), VectorXd(), std::declval<set_type const&>(), 1.0));

  newton_scene::data d{5};
  set_type set;
  counted_type A;
  function_type F;
  VectorXd x, f;
  slant::slant_operator_t<function_type, VectorXd> G;
  MatrixXd dense;
};

slant::direction_request<double> request(system const& s, double η) {
  return {η, s.f.norm()};
}

TEST_CASE(
    "the direction of a dense solve, the residual that is reported, one product an iteration") {
  system const s(1e-3);
  VectorXd const exact = slanting_support::solve(s.dense, VectorXd(-s.f));
  slant::symmetrized_cg const cg;
  auto p = cg.prepare(s.G, s.f);
  CHECK(s.A.applications() == 0);
  VectorXd dy(15);
  for (double η : {0.5, 1e-2, 1e-12}) {
    s.A.reset_counts();
    auto const r = cg.solve(s.G, s.f, request(s, η), dy, p);
    CAPTURE(η);
    CHECK(r.status == slant::status::converged);
    CHECK(r.residual_norm <= η * s.f.norm());
    double const residual = (s.f + s.dense * dy).norm();
    CHECK(std::abs(residual - r.residual_norm) <= 1e-13 * s.f.norm());
    CHECK(r.operator_applications == r.iterations + 1);
    CHECK(s.A.applications() == r.operator_applications);
    CHECK(r.factorizations == 0);
  }
  CHECK((dy - exact).norm() <= 1e-11 * exact.norm());
}

TEST_CASE("discs that slide far outside cost nothing: G as small as 1e-12") {
  system const s(1e-12);
  REQUIRE(slant::slant_of_projection(s.G).part<1>().block(0).norm() < 1e-11);
  slant::symmetrized_cg const cg;
  auto p = cg.prepare(s.G, s.f);
  VectorXd dy(15);
  auto const r = cg.solve(s.G, s.f, request(s, 1e-10), dy, p);
  CHECK(r.status == slant::status::converged);
  CHECK(r.iterations <= 15);
  CHECK((s.f + s.dense * dy).norm() <= 2e-10 * s.f.norm());
}

TEST_CASE("limits and numbers out of range are statuses, never NaN") {
  system const s(1e-3);
  slant::symmetrized_cg const cg{.max_iterations = 2};
  auto p = cg.prepare(s.G, s.f);
  VectorXd dy(15);
  auto const r = cg.solve(s.G, s.f, request(s, 1e-12), dy, p);
  CHECK(r.status == slant::status::iteration_limit);
  CHECK(r.iterations == 2);
  CHECK(std::abs((s.f + s.dense * dy).norm() - r.residual_norm) <= 1e-13 * s.f.norm());

  VectorXd const huge = VectorXd::Constant(15, 4e307);  // A F overflows
  auto const overflow = cg.solve(s.G, huge, {0.1, huge.norm()}, dy, p);
  CHECK(overflow.status == slant::status::breakdown);
  CHECK(dy == VectorXd::Zero(15));
  CHECK_THROWS_AS(slant::symmetrized_cg{.max_iterations = -1}.validate(), slant::bad_input);
}

/// x ≥ 0 by a client who knows nothing of blocks: G is some diagonal operator.
struct positive_points {
  slant::index n;
  [[nodiscard]] slant::index size() const { return n; }
  void project(auto const& x, auto& y) const { y = x.cwiseMax(0); }
  [[nodiscard]] bool contains(auto const& x) const { return (x.array() >= 0).all(); }
  [[nodiscard]] static auto slant(VectorXd const& x) {
    return slant::diagonal<slant::self_adjoint, slant::firmly_nonexpansive>(
        VectorXd((x.array() >= 0).cast<double>()));
  }
};

TEST_CASE("a set whose blocks are not accessible") {
  newton_scene::data const d(5);
  auto const A = d.definite();
  auto const F = slant::natural_residual(A, d.b, positive_points{15}, d.ρ);
  VectorXd const x = slanting_support::random_vector(15, 7);
  VectorXd const f = slant::evaluate(F, x);
  auto const G = F.slant(x);
  slant::symmetrized_cg const cg;
  auto p = cg.prepare(G, f);
  static_assert(!decltype(p.preconditioner)::effective);
  VectorXd dy(15);
  CHECK(cg.solve(G, f, {1e-10, f.norm()}, dy, p).status == slant::status::converged);
  CHECK((f + slanting_support::dense(G, x) * dy).norm() <= 1.1e-10 * f.norm());
}

TEST_CASE("archetype operator and vector; who is refused") {
  namespace archetype = slant::testing::archetype;
  newton_scene::data const d(5);
  archetype::spd_operator const A(d.A);
  archetype::vector const b(d.b), x(slanting_support::random_vector(15, 7));
  auto const set = newton_scene::contact_set(5, 1e-3);
  auto const F = slant::natural_residual(A, b, set, d.ρ);
  auto const f = slant::evaluate(F, x);
  auto const G = F.slant(x);
  slant::symmetrized_cg const cg;
  auto p = cg.prepare(G, f);
  archetype::vector dy = f;
  auto const r = cg.solve(G, f, {1e-8, slant::norm(f)}, dy, p);
  CHECK(r.status == slant::status::converged);
  MatrixXd const dense = slanting_support::dense(G, x);
  CHECK((f.local() + dense * dy.local()).norm() <= 1.1e-8 * f.local().norm());

  static_assert(slant::direction_solver<slant::symmetrized_cg, decltype(G), archetype::vector>);
  auto const undeclared = slant::natural_residual(d.A, d.b, set, d.ρ);
  using other = slant::slant_operator_t<decltype(undeclared), VectorXd>;
  static_assert(!slant::direction_solver<slant::symmetrized_cg, other, VectorXd>);
}

}  // namespace symmetrized_cg_test
