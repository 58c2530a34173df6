// SPDX-License-Identifier: MIT
#include <slant/contact/dual.hpp>

#include <slant/contact/optimality.hpp>
#include <slant/factorizations/ldlt.hpp>
#include <slant/iteration/solve.hpp>
#include <slant/methods/kprgp.hpp>

#include <support/testing.hpp>
#include "counting_factor.hpp"
#include "scenes.hpp"

namespace dual_test {

/// The multipliers of a dual problem, by a method that needs no settings.
template <class Dual>
VectorXd solved(Dual const& dual, double tolerance) {
  auto const r = slant::solve(slant::kprgp{dual.qp()}, dual.zero(),
                              slant::reduced_gradient_below(tolerance) || slant::at_most(100000));
  REQUIRE(r.converged());
  return r.x();
}

template <class Friction>
void check_against_reference(Friction friction, Eigen::SparseMatrix<double> const& K,
                             contact::data<double> const& c) {
  auto const reference = test::reference(K, c);
  contact::dual const dual(friction, slant::ldlt(K), c);
  VectorXd const λ = solved(dual, 1e-12), u = dual.displacement(λ);
  CHECK(oracle::energy_error(K, u, reference.u) <= 1e-7);
  CHECK((λ.head(c.nodes()) - reference.normal).norm() <= 1e-5 * λ.norm());
  CHECK(contact::check_optimality(K, c, u, λ).residual() <= 1e-9);
}

TEST_CASE("bricks with friction, with one tangent, without friction: as the reference") {
  for (auto const load : fem::brick_loads) {
    CAPTURE(fem::name_of(load));
    auto const scene = fem::make_steel_brick({.k = test::effort(2, 1), .load = load});
    check_against_reference(contact::friction_disc{}, scene.K, test::contact_data(scene));
    check_against_reference(contact::friction_line{}, scene.K, test::one_tangent(scene));
    check_against_reference(contact::frictionless{}, scene.K, test::frictionless_data(scene));
  }
}

template <class D> concept lends_a = requires(D&& d) { std::forward<D>(d).a(); };
template <class D> concept lends_qp = requires(D&& d) { std::forward<D>(d).qp(); };
template <class D> concept lends_b = requires(D&& d) { std::forward<D>(d).b(); };
template <class D> concept lends_set = requires(D&& d) { std::forward<D>(d).set(); };
template <class D>
concept lends_constraints = requires(D&& d) { std::forward<D>(d).constraints(); };

template <class D>
inline constexpr bool lends_all =
    lends_a<D> && lends_qp<D> && lends_b<D> && lends_set<D> && lends_constraints<D>;
template <class D>
inline constexpr bool lends_any =
    lends_a<D> || lends_qp<D> || lends_b<D> || lends_set<D> || lends_constraints<D>;

TEST_CASE("nothing can be lent by a problem that is about to go") {
  auto const scene = fem::make_steel_brick({.k = 1});
  auto const c = test::frictionless_data(scene);
  using problem = decltype(contact::dual(contact::frictionless{}, slant::ldlt(scene.K), c));
  static_assert(lends_all<problem&> && lends_all<problem const&>);
  static_assert(!lends_any<problem> && !lends_any<problem const>);
  // What is a value of its own may still be asked of it.
  CHECK(contact::dual(contact::frictionless{}, slant::ldlt(scene.K), c).zero().size() == 6);
}

TEST_CASE("nodes that never meet the obstacle carry no force; infinite slip bounds stick") {
  auto const scene = fem::make_steel_brick({.k = 2});
  auto c = test::contact_data(scene);
  for (Eigen::Index i = 0; i < c.d.size(); i += 3) c.d(i) = infinity;
  for (Eigen::Index i = 1; i < c.g.size(); i += 3) c.g(i) = infinity;
  for (Eigen::Index i = 2; i < c.g.size(); i += 3) c.g(i) = 0;
  contact::dual const dual(contact::friction_disc{}, slant::ldlt(scene.K), c);
  VectorXd const λ = solved(dual, 1e-12), u = dual.displacement(λ);
  CHECK(contact::check_optimality(scene.K, c, u, λ).residual() <= 1e-9);
  VectorXd const slip = c.T * u;
  for (Eigen::Index i = 0; i < c.d.size(); i += 3) CHECK(λ(i) == 0);
  for (Eigen::Index i = 1; i < c.g.size(); i += 3)
    CHECK(slip.segment(2 * i, 2).norm() <= 1e-8 * slip.norm());
  for (Eigen::Index i = 2; i < c.g.size(); i += 3)
    CHECK(λ.segment(c.nodes() + 2 * i, 2).norm() == 0);
}

TEST_CASE("interference without load beside infinite gaps: any length is as good as another") {
  Eigen::Index const n = 9;
  Eigen::SparseMatrix<double> const K = test::springs(n);
  Eigen::SparseMatrix<double> N(2, n);
  N.insert(0, 1) = 1;
  N.insert(1, 4) = 1;
  slant::ldlt const factor(K);
  for (double const size : {1.0, 1e-9, 1e-30, 1e30}) {
    CAPTURE(size);
    contact::data<double> const c{N, Eigen::SparseMatrix<double>(0, n), VectorXd::Zero(n),
                                  Vector2d(-size, infinity), VectorXd(0)};
    contact::dual const dual(contact::frictionless{}, factor, c);
    CHECK(dual.b()(0) == size);
    CHECK(dual.b()(1) == -size / 2);
    VectorXd const λ = solved(dual, 1e-8), u = dual.displacement(λ);
    CHECK(u(1) == doctest::Approx(-size).epsilon(1e-7));
    CHECK(λ(1) == 0);
    CHECK(contact::check_optimality(K, c, u, λ).residual() <= 1e-7);
  }
}

TEST_CASE("the load of an infinite gap is measured by the other gaps and slips") {
  auto const scene = fem::make_steel_brick({.k = 1});
  auto c = test::contact_data(scene);
  slant::ldlt const factor(scene.K);
  c.d.setConstant(1e3);  // so far away that K⁻¹f does not matter
  c.d(0) = infinity;
  contact::dual const gaps(contact::friction_disc{}, factor, c);
  double const m = static_cast<double>(c.nodes());
  CHECK(gaps.b()(0) == doctest::Approx(-1e3 / m));
  c.d.setConstant(infinity);
  contact::dual const slips(contact::friction_disc{}, factor, c);
  CHECK(slips.b()(0) == -slips.b().tail(c.T.rows()).cwiseAbs().maxCoeff() / m);
  CHECK((slips.b().head(c.nodes()).array() == slips.b()(0)).all());
  // No length at all: λ = 0 it is, at once.
  c.f.setZero();
  contact::dual const nothing(contact::friction_disc{}, factor, c);
  auto const qp = nothing.qp();
  auto const r = slant::solve(slant::kprgp{qp}, nothing.zero(), slant::reduced_gradient_below(0.0));
  CHECK(r.converged());
  CHECK(r.iterations() == 0);
  CHECK(r.x() == nothing.zero());
}

/// A brick two of whose gaps are infinite, and the factors of its K.
struct fixture {
  fem::contact_scene<3> scene = fem::make_steel_brick({.k = 2, .load = fem::brick_load::pull});
  contact::data<double> c = test::contact_data(scene);
  test::counting_factor factor{scene.K};
  fixture() { c.d(1) = c.d(7) = infinity; }
  [[nodiscard]] auto problem() const { return contact::dual(contact::friction_disc{}, factor, c); }
};

/// P_Λ of a vector that is outside of most blocks.
template <class Dual>
VectorXd projected(Dual const& dual) {
  VectorXd const far = VectorXd::LinSpaced(dual.b().size(), -2, 3);
  VectorXd y(far.size());
  slant::project(dual.set(), far, y);
  return y;
}

TEST_CASE("an updated problem is the one made of the new data, to the last bit") {
  fixture t;
  auto dual = t.problem();
  auto const qp = dual.qp();
  t.factor.solves = 0;

  auto const check_same = [&] {
    auto const fresh = t.problem();
    --t.factor.solves;  // its own
    CHECK(qp.b() == fresh.b());
    CHECK(projected(dual) == projected(fresh));
    VectorXd const λ = projected(fresh);
    CHECK(dual.displacement(λ) == fresh.displacement(λ));
    t.factor.solves -= 2;
  };

  t.c.f += VectorXd::LinSpaced(t.c.f.size(), -1, 2);
  dual.update_load(t.c.f);
  CHECK(t.factor.solves == 1);
  check_same();

  t.c.d = (t.c.d.array() + VectorXd::LinSpaced(t.c.d.size(), -1e-4, 2e-4).array()).matrix();
  dual.update_gaps(t.c.d);
  CHECK(t.factor.solves == 1);
  check_same();

  t.c.g = VectorXd::LinSpaced(t.c.g.size(), 0, 5);
  t.c.g(3) = infinity;
  dual.update_bounds(t.c.g);
  CHECK(t.factor.solves == 1);
  check_same();

  t.c.f = VectorXd::LinSpaced(t.c.f.size(), 1, 0).cwiseAbs2();
  t.c.d *= 2;
  t.c.g.setZero();
  dual.update({.f = t.c.f, .d = t.c.d, .g = t.c.g});
  CHECK(t.factor.solves == 2);
  check_same();

  dual.update({});
  CHECK(t.factor.solves == 2);
  check_same();
}

TEST_CASE("loads on the line through two others need no solve") {
  fixture t;
  auto dual = t.problem();
  VectorXd const first = t.c.f, second = VectorXd::LinSpaced(first.size(), -1, 2);
  t.factor.solves = 0;
  auto const load = [&](VectorXd const& f, int solves) {
    dual.update_load(f);
    CHECK(t.factor.solves == solves);
    t.factor.solves = 0;
    t.c.f = f;
    auto const fresh = t.problem();
    CHECK((dual.b() - fresh.b()).norm() <= 1e-12 * fresh.b().norm());
    VectorXd const λ = projected(fresh);
    VectorXd const u = fresh.displacement(λ);
    CHECK(dual.displacement(λ) == u);
    t.factor.solves = 0;
  };
  load(-1.7 * first, 0);
  load(VectorXd::Zero(first.size()), 0);
  load(second, 1);
  for (int i = 0; i <= 20; ++i) load(first + i / 7.0 * second, 0);
  load(first, 0);
  load(1e300 * first, 1);  // too far from them
  VectorXd other = second;
  other(4) *= 1 + 1e-12;
  load(other, 1);  // nearly is not enough
  load(1e-300 * other, 0);
  load(1e-300 * VectorXd::LinSpaced(first.size(), 3, 1).cwiseSqrt(), 1);
  // A small difference of two loads would be left with the errors of both.
  load(first, 1);
  VectorXd const little = 1e-4 * second;
  load(first + little, 1);
  load(((first + little) - first) * 30, 1);
}

/// What update says of a step that brings more than what is wrong with it; after it everything must
/// be as it was.
template <class Dual>
std::string complaint(Dual& dual, contact::load_step<double> const& step) {
  VectorXd const b = dual.b(), points = projected(dual), u = dual.displacement(points);
  std::string const what = SLANT_COMPLAINT(dual.update(step));
  CHECK(dual.b() == b);
  CHECK(projected(dual) == points);
  CHECK(dual.displacement(points) == u);
  return what;
}

TEST_CASE("a small change beside a huge entry, as of a penalty, is a new load") {
  Eigen::SparseMatrix<double> K(3, 3);
  K.insert(0, 0) = 1e20;
  K.insert(1, 1) = K.insert(2, 2) = 2;
  K.insert(1, 2) = K.insert(2, 1) = -1;
  contact::data<double> c;
  c.N.resize(1, 3);
  c.N.insert(0, 2) = 1;
  c.T.resize(0, 3);
  c.f = Vector3d(1e19, 0, 0.5);
  c.d = VectorXd::Zero(1);
  slant::ldlt const factor(K);
  contact::dual dual(contact::frictionless{}, factor, c);
  c.f[2] = 5;
  contact::dual const fresh(contact::frictionless{}, factor, c);
  dual.update_load(c.f);
  CHECK(dual.b() == fresh.b());
}

TEST_CASE("bad data are named and change nothing, not even the part that was good") {
  fixture const t;
  auto dual = t.problem();
  auto const entry = [](VectorXd v, Eigen::Index i, double value) {
    v(i) = value;
    return v;
  };
  VectorXd const f = 2 * t.c.f, d = 2 * t.c.d, g = 2 * t.c.g;
  CHECK(complaint(dual, {.f = f.head(3), .d = d, .g = g}) ==
        "f: got 3, expected one load per unknown, " + std::to_string(f.size()));
  CHECK(complaint(dual, {.f = entry(f, 3, quiet_nan), .d = d, .g = g}) ==
        "f[3]: got nan, expected a finite number");
  CHECK(complaint(dual, {.f = f, .d = d.head(3), .g = g}) ==
        "d: got 3, expected one gap per row of N, " + std::to_string(d.size()));
  CHECK(complaint(dual, {.f = f, .d = entry(d, 0, quiet_nan), .g = g}) ==
        "d[0]: got nan, expected a number or +inf");
  CHECK(complaint(dual, {.f = f, .d = entry(d, 0, infinity), .g = g}) ==
        "d[0]: got inf, expected a finite number, since this gap was finite when B was made");
  CHECK(complaint(dual, {.f = f, .d = entry(d, 1, 0), .g = g}) ==
        "d[1]: got 0, expected +inf, since this gap was infinite when B was made");
  CHECK(complaint(dual, {.f = f, .d = d, .g = g.head(3)}) ==
        "g: got 3, expected one slip bound per row of N, " + std::to_string(g.size()));
  CHECK(complaint(dual, {.f = f, .d = d, .g = entry(g, 4, -0.5)}) ==
        "g[4]: got -0.5, expected a number >= 0 or +inf");
  CHECK(complaint(dual, {.f = VectorXd::Constant(f.size(), 1e308), .d = d, .g = g})
            .starts_with("f: got a load under which u["));
}

TEST_CASE("gaps that no displacement opens, and bounds without friction") {
  auto const scene = fem::make_steel_brick({.k = 1});
  auto c = test::frictionless_data(scene);
  c.N.prune([](auto row, auto, double) { return row != 2; });
  contact::dual dual(contact::frictionless{}, slant::ldlt(scene.K), c);
  VectorXd d = c.d;
  d(2) = -1;
  CHECK(
      complaint(dual, {.d = d}) ==
      "d[2]: got -1, expected a number >= 0, since row 2 of N is zero: no displacement opens this "
      "gap");
  CHECK(complaint(dual, {.g = VectorXd::Zero(6)}) ==
        "g: got 6, expected no slip bounds without T, 0");
  d(2) = 1;
  dual.update({.d = d, .g = VectorXd(0)});
  CHECK(dual.b()(2) == -1);
}

TEST_CASE("friction law and data must fit") {
  auto const scene = fem::make_steel_brick({.k = 1});
  slant::ldlt const factor(scene.K);
  using slant::bad_input;
  CHECK_THROWS_WITH_AS(contact::dual(contact::frictionless{}, factor, test::contact_data(scene)),
                       "tangents per contact node: got 2, expected 0 for this friction law",
                       bad_input);
  auto c = test::contact_data(scene);
  c.f.conservativeResize(c.f.size() - 1);
  CHECK_THROWS_AS(contact::dual(contact::friction_disc{}, factor, c), bad_input);
  contact::dual const dual(contact::friction_disc{}, factor, test::contact_data(scene));
  CHECK_THROWS_AS(static_cast<void>(dual.displacement(VectorXd::Zero(1))), bad_input);
}

}  // namespace dual_test
