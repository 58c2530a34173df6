// SPDX-License-Identifier: MIT
#include <slant/methods/parts/curved_minimum.hpp>
#include <slant/sets/contact_sets.hpp>

#include <methods/sliding_discs.hpp>
#include <support/testing.hpp>

namespace newton_segment_test {

TEST_CASE("the residual along a segment, with exact ends") {
  test::sliding_discs const p;
  auto const set = slant::discs(p.g);
  slant::newton_segment<VectorXd> segment(p.r, 12);
  segment.y = 1e10 * test::random_vector(12, 1);
  segment.z = segment.y - p.ρ * (p.A * segment.y - p.r);
  segment.target_y = test::random_vector(12, 2);
  segment.target_z = segment.target_y - p.ρ * (p.A * segment.target_y - p.r);
  VectorXd projected(12), trial(12);
  for (double β : {0.0, 0.25, 1.0}) {
    VectorXd const y = (1 - β) * segment.y + β * segment.target_y;
    VectorXd const z = y - p.ρ * (p.A * y - p.r);
    VectorXd const F = y - slant::project(set, z);
    CHECK(segment.residual_at(set, β, projected, trial) == doctest::Approx(F.norm()));
  }
  VectorXd const end = segment.target_y;
  segment.advance(1.0);
  CHECK(segment.y == end);
}

}  // namespace newton_segment_test
