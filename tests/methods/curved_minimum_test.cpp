// SPDX-License-Identifier: MIT
#include <slant/slant.hpp>

#include <methods/sliding_discs.hpp>
#include <support/testing.hpp>

namespace curved_minimum_test {

using test::sliding_discs;

/// The minimiser by dense linear algebra on a basis of range(G).
VectorXd dense_minimiser(sliding_discs const& p, slant::curved_face<> const& face) {
  test::dense_face const dense(p, face);
  return -test::least_squares(dense.H, dense.keep * p.r);
}

TEST_CASE("the minimiser of the model and its image, with and without a preconditioner") {
  sliding_discs const p;
  auto const set = slant::discs(p.g);
  auto const A = slant::counted(test::spd(p.A));
  slant::curved_face<> face(set);
  face.assign(set, p.z, 1.0 / p.ρ);
  REQUIRE(face.curved_count() >= 2);
  VectorXd const exact = dense_minimiser(p, face);
  auto const check = [&](auto const& m, double s) {
    auto const before = A.applications();
    auto workspace_of_a = slant::workspace(A, p.r);
    slant::curved_minimum<VectorXd, std::remove_cvref_t<decltype(m)>> inner(p.r, 12, m);
    auto const result =
        inner.minimise(A, workspace_of_a, m, p.r, face, p.ρ, s, 1e-13 * p.r.norm(), 100);
    CHECK(result.finite);
    CHECK(result.residual <= 1e-13 * p.r.norm());
    CHECK(A.applications() - before == result.iterations);
    CHECK((inner.t - exact).norm() <= 1e-10 * exact.norm());
    CHECK((inner.image - p.A * inner.t).norm() <= 1e-12 * p.A.norm() * exact.norm());
    return result.iterations;
  };
  auto const plain = check(slant::identity(12), 1.0);
  MatrixXd const inverse = p.A.inverse();
  auto const preconditioned =
      check(test::spd(MatrixXd((inverse + inverse.transpose()) / 2)), inverse.trace() / 12);
  CHECK(preconditioned <= plain);
}

TEST_CASE("limits: no step, a target that is met already, a kernel") {
  sliding_discs const p;
  auto const set = slant::discs(p.g);
  slant::curved_face<> face(set);
  face.assign(set, p.z, 1.0);
  auto const I = slant::identity(12);
  slant::curved_minimum<VectorXd, slant::identity_operator> inner(p.r, 12, I);
  auto const A = test::spd(p.A);
  auto w = slant::workspace(A, p.r);
  CHECK(inner.minimise(A, w, I, p.r, face, p.ρ, 1.0, 0.0, 0).iterations == 0);
  CHECK(inner.t == VectorXd::Zero(12));
  CHECK(inner.minimise(A, w, I, p.r, face, p.ρ, 1.0, 10 * p.r.norm(), 50).iterations == 0);
  // A = 0 on free components: descent without end is left to others.
  VectorXd const inside = VectorXd::Zero(12);
  auto const wide = slant::discs(VectorXd(VectorXd::Ones(6)));
  face.assign(wide, inside, 1.0);
  MatrixXd const zero = MatrixXd::Zero(12, 12);
  auto const nothing = test::spd(zero);
  auto const result = inner.minimise(nothing, w, I, p.r, face, p.ρ, 1.0, 0.0, 50);
  CHECK(result.iterations == 1);
  CHECK(result.finite);
  CHECK(inner.t == VectorXd::Zero(12));
}

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

}  // namespace curved_minimum_test
