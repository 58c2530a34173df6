// SPDX-License-Identifier: MIT
//
// contact::solve without factors, against the dual route with factors: another problem, another
// method, another certificate.
#include <slant/contact/solve.hpp>

#include <slant/contact/certified_coulomb.hpp>
#include <slant/contact/optimality.hpp>
#include <slant/contact/primal.hpp>
#include <slant/testing/function_breaches.hpp>

#include <fem/box_prolongations.hpp>
#include <fem/stacked_bricks.hpp>
#include <fem/two_bricks.hpp>
#include <fem/two_plates.hpp>
#include <support/testing.hpp>
#include "facing_bricks.hpp"
#include "loose_brick.hpp"
#include "scenes.hpp"
#include "spring_scenes.hpp"
#include "support/chequered_brick.hpp"

namespace iterated_run_test {

using contact::solution_route;
using oracle::energy_error;
using options = contact::solve_options<double>;

struct scene {
  sparse K;
  contact::data<double> data;
  contact::node_layout<double> layout;
  std::vector<sparse> prolongations{};
};

/// Without friction, and without coordinates.
scene bare(sparse K, sparse N, VectorXd f, VectorXd d) {
  auto const n = f.size();
  return {std::move(K), {std::move(N), sparse(0, n), std::move(f), std::move(d), VectorXd(0)}, {}};
}

scene frictionless(scene const& s) {
  auto r = bare(s.K, s.data.N, s.data.f, s.data.d);
  r.layout = s.layout;
  return r;
}

template <int D>
scene scene_of(fem::contact_scene<D> const& s) {
  return {s.K, {s.N, s.T, s.f, s.d, s.g}, contact::layout_of(s.mesh.nodes, s.unknowns.first)};
}

scene brick(int k, fem::brick_load load) {
  return scene_of<3>(fem::make_steel_brick({.k = k, .load = load}));
}

/// Iterated, and beside the solution of the dual problem, to the tolerance that is asked for.
contact::solution<double> agree(scene const& s, double tolerance = 1e-9) {
  options const o{.tolerance = tolerance,
                  .layout = s.layout,
                  .route = solution_route::iterate,
                  .multigrid = {.prolongations = s.prolongations}};
  auto const iterated = contact::solve(s.K, s.data, o);
  auto const factored =
      contact::solve(s.K, s.data, {.tolerance = 1e-12, .route = solution_route::factor});
  CAPTURE(iterated.reason);
  CHECK(factored.error.relative() <= 1e-10);
  CHECK(iterated.converged());
  CHECK(iterated.choice.route == solution_route::iterate);
  CHECK(iterated.work.factorizations == 0);
  double const error = energy_error(s.K, iterated.u, factored.u);
  CHECK(error <= tolerance);
  CHECK(iterated.error.relative() <= tolerance);
  CHECK(iterated.error.relative() >= 0.9 * error - 1e-12);  // that of the reference
  CHECK((iterated.multipliers - factored.multipliers).norm() <=
        1e3 * tolerance * (s.data.f.norm() + factored.multipliers.norm()));
  return iterated;
}

TEST_CASE("bricks with friction: the solution of the dual problem, K never factored") {
  for (auto const load : fem::brick_loads) {
    for (int k = 2; k <= test::effort(6, 3); k += test::effort(2, 1)) {
      auto const r = agree(brick(k, load));
      CHECK(r.iterations <= 25);
      CHECK(r.work.inner_iterations <= 80);
      CHECK(r.factorization.find("candidates") != std::string::npos);
    }
  }
}

TEST_CASE("no slip, infinite gaps, other units, no coordinates") {
  scene s = brick(test::effort(3, 2), fem::brick_load::lift);
  scene other = s;
  other.data.g.setZero();
  agree(other);
  other.data.g.setConstant(infinity);
  agree(other);
  other.data.g = 1e6 * s.data.g;
  agree(other);
  other = s;
  for (Index i = 0; i < s.data.d.size(); i += 2) other.data.d[i] = infinity;
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
      options const o{.layout = s.layout, .route = solution_route::iterate};
      auto const r = contact::solve(other.K, other.data, o);
      CAPTURE(force);
      CAPTURE(stiffness);
      CHECK(r.converged());
      CHECK(energy_error(s.K, r.u * (stiffness / force), u) <= 2e-8);
    }
  }
}

