// SPDX-License-Identifier: MIT
#include "feti_scenes.hpp"
#include "scenes.hpp"

#include <slant/iteration/feasible.hpp>
#include <slant/iteration/solve.hpp>
#include <slant/methods/smalse.hpp>

#include <doctest/doctest.h>

#include <support/dense_of.hpp>
#include <support/effort.hpp>

#include <string>

namespace total_feti_test {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using sparse = Eigen::SparseMatrix<double>;
using slant::contact::friction_disc;
using slant::contact::frictionless;
using slant::contact::total_feti;
using test::decomposed_brick;

TEST_CASE("the displacements of the brick that was not cut, without and with friction") {
  auto const load = fem::brick_load::pull;
  decomposed_brick const brick({2, test::effort(2, 1), 1}, 2, load);
  auto const same = [&](VectorXd const& u, VectorXd const& expected) {
    CHECK((u - expected).norm() <= 1e-8 * expected.norm());
  };
  {
    auto const expected =
        test::reference(brick.scene.K, examples::contact_data(brick.scene, false)).u;
    total_feti const problem(frictionless{}, brick.bodies, brick.data(false));
    auto const qp = problem.qp();
    same(test::displacement(brick, problem, slant::smalse{qp, problem.constraints()}), expected);
  }
  {
    auto const expected =
        test::reference(brick.scene.K, examples::contact_data(brick.scene, true)).u;
    total_feti const problem(friction_disc{}, brick.bodies, brick.data(true));
    auto const qp = problem.qp();
    same(test::displacement(brick, problem, slant::smalse{qp, problem.constraints()}), expected);
    slant::smalse_options<double> options;
    options.newton_multipliers = true;
    slant::smalse const newton{qp, problem.constraints(), options};
    same(test::displacement(brick, problem, newton), expected);
    CHECK(slant::solve(newton, problem.zero(), test::accurate()).iterations() <= 12);
  }
}

TEST_CASE("by dense matrices: F on ker G does not depend on K+, G and e are those of the bodies") {
  decomposed_brick brick({2, 1, 1}, 1, fem::brick_load::lift);
  total_feti const given(friction_disc{}, brick.bodies, brick.data(true));
  brick.bodies.R.clear();  // computed: another basis, other fixing rows
  total_feti const computed(friction_disc{}, brick.bodies, brick.data(true));
  MatrixXd const P = test::dense_of(given.constraints().kernel_projector());
  MatrixXd const F = P * test::dense_of(given.a()) * P;
  CHECK((P - test::dense_of(computed.constraints().kernel_projector())).norm() <= 1e-10);
  CHECK((F - P * test::dense_of(computed.a()) * P).norm() <= 1e-10 * F.norm());
  VectorXd const x = given.constraints().nearest();
  CHECK((given.kernel().transpose() * (brick.parts.f - given.rows().transpose() * x)).norm() <=
        1e-12 * brick.parts.f.norm());
  CHECK(given.constraints().redundant().empty());
  CHECK(given.constraints().rows() == 12);
}

TEST_CASE("prescribed displacements: a brick whose end is moved") {
  decomposed_brick brick({2, 1, 1}, 2, fem::brick_load::press);
  // The fixed nodes have the rows with a single entry.
  Eigen::Index const rows = brick.bodies.B.rows();
  VectorXd const count = brick.bodies.B.cwiseAbs2() * VectorXd::Ones(brick.parts.unknowns());
  auto data = brick.data(false);
  data.f.setZero();
  data.d.setConstant(std::numeric_limits<double>::infinity());  // nothing is touched
  VectorXd entries = VectorXd::Zero(rows);
  for (Eigen::Index j = 0; j < brick.bodies.B.outerSize(); ++j) {
    for (sparse::InnerIterator e(brick.bodies.B, j); e; ++e) entries[e.row()] += 1;
  }
  int axis = 0;
  for (Eigen::Index i = 0; i < rows; ++i) {
    if (entries[i] == 1) brick.bodies.c[i] = axis++ % 3 == 2 ? 0.25 : 0.0;
  }
  CHECK(count.minCoeff() > 0);
  total_feti const problem(frictionless{}, brick.bodies, data);
  auto const qp = problem.qp();
  slant::smalse const method{qp, problem.constraints()};
  auto const r = slant::solve(method, problem.zero(), test::accurate());
  CHECK(r.converged());
  VectorXd const u = problem.displacement(r.x(), method.multipliers(r.state));
  for (Eigen::Index i = 0; i < u.size(); ++i) {
    CHECK(u[i] == doctest::Approx(i % 3 == 2 ? 0.25 : 0.0).epsilon(1e-9).scale(0.25));
  }
}

TEST_CASE("redundant gluing, a body with no constraint, loads that nothing bears") {
  decomposed_brick brick({2, 1, 1}, 1, fem::brick_load::press);
  // Every row of B_E twice, and a third body far from the others on which nothing acts.
  auto const two = brick.parts.unknowns();
  auto const own = brick.bodies.K.front().rows();
  auto const rows = brick.bodies.B.rows();
  std::vector<Eigen::Triplet<double>> entries;
  slant::detail::for_each_entry(brick.bodies.B, [&](auto i, auto j, double value) {
    entries.emplace_back(int(i), int(j), value);
    entries.emplace_back(int(rows + i), int(j), -2 * value);
  });
  slant::contact::floating_bodies<double> bodies = brick.bodies;
  bodies.K.push_back(brick.bodies.K.front());
  bodies.R.push_back(brick.bodies.R.front());
  bodies.B = sparse(2 * rows, two + own);
  bodies.B.setFromTriplets(entries.begin(), entries.end());
  bodies.c = VectorXd::Zero(2 * rows);
  auto data = brick.data(true);
  data.N.conservativeResize(data.N.rows(), two + own);
  data.T.conservativeResize(data.T.rows(), two + own);
  data.f.conservativeResize(two + own);
  data.f.tail(own).setZero();

  total_feti const problem(friction_disc{}, bodies, data);
  CHECK(problem.constraints().redundant().size() == 6);
  auto const qp = problem.qp();
  slant::smalse const method{qp, problem.constraints()};
  auto const r = slant::solve(method, problem.zero(), test::accurate());
  CHECK(r.converged());
  VectorXd const u = problem.displacement(r.x(), method.multipliers(r.state));
  CHECK(u.tail(own).norm() == 0);
  auto const expected = test::reference(brick.scene.K, examples::contact_data(brick.scene, true)).u;
  CHECK((brick.parts.mean * u.head(two) - expected).norm() <= 1e-8 * expected.norm());

  data.f[two + 1] = 0.5;
  std::string complaint;
  try {
    total_feti const pushed(friction_disc{}, bodies, data);
  } catch (slant::bad_input const& e) {
    complaint = e.what();
  }
  CHECK(complaint.find("f: got a load that moves body 2") == 0);
}

TEST_CASE("bad input") {
  decomposed_brick const brick({2, 1, 1}, 1, fem::brick_load::press);
  auto const data = brick.data(true);
  auto const refused = [&](auto change) {
    auto bodies = brick.bodies;
    change(bodies);
    CHECK_THROWS_AS((total_feti(friction_disc{}, bodies, data)), slant::bad_input);
  };
  refused([](auto& b) { b.K.clear(); });
  refused([](auto& b) { b.K.pop_back(); });
  refused([](auto& b) { b.R.pop_back(); });
  refused([](auto& b) { b.R.back()(0, 0) += 1; });
  refused([](auto& b) { b.c.conservativeResize(3); });
  refused([](auto& b) { b.B.conservativeResize(b.B.rows(), 3); });
  refused([](auto& b) { b.c[0] = std::numeric_limits<double>::quiet_NaN(); });
  CHECK_THROWS_AS((total_feti(frictionless{}, brick.bodies, data)), slant::bad_input);
}

}  // namespace total_feti_test
