// SPDX-License-Identifier: MIT
#include "slanting_support.hpp"

#include "oracle/hard_points.hpp"

#include <slant/slanting/friction_projection.hpp>
#include <slant/testing/slanting_laws.hpp>

#include <doctest/doctest.h>

#include <Eigen/Core>
#include <cmath>
#include <limits>
#include <string>

namespace friction_projection_test {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Eigen::VectorXd;

constexpr double ε = std::numeric_limits<double>::epsilon();

/// The same by its definition.
Vector3d naive(double μ, Vector3d const& z) {
  double const p = std::max(0.0, z(0)), size = std::hypot(z(1), z(2));
  double const share = size > μ * p ? μ * p / size : 1;
  return {p, share * z(1), share * z(2)};
}

TEST_CASE("known values: open, sticking, sliding") {
  auto const f = slant::friction_projection<3>(VectorXd{{0.5, 0.5, 0.5}});
  VectorXd const z{{-1, 3, 4, 2, 0.6, -0.8, 2, 3, -4}};
  CHECK((slant::evaluate(f, z) - VectorXd{{0, 0, 0, 2, 0.6, -0.8, 2, 0.6, -0.8}}).norm() <= 4 * ε);
  auto const line = slant::friction_projection<2>(VectorXd{{0.5}});
  CHECK(slant::evaluate(line, VectorXd{{2.0, -7.0}}) == VectorXd{{2.0, -1.0}});
}

TEST_CASE("against the definition and differences, at all scales") {
  oracle::number_source<double> source(1);
  int slides = 0;
  for (int i = 0; i < 200; ++i) {
    double const scale = source.positive_of_size(-150, 150);
    double const μ = source.positive_of_size(-2, 1);
    Vector3d const unit = source.direction<3>(), z = scale * unit;
    slant::friction_projection_block<3> const block(μ);
    CHECK((block.value(z) / scale - naive(μ, unit)).norm() <= 16 * ε);
    // Not across a kink.
    double const h = 1e-7, p = unit(0), size = std::hypot(unit(1), unit(2));
    if (std::fabs(p) < 1e-3 || std::fabs(size - μ * p) < 1e-3 || size < 1e-3) continue;
    Matrix3d J;
    for (int j = 0; j < 3; ++j) {
      Vector3d const e = h * Vector3d::Unit(j);
      J.col(j) = (naive(μ, unit + e) - naive(μ, unit - e)) / (2 * h);
    }
    CHECK((block.slant(z) - J).norm() <= 1e-5 * (1 + μ));
    slides += p > 0 && size > μ * p ? 1 : 0;
  }
  CHECK(slides >= 10);
}

TEST_CASE("choices at the kinks: from inside") {
  slant::friction_projection_block<3> const f(0.5), smooth(0);
  CHECK(f.slant(Vector3d(2, 0.6, 0.8)) == Matrix3d::Identity());  // on the circle
  Matrix3d apex = Matrix3d::Zero();
  apex(0, 0) = 1;
  CHECK(f.slant(Vector3d::Zero()) == apex);
  Matrix3d closing = apex;
  closing(1, 0) = 0.5;
  CHECK(f.slant(Vector3d(0, 3, 0)) == closing);
  CHECK(f.slant(Vector3d(-1, 3, 0)) == Matrix3d::Zero());
  CHECK(smooth.slant(Vector3d(1, 3, 4)) == apex);
  CHECK(smooth.slant(Vector3d(1, 0, 0)) == apex);
}

TEST_CASE("coefficients out of range are refused") {
  auto const message = [](VectorXd const& μ) -> std::string {
    try {
      static_cast<void>(slant::friction_projection<3>(μ));
    } catch (slant::bad_input const& e) {
      return e.what();
    }
    return "accepted";
  };
  CHECK(message(VectorXd{{0.1, -1}}) == "mu[1]: got -1, expected a finite number >= 0");
}

TEST_CASE("it is a slanting function") {
  auto const f = slant::friction_projection<3>(VectorXd{{0.5, 0.0, 2.0}});
  slant::testing::check_slanting_laws(f, VectorXd::Zero(9).eval());
}

}  // namespace friction_projection_test
