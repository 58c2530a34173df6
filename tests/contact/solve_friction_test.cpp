// SPDX-License-Identifier: MIT
#include <slant/contact/solve_friction.hpp>

#include <slant/contact/friction/verify.hpp>

#include <support/testing.hpp>
#include "contact/friction_scenes.hpp"

namespace solve_friction_test {

using slant::contact::friction_method;
using slant::contact::solve_friction;
using slant::contact::verify;
using test::all_methods;
using options = slant::contact::friction_options<double>;

TEST_CASE("solve_friction: every state of one contact, several solutions, redundant contacts") {
  for (auto const& c : test::solvable_cases()) {
    CAPTURE(c.name);
    for (auto const method : all_methods) {
      auto const s = solve_friction(c.problem, {.method = method, .tolerance = 1e-12});
      CHECK(s.converged());
      CHECK(verify(c.problem, s.r).relative_natural_map <= 2e-12);
      CHECK((s.u - (c.problem.W * s.r + c.problem.q)).norm() <= 1e-13 * c.problem.q.norm());
      double nearest = std::numeric_limits<double>::infinity();
      for (auto const& r : c.r) nearest = std::min(nearest, (s.r - r).norm());
      if (!c.infinitely_many) CHECK(nearest <= 1e-10 * (1 + s.r.norm()));
    }
  }
}

TEST_CASE("solve_friction: all methods agree with Gauss–Seidel to 1e-12 where W is definite") {
  for (slant::index const dimension : {2, 3}) {
    for (unsigned const seed : {1U, 2U}) {
      auto const p = test::random_friction(30, dimension, 0.3, seed);
      auto const reference =
          solve_friction(p, {.method = friction_method::gauss_seidel, .tolerance = 1e-13});
      CHECK(reference.converged());
      for (auto const method : all_methods) {
        auto const s =
            solve_friction(p, {.method = method, .tolerance = 1e-12, .first_sweeps = 20});
        CHECK(s.converged());
        CHECK((s.r - reference.r).norm() <= 1e-9 * reference.r.norm());
      }
    }
  }
}

TEST_CASE("solve_friction: contacts four times over, W with a quarter of full rank") {
  auto const p = test::repeated(test::random_friction(12, 3, 0.5, 9), 4);
  auto const single = solve_friction(test::random_friction(12, 3, 0.5, 9), {.tolerance = 1e-12});
  for (auto const method : all_methods) {
    // Contacts between two states have an error of the square root of what rounding leaves of xᵀs.
    double const tolerance = method == friction_method::interior_point ? 1e-8 : 1e-11;
    auto const s = solve_friction(p, {.method = method, .tolerance = tolerance});
    CHECK(s.converged());
    CHECK(verify(p, s.r).relative_natural_map <= 2 * tolerance);
    // Velocities are unique here, forces are not.
    CHECK((s.u.head(36) - single.u).norm() <= 100 * tolerance * single.u.norm());
  }
}

TEST_CASE("solve_friction: contacts stiffer than others by any factor") {
  auto const p = test::random_friction(6, 3, 0.5, 7);
  auto const reference = solve_friction(p, {.tolerance = 1e-12});
  for (double const factor : {1e-6, 1e-10, 1e-16, 1e-60}) {
    // Contacts that do not touch each other, each second one in other units of force.
    auto apart = test::make_friction_problem(MatrixXd::Identity(18, 18), p.q, p.mu);
    auto stiff = apart;
    for (slant::index i = 0; i < 18; ++i) stiff.W.coeffRef(i, i) = i / 3 % 2 == 1 ? factor : 1;
    auto const a = solve_friction(apart), b = solve_friction(stiff);
    CHECK(b.converged());
    CHECK((a.u - b.u).norm() <= 1e-8 * p.q.norm());
  }
  // And where they do: W = D W D, forces D⁻¹ r, velocities D u.
  VectorXd d = VectorXd::Ones(18);
  for (slant::index i = 3; i < 9; ++i) d[i] = 1e-5;
  auto scaled = p;
  scaled.W = MatrixXd(d.asDiagonal() * p.W * d.asDiagonal()).sparseView();
  scaled.q = d.cwiseProduct(p.q);
  auto const s = solve_friction(scaled, {.tolerance = 1e-14});
  CHECK(s.converged());
  CHECK((d.cwiseProduct(s.r) - reference.r).norm() <= 1e-6 * reference.r.norm());
}

TEST_CASE("solve_friction: verdict and forces in any units of W, of q and of single contacts") {
  auto const given = test::repeated(test::random_friction(8, 3, 0.5, 5), 2);
  auto const definite = test::random_friction(8, 3, 0.5, 5);
  for (auto const* p : {&given, &definite}) {
    auto const reference = solve_friction(*p);
    slant::index const n = p->q.size();
    auto const same = [&](double s, double t, VectorXd const& d) {
      auto scaled = *p;
      scaled.W = MatrixXd(d.asDiagonal() * p->W * d.asDiagonal()).sparseView();
      scaled.W *= s;
      scaled.q = t * d.cwiseProduct(p->q);
      auto const r = solve_friction(scaled);
      CHECK(r.converged());
      CHECK(r.error.scaled <= 1e-8);
      CHECK(r.error.scaled == verify(scaled, r.r).unit_free_map);
      CHECK(r.worst.contact == verify(scaled, r.r).worst.contact);
      CHECK(r.reason.starts_with("unit-free natural map "));
      VectorXd const back = s / t * d.cwiseProduct(r.r);
      CHECK(verify(*p, back).unit_free_map <= 1.0001e-8);
      if (p == &definite) CHECK((back - reference.r).norm() <= 1e-7 * reference.r.norm());
      // Where the measures do not agree the reason has both.
      bool const both = r.reason.find("with rho = 1 in the units given") != std::string::npos;
      CHECK(both == (r.error.plain > 1e-8));
    };
    VectorXd const ones = VectorXd::Ones(n);
    for (double const s : {1e6, 1e-6, 1e150, 1e-150}) same(s, 1, ones);
    for (double const t : {1e150, 1e-150}) same(1, t, ones);
    for (double const factor : {1e8, 1e-8}) {
      for (slant::index const i : {0, 5}) {
        VectorXd d = ones;
        d.segment(3 * i, 3).setConstant(factor);
        same(1, 1, d);
      }
    }
  }
}

TEST_CASE(
    "solve_friction: a run that ends without a solution says where the law is violated most") {
  auto const p = test::random_friction(20, 3, 0.4, 3);
  auto const s = solve_friction(p, {.method = friction_method::gauss_seidel, .sweeps = 1});
  CHECK(!s.converged());
  CHECK(s.worst.contact >= 0);
  CHECK(s.worst.value <= s.error.scaled);
  CHECK(s.reason.find("largest at contact " + std::to_string(s.worst.contact)) !=
        std::string::npos);
}

TEST_CASE("solve_friction: contacts that open cost nothing later, a sparse W stays sparse") {
  slant::index const m = 100;
  auto const p = test::chain_friction(m);
  auto const s =
      solve_friction(p, {.method = friction_method::newton, .tolerance = 1e-12, .first_sweeps = 0});
  CHECK(s.converged());
  CHECK(verify(p, s.r).open == m / 2);
  CHECK(s.work.factorizations > 0);
  // The first system may hold more; open contacts leave for good.
  CHECK(s.work.factored_rows <= (s.work.factorizations - 1) * 3 * (m / 2) + 3 * m);
  CHECK(s.work.sparse_factorizations == s.work.factorizations);
  auto const g = solve_friction(p, {.method = friction_method::gauss_seidel, .tolerance = 1e-12});
  CHECK(g.converged());
  // Of 298 blocks the closed contacts need their 50 diagonals; every tenth sweep looks at all.
  CHECK(g.work.block_products < g.work.sweeps * 80 + 4 * 298);
}

TEST_CASE("solve_friction: the interior-point method has its turn where Newton's method fails") {
  auto const p = test::repeated(test::random_friction(12, 3, 0.5, 9), 2);
  // A single step is not enough for Newton's method, and there are no sweeps before.
  options const o{.first_sweeps = 0, .attempt = 1};
  auto const s = solve_friction(p, o);
  CHECK(s.converged());
  CHECK(s.solved_by == friction_method::interior_point);
  CHECK(verify(p, s.r).relative_natural_map <= 1.01e-8);
  CHECK(s.work.sweeps == 0);
  CHECK(s.work.interior_steps > 1);
  CHECK(s.work.newton_steps == s.work.interior_steps + 1);
  CHECK(s.work.factorizations == s.work.newton_steps);
  // Alone it takes the same steps, and without any the others do it.
  auto const alone = solve_friction(p, {.method = friction_method::interior_point});
  CHECK(alone.work.interior_steps == s.work.interior_steps);
  CHECK(alone.r == s.r);
  auto const without = solve_friction(p, {.first_sweeps = 0, .interior_steps = 0, .attempt = 1});
  CHECK(without.converged());
  CHECK(without.work.interior_steps == 0);
  CHECK(without.solved_by != friction_method::interior_point);
}

TEST_CASE("solve_friction: nothing to do, warm starts") {
  auto p = test::chain_friction(10);
  auto const cold = solve_friction(p);
  auto const warm = solve_friction(p, {}, cold.r);
  CHECK(warm.converged());
  CHECK(warm.work.sweeps == 0);
  CHECK(warm.r == cold.r);
  for (slant::index i = 0; i < 10; ++i) p.q[3 * i] = 1;  // all part by themselves
  auto const parted = solve_friction(p);
  CHECK(parted.converged());
  CHECK(parted.r.norm() == 0);
  CHECK(parted.u == p.q);
  CHECK(parted.work.sweeps == 0);
  p.q.setZero();
  CHECK(solve_friction(p).r.norm() == 0);
  CHECK(solve_friction(p, {}, cold.r).r.norm() == 0);
  slant::contact::friction_problem<double> const none;
  auto const empty = solve_friction(none);
  CHECK(empty.converged());
  CHECK(empty.r.size() == 0);
}

TEST_CASE("solve_friction: W that is not symmetric is used as given, or refused") {
  auto p = test::random_friction(10, 3, 0.4, 6);
  p.W.coeffRef(0, 3) += 0.05;
  auto const s = solve_friction(p, {.tolerance = 1e-11});
  CHECK(s.converged());
  CHECK(verify(p, s.r).relative_natural_map <= 2e-11);
  CHECK_THROWS_WITH_AS(
      static_cast<void>(solve_friction(p, {.asymmetry = slant::contact::asymmetric_data::refused})),
      doctest::Contains("asymmetry"), slant::bad_input);
  p.mu[3] = -1;
  CHECK_THROWS_WITH_AS(static_cast<void>(solve_friction(p)), doctest::Contains("mu[3]"),
                       slant::bad_input);
  p.mu[3] = 1;
  CHECK_THROWS_WITH_AS(static_cast<void>(solve_friction(p, {}, VectorXd::Zero(3))),
                       doctest::Contains("start"), slant::bad_input);
}

TEST_CASE("solve_friction: without a solution every method ends with a status, within its limits") {
  for (slant::index const dimension : {2, 3}) {
    auto const c = test::no_solution_case(dimension);
    for (auto const method : all_methods) {
      auto const s =
          solve_friction(c.problem, {.method = method, .sweeps = 5000, .newton_steps = 200});
      CHECK(!s.converged());
      CHECK((s.status == slant::status::iteration_limit || s.status == slant::status::stalled ||
             s.status == slant::status::breakdown));
      CHECK(s.r.allFinite());
      CHECK(s.work.newton_steps <= 200);
      CHECK(s.work.sweeps <= 5000);
      CHECK(s.error.worst() > 1e-8);
      CHECK(s.reason.find(to_string(method)) != std::string::npos);
      CHECK(s.reason.find("unit-free natural map ") != std::string::npos);
      CHECK(s.reason.find("largest at contact 0") != std::string::npos);
      for (slant::index const most : {0, 1, 7, 25, 101}) {
        auto const cut =
            solve_friction(c.problem, {.method = method, .sweeps = most, .newton_steps = most});
        CHECK(cut.work.sweeps <= most);
        CHECK(cut.work.newton_steps <= most);
        CHECK(!cut.converged());
      }
    }
  }
  auto const large = std::numeric_limits<slant::index>::max();
  auto const s = solve_friction(
      test::no_solution_case(3).problem,
      {.first_sweeps = large, .sweeps = 1000, .newton_steps = 100, .attempt = large});
  CHECK(s.work.sweeps <= 1000);
  CHECK(s.work.newton_steps <= 100);
}

TEST_CASE("solve_friction: forces without bound are no solution, and the search for them ends") {
  using Eigen::Matrix3d, Eigen::Vector4d;
  VectorXd const one = VectorXd::Constant(1, 0.5), two = VectorXd::Constant(2, 0.5);
  Matrix3d const flat = Vector3d(0, 1, 1).asDiagonal();
  Eigen::Matrix4d wedge = Eigen::Matrix4d::Identity();
  wedge(0, 2) = wedge(2, 0) = -1;
  for (auto const& p : {test::make_friction_problem(Matrix3d::Zero(), Vector3d(-1, 0, 0), one),
                        test::make_friction_problem(flat, Vector3d(-1, 1, 0), one),
                        test::make_friction_problem(wedge, Vector4d(-1, 0, -1, 0), two),
                        test::make_friction_problem(wedge, Vector4d(-1, 0, 1 - 1e-6, 0), two)}) {
    for (auto const method : all_methods) {
      for (double const start : {0., 1e17}) {
        VectorXd r = VectorXd::Zero(p.q.size());
        for (slant::index i = 0; i < p.contacts(); ++i) r[i * p.dimension()] = start;
        auto const s = solve_friction(p, {.method = method, .sweeps = 20000}, r);
        CHECK(!s.converged());
        CHECK(s.status != slant::status::running);
        CHECK(s.r.allFinite());
      }
    }
    auto const s = solve_friction(p);
    CHECK(s.status == slant::status::stalled);  // no limit was reached
    CHECK(s.work.sweeps < 300000);
    CHECK(s.work.newton_steps < 3000);
  }
}

TEST_CASE("solve_friction: friction without bound, and hardly any") {
  for (double const mu : {1e9, 1e-200}) {
    auto const p = test::make_friction_problem(Eigen::Matrix3d::Identity(), Vector3d(-1, 1, 0),
                                               VectorXd::Constant(1, mu));
    for (auto const method : all_methods) {
      // From inside of a cone that is nearly a half space it is too far to a force.
      if (mu > 1 && method == friction_method::interior_point) continue;
      auto const s = solve_friction(p, {.method = method});
      CHECK(s.converged());
      CHECK((s.r - Vector3d(1, mu > 1 ? -1 : 0, 0)).norm() <= 1e-8);
    }
  }
  auto rough = test::random_friction(10, 3, 1e9, 3);  // all that are closed stick
  auto const s = solve_friction(rough);
  CHECK(s.converged());
  CHECK(verify(rough, s.r).slip == 0);
  for (slant::index i = 0; i < 10; ++i) {
    CHECK(s.u[3 * i] >= -1e-8 * rough.q.norm());
    if (s.r[3 * i] > 1e-6) CHECK(s.u.segment<3>(3 * i).norm() <= 1e-8 * rough.q.norm());
  }
}

TEST_CASE("solve_friction: results outside of the range of numbers are a breakdown") {
  for (double const sign : {1., -1.}) {
    auto const p = test::make_friction_problem(
        std::pow(10., -200 * sign) * Eigen::Matrix3d::Identity(),
        -std::pow(10., 200 * sign) * Vector3d::UnitX(), VectorXd::Constant(1, 0.5));
    auto const s = solve_friction(p);
    CHECK(s.status == slant::status::breakdown);
    CHECK(s.reason.find("range of numbers") != std::string::npos);
  }
}

TEST_CASE("friction options: the defaults are valid, each bad one is named") {
  CHECK(test::complaint([] { options{}.validate(); }) == "nothing thrown");
  struct bad {
    char const* name;
    options o;
  };
  for (auto const& [name, o] :
       {bad{"tolerance", {.tolerance = 0}},
        {"tolerance", {.tolerance = std::numeric_limits<double>::quiet_NaN()}},
        {"first_sweeps", {.first_sweeps = -1}},
        {"sweeps", {.sweeps = -1}},
        {"newton_steps", {.newton_steps = -1}},
        {"interior_steps", {.interior_steps = -1}},
        {"attempt", {.attempt = 0}}}) {
    CAPTURE(name);
    CHECK(test::complaint([&o = o] { o.validate(); }).find(name) != std::string::npos);
  }
}

TEST_CASE("friction options: methods have names") {
  CHECK(to_string(friction_method::automatic) == "automatic");
  CHECK(to_string(friction_method::gauss_seidel) == "gauss_seidel");
  CHECK(to_string(friction_method::newton) == "newton");
  CHECK(to_string(friction_method::interior_point) == "interior_point");
}

}  // namespace solve_friction_test
