// SPDX-License-Identifier: MIT
#include <slant/iteration/solve.hpp>
#include <slant/krylov/cg.hpp>
#include <slant/krylov/conjugate_directions.hpp>
#include <slant/operators/operators.hpp>

#include <support/testing.hpp>
#include "spd_matrices.hpp"

namespace cg_test {

TEST_CASE("cg agrees with a dense solve") {
  for (double κ : {1.0, 1e2, 1e6}) {
    auto const M = test::with_spectrum(test::log_spaced(40, κ));
    VectorXd const x = test::random_vector(40), b = M * x;
    auto const A = test::spd(M);
    auto const r = slant::solve(slant::cg{A, b}, test::zeros(40),
                                slant::residual_below(1e-13) || slant::at_most(2000));
    REQUIRE(r.converged());
    CHECK((r.x() - x).norm() <= 1e-12 * κ * x.norm());
    CHECK((M * r.x() - b).norm() <= 1e-12 * b.norm());
  }
}

TEST_CASE("cg ends after as many steps as there are distinct eigenvalues") {
  VectorXd spectrum(30);
  for (int i = 0; i < 30; ++i) spectrum(i) = 1 + i % 3;
  auto const M = test::with_spectrum(spectrum);
  VectorXd const b = test::random_vector(30);
  auto const A = test::spd(M);
  auto const r = slant::solve(slant::cg{A, b}, test::zeros(30),
                              slant::residual_below(1e-12) || slant::at_most(30));
  CHECK(r.converged());
  CHECK(r.iterations() == 3);
}

TEST_CASE("the energy error falls monotonically and below the Chebyshev bound") {
  double const κ = 100;
  auto const M = test::with_spectrum(test::log_spaced(60, κ));
  VectorXd const x = test::random_vector(60), b = M * x;
  auto const A = test::spd(M);
  slant::cg method{A, b};
  auto s = method.start(VectorXd::Zero(60));
  auto energy = [&] { return std::sqrt((s.x - x).dot(M * (s.x - x))); };
  double const first = energy();
  double last = first;
  double const q = (std::sqrt(κ) - 1) / (std::sqrt(κ) + 1);
  for (int k = 1; k <= 40; ++k) {
    method.step(s);
    CHECK(energy() <= last * (1 + 1e-12));
    CHECK(energy() <= 2 * std::pow(q, k) * first * (1 + 1e-10));
    last = energy();
  }
}

TEST_CASE("the inverse of the diagonal as preconditioner undoes bad scaling") {
  auto M = test::with_spectrum(test::log_spaced(40, 4));
  VectorXd scale(40);
  for (int i = 0; i < 40; ++i) scale(i) = std::pow(10.0, (i % 7) - 3);
  M = (scale.asDiagonal() * M * scale.asDiagonal()).eval();
  VectorXd const b = M * test::random_vector(40);
  auto const A = test::spd(M);
  VectorXd const weights = M.diagonal().cwiseInverse();
  auto const D = slant::diagonal<slant::positive_definite>(weights);
  auto const stop = slant::residual_below(1e-10) || slant::at_most(400);
  VectorXd const zero = VectorXd::Zero(40);
  auto const plain = slant::solve(slant::cg{A, b}, zero, stop);
  auto const preconditioned = slant::solve(slant::cg{A, b, D}, zero, stop);
  REQUIRE(preconditioned.converged());
  CHECK(preconditioned.iterations() <= 30);
  CHECK(plain.iterations() > 3 * preconditioned.iterations());
}

TEST_CASE("an operator that breaks its promise is reported, not trusted") {
  MatrixXd M = Vector2d(1, -1).asDiagonal();
  VectorXd const b = VectorXd::Ones(2);
  auto const A = test::spd(M);
  auto const r = slant::solve(slant::cg{A, b}, test::zeros(2), slant::at_most(10));
  CHECK(r.status == slant::status::breakdown);
  CHECK(r.reason == "pᵀA p = 0 for a direction p, where a positive definite A has a number > 0");
}

TEST_CASE("bad input is named") {
  auto const M = test::with_spectrum(test::log_spaced(5, 4));
  auto const A = test::spd(M);
  VectorXd b = VectorXd::Ones(4);
  CHECK_THROWS_WITH_AS((slant::cg{A, b}), "A.rows(): got 5, expected size 4", slant::bad_input);
  b = VectorXd::Ones(5);
  slant::cg method{A, b};
  CHECK_THROWS_WITH_AS((void)method.start(VectorXd::Ones(3)), "x0: got 3, expected size 5",
                       slant::bad_input);
  b(3) = std::nan("");
  CHECK_THROWS_WITH_AS((slant::cg{A, b}), "b[3]: got nan, expected a finite number",
                       slant::bad_input);
}

TEST_CASE_TEMPLATE("cg computes in any scalar", S, float, long double) {
  auto const D = test::with_spectrum(test::log_spaced(20, 10));
  test::dense<S> const M = D.cast<S>();
  test::column<S> const x = test::random_vector(20).cast<S>(), b = M * x;
  auto const A = test::spd(M);
  S const ε = std::numeric_limits<S>::epsilon();
  auto const r = slant::solve(slant::cg{A, b}, test::column<S>(test::column<S>::Zero(20)),
                              slant::residual_below(20 * ε) || slant::at_most(200));
  REQUIRE(r.converged());
  CHECK((r.x() - x).norm() <= 1000 * ε * x.norm());
}

TEST_CASE("each direction is conjugate to its predecessor, whatever gradient comes in") {
  auto const M = test::with_spectrum(test::log_spaced(12, 1e3));
  auto const A = test::spd(M);
  auto w = slant::workspace(A, VectorXd(12));
  slant::conjugate_directions<VectorXd> d(VectorXd(12));
  VectorXd previous;
  for (unsigned seed = 1; seed <= 10; ++seed) {
    VectorXd const φ = test::random_vector(12, seed);
    d.advance(φ);
    d.image(A, w);
    CHECK(d.curvature == doctest::Approx(d.p.dot(M * d.p)).epsilon(1e-14));
    if (seed == 1) {
      CHECK(d.p == φ);
    } else {
      CHECK(std::abs(d.p.dot(M * previous)) <= 1e-13 * d.p.norm() * previous.norm());
    }
    previous = d.p;
  }
}

TEST_CASE("a restart forgets") {
  auto const M = test::with_spectrum(test::log_spaced(5, 30));
  auto const A = test::spd(M);
  auto w = slant::workspace(A, VectorXd(5));
  slant::conjugate_directions<VectorXd> d(VectorXd(5));
  d.advance(test::random_vector(5, 1));
  d.image(A, w);
  CHECK(d.live);
  d.live = false;
  VectorXd const φ = test::random_vector(5, 2);
  d.advance(φ);
  CHECK(d.p == φ);
}

}  // namespace cg_test
