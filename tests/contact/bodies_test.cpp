// SPDX-License-Identifier: MIT
#include <slant/contact/bodies.hpp>

#include <slant/contact/dual.hpp>
#include <slant/factorizations/ldlt.hpp>
#include <slant/iteration/solve.hpp>
#include <slant/methods/schur_contact.hpp>
#include <slant/methods/symmetric_newton.hpp>

#include <fem/contact_scene.hpp>
#include <fem/elastic_torsion.hpp>
#include <fem/plate_chain.hpp>
#include <fem/stacked_bricks.hpp>
#include <fem/steel_brick.hpp>
#include <fem/string_1d.hpp>
#include <fem/two_bricks.hpp>
#include <fem/two_plates.hpp>
#include <support/dense_of.hpp>
#include <support/testing.hpp>

namespace bodies_test {

using slant::status;

struct answer {
  VectorXd u;
  VectorXd λ;
};

auto run(contact::bodies<double> const& bodies, double tolerance = 1e-12) {
  auto const qp = bodies.qp();
  return slant::solve(slant::schur_contact{qp}, bodies.zero(),
                      slant::residual_below(tolerance) || slant::at_most(5000));
}

/// The dual problem with a definite K, by another method.
answer by_dual(sparse const& K, VectorXd const& f, sparse const& B, VectorXd const& c) {
  contact::data<double> data;
  data.N = B;
  data.T.resize(0, K.rows());
  data.f = f;
  data.d = c;
  contact::dual const dual(contact::frictionless{}, slant::ldlt(K), data);
  auto const qp = dual.qp();
  auto const newton = slant::solve(slant::symmetric_newton{qp}, dual.zero(),
                                   slant::reduced_gradient_below(1e-13) || slant::at_most(200));
  REQUIRE(newton.state.reduced_gradient_norm <= 1e-11 * newton.state.gradient_scale);
  return {dual.displacement(newton.x()), newton.x()};
}

void compare(contact::bodies<double> const& bodies, answer const& expected) {
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

TEST_CASE("loads that no contact balances: unbounded, with the direction") {
  struct push {
    char const* name;
    fem::stack_options options;
  };
  push const pushes[] = {{"pulled up", {.top = {-1, -1}}},
                         {"tipped over", {.top = {1.5, -1.2}}},
                         {"away from the walls", {.walls = -0.3}},
                         {"three bricks, the upper two lifted", {.bricks = 3, .top = {-0.5, -1}}}};
  for (auto const& [name, options] : pushes) {
    CAPTURE(name);
    auto const scene = fem::make_stack(options);
    contact::bodies<double> const bodies(scene.K, scene.f, scene.B, scene.c);
    auto const r = run(bodies);
    CHECK(r.status == status::unbounded);
    CHECK(r.reason == "no solution: the energy falls for ever along `descent`");
    VectorXd const d = bodies.direction(r.state.descent).normalized();
    CHECK((scene.K * d).norm() <= 1e-13 * scene.K.norm());
    CHECK((scene.B * d).maxCoeff() <= 1e-12);
    CHECK(scene.f.dot(d) >= 1e-3 * scene.f.norm());
  }
}

/// Factors that count their solves, per size of the matrix.
struct counting_factor {
  struct factors {
    slant::ldlt<double> inner;
    std::shared_ptr<std::vector<slant::index>> solved;

    [[nodiscard]] slant::index rows() const { return inner.rows(); }
    [[nodiscard]] auto workspace(VectorXd const& b) const { return inner.workspace(b); }
    void solve(VectorXd const& b, VectorXd& x, VectorXd& w) const {
      solved->push_back(rows());
      inner.solve(b, x, w);
    }
  };
  std::shared_ptr<std::vector<slant::index>> solved = std::make_shared<std::vector<slant::index>>();
  std::shared_ptr<int> factored = std::make_shared<int>(0);

  [[nodiscard]] factors operator()(sparse const& k) const {
    ++*factored;
    return {slant::ldlt<double>(k), solved};
  }
};

TEST_CASE("bodies that touch nothing cost one solve, and nothing per iteration") {
  for (int const touching : {0, 2, 4}) {
    auto const scene = fem::make_plate_chain({.plates = 9, .touching = touching, .k = 4});
    counting_factor const factor;
    contact::bodies<double, counting_factor> const bodies(scene.K, scene.f, scene.B, scene.c,
                                                          factor);
    int const idle = 9 - touching;
    CHECK(bodies.idle() == idle);
    CHECK(*factor.factored == 9);
    CHECK(bodies.factorizations() == 9);
    auto const per_plate = scene.f.size() / 9;
    CHECK(bodies.live_size() == touching * per_plate);
    CHECK(slant::index(factor.solved->size()) == idle);

    auto const qp = bodies.qp();
    auto const r = slant::solve(slant::schur_contact{qp}, bodies.zero(),
                                slant::residual_below(1e-11) || slant::at_most(500));
    REQUIRE(r.converged());
    CHECK((touching == 0) == (r.iterations() == 0));
    // Each application of Q is one sweep over each body that may touch another.
    auto const sweeps = slant::index(factor.solved->size()) - idle;
    CHECK(sweeps == touching * r.state.projector_applications);
    CHECK(*factor.factored == 9);
    VectorXd const u = bodies.displacement(r.x());
    VectorXd const rest = scene.K * u - scene.f;
    CHECK(rest.tail(idle * per_plate).norm() <= 1e-11 * scene.f.norm());
    if (touching < 2) continue;
    CHECK(r.state.rows.active.size() > 0);
    compare(contact::bodies<double>(scene.K, scene.f, scene.B, scene.c),
            by_dual(scene.K, scene.f, scene.B, scene.c));
  }
}

TEST_CASE("floating bodies with too few constraints, or none, are given fixing rows") {
  auto scene = fem::make_stack({.bricks = 1, .cells = {3, 2, 2}});
  sparse const none(0, scene.K.rows());
  // No constraint and no load: at rest.
  contact::bodies<double> const free(scene.K, VectorXd::Zero(scene.K.rows()).eval(), none,
                                     VectorXd());
  CHECK(free.fixed() == 1);
  CHECK(free.idle() == 0);
  CHECK(free.factorizations() == 3);
  CHECK(free.live_size() - free.inside_size() == 6);
  CHECK(run(free).converged());
  // Forces in balance: a solution, whichever rigid motion it has.
  VectorXd const stretched = VectorXd::Random(scene.K.rows());
  VectorXd const balanced = scene.K * stretched;
  contact::bodies<double> const held(scene.K, balanced, none, VectorXd());
  auto const r = run(held);
  CHECK(r.converged());
  CHECK((scene.K * held.displacement(r.x()) - balanced).norm() <= 1e-11 * balanced.norm());
  // Forces that are not.
  contact::bodies<double> const pushed(scene.K, scene.f, none, VectorXd());
  auto const u = run(pushed);
  CHECK(u.status == status::unbounded);
  CHECK(scene.f.dot(pushed.direction(u.state.descent)) > 0);

  // One contact node, under the middle of a brick that is pressed down there alone.
  sparse one(1, scene.K.rows());
  VectorXd load = VectorXd::Zero(scene.K.rows());
  for (int node = 0; node < scene.mesh.node_count(); ++node) {
    if (scene.mesh.nodes(2, node) == 0 && scene.mesh.nodes(1, node) == 0.5 && one.nonZeros() == 0) {
      one.insert(0, 3 * node + 2) = -1;
      load[3 * node + 2] = -1;
    }
  }
  REQUIRE(one.nonZeros() == 1);
  contact::bodies<double> const balancing(scene.K, load, one, VectorXd{{0.25}});
  CHECK(balancing.fixed() == 1);
  // The brick falls by a quarter of its height: ε ‖K‖‖u‖ is 1e-10 times the load.
  auto const b = run(balancing, 1e-9);
  REQUIRE(b.converged());
  CHECK(b.state.multipliers()[0] == doctest::Approx(1));
  CHECK((one * balancing.displacement(b.x()))[0] == doctest::Approx(0.25));
}

TEST_CASE("bodies of softer and stiffer material, and in other units") {
  auto const soft = fem::make_stack({.bricks = 3, .E = {2e5, 2e2}});
  contact::bodies<double> const bodies(soft.K, soft.f, soft.B, soft.c);
  auto const r = run(bodies, 1e-11);
  REQUIRE(r.converged());
  VectorXd const u = bodies.displacement(r.x());
  VectorXd const λ = r.state.multipliers();
  CHECK((soft.K * u + soft.B.transpose() * λ - soft.f).norm() <= 1e-10 * soft.f.norm());
  CHECK((soft.B * u - soft.c).maxCoeff() <= 1e-14 * u.norm());
  for (double const unit : {0x1p+300, 0x1p-300}) {
    contact::bodies<double> const scaled(sparse(unit * soft.K), VectorXd(unit * soft.f), soft.B,
                                         soft.c);
    auto const s = run(scaled, 1e-11);
    CHECK(s.converged());
    CHECK(scaled.displacement(s.x()) == u);
    CHECK(s.state.multipliers() == VectorXd(unit * λ));
  }
}

TEST_CASE("data that do not fit are named") {
  auto const message = [](sparse const& K, VectorXd const& f, sparse const& B,
                          VectorXd const& c) -> std::string {
    return SLANT_COMPLAINT(contact::bodies<double>(K, f, B, c));
  };
  MatrixXd k = 2 * MatrixXd::Identity(3, 3);
  sparse const B = MatrixXd{{1, 0, 0}}.sparseView();
  VectorXd const f = VectorXd::Ones(3), c = VectorXd::Ones(1);
  CHECK(message(k.sparseView(), VectorXd::Ones(2), B, c) ==
        "rows of K: got 3, expected the size of f, 2");
  CHECK(message(k.sparseView(), f, B, VectorXd::Ones(2)) ==
        "c: got 2, expected one entry per row of B, 1");
  CHECK(message(k.sparseView(), f, sparse(1, 4), c) ==
        "columns of B: got 4, expected the size of f, 3");
  k(1, 2) = 1;
  CHECK(message(k.sparseView(), f, B, c).starts_with("K("));
  k(2, 1) = 1;
  // Indefinite, as the diagonal shows; where it does not, it is found out on the way.
  k(1, 1) = -2;
  CHECK(message(k.sparseView(), f, B, c) ==
        "K(1, 1): got -2, expected a number >= 0 on the diagonal of a semidefinite matrix");
  k(1, 1) = 0;
  CHECK(message(k.sparseView(), f, B, c) ==
        "K(1, 1): got 0, expected a number > 0, since row 1 has other entries");
  k(1, 1) = 0.25;
  contact::bodies<double> const indefinite(sparse(k.sparseView()), f, B, c);
  CHECK(run(indefinite).status == status::breakdown);
}

/// Bars in a zigzag, joined by hinges: a body that can fold, with a kernel of n + 1 dimensions.
sparse hinged_bars(int n) {
  std::vector<Eigen::Triplet<double>> entries;
  for (int bar = 0; bar + 1 < n; ++bar) {
    double const along[] = {std::cos(0.7), (bar % 2 == 0 ? 1 : -1) * std::sin(0.7)};
    for (int a = 0; a < 4; ++a) {
      for (int b = 0; b < 4; ++b) {
        double const sign = a / 2 == b / 2 ? 1 : -1;
        entries.emplace_back(2 * bar + a, 2 * bar + b, sign * along[a % 2] * along[b % 2]);
      }
    }
  }
  sparse K(2 * n, 2 * n);
  K.setFromTriplets(entries.begin(), entries.end());
  return K;
}

TEST_CASE("mechanisms: a kernel of any size is no reason to refuse a body") {
  for (int const n : {4, 8, 16, 40}) {
    CAPTURE(n);
    sparse const K = hinged_bars(n);
    sparse B(1, 2 * n);
    B.insert(0, 2 * n - 2) = 1;
    VectorXd const load = K * VectorXd::LinSpaced(2 * n, -1, 2).array().sin().matrix();
    contact::bodies<double> const bodies(K, load, B, VectorXd{{10}});
    CHECK(bodies.fixed() == 1);
    auto const r = run(bodies, 1e-10);
    CAPTURE(r.reason);
    REQUIRE(r.converged());
    CHECK((K * bodies.displacement(r.x()) - load).norm() <= 1e-9 * load.norm());
    CHECK(bodies.factorizations() <= 3);
  }
}

TEST_CASE(
    "one body on a foundation, two bodies in the plane and in space: as by the dual problem") {
  for (auto const load : fem::brick_loads) {
    CAPTURE(fem::name_of(load));
    compare(fem::make_steel_brick({.k = test::effort(4, 2), .load = load}));
  }
  compare(fem::make_two_plates(test::effort(8, 3)));
  compare(fem::make_two_bricks(test::effort(6, 4)));
}

TEST_CASE("the wire above a bound, a membrane between two obstacles: as by the dual problem") {
  // The components of the wire are two bodies; of the membrane every unknown is constrained.
  auto const wire = fem::make_wire(16);
  for (double const bound : {-1.0, 0.0}) {
    sparse N(wire.m, wire.A.rows());
    for (Eigen::Index i = 0; i < wire.m; ++i) N.insert(i, i) = -1;
    VectorXd const d = VectorXd::Constant(wire.m, -bound);
    compare(contact::bodies<double>(wire.A, wire.b, N, d), by_dual(wire.A, wire.b, N, d));
  }
  auto const bar = fem::make_elastic_torsion(6, 5, 10.0);
  sparse const A = test::dense_of(bar.A).sparseView();
  Eigen::Index const n = bar.b.size();
  sparse N(2 * n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    N.insert(i, i) = 1;
    N.insert(n + i, i) = -1;
  }
  VectorXd d(2 * n);
  d << bar.upper, -bar.lower;
  compare(contact::bodies<double>(A, bar.b, N, d), by_dual(A, bar.b, N, d));
}

/// A stack has a singular K. Springs that pull rows of B to their bounds, which they reach at the
/// solution anyway, change nothing there and make K definite. Which rows these are may be guessed
/// in any way: that the springs are at rest in the end is checked.
answer by_dual(fem::stack_scene const& scene, VectorXd const& springs) {
  double const stiffness = scene.K.diagonal().mean();
  sparse const K =
      scene.K + stiffness * sparse(scene.B.transpose() * springs.asDiagonal() * scene.B);
  VectorXd const f = scene.f + stiffness * scene.B.transpose() * springs.cwiseProduct(scene.c);
  auto const found = by_dual(K, f, scene.B, scene.c);
  // Otherwise it would be another problem.
  VectorXd const stretch = springs.cwiseProduct(scene.B * found.u - scene.c);
  REQUIRE(stretch.norm() <= 1e-11 * found.u.norm());
  return found;
}

TEST_CASE("floating bricks, held by contact alone: as by the dual problem") {
  for (double const gap : {0.0, 1e-5}) {
    auto const scene = fem::make_stack({.gap = gap});
    contact::bodies<double> const bodies(scene.K, scene.f, scene.B, scene.c);
    CHECK(bodies.count() == 2);
    CHECK(bodies.idle() == 0);
    CHECK(bodies.fixed() == 0);
    auto const active = run(bodies);
    REQUIRE(active.converged());
    VectorXd const λ = active.state.multipliers();
    CHECK((λ.array() == 0).any());  // something has opened
    VectorXd const springs = (λ.array() > 1e-3 * λ.maxCoeff()).cast<double>();
    compare(bodies, by_dual(scene, springs));
  }
}

}  // namespace bodies_test
