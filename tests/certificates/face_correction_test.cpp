// SPDX-License-Identifier: MIT
#include <slant/slant.hpp>

#include <methods/sliding_discs.hpp>
#include <support/testing.hpp>

namespace face_correction_test {

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

}  // namespace face_correction_test