TEST_CASE("no friction: all loads, sizes of a single level, no coordinates") {
  for (auto const load : fem::brick_loads) {
    for (int k = 1; k <= test::effort(6, 2); ++k) {
      CAPTURE(k);
      scene s = frictionless(brick(k, load));
      auto const r = agree(s);
      CHECK(r.work.inner_iterations <= 160);
      if (k == 6) CHECK(r.iterations <= 8);  // from the level below
      s.layout = {};
      CHECK(agree(s).work.inner_iterations <= 200);
    }
  }
}

TEST_CASE("discs on nodes whose unknowns K does not couple, no coordinates") {
  MatrixXd K = 2 * MatrixXd::Identity(15, 15);
  K.diagonal(3).setConstant(-1);
  K.diagonal(-3).setConstant(-1);
  MatrixXd const I = MatrixXd::Identity(15, 15);
  VectorXd f = I.col(0) + I.col(3) + I.col(6) + I.col(7) + I.col(9) - I.col(12);
  f[8] = 0.75;
  sparse const N = I({0, 3, 6, 9, 12}, Eigen::all).sparseView();
  sparse const T = I({1, 2, 4, 5, 7, 8, 10, 11, 13, 14}, Eigen::all).sparseView();
  agree({K.sparseView(), {N, T, f, VectorXd::Zero(5), VectorXd::Constant(5, 0.5)}, {}});
}

TEST_CASE("no friction: no contact, contact everywhere, contact of some nodes, an inclined floor") {
  scene const s = frictionless(brick(3, fem::brick_load::lift));
  Index const m = s.data.d.size();
  scene other = s;
  other.data.d.setConstant(infinity);
  CHECK(agree(other).multipliers == VectorXd::Zero(m));
  other = s;
  other.data.f.setZero();
  for (Index i = 2; i < s.data.f.size(); i += 3) other.data.f[i] = -1;
  CHECK(agree(other).multipliers.minCoeff() > 0);
  other = s;
  other.data.d.head(m / 2).setConstant(infinity);
  CHECK(agree(other).multipliers.head(m / 2) == VectorXd::Zero(m / 2));
  other = frictionless(brick(3, fem::brick_load::pull));
  for (int j = 0; j < s.data.N.outerSize(); ++j) {
    for (sparse::InnerIterator e(s.data.N, j); e; ++e) {
      other.data.N.coeffRef(e.row(), j - 1) = 0.2;
      other.data.N.coeffRef(e.row(), j - 2) = -0.1;
    }
  }
  CHECK(contact::primal(other.K, other.data).turns());
  agree(other);
}

TEST_CASE(
    "no friction: rows of either sign, any size, several entries; a K that is nearly singular") {
  Index const n = 7;
  sparse const K = test::springs(n);
  VectorXd const f{{1, 2, -1, 3, 1, 1, 2}};
  MatrixXd single = MatrixXd::Zero(4, n);
  single(0, 1) = 1;
  single(1, 2) = 4;
  single(2, 4) = -1;
  single(3, 5) = 1;
  VectorXd const gaps{{1.5, 5.0, -9.0, infinity}};
  auto const chain = agree(bare(K, single.sparseView(), f, gaps), 1e-12);
  CHECK(chain.u[1] == 1.5);
  CHECK(chain.u[2] == 1.25);
  CHECK(chain.u[4] == 9);  // pulled up to it
  CHECK(chain.multipliers[3] == 0);
  MatrixXd several = MatrixXd::Zero(3, n);
  several.row(0).head(3) << 1, 1, -0.5;
  several.row(1).segment(3, 2) << -2, 0.25;
  several(2, 6) = 1;
  VectorXd const d{{0.5, 1, 0.1}};
  VectorXd const u = agree(bare(K, several.sparseView(), f, d), 1e-12).u;
  for (double const unit : {0x1p-300, 0x1p300}) {
    CAPTURE(unit);
    auto const s = bare(K, (unit * several).sparseView(0, 0), f, unit * d);
    CHECK((agree(s, 1e-12).u - u).norm() <= 1e-11 * u.norm());
  }
  auto const plane = test::spring_block<2>(8, 1e-2);
  scene const loose = bare(plane.K, plane.contact.N, plane.contact.f, plane.contact.d);
  for (slant::index const coarsest : {600, 50}) {
    options const o{.route = solution_route::iterate, .multigrid = {.coarsest = coarsest}};
    auto const r = contact::solve(loose.K, loose.data, o);
    CHECK(r.converged());
    CHECK(contact::check_optimality(loose.K, loose.data, r.u, r.multipliers).residual() <= 1e-6);
  }
}

