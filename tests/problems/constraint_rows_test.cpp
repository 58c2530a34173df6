// SPDX-License-Identifier: MIT
#include <slant/methods/parts/active_rows.hpp>
#include <slant/problems/polyhedral_qp.hpp>

#include <oracle/small_polyhedra.hpp>
#include <support/testing.hpp>

namespace constraint_rows_test {

slant::constraint_rows<double> rows_of(MatrixXd const& b, VectorXd const& c) {
  return {b.sparseView(), c};
}

TEST_CASE("rows that share unknowns are a cluster; those that never act are in none") {
  MatrixXd b = MatrixXd::Zero(6, 7);
  b(0, 1) = 1;
  b(1, 3) = 1;
  b(1, 4) = -1;
  b(2, 4) = 2;
  b(3, 6) = 1;  // infinite bound
  b(5, 0) = 1;  // row 4 is zero
  b(5, 6) = 1;
  auto const rows = rows_of(b, VectorXd{{1, 1, 1, infinity, 0, 2}});
  REQUIRE(rows.clusters().size() == 3);
  CHECK(rows.clusters()[0].rows == std::vector<slant::index>{0});
  CHECK(rows.clusters()[1].rows == std::vector<slant::index>{1, 2});
  CHECK(rows.clusters()[1].unknowns == std::vector<slant::index>{3, 4});
  CHECK(rows.clusters()[2].rows == std::vector<slant::index>{5});
  CHECK(!rows.acts(3));
  CHECK(!rows.acts(4));

  VectorXd const v = VectorXd::LinSpaced(7, 1, 7);
  VectorXd product = VectorXd::Zero(6), sizes = VectorXd::Zero(6);
  rows.for_each_product(v, [&](slant::index i, double value, double size) {
    product[i] = rows.units()[i] * value;
    sizes[i] = rows.units()[i] * size;
  });
  CHECK(product == VectorXd{{2, -1, 10, 0, 0, 8}});
  CHECK(sizes == VectorXd{{2, 9, 10, 0, 0, 8}});
}

TEST_CASE("projections onto the kernel of J, the tangent cone and the set, with redundant rows") {
  std::srand(11);
  for (int round = 0; round < 40; ++round) {
    // Three rows of one cluster, their sum, a copy that is computed differently, a multiple.
    MatrixXd b = MatrixXd::Zero(6, 5);
    b.topRows(3) = MatrixXd::Random(3, 5);
    b.row(3) = b.row(0) + b.row(1);
    b.row(4) = 0.1 * (b.row(2) * 3) / 0.3;
    b.row(5) = 2 * b.row(1);
    VectorXd const x = 3 * VectorXd::Random(5);
    auto const rows = rows_of(b, VectorXd::Zero(6));
    slant::active_rows<double> active(rows);
    unsigned const subset = static_cast<unsigned>(std::rand()) % 64;
    active.assign(rows, [&](slant::index i) { return (subset >> i & 1U) != 0; });

    // Onto ker B^J.
    std::vector<Eigen::Index> chosen;
    for (int i = 0; i < 6; ++i)
      if ((subset >> i & 1U) != 0) chosen.push_back(i);
    MatrixXd const bj = b(chosen, Eigen::all);
    VectorXd const expected =
        chosen.empty() ? x : VectorXd(x - bj.transpose() * test::least_squares(bj.transpose(), x));
    VectorXd φ(5);
    active.project_on_kernel(rows, x, φ);
    CHECK((φ - expected).norm() <= 1e-12 * x.norm());

    // Onto { d : b_iᵀd ≤ 0 for i in J }; the multipliers explain it, whichever rows carry them.
    VectorXd d(5), λ(6);
    active.project_on_cone(rows, x, d, λ);
    auto const cone =
        oracle::minimum_over_polyhedron(MatrixXd::Identity(5, 5), x, bj, VectorXd::Zero(bj.rows()));
    REQUIRE(cone.has_value());
    CHECK((d - cone->u).norm() <= 1e-11 * x.norm());
    CHECK((x - b.transpose() * λ.cwiseQuotient(rows.units()) - d).norm() <= 1e-12 * x.norm());
    CHECK(λ.minCoeff() >= 0);
    CHECK((λ.cwiseQuotient(rows.units()).array() * (b * d).array()).abs().maxCoeff() <=
          1e-11 * x.squaredNorm());
    // Once more, from the rows that were in use.
    VectorXd const again = d;
    active.project_on_cone(rows, x, d, λ);
    CHECK((d - again).norm() <= 1e-12 * x.norm());

    // Onto { B u ≤ c }.
    VectorXd const c = VectorXd::Random(6).cwiseAbs();
    auto const shifted = rows_of(b, c);
    slant::active_rows<double> other(shifted);
    VectorXd u = x;
    CHECK(other.project_on_set(shifted, u, λ));
    auto const nearest = oracle::minimum_over_polyhedron(MatrixXd::Identity(5, 5), x, b, c);
    REQUIRE(nearest.has_value());
    CHECK((u - nearest->u).norm() <= 1e-10 * x.norm());
  }
}

TEST_CASE("a set without points is found out") {
  MatrixXd b(3, 2);
  b << 1, 0, 0, 1, -1, -1;
  VectorXd u = VectorXd::Ones(2), λ(3);
  auto const empty = rows_of(b, VectorXd{{-1, -1, 1}});
  slant::active_rows<double> active(empty);
  CHECK(!active.project_on_set(empty, u, λ));
  auto const point = rows_of(b, VectorXd{{-1, -1, 2}});
  slant::active_rows<double> single(point);
  u.setOnes();
  CHECK(single.project_on_set(point, u, λ));
  CHECK((u - VectorXd{{-1, -1}}).norm() <= 1e-15);
}

TEST_CASE("rows that all but depend on each other: near the set, or said to be empty") {
  std::srand(6);
  int found = 0;
  for (int round = 0; round < 300; ++round) {
    MatrixXd b = MatrixXd::Zero(12, 5);
    b.topRows(4) = MatrixXd::Random(4, 5);
    for (int i = 4; i < 12; ++i)
      b.row(i) = b.row(i % 4) + std::pow(10.0, -8 - round % 9) * MatrixXd::Random(1, 5);
    VectorXd const c = round % 2 == 0 ? VectorXd::Zero(12) : VectorXd(VectorXd::Random(12));
    auto const rows = rows_of(b, c);
    slant::active_rows<double> active(rows);
    VectorXd const start = 100 * VectorXd::Random(5);
    VectorXd u = start, λ(12);
    if (!active.project_on_set(rows, u, λ)) {
      CHECK(round % 2 == 1);  // with c = 0 there is a point
      continue;
    }
    ++found;
    CAPTURE(round);
    VectorXd const size = b.cwiseAbs() * start.cwiseAbs().cwiseMax(u.cwiseAbs()) + c.cwiseAbs();
    CHECK(((b * u - c).array() <= 5000 * 2.2e-16 * size.array()).all());
  }
  CHECK(found >= 150);
}

TEST_CASE("C = V Vᵀ is a projector") {
  std::srand(3);
  MatrixXd b = MatrixXd::Zero(4, 8);
  b.topLeftCorner(3, 4) = MatrixXd::Random(3, 4);
  b(3, 6) = 1;
  auto const rows = rows_of(b, VectorXd::Zero(4));
  slant::active_rows<double> active(rows);
  active.assign(rows, [](slant::index i) { return i != 1; });
  slant::detail::kernel_projector<double> const c(rows, active);
  VectorXd x = VectorXd::Random(8), y(8), z(8);
  for (int k = 0; k < 5; ++k) {
    x.setRandom();
    VectorXd const other = VectorXd::Random(8);
    c.apply(x, y);
    c.apply(y, z);
    CHECK((z - y).norm() <= 1e-14);
    c.apply(other, z);
    CHECK(std::abs(y.dot(other) - x.dot(z)) <= 1e-14);
    CHECK((MatrixXd(b({0, 2, 3}, Eigen::all)) * y).norm() <= 1e-14);
  }
}

TEST_CASE("slacks: tight up to the rounding of what they are the difference of") {
  MatrixXd b(2, 2);
  b << 1, 0, 1, 1;
  auto const rows = rows_of(b, VectorXd{{0, 1}});
  slant::row_slacks<double> s(rows);
  s.measure(rows, VectorXd{{-1e-20, 0.5}});
  CHECK(s.slack[0] == 1e-20);  // nothing has been larger so far
  s.note_sizes(rows, VectorXd{{3, 3}});
  s.measure(rows, VectorXd{{-1e-20, 0.5}});
  CHECK(s.slack[0] == 0);
  CHECK(s.slack[1] == 0.5);
  s.take_tight(rows);
  CHECK(s.active.contains(0));
  CHECK(s.active.size() == 1);
  CHECK(s.first_constraint(rows, VectorXd{{0, 2}}, 0.5, 0.0) == 0.5);
  CHECK(s.first_constraint(rows, VectorXd{{0, 2}}, 0.5, 1.5) == infinity);
  CHECK(s.first_constraint(rows, VectorXd{{0, 2}}, 0.5, 1.0) == 0.5);
  s.advance(rows, VectorXd{{0, 2}}, 0.25);
  s.take_blocking(rows, 0.5);
  CHECK(s.active.size() == 2);
  CHECK(s.slack[1] == 0);
  CHECK(s.changes == 2);
  CHECK(s.rows_changed == 2);
  CHECK(s.leave_along(rows, VectorXd{{-1, 1}}, VectorXd{{-1, 0}}, VectorXd{{0, 0.1}}));
  CHECK(!s.active.contains(0));
  CHECK(s.active.contains(1));  // it has a multiplier
}

TEST_CASE("no allocation after construction") {
  MatrixXd const b = MatrixXd::Random(4, 6);
  auto const rows = rows_of(b, VectorXd::Ones(4));
  slant::row_slacks<double> s(rows);
  VectorXd x = 5 * VectorXd::Ones(6), d(6), λ(4);
  slant::testing::allocation_guard guard;
  s.measure(rows, x);
  (void)s.active.project_on_set(rows, x, λ);
  s.measure(rows, x);
  s.take_tight(rows);
  s.active.project_on_kernel(rows, x, d);
  s.active.project_on_cone(rows, x, d, λ);
  (void)s.leave_along(rows, x, d, λ);
  auto const allocations = guard.count();
  CHECK(allocations == 0);
}

TEST_CASE("bounds that make no sense are named") {
  auto const message = [](MatrixXd const& b, VectorXd const& c) -> std::string {
    return SLANT_COMPLAINT(rows_of(b, c));
  };
  MatrixXd const b{{1, 0}, {0, 0}};
  CHECK(message(b, VectorXd{{1}}) == "c: got 1, expected one entry per row of B, 2");
  CHECK(message(b, VectorXd{{1, -1}}) ==
        "c[1]: got -1, expected a number >= 0, since row 1 of B is zero");
  CHECK(message(b, VectorXd{{-infinity, 1}}) == "c[0]: got -inf, expected a number or +inf");
  CHECK(message(MatrixXd{{infinity}}, VectorXd{{1}}) ==
        "B(0, 0): got inf, expected a finite number");
  CHECK(message(b, VectorXd{{infinity, 0}}) == "nothing thrown");
}

}  // namespace constraint_rows_test
