// SPDX-License-Identifier: MIT
#include <slant/methods/constrained_newton.hpp>

#include <slant/contact/preconditioners.hpp>
#include <slant/iteration/solve.hpp>
#include <slant/iteration/stopping.hpp>
#include <slant/operators/any_operator.hpp>

#include <fem/decomposed_brick.hpp>
#include <support/dense_of.hpp>
#include <support/floating_parts.hpp>
#include <support/testing.hpp>
#include "scenes.hpp"

namespace total_feti_test {

using slant::contact::friction_disc;
using slant::contact::frictionless;
using slant::contact::total_feti;

/// A brick of cubes of c × c × c cells, one for each subdomain.
struct decomposed_brick : fem::decomposed_brick {
  slant::contact::floating_bodies<double> bodies;

  decomposed_brick(std::array<int, 3> const& cubes, int c, fem::brick_load load)
      : fem::decomposed_brick(
            fem::make_decomposed_brick({.cubes = cubes, .cells = c, .load = load})),
        bodies(examples::floating_parts(parts)) {}

  /// Contact data for the unknowns of all subdomains.
  [[nodiscard]] slant::contact::data<double> data(bool friction) const {
    return examples::contact_data(scene, parts, friction);
  }
};

auto accurate() {
  return (slant::reduced_gradient_below(1e-10) && slant::feasibility_below(1e-10)) ||
         slant::at_most(100);
}

/// Displacements of the scene, the mean of the copies, which must agree with each other.
template <class Problem, class Method>
VectorXd displacement(decomposed_brick const& brick, Problem const& problem, Method const& method) {
  auto const r = slant::solve(method, problem.zero(), accurate());
  CAPTURE(r.reason);
  CHECK(r.converged());
  CHECK(r.iterations() <= 30);
  VectorXd const u = problem.displacement(r.x(), method.multipliers(r.state));
  CHECK((brick.parts.glue * u).norm() <= 1e-8 * u.norm());
  return brick.parts.mean * u;
}

/// What the load rests on, or why it cannot.
template <class Bodies, class Data>
auto solved(Bodies const& bodies, Data const& data) {
  total_feti const problem(friction_disc{}, bodies, data);
  auto const qp = problem.qp();
  slant::constrained_newton const method{qp, problem.constraints()};
  auto r = slant::solve(method, problem.zero(), accurate());
  VectorXd u = problem.displacement(r.x(), method.multipliers(r.state));
  sparse const K = slant::contact::block_stiffness(bodies);
  VectorXd const rest = K * u - data.f + problem.rows().transpose() * r.x();
  CHECK((!r.converged() || rest.norm() <= 1e-8 * data.f.norm() + 1e-12 * K.norm() * u.norm()));
  return std::pair(std::move(r), std::move(u));
}

/// What is said of bodies and data that are refused; nothing if they are not.
template <class Bodies, class Data>
std::string complaint(Bodies const& bodies, Data const& data) {
  return test::complaint([&] { total_feti const problem(friction_disc{}, bodies, data); });
}

TEST_CASE(
    "the displacements of the brick that was not cut, one node close and far from the ground") {
  decomposed_brick const brick({2, test::effort(2, 1), 1}, 2, fem::brick_load::pull);
  for (double const far : {0.0, 1e2}) {
    CAPTURE(far);
    auto whole = examples::contact_data(brick.scene, true);
    auto cut = brick.data(true);
    whole.d[1] += far;
    cut.d[1] += far;
    auto const expected = test::reference(brick.scene.K, whole).u;
    total_feti const problem(friction_disc{}, brick.bodies, cut);
    auto const qp = problem.qp();
    // With the far node SMALSE-M may get no further than rounding errors allow, but says so.
    slant::smalse const smalse{qp, problem.constraints()};
    auto const r = slant::solve(smalse, problem.zero(), accurate());
    VectorXd const u = problem.displacement(r.x(), smalse.multipliers(r.state));
    CAPTURE(r.reason);
    CHECK((far > 0 || r.converged()));
    CHECK((!r.converged() || (brick.parts.mean * u - expected).norm() <= 1e-8 * expected.norm()));
    slant::constrained_newton const newton{qp, problem.constraints()};
    VectorXd const v = displacement(brick, problem, newton);
    CHECK((v - expected).norm() <= 1e-8 * expected.norm());
    CHECK(slant::solve(newton, problem.zero(), accurate()).iterations() <= 12);
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

TEST_CASE("prescribed displacements: a brick whose end is moved, with no contact at all") {
  decomposed_brick brick({2, 1, 1}, 2, fem::brick_load::press);
  // The fixed nodes have the rows with a single entry.
  Eigen::Index const rows = brick.bodies.B.rows();
  auto const n = brick.parts.unknowns();
  slant::contact::data<double> const data{sparse(0, n), sparse(0, n), VectorXd::Zero(n),
                                          VectorXd(0), VectorXd(0)};
  VectorXd entries = VectorXd::Zero(rows);
  slant::detail::for_each_entry(brick.bodies.B, [&](auto i, auto, double) { entries[i] += 1; });
  int axis = 0;
  for (Eigen::Index i = 0; i < rows; ++i)
    if (entries[i] == 1) brick.bodies.c[i] = axis++ % 3 == 2 ? 0.25 : 0.0;
  auto const [r, u] = solved(brick.bodies, data);
  CHECK(r.converged());
  for (Eigen::Index i = 0; i < u.size(); ++i)
    CHECK(u[i] == doctest::Approx(i % 3 == 2 ? 0.25 : 0.0).epsilon(1e-9).scale(0.25));
}

TEST_CASE("redundant gluing, a body with no constraint, loads that nothing bears") {
  decomposed_brick brick({2, 1, 1}, 1, fem::brick_load::press);
  // Every row of B_E twice, and a third body far from the others on which nothing acts.
  auto const two = brick.parts.unknowns();
  auto const own = brick.bodies.K.front().rows();
  auto const rows = brick.bodies.B.rows();
  slant::contact::floating_bodies<double> bodies = brick.bodies;
  bodies.K.push_back(brick.bodies.K.front());
  bodies.R.push_back(brick.bodies.R.front());
  bodies.B = slant::contact::detail::stacked<double>(bodies.B, sparse(-2 * bodies.B));
  bodies.B.conservativeResize(2 * rows, two + own);
  bodies.c = VectorXd::Zero(2 * rows);
  auto data = brick.data(true);
  data.N.conservativeResize(data.N.rows(), two + own);
  data.T.conservativeResize(data.T.rows(), two + own);
  data.f.conservativeResize(two + own);
  data.f.tail(own).setZero();

  {
    total_feti const problem(friction_disc{}, bodies, data);
    CHECK(problem.constraints().redundant().size() == 6);
  }
  auto const [r, u] = solved(bodies, data);
  CHECK(r.converged());
  CHECK(u.tail(own).norm() == 0);
  auto const expected = test::reference(brick.scene.K, examples::contact_data(brick.scene, true)).u;
  CHECK((brick.parts.mean * u.head(two) - expected).norm() <= 1e-8 * expected.norm());

  for (double const push : {0.5, 1e-8, 1e-12}) {
    data.f[two + 1] = push;
    CHECK(complaint(bodies, data).find("f: got a load that moves body 2") == 0);
  }
  // A load in equilibrium with itself is fine, however large.
  VectorXd const shape = VectorXd::LinSpaced(own, -1, 1).array().sin();
  data.f.tail(own) = 1e3 * (bodies.K.back() * shape);
  auto const [deformed, v] = solved(bodies, data);
  CHECK(deformed.converged());
}

/// One cube without Dirichlet conditions, held at given unknowns.
decomposed_brick cube_held_at(std::vector<Eigen::Index> const& unknowns) {
  decomposed_brick cube({1, 1, 1}, 1, fem::brick_load::press);
  auto const rows = static_cast<Eigen::Index>(unknowns.size());
  cube.bodies.B = sparse(rows, cube.parts.unknowns());
  for (Eigen::Index i = 0; i < rows; ++i)
    cube.bodies.B.insert(i, unknowns[static_cast<std::size_t>(i)]) = 1;
  cube.bodies.c = VectorXd::Zero(rows);
  return cube;
}

TEST_CASE("a body held in six directions, and in five") {
  auto const n = decomposed_brick({1, 1, 1}, 1, fem::brick_load::press).parts.unknowns();
  auto const nodes = decomposed_brick({1, 1, 1}, 1, fem::brick_load::press).parts.nodes.front();
  auto const R = slant::contact::rigid_body_modes(nodes);
  auto const six = slant::fixing_rows(R);
  VectorXd const f = VectorXd::LinSpaced(n, -1, 2).array().cos();
  slant::contact::data<double> data{sparse(0, n), sparse(0, n), f, VectorXd(0), VectorXd(0)};
  auto const held = cube_held_at(six);
  auto const [r, u] = solved(held.bodies, data);
  CHECK(r.converged());
  CHECK((held.bodies.B * u).norm() <= 1e-10 * u.norm());

  auto const loose = cube_held_at({six.begin(), six.end() - 1});
  CHECK(complaint(loose.bodies, data).find("f: got a load that moves body 0") == 0);
  // The motion that is left, and a load without a component along it.
  MatrixXd const image = loose.bodies.B * R;
  VectorXd const motion = R * MatrixXd(image.fullPivLu().kernel());
  data.f = f - motion * (motion.dot(f) / motion.squaredNorm());
  total_feti const problem(friction_disc{}, loose.bodies, data);
  CHECK(problem.constraints().redundant().size() == 1);
  auto const [bearable, v] = solved(loose.bodies, data);
  CHECK(bearable.converged());
}

TEST_CASE("a body that only contact holds: pressed on, and pulled off") {
  auto cube = cube_held_at({});
  auto data = cube.data(true);
  data.d.setZero();
  data.g.setOnes();
  for (double const sign : {1.0, -1.0}) {
    // Each normal multiplier alike, pressing or pulling.
    data.f = sign * (cube.parts.N.transpose() * VectorXd::Ones(cube.parts.N.rows()));
    auto const [r, u] = solved(cube.bodies, data);
    CAPTURE(r.reason);
    CHECK(r.converged() == (sign > 0));
    CHECK(r.state.infeasible == (sign < 0));
  }
}

TEST_CASE("no gap closes, and lengths are short: b has no other unit") {
  decomposed_brick const brick({2, 1, 1}, 1, fem::brick_load::press);
  auto bodies = brick.bodies;
  bodies.c *= 1e-25;
  auto data = brick.data(false);
  data.f *= 1e-25;
  data.d.setConstant(infinity);
  total_feti const problem(slant::contact::frictionless{}, bodies, data);
  auto const b = problem.qp().b();
  CHECK(b.cwiseAbs().maxCoeff() == b.head(bodies.c.size()).cwiseAbs().maxCoeff());
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
  CHECK_THROWS_AS((total_feti(slant::contact::frictionless{}, brick.bodies, data)),
                  slant::bad_input);
}

using preconditioner =
    slant::any_operator<VectorXd, slant::laws<slant::self_adjoint, slant::positive_semidefinite>>;

TEST_CASE(
    "without preconditioner, lumped and Dirichlet in the face, contact that holds and opens") {
  for (auto const load : {fem::brick_load::pull, fem::brick_load::lift}) {
    decomposed_brick const brick({2, 1, 1}, test::effort(3, 2), load);
    auto const expected =
        test::reference(brick.scene.K, examples::contact_data(brick.scene, false)).u;
    total_feti const problem(frictionless{}, brick.bodies, brick.data(false));
    auto const qp = problem.qp();
    auto const K = slant::contact::block_stiffness(brick.bodies);
    auto const steps_with = [&](preconditioner const& M) {
      slant::constrained_newton const method{qp, problem.constraints(), M};
      VectorXd const u = displacement(brick, problem, method);
      CHECK((u - expected).norm() <= 1e-8 * expected.norm());
      auto const r = slant::solve(method, problem.zero(), accurate());
      CHECK(r.iterations() <= 15);
      CHECK(r.state.fallback_count == 0);
      return static_cast<double>(r.state.work.inner_iterations);
    };
    double const without = steps_with(preconditioner(slant::identity(qp.size())));
    double const lumped =
        steps_with(preconditioner(slant::contact::lumped_preconditioner(K, problem.rows())));
    double const dirichlet =
        steps_with(preconditioner(slant::contact::dirichlet_preconditioner(K, problem.rows())));
    CAPTURE(without);
    CAPTURE(lumped);
    CAPTURE(dirichlet);
    CHECK(lumped < 0.6 * without);
    CHECK(dirichlet <
          0.6 * without);  // with two cells along an edge not better than the lumped one
  }
}

}  // namespace total_feti_test
