// SPDX-License-Identifier: MIT
//
// IMSSN and GIMSSN where discs slide: each block outside 𝒜 moves by one projected gradient step a
// Newton step, so the last digits take hundreds of them, as with KPRGP.
#include <slant/contact/optimality.hpp>
#include <slant/contact/tresca.hpp>
#include <slant/factorizations/factorize.hpp>
#include <slant/iteration/solve.hpp>
#include <slant/methods/gimssn.hpp>
#include <slant/methods/imssn.hpp>

#include <doctest/doctest.h>

#include <contact/scenes.hpp>
#include <string>
#include <support/effort.hpp>

namespace modified_newton_brick_test {

TEST_CASE("a brick pressed down: the energy error is small, the price is known") {
  int const k = test::effort(3, 2);
  auto const scene = fem::make_steel_brick({.k = k, .load = fem::brick_load::press});
  auto const data = test::contact_data(scene);
  auto const reference = test::reference(scene.K, data);
  slant::contact::dual const dual(slant::contact::friction_disc{}, slant::factorize(scene.K), data);
  auto const qp = dual.qp();
  auto const check = [&](std::string const& name, auto const& method, slant::index products) {
    CAPTURE(name);
    auto const r = slant::solve(method, dual.zero(),
                                slant::reduced_gradient_below(1e-7) || slant::at_most(5000));
    REQUIRE(r.converged());
    auto const u = dual.displacement(r.x());
    CHECK(oracle::energy_error(scene.K, u, reference.u) <= 3e-5);
    CHECK(slant::contact::check_optimality(scene.K, data, u, r.x()).residual() <= 1e-5);
    CHECK(r.state.work.operator_applications <= products);
    CHECK(r.iterations() >= 50);  // no Newton method, on discs
  };
  check("imssn", slant::imssn{qp}, 6000);
  check("gimssn", slant::gimssn{qp}, 2500);
}

}  // namespace modified_newton_brick_test