TEST_CASE("no friction: rows of one unknown are factored; those that exclude each other") {
  sparse K(3, 3);
  K.setIdentity();
  MatrixXd N = MatrixXd::Zero(5, 3);
  N.col(0).head(3) << 1, 2, 1;
  N.col(2).tail(2) << -1, 1;
  VectorXd const f{{5, 0, -5}}, d{{3, 2, 4, 0.5, 0.5}};
  scene const s = bare(K, N.sparseView(), f, d);
  auto const r = contact::solve(s.K, s.data);
  CHECK(r.converged());
  CHECK((r.u - VectorXd{{1, 0, -0.5}}).norm() <= 1e-8);
  CHECK((r.multipliers - VectorXd{{0, 2, 0, 4.5, 0}}).norm() <= 1e-7);
  scene const none = bare(K, N.sparseView(), f, VectorXd{{3, 2, 4, 0.5, -2}});
  auto const grows = contact::solve(none.K, none.data);
  CHECK(grows.status == slant::status::unbounded);
  CHECK(grows.reason.starts_with("no u satisfies the constraints"));
}

TEST_CASE("what cannot be used is named, an indefinite K is told, on either route") {
  scene const s = frictionless(brick(2, fem::brick_load::press));
  for (auto const route : {solution_route::factor, solution_route::iterate}) {
    options const o{.route = route};
    auto const complaint = [&](auto change) {
      scene other = s;
      change(other);
      return SLANT_COMPLAINT(contact::solve(other.K, other.data, o));
    };
    CHECK(complaint([](scene& x) { x.data.f[5] = std::nan(""); }).starts_with("f[5]: got nan"));
    CHECK(complaint([&](scene& x) {
            x.K = sparse(s.K.topLeftCorner(6, 6));
          }).starts_with("rows of K: got 6"));
    CHECK(complaint([&](scene& x) { x.K.coeffRef(0, 1) += 7; }).starts_with("K"));
    sparse indefinite = s.K;
    double const shift = 0.2 * s.K.diagonal().mean();
    for (Index i = 0; i < indefinite.rows(); ++i) indefinite.coeffRef(i, i) -= shift;
    bool told = false;
    try {
      told = !contact::solve(indefinite, s.data, o).converged();
    } catch (slant::bad_input const&) {
      told = true;
    }
    CHECK(told);
  }
}

TEST_CASE("in the plane") {
  int const cells = test::effort(24, 12);
  for (auto const& push : {Vector2d(0.6, 0.5), Vector2d(0.6, 2)}) {
    auto const s = fem::make_contact_scene<2>(
        {.mesh = fem::make_box_mesh<2>({cells, cells / 3}, Vector2d(3, 1)),
         .material = fem::lame(10, 0.3),
         .fixed = {.axis = 0, .upper = false},
         .contact = {.axis = 1, .upper = false},
         .loads = {{{.axis = 1, .upper = true}, Vector2d(0, -1)},
                   {{.axis = 0, .upper = true}, push}},
         .slip_bound = 0.3});
    agree(scene_of<2>(s));
  }
}

