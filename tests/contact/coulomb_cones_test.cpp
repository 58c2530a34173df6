// SPDX-License-Identifier: MIT
#include <slant/contact/coulomb/coulomb_families.hpp>

#include "coulomb_scenes.hpp"

#include <slant/contact/coulomb/coulomb.hpp>
#include <slant/contact/preconditioners.hpp>
#include <slant/factorizations/ldlt.hpp>
#include <slant/iteration/solve.hpp>

#include <fem/two_plates.hpp>

#include <doctest/doctest.h>

namespace coulomb_cones_test {

using Eigen::VectorXd;
namespace contact = slant::contact;

constexpr double tolerance = 1e-11;

template <class Family, class M>
auto solve(Family& family, M const& m) {
  return slant::solve(contact::coulomb(family, m, {.goal = tolerance}), family.zero(),
                      slant::reduced_gradient_below(tolerance) || slant::at_most(200));
}

/// Both families on a scene, against de Saxcé's natural map and each other.
template <class Friction, int D>
void compare(fem::contact_scene<D> const& s, double F) {
  contact::data<double> const c{s.N, s.T, s.f, s.d, s.g};
  auto const factor = slant::ldlt(s.K);
  contact::dual problem(Friction{}, factor, c);
  VectorXd const μ = VectorXd::Constant(c.d.size(), F);
  contact::coulomb_cones cones(problem, μ);
  auto const by_cones = solve(cones, contact::lumped_preconditioner(s.K, cones.constraints()));
  REQUIRE(by_cones.converged());
  VectorXd const λ = cones.by_directions(by_cones.x());
  CHECK(cones.by_contacts(λ) == by_cones.x());
  CHECK(test::natural_map(test::dense_dual(s.K, c), μ, λ) <= 1e-9);

  contact::coulomb_radii radii(problem, contact::coefficients(μ));
  auto const by_radii = solve(radii, contact::lumped_preconditioner(s.K, problem.constraints()));
  REQUIRE(by_radii.converged());
  CHECK((by_radii.x() - λ).norm() <= 1e-8 * λ.norm());
}

TEST_CASE("both families find the same forces: the brick") {
  for (auto const load : fem::brick_loads) {
    CAPTURE(fem::name_of(load));
    compare<contact::friction_disc>(fem::make_steel_brick({.k = 2, .load = load}), 0.3);
  }
}

TEST_CASE("both families find the same forces: plates in the plane, little and much friction") {
  for (double const F : {0.0, 0.3, 1.0}) {
    CAPTURE(F);
    compare<contact::friction_line>(fem::make_two_plates(4), F);
  }
}

}  // namespace coulomb_cones_test
