// SPDX-License-Identifier: MIT
#include <slant/slant.hpp>

#include <support/testing.hpp>
#include "mixture.hpp"

namespace gradient_point_test {

TEST_CASE("begin: the projected start, a power-of-two unit, the scale of the point next to 0") {
  test::mixture const p(30);
  auto const A = slant::counted(test::spd(p.A));
  auto const set = p.set();
  slant::separable_qp const qp{A, p.b, set};
  VectorXd const x0 = 3 * test::random_vector(20, 11);
  slant::gradient_point<std::remove_cvref_t<decltype(qp)>> point(qp, x0);
  point.step_length = 0.7;
  CHECK_FALSE(point.begin(qp, x0));
  CHECK(A.applications() == 2);  // at P_Λ(0) ≠ 0 and at P_Λ(x0)
  CHECK(point.x == slant::project(set, x0));
  CHECK((point.unit * point.r - (p.A * point.x - p.b)).norm() <= 1e-14 * p.b.norm());
  CHECK(std::ldexp(1.0, std::ilogb(point.unit)) == point.unit);
  VectorXd const origin = slant::project(set, test::zeros(20));
  VectorXd const there = slant::project(set, VectorXd(origin - 0.7 * (p.A * origin - p.b)));
  CHECK(point.gradient_scale == doctest::Approx((origin - there).norm() / 0.7));
}

TEST_CASE("the energy, without a product") {
  test::mixture const p(30);
  auto const A = slant::counted(test::spd(p.A));
  auto const set = p.set();
  slant::separable_qp const qp{A, p.b, set};
  VectorXd const x0 = test::random_vector(20, 3);
  slant::gradient_point<std::remove_cvref_t<decltype(qp)>> point(qp, x0);
  point.step_length = 0.7;
  static_cast<void>(point.begin(qp, x0));
  auto const before = A.applications();
  auto const [q, noise] = point.energy(qp);
  CHECK(A.applications() == before);
  double const exact = 0.5 * point.x.dot(p.A * point.x) - p.b.dot(point.x);
  CHECK(std::abs(q * point.unit - exact) <= noise * point.unit);
  CHECK(noise <= 1e-13 * (std::abs(q) + point.x.norm()));
}

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

}  // namespace gradient_point_test