TEST_CASE("two bodies: levels of each, whose unknowns the contact mixes") {
  for (int const p : {3, test::effort(10, 6)}) {
    auto const r = agree(scene_of<3>(fem::make_two_bricks(p)));
    CHECK(r.iterations <= 12);
    CHECK(r.work.inner_iterations <= 5 * r.iterations);  // from levels of the mixed unknowns 10
  }
  agree(scene_of<2>(fem::make_two_plates(8)));
  for (auto const& [p, q] : {std::pair{4, 3}, {test::effort(7, 5), test::effort(9, 7)}, {5, 3}}) {
    CAPTURE(p);
    auto const s = scene_of<3>(test::facing_bricks(p, q));
    auto const r = agree(s);
    CHECK(r.work.inner_iterations <= 6 * r.iterations);
    CHECK(contact::check_optimality(s.K, s.data, r.u, r.multipliers).residual() <= 1e-6);
  }
}

/// A scene and all of it turned.
scene turned(scene const& s) {
  sparse const turn = test::rotation(s.K.rows()), back = turn.transpose();
  scene t = s;
  t.K = turn * s.K * back;
  t.data.N = s.data.N * back;
  t.data.T = s.data.T * back;
  t.data.f = turn * s.data.f;
  if (s.layout.is_known()) t.layout.x = MatrixXd(turn.topLeftCorner(3, 3)) * s.layout.x;
  return t;
}

TEST_CASE("rows of N and T in any direction: reflections of the unknowns of a contact") {
  scene const s = brick(3, fem::brick_load::pull), t = turned(s);
  CHECK(contact::primal(t.K, t.data).turns());
  auto const there = agree(t), here = agree(s);
  CHECK(energy_error(s.K, test::rotation(s.K.rows()).transpose() * there.u, here.u) <= 3e-9);
  CHECK((there.multipliers - here.multipliers).norm() <= 1e-6 * here.multipliers.norm());
}

TEST_CASE("a soft unknown takes the place of a stiff one, and nothing is lost or made symmetric") {
  Eigen::Matrix4d K, E;
  K << 1e12, 3, 0.1, 0, 3, 1, 0.5, 0, 0.1, 0.25, 1, 2, 0, 0, 2, 5;  // the last column is copied
  E << 0, 1, 0, 0, 1, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1;
  Eigen::SparseMatrix<double> sparse = K.sparseView();
  sparse.uncompress();
  CHECK(MatrixXd(contact::detail::congruent<double>(sparse, E.sparseView())) == E * K * E);
}

TEST_CASE("nested meshes: prolongations of the user, their levels begun on the coarser ones") {
  int const k = test::effort(12, 6);
  for (auto const load : fem::brick_loads) {
    if (load != fem::brick_load::lift && !test::is_optimised) continue;
    auto const made = fem::make_steel_brick({.k = k, .load = load});
    scene s = scene_of<3>(made);
    s.layout = {};
    s.prolongations = fem::box_prolongations(fem::make_brick_mesh(k, {3, 1, 1}), made.unknowns);
    auto const r = agree(s);
    CHECK(r.factorization.find("prolongations of the user: levels of") == 0);
    CHECK(r.iterations <= 9);  // 15 from zero
    CHECK(r.work.inner_iterations <= 30);
    if (load != fem::brick_load::lift) continue;
    auto const there = agree(turned(s));
    CHECK(there.iterations <= r.iterations + 1);  // 3 more if E is trusted beyond rough products
    CHECK(there.work.inner_iterations <= r.work.inner_iterations + 3);
    // Without coordinates nobody would know whether the body floats.
    CHECK(contact::solve(s.K, s.data, {.multigrid = {.prolongations = s.prolongations}})
              .choice.reason == "factored: no coordinates of nodes are given");
  }
}

