// SPDX-License-Identifier: MIT
#include <slant/methods/parts/gradient_point.hpp>

#include <support/testing.hpp>
#include "mixture.hpp"

namespace reduced_gradient_test {

TEST_CASE("by its definition; exactly r where no constraint is felt") {
  test::mixture const p(10);
  auto const set = p.set();
  VectorXd const x = slant::project(set, VectorXd(3 * test::random_vector(20, 3)));
  VectorXd const r = test::random_vector(20, 4);
  for (double α : {1e-6, 0.3, 10.0}) {
    VectorXd trial(20), projected(20), reduced(20);
    slant::reduced_gradient(set, x, r, α, trial, projected, reduced);
    CHECK(trial == x - α * r);
    CHECK(projected == slant::project(set, trial));
    CHECK((reduced - (x - projected) / α).norm() <= 1e-15 * x.norm() / α);
    CHECK(reduced.tail(4) == r.tail(4));  // free components
    // (x − P)ᵀ(x − α r − P) ≤ 0 for x ∈ Λ
    CHECK(reduced.squaredNorm() <= reduced.dot(r) + 1e-13 * x.norm() / α * r.norm());
  }
}

TEST_CASE("the gain is the product with r, or its lower bound where rounding errors swallow that") {
  VectorXd const reduced{{3.0, 0.0}}, r{{4.0, 1.0}}, across{{0.0, 1e9}};
  CHECK(slant::gain(reduced, r, 0.0) == 12);
  CHECK(slant::gain(reduced, r, 5.0) == 9);
  CHECK(slant::gain(reduced, across, 1e-7) == 9);
}

}  // namespace reduced_gradient_test
