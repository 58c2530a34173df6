// SPDX-License-Identifier: MIT
//
// Load steps without factors, against the dual problem with factors.
#include <slant/contact/primal_stepper.hpp>

#include <slant/contact/dual.hpp>
#include <slant/contact/optimality.hpp>
#include <slant/contact/solve.hpp>
#include <slant/factorizations/factorize.hpp>
#include <slant/iteration/solve.hpp>
#include <slant/methods/symmetric_newton.hpp>

#include <support/testing.hpp>
#include "loose_brick.hpp"
#include "scenes.hpp"

namespace primal_stepper_test {

using step = contact::load_step<double>;
using options = contact::solve_options<double>;
using coulomb_options = contact::certified_coulomb_options<double>;

struct scene {
  sparse K;
  contact::data<double> data;
  options o;

  explicit scene(int k, fem::brick_load load, double tolerance = 1e-9) {
    auto s = fem::make_steel_brick({.k = k, .load = load});
    o.tolerance = tolerance;
    o.layout = contact::layout_of(s.mesh.nodes, s.unknowns.first);
    K = std::move(s.K);
    data = {std::move(s.N), std::move(s.T), std::move(s.f), std::move(s.d), std::move(s.g)};
  }
};

/// The same steps by the forces.
class reference {
 public:
  explicit reference(scene const& s)
      : problem_(contact::friction_disc{}, slant::factorize(s.K), s.data) {}
  VectorXd advance(step next) {
    problem_.update(std::move(next));
    auto const run = slant::solve(slant::symmetric_newton{problem_.qp()}, problem_.zero(),
                                  slant::reduced_gradient_below(1e-13) || slant::at_most(300));
    return problem_.displacement(run.x());
  }