TEST_CASE("two materials: contacts are scaled to one stiffness" *
          doctest::skip(!test::is_optimised)) {
  int const k = 8;
  for (auto const load : {fem::brick_load::press, fem::brick_load::lift}) {
    auto const made = fem::make_steel_brick({.k = k, .load = load});
    for (double const factor : {1e-4, 1e4}) {
      CAPTURE(factor);
      scene s = scene_of<3>(made);
      s.K = test::chequered_stiffness(k, factor);
      auto const by_aggregation = agree(s);
      CHECK(by_aggregation.iterations <= 16);  // 102 and 230 with one scale for all
      CHECK(by_aggregation.work.inner_iterations <= 50);
      s.prolongations = fem::box_prolongations(fem::make_brick_mesh(k, {3, 1, 1}), made.unknowns);
      CHECK(agree(s).iterations <= 16);  // thousands
    }
  }
}

TEST_CASE("the choice: by cost, by what is known, and by what can be iterated at all") {
  scene const s = brick(6, fem::brick_load::press);
  options o{.layout = s.layout};
  auto const route_of = [&](scene const& given) {
    auto const r = contact::solve(given.K, given.data, o);
    CHECK(r.converged());
    return r.choice;
  };
  CHECK(route_of(s).route == solution_route::iterate);
  std::ostringstream out;
  out << contact::solve(s.K, s.data, o);
  CHECK(out.str().find("converged: relative energy error") == 0);
  CHECK(out.str().find("\n  chosen                 iterated: factors are estimated at") !=
        std::string::npos);
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
    for (sparse::InnerIterator e(Nt, from); e; ++e)
      twice.emplace_back(int(i), int(e.row()), e.value());
  }
  shared.data.N.setFromTriplets(twice.begin(), twice.end());
  CHECK(route_of(shared).reason.find("factored: contact 0 shares unknown") == 0);
  o.route = solution_route::iterate;
  CHECK(SLANT_COMPLAINT(contact::solve(shared.K, shared.data, o))
            .find("route: got iterate, expected factor or automatic, because contact 0 shares") ==
        0);

  o.route = solution_route::automatic;
  // Friction alone at a contact, or a gap alone beside contacts with friction.
  for (bool const of_gaps : {true, false}) {
    scene half = s;
    (of_gaps ? half.data.N : half.data.T).prune([](Index row, Index, double) { return row > 1; });
    CHECK(route_of(half).reason.find(of_gaps ? "factored: contact 0 has a row of T and none of N"
                                             : "factored: contact 0 has an empty row of T") == 0);
  }
}

scene loose(double press, Vector3d const& end, double gap) {
  test::loose_brick const s(press, end, 0.05);
  scene r{s.K, s.data, contact::interleaved_layout(s.mesh.nodes)};
  r.data.d.setConstant(gap);
  return r;
}

