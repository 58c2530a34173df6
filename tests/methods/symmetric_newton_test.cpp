// SPDX-License-Identifier: MIT
#include <slant/slant.hpp>

#include <krylov/spd_matrices.hpp>
#include <oracle/dense_newton.hpp>
#include <support/minimise.hpp>
#include <support/testing.hpp>
#include "mixture.hpp"

namespace symmetric_newton_test {

TEST_CASE("the same steps as Newton's method for the natural residual") {
  test::mixture const p(100);
  auto const A = test::spd(p.A);
  auto const set = p.set();
  slant::separable_qp const qp{A, p.b, set};
  VectorXd const x0 = VectorXd::Zero(20);
  slant::symmetric_newton const method{
      qp, {.forcing = {.γ = 1e-14, .exponent = 2, .η_max = 1e-14, .η_first = 1e-14}}};
  auto s = method.start(x0);
  slant::semismooth_newton const generic{slant::natural_residual(A, p.b, set, s.step_length),
                                         slant::direct_solver{}};
  test::check_same_steps(method, s, generic, s.segment.y);
}

TEST_CASE("a mixture of all constraints, from anywhere, with any preconditioner") {
  for (double κ : {1e2, 1e6, 1e10}) {
    CAPTURE(κ);
    test::mixture const p(κ);
    auto const A = test::spd(p.A);
    auto const set = p.set();
    slant::separable_qp const qp{A, p.b, set};
    auto const reference = oracle::solve_dense(p.plain());
    VectorXd const exact = reference.x.cast<double>();
    MatrixXd const inverse = p.A.inverse();
    auto const M = test::spd(MatrixXd((inverse + inverse.transpose()) / 2));
    auto const stop = slant::reduced_gradient_below(1e-11) || slant::at_most(500);
    for (double size : {0.0, 1.0, 1e10}) {
      CAPTURE(size);
      VectorXd const x0 = size * test::random_vector(20, 17);
      auto const check = [&](auto const& method) {
        auto const r = slant::solve(method, x0, stop);
        CHECK(r.converged());
        CHECK((r.x() - exact).norm() <= 1e-11 * κ * exact.norm());
        CHECK(set.contains(r.x()));
      };
      check(slant::symmetric_newton{qp});
      check(slant::symmetric_newton{qp, M});
    }
  }
}

TEST_CASE("what is counted, and one product a Newton step besides those of its inner iterations") {
  test::mixture const p(100);
  auto const A = slant::counted(test::spd(p.A));
  auto const set = p.set();
  slant::separable_qp const qp{A, p.b, set};
  slant::symmetric_newton method{qp};
  auto s = method.start(test::zeros(20));
  CHECK(s.work.setup_applications == 0);  // A knows its diagonal
  // P_Λ(0) is not 0 in this set: its gradient and, in the first step, that of P_Λ(z).
  CHECK(A.applications() == 1);
  for (int k = 0; k < 30 && s.status == slant::status::running; ++k) {
    auto const before = A.applications();
    method.step(s);
    CHECK(A.applications() - before == s.inner_iterations + (k == 0 ? 2 : 1));
    CHECK(A.applications() == s.work.operator_applications);
    CHECK((s.unit * s.r - (p.A * s.x - p.b)).norm() <= 1e-13 * p.b.norm());
    if (s.reduced_gradient_norm <= 1e-10 * s.gradient_scale) break;
  }
  CHECK(s.reduced_gradient_norm <= 1e-10 * s.gradient_scale);
  CHECK(s.descent.count() == 0);
  CHECK_FALSE(s.descent.state().has_value());  // not even its memory
}

/// Ellipses, balls in space, cones, images of discs and ellipses, intervals, points, free ones.
auto all_sets() {
  Eigen::Matrix2d turn;
  turn << 0.8, -0.6, 0.6, 0.8;
  return slant::cartesian(
      slant::power(slant::ellipse(2.0, 0.25), 2), slant::power(slant::ball<3>(0.7), 2),
      slant::power(slant::second_order_cone<3>(0.4), 3),
      slant::shifted(slant::ball<2>(0.5), Vector2d(1.0, -1.0)),
      slant::scaled(3.0, slant::ellipse(0.2, 0.1)), slant::rotated(slant::ellipse(1.0, 0.1), turn),
      slant::intervals(VectorXd{{0.3, 0.0}}), slant::point<2>(Vector2d(0.1, 0.2)),
      slant::half_lines(VectorXd{{0.2, -1.0}}), slant::free_components(2));
}

TEST_CASE("every set: the solution of projected gradients, in a few superlinear steps") {
  auto const set = all_sets();
  auto const n = set.size();
  for (unsigned seed = 1; seed <= 6; ++seed) {
    CAPTURE(seed);
    MatrixXd const M = test::with_spectrum(test::log_spaced(n, 30), seed);
    auto const A = test::spd(M);
    VectorXd const b = 4 * test::random_vector(n, seed + 50);
    slant::separable_qp const qp{A, b, set};
    VectorXd const x0 = 10 * test::random_vector(n, seed + 90);
    auto const exact = test::minimise(slant::kprgp{qp}, x0, 1e-13, 50000);
    REQUIRE(exact.converged());
    auto const r = test::minimise(slant::symmetric_newton{qp}, x0, 1e-13, 60);
    CHECK(r.converged());
    CHECK(r.state.descent.count() == 0);
    CHECK(r.iterations() <= 25);
    CHECK((r.x() - exact.x()).norm() <= 1e-10 * exact.x().norm());
    CHECK(set.contains(r.x()));
    CHECK(r.state.work.operator_applications < exact.state.work.operator_applications);
  }
}

TEST_CASE("warm start: from the solution of a neighbour, and from the solution itself") {
  auto const set = all_sets();
  auto const n = set.size();
  MatrixXd const M = test::with_spectrum(test::log_spaced(n, 30), 3);
  auto const A = test::spd(M);
  VectorXd const b = 4 * test::random_vector(n, 53),
                 neighbour = b + 1e-3 * test::random_vector(n, 7);
  auto const stop = slant::reduced_gradient_below(1e-11) || slant::at_most(60);
  slant::separable_qp const before{A, b, set}, qp{A, neighbour, set};
  auto const first = slant::solve(slant::symmetric_newton{before}, test::zeros(n), stop);
  REQUIRE(first.converged());
  auto const cold = slant::solve(slant::symmetric_newton{qp}, test::zeros(n), stop);
  auto const warm = slant::solve(slant::symmetric_newton{qp}, first.x(), stop);
  REQUIRE(cold.converged());
  REQUIRE(warm.converged());
  CHECK(warm.iterations() <= 4);
  CHECK(warm.iterations() < cold.iterations());
  CHECK(warm.state.work.operator_applications < cold.state.work.operator_applications);
  auto const again = slant::solve(slant::symmetric_newton{qp}, warm.x(), stop);
  CHECK(again.iterations() == 0);
}

TEST_CASE("where Newton's method fails KPRGP takes over, and hands back") {
  test::mixture const p(1e3);
  auto const A = test::spd(p.A);
  auto const set = p.set();
  slant::separable_qp const qp{A, p.b, set};
  VectorXd const exact = oracle::solve_dense(p.plain()).x.cast<double>();
  // A search that is never content: every step with ‖F‖ above 1 % of the last one is a failure.
  slant::symmetric_newton const method{qp, {.sufficient = 0.99, .halvings = 0}};
  auto const r = test::minimise(method, test::zeros(20), 1e-11, 5000);
  CHECK(r.converged());
  CHECK(r.state.descent.count() >= 1);
  CHECK((r.x() - exact).norm() <= 1e-8 * exact.norm());
  // σ_max once, however often it takes over.
  CHECK(r.state.work.setup_applications <= 20);
}

TEST_CASE(
    "no minimum, found at any takeover; in float a search ends where β is no number any more") {
  // Descent without end along (1, 1, 0); the third unknown alone has work to do.
  MatrixXd const M{{1.0, -1.0, 0.0}, {-1.0, 1.0, 0.0}, {0.0, 0.0, 3.0}};
  auto const A = slant::matrix<slant::self_adjoint, slant::positive_semidefinite>(M);
  VectorXd const b{{1.0, 1.0, 2.0}};
  auto const positive = slant::half_lines(3);
  slant::separable_qp const qp{A, b, positive};
  slant::symmetric_newton const method{qp, {.sufficient = 0.999, .halvings = 0}};
  auto const r = test::minimise(method, test::zeros(3), 1e-10, 5000);
  CHECK(r.status == slant::status::unbounded);

  test::mixture const p(1e3);
  Eigen::MatrixXf const single = p.A.cast<float>();
  auto const Af = slant::matrix<slant::self_adjoint, slant::positive_definite>(single);
  Eigen::VectorXf const bf = p.b.cast<float>(), lower = p.lower.cast<float>(),
                        g = p.g.cast<float>();
  auto const set =
      slant::cartesian(slant::half_lines(lower), slant::discs(g), slant::free_components<float>(6));
  slant::symmetric_newton const strict{slant::separable_qp{Af, bf, set}, {.sufficient = 0.95F}};
  auto const rf = test::minimise(strict, Eigen::VectorXf(Eigen::VectorXf::Zero(20)), 1e-3F, 5000);
  CHECK(rf.converged());
}

TEST_CASE("the precision is exhausted: stalled, at the floor") {
  for (double κ : {1e2, 1e8}) {
    CAPTURE(κ);
    test::mixture const p(κ);
    auto const A = test::spd(p.A);
    auto const set = p.set();
    slant::separable_qp const qp{A, p.b, set};
    auto const r = test::minimise(slant::symmetric_newton{qp}, test::zeros(20), 0.0, 3000);
    CHECK((r.status == slant::status::stalled || r.status == slant::status::converged));
    CHECK(r.iterations() <= 1000);
    // 100 ε times what the entries of A x − b are rounded against.
    CHECK(r.state.reduced_gradient_norm <=
          100 * std::numeric_limits<double>::epsilon() * (p.b.norm() + p.A.norm() * r.x().norm()));
    CHECK(std::string(r.reason).size() > 10);
  }
}

TEST_CASE("no minimum: unbounded, with the direction") {
  // x₁ + x₂ costs nothing and its sum is wanted as large as possible.
  MatrixXd const M{{1.0, -1.0}, {-1.0, 1.0}};
  auto const A = slant::matrix<slant::self_adjoint, slant::positive_semidefinite>(M);
  VectorXd const b = VectorXd::Ones(2);
  auto const set = slant::half_lines(2);
  slant::separable_qp const qp{A, b, set};
  auto const r = test::minimise(slant::symmetric_newton{qp}, test::zeros(2), 1e-10, 1000);
  CHECK(r.status == slant::status::unbounded);
  REQUIRE(r.state.descent.state().has_value());
  VectorXd const d = -r.state.descent.state()->directions.p;
  CHECK((M * d).norm() <= 1e-12 * d.norm());
  CHECK(b.dot(d) > 0);
  CHECK(d.minCoeff() >= 0);
}

TEST_CASE("a matrix that breaks its promise is no convergence") {
  MatrixXd const M = VectorXd{{1.0, -1.0, 1.0}}.asDiagonal();
  auto const A = slant::matrix<slant::self_adjoint, slant::positive_definite>(M);
  VectorXd const b{{1.0, 1.0, 1.0}}, none;
  auto const free = test::mixed_set(none, none, none, 3);
  slant::separable_qp const qp{A, b, free};
  auto const message = test::complaint([&] {
    auto const r = test::minimise(slant::symmetric_newton{qp, {.step_length = 0.3}}, test::zeros(3),
                                  1e-10, 1000);
    CHECK_FALSE(r.converged());
    CHECK(r.status != slant::status::running);
  });
  CHECK((message == "nothing thrown" || message.find("semidefinite") != std::string::npos));
}

TEST_CASE("slip bounds of zero and infinity, discs that are hardly touched") {
  MatrixXd const M = test::with_spectrum(test::log_spaced(8, 50), 4);
  auto const A = test::spd(M);
  VectorXd const b = 2 * test::random_vector(8, 9);
  VectorXd const free = M.ldlt().solve(b);
  VectorXd const zero = VectorXd::Zero(8), nothing;
  auto const solve_with = [&](VectorXd const& g) {
    auto const set = test::mixed_set(nothing, nothing, g, 0);
    slant::separable_qp const qp{A, b, set};
    return test::minimise(slant::symmetric_newton{qp}, zero, 1e-12, 100);
  };
  auto const none = solve_with(VectorXd::Zero(4));
  CHECK(none.converged());
  CHECK(none.x() == zero);
  auto const all = solve_with(VectorXd::Constant(4, infinity));
  CHECK(all.converged());
  CHECK((all.x() - free).norm() <= 1e-10 * free.norm());
  // The free solution lies exactly on the boundary of every disc: weak contact.
  VectorXd g(4);
  for (int i = 0; i < 4; ++i) g(i) = free.segment<2>(2 * i).norm();
  auto const weak = solve_with(g);
  CHECK(weak.converged());
  CHECK((weak.x() - free).norm() <= 1e-10 * free.norm());
}

TEST_CASE("a preconditioner of another size is named, options are looked at") {
  VectorXd const one = VectorXd::Ones(2);
  auto const A = slant::diagonal<slant::positive_definite>(one);
  slant::separable_qp const qp{A, one, slant::half_lines(2)};
  auto const wrong = slant::diagonal<slant::positive_definite>(VectorXd(VectorXd::Ones(3)));
  CHECK(test::complaint([&] {
          slant::symmetric_newton const m{qp, wrong};
        }) == "rows of the preconditioner: got 3, expected size 2");
  CHECK_THROWS_AS((slant::symmetric_newton{qp, {.sufficient = 1.0}}), slant::bad_input);
}

}  // namespace symmetric_newton_test
