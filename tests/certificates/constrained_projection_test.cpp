// SPDX-License-Identifier: MIT
#include <slant/certificates/constrained_energy_certificate.hpp>
#include <slant/sets/cartesian.hpp>
#include <slant/sets/contact_sets.hpp>

#include <doctest/doctest.h>
#include <Eigen/Core>

#include <support/allocation_guard.hpp>

#include <cmath>
#include <random>

namespace constrained_projection_test {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using sparse = Eigen::SparseMatrix<double>;

auto half_lines_and_discs(VectorXd const& radius) {
  return slant::cartesian(slant::free_components<double>(2), slant::half_lines(4),
                          slant::discs(radius));
}

TEST_CASE("the nearest point of half lines, discs and a plane: the optimality conditions") {
  std::mt19937 random(8);
  std::normal_distribution<double> gauss;
  VectorXd const radius{{0.5, 2.0}};
  auto const set = half_lines_and_discs(radius);
  int curved = 0;
  for (int run = 0; run < 100; ++run) {
    CAPTURE(run);
    int const p = 1 + run % 4;
    MatrixXd rows = MatrixXd::NullaryExpr(p, 10, [&] { return gauss(random); });
    rows.rowwise().normalize();
    VectorXd const inside =
        slant::project(set, VectorXd(VectorXd::NullaryExpr(10, [&] { return gauss(random); })));
    // In any units.
    double const unit = std::pow(10, 150.0 * (run % 3 - 1));
    auto const scaled = half_lines_and_discs(unit * radius);
    VectorXd const nearest = unit * inside;  // only N x̄ matters
    VectorXd const z = VectorXd::NullaryExpr(10, [&] { return 3 * unit * gauss(random); });
    sparse const N = rows.sparseView();
    slant::constrained_projection<double> projection(N);
    slant::testing::allocation_guard guard;
    bool const found = projection.compute(scaled, N, nearest, z);
    auto const allocations = guard.count();
    CHECK(allocations == 0);
    REQUIRE(found);
    auto const& y = projection.point;
    CHECK(scaled.contains(y));
    CHECK((rows * (y - nearest)).stableNorm() <= 1e-14 * unit * 10);
    // y = P_Λ(z − Nᵀm), and z − base in range Nᵀ.
    CHECK((y - slant::project(scaled, projection.base)).stableNorm() == 0);
    VectorXd const normal = projection.normal / unit;
    VectorXd const m = (rows * rows.transpose()).llt().solve(rows * normal);
    CHECK((normal - rows.transpose() * m).norm() <= 1e-12 * (1 + normal.norm()));
    if (y.segment<2>(6).stableNorm() > 0.499 * unit) ++curved;
  }
  CHECK(curved > 20);
}

TEST_CASE("a corner, equations that depend on each other there, and no point at all") {
  // x₀ + x₁ = 1, x₀ − x₁ = 1 over the quadrant: (1, 0), on whose face both rows say the same.
  auto const quadrant = slant::half_lines(2);
  MatrixXd rows{{1.0, 1.0}, {1.0, -1.0}};
  rows /= std::sqrt(2.0);
  sparse const N = rows.sparseView();
  slant::constrained_projection<double> projection(N);
  VectorXd const nearest{{1.0, 0.0}};
  for (double const far : {0.0, 1.0, -1e6}) {
    REQUIRE(projection.compute(quadrant, N, nearest, VectorXd{{far, far}}));
    CHECK((projection.point - nearest).norm() <= 1e-14);
  }
  for (double const gap : {1.0, 1e-6, 1e-12}) {
    CAPTURE(gap);
    sparse const first = MatrixXd{{std::sqrt(0.5), std::sqrt(0.5)}}.sparseView();
    slant::constrained_projection<double> onto_line(first);
    VectorXd const outside{{1.0, -1.0 - gap}};  // x₀ + x₁ = −gap
    CHECK(!onto_line.compute(quadrant, first, outside, VectorXd{{2.0, 3.0}}));
  }
  sparse const none(0, 2);
  slant::constrained_projection<double> plain(none);
  REQUIRE(plain.compute(quadrant, none, VectorXd(VectorXd::Zero(2)), VectorXd{{2.0, -3.0}}));
  CHECK(plain.point == VectorXd{{2.0, 0.0}});
}

}  // namespace constrained_projection_test
