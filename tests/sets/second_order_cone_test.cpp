// SPDX-License-Identifier: MIT
#include <slant/sets/sets.hpp>
#include <slant/testing/laws.hpp>

#include <support/testing.hpp>
#include "oracle/precise.hpp"
#include "oracle/projection_errors.hpp"
#include "oracle/set_checks.hpp"

namespace second_order_cone_test {

using oracle::float_50;
using slant::block_state;
using cone = slant::second_order_cone<3>;
using vec3 = Eigen::Vector3d;
using plane = slant::plane_cone<>;
constexpr double ε = std::numeric_limits<double>::epsilon();

TEST_CASE_TEMPLATE("cone: known answers", S, float, float_50) {
  using vec = Eigen::Matrix<S, 3, 1>;
  slant::second_order_cone<3, S> const unit;
  CHECK(unit.mu() == S(1));
  auto const set = unit.with(S(2));
  vec const zero(S(0), S(0), S(0));
  CHECK(set.project(vec(S(3), S(4), S(4))) == vec(S(3), S(4), S(4)));
  CHECK(set.project(vec(S(-20), S(6), S(8))) == zero);
  CHECK(set.project(vec(S(-21), S(6), S(8))) == zero);
  // n + μρ = 25, 1 + μ² = 10, μ p_n/ρ = 3/4.
  CHECK(set.with(S(3)).project(vec(S(-5), S(6), S(8))) == vec(S(2.5), S(4.5), S(6)));
  CHECK(set.support(vec(S(-20), S(6), S(8))) == S(0));
  CHECK(set.support(vec(S(-19), S(6), S(8))) == std::numeric_limits<S>::infinity());
  CHECK(set.inequality(vec(S(1), S(2), S(1)))(0) == S(1));
  CHECK(set.inequality(vec(S(1), S(2), S(1)))(1) == S(-1));
  CHECK(set.step_to_boundary(vec(S(1), S(0), S(0)), vec(S(0), S(0), S(4))) == S(0.5));
  CHECK(set.step_to_boundary(vec(S(1), S(0), S(0)), vec(S(-2), S(0), S(0))) == S(0.5));
  CHECK(set.step_to_boundary(vec(S(1), S(0), S(0)), vec(S(1), S(0), S(2))) ==
        std::numeric_limits<S>::infinity());
}

TEST_CASE("cone: state and membership") {
  cone const set(2.0);
  vec3 const on_mantle(5, 6, 8);
  CHECK(set.state(on_mantle) == block_state::sliding);
  CHECK(set.state(vec3(5 * (1 + 4 * ε), 6, 8)) == block_state::sliding);
  CHECK(set.state(vec3(5 * (1 + 40 * ε), 6, 8)) == block_state::free);
  CHECK(set.contains(vec3(5 * (1 - 4 * ε), 6, 8)));
  CHECK_FALSE(set.contains(vec3(5 * (1 - 40 * ε), 6, 8)));
  CHECK_FALSE(set.contains(vec3(-5, 6, 8)));
  CHECK_FALSE(set.contains(vec3(-1e-300, 0, 0)));
  CHECK(set.contains(vec3(0, 0, 0)));
  CHECK(set.state(vec3(0, 0, 0)) == block_state::fixed);
  CHECK(set.state(vec3(1e-300, 0, 0)) == block_state::free);
  CHECK(set.state(1e-300 * on_mantle) == block_state::sliding);
}

TEST_CASE("cone: μ = 0 is the ray, and a huge μ nearly the half space") {
  cone const ray(0.0), wide(1e200);
  vec3 const zero(0, 0, 0);
  CHECK(ray.project(vec3(2, 3, 4)) == vec3(2, 0, 0));
  CHECK(ray.project(vec3(-2, 3, 4)) == zero);
  CHECK(ray.project(vec3(-2, 0, 0)) == zero);
  CHECK(ray.state(vec3(2, 0, 0)) == block_state::sliding);
  CHECK(ray.state(zero) == block_state::fixed);
  CHECK(ray.slant(vec3(2, 3, 4)) == vec3(1, 0, 0).asDiagonal().toDenseMatrix());
  CHECK(ray.slant(vec3(2, 0, 0)) == vec3(1, 0, 0).asDiagonal().toDenseMatrix());
  CHECK(ray.slant(vec3(-2, 3, 4)) == Eigen::Matrix3d::Zero());
  CHECK(ray.step_to_boundary(vec3(1e304, 0, 0), vec3(-5e303, 0, 0)) == 2.0);
  CHECK(ray.step_to_boundary(vec3(2, 0, 0), vec3(-1, 1, 0)) == 0.0);
  CHECK(ray.step_to_boundary(vec3(2, 0, 0), vec3(1, 0, 0)) == infinity);
  CHECK(wide.project(vec3(1, 3, 4)) == vec3(1, 3, 4));
  CHECK(wide.project(vec3(-1, 3e100, 4e100)).tail<2>() == vec3(0, 3e100, 4e100).tail<2>());
  CHECK(wide.project(vec3(-1, 0, 0)) == zero);
}

TEST_CASE("cone: slanting function in its three regions and on the kinks") {
  oracle::number_source<double> source(9);
  for (int i = 0; i < 90; ++i) {
    double const μ = source.positive_of_size(-1, 1);
    vec3 x = source.direction<3>();
    double const ρ = x.tail<2>().norm();
    // Away from the kinks n = ρ/μ and n = −μρ by at least a tenth of their distance.
    double const between = source.uniform(0.1, 0.9);
    x(0) = i % 3 == 0   ? ρ / μ * (1.1 + source.uniform(0, 3))
           : i % 3 == 1 ? -μ * ρ * (1.1 + source.uniform(0, 3))
                        : between * ρ / μ - (1 - between) * μ * ρ;
    auto const naive_project = [&](auto const& z) {
      return naive::project_cone<float_50, 3>(z, float_50(μ));
    };
    oracle::check_slant(cone(μ), x, naive_project, 1e-15, 8);
  }
  cone const set(2.0);
  CHECK(set.slant(vec3(5, 6, 8)) == Eigen::Matrix3d::Identity());
  CHECK(set.slant(vec3(0, 0, 0)) == Eigen::Matrix3d::Identity());
  CHECK(set.slant(vec3(-20, 6, 8)) == Eigen::Matrix3d::Zero());
  // μ = 1, n = 0: w = (1, e)/√2, θ = 1/2.
  Eigen::Matrix3d expected;
  expected << 0.5, 0.5, 0, 0.5, 0.5, 0, 0, 0, 0.5;
  CHECK((cone(1.0).slant(vec3(0, 1, 0)) - expected).norm() <= 4 * ε);
}

TEST_CASE("cone: steps along generators, through the apex and from outside by rounding") {
  cone const set(2.0);
  vec3 const x(5, 6, 8), zero(0, 0, 0);
  CHECK(set.step_to_boundary(x, -x) == 1.0);
  CHECK(set.step_to_boundary(x, x) == infinity);
  CHECK(set.step_to_boundary(x, zero) == infinity);
  CHECK(set.step_to_boundary(zero, x) == infinity);
  CHECK(set.step_to_boundary(zero, -x) == 0.0);
  CHECK(set.step_to_boundary(zero, vec3(1, 3, 0)) == 0.0);
  vec3 const outside(5 * (1 - 4 * ε), 6, 8);
  CHECK(set.step_to_boundary(outside, vec3(0, 6, 8)) == 0.0);
  CHECK(set.step_to_boundary(outside, vec3(-1, 0, 0)) == 0.0);
  CHECK(set.step_to_boundary(outside, -outside) == doctest::Approx(1.0));
  CHECK(set.step_to_boundary(outside, vec3(0, -6, -8)) == doctest::Approx(2.0));
  oracle::number_source<double> source(11);
  for (int i = 0; i < 2000; ++i) {
    double const μ = source.positive_of_size(-3, 3);
    cone const random(μ);
    vec3 const p = random.project(source.of_size(-100, 100) * source.direction<3>());
    vec3 const d = source.any_size() * source.direction<3>();
    double const α = random.step_to_boundary(p, d);
    CHECK(α >= 0);
    if (α < infinity) CHECK((p + α * d)(0) >= -16 * ε * p(0));
  }
}

TEST_CASE("cone: next to the mantle the digits of the inequality are right") {
  vec3 const x(1.25, 0.6 * (1 + 3 * ε), 0.8);
  float_50 const n = float_50(x(0)) * float_50(0.8);
  float_50 const exact = float_50(x(1)) * float_50(x(1)) + float_50(x(2)) * float_50(x(2)) - n * n;
  CHECK(oracle::ulp_distance<double>(cone(0.8).inequality(x)(0), exact) <= 1);
}

TEST_CASE("plane cone: laws, as a polyhedron and as a cone") {
  slant::testing::set_options const few{.points = 24, .directions = 3};
  slant::testing::check_set_laws(plane(0.7), few);
  slant::testing::check_set_laws(slant::second_order_cone<2>(0.7), few);
  auto flat = few;
  flat.interior = false;
  slant::testing::check_set_laws(plane(0.0), flat);
}

TEST_CASE("plane cone: the set of second_order_cone<2>, its slant at the kinks") {
  plane const set(2.0);
  CHECK(set.project(Vector2d(-1, 3)) == Vector2d(1, 2));
  CHECK(set.project(Vector2d(-2, -1)) == Vector2d(0, 0));
  CHECK(set.slant(Vector2d(1, 2)) == Eigen::Matrix2d::Identity());
  CHECK(set.slant(Vector2d(0, 0)) == Eigen::Matrix2d::Identity());
  CHECK(set.slant(Vector2d(-2, 1)) == Eigen::Matrix2d::Zero());
  Eigen::Matrix2d edge;
  edge << 0.2, -0.4, -0.4, 0.8;
  CHECK((set.slant(Vector2d(0, -1)) - edge).norm() <= 2 * ε);
  CHECK(plane(0.0).project(Vector2d(3, -5)) == Vector2d(3, 0));
  CHECK(plane(0.0).slant(Vector2d(3, 0)) == Vector2d(1, 0).asDiagonal().toDenseMatrix());
  CHECK(set.with(0.5).mu() == 0.5);
}

TEST_CASE("plane cone: linear inequalities") {
  CHECK(plane(0.5).inequality(Vector2d(2, 3)) == Vector2d(2, -4));
  double const almost = 0.1 * 3;  // 0.30000000000000004
  CHECK(plane(0.1).inequality(Vector2d(3, almost))(0) ==
        double(float_50(almost) - float_50(0.1) * float_50(3)));
}

TEST_CASE("friction cones of many contacts, plane and spatial, by name") {
  Vector3d const mu(0.5, 0, 2);
  auto const spatial = slant::friction_cones<3>(mu);
  CHECK(spatial.size() == 9);
  CHECK(spatial.block(2).mu() == 2.0);
  auto const flat = slant::friction_cones<2>(mu);
  CHECK(flat.size() == 6);
  VectorXd const x = VectorXd::LinSpaced(6, -3, 2);
  CHECK(slant::project(flat, x).head<2>() == plane(0.5).project(x.head<2>()));
}

}  // namespace second_order_cone_test
