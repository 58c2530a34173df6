// SPDX-License-Identifier: MIT
#include <slant/operators/counted.hpp>
#include <slant/sets/sets.hpp>
#include <slant/slanting/kkt_function.hpp>
#include <slant/testing/archetypes.hpp>
#include <slant/testing/laws.hpp>

#include <fem/string_1d.hpp>
#include <support/testing.hpp>
#include "slanting_support.hpp"

namespace kkt_function_test {

using slanting_support::dense_slant;
using slanting_support::random_vector;

/// The wire of [T (4.1)]: bounds, circles, free unknowns.
struct wire_problem {
  fem::wire<> wire;
  double l;
  double g;

  [[nodiscard]] auto set() const {
    return slant::cartesian(slant::half_lines(VectorXd::Constant(wire.m, l).eval()),
                            slant::discs(VectorXd::Constant(wire.m, g).eval()),
                            slant::free_components(wire.m));
  }
  /// [T (2.11)], written down component by component.
  [[nodiscard]] VectorXd value(VectorXd const& y, double ρ) const {
    auto const m = wire.m;
    auto const n = 4 * m;
    VectorXd const x = y.head(n);
    VectorXd F(n + 2 * m);
    F.head(n) = wire.A * x - wire.b;
    for (Eigen::Index i = 0; i < m; ++i) {
      double const λ = y[n + i], μ = y[n + m + i];
      double const x1 = x[i], x2 = x[m + 2 * i], x3 = x[m + 2 * i + 1];
      F[i] -= λ;
      F[m + 2 * i] += 2 * μ * x2;
      F[m + 2 * i + 1] += 2 * μ * x3;
      F[n + i] = λ - std::max(0.0, λ + ρ * (l - x1));
      F[n + m + i] = μ - std::max(0.0, μ + ρ * (x2 * x2 + x3 * x3 - g * g));
    }
    return F;
  }
  /// [T (2.13)] as a dense matrix.
  [[nodiscard]] MatrixXd slant(VectorXd const& y, double ρ) const {
    auto const m = wire.m;
    auto const n = 4 * m;
    MatrixXd G = MatrixXd::Zero(n + 2 * m, n + 2 * m);
    G.topLeftCorner(n, n) = MatrixXd(wire.A);
    for (Eigen::Index i = 0; i < m; ++i) {
      auto const two = m + 2 * i, three = two + 1, row = n + m + i;
      double const λ = y[n + i], μ = y[row], x2 = y[two], x3 = y[three];
      bool const bound = λ + ρ * (l - y[i]) > 0;
      bool const circle = μ + ρ * (x2 * x2 + x3 * x3 - g * g) > 0;
      G(two, two) += 2 * μ;
      G(three, three) += 2 * μ;
      G(i, n + i) = -1;
      G(two, row) = 2 * x2;
      G(three, row) = 2 * x3;
      if (bound) G(n + i, i) = ρ;
      if (!bound) G(n + i, n + i) = 1;
      if (circle) G(row, two) = -2 * ρ * x2;
      if (circle) G(row, three) = -2 * ρ * x3;
      if (!circle) G(row, row) = 1;
    }
    return G;
  }
};

TEST_CASE("the function and the operator of the thesis, to the last digit") {
  wire_problem const p{fem::make_wire(5), -0.3, 0.7};
  auto const n = 4 * p.wire.m;
  auto const set = p.set();
  for (double ρ : {1.0, 0.37, 100.0}) {
    auto const F = slant::kkt(p.wire.A, p.wire.b, set, ρ);
    CHECK(F.rows() == 6 * p.wire.m);
    CHECK(F.unknowns() == n);
    CHECK(F.multipliers() == 2 * p.wire.m);
    for (unsigned seed = 1; seed <= 20; ++seed) {
      VectorXd y = random_vector(F.cols(), seed);
      if (seed == 1) y.setZero();             // circles inactive
      if (seed == 2) y.tail(p.wire.m) *= 40;  // circles active
      VectorXd const hand = p.value(y, ρ);
      CHECK((slant::evaluate(F, y) - hand).cwiseAbs().maxCoeff() <=
            4e-16 * (1 + p.wire.A.coeff(0, 0) + 100 * ρ));
      CHECK(dense_slant(F, y) == p.slant(y, ρ));
    }
  }
}

TEST_CASE("ties are inactive, as in the thesis") {
  wire_problem const p{fem::make_wire(3), 0, 1};
  auto const set = p.set();
  auto const F = slant::kkt(p.wire.A, p.wire.b, set, 1.0);
  auto const G = F.slant(VectorXd::Zero(F.cols()).eval());  // λ + ρ (l − x₁) = 0
  CHECK(G.active() == VectorXd::Zero(6));
}

TEST_CASE("the laws of slanting functions, also where the set is ellipses and intervals") {
  auto const ellipses =
      slant::power(slant::ellipse<>{}, VectorXd{{1.0, 2.0}}, VectorXd{{0.5, 0.3}});
  auto const intervals = slant::intervals(VectorXd{{-1.0, 0.0}}, VectorXd{{0.5, 2.0}});
  auto const set = slant::cartesian(intervals, slant::free_components(1), ellipses);
  MatrixXd const A = slanting_support::random_spd(7, 5);
  VectorXd const b = random_vector(7, 6);
  auto const F = slant::kkt(A, b, set, 0.5);
  CHECK(F.multipliers() == 6);
  for (unsigned seed = 1; seed <= test::effort(5U, 1U); ++seed) {
    slant::testing::check_slanting_laws(F, VectorXd(2 * random_vector(13, seed)),
                                        random_vector(13, 50 + seed));
  }
}

TEST_CASE("λ − max(0, λ + ρ f(x)) does not cancel: z far larger than f loses nothing of it") {
  wire_problem const p{fem::make_wire(3), -0.2, 0.5};
  auto const set = p.set();
  auto const F = slant::kkt(p.wire.A, p.wire.b, set, 2.0);
  VectorXd y = VectorXd::Zero(18);
  y.tail(6).setConstant(1e17);
  CHECK(slant::evaluate(F, y)[12] == 2.0 * -(-0.2 - 0.0));
}

TEST_CASE("one application of A for a value and its slant; nothing allocates") {
  wire_problem const p{fem::make_wire(8), -0.2, 0.5};
  auto const set = p.set();
  auto const A = slant::counted(p.wire.A);
  auto const F = slant::kkt(A, p.wire.b, set, 1.0);
  slanting_support::check_products(F, A, random_vector(F.cols(), 3));
}

TEST_CASE("bad input") {
  wire_problem const p{fem::make_wire(3), 0, 1};
  auto const set = p.set();
  VectorXd const b = VectorXd::Zero(12);
  CHECK_THROWS_WITH_AS(static_cast<void>(slant::kkt(p.wire.A, VectorXd(b.head(5)), set, 1.0)),
                       doctest::Contains("b.size(): got 5, expected 12"), slant::bad_input);
  CHECK(SLANT_COMPLAINT(slant::kkt(p.wire.A, b, set, 0.0)) ==
        "rho: got 0, expected a finite number > 0");
}

TEST_CASE("F and F° for one bound, one free unknown and one circle, in another scalar") {
  Eigen::MatrixXf const A = 4 * Eigen::MatrixXf::Identity(4, 4);
  Eigen::VectorXf const b = Eigen::VectorXf::Ones(4);
  auto const set = slant::cartesian(slant::half_lines<float>(1), slant::free_components<float>(1),
                                    slant::discs(Eigen::VectorXf{{1.0F}}));
  auto const F = slant::kkt(A, b, set, 0.5F);
  Eigen::VectorXf const y{{-1.0F, 2.0F, 1.0F, 2.0F, 3.0F, -0.5F}};
  // μ + ρ (1 + 4 − 1) = 1.5: active; λ + ρ (0 + 1) = 3.5: active
  CHECK(slant::evaluate(F, y) == Eigen::VectorXf{{-8.0F, 7.0F, 2.0F, 5.0F, -0.5F, -2.0F}});
  Eigen::MatrixXf G = Eigen::MatrixXf::Zero(6, 6);
  G.diagonal() << 4, 4, 3, 3, 0, 0;
  G(0, 4) = G(5, 2) = -1;
  G(2, 5) = 2;
  G(3, 5) = 4;
  G(4, 0) = 0.5F;
  G(5, 3) = -2;
  CHECK(dense_slant(F, y) == G);
}

TEST_CASE("vectors of which only the concept is known") {
  using slant::testing::archetype::vector;
  MatrixXd const A = 4 * MatrixXd::Identity(4, 4);
  auto const set = slant::cartesian(slant::half_lines(1), slant::free_components(1),
                                    slant::discs(VectorXd{{1.0}}));
  vector const b(VectorXd::Constant(4, 1.0));
  auto const F = slant::kkt(A, b, set, 0.5);
  vector const y(VectorXd{{-1, 2, 1, 2, 3, -0.5}});
  CHECK(slant::evaluate(F, y).local() == VectorXd{{-8, 7, 2, 5, -0.5, -2}});
  CHECK(dense_slant(F, y).row(4).transpose() == VectorXd{{0.5, 0, 0, 0, 0, 0}});
}

}  // namespace kkt_function_test
