// SPDX-License-Identifier: MIT
#include <slant/krylov/krylov.hpp>
#include <slant/operators/diagonal.hpp>
#include <slant/sets/sets.hpp>

#include <support/testing.hpp>

namespace feasible_step_test {

using end = slant::feasible_step_end;

/// What the parts need of a state; r = A x − b in units of 2, A a diagonal.
struct state {
  VectorXd d, x, r, φ, trial = VectorXd::Zero(2);
  slant::conjugate_directions<VectorXd> directions{trial};
  double unit = 2;
  slant::workspace_t<slant::diagonal_operator<VectorXd>, VectorXd> a_workspace{};
  struct {
    slant::index operator_applications = 0;
  } work;
  slant::index since_refresh = 0;

  state(VectorXd diagonal, VectorXd start, VectorXd const& b)
      : d(std::move(diagonal)), x(std::move(start)), r((d.cwiseProduct(x) - b) / 2), φ(r) {}
};

/// The step along −r, and the state after it.
template <class Set>
slant::feasible_step<double> step(state& s, Set const& set, double noise = 0) {
  slant::next_direction(slant::diagonal(s.d), s);
  CHECK(s.work.operator_applications == 1);
  return slant::step_within(set, s, noise);
}

TEST_CASE("to the minimum, if that is inside: x and r move, without a second product") {
  VectorXd const b{{2.0, 2.0}};
  state s(VectorXd{{1.0, 1.0}}, VectorXd::Zero(2), b);
  CHECK(step(s, slant::half_lines(2)).end == end::minimum);
  CHECK(s.x == b);
  CHECK(s.r == VectorXd::Zero(2));
  CHECK(s.since_refresh == 1);
}

TEST_CASE("no further than the boundary, in two moves") {
  VectorXd const b{{2.0, -6.0}}, x0{{1.0, 1.0}};
  state s(VectorXd{{1.0, 1.0}}, x0, b);
  auto const set = slant::half_lines(2);
  auto const found = step(s, set);
  CHECK(found.end == end::boundary);
  CHECK_FALSE(found.flat);
  CHECK(s.x == x0);  // nothing has happened yet
  slant::half_step_within(set, s, found);
  CHECK(s.x(1) == 0.0);
  CHECK(s.x(0) == doctest::Approx(1 + 1.0 / 7));
  CHECK((2 * s.r - (s.x - b)).norm() <= 1e-15);
}

TEST_CASE("a half step from afar ends in the set, whatever it rounds") {
  auto const set = slant::half_lines(VectorXd{{-1e9, 0.1}});
  int outside = 0;
  for (int k = 0; k < 100; ++k) {
    CAPTURE(k);
    state s(VectorXd{{1.0, 1.0}}, VectorXd{{0.0, 1000 + k / 7.0}}, VectorXd{{2.0, -300 - k / 3.0}});
    auto const found = step(s, set);
    REQUIRE(found.end == end::boundary);
    outside += !set.contains(VectorXd(s.x + found.length * s.trial));
    slant::half_step_within(set, s, found);
    CHECK(set.contains(s.x));
  }
  CHECK(outside > 5);
}

TEST_CASE("flat directions: to the boundary if there is one") {
  VectorXd const b{{0.0, 1.0}};
  state bounded(VectorXd{{1.0, 0.0}}, VectorXd::Zero(2), b);
  auto const box = slant::intervals(VectorXd{{3.0, 3.0}});
  auto const found = step(bounded, box);
  CHECK(found.end == end::boundary);
  CHECK(found.flat);
  slant::half_step_within(box, bounded, found);
  CHECK(bounded.x == VectorXd{{0.0, 3.0}});
  state endless(VectorXd{{1.0, 0.0}}, VectorXd::Zero(2), b);
  CHECK(step(endless, slant::half_lines(2)).end == end::endless);
  // A curvature below the noise counts as flat.
  state nearly(VectorXd{{1.0, 1e-17}}, VectorXd::Zero(2), b);
  CHECK(step(nearly, slant::half_lines(2), 1e-16).end == end::endless);
}

TEST_CASE("negative curvature and NaN are no steps") {
  VectorXd const b{{1.0, 1.0}};
  state negative(VectorXd{{1.0, -2.0}}, VectorXd::Zero(2), b);
  CHECK(step(negative, slant::half_lines(2)).end == end::broken);
  CHECK(negative.x == VectorXd::Zero(2));
  state nan(VectorXd{{1.0, 1.0}}, VectorXd::Zero(2), b);
  nan.r(1) = nan.φ(1) = std::numeric_limits<double>::quiet_NaN();
  CHECK(step(nan, slant::half_lines(2)).end == end::broken);
  CHECK(nan.x == VectorXd::Zero(2));
}

}  // namespace feasible_step_test
