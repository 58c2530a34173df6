// SPDX-License-Identifier: MIT
#include <slant/krylov/conjugate_directions.hpp>

#include <support/testing.hpp>
#include "spd_matrices.hpp"

namespace conjugate_directions_test {

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

}  // namespace conjugate_directions_test
