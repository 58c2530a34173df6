// SPDX-License-Identifier: MIT
//
// contact::solve without factors, against the dual route with factors: another problem, another
// method, another certificate.
#include <slant/contact/solve.hpp>

#include <slant/contact/optimality.hpp>
#include <slant/contact/primal.hpp>
#include <slant/testing/function_breaches.hpp>

#include <doctest/doctest.h>

#include <fem/steel_brick.hpp>
#include "loose_brick.hpp"
#include "support/allocation_guard.hpp"
#include "support/effort.hpp"
#include "support/message.hpp"

#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace iterated_run_test {

namespace contact = slant::contact;
using contact::solution_route;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using sparse = Eigen::SparseMatrix<double>;
using options = contact::solve_options<double>;
constexpr double infinity = std::numeric_limits<double>::infinity();

struct scene {
  sparse K;
  contact::data<double> data;
  contact::node_layout<double> layout;
};

scene brick(int k, fem::brick_load load) {
  auto const s = fem::make_steel_brick({.k = k, .load = load});
  return {s.K, {s.N, s.T, s.f, s.d, s.g}, contact::layout_of(s.mesh.nodes, s.unknowns.first)};
}

double energy(sparse const& K, VectorXd const& u) {
  return std::sqrt(u.dot(VectorXd(K * u)));
}

/// Iterated, and beside the solution of the dual problem, to the tolerance that is asked for.
contact::solution<double> agree(scene const& s, double tolerance = 1e-9) {
  options o{.tolerance = tolerance};
  o.layout = s.layout;
  o.route = solution_route::iterate;
  auto const iterated = contact::solve(s.K, s.data, o);
  auto const factored =
      contact::solve(s.K, s.data, {.tolerance = 1e-12, .route = solution_route::factor});
  CAPTURE(iterated.reason);
  CHECK(iterated.converged());
  CHECK(iterated.choice.route == solution_route::iterate);
  CHECK(iterated.work.factorizations == 0);
  double const size = energy(s.K, factored.u);
  double const error = energy(s.K, VectorXd(iterated.u - factored.u)) / size;
  CHECK(error <= tolerance);
  CHECK(iterated.error.relative() <= tolerance);
  CHECK(iterated.error.relative() >= 0.9 * error - 1e-12);  // that of the reference
  CHECK((iterated.multipliers - factored.multipliers).norm() <=
        1e3 * tolerance * (s.data.f.norm() + factored.multipliers.norm()));
  return iterated;
}

TEST_CASE("bricks with friction: the solution of the dual problem, K never factored") {
  for (auto const load : fem::brick_loads) {
    for (int const k : {2, 4, test::effort(6, 3)}) {
      auto const r = agree(brick(k, load));
      CHECK(r.iterations <= 25);
      CHECK(r.work.inner_iterations <= 80);
      CHECK(r.factorization.find("candidates") != std::string::npos);
    }
  }
}

TEST_CASE("no friction, no slip, infinite gaps, other units, no coordinates") {
  scene s = brick(3, fem::brick_load::lift);
  scene other = s;
  other.data.g.setZero();
  agree(other);
  other.data.g.setConstant(infinity);
  agree(other);
  other = s;
  other.data.g *= 1e6;
  agree(other);
  other = s;
  for (Index i = 0; i < s.data.d.size(); i += 2) other.data.d[i] = infinity;
  agree(other);
  other = s;
  other.data.T.resize(0, s.K.rows());
  other.data.g.resize(0);
  agree(other);
  other = s;
  other.layout = {};
  agree(other);
  VectorXd const u = agree(s).u;
  for (double const force : {0x1p-300, 0x1p300}) {
    for (double const stiffness : {0x1p-300, 0x1p300}) {
      other = s;
      other.K *= stiffness;
      other.data.f *= force;
      other.data.g *= force;
      other.data.d *= force / stiffness;
      if (!(force / stiffness < 0x1p500 && force / stiffness > 0x1p-500)) continue;
      options o;
      o.layout = s.layout;
      o.route = solution_route::iterate;
      auto const r = contact::solve(other.K, other.data, o);
      CAPTURE(force);
      CAPTURE(stiffness);
      CHECK(r.converged());
      CHECK(energy(s.K, VectorXd(r.u * (stiffness / force) - u)) <= 2e-8 * energy(s.K, u));
    }
  }
}

TEST_CASE("in the plane") {
  for (auto const& push : {Eigen::Vector2d(0.6, 0.5), Eigen::Vector2d(0.6, 2)}) {
    auto const s =
        fem::make_contact_scene<2>({.mesh = fem::make_box_mesh<2>({24, 8}, Eigen::Vector2d(3, 1)),
                                    .material = fem::lame(10, 0.3),
                                    .fixed = {.axis = 0, .upper = false},
                                    .contact = {.axis = 1, .upper = false},
                                    .loads = {{{.axis = 1, .upper = true}, Eigen::Vector2d(0, -1)},
                                              {{.axis = 0, .upper = true}, push}},
                                    .slip_bound = 0.3});
    agree({s.K, {s.N, s.T, s.f, s.d, s.g}, contact::layout_of(s.mesh.nodes, s.unknowns.first)});
  }
}

