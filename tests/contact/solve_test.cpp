// SPDX-License-Identifier: MIT
#include <slant/contact/optimality.hpp>

#include <slant/contact/solve.hpp>
#include <slant/contact/solve_options.hpp>
#include <slant/contact/total_feti.hpp>

#include <fem/stacked_bricks.hpp>
#include <support/testing.hpp>
#include "loose_brick.hpp"
#include "scenes.hpp"

namespace solve_test {

using oracle::energy_error;
using slant::status;

contact::solution<double> solve(Eigen::SparseMatrix<double> const& K,
                                contact::data<double> const& c,
                                contact::solve_options<double> const& o = {}) {
  return contact::solve(contact::friction_disc{}, K, c, o);
}

TEST_CASE(
    "contact::solve: what it says of its error is true, on sound bodies and on slender ones") {
  struct body {
    Vector3d size;
    double least;  // accuracy that must be reached
  };
  for (body const& b : {body{{3, 1, 1}, 1e-8}, body{{300, 1, 1}, 1e-8}, body{{3, 1, 1e-2}, 1e-8},
                        body{{3, 1, 1e-4}, 1e-4}}) {
    for (auto const load : fem::brick_loads) {
      // The reference, which factors A, solves the slender brick under one load only.
      if (b.size.x() > 3 && load != fem::brick_load::lift) continue;
      auto const scene = fem::make_steel_brick({.k = 1, .load = load, .size = b.size});
      auto const data = test::contact_data(scene);
      auto const reference = test::reference(scene.K, data);
      auto const r = solve(scene.K, data);
      CAPTURE(b.size.transpose());
      double const error = energy_error(scene.K, r.u, reference.u);
      double const slack = 2 * reference.energy_error;
      CHECK(error <= r.error.relative() + slack);
      CHECK(error <= b.least + slack);
      CHECK((r.converged() || r.status == slant::status::stalled));
      if (b.least <= 1e-8) CHECK(r.converged());
      CHECK(r.converged() == (r.error.relative() <= 1e-8));
      CHECK(r.reason.find("relative energy error") != std::string::npos);
      CHECK(r.multipliers.size() == 3 * data.nodes());
    }
  }
}

TEST_CASE(
    "contact::solve: a sound scene costs one certificate and is not scaled; each iterate is told") {
  auto const scene = fem::make_steel_brick({.k = 2, .load = fem::brick_load::lift});
  auto const data = test::contact_data(scene);
  std::vector<slant::index> told;
  std::vector<double> gradients;
  contact::solve_options<double> o;
  o.progress = [&](contact::solve_step<double> const& step) {
    told.push_back(step.iteration);
    gradients.push_back(step.reduced_gradient);
  };
  auto const r = solve(scene.K, data, o);
  CHECK(r.converged());
  CHECK(r.corrections == 0);
  CHECK(r.solves == 2);  // for u, and for its residual
  CHECK(r.work.factorizations == 1);
  CHECK_FALSE(r.scaled);
  REQUIRE(told.size() == static_cast<std::size_t>(r.iterations + 1));
  CHECK(told.front() == 0);
  CHECK(told.back() == r.iterations);
  CHECK(gradients.back() < 1e-3 * gradients.front());
  CHECK(r.condition > 100);
  CHECK(r.condition < 1e6);

  auto const proven = solve(scene.K, data, {.tolerance = 1e-6, .prove = true});
  CHECK(proven.converged());
  CHECK(proven.error.proven);
  CHECK(proven.work.factorizations == 2);
}

TEST_CASE("contact::solve: rows of N and T scaled over sixteen or 270 orders of magnitude") {
  auto const scene = fem::make_steel_brick({.k = 2, .load = fem::brick_load::pull});
  auto const data = test::contact_data(scene);
  auto const reference = test::reference(scene.K, data);
  for (double const most : {27.0, 450.0}) {
    auto other = data;
    std::mt19937 random(1);
    std::uniform_real_distribution<double> exponent(-most, most);
    VectorXd rows(data.nodes()), pairs(2 * data.nodes());
    for (slant::index i = 0; i < data.nodes(); ++i) {
      rows(i) = std::exp2(exponent(random));
      pairs.segment<2>(2 * i).setConstant(std::exp2(exponent(random)));
      other.d(i) *= rows(i);
      other.g(i) /= pairs(2 * i);
    }
    other.N = Eigen::SparseMatrix<double>(rows.asDiagonal() * data.N);
    other.T = Eigen::SparseMatrix<double>(pairs.asDiagonal() * data.T);
    auto const r = solve(scene.K, other);
    CHECK(r.converged());
    CHECK(r.scaled);
    CHECK(energy_error(scene.K, r.u, reference.u) <= 1e-8);
    CHECK(r.iterations <= 60);
    auto const again = solve(scene.K, other, {.start = r.multipliers});
    CHECK(again.work.operator_applications < r.work.operator_applications / 2);
  }
}

TEST_CASE("contact::solve: tangents that nothing moves, in any units of force") {
  // Contacts on a plane of symmetry: one of two rows of T is zero.
  MatrixXd K = MatrixXd::Zero(6, 6), N = MatrixXd::Zero(3, 6), T = MatrixXd::Zero(6, 6);
  VectorXd const stiff{{1, 1, 1, 1, 5, 20}};
  for (int i = 0; i < 6; ++i) {
    K(i, i) = 2 * stiff[i] * stiff[i];
    if (i > 0) K(i, i - 1) = K(i - 1, i) = -stiff[i] * stiff[i - 1];
  }
  N(0, 0) = N(1, 2) = N(2, 4) = T(0, 1) = T(2, 3) = T(4, 5) = 1;
  T(3, 4) = 0.3;
  VectorXd const f{{1, -0.3, 0.5, 0.8, 2, -3}}, d{{0, 0.1, 0.2}}, g{{0.2, 0.4, 1}};
  sparse const k = K.sparseView(), n = N.sparseView(), t = T.sparseView();
  contact::data<double> const data{n, t, f, d, g};
  auto const reference = solve(k, data, {.tolerance = 1e-12});
  REQUIRE(reference.converged());
  auto const found = contact::check_optimality(k, data, reference.u, reference.multipliers);
  CHECK(found.residual() <= 1e-10);
  for (double const unit : {1e20, 1e5, 1e-6, 1e-8, 1e-12, 1e-20}) {
    CAPTURE(unit);
    auto const r = solve(unit * k, {n, t, unit * f, d, unit * g});
    CHECK(r.converged());
    CHECK(energy_error(k, r.u, reference.u) <= 1e-8);
  }
  // One contact that slides along its only tangent: nothing is lost in the rounding of its gap.
  sparse const row = MatrixXd{{1, 0}}.sparseView();
  sparse const rows = MatrixXd{{1, 0}, {0, 0}}.sparseView();
  for (int i = 0; i < 100; ++i) {
    sparse const body = MatrixXd{{1 + 0.02 * i, 0.2}, {0.2, 1.7}}.sparseView();
    auto const r =
        solve(body, {row, rows, VectorXd{{-2, 0.9 + 0.002 * i}}, VectorXd{{0}}, VectorXd{{0.6}}});
    CAPTURE(r.reason);
    CHECK(r.converged());
  }
}

TEST_CASE("contact::solve: stiffness contrast of twelve orders of magnitude") {
  auto const scene = fem::make_steel_brick({.k = 2, .load = fem::brick_load::lift});
  auto data = test::contact_data(scene);
  std::mt19937 random(4);
  std::uniform_real_distribution<double> exponent(-6, 6);
  VectorXd s(scene.K.rows() / 3);
  for (double& entry : s) entry = std::pow(10, exponent(random) / 2);
  VectorXd scale(scene.K.rows());
  for (slant::index i = 0; i < scale.size(); ++i) scale(i) = s(i / 3);
  // D K D: a body whose nodes differ in stiffness by up to 1e12.
  Eigen::SparseMatrix<double> const half = scale.asDiagonal() * scene.K;
  Eigen::SparseMatrix<double> const K = half * scale.asDiagonal();
  auto const reference = test::reference(K, data);
  auto const r = solve(K, data);
  double const error = energy_error(K, r.u, reference.u), slack = 2 * reference.energy_error;
  CHECK(error <= r.error.relative() + slack);
  CHECK(error <= 1e-6);
}

TEST_CASE("contact::solve: tolerance 0 goes on to the last digits and says that they are") {
  auto const scene = fem::make_steel_brick({.k = 1, .load = fem::brick_load::lift});
  auto const data = test::contact_data(scene);
  auto const reference = test::reference(scene.K, data);
  auto const r = solve(scene.K, data, {.tolerance = 0});
  CHECK(r.status == slant::status::stalled);
  CHECK(r.reason.find("rounding errors allow no more") != std::string::npos);
  CHECK(r.error.relative() <= 1e-12);
  CHECK(energy_error(scene.K, r.u, reference.u) <= r.error.relative() + 2 * reference.energy_error);
}

TEST_CASE("contact::solve: a law that is named is the one that the rows of T stand for") {
  auto const scene = fem::make_steel_brick({.k = 2, .load = fem::brick_load::press});
  auto data = test::contact_data(scene);
  auto const of_data = contact::solve(scene.K, data);
  auto const named = contact::solve(contact::friction_disc{}, scene.K, data);
  REQUIRE(of_data.converged());
  CHECK(named.u == of_data.u);
  CHECK(named.multipliers == of_data.multipliers);
  CHECK(named.iterations == of_data.iterations);

  CHECK(SLANT_COMPLAINT(contact::solve(contact::friction_line{}, scene.K, data)) ==
        "tangents per contact node: got 2, expected 1 for this friction law");
  data.T.resize(0, data.N.cols());
  data.g.resize(0);
  auto const without = contact::solve(scene.K, data);
  REQUIRE(without.converged());
  CHECK(contact::solve(contact::frictionless{}, scene.K, data).u == without.u);
  CHECK_THROWS_AS((void)contact::solve(contact::friction_disc{}, scene.K, data), slant::bad_input);
}

TEST_CASE("contact::solve: limits, starts, bad input") {
  auto const scene = fem::make_steel_brick({.k = 1, .load = fem::brick_load::press});
  auto const data = test::contact_data(scene);
  auto const early = solve(scene.K, data, {.max_steps = 1});
  CHECK(early.status == slant::status::iteration_limit);
  CHECK(early.iterations == 1);
  CHECK(early.u.allFinite());
  auto const done = solve(scene.K, data);
  contact::solve_options<double> again;
  again.start = done.multipliers;
  auto const warm = solve(scene.K, data, again);
  CHECK(warm.converged());
  CHECK(warm.iterations <= 2);
  again.start = VectorXd::Zero(2);
  CHECK_THROWS_AS((void)solve(scene.K, data, again), slant::bad_input);
  CHECK_THROWS_AS((void)solve(scene.K, data, {.tolerance = 1}), slant::bad_input);
  auto far = data;
  far.d.setConstant(-1);
  far.N.setZero();
  CHECK_THROWS_AS((void)solve(scene.K, far), slant::bad_input);
}

contact::solution<double> solve(test::loose_brick const& b, contact::solve_options<double> o = {}) {
  o.layout = contact::interleaved_layout(b.mesh.nodes);
  o.route = contact::solution_route::factor;
  return solve(b.K, b.data, o);
}

TEST_CASE("contact::solve: bodies without supports that contact or friction holds") {
  struct push {
    char const* by;
    Vector3d end;
    double slip, press = 1;
  };
  // 3 is the area of the top: the pressure 1 presses with 3; 12 nodes.
  for (push const& p : {push{"contact alone", {0, 0, 0}, 0}, push{"friction", {-0.3, 0, 0}, 0.05},
                        push{"friction, nearly all of it", {-0.59, 0, 0}, 0.05},
                        push{"sticking", {-0.3, 0.1, 0}, infinity},
                        push{"contact, one end up", {0, 0, 1.2}, 0.05}}) {
    CAPTURE(p.by);
    test::loose_brick const brick(p.press, p.end, p.slip);
    auto const r = solve(brick);
    CAPTURE(r.reason);
    REQUIRE(r.converged());
    CHECK(r.error.relative() <= 1e-8);
    CHECK_FALSE(r.error.proven);
    CHECK(r.motions.sentence() ==
          "body 0 (unknowns 0 to 107) can move along x, y and z and turn about x, y and z");
    CHECK(r.work.factorizations == 1);
    CHECK(r.multipliers.head(12).sum() == doctest::Approx(3 - p.end.z()));
    double along = 0;
    for (slant::index i = 0; i < 12; ++i) along += r.multipliers(12 + 2 * i);
    CHECK(along == doctest::Approx(p.end.x()));
    // Judged by another run to more digits, and that one by the data alone.
    auto const sharp = solve(brick, {.tolerance = 1e-12});
    CHECK(sharp.error.relative() <= 1e-11);
    CHECK(contact::check_optimality(brick.K, brick.data, sharp.u, sharp.multipliers).residual() <=
          1e-10);
    CHECK(energy_error(brick.K, r.u, sharp.u) <= r.error.relative() + sharp.error.relative());
  }
}

/// ‖u − exact‖_K/‖exact‖_K without the motion that closes the gap h (1 + x τ), and others.
double error_across(test::loose_brick const& b, double h, double τ,
                    contact::solution<double> const& r, VectorXd const& exact) {
  VectorXd e = r.u - exact;
  for (slant::index i = 0; i < b.mesh.nodes.cols(); ++i) {
    e(3 * i) -= h * τ * b.mesh.nodes(2, i);
    e(3 * i + 2) += h * (1 + τ * b.mesh.nodes(0, i));
  }
  auto const& R = r.motions.free.at(0).motions;
  e -= R * VectorXd(R.transpose() * e);
  return energy_error(b.K, VectorXd(exact + e), exact);
}

TEST_CASE("contact::solve: bodies without supports that a gap parts from what holds them") {
  struct push {
    char const* by;
    Vector3d end;
    double slip;
    bool friction = true;
  };
  for (push const& p :
       {push{"contact alone", {0, 0, 0}, 0, false}, push{"friction", {-0.3, 0, 0}, 0.05},
        push{"sticking", {-0.3, 0.1, 0}, infinity}}) {
    CAPTURE(std::string(p.by));
    test::loose_brick brick(1, p.end, p.slip, p.friction);
    auto const floor = brick.mesh.nodes_on({2, false});
    auto const closed = contact::solve(brick.K, brick.data);
    auto const exact = contact::solve(brick.K, brick.data, {.tolerance = 1e-12});
    for (double const τ : {0.0, 0.25}) {
      for (double const h : {1e-6, 1e-2, 0.1, 1.0}) {
        CAPTURE(h);
        for (slant::index i = 0; i < 12; ++i)
          brick.data.d(i) = h * (1 + τ * brick.mesh.nodes(0, floor[std::size_t(i)]));
        auto const r = contact::solve(brick.K, brick.data);
        CAPTURE(r.reason);
        REQUIRE(r.converged());
        CHECK(error_across(brick, h, τ, r, exact.u) <= 1e-8);
        CHECK((brick.data.N * r.u - brick.data.d).maxCoeff() <= 1e-12);
        CHECK(r.work.factorizations == 1);
        // No more problems than without the gap. Where everything sticks, rounding decides how many
        // corrections each of them takes.
        CHECK(r.springs <= closed.springs + 2);
        CHECK(r.work.operator_applications <= 2 * closed.work.operator_applications);
      }
    }
    // Moved so far beside what it deforms, u itself is rounded by more than is asked.
    brick.data.d.setConstant(1e4);
    auto const far = contact::solve(brick.K, brick.data);
    CHECK(far.status == slant::status::stalled);
    CHECK(far.reason.find("the bodies move far beside what they deform") != std::string::npos);
    CHECK(error_across(brick, 1e4, 0, far, exact.u) <= 2 * far.error.relative());
  }
  // Nothing holds it below.
  test::loose_brick sliding(1, {-0.3, 0, 0}, 0.01);
  sliding.data.d.setConstant(0.1);
  CHECK(solve(sliding).reason.ends_with("body 0 (unknowns 0 to 107) moves along -x"));
}

TEST_CASE("contact::solve: a long chain that only its end holds, across any gap") {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(0.5, 1.5);
  for (int const n : {100, 400}) {
    contact::data<double> c;
    c.N.resize(1, n);
    c.N.insert(0, n - 1) = 1;
    c.T.resize(0, n);
    c.f = VectorXd::NullaryExpr(n, [&](Eigen::Index) { return uniform(random) / n; });
    auto const K = test::springs(n, 0, 0);
    for (double const gap : {1e2, 1e4, 1e6}) {
      CAPTURE(n);
      CAPTURE(gap);
      c.d = VectorXd::Constant(1, gap);
      auto const r = contact::solve(contact::frictionless{}, K, c);
      CAPTURE(r.reason);
      // Statically determinate: spring i carries the loads of nodes 0 to i.
      double force = 0, missed = 0, energy = 0;
      for (int i = 0; i + 1 < n; ++i) {
        force += c.f(i);
        double const off = r.u(i) - r.u(i + 1) - force;
        missed += off * off;
        energy += force * force;
      }
      double const error = std::sqrt(missed / energy);
      CHECK((r.converged() || r.status == slant::status::stalled));
      CHECK((r.converged() || gap > 1e5));
      // What is claimed below the tolerance may be a few times too little.
      CHECK(error <= std::max(4 * r.error.relative(), r.converged() ? 1e-8 : 0.0));
      CHECK(r.multipliers(0) == doctest::Approx(c.f.sum()).epsilon(1e-8));
    }
  }
}

/// The least of ½ uᵀKu − fᵀu for u ≤ d and an M-matrix K: nodes leave the contact whose force
/// pulls.
VectorXd below_obstacle(Eigen::SparseMatrix<double> const& K, VectorXd const& f,
                        VectorXd const& d) {
  using matrix = Eigen::Matrix<long double, Eigen::Dynamic, Eigen::Dynamic>;
  using vector = Eigen::Matrix<long double, Eigen::Dynamic, 1>;
  matrix const K_ = MatrixXd(K).cast<long double>();
  vector u = d.cast<long double>();
  for (std::vector<bool> free(std::size_t(f.size()), false);;) {
    vector const force = f.cast<long double>() - K_ * u;
    bool changed = false;
    for (Eigen::Index i = 0; i < f.size(); ++i) {
      if (free[std::size_t(i)] || !(force(i) < 0)) continue;
      free[std::size_t(i)] = changed = true;
    }
    if (!changed) return u.cast<double>();
    matrix held = K_;
    vector load = f.cast<long double>();
    for (Eigen::Index i = 0; i < f.size(); ++i) {
      if (free[std::size_t(i)]) continue;
      held.row(i).setZero();
      held(i, i) = 1;
      load(i) = d(i);
    }
    u = held.partialPivLu().solve(load);
  }
}

TEST_CASE("contact::solve: a chain that nearly floats, what is said of it is true") {
  int const n = 40;
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(0, 1);
  contact::data<double> c;
  c.N.resize(n, n);
  c.N.setIdentity();
  c.T.resize(0, n);
  c.f.resize(n);
  c.d.resize(n);
  for (int i = 0; i < n; ++i) {
    c.f(i) = uniform(random) - 0.3;
    c.d(i) = 0.3 * std::sin(0.3 * i) + 0.2;
  }
  for (double const ground : {1e-6, 1e-8, 1e-10, 1e-12, 1e-14}) {
    CAPTURE(ground);
    auto const K = test::springs(n, ground, 0);
    auto const r = contact::solve(contact::frictionless{}, K, c, {.max_steps = 2000});
    CAPTURE(r.reason);
    VectorXd const exact = below_obstacle(K, c.f, c.d);
    double const error = energy_error(K, r.u, exact);
    CHECK(error <= r.error.relative() + 1e-12);
    // A phase that may take more steps has not met rounding.
    bool const is_short = r.reason.find("limit of 2000 steps") != std::string::npos;
    CHECK(is_short == (r.status == slant::status::iteration_limit));
    CHECK((is_short || r.converged() || r.status == slant::status::stalled));
  }
}

TEST_CASE("contact::solve: one gap that is wide beside the others") {
  for (double const far : {1e2, 1e10}) {
    auto const scene = fem::make_steel_brick({.k = 2, .load = fem::brick_load::press});
    auto held = test::contact_data(scene);
    held.d(held.nodes() - 1) = far;
    auto const r = solve(scene.K, held, {.prove = true});
    CAPTURE(r.reason);
    CHECK(r.converged());
    CHECK(r.error.proven);
    held.d(held.nodes() - 1) = std::numeric_limits<double>::infinity();
    CHECK(energy_error(scene.K, r.u, solve(scene.K, held, {.tolerance = 1e-12}).u) <= 1e-8);
    test::loose_brick loose(1, {-0.3, 0, 0}, 0.05);
    loose.data.d(4) = far;
    CHECK(solve(loose).converged());
  }
}

TEST_CASE("contact::solve: bodies that nothing holds, and those that are unfit") {
  struct push {
    double press, along, slip;
    char const* motion;
  };
  for (push const& p : {push{1, -0.3, 0.01, "moves along -x"}, push{1, -0.3, 0, "moves along -x"},
                        push{-1, 0, 0.05, "moves along z"}}) {
    test::loose_brick const brick(p.press, {p.along, 0, 0}, p.slip);
    auto const r = solve(brick);
    CHECK(r.status == slant::status::unbounded);
    CHECK(r.reason ==
          "neither contact nor friction holds the bodies under this load: body 0 (unknowns 0 to "
          "107) " +
              std::string(p.motion));
    CHECK(r.motions.dimension() == 6);
    REQUIRE(r.descent.size() == r.u.size());
    CHECK((brick.K * r.descent).norm() <= 1e-12 * brick.K.norm());
    CHECK((brick.data.N * r.descent).maxCoeff() <= 1e-6);
    CHECK(brick.data.f.dot(r.descent) > 0);
  }
  test::loose_brick brick(1, {-0.3, 0, 0}, 0.05);
  auto const early = solve(brick, {.max_steps = 2});
  CHECK(early.status == slant::status::iteration_limit);
  CHECK(early.iterations == 2);
  CHECK(early.reason.find("can move along x") != std::string::npos);
  auto const last = solve(brick, {.tolerance = 0});
  CHECK(last.status == slant::status::stalled);
  CHECK(last.error.relative() <= 1e-11);
  brick.K.coeffRef(0, 0) *= -1;
  CHECK(SLANT_COMPLAINT(solve(brick)).starts_with("K: got pivot"));
}

TEST_CASE("contact::solve: some motions of one of three bodies, and their names") {
  test::loose_brick const one(1, {0, 0, 0}, 0.05);
  auto const n = one.K.rows();
  // Bodies 0 and 1 clamped at x = 0; body 2 held along z there and at the other end, along y at one
  // node.
  std::vector<slant::index> kept;
  for (slant::index body = 0; body < 3; ++body) {
    for (slant::index i = 0; i < n; ++i) {
      bool const at_end = one.mesh.nodes(0, i / 3) == 0 || one.mesh.nodes(0, i / 3) == 3;
      bool const clamped = one.mesh.nodes(0, i / 3) == 0;
      bool const held = body < 2 ? clamped : (i % 3 == 2 && at_end) || i == 1;
      if (!held) kept.push_back(body * n + i);
    }
  }
  auto const thrice = [](sparse const& M) {
    return contact::detail::diagonal_of<double>(std::vector<sparse>(3, M));
  };
  sparse const P = slant::detail::columns_of_identity<double>(3 * n, kept), Pt = P.transpose(),
               own = Pt * thrice(one.K) * P;
  contact::data<double> data{thrice(one.data.N) * P, thrice(one.data.T) * P,
                             Pt * one.data.f.replicate(3, 1), VectorXd::Zero(36),
                             VectorXd::Constant(36, 0.05)};
  contact::solve_options<double> o;
  MatrixXd nodes(3, 3 * one.mesh.nodes.cols());
  nodes << one.mesh.nodes, one.mesh.nodes, one.mesh.nodes;
  auto const all = contact::interleaved_layout(nodes);
  o.layout.x = all.x;
  for (auto const j : kept) {
    o.layout.node.push_back(all.node[std::size_t(j)]);
    o.layout.axis.push_back(all.axis[std::size_t(j)]);
  }
  auto const r = solve(own, data, o);
  CAPTURE(r.reason);
  CHECK(r.converged());
  REQUIRE(r.motions.free.size() == 1);
  CHECK(r.motions.free[0].number == 2);
  CHECK(r.motions.dimension() == 2);
  CHECK(r.motions.sentence() == "body 2 (unknowns 162 to 250) can move along x and turn about z");
  // The load pulls all along x: only the last one gives way.
  for (slant::index j = 0; j < own.rows(); ++j)
    if (o.layout.axis[std::size_t(j)] == 0) data.f(j) += 0.05;
  auto const pulled = solve(own, data, o);
  CHECK(pulled.status == slant::status::unbounded);
  CHECK(pulled.reason.find("body 2") != std::string::npos);
  CHECK(pulled.reason.ends_with("moves along x"));
}

TEST_CASE("contact::solve: what holds a body hardly is seen beside what holds it well") {
  // Two bodies of springs, x: two nodes, y: three; the contacts resist a motion of x by 1e-4 only.
  std::vector<Eigen::Triplet<double>> entries;
  auto const spring = [&](int i, int j) {
    for (int const k : {i, j}) entries.emplace_back(k, k, 1);
    entries.emplace_back(i, j, -1);
    entries.emplace_back(j, i, -1);
  };
  spring(0, 1);
  spring(2, 3);
  spring(2, 4);
  Eigen::SparseMatrix<double> K(5, 5);
  K.setFromTriplets(entries.begin(), entries.end());
  contact::data<double> c;
  double const α = 1e-4;
  c.N.resize(2, 5);
  c.N.insert(0, 0) = α;
  c.N.insert(0, 2) = -1;
  c.N.insert(1, 1) = -α;
  c.N.insert(1, 3) = -1;
  // Rows of zeros say nothing of friction, whether the zeros are stored or not.
  c.T.resize(2, 5);
  c.T.insert(0, 0) = 0;
  c.T.insert(1, 1) = 0;
  c.g = VectorXd::Ones(2);
  c.d = VectorXd::Zero(2);
  for (double const F : {1e-3, 1e-6, 1e-9}) {
    c.f = VectorXd{{F * α, 0.0, -1.0, -2.0, -1.0}};
    // Both contacts press: K u + Nᵀλ = f, N u = 0.
    MatrixXd whole = MatrixXd::Zero(7, 7);
    whole.topLeftCorner(5, 5) = K;
    whole.bottomLeftCorner(2, 5) = c.N;
    whole.topRightCorner(5, 2) = MatrixXd(c.N).transpose();
    VectorXd load = VectorXd::Zero(7);
    load.head(5) = c.f;
    VectorXd const exact = whole.fullPivLu().solve(load).head(5);
    for (double const tolerance : {1e-3, 1e-6, 1e-8}) {
      auto const r = contact::solve(contact::friction_line{}, K, c, {.tolerance = tolerance});
      double const error = energy_error(K, r.u, exact);
      CAPTURE(F);
      CAPTURE(tolerance);
      CAPTURE(r.reason);
      if (r.converged()) CHECK(error <= tolerance);
      if (tolerance == 1e-3) CHECK(r.converged());
      CHECK(r.status != slant::status::unbounded);
    }
  }
}

TEST_CASE("contact::solve: a brick without supports and without a load") {
  test::loose_brick const idle(0, {0, 0, 0}, 0.05);
  auto const r = solve(idle);
  CAPTURE(r.reason);
  CHECK(r.converged());
  CHECK(r.multipliers.norm() == 0);
}

TEST_CASE("contact::solve: a brick that friction holds, or not, in other units") {
  for (double const slip : {0.05, 0.01}) {
    test::loose_brick const given(1, {-0.3, 0, 0}, slip);
    auto const one = solve(given);
    for (double const unit : {0x1p-400, 0x1p400}) {
      CAPTURE(unit);
      test::loose_brick brick = given;
      brick.data.f *= unit;
      brick.data.g *= unit;
      brick.K *= unit;
      auto const scaled = solve(brick);
      CAPTURE(scaled.reason);
      CHECK(scaled.status == one.status);
      if (one.converged()) {
        CHECK(energy_error(given.K, scaled.u, one.u) <=
              1.01 * (scaled.error.relative() + one.error.relative()));
      } else {
        CHECK(scaled.reason == one.reason);
      }
    }
  }
}

TEST_CASE("contact::solve: stacked bricks held by walls and floor, or tipped over") {
  struct push {
    fem::stack_options options;
    bool holds;
    double stiffness = 1, length = 1;
  };
  push const pushes[] = {{{.cells = {3, 2, 1}}, true},
                         {{.cells = {3, 2, 1}, .walls = -0.3}, false},
                         {{.cells = {3, 2, 1}, .top = {-1, -1}}, false, 1e100, 1e80},
                         {{.cells = {3, 2, 1}}, true, 1e-160, 1e-20}};
  for (auto const& [options, holds, stiffness, length] : pushes) {
    auto scene = fem::make_stack(options);
    scene.K *= stiffness;
    scene.f *= stiffness * length;
    scene.c *= length;
    contact::data<double> const data{scene.B, sparse(0, scene.K.rows()), scene.f, scene.c, {}};
    auto const r = contact::solve(scene.K, data);
    CHECK(r.motions.sentence() ==
          "body 0 (unknowns 0 to 71) has 6 free motions; body 1 (unknowns 72 to 143) has 6 free "
          "motions");
    CAPTURE(r.reason);
    CHECK(r.status == (holds ? status::converged : status::unbounded));
    if (holds) {
      CHECK(contact::check_optimality(scene.K, data, r.u, r.multipliers).residual() <= 1e-6);
      continue;
    }
    CHECK((scene.K * r.descent).norm() <= 1e-12 * scene.K.norm());
    CHECK((scene.B * r.descent).maxCoeff() <= 1e-6);
    CHECK(scene.f.dot(r.descent) >= 1e-3 * scene.f.stableNorm());
  }
}

TEST_CASE("contact::solve: two bricks held by friction, their unknowns in any order") {
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
  contact::data<double> data{sparse(m, n), sparse(2 * m, n), scene.f, VectorXd::Zero(m),
                             VectorXd::Constant(m, 0.1)};
  data.N.setFromTriplets(normal.begin(), normal.end());
  data.T.setFromTriplets(tangential.begin(), tangential.end());
  auto const r = contact::solve(scene.K, data);
  CAPTURE(r.reason);
  REQUIRE(r.converged());
  CHECK(contact::check_optimality(scene.K, data, r.u, r.multipliers).residual() <= 1e-6);

  Eigen::PermutationMatrix<Eigen::Dynamic> P(n);
  for (Eigen::Index i = 0; i < n; ++i)
    P.indices()[i] = int(i < n / 2 ? 2 * i : 2 * (i - n / 2) + 1);
  contact::data<double> const mixed{sparse(data.N * P.transpose()), sparse(data.T * P.transpose()),
                                    P * data.f, data.d, data.g};
  sparse const K = P * scene.K * P.transpose();
  auto const s = contact::solve(K, mixed);
  CHECK(s.motions.free[1].text == "body 1 (54 of the unknowns 1 to 107) has 6 free motions");
  REQUIRE(s.converged());
  CHECK(contact::check_optimality(K, mixed, s.u, s.multipliers).residual() <= 1e-6);
  CHECK(energy_error(scene.K, P.transpose() * s.u, r.u) <=
        1.01 * (s.error.relative() + r.error.relative()));
}

TEST_CASE("contact::solve_options: values out of range are named") {
  using options = slant::contact::solve_options<double>;
  CHECK(test::complaint([] { options{}.validate(); }) == "nothing thrown");
  CHECK(test::complaint([] { options{.tolerance = 0}.validate(); }) == "nothing thrown");
  CHECK(
      test::complaint([] { options{.tolerance = 1}.validate(); }).starts_with("tolerance: got 1"));
  CHECK(test::complaint([] { options{.max_steps = -1}.validate(); }) ==
        "max_steps: got -1, expected at least 0");
  CHECK(slant::contact::solution<double>{}.motions.dimension() == 0);
}

}  // namespace solve_test