TEST_CASE("bodies that contact and friction hold: springs that end where they began") {
  for (auto const& end : {Vector3d(0, 0, 0), {-0.1, 0, 0}, {-0.45, 0.2, 0}}) {
    for (double const gap : {0.0, 1e-6, 1e-4}) {
      if (gap != 1e-6 && !test::is_optimised) continue;
      CAPTURE(gap);
      auto const s = loose(0.3, end, gap);
      auto const r = agree(s);
      CHECK(r.springs <= 12);
      CHECK(r.motions.sentence() ==
            "body 0 (unknowns 0 to 107) can move along x, y and z and turn about x, y and z");
      agree(s, 1e-2);  // not before the springs have moved
      CHECK(contact::check_optimality(s.K, s.data, r.u, r.multipliers).residual() <= 1e-6);
    }
  }
  if (!test::is_optimised) return;
  // A gap of 1e4 times the deformation: rounding errors of the way, at any tolerance.
  auto const far = loose(0.3, {-0.1, 0, 0}, 0.02);
  options o{.tolerance = 1e-9, .layout = far.layout, .route = solution_route::iterate};
  VectorXd const exact = contact::solve(far.K, far.data, o).u;
  for (double const tolerance : {1e-1, 1e-2, 1e-4, 1e-6}) {
    o.tolerance = tolerance;
    auto const r = contact::solve(far.K, far.data, o);
    CHECK(r.converged());
    CHECK(energy_error(far.K, r.u, exact) <= tolerance);
  }
  // Nearly sliding after a fall: the first way hides a slow motion.
  for (double const turn : {0.0, -0.2}) {
    auto const slow = loose(0.3, {-0.597, 0.02, turn}, 1e-3);
    o.layout = slow.layout;
    o.tolerance = 1e-9;
    VectorXd const end = contact::solve(slow.K, slow.data, o).u;
    for (double const tolerance : {1e-2, 1e-4}) {
      o.tolerance = tolerance;
      auto const r = contact::solve(slow.K, slow.data, o);
      CHECK(r.converged());
      CHECK(energy_error(slow.K, r.u, end) <= std::min(tolerance, r.error.relative()));
    }
  }
  agree(loose(0.01, {0, 0, -0.5}, 0));  // tips over an edge of the floor, and ends there
  // Three bricks in a corner, the upper ones on the lower, no friction.
  auto const stack =
      fem::make_stack({.bricks = 3, .cells = {4, 2, 2}, .top = {1.5, -0.4}, .gap = 1e-5});
  auto corner = bare(stack.K, stack.B, stack.f, stack.c);
  corner.layout = contact::layout_of(stack.mesh.nodes, stack.unknowns.first);
  agree(corner, 1e-8);
  // Forces of 2^-200, a stiffness of 2^300.
  auto s = loose(0.3, {-0.1, 0, 0}, 1e-6);
  VectorXd const u = agree(s).u;
  s.K *= 0x1p300;
  for (VectorXd* v : {&s.data.f, &s.data.g}) *v *= 0x1p-200;
  s.data.d *= 0x1p-500;
  o.layout = s.layout;
  o.tolerance = 1e-8;
  CHECK((contact::solve(s.K, s.data, o).u * 0x1p500 - u).norm() <= 1e-7 * u.norm());
}

TEST_CASE("the springs of a body move as fast on any mesh") {
  auto const springs = [](int k) {
    auto const mesh = fem::make_box_mesh<2>({3 * k, k}, {3, 1});
    auto const unknowns = fem::number_unknowns(mesh, [](Index) { return false; });
    sparse const K = fem::stiffness<2>(mesh, unknowns, fem::lame(10, 0.3));
    VectorXd f = VectorXd::Zero(K.rows());
    fem::add_tractions<2>(mesh, unknowns, {{{1, true}, {0, -1}}, {{0, true}, {-0.1, 0}}}, f);
    auto const floor = mesh.nodes_on({1, false});
    auto const m = static_cast<Index>(floor.size());
    sparse N(m, K.rows()), T(m, K.rows());
    for (Index i = 0; i < m; ++i) {
      int const first = unknowns.first[floor[static_cast<std::size_t>(i)]];
      N.insert(i, first + 1) = -1;
      T.insert(i, first) = 1;
    }
    double const share = 1 / static_cast<double>(m);
    auto const r = contact::solve(K, {N, T, f, VectorXd::Zero(m), VectorXd::Constant(m, share)},
                                  {.layout = contact::layout_of(mesh.nodes, unknowns.first),
                                   .route = solution_route::iterate});
    CHECK(r.converged());
    return r.springs;
  };
  auto const few = springs(8);
  CHECK(few >= 2);
  CHECK(springs(48) <= few);
}

TEST_CASE("bodies that nothing holds: told by the factors, a stall without them") {
  for (auto const& s : {loose(-0.3, {0, 0, 0}, 0), loose(0.3, {-2, 0, 0}, 0)}) {
    options o{.layout = s.layout};
    auto const r = contact::solve(s.K, s.data, o);
    CHECK(r.status == slant::status::unbounded);
    CHECK(r.motions.free.size() == 1);
    o.route = solution_route::iterate;
    auto const iterated = contact::solve(s.K, s.data, o);
    CHECK(iterated.status == slant::status::stalled);
    CHECK(iterated.error.relative() == infinity);
    CHECK(iterated.reason.find("contact hardly holds bodies without supports") !=
          std::string::npos);
  }
}

