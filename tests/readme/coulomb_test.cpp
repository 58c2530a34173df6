// SPDX-License-Identifier: MIT
#include <slant/contact/certified_coulomb.hpp>

#include <doctest/doctest.h>

#include <fem/steel_brick.hpp>

TEST_CASE("Coulomb friction of a body") {
  auto const brick = fem::make_steel_brick({.k = 1, .load = fem::brick_load::pull});
  auto const& K = brick.K;
  slant::contact::data<double> const data{brick.N, brick.T, brick.f, brick.d, brick.g};
  Eigen::VectorXd const F = Eigen::VectorXd::Constant(data.nodes(), 0.3);

  // F: one coefficient for each contact node; data.g is not read.
  auto const r = slant::contact::certified_coulomb(slant::contact::friction_disc{}, K, data, F);
  if (!r.converged()) FAIL(r.reason);  // else r.u, r.λ, r.error

  CHECK(r.error.frozen.relative() <= 1e-8);
  CHECK(r.u.size() == K.rows());
}
