// SPDX-License-Identifier: MIT
#include <slant/sets/sets.hpp>

#include <krylov/spd_matrices.hpp>
#include <support/testing.hpp>

namespace curved_face_test {

using namespace test::evaluated;
/// The matrix of x ↦ f(x, y).
template <class F>
MatrixXd columns(Eigen::Index n, F&& f) {
  MatrixXd m(n, n);
  for (Eigen::Index j = 0; j < n; ++j) {
    VectorXd const e = VectorXd::Unit(n, j);
    VectorXd y = VectorXd::Zero(n);
    f(e, y);
    m.col(j) = y;
  }
  return m;
}

/// A point with blocks inside, outside and far outside, of every kind.
auto all_kinds() {
  return slant::cartesian(slant::half_lines(VectorXd{{0.0, 1.0, -2.0}}),
                          slant::discs(VectorXd{{1.0, 2.0, 0.0, 1e-9}}), slant::free_components(2),
                          slant::power(slant::second_order_cone<3>(0.5), 2),
                          slant::power(slant::ellipse(3.0, 0.5), 1));
}

TEST_CASE("projector, curvature and weight are functions of the slanting operator") {
  auto const set = all_kinds();
  Eigen::Index const n = set.size();
  double const κ = 0.7;
  slant::curved_face<> face(set);
  for (unsigned seed = 1; seed <= 20; ++seed) {
    CAPTURE(seed);
    VectorXd const z = 3 * test::random_vector(n, seed);
    face.assign(set, z, κ);
    auto const g = slant::projection_slant(set, z);
    MatrixXd const G = columns(n, [&](auto const& x, auto& y) { g.apply(x, y); });
    Eigen::SelfAdjointEigenSolver<MatrixXd> const eigen((G + G.transpose()) / 2);
    MatrixXd projector = MatrixXd::Zero(n, n), curvature = projector, weight = projector;
    for (Eigen::Index j = 0; j < n; ++j) {
      double const γ = std::min(eigen.eigenvalues()(j), 1.0);
      if (γ < 1e-14) continue;
      MatrixXd const P = eigen.eigenvectors().col(j) * eigen.eigenvectors().col(j).transpose();
      projector += P;
      curvature += (1 - γ) / γ * P;
      weight += γ / (γ + κ * (1 - γ)) * P;
    }
    auto const keep = columns(n, [&](auto const& x, auto& y) { face.keep(x, y); });
    auto const weigh = columns(n, [&](auto const& x, auto& y) { face.weigh(x, y); });
    auto const bend = columns(n, [&](auto const& x, auto& y) { face.add_curvature(1.0, x, y); });
    CHECK((keep - projector).norm() <= 1e-13);
    CHECK((weigh - weight).norm() <= 1e-13);
    CHECK((bend - curvature).norm() <= 1e-12 * (1 + curvature.norm()));
    CHECK((keep * keep - keep).norm() <= 1e-14);
    MatrixXd entries = MatrixXd::Identity(n, n), bent = MatrixXd::Zero(n, n);
    face.block_entries([&](slant::index i, slant::index j, double π, double c) {
      entries(i, j) = π;
      bent(i, j) = c;
    });
    CHECK(entries == keep);
    CHECK(bent == bend);
  }
}

TEST_CASE("a sliding disc: (1 − τ)/τ on its tangent, to the last digits for any τ") {
  for (double g : {1.0, 1e-6, 1e-12}) {
    auto const set = slant::discs(VectorXd{{g}});
    slant::curved_face<> face(set);
    VectorXd const z{{3.0, 4.0}};
    face.assign(set, z, 1.0);
    CHECK(face.curved_count() == 1);
    VectorXd const tangent{{-0.8, 0.6}};
    VectorXd y = VectorXd::Zero(2);
    face.add_curvature(1.0, tangent, y);
    double const τ = g / 5.0;
    CHECK((y - (1 - τ) / τ * tangent).norm() <= 1e-14 / τ);
    face.keep(z, y);
    CHECK(y.norm() <= 1e-15 * z.norm());
  }
}

TEST_CASE("blocks that are inside or fixed are told by a mask, and ∞ stays where it is") {
  auto const set = slant::cartesian(slant::half_lines(2), slant::discs(VectorXd{{1.0, 0.0}}));
  slant::curved_face<> face(set);
  face.assign(set, VectorXd{{1.0, -1.0, 0.1, 0.1, 5.0, 5.0}}, 1.0);
  CHECK(face.curved_count() == 0);
  VectorXd y(6);
  face.keep(VectorXd{{1.0, infinity, 2.0, 3.0, infinity, infinity}}, y);
  CHECK(y == VectorXd{{1.0, 0.0, 2.0, 3.0, 0.0, 0.0}});
}

TEST_CASE("reassigning does not allocate") {
  auto const set = all_kinds();
  slant::curved_face<> face(set);
  VectorXd const inside = VectorXd::Zero(set.size()),
                 outside = VectorXd::Constant(set.size(), 100.0);
  slant::testing::allocation_guard guard;
  face.assign(set, inside, 1.0);
  face.assign(set, outside, 1.0);
  auto const allocations = guard.count();
  CHECK(allocations == 0);
}

TEST_CASE("small eigenvalues are as accurate as large ones") {
  // diag(1, 1e-12) turned by 30°: the small one is what remains of cancelling entries.
  double const c = std::sqrt(3.0) / 2, s = 0.5;
  Eigen::Matrix3d g = Vector3d(1e-3, 2.0, 5e-7).asDiagonal();
  Eigen::Matrix3d Q;
  Q << c, -s, 0, s, c, 0, 0, 0, 1;
  slant::detail::symmetric_eigen<double, 3> const e(Q * g * Q.transpose());
  CHECK(
      (e.vectors * e.values.asDiagonal() * e.vectors.transpose() - Q * g * Q.transpose()).norm() <=
      1e-14);
  CHECK((e.vectors.transpose() * e.vectors - Eigen::Matrix3d::Identity()).norm() <= 1e-14);
  Vector3d sorted = e.values;
  std::sort(sorted.data(), sorted.data() + 3);
  CHECK(sorted(0) == doctest::Approx(5e-7).epsilon(1e-12));
  CHECK(sorted(1) == doctest::Approx(1e-3).epsilon(1e-12));
  CHECK(sorted(2) == doctest::Approx(2.0).epsilon(1e-12));
}

}  // namespace curved_face_test
