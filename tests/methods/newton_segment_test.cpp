// SPDX-License-Identifier: MIT
#include <slant/methods/parts/curved_minimum.hpp>
#include <slant/sets/contact_sets.hpp>

#include <krylov/spd_matrices.hpp>
#include <support/testing.hpp>

namespace newton_segment_test {

TEST_CASE("the residual along a segment, with exact ends") {
  MatrixXd const A = test::with_spectrum(test::log_spaced(12, 200), 2);
  VectorXd const b = test::random_vector(12, 4);
  double const ρ = 0.8;
  auto const set = slant::discs(VectorXd{{0.5, 1.0, 3.0, 0.0, 0.1, 2.0}});
  slant::newton_segment<VectorXd> segment(b, 12);
  segment.y = 1e10 * test::random_vector(12, 1);
  segment.z = segment.y - ρ * (A * segment.y - b);
  segment.target_y = test::random_vector(12, 2);
  segment.target_z = segment.target_y - ρ * (A * segment.target_y - b);
  VectorXd projected(12), trial(12);
  for (double β : {0.0, 0.25, 1.0}) {
    VectorXd const y = (1 - β) * segment.y + β * segment.target_y;
    VectorXd const z = y - ρ * (A * y - b);
    VectorXd const F = y - slant::project(set, z);
    CHECK(segment.residual_at(set, β, projected, trial) == doctest::Approx(F.norm()));
  }
  VectorXd const end = segment.target_y;
  segment.advance(1.0);
  CHECK(segment.y == end);
}

}  // namespace newton_segment_test
