// SPDX-License-Identifier: MIT
#include "counting_factor.hpp"
#include "scenes.hpp"

#include <slant/contact/dual.hpp>
#include <slant/contact/load_stepper.hpp>
#include <slant/contact/preconditioners.hpp>
#include <slant/factorizations/ldlt.hpp>
#include <slant/methods/symmetric_newton.hpp>
#include <support/testing.hpp>

namespace load_stepper_test {

using step = contact::load_step<double>;

struct fixture {
  fem::contact_scene<3> scene = fem::make_steel_brick({.k = 2, .load = fem::brick_load::lift});
  VectorXd press = fem::make_steel_brick({.k = 2}).f;
  contact::data<double> c = test::contact_data(scene);
  test::counting_factor factor{scene.K};
  fixture() { c.f = press; }

  [[nodiscard]] VectorXd load(double t) const { return press + t * (scene.f - press); }
  /// Lifted until nodes open, and let down until they close; in between a step without friction,
  /// one on a rougher floor, and one that moves the floor.
  [[nodiscard]] std::vector<step> path() const {
    VectorXd const d = VectorXd::LinSpaced(c.d.size(), 0, 1e-6);
    return {{},
            {.f = load(0.4)},
            {.f = load(0.8)},
            {.g = VectorXd::Zero(c.g.size())},
            {.f = load(1), .g = 2 * c.g},
            {.f = load(0.7), .d = d},
            {.d = VectorXd::Zero(d.size()), .g = c.g},
            {.f = load(0.2)},
            {.f = VectorXd::Zero(press.size())}};
  }
  /// The data after a step.
  void take(step const& s) {
    if (s.f) c.f = *s.f;
    if (s.d) c.d = *s.d;
    if (s.g) c.g = *s.g;
  }
};

// The references are dense and share no code.
TEST_CASE("every step is the solution of its data: Newton's method with a preconditioner") {
  fixture t;
  contact::dual problem(contact::friction_disc{}, t.factor, t.c);
  auto const qp = problem.qp();
  slant::symmetric_newton const method{
      qp, contact::lumped_preconditioner(t.scene.K, problem.constraints())};
  contact::load_stepper stepper(problem, method,
                                slant::reduced_gradient_below(1e-11) || slant::at_most(20000));
  Eigen::Index fewest = t.c.nodes(), most = 0;
  slant::index number = 0;
  for (step const& s : t.path()) {
    t.take(s);
    t.factor.solves = 0;
    auto const& report = stepper.advance(s);
    CAPTURE(report.number);
    CHECK(report.number == ++number);
    REQUIRE(report.converged());
    // Two loads are solved for, the others are combinations of them; and nothing but what the
    // report says, which has nothing to learn about A after the first step.
    auto const& work = report.work;
    CHECK(t.factor.solves ==
          (number == 2 ? 1 : 0) + work.operator_applications + work.setup_applications);
    CHECK((number == 1) == (work.setup_applications > 0));
    VectorXd const u = problem.displacement(report.x());
    auto const reference = test::reference(t.scene.K, t.c);
    if (t.c.f.norm() > 0) {
      CHECK(oracle::energy_error(t.scene.K, u, reference.u) <= 1e-9);
    } else {
      CHECK(u.norm() == 0);
    }
    Eigen::Index const pressed = (report.x().head(t.c.nodes()).array() > 0).count();
    fewest = std::min(fewest, pressed);
    most = std::max(most, pressed);
  }
  CHECK(fewest < most);
}

TEST_CASE("proportional loads while nothing slides: a product a step") {
  fixture t;
  t.c.g.setConstant(1e6);
  contact::dual problem(contact::friction_disc{}, t.factor, t.c);
  auto const qp = problem.qp();
  slant::symmetric_newton const method{qp};
  contact::load_stepper stepper(problem, method,
                                slant::reduced_gradient_below(1e-9) || slant::at_most(100));
  CHECK(stepper.advance({}).work.operator_applications > 10);
  for (double const factor : {2.0, 3.0, 5.0, -0.0, 1.0}) {
    CAPTURE(factor);
    auto const& report = stepper.advance({.f = factor * t.press});
    CHECK(report.converged());
    CHECK(report.work.operator_applications == (factor == 0 ? 0 : 1));
    CHECK(report.iterations() == 0);
  }
}

TEST_CASE("a step that fails says so, and the next one starts from the last that did not") {
  fixture t;
  contact::dual problem(contact::friction_disc{}, t.factor, t.c);
  auto const qp = problem.qp();
  slant::symmetric_newton const method{qp};
  bool patient = true;
  auto const hasty =
      slant::stop_when([&](auto const& s) { return !patient && s.iteration == 1; }, "no patience");
  contact::load_stepper stepper(problem, method, slant::reduced_gradient_below(1e-11) || hasty);
  auto const& solved = stepper.advance({});
  REQUIRE(solved.converged());
  patient = false;
  contact::load_stepper other(problem, method, slant::at_most(0), solved.x());  // fails, too
  VectorXd const first = other.advance({}).x();
  CHECK((other.advance({}).x() == first && first != VectorXd(VectorXd::Zero(first.size()))));
  auto const& failed = stepper.advance({.f = t.scene.f});
  CHECK(failed.number == 2);
  CHECK(failed.status == slant::status::interrupted);
  CHECK(failed.reason == "no patience");
  patient = true;
  auto const& again = stepper.advance({});
  CHECK(again.number == 3);
  REQUIRE(again.converged());
  t.take({.f = t.scene.f});
  CHECK(oracle::energy_error(t.scene.K, problem.displacement(again.x()),
                             test::reference(t.scene.K, t.c).u) <= 1e-9);
}

TEST_CASE("data that do not fit: nothing has happened") {
  fixture t;
  contact::dual problem(contact::friction_disc{}, t.factor, t.c);
  auto const qp = problem.qp();
  slant::symmetric_newton const method{qp};
  contact::load_stepper stepper(problem, method,
                                slant::reduced_gradient_below(1e-9) || slant::at_most(100));
  VectorXd const λ = stepper.advance({}).x(), b = problem.b();
  step const bad{.f = t.scene.f, .g = VectorXd::Constant(t.c.g.size(), -1)};
  CHECK(SLANT_COMPLAINT(stepper.advance(bad)) == "g[0]: got -1, expected a number >= 0 or +inf");
  CHECK(problem.b() == b);
  auto const& report = stepper.advance({});
  CHECK(report.number == 2);
  CHECK(report.x().isApprox(λ, 1e-8));
}

TEST_CASE("no allocation in a later step, from the start on") {
  fixture t;
  slant::ldlt const factor(t.scene.K);
  contact::dual problem(contact::friction_disc{}, factor, t.c);
  auto const qp = problem.qp();
  slant::symmetric_newton const method{qp};
  auto s = method.start(problem.zero());
  for (int k = 0; k < 20; ++k) method.step(s);
  problem.update_load(1.5 * t.press);
  VectorXd const λ = 1.2 * s.x;
  slant::testing::allocation_guard guard;
  method.resume(s, λ);
  for (int k = 0; k < 5; ++k) method.step(s);
  auto const allocations = guard.count();
  CHECK(allocations == 0);
  CHECK(s.work.setup_applications == 0);
}

}  // namespace load_stepper_test
