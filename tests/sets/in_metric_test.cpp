// SPDX-License-Identifier: MIT
#include <slant/sets/in_metric.hpp>

#include "oracle/hard_points.hpp"
#include "oracle/naive_projections.hpp"
#include "oracle/precise.hpp"
#include "oracle/set_checks.hpp"

#include <slant/sets/ball.hpp>
#include <slant/sets/ellipse.hpp>
#include <slant/sets/half_line.hpp>
#include <slant/sets/second_order_cone.hpp>
#include <slant/slanting/projection.hpp>
#include <slant/testing/slanting_laws.hpp>

#include <doctest/doctest.h>

#include <Eigen/Core>
#include <limits>

namespace in_metric_test {

using Eigen::Vector3d;
using Eigen::VectorXd;
using oracle::float_50;
using cone = slant::second_order_cone<3>;

constexpr double ε = std::numeric_limits<double>::epsilon();

TEST_CASE("in_metric: optimality in the metric, at all scales of point and metric") {
  oracle::number_source<double> source(1);
  for (int i = 0; i < 300; ++i) {
    double const μ = source.positive_of_size(-2, 2), scale = source.positive_of_size(-150, 150);
    double const unit = source.positive_of_size(-140, 140), t = source.positive_of_size(-3, 3);
    Vector3d const d(unit, t * unit, t * unit), x = scale * source.direction<3>();
    cone const set(μ);
    auto const metric = slant::in_metric(set, d);
    Vector3d const p = metric.project(x);
    CHECK(metric.contains(p));
    // The D-normal D (x − p), in units of d_n and of the scale, is in the polar cone and
    // orthogonal.
    using wide = Eigen::Matrix<float_50, 3, 1>;
    wide const n = (oracle::widen<float_50>(x) - oracle::widen<float_50>(p))
                       .cwiseProduct(wide(float_50(1), float_50(d(1)) / float_50(unit),
                                          float_50(d(2)) / float_50(unit))) /
                   float_50(scale);
    wide const q = oracle::widen<float_50>(p) / float_50(scale);
    float_50 const size = (1 + t) * (1 + sqrt(q.squaredNorm()));
    float_50 const slip = sqrt(float_50(n(1) * n(1) + n(2) * n(2)));
    CHECK(n(0) + μ * slip <= 16 * ε * (1 + μ) * size);
    CHECK(abs(float_50(n.dot(q))) <= 16 * ε * size);
  }
}

TEST_CASE("in_metric: metrics as unequal as numbers can be") {
  // Exactly, p is below the smallest numbers.
  CHECK(slant::in_metric(cone(0.5), Vector3d(1e100, 1, 1)).project(Vector3d(0, 1e-300, 0)) ==
        Vector3d(0, 0, 0));
  // Heavy along n: x_n stays, and ‖p_t‖ = μ x_n; heavy along t: x_t stays.
  for (double s : {1e-150, 1.0, 1e150}) {
    Vector3d const x(s, 3 * s, 0);
    Vector3d const along_n = slant::in_metric(cone(0.5), Vector3d(1e200, 1, 1)).project(x);
    CHECK((along_n - Vector3d(s, 0.5 * s, 0)).norm() <= 8 * ε * s);
    Vector3d const along_t = slant::in_metric(cone(0.5), Vector3d(1e-200, 1, 1)).project(x);
    CHECK((along_t - Vector3d(6 * s, 3 * s, 0)).norm() <= 32 * ε * s);
  }
  CHECK(oracle::complaint<slant::bad_input>([] {
          return slant::in_metric(cone(1e-250), Vector3d(1e300, 1e-300, 1e-300));
        }).substr(0, 2) == "d:");
}

TEST_CASE("in_metric: what stays is not rounded, projecting twice changes only last digits") {
  oracle::number_source<double> source(2);
  for (int i = 0; i < 100; ++i) {
    Vector3d const d(source.positive_of_size(-2, 2), 3, 3), x = source.direction<3>();
    auto const metric = slant::in_metric(cone(0.5), d);
    Vector3d const p = metric.project(x);
    CHECK((metric.project(p) - p).norm() <= 16 * ε * p.norm());
    Vector3d const inside(1, 0.3 * x(1), 0.3 * x(2));
    CHECK(metric.project(inside) == inside);
  }
}

TEST_CASE("in_metric: slanting operator against differences, D-symmetric, no laws declared") {
  oracle::number_source<double> source(3);
  using wide = Eigen::Matrix<float_50, 3, 1>;
  for (int i = 0; i < 30; ++i) {
    double const μ = source.positive_of_size(-1, 1);
    Vector3d const d(source.positive_of_size(-1, 1), 2, 2);
    Vector3d x = source.direction<3>();
    double const c = std::sqrt(2 / d(0)), ρ = c * x.tail<2>().norm(), m = μ * c;
    double const between = source.uniform(0.1, 0.9);
    x(0) = between * ρ / m - (1 - between) * m * ρ;  // on the mantle, off the kinks
    float_50 const C = sqrt(float_50(2) / float_50(d(0)));
    auto const naive = [&](wide const& z) {
      wide p = naive::project_cone<float_50, 3>(wide(z(0), C * z(1), C * z(2)), float_50(μ) * C);
      p.tail<2>() /= C;
      return p;
    };
    auto const J =
        oracle::differences<float_50, 3, 3>(naive, oracle::widen<float_50>(x), float_50(1e-18));
    auto const metric = slant::in_metric(cone(μ), d);
    Eigen::Matrix3d const G = metric.slant(x), DG = d.asDiagonal() * G;
    for (int k = 0; k < 9; ++k) {
      CHECK(std::abs(G(k / 3, k % 3) - double(J(k / 3, k % 3))) <= 32 * ε * (1 + c + 1 / c));
    }
    CHECK((DG - DG.transpose()).norm() <= 8 * ε * DG.norm());
  }
  auto const f = slant::projection(slant::in_metric(cone(0.5), Vector3d(2, 5, 5)));
  static_assert(!slant::declares_self_adjoint<decltype(f.slant(Vector3d()))>);
  static_assert(slant::oblique<slant::in_metric_block<cone>>);
  static_assert(!slant::separable_set<slant::in_metric_block<cone>, Vector3d>);
}

TEST_CASE("in_metric: of a product; limits at the apex, the axis and the boundary") {
  auto const K = slant::power(cone{}, VectorXd{{0.5, 0.0}});
  VectorXd const d{{2.0, 5.0, 5.0, 1.0, 0.25, 0.25}};
  auto const set = slant::in_metric(K, d);
  VectorXd const x{{-0.25, 1.0, 2.0, 1.0, 2.0, 3.0}};
  VectorXd const p = slant::project(set, x);
  CHECK(p.head<3>() == slant::in_metric(cone(0.5), Vector3d(2, 5, 5)).project(x.head<3>()));
  CHECK(p.tail<3>() == Vector3d(1, 0, 0));
  auto const f = slant::projection(set);
  static_assert(!slant::declares_self_adjoint<decltype(f.slant(x))>);
  slant::testing::check_slanting_laws(f, x, VectorXd(VectorXd::Zero(6)),
                                      VectorXd{{1.0, 0.3, 0.4, 1.0, 0.0, 0.0}},
                                      VectorXd{{1.0, 0.0, 0.0, -1.0, 0.0, 0.0}});
}

TEST_CASE("in_metric: ellipses, half lines, balls") {
  // In the norm with D = diag(1/a², 1/b²) the ellipse is a disc.
  auto const round = slant::in_metric(slant::ellipse<>{2.0, 0.5}, Eigen::Vector2d(0.25, 4));
  CHECK((round.project(Eigen::Vector2d(6, 2)) - Eigen::Vector2d(1.2, 0.4)).norm() <= 4 * ε);
  CHECK(slant::in_metric(slant::half_line<>{-3.0}, Eigen::Matrix<double, 1, 1>(7.0))
            .project(Eigen::Matrix<double, 1, 1>(-5.0))(0) == doctest::Approx(-3.0));
  slant::ball<2> const disc(2.0);
  Eigen::Vector2d const x(3, 4);
  CHECK((slant::in_metric(disc, Eigen::Vector2d(7, 7)).project(x) - disc.project(x)).norm() <=
        4 * ε);
}

TEST_CASE("in_metric: bad input is named") {
  auto const made = [](double a, double b, double c) {
    return oracle::complaint<slant::bad_input>(
        [=] { return slant::in_metric(cone(0.5), Vector3d(a, b, c)); });
  };
  CHECK(made(1, 2, 2).empty());
  CHECK(made(0, 2, 2) == "d(0): got 0, expected a finite number > 0");
  CHECK(made(1, 4, 1).substr(0, 8) == "factor 2");
  CHECK(slant::in_metric(cone(0.5), {1.0, 2.0, 2.0}).contains(Vector3d(1, 0.5, 0)));
  CHECK(oracle::complaint<slant::bad_input>([] {
          return slant::in_metric(cone(0.5), VectorXd{{1.0, 2.0}});
        }) == "d: got 2, expected the dimension of the set, 3");
  auto const K = slant::power(cone{}, 2);
  CHECK(oracle::complaint<slant::bad_input>([&] {
          return slant::in_metric(K, VectorXd{{1.0, 1.0, 1.0, 1.0, -1.0, 1.0}});
        }) == "d(1)[1]: got -1, expected a finite number > 0");
}

}  // namespace in_metric_test