TEST_CASE("a K that is not square") {
  scene const s = brick(2, fem::brick_load::press);
  options o{.layout = s.layout};
  for (Index const columns : {s.K.cols() - 3, s.K.cols() + 3}) {
    sparse K = s.K;
    K.conservativeResize(s.K.rows(), columns);
    if (columns > s.K.cols()) K.insert(0, columns - 1) = 1;
    CHECK(SLANT_COMPLAINT(contact::solve(K, s.data, o))
              .starts_with("columns of K: got " + std::to_string(columns)));
  }
}

TEST_CASE("what does not converge is factored, or says so where it may not be") {
  scene const s = brick(6, fem::brick_load::lift);
  options o{.max_steps = 1, .layout = s.layout, .route = solution_route::iterate};
  auto const cut = contact::solve(s.K, s.data, o);
  CHECK(cut.status == slant::status::iteration_limit);
  CHECK(cut.error.relative() > o.tolerance);
  CHECK(cut.reason.find("asked was 1e-08") != std::string::npos);
  o.route = solution_route::automatic;
  o.costs.operation = 1;  // factors seem dear
  auto const both = contact::solve(s.K, s.data, o);
  CHECK(both.choice.route == solution_route::iterate);
  CHECK(both.choice.reason.find("; factored in vain: reached the limit") != std::string::npos);
  CHECK(both.error.relative() == cut.error.relative());
  CHECK(both.work.operator_applications > cut.work.operator_applications);
  o.route = solution_route::iterate;
  // Loads along a foundation without friction: u is 1e10 times the deformation.
  auto const block = test::spring_block<2>(3, 1e-10);
  auto const& l = block.contact;
  scene const loose = bare(block.K, l.N, l.f, l.d);
  auto const floor = contact::solve(loose.K, loose.data, options{.route = solution_route::iterate});
  CHECK(floor.status == slant::status::stalled);
  CHECK(floor.error.relative() > 1e-8);
  Index steps = 0;
  o.max_steps = 5000;
  o.progress = [&](auto const& step) { steps = step.iteration; };
  auto const r = contact::solve(s.K, s.data, o);
  CHECK(steps == r.iterations);
}

TEST_CASE(
    "multigrid that costs preferred, but takes far more cycles, ends at twice what factors cost") {
  for (double const nu : {0.3, 0.4999}) {
    auto const s =
        scene_of<3>(fem::make_steel_brick({.k = 5, .load = fem::brick_load::press, .nu = nu}));
    options o{.layout = s.layout};
    o.costs.hierarchy = o.costs.cycles = 0;  // the fill is not counted before the budget asks
    auto const r = contact::solve(s.K, s.data, o);
    CHECK(r.converged());
    CHECK((r.choice.route == solution_route::iterate) == (nu == 0.3));
    if (nu == 0.3) continue;
    CHECK(r.choice.reason.find("; factored after all: ") != std::string::npos);
    CHECK(r.choice.reason.find("multigrid has cost twice what factors are estimated at") !=
          std::string::npos);
    CHECK(r.work.operator_applications < 2500);
    VectorXd const F = VectorXd::Constant(s.data.nodes(), 0.3);
    contact::certified_coulomb_options<double> own{.layout = s.layout, .costs = o.costs};
    auto const law = contact::certified_coulomb(contact::friction_disc{}, s.K, s.data, F, own);
    CHECK(law.converged());
    CHECK(law.choice.reason.find("multigrid has cost twice") != std::string::npos);
  }
}

