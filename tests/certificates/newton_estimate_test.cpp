// SPDX-License-Identifier: MIT
#include <slant/slant.hpp>

#include <methods/sliding_discs.hpp>
#include <support/testing.hpp>
#include "made_programs.hpp"

namespace newton_estimate_test {

/// What the estimate says of x with ‖rest‖_{A⁻¹} from the inverse, for a gradient that is off by d.
double estimate(test::made_program const& p, VectorXd const& x, VectorXd const& d, double step,
                slant::index most, bool trusts_iterations = true) {
  auto const qp = test::program(p);
  VectorXd const inverse = p.A.diagonal().cwiseInverse();
  auto const M = slant::diagonal(inverse);
  slant::newton_estimate newton(qp, M);
  auto of_a = slant::workspace(qp.a(), x);
  VectorXd const gradient = p.A * x - p.b + d;
  double const ρ = step / p.A.diagonal().mean();
  double const distance = newton(
      {x, gradient, inverse, ρ, most, {}, trusts_iterations}, M, of_a,
      [&](VectorXd const& rest) { return std::sqrt(std::fmax(0.0, rest.dot(p.inverse * rest))); });
  CHECK(newton.applications() <= most + 1);
  return distance;
}

/// Near the solution, on its face: three steps of the projected gradient method.
VectorXd beside_solution(test::made_program const& p, double δ, std::mt19937& random) {
  std::normal_distribution<double> gauss;
  auto const qp = test::program(p);
  VectorXd x = p.solution;
  for (double& entry : x) entry += δ * gauss(random);
  for (int k = 0; k < 3; ++k) x = slant::project(qp.set(), VectorXd(x - p.A * x + p.b));
  return x;
}

TEST_CASE("newton_estimate: next to the solution the error itself, whatever the step") {
  std::mt19937 random(5);
  int sharp = 0, all = 0;
  for (int run = 0; run < 40; ++run) {
    auto const p = test::make_program(2 + run % 4, run % 5, random);
    VectorXd const x = beside_solution(p, 1e-6, random);
    double const error = test::energy_norm(p.A, x - p.solution);
    if (!(error > 1000 * p.lost)) continue;
    for (double const step : {1.0, 1e-3}) {
      double const claimed = estimate(p, x, VectorXd::Zero(x.size()), step, 40);
      CHECK(claimed >= 0.6 * error);
      ++all;
      sharp += claimed <= 1.5 * error ? 1 : 0;
    }
  }
  CHECK(all > 40);
  CHECK(sharp >= 0.9 * all);
}

TEST_CASE("newton_estimate: far from the solution, and with few iterations, never far too small") {
  std::mt19937 random(8);
  for (int run = 0; run < 60; ++run) {
    auto const p = test::make_program(2 + run % 4, run % 6, random);
    for (double const δ : {1.0, 1e-2}) {
      VectorXd const x = beside_solution(p, δ, random);
      double const error = test::energy_norm(p.A, x - p.solution);
      CHECK(estimate(p, x, VectorXd::Zero(x.size()), 1, 40) >= 0.5 * error - p.lost);
      CHECK(estimate(p, x, VectorXd::Zero(x.size()), 1, 8) >= 0.3 * error - p.lost);
    }
  }
}

TEST_CASE("newton_estimate: where iterations are not trusted, a bound however few there are") {
  std::mt19937 random(12);
  int close = 0, all = 0;
  for (int run = 0; run < 60; ++run) {
    auto const p = test::make_program(2 + run % 4, run % 8, random);
    for (double const δ : {1e-2, 1e-6}) {
      VectorXd const x = beside_solution(p, δ, random), exact = VectorXd::Zero(x.size());
      double const error = test::energy_norm(p.A, x - p.solution);
      for (slant::index const most : {1, 5, 40}) {
        double const claimed = estimate(p, x, exact, 1e-3, most, false);
        // Infinite after so few steps that nothing is known.
        CHECK(claimed >= error * (1 - 1e-6) - 2 * p.lost);
        if (most < 40 || δ > 1e-3 || !(error > 1000 * p.lost)) continue;
        ++all;
        close += claimed <= 2 * error ? 1 : 0;
      }
    }
  }
  CHECK(all > 20);
  CHECK(close >= 0.7 * all);
}

TEST_CASE("newton_estimate: a gradient off by d counts at most ‖d‖ in the norm of A⁻¹") {
  std::mt19937 random(9);
  std::normal_distribution<double> gauss;
  for (int run = 0; run < 20; ++run) {
    auto const p = test::make_program(3, 2, random);
    VectorXd const x = beside_solution(p, 1e-4, random);
    VectorXd d(x.size());
    for (double& entry : d) entry = 1e-6 * gauss(random);
    double const size = std::sqrt(d.dot(p.inverse * d));
    double const error = test::energy_norm(p.A, x - p.solution);
    CHECK(estimate(p, x, d, 1, 40) + size >= 0.9 * error);
  }
}

using test::dense_face;
using test::sliding_discs;

TEST_CASE("the step, its image and energies, beside dense linear algebra") {
  sliding_discs const p;
  auto const set = slant::discs(p.g);
  auto const A = slant::counted(test::spd(p.A));
  auto wa = slant::workspace(A, p.r);
  slant::curved_face<> face(set);
  face.assign(set, p.z, 1.0 / p.ρ);
  REQUIRE(face.curved_count() >= 2);
  dense_face const dense(p, face);
  VectorXd const exact = -test::least_squares(dense.H, dense.keep * p.r);
  auto const check = [&](auto const& m, double s) {
    slant::face_correction<VectorXd, std::remove_cvref_t<decltype(m)>> c(p.r, m);
    auto const before = A.applications();
    slant::testing::allocation_guard guard;
    auto const steps = c.compute(A, wa, m, p.r, face, p.ρ, s, 50, std::nullopt);
    auto const allocations = guard.count();
    CHECK(allocations == 0);
    CHECK(c.found);
    CHECK(A.applications() - before == steps);
    VectorXd const e = c.t - exact;
    double const whole = exact.dot(dense.H * exact), lost = e.dot(dense.H * e);
    CHECK(lost <= 0.02 * whole);
    CHECK(c.missing * c.missing <= 0.02 * whole);
    CHECK((c.image - p.A * c.t).norm() <= 1e-12 * c.image.norm());
    CHECK(c.energy == doctest::Approx(std::sqrt(c.t.dot(p.A * c.t))));
    CHECK(c.energy * c.energy + c.bend * c.bend == doctest::Approx(c.t.dot(dense.H * c.t)));
    CHECK((c.remainder - dense.keep * p.r - dense.H * c.t).norm() <= 1e-12 * p.r.norm());
    return steps;
  };
  auto const plain = check(slant::identity(12), 1.0);
  MatrixXd const inverse = p.A.inverse();
  auto const preconditioned =
      check(test::spd(MatrixXd((inverse + inverse.transpose()) / 2)), inverse.trace() / 12);
  CHECK(preconditioned <= plain + 1);
}

TEST_CASE("nothing to do; a face without curvature; what rounding leaves of the gradient there") {
  VectorXd const inside = VectorXd::Zero(4), g{{1.0, 1.0, 0.0, 0.0}};
  auto const set = slant::half_lines(VectorXd(VectorXd::Constant(4, -1.0)));
  slant::curved_face<> face(set);
  face.assign(set, inside, 1.0);
  MatrixXd a = MatrixXd::Identity(4, 4);
  a(3, 3) = 0;
  auto const A = test::spd(a);
  auto wa = slant::workspace(A, g);
  auto const I = slant::identity(4);
  slant::face_correction<VectorXd, slant::identity_operator> c(g, I);
  slant::gradient_size<double> const sizes{1.0, 1.0};
  CHECK(c.compute(A, wa, I, inside, face, 1.0, 1.0, 9, sizes) == 0);
  CHECK(c.found);
  CHECK(c.energy == 0);
  c.compute(A, wa, I, g, face, 1.0, 1.0, 9, sizes);
  CHECK(c.found);
  CHECK(c.energy == doctest::Approx(std::sqrt(2.0)));
  VectorXd const hidden{{1.0, 1.0, 0.0, 1e-3}}, noise{{1.0, 1.0, 0.0, 1e-16}};
  c.compute(A, wa, I, hidden, face, 1.0, 1.0, 9, sizes);
  CHECK_FALSE(c.found);
  c.compute(A, wa, I, noise, face, 1.0, 1.0, 9, sizes);
  CHECK(c.found);
  CHECK(c.energy == doctest::Approx(std::sqrt(2.0)));
}

}  // namespace newton_estimate_test
