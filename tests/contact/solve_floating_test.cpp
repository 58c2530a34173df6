// SPDX-License-Identifier: MIT
#include "loose_brick.hpp"

#include <slant/contact/solve_floating.hpp>

#include <doctest/doctest.h>

#include <fem/stacked_bricks.hpp>
#include <limits>
#include <oracle/dense_contact_reference.hpp>
#include <string>
#include <support/message.hpp>
#include <vector>

namespace solve_floating_test {

using Eigen::VectorXd;
using slant::status;
using slant::contact::solve_floating;
using sparse = Eigen::SparseMatrix<double>;
constexpr double infinity = std::numeric_limits<double>::infinity();

struct loose_brick : test::loose_brick {
  slant::contact::floating_options<double> options{};

  loose_brick(double press, Eigen::Vector3d const& end, double slip, bool friction = true)
      : test::loose_brick(press, end, slip, friction) {
    options.layout = slant::contact::interleaved_layout(mesh.nodes);
  }
  [[nodiscard]] auto solve() const { return solve_floating(K, data, options); }
};

TEST_CASE("a brick without its clamp: friction holds it, or it slides away") {
  // 3 is the area of the top: the pressure 1 presses with 3, the end is pushed with 0.3.
  loose_brick const held(1, {-0.3, 0, 0}, 0.05);  // 12 nodes hold 0.6
  auto const r = held.solve();
  CAPTURE(r.reason);
  REQUIRE(r.converged());
  CHECK(r.method == "constrained_newton");
  CHECK(r.residual <= 1e-8);
  CHECK(r.motions.dimension() == 6);
  CHECK(r.lambda.head(12).sum() == doctest::Approx(3));
  // The same by a clamp so weak that it carries nothing, without the library.
  sparse weak = held.K;
  for (int j = 0; j < weak.rows(); ++j) weak.coeffRef(j, j) *= 1 + 1e-11;
  auto const other = slant::contact::check_optimality(weak, held.data, r.u, r.lambda);
  CHECK(other.residual() <= 1e-6);
  double along = 0;
  for (int i = 0; i < 12; ++i) along += r.lambda[12 + 2 * i];
  CHECK(along == doctest::Approx(-0.3));

  loose_brick const weaker(1, {-0.3, 0, 0}, 0.01);  // 0.12 < 0.3
  auto const slides = weaker.solve();
  CHECK(slides.status == status::unbounded);
  CHECK(slides.reason ==
        "neither contact nor friction holds the bodies under this load: body 0 (unknowns 0 to 107)"
        " moves along -x");
  CHECK(slides.descent.dot(weaker.data.f) > 0);

  for (bool const friction : {true, false}) {
    loose_brick const smooth(1, {-0.3, 0, 0}, 0, friction);
    auto const s = smooth.solve();
    CHECK(s.status == status::unbounded);
    CHECK(s.method == "schur_contact");
    CHECK(s.reason.ends_with("body 0 (unknowns 0 to 107) moves along -x"));
    loose_brick const still(1, {0, 0, 0}, 0, friction);
    auto const t = still.solve();
    CAPTURE(t.reason);
    CHECK(t.converged());
    CHECK(t.residual <= 1e-8);
    CHECK(t.lambda.size() == (friction ? 36 : 12));
    CHECK(t.lambda.head(12).sum() == doctest::Approx(3));
  }
}

TEST_CASE("lifted, without a load, stuck, in other units") {
  loose_brick const lifted(-1, {0, 0, 0}, 0.05);
  auto const r = lifted.solve();
  CHECK(r.status == status::unbounded);
  CHECK(r.reason.ends_with("moves along z"));
  loose_brick const idle(0, {0, 0, 0}, 0.05);
  CHECK(idle.solve().converged());
  CHECK(idle.solve().lambda.norm() == 0);
  loose_brick const stuck(1, {-0.3, 0.1, 0}, infinity);
  CHECK(stuck.solve().converged());
  CHECK((stuck.data.T * stuck.solve().u).norm() <= 1e-9 * stuck.solve().u.norm());
  for (double const unit : {0x1p-400, 0x1p400}) {
    for (bool const holds : {true, false}) {
      loose_brick brick(1, {-0.3, 0, 0}, holds ? 0.05 : 0.01);
      auto const one = brick.solve();
      brick.data.f *= unit;
      brick.data.g *= unit;
      brick.K *= unit;
      auto const scaled = brick.solve();
      CHECK(scaled.status == one.status);
      CHECK((holds || scaled.reason == one.reason));
      CHECK((scaled.lambda / unit - one.lambda).norm() <= 1e-9 * one.lambda.norm());
    }
  }
}

TEST_CASE("a gap that parts bodies from what holds them changes nothing") {
  for (bool const friction : {true, false}) {
    CAPTURE(friction);
    loose_brick brick(1, {friction ? -0.3 : 0, 0, 0}, 0.05, friction);
    auto const closed = brick.solve();
    for (double const gap : {1e-3, 0.1, 1.0}) {
      CAPTURE(gap);
      brick.data.d.setConstant(gap);
      auto const r = brick.solve();
      CAPTURE(r.reason);
      REQUIRE(r.converged());
      CHECK(r.iterations <= closed.iterations + 2);
      CHECK((brick.data.N * r.u - brick.data.d).maxCoeff() <= 1e-12);
      CHECK((r.lambda - closed.lambda).norm() <= 1e-7 * closed.lambda.norm());
    }
  }
  loose_brick sliding(1, {-0.3, 0, 0}, 0.01);
  sliding.data.d.setConstant(0.1);
  CHECK(sliding.solve().reason.ends_with("moves along -x"));
}

TEST_CASE("stacked bricks: held by walls and floor, tipped over, unknowns in another order") {
  struct push {
    fem::stack_options options;
    bool holds;
  };
  push const pushes[] = {{{.cells = {3, 2, 1}}, true},
                         {{.cells = {3, 2, 1}, .walls = -0.3}, false},
                         {{.cells = {3, 2, 1}, .top = {-1, -1}}, false}};
  for (auto const& [options, holds] : pushes) {
    auto const scene = fem::make_stack(options);
    slant::contact::data<double> data{scene.B, sparse(0, scene.K.rows()), scene.f, scene.c, {}};
    auto const r = solve_floating(scene.K, data);
    CHECK(r.motions.sentence() ==
          "body 0 (unknowns 0 to 71) has 6 free motions; body 1 (unknowns 72 to 143) has 6 free "
          "motions");
    CAPTURE(r.reason);
    CHECK(r.status == (holds ? status::converged : status::unbounded));
    if (holds) {
      CHECK(r.residual <= 1e-8);
      continue;
    }
    CHECK((scene.K * r.descent).norm() <= 1e-12 * scene.K.norm());
    CHECK((scene.B * r.descent).maxCoeff() <= 1e-6);
    CHECK(scene.f.dot(r.descent) >= 1e-3 * scene.f.norm());
  }
}

TEST_CASE("two bricks, friction between them and to the floor; the unknowns of both mixed") {
  auto const scene = fem::make_stack({.cells = {2, 2, 1}, .walls = 0.1, .top = {1, 1}});
  // Floor and joint with friction, without the walls.
  auto const n = scene.K.rows();
  std::vector<Eigen::Triplet<double>> normal, tangential;
  int m = 0;
  for (std::size_t row = 0; row < scene.axes.size(); ++row) {
    if (scene.axes[row] != 2) continue;
    for (Eigen::Index j = 0; j < n; ++j) {
      double const value = scene.B.coeff(Eigen::Index(row), j);
      if (value == 0) continue;
      normal.emplace_back(m, int(j), value);
      tangential.emplace_back(2 * m, int(j) - 2, value);
      tangential.emplace_back(2 * m + 1, int(j) - 1, value);
    }
    ++m;
  }
  slant::contact::data<double> data{sparse(m, n), sparse(2 * m, n), scene.f, VectorXd::Zero(m),
                                    VectorXd::Constant(m, 0.1)};
  data.N.setFromTriplets(normal.begin(), normal.end());
  data.T.setFromTriplets(tangential.begin(), tangential.end());
  auto const r = solve_floating(scene.K, data);
  CAPTURE(r.reason);
  REQUIRE(r.converged());
  CHECK(r.residual <= 1e-8);

  Eigen::PermutationMatrix<Eigen::Dynamic> P(n);
  for (Eigen::Index i = 0; i < n; ++i)
    P.indices()[i] = int(i < n / 2 ? 2 * i : 2 * (i - n / 2) + 1);
  slant::contact::data<double> mixed{sparse(data.N * P.transpose()), sparse(data.T * P.transpose()),
                                     P * data.f, data.d, data.g};
  sparse const K = P * scene.K * P.transpose();
  auto const s = solve_floating(K, mixed);
  CHECK(s.motions.free[1].text == "body 1 (54 of the unknowns 1 to 107) has 6 free motions");
  REQUIRE(s.converged());
  CHECK(s.residual <= 1e-8);
  CHECK((P.transpose() * s.u - r.u).norm() <= 1e-8 * r.u.norm());
}

TEST_CASE("bad input") {
  loose_brick const brick(1, {0, 0, 0}, 0.05);
  auto refused = [&](auto change) {
    auto copy = brick;
    change(copy);
    return test::complaint([&] { (void)copy.solve(); });
  };
  CHECK(refused([](auto& b) { b.options.tolerance = 0; }) ==
        "tolerance: got 0, expected a number in (0, 1)");
  CHECK(refused([](auto& b) { b.options.max_iterations = -1; }) ==
        "max_iterations: got -1, expected a number >= 0");
  CHECK(refused([](auto& b) { b.K.coeffRef(0, 0) *= -1; }).starts_with("K: got a body, number 0,"));
  CHECK(refused([](auto& b) { b.data.g[3] = -1; }).starts_with("g[3]"));
}

}  // namespace solve_floating_test