TEST_CASE("what factors do not bring to an end is iterated after all") {
  scene const s = scene_of<3>(
      fem::make_steel_brick({.k = 3, .load = fem::brick_load::pull, .size = {3, 1, 0.1}}));
  options o{.max_steps = 10, .layout = s.layout};
  o.costs.cycle = 1;  // multigrid seems dear
  auto const r = contact::solve(s.K, s.data, o);
  CAPTURE(r.reason);
  CHECK(r.converged());
  CHECK(r.choice.route == solution_route::iterate);
  CHECK(r.choice.reason.find("iterated after all: reached the limit of 10") != std::string::npos);
  o.layout = {};
  auto const blind = contact::solve(s.K, s.data, o);
  CHECK(blind.converged());
  CHECK(blind.choice.reason.find("factored: no coordinates of nodes are given; iterated after") ==
        0);
  // Forces that are far off are no reason to end there.
  o.start = VectorXd::Constant(s.data.d.size() + s.data.T.rows(), 1e16);
  for (auto const& layout : {s.layout, options{}.layout}) {
    o.layout = layout;
    auto const far = contact::solve(s.K, s.data, o);
    CHECK(far.converged());
    CHECK(far.choice.route == solution_route::iterate);
    CHECK(energy_error(s.K, far.u, r.u) <= 2e-8);
  }
  o.route = solution_route::factor;
  CHECK(contact::solve(s.K, s.data, o).status == slant::status::iteration_limit);
}

TEST_CASE("a long bar: what rounding leaves of a level may be indefinite") {
  auto const s = scene_of<3>(fem::make_steel_brick({.k = 6, .size = {100, 1, 1}}));
  auto const r =
      contact::solve(s.K, s.data, {.layout = s.layout, .route = solution_route::iterate});
  CHECK(r.converged());
  CHECK(r.work.inner_iterations <= 100);
  CHECK(contact::check_optimality(s.K, s.data, r.u, r.multipliers).residual() <= 1e-4);
}

TEST_CASE("thin bodies over a foundation with uneven gaps") {
  // Newton's steps are cut to 1e-4 and less where a part that is set free is far from stiff.
  for (Eigen::Vector3d const& size : {Eigen::Vector3d(5, 0.4, 0.08), {6, 10, 0.06}}) {
    if (size.y() > 1 && !test::is_optimised) continue;
    for (auto const load : fem::brick_loads) {
      scene s = scene_of<3>(fem::make_steel_brick({.k = 3, .load = load, .size = size}));
      VectorXd& d = s.data.d;
      d.setConstant(infinity);
      scene free = s;
      free.data.g.setZero();
      double const way = (s.data.N * contact::solve(free.K, free.data).u).lpNorm<Eigen::Infinity>();
      for (Index i = 0; i < d.size(); ++i)
        if (i % 3 != 0) d[i] = way * double(i * 11 % 64) / 128;
      CHECK(agree(s, 1e-8).iterations <= 200);
    }
  }
}

TEST_CASE("thin bodies, any tolerance: what is certified is never just short of it") {
  for (double const thickness : {0.1, 0.02, 0.003}) {
    if (thickness < 0.1 && !test::is_optimised) continue;
    for (auto const load : fem::brick_loads) {
      scene const s =
          scene_of<3>(fem::make_steel_brick({.k = 2, .load = load, .size = {3, 1, thickness}}));
      for (double const tolerance : {1e-3, 1e-4, 1e-5, 1e-7, 1e-10}) {
        options o{.tolerance = tolerance, .layout = s.layout, .route = solution_route::iterate};
        auto const r = contact::solve(s.K, s.data, o);
        CAPTURE(thickness);
        CAPTURE(tolerance);
        CAPTURE(r.reason);
        CHECK(r.converged());
        if (load != fem::brick_load::lift) continue;
        auto const coulomb = contact::certified_coulomb(
            contact::friction_disc{}, s.K, s.data,
            VectorXd(VectorXd::Constant(s.data.nodes(), 0.3)),
            {.tolerance = tolerance, .layout = s.layout, .route = solution_route::iterate});
        CAPTURE(coulomb.reason);
        CHECK(coulomb.converged());
      }
    }
  }
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
