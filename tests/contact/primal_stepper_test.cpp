// SPDX-License-Identifier: MIT
//
// Load steps without factors, against the dual problem with factors.
#include <slant/contact/primal_stepper.hpp>

#include <slant/contact/dual.hpp>
#include <slant/factorizations/factorize.hpp>
#include <slant/iteration/solve.hpp>
#include <slant/methods/symmetric_newton.hpp>

#include <support/testing.hpp>
#include "loose_brick.hpp"
#include "scenes.hpp"

namespace primal_stepper_test {

namespace contact = slant::contact;
using sparse = Eigen::SparseMatrix<double>;
using step = contact::load_step<double>;
using options = contact::solve_options<double>;

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
  for (double const unit : {1.0, 1e12, 1e-12, 1.0}) {
    steps.push_back({.f = VectorXd(unit * c.f), .d = VectorXd(unit * c.d), .g = unit * c.g});
  }
  agree(s, steps);
}

TEST_CASE("tangential positions in the first step") {
  scene const s(2, fem::brick_load::lift);
  agree(s, {{.w = VectorXd::Constant(s.data.T.rows(), 1e-4)}, {.f = VectorXd(2 * s.data.f)}});
}

TEST_CASE("what does not fit is named and changes nothing") {
  scene const s(2, fem::brick_load::pull);
  auto const& c = s.data;
  contact::primal_stepper stepper(s.K, c, s.o);
  VectorXd const u = stepper.advance({}).u;
  auto const refused = [&](step const& next) {
    return test::complaint([&] { static_cast<void>(stepper.advance(next)); });
  };
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
    return test::complaint([&] { contact::primal_stepper(K, data, std::move(o)); });
  };
  options o = s.o;
  o.prove = true;
  CHECK(complaint(s.K, c, o) == "prove: got true, expected false, as a proof takes factors");
  contact::data<double> half = c;
  half.T.prune([](Eigen::Index row, Eigen::Index, double) { return row > 1; });
  CHECK(complaint(s.K, half, s.o).find("N and T: got contact 0 has an empty row of T") == 0);
  test::loose_brick const loose(1, Vector3d::Zero(), 0.05);
  o = {.tolerance = 1e-8, .layout = contact::interleaved_layout(loose.mesh.nodes)};
  CHECK(complaint(loose.K, loose.data, o).find("expected supports of every body") !=
        std::string::npos);
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
