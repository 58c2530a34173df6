// SPDX-License-Identifier: MIT
#include "counting_factor.hpp"
#include "scenes.hpp"

#include <slant/contact/dual.hpp>
#include <slant/contact/load_steps.hpp>
#include <slant/iteration/solve.hpp>
#include <slant/methods/interior_point.hpp>
#include <slant/methods/symmetric_newton.hpp>

#include <range/v3/view/take_while.hpp>
#include <support/testing.hpp>

namespace load_steps_test {

using step = contact::load_step<double>;

struct fixture {
  fem::contact_scene<3> scene = fem::make_steel_brick({.k = 1, .load = fem::brick_load::lift});
  contact::data<double> c = test::contact_data(scene);
  test::counting_factor factor{scene.K};
  contact::dual<contact::friction_disc, test::counting_factor const&, double> problem{
      contact::friction_disc{}, factor, c};

  /// The multipliers of this load, from zero.
  [[nodiscard]] VectorXd cold(double t) const {
    contact::data<double> scaled = c;
    scaled.f *= t;
    contact::dual const other(contact::friction_disc{}, factor, scaled);
    auto const qp = other.qp();
    return slant::solve(slant::symmetric_newton{qp}, other.zero(),
                        slant::reduced_gradient_below(1e-13) || slant::at_most(100))
        .x();
  }
  [[nodiscard]] auto loads(std::vector<double> const& factors) const {
    return factors | std::views::transform([this](double t) { return step{.f = t * c.f}; });
  }
};

auto stop() {
  return slant::reduced_gradient_below(1e-12) || slant::at_most(100);
}

void follow(fixture& t, auto const& method, auto const& rule, std::vector<double> const& factors,
            double accuracy) {
  std::size_t seen = 0;
  for (auto const& report : contact::load_steps(t.problem, method, rule, t.loads(factors))) {
    REQUIRE(report.converged());
    CHECK(report.number == slant::index(seen + 1));
    CHECK((report.x() - t.cold(factors[seen])).norm() <= accuracy * report.x().norm());
    ++seen;
  }
  CHECK(seen == factors.size());
}

TEST_CASE("a range of reports, one for each step, in order; methods that cannot go on begin anew") {
  fixture t, other;
  auto const qp = t.problem.qp(), same = other.problem.qp();
  follow(t, slant::symmetric_newton{qp}, stop(), {0.3, 0.7, 1.2, 1.0}, 1e-9);
  auto const rough = slant::reduced_gradient_below(1e-7) || slant::at_most(100);
  follow(other, slant::interior_point{same}, rough, {0.5, 1.0}, 1e-5);
}

TEST_CASE("steps are solved when the range gets there, and not after the last one looked at") {
  fixture t;
  std::vector<double> const factors{0.3, 0.7, 1.2, 1.0};
  auto const qp = t.problem.qp();
  slant::symmetric_newton const method{qp};
  auto const early = [](auto const& report) { return report.number < 2; };
  slant::index last = 0;
  for (auto const& report : contact::load_steps(t.problem, method, stop(), t.loads(factors)) |
                                ranges::views::take_while(early)) {
    last = report.number;
  }
  CHECK(last == 1);
  auto other = t.c;
  other.f *= 0.7;
  contact::dual const second(contact::friction_disc{}, t.factor, other);
  CHECK((t.problem.b() - second.b()).norm() <=
        1e-14 * second.b().norm());  // take_while had to look at it; nobody got to the third
}

TEST_CASE("a step that does not converge is shown and is the last one") {
  fixture t;
  std::vector<double> const factors{0.01, 1.0, 0.5, 0.25};
  auto const qp = t.problem.qp();
  std::vector<slant::status> how;
  auto const hasty = slant::reduced_gradient_below(1e-12) || slant::at_most_applications(15);
  for (auto const& report :
       contact::load_steps(t.problem, slant::symmetric_newton{qp}, hasty, t.loads(factors))) {
    CHECK(report.number == slant::index(how.size() + 1));
    how.push_back(report.status);
  }
  REQUIRE(!how.empty());
  REQUIRE(how.size() < factors.size());
  CHECK(how.back() == slant::status::iteration_limit);
}

TEST_CASE("no steps: no reports, and nothing is solved") {
  fixture t;
  auto const qp = t.problem.qp();
  t.factor.solves = 0;
  std::vector<double> const nothing;
  auto const none =
      contact::load_steps(t.problem, slant::symmetric_newton{qp}, stop(), t.loads(nothing));
  CHECK(none.begin() == none.end());
  CHECK(t.factor.solves == 0);
}

}  // namespace load_steps_test