 private:
  using factor_type = decltype(slant::factorize(std::declval<sparse const&>()));
  contact::dual<contact::friction_disc, factor_type, double> problem_;
};

/// What the stepper found for these steps; each checked.
std::vector<contact::solution<double>> agree(scene const& s, std::vector<step> const& steps) {
  contact::primal_stepper stepper(s.K, s.data, s.o);
  reference dual(s);
  std::vector<contact::solution<double>> found;
  for (auto const& next : steps) {
    CAPTURE(found.size());
    found.push_back(stepper.advance(next));
    auto const& r = found.back();
    CAPTURE(r.reason);
    VectorXd const u = dual.advance(next);
    double const error = oracle::energy_error(s.K, r.u, u);
    CHECK(r.converged());
    CHECK(error <= s.o.tolerance);
    CHECK(r.error.relative() >= 0.9 * error - 1e-11);  // that of the reference
    CHECK(r.error.size == doctest::Approx(std::sqrt(u.dot(s.K * u))).epsilon(1e-6));
    CHECK(r.work.factorizations == 0);
  }
  return found;
}

TEST_CASE("loads, gaps, slip bounds, and friction on increments") {
  for (auto const load : fem::brick_loads) {
    scene const s(test::effort(5, 2), load);
    auto const& c = s.data;
    VectorXd const w = VectorXd::LinSpaced(c.T.rows(), -2e-5, 3e-5);
    VectorXd gaps = c.d;
    gaps.head(3).setConstant(1e-5);
    auto const found = agree(s, {{.f = VectorXd(0.5 * c.f)},
                                 {},
                                 {.f = c.f},
                                 {.g = VectorXd(2 * c.g)},
                                 {.d = gaps},
                                 {.w = w},
                                 {.f = VectorXd(0.8 * c.f), .w = VectorXd(0.5 * w)},
                                 {.w = VectorXd(0 * w)}});
    // Where nothing has changed nothing is done.
    CHECK(found[1].iterations <= 2);
    CHECK(found[1].work.inner_iterations <= 4);
  }
}

TEST_CASE("a path costs a part of as many problems: steps start at the last solutions") {
  scene const s(test::effort(10, 4), fem::brick_load::lift, 1e-8);
  contact::primal_stepper stepper(s.K, s.data, s.o);
  slant::index steps = 0, cycles = 0;
  VectorXd w = VectorXd::Zero(s.data.T.rows());
  for (int i = 1; i <= 10; ++i) {
    auto const& r = stepper.advance({.f = VectorXd(i / 10.0 * s.data.f), .w = w});
    CHECK(r.converged());
    steps += r.iterations;
    cycles += r.work.inner_iterations;
    w = s.data.T * r.u;
  }
  CHECK(steps <= 80);
  CHECK(cycles <= 250);
}

TEST_CASE("loads of any size after each other") {
  scene const s(2, fem::brick_load::pull);
  auto const& c = s.data;
  std::vector<step> steps;
  for (double const unit : {1.0, 1e12, 1e-12, 1.0})
    steps.push_back({.f = VectorXd(unit * c.f), .d = VectorXd(unit * c.d), .g = unit * c.g});
  agree(s, steps);
}

TEST_CASE("a floor lets a node go that the step down to it has held") {
  VectorXd const k{{1.0625, 0.0625, 4.0625}};
  sparse const K = MatrixXd(k.asDiagonal()).sparseView(), I = MatrixXd::Identity(3, 3).sparseView();
  contact::data<double> const c{.N = I.topRows(1),
                                .T = I.bottomRows(2),
                                .f = Eigen::Vector3d(1, 0, -3),
                                .d = VectorXd::Zero(1),
                                .g = VectorXd::Zero(1)};
  auto const layout = contact::interleaved_layout(MatrixXd(MatrixXd::Zero(3, 1)));
  contact::primal_stepper stepper(K, c, {.tolerance = 1e-8, .layout = layout});
  CHECK(stepper.advance({}).converged());
  auto const& r = stepper.advance({.d = VectorXd::Ones(1)});
  CHECK((r.converged() && (r.u - c.f.cwiseQuotient(k)).norm() <= 1e-8));
}

TEST_CASE("tangential positions in the first step") {
  scene const s(2, fem::brick_load::lift);
  agree(s, {{.w = VectorXd::Constant(s.data.T.rows(), 1e-4)}, {.f = VectorXd(2 * s.data.f)}});
}

coulomb_options coulomb_options_of(scene const& s) {
  return {.tolerance = s.o.tolerance, .layout = s.o.layout};
}

/// Data whose solution is u − Tᵀw (rows of T are unit vectors): friction acts from 0 there.
contact::data<double> from_zero(sparse const& K, contact::data<double> c, VectorXd const& w) {
  c.f -= K * VectorXd(c.T.transpose() * w);
  return c;
}

TEST_CASE("Coulomb's law on increments: each step as a problem of its own by the forces") {
  for (auto const load : fem::brick_loads) {
    scene const s(test::effort(5, 2), load);
    VectorXd const F = VectorXd::Constant(s.data.d.size(), 0.3);
    contact::data<double> c = s.data;
    contact::primal_coulomb_stepper stepper(s.K, c, F, coulomb_options_of(s));
    VectorXd const f = c.f;
    VectorXd w = VectorXd::Zero(c.T.rows());
    VectorXd gaps = c.d;
    gaps.head(3).setConstant(1e-5);
    for (step const& next : std::vector<step>{
             {.f = VectorXd(0.5 * f)},
             {},
             {.f = f, .w = VectorXd::LinSpaced(w.size(), -2e-5, 3e-5)},
             {.d = gaps},
             {.f = VectorXd(1e-6 * f), .d = VectorXd(1e-6 * gaps), .w = VectorXd(0 * w)},
             {.f = VectorXd(0.8 * f), .d = c.d}}) {
      if (next.f) c.f = *next.f;
      if (next.d) c.d = *next.d;
      if (next.w) w = *next.w;
      auto const& r = stepper.advance(next);
      CAPTURE(r.reason);
      REQUIRE(r.converged());
      auto const alone = contact::certified_coulomb(
          contact::friction_disc{}, s.K, from_zero(s.K, c, w), F,
          {.tolerance = 1e-12, .route = contact::solution_route::factor});
      VectorXd const u = alone.u + c.T.transpose() * w;
      CHECK(oracle::energy_error(s.K, r.u, u) <= s.o.tolerance);
      CHECK((r.λ - alone.λ).norm() <= 100 * s.o.tolerance * alone.λ.norm());
      CHECK(r.error.frozen.size == doctest::Approx(std::sqrt(u.dot(s.K * u))).epsilon(1e-6));
      if (!next.f && !next.d && !next.w) CHECK(r.steps <= 3);  // nothing has changed
    }
    // Without pressure nothing holds what friction has held.
    auto const& rest =
        stepper.advance({.f = VectorXd(0 * f), .w = VectorXd::Constant(w.size(), 1e-4)});
    CHECK((rest.converged() && rest.u == 0 * f && rest.λ.isZero(0)));
    CHECK(stepper.advance({.f = f}).converged());
  }
}

TEST_CASE("a path with Coulomb's law costs a part of as many problems") {
  scene const s(test::effort(8, 4), fem::brick_load::pull, 1e-8);
  VectorXd const F = VectorXd::Constant(s.data.d.size(), 0.3);
  contact::primal_coulomb_stepper stepper(s.K, s.data, F, coulomb_options_of(s));
  auto alone = coulomb_options_of(s);
  alone.route = contact::solution_route::iterate;
  VectorXd const press =
      fem::make_steel_brick({.k = test::effort(8, 4), .load = fem::brick_load::press}).f;
  slant::index cycles = 0, cycles_alone = 0;
  for (int i = 1; i <= 10; ++i) {
    contact::data<double> c = s.data;
    c.f = press + i / 10.0 * (s.data.f - press);
    cycles += stepper.advance({.f = c.f}).work.inner_iterations;
    cycles_alone += contact::certified_coulomb(contact::friction_disc{}, s.K, c, F, alone)
                        .work.inner_iterations;
  }
  CHECK(cycles <= 0.7 * static_cast<double>(cycles_alone));  // 0.6
}

TEST_CASE("bodies that contact and friction hold, on a path") {
  for (double const friction : {0.05, 0.0}) {  // slip bound; 0: Coulomb's law
    CAPTURE(friction);
    test::loose_brick const loose(0.3, {-0.05, 0, 0}, friction);
    contact::data<double> c = loose.data;
    contact::solve_options<double> const o{.tolerance = 1e-9,
                                           .layout = contact::interleaved_layout(loose.mesh.nodes)};
    coulomb_options const with_law{.tolerance = o.tolerance, .layout = o.layout};
    contact::primal_stepper tresca(loose.K, c, o);
    contact::primal_coulomb_stepper coulomb(loose.K, c, VectorXd::Constant(c.d.size(), 0.3),
                                            with_law);
    VectorXd const f = c.f, w = VectorXd::LinSpaced(c.T.rows(), -2e-6, 3e-6);
    VectorXd const none = VectorXd::Zero(w.size()), gaps = VectorXd::Constant(c.d.size(), 1e-5);
    VectorXd at = none;
    for (step const& next : std::vector<step>{{.f = VectorXd(0.5 * f)},
                                              {},
                                              {.f = f},
                                              {.w = w},
                                              {.f = VectorXd(0.9 * f), .d = gaps, .w = none},
                                              {.d = VectorXd(100 * gaps)},
                                              {.f = VectorXd(0.901 * f)}}) {
      if (next.f) c.f = *next.f;
      if (next.d) c.d = *next.d;
      if (next.w) at = *next.w;
      VectorXd u;
      if (friction > 0) {
        auto const& r = tresca.advance(next);
        CAPTURE(r.reason);
        CHECK(r.converged());
        CHECK(r.motions.free.size() == 1);
        u = r.u;
      } else {
        auto const& r = coulomb.advance(next);
        CAPTURE(r.reason);
        CHECK(r.converged());
        c.g = 0.3 * r.λ.head(c.d.size()).cwiseMax(0);
        u = r.u;
      }
      auto const alone =
          contact::solve(loose.K, from_zero(loose.K, c, at),
                         {.tolerance = 1e-10, .route = contact::solution_route::factor});
      REQUIRE(alone.converged());
      CHECK(oracle::energy_error(loose.K, u, VectorXd(alone.u + c.T.transpose() * at)) <= 1.1e-9);
    }
    // Without a load bodies rest where they began.
    CHECK((friction > 0 ? tresca.advance({.f = VectorXd(0 * f)}).u
                        : coulomb.advance({.f = VectorXd(0 * f)}).u) == 0 * f);
  }
}

TEST_CASE("what does not fit is named and changes nothing") {
  scene const s(2, fem::brick_load::pull);
  auto const& c = s.data;
  contact::primal_stepper stepper(s.K, c, s.o);
  VectorXd const u = stepper.advance({}).u;
  auto const refused = [&](step const& next) { return SLANT_COMPLAINT(stepper.advance(next)); };
  CHECK(refused({.f = VectorXd(VectorXd::Ones(3))}).find("f") != std::string::npos);
  CHECK(refused({.f = VectorXd(3 * c.f), .g = VectorXd(-c.g)}).find("g[0]: got -") == 0);
  CHECK(refused({.d = VectorXd(c.d.head(2))}).find("d") != std::string::npos);
  CHECK(refused({.w = VectorXd(1)}) ==
        "w: got 1, expected one per row of T, " + std::to_string(c.T.rows()));
  VectorXd w = VectorXd::Zero(c.T.rows());
  w[1] = std::numeric_limits<double>::quiet_NaN();
  CHECK(refused({.w = w}).find("w[1]: got nan") == 0);
  CHECK((stepper.advance({}).u - u).norm() <= 1e-8 * u.norm());

  auto const complaint = [&](sparse const& K, contact::data<double> const& data, options o) {
    return SLANT_COMPLAINT(contact::primal_stepper(K, data, std::move(o)));
  };
  options o = s.o;
  o.prove = true;
  CHECK(complaint(s.K, c, o) == "prove: got true, expected false, as a proof takes factors");
  contact::data<double> half = c;
  half.T.prune([](Eigen::Index row, Eigen::Index, double) { return row > 1; });
  CHECK(complaint(s.K, half, s.o).find("N and T: got contact 0 has an empty row of T") == 0);
  contact::primal_coulomb_stepper coulomb(s.K, c, VectorXd::Constant(c.d.size(), 0.3),
                                          coulomb_options_of(s));
  CHECK(SLANT_COMPLAINT(coulomb.advance({.g = c.g})) ==
        "g: got slip bounds, expected none, which are F times the pressures");
  CHECK(SLANT_COMPLAINT(contact::primal_coulomb_stepper(s.K, c, VectorXd::Constant(c.d.size(), -1),
                                                        coulomb_options_of(s)))
            .find("F[0]: got -1") == 0);
}

TEST_CASE("a step that ends early is told, and not gone on from") {
  scene s(4, fem::brick_load::lift);
  s.o.max_steps = 4;
  contact::primal_stepper stepper(s.K, s.data, s.o);
  auto const& first = stepper.advance({});
  CHECK(first.status == slant::status::iteration_limit);
  CHECK(first.reason.find("asked was 1e-09") != std::string::npos);
  CHECK(stepper.advance({.f = VectorXd(0 * s.data.f), .g = VectorXd(0 * s.data.g)}).u.norm() <=
        1e-12);
}

}  // namespace primal_stepper_test
