// SPDX-License-Identifier: MIT
#include "schur_contact_scenes.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <string>
#include <vector>

namespace schur_contact_scales_test {

using namespace schur_contact_scenes;

TEST_CASE("the same in other units, bit for bit in the steps") {
  small_problem p{both(chain(4), chain(4)), VectorXd(8), MatrixXd::Zero(3, 8),
                  VectorXd{{0.5, 1, 0}}};
  p.f << 0, 1, 0, 2, 0, 0, -1, 1;
  p.B(0, 3) = 1;
  p.B(0, 4) = -1;
  p.B(1, 7) = 1;
  p.B(2, 0) = -1;
  std::vector<slant::index> steps;
  VectorXd first;
  for (int const e : {0, 480, -480}) {
    small_problem q = p;
    double const force = std::ldexp(1.0, e);
    q.K *= std::ldexp(1.0, e / 2);
    q.f *= force;
    q.c *= std::ldexp(1.0, e - e / 2);
    solve(q, {}, [&](body_list const&, report_type const& r) {
      REQUIRE(r.converged());
      steps.push_back(r.iterations());
      VectorXd const u = r.x() * std::ldexp(1.0, e / 2 - e);
      if (first.size() == 0) first = u;
      CHECK(u == first);
    });
  }
  CHECK(steps[1] == steps[0]);
  CHECK(steps[2] == steps[0]);
}

TEST_CASE("rows of any size: the same displacements, multipliers in the units of the rows") {
  small_problem const p{
      both(chain(4), chain(4)), VectorXd{{0, 1, 0, 2, 0, 0, -1, 1}},
      MatrixXd{{0, 0, 0, 1, -1, 0, 0, 0}, {0, 0, 0, 0, 0, 0, 0, 1}, {-1, 0, 0, 0, 0, 0, 0, 0}},
      VectorXd{{0.5, 1, 0}}};
  VectorXd u, λ;
  solve(p, {}, [&](body_list const&, report_type const& r) {
    u = r.x();
    λ = r.state.multipliers();
  });
  REQUIRE(λ.maxCoeff() > 0);
  for (auto const& exponents : {std::array{500, 500, 500}, std::array{-500, -500, -500},
                                std::array{-560, 530, 3}, std::array{900, -900, 0}}) {
    small_problem q = p;
    VectorXd forces = λ;
    for (int i = 0; i < 3; ++i) {
      double const unit = std::ldexp(1.0, exponents[std::size_t(i)]);
      q.B.row(i) *= unit;
      q.c[i] *= unit;
      forces[i] /= unit;
    }
    solve(q, {}, [&](body_list const&, report_type const& r) {
      REQUIRE(r.converged());
      CHECK(r.x() == u);
      CHECK(r.state.multipliers() == forces);
    });
  }
}

TEST_CASE("a start far away is forgotten") {
  small_problem const p{chain(3) + MatrixXd::Identity(3, 3), VectorXd{{3, 0, 1}},
                        MatrixXd{{1, 0, 0}, {0, 0, 1}}, VectorXd{{0.5, 0.3}}};
  auto const reference = oracle::minimum_over_polyhedron(p.K, p.f, p.B, p.c);
  body_list const bodies = body_list{p};
  auto const qp = bodies.qp();
  stiffness const K{p.K};
  for (double const far : {0.0, 1e8, 1e12, 1e14, 1e16, 1e40}) {
    for (double const side : {-1.0, 1.0}) {
      CAPTURE(side * far);
      auto const r = minimise(problem(K, qp.f(), qp.rows(), qp.projection()),
                              VectorXd::Constant(3, side * far));
      CHECK(r.converged());
      CHECK((r.x() - reference->u).norm() <= 1e-12);
      CHECK((p.B * r.x() - p.c).maxCoeff() <= 1e-14);
    }
  }
}

}  // namespace schur_contact_scales_test
