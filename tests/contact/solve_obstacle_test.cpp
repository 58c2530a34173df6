// SPDX-License-Identifier: MIT
#include <slant/contact/optimality.hpp>

#include <slant/contact/rigid_body_modes.hpp>
#include <slant/contact/solve_obstacle.hpp>

#include <doctest/doctest.h>

#include <fem/steel_brick.hpp>
#include <support/effort.hpp>
#include "spring_scenes.hpp"

#include <cmath>
#include <limits>

namespace solve_obstacle_test {

using Eigen::VectorXd;
using slant::contact::solution_route;
using slant::contact::solve_obstacle;
using sparse = Eigen::SparseMatrix<double>;
using options = slant::contact::obstacle_options<double>;
using slant::contact::choose_route;
constexpr double infinity = std::numeric_limits<double>::infinity();

options iterate(fem::contact_scene<3> const& s, double tolerance = 1e-12) {
  Eigen::MatrixXd nodes(3, s.f.size() / 3);
  Eigen::Index next = 0;
  for (Eigen::Index i = 0; i < s.mesh.node_count(); ++i) {
    if (!s.unknowns.is_fixed(i)) nodes.col(next++) = s.mesh.nodes.col(i);
  }
  return {.route = solution_route::iterate,
          .tolerance = tolerance,
          .near_kernel = slant::contact::rigid_body_modes(nodes),
          .multigrid = {.coarsest = 100}};
}

options const factor{.route = solution_route::factor, .tolerance = 1e-12};

/// Both routes lead to the same displacements and forces.
slant::contact::obstacle_solution<double> agree(fem::contact_scene<3> const& s, sparse const& N,
                                                VectorXd const& f, VectorXd const& d) {
  auto const a = solve_obstacle(s.K, f, N, d, iterate(s));
  auto const b = solve_obstacle(s.K, f, N, d, factor);
  CHECK(a.converged());
  CHECK(b.converged());
  CHECK(a.work.factorizations == 0);
  CHECK((a.u - b.u).norm() <= 1e-9 * b.u.norm());
  CHECK((a.λ - b.λ).norm() <= 1e-8 * f.norm());
  return a;
}

TEST_CASE("the brick by both routes; cycles hardly grow with the mesh") {
  for (auto const load : fem::brick_loads) {
    for (int k = 2; k <= test::effort(6, 3); k += 2) {
      auto const s = fem::make_steel_brick({.k = k, .load = load});
      auto const a = agree(s, s.N, s.f, s.d);
      CHECK(a.steps <= 30);
      CHECK(a.work.inner_iterations <= 160);
    }
  }
}

/// check_optimality of a solution, which reports the same.
double kkt(sparse const& K, sparse const& N, VectorXd const& f, VectorXd const& d,
           slant::contact::obstacle_solution<double> const& s) {
  slant::contact::data<double> const c{N, sparse(0, f.size()), f, d, VectorXd(0)};
  double const found = slant::contact::check_optimality(K, c, s.u, s.λ).residual();
  CHECK(s.kkt_residual == found);
  return found;
}

TEST_CASE("without a near kernel, at sizes of a single level of multigrid too") {
  for (auto const load : fem::brick_loads) {
    for (int k = 1; k <= test::effort(6, 4); ++k) {
      CAPTURE(k);
      auto const s = fem::make_steel_brick({.k = k, .load = load});
      auto const a = solve_obstacle(s.K, s.f, s.N, s.d, {.route = solution_route::iterate});
      CHECK(a.converged());
      CHECK(a.steps <= 20);
      CHECK(a.work.inner_iterations <= 200);
      CHECK(kkt(s.K, s.N, s.f, s.d, a) <= 1e-9);
    }
  }
  auto const plane = test::spring_block<2>(8, 1e-2);
  auto const& c = plane.contact;
  for (slant::index const coarsest : {600, 50}) {
    auto const a =
        solve_obstacle(plane.K, c.f, c.N, c.d,
                       {.route = solution_route::iterate, .multigrid = {.coarsest = coarsest}});
    CHECK(a.converged());
    CHECK(a.steps <= 20);
    CHECK(kkt(plane.K, c.N, c.f, c.d, a) <= 1e-9);
  }
}

TEST_CASE("a verdict that the check contradicts is none; the factors take over where it is left") {
  auto const s = test::spring_block<2>(3, 1e-6);
  auto const& c = s.contact;
  slant::contact::route_costs costs;
  costs.operation = 1;  // factors seem dear
  auto const a = solve_obstacle(s.K, c.f, c.N, c.d, {.costs = costs});
  CHECK(a.converged());
  CHECK(kkt(s.K, c.N, c.f, c.d, a) <= 1e-8);
  CHECK(a.choice.route == solution_route::factor);
  CHECK(a.choice.reason.find("factored after all, because that ended stalled") !=
        std::string::npos);
  // Loads along a foundation without friction: u is 1e10 times the deformation, and K u − f is
  // rounding of that.
  for (auto const route : {solution_route::factor, solution_route::iterate}) {
    auto const loose = test::spring_block<2>(3, 1e-10);
    auto const& l = loose.contact;
    auto const b = solve_obstacle(loose.K, l.f, l.N, l.d, {.route = route});
    CHECK(b.status == slant::status::stalled);
    CHECK(kkt(loose.K, l.N, l.f, l.d, b) > 1e-8);
  }
}

TEST_CASE("no contact, contact everywhere, gaps that are never closed") {
  auto const s = fem::make_steel_brick({.k = 3, .load = fem::brick_load::lift});
  auto const free = agree(s, s.N, s.f, VectorXd::Constant(s.d.size(), infinity));
  CHECK(free.λ == VectorXd::Zero(s.d.size()));
  CHECK((s.K * free.u - s.f).norm() <= 1e-9 * s.f.norm());
  VectorXd down = VectorXd::Zero(s.f.size());
  for (Eigen::Index i = 2; i < down.size(); i += 3) down[i] = -1;
  auto const closed = agree(s, s.N, down, s.d);
  CHECK(closed.λ.minCoeff() > 0);
  VectorXd half = s.d;
  half.head(half.size() / 2).setConstant(infinity);
  auto const some = agree(s, s.N, s.f, half);
  CHECK(some.λ.head(half.size() / 2) == VectorXd::Zero(half.size() / 2));
}

TEST_CASE("an inclined foundation: rows of three entries; redundant rows") {
  auto const s = fem::make_steel_brick({.k = 3, .load = fem::brick_load::pull});
  sparse inclined = s.N;
  for (int j = 0; j < s.N.outerSize(); ++j) {
    for (sparse::InnerIterator e(s.N, j); e; ++e) {
      inclined.coeffRef(e.row(), j - 1) = 0.2;
      inclined.coeffRef(e.row(), j - 2) = -0.1;
    }
  }
  agree(s, inclined, s.f, s.d);
  sparse twice(2 * s.N.rows(), s.N.cols());
  std::vector<Eigen::Triplet<double>> entries;
  for (int j = 0; j < s.N.outerSize(); ++j) {
    for (sparse::InnerIterator e(s.N, j); e; ++e) {
      auto const row = static_cast<int>(e.row()), below = row + static_cast<int>(s.N.rows());
      entries.emplace_back(row, j, e.value());
      entries.emplace_back(below, j, 2 * e.value());
    }
  }
  twice.setFromTriplets(entries.begin(), entries.end());
  VectorXd const gaps = VectorXd::Zero(twice.rows());
  auto const a = solve_obstacle(s.K, s.f, twice, gaps, iterate(s));
  auto const b = solve_obstacle(s.K, s.f, s.N, s.d, iterate(s));
  CHECK(a.u == b.u);
}

TEST_CASE("units: data of 1e-100 and 1e100") {
  auto const s = fem::make_steel_brick({.k = 2, .load = fem::brick_load::lift});
  auto const one = solve_obstacle(s.K, s.f, s.N, s.d, iterate(s));
  for (double const unit : {1e-100, 1e100}) {
    auto const loads = solve_obstacle(s.K, VectorXd(unit * s.f), s.N, s.d, iterate(s));
    CHECK(loads.converged());
    CHECK((loads.u / unit - one.u).norm() <= 1e-10 * one.u.norm());
    auto const stiff = solve_obstacle(sparse(unit * s.K), s.f, s.N, s.d, iterate(s));
    CHECK(stiff.converged());
    CHECK((stiff.u * unit - one.u).norm() <= 1e-10 * one.u.norm());
  }
}

TEST_CASE("the route is reported; without one it is chosen") {
  auto const s = fem::make_steel_brick({.k = 1});
  auto const r = solve_obstacle(s.K, s.f, s.N, s.d);
  CHECK(r.converged());
  CHECK(r.choice.route == solution_route::factor);
  CHECK(r.work.factorizations == 1);
  auto const limited =
      solve_obstacle(s.K, s.f, s.N, s.d, {.route = solution_route::iterate, .steps = 1});
  CHECK(limited.status == slant::status::iteration_limit);
}

TEST_CASE("what cannot be used is named; an indefinite K is told on either route") {
  auto const s = fem::make_steel_brick({.k = 2});
  VectorXd bad = s.f;
  bad[5] = std::nan("");
  for (auto const route : {solution_route::factor, solution_route::iterate}) {
    options const o{.route = route};
    CHECK_THROWS_AS((void)solve_obstacle(s.K, bad, s.N, s.d, o), slant::bad_input);
    CHECK_THROWS_AS((void)solve_obstacle(s.K, s.f, s.N, VectorXd(s.d.head(3)), o),
                    slant::bad_input);
    sparse const small = s.K.topLeftCorner(6, 6);
    CHECK_THROWS_AS((void)solve_obstacle(small, s.f, s.N, s.d, o), slant::bad_input);
    sparse indefinite = s.K;
    double const shift = 0.2 * s.K.diagonal().mean();
    for (Eigen::Index i = 0; i < indefinite.rows(); ++i) indefinite.coeffRef(i, i) -= shift;
    bool told = false;
    try {
      told = !solve_obstacle(indefinite, s.f, s.N, s.d, o).converged();
    } catch (slant::bad_input const&) {
      told = true;
    }
    CHECK(told);
  }
}

TEST_CASE("small problems are factored, large ones iterated, and both ways the reason is told") {
  auto const s = fem::make_steel_brick({.k = 1});
  auto const small = choose_route(s.K, s.N);
  CHECK(small.route == solution_route::factor);
  CHECK(small.factor_seconds < small.iterate_seconds);
  CHECK(small.reason.starts_with("factored: factors are estimated at "));
  slant::contact::route_costs slow;
  slow.operation = 1;  // seconds
  auto const large = choose_route(s.K, s.N, solution_route::automatic, slow);
  CHECK(large.route == solution_route::iterate);
  CHECK(large.reason.starts_with("iterated: factors are estimated at more than "));
}

TEST_CASE("without supernodes iterating pays earlier") {
  auto const s = fem::make_steel_brick({.k = 5});
  auto const costs = slant::contact::route_costs::without_cholmod();
  auto const plain = choose_route(s.K, s.N, solution_route::automatic, costs);
  auto const blocked =
      choose_route(s.K, s.N, solution_route::automatic, slant::contact::route_costs{});
  CHECK(plain.factor_seconds > blocked.factor_seconds);
  CHECK(plain.iterate_seconds == blocked.iterate_seconds);
}

TEST_CASE("the choice can be forced, but not to what is impossible") {
  auto const s = fem::make_steel_brick({.k = 2});
  for (auto const route : {solution_route::factor, solution_route::iterate}) {
    auto const c = choose_route(s.K, s.N, route);
    CHECK(c.route == route);
    CHECK(c.reason.ends_with("as asked for"));
  }
  sparse const shared = Eigen::MatrixXd::Ones(2, s.K.cols()).sparseView();
  auto const c = choose_route(s.K, shared);
  CHECK(c.route == solution_route::factor);
  CHECK(c.reason == "factored: rows 0 and 1 of N share unknown 0");
  CHECK_THROWS_AS((void)choose_route(s.K, shared, solution_route::iterate), slant::bad_input);
}

}  // namespace solve_obstacle_test