TEST_CASE("rows of N and T in any direction: reflections of the unknowns of a contact") {
  scene const s = brick(3, fem::brick_load::pull);
  Eigen::Matrix3d const Q =
      (Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, -2, 0.5).normalized())).toRotationMatrix();
  std::vector<Eigen::Triplet<double>> entries;
  for (Index i = 0; i < s.K.rows(); i += 3) {
    for (int a = 0; a < 3; ++a) {
      for (int b = 0; b < 3; ++b) entries.emplace_back(int(i) + a, int(i) + b, Q(a, b));
    }
  }
  sparse turn(s.K.rows(), s.K.cols());
  turn.setFromTriplets(entries.begin(), entries.end());
  sparse const back = turn.transpose();
  scene turned = s;
  turned.K = turn * s.K * back;
  turned.data.N = s.data.N * back;
  turned.data.T = s.data.T * back;
  turned.data.f = turn * s.data.f;
  turned.layout.x = Q * s.layout.x;
  CHECK(contact::primal(turned.K, turned.data).turns());
  auto const there = agree(turned), here = agree(s);
  CHECK(energy(s.K, VectorXd(back * there.u - here.u)) <= 3e-9 * energy(s.K, here.u));
  CHECK((there.multipliers - here.multipliers).norm() <= 1e-6 * here.multipliers.norm());
}

TEST_CASE("the choice: by cost, by what is known, and by what can be iterated at all") {
  scene const s = brick(6, fem::brick_load::press);
  options o;
  o.layout = s.layout;
  auto const route_of = [&](scene const& given) {
    auto const r = contact::solve(given.K, given.data, o);
    CHECK(r.converged());
    return r.choice;
  };
  CHECK(route_of(s).route == solution_route::iterate);
  o.costs.cycle = 1;
  CHECK(route_of(s).route == solution_route::factor);
  o.costs = {};
  o.layout = {};
  CHECK(route_of(s).reason == "factored: no coordinates of nodes are given");
  o.layout = s.layout;
  o.prove = true;
  CHECK(route_of(s).reason == "factored: the proof of a bound takes factors");
  o.prove = false;

  scene shared = s;
  std::vector<Eigen::Triplet<double>> twice;
  sparse const Nt = s.data.N.transpose();
  for (Index i = 0; i < s.data.N.rows(); ++i) {
    Index const from = i == 1 ? 0 : i;  // contact 1 presses where contact 0 does
    for (sparse::InnerIterator e(Nt, from); e; ++e) {
      twice.emplace_back(int(i), int(e.row()), e.value());
    }
  }
  shared.data.N.setFromTriplets(twice.begin(), twice.end());
  CHECK(route_of(shared).reason.find("factored: contacts 0 and 1 share unknown") == 0);
  o.route = solution_route::iterate;
  CHECK(test::complaint([&] {
          static_cast<void>(contact::solve(shared.K, shared.data, o));
        }).find("route: got iterate, expected factor or automatic, because contacts 0 and 1") == 0);

  o.route = solution_route::automatic;
  test::loose_brick const loose(1, {-0.3, 0, 0}, 0.05);
  options free;
  free.layout = contact::interleaved_layout(loose.mesh.nodes);
  auto const floats = contact::solve(loose.K, loose.data, free);
  CHECK(floats.converged());
  CHECK(floats.motions.free.size() == 1);
}

TEST_CASE("a K that is not square") {
  scene const s = brick(2, fem::brick_load::press);
  options o;
  o.layout = s.layout;
  for (Index const columns : {s.K.cols() - 3, s.K.cols() + 3}) {
    sparse K = s.K;
    K.conservativeResize(s.K.rows(), columns);
    if (columns > s.K.cols()) K.insert(0, columns - 1) = 1;
    CHECK(test::complaint([&] {
            static_cast<void>(contact::solve(K, s.data, o));
          }).starts_with("columns of K: got " + std::to_string(columns)));
  }
}

TEST_CASE("what does not converge is factored, or says so where it may not be") {
  scene const s = brick(6, fem::brick_load::lift);
  options o{.max_steps = 1};
  o.layout = s.layout;
  o.route = solution_route::iterate;
  auto const cut = contact::solve(s.K, s.data, o);
  CHECK(cut.status == slant::status::iteration_limit);
  CHECK(cut.error.relative() > o.tolerance);
  CHECK(cut.reason.find("asked was 1e-08") != std::string::npos);
  Index steps = 0;
  o.max_steps = 5000;
  o.progress = [&](auto const& step) { steps = step.iteration; };
  auto const r = contact::solve(s.K, s.data, o);
  CHECK(steps == r.iterations);
  CHECK_THROWS_AS((void)contact::solve(s.K, s.data, o, [](auto const&) {}), slant::bad_input);
}

TEST_CASE("the surface is a function with a proximal map; a step on an old face sets nothing up") {
  scene const s = brick(2, fem::brick_load::pull);
  contact::primal const problem(s.K, s.data);
  CHECK(slant::testing::function_breaches(problem.surface(),
                                          {.points = 12, .directions = 2, .size = 1e-3})
            .empty());

  scene const large = brick(test::effort(6, 4), fem::brick_load::pull);
  contact::primal const p(large.K, large.data);
  slant::multigrid const M(p.matrix(), contact::detail::rigid_motions(large.layout));
  auto const qp = p.qp();
  slant::envelope_newton const method{qp, M};
  auto state = method.start(p.zero());
  while (state.reduced_gradient_norm > 1e-9 * state.gradient_scale) method.step(state);
  slant::testing::allocation_guard const guard;
  method.step(state);
  auto const allocations = guard.count();
  CHECK(allocations == 0);
}

}  // namespace iterated_run_test
