// SPDX-License-Identifier: MIT
#include <slant/contact/dual.hpp>
#include <slant/contact/optimality.hpp>
#include <slant/factorizations/ldlt.hpp>
#include <slant/iteration/solve.hpp>
#include <slant/methods/kprgp.hpp>

#include <doctest/doctest.h>

#include <cmath>
#include <contact/scenes.hpp>
#include <support/effort.hpp>

namespace units_test {

namespace contact = slant::contact;
using Eigen::VectorXd;

// K in s, f in t: displacements and gaps in t/s, forces and slip bounds in t.
TEST_CASE("units change neither status nor iterations nor errors") {
  auto const scene =
      fem::make_steel_brick({.k = test::effort(2, 1), .load = fem::brick_load::lift});
  auto plain = test::contact_data(scene);
  plain.d.array() += 1e-6;
  VectorXd const exact = test::reference(scene.K, plain).u;
  struct result {
    slant::status status;
    slant::index iterations;
    VectorXd λ;
    VectorXd u;
    double residual;
    double error;
  };
  auto const solve_in = [&](double s, double t) {
    Eigen::SparseMatrix<double> const K = s * scene.K;
    auto c = plain;
    c.f *= t;
    c.g *= t;
    c.d *= t / s;
    contact::dual const dual(contact::friction_disc{}, slant::ldlt(K), c);
    auto const qp = dual.qp();
    auto const r = slant::solve(slant::kprgp{qp}, dual.zero(),
                                slant::reduced_gradient_below(1e-6) || slant::at_most(20000));
    VectorXd const u = dual.displacement(r.x());
    double const residual = contact::check_optimality(K, c, u, r.x()).residual();
    double const error = (u * (s / t) - exact).norm() / exact.norm();
    return result{r.status, r.iterations(), r.x() / t, u * (s / t), residual, error};
  };
  auto const reference = solve_in(1, 1);
  CHECK(reference.status == slant::status::converged);
  CHECK(reference.error <= 1e-4);
  for (int const s : {-40, 0, 40}) {
    for (int const t : {-40, 0, 40}) {
      CAPTURE(s);
      CAPTURE(t);
      auto const scaled = solve_in(std::ldexp(1.0, s), std::ldexp(1.0, t));
      CHECK(scaled.status == reference.status);
      CHECK(scaled.iterations == reference.iterations);
      CHECK(scaled.λ == reference.λ);
      CHECK(scaled.u == reference.u);
      CHECK(scaled.residual == reference.residual);
    }
  }
  for (double const s : {1e-12, 1e-5, 1e12}) {
    for (double const t : {1e-12, 1e3, 1e12}) {
      CAPTURE(s);
      CAPTURE(t);
      auto const scaled = solve_in(s, t);
      CHECK(scaled.status == reference.status);
      CHECK(scaled.iterations == reference.iterations);
      CHECK(scaled.error == doctest::Approx(reference.error).epsilon(1e-3));
      CHECK(scaled.residual == doctest::Approx(reference.residual).epsilon(1e-6));
    }
  }
}

TEST_CASE("friction law and data must fit") {
  auto const scene = fem::make_steel_brick({.k = 1});
  slant::ldlt const factor(scene.K);
  using slant::bad_input;
  CHECK_THROWS_WITH_AS(contact::dual(contact::frictionless{}, factor, test::contact_data(scene)),
                       "tangents per contact node: got 2, expected 0 for this friction law",
                       bad_input);
  auto c = test::contact_data(scene);
  c.f.conservativeResize(c.f.size() - 1);
  CHECK_THROWS_AS(contact::dual(contact::friction_disc{}, factor, c), bad_input);
  contact::dual const dual(contact::friction_disc{}, factor, test::contact_data(scene));
  CHECK_THROWS_AS(static_cast<void>(dual.displacement(VectorXd::Zero(1))), bad_input);
}

}  // namespace units_test
