// SPDX-License-Identifier: MIT
#include <fem/contact_field.hpp>
#include <fem/steel_brick.hpp>
#include <fem/two_bricks.hpp>
#include <fem/two_plates.hpp>
#include <oracle/dense_contact_reference.hpp>
#include <support/testing.hpp>

namespace contact_field_test {

TEST_CASE("the field of a solution has its stresses and states") {
  auto const scene = fem::make_steel_brick({.k = 2, .load = fem::brick_load::lift});
  auto const solution =
      oracle::solve_contact({scene.K, scene.N, scene.T, scene.f, scene.d, scene.g});
  auto const field =
      fem::make_contact_field(scene, solution.u, solution.normal, solution.tangential);
  auto const counts = oracle::count_active(solution.dual, solution.report.x);
  CHECK(field.count(fem::contact_state::open) == counts.intervals);
  CHECK(std::count(field.at_slip_bound.begin(), field.at_slip_bound.end(), true) == counts.circles);
  CHECK(field.count(fem::contact_state::open) + field.count(fem::contact_state::stick) +
            field.count(fem::contact_state::slip) ==
        18);
  for (Eigen::Index i = 0; i < field.size(); ++i) {
    auto const at = static_cast<std::size_t>(i);
    CHECK(field.slip_bound[i] == doctest::Approx(0.6));
    CHECK(field.normal[i] >= 0);
    CHECK((field.normal[i] == 0) == (field.state[at] == fem::contact_state::open));
    bool const largest = field.friction.col(i).norm() > 0.6 * (1 - 1e-12);
    CHECK(largest == field.at_slip_bound[at]);
  }

  // The contact forces and the load are in equilibrium with the reaction at the fixed end; the
  // vertical sum of stresses times areas is the sum of the multipliers.
  CHECK(field.normal.dot(scene.contact_weights) == doctest::Approx(solution.normal.sum()));
  // Friction acts against the traction that drags the brick to the right.
  CHECK(field.friction.row(0).dot(scene.contact_weights) < 0);
}

/// The field of the reference solution.
template <int D>
fem::contact_field<D> solved(fem::contact_scene<D> const& s) {
  auto const r = oracle::solve_contact({s.K, s.N, s.T, s.f, s.d, s.g});
  CHECK(r.violations.largest() < 1e-14);
  return fem::make_contact_field(s, r.u, r.normal, r.tangential);
}

TEST_CASE("the states do not depend on units") {
  auto const one = fem::make_steel_brick({.k = 1, .load = fem::brick_load::lift});
  auto const other = fem::make_steel_brick(
      {.k = 1, .load = fem::brick_load::lift, .E = 2.119e5 * 0x1p-40, .load_factor = 0x1p30});
  CHECK((solved(one).state == solved(other).state));
}

TEST_CASE("two plates [K Ex 5]") {
  auto const field = solved(fem::make_two_plates(4));
  CHECK(field.slip_bound.isApprox(VectorXd::Constant(12, 1.7e7), 1e-14));
  // Two cantilevers bent down: the lower fibres of the upper one are pressed together and slide to
  // the left over the upper fibres of the lower one, so friction on the upper one points right. The
  // free end of the upper one is torn upwards.
  CHECK(field.state.back() == fem::contact_state::open);
  CHECK(field.count(fem::contact_state::slip) == 11);
  CHECK(field.friction.head(11).isApprox(Eigen::RowVectorXd::Constant(11, 1.7e7), 1e-12));
}

TEST_CASE("two bricks [K Ex 6]") {
  auto const field = solved(fem::make_two_bricks(4));
  CHECK(field.size() == 16);
  // The free end of the lower one is drawn down, away from the upper one.
  for (std::size_t i = 0; i < 16; ++i)
    if (field.patches[i].centre[0] > 600) CHECK(field.state[i] == fem::contact_state::open);
  CHECK(field.count(fem::contact_state::open) == 12);
}

}  // namespace contact_field_test
