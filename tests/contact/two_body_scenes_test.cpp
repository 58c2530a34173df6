// SPDX-License-Identifier: MIT
//
// Two bodies in the plane and in space, solved by a method of the library, against the dense
// reference, which shares no factorisation, set or method with it.
#include <slant/contact/dual.hpp>
#include <slant/contact/optimality.hpp>
#include <slant/factorizations/ldlt.hpp>
#include <slant/iteration/solve.hpp>
#include <slant/methods/kprgp.hpp>

#include <doctest/doctest.h>

#include <fem/contact_field.hpp>
#include <fem/two_bricks.hpp>
#include <fem/two_plates.hpp>
#include <oracle/dense_contact_reference.hpp>

namespace two_body_scenes_test {

/// Solves and compares; the field of the solution.
template <class Friction, int D>
fem::contact_field<D> check_scene(Friction friction, fem::contact_scene<D> const& scene) {
  auto const reference =
      oracle::solve_contact({scene.K, scene.N, scene.T, scene.f, scene.d, scene.g});
  CHECK(reference.violations.largest() < 1e-14);
  slant::contact::data<double> const data{scene.N, scene.T, scene.f, scene.d, scene.g};
  slant::contact::dual const dual(friction, slant::ldlt(scene.K), data);
  auto const r = slant::solve(slant::kprgp{dual.qp()}, dual.zero(),
                              slant::reduced_gradient_below(1e-9) || slant::at_most(20000));
  CHECK(r.converged());
  auto const u = dual.displacement(r.x());
  CHECK(oracle::energy_error(scene.K, u, reference.u) <= 1e-6);
  CHECK(slant::contact::check_optimality(scene.K, data, u, r.x()).residual() <= 1e-6);
  Eigen::Index const m = scene.contact_count();
  return fem::make_contact_field(scene, u, r.x().head(m).eval(), r.x().tail((D - 1) * m).eval());
}

TEST_CASE("two plates [K Ex 5]") {
  auto const scene = fem::make_two_plates(4);
  auto const field = check_scene(slant::contact::friction_line{}, scene);
  CHECK(field.slip_bound.isApprox(Eigen::VectorXd::Constant(12, 1.7e7), 1e-14));
  // Two cantilevers bent down: the lower fibres of the upper one are pressed together and slide to
  // the left over the upper fibres of the lower one, so friction on the upper one points right. The
  // free end of the upper one is torn upwards.
  CHECK(field.state.back() == fem::contact_state::open);
  CHECK(field.count(fem::contact_state::slip) == 11);
  CHECK(field.friction.head(11).isApprox(Eigen::RowVectorXd::Constant(11, 1.7e7), 1e-12));
}

TEST_CASE("two bricks [K Ex 6]") {
  auto const field = check_scene(slant::contact::friction_disc{}, fem::make_two_bricks(4));
  CHECK(field.size() == 16);
  // The free end of the lower one is drawn down, away from the upper one.
  for (std::size_t i = 0; i < 16; ++i)
    if (field.patches[i].centre[0] > 600) CHECK(field.state[i] == fem::contact_state::open);
  CHECK(field.count(fem::contact_state::open) == 12);
}

}  // namespace two_body_scenes_test
