// SPDX-License-Identifier: MIT
#include <slant/iteration/feasible.hpp>
#include <slant/iteration/solve.hpp>
#include <slant/methods/smalse.hpp>
#include <slant/operators/equality_constraints.hpp>
#include <slant/operators/matrix.hpp>
#include <slant/sets/cartesian.hpp>
#include <slant/sets/contact_sets.hpp>

#include <doctest/doctest.h>

#include <support/allocation_guard.hpp>

#include <random>

namespace smalse_test {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using sparse = Eigen::SparseMatrix<double>;
using slant::status;

MatrixXd random_matrix(Eigen::Index rows, Eigen::Index cols, unsigned seed) {
  std::mt19937 generator(seed);
  std::normal_distribution<double> gaussian;
  return MatrixXd::NullaryExpr(rows, cols, [&] { return gaussian(generator); });
}

/// A problem with a known solution: 4 free components, 8 half lines of which every other one is at
/// its bound, and 6 discs of which every other one slides; 5 equations.
struct known_problem {
  static constexpr int n = 24;
  MatrixXd A, G;
  VectorXd x, b, e, g, μ;

  explicit known_problem(double unit = 1, int rank = n) {
    MatrixXd const root = random_matrix(n, rank, 1);
    A = unit * (root * root.transpose() / n);
    if (rank == n) A.diagonal().array() += 0.1 * unit;
    G = random_matrix(5, n, 2);
    x = random_matrix(n, 1, 3);
    μ = unit * random_matrix(5, 1, 4);
    g = VectorXd::Constant(6, 1.0);
    VectorXd normal = VectorXd::Zero(n);  // of Λ at x
    for (int i = 0; i < 8; ++i) {
      x[4 + i] = i % 2 == 0 ? 0.0 : 0.5 + std::abs(x[4 + i]);
      if (i % 2 == 0) normal[4 + i] = -0.3 - 0.1 * i;
    }
    for (int i = 0; i < 6; ++i) {
      auto disc = x.segment<2>(12 + 2 * i);
      disc *= (i % 2 == 0 ? 1.0 : 0.4) / disc.norm();
      if (i % 2 == 0) normal.segment<2>(12 + 2 * i) = (0.2 + i) * disc;
    }
    b = A * x + G.transpose() * μ + unit * normal;
    e = G * x;
  }
  [[nodiscard]] auto set() const {
    return slant::cartesian(slant::free_components(4), slant::half_lines(8), slant::discs(g));
  }
  [[nodiscard]] auto qp() const {
    return slant::separable_qp{slant::matrix<slant::self_adjoint, slant::positive_semidefinite>(A),
                               b, set()};
  }
  [[nodiscard]] auto constraints() const {
    return slant::equality_constraints(sparse(G.sparseView()), e);
  }
};

auto accurate(double tolerance) {
  return (slant::reduced_gradient_below(tolerance) && slant::feasibility_below(tolerance)) ||
         slant::at_most(200);
}

using newton_options = slant::smalse_options<double, slant::newton_inner<double>>;

/// Runs a method from zero and compares with the solution that is known.
template <class Method>
auto check_solution(Method const& method, known_problem const& p, double unit = 1) {
  auto const r = slant::solve(method, VectorXd(VectorXd::Zero(p.n)), accurate(1e-11));
  CAPTURE(r.reason);
  CHECK(r.converged());
  CHECK((r.x() - p.x).norm() <= 1e-9);
  CHECK((p.G * r.x() - p.e).norm() <= 1e-9);
  CHECK((method.multipliers(r.state) - p.μ).norm() <= 1e-8 * unit);
  return r;
}

TEST_CASE("the known solution with its multipliers, by KPRGP and by Newton's method") {
  known_problem const p;
  auto const qp = p.qp();
  auto const constraints = p.constraints();
  auto const r = check_solution(slant::smalse{qp, constraints}, p);
  CHECK(r.iterations() <= 30);
  CHECK(r.state.work.inner_iterations <= 300);
  // The bound of σ_max and A x̄; one product an outer step besides those of the inner method, and
  // one more of it for a step that leaves the set.
  CHECK(r.state.work.setup_applications <= p.n + 1);
  CHECK(r.state.work.operator_applications >= r.state.work.inner_iterations + r.iterations() - 1);
  CHECK(r.state.work.operator_applications <= 2 * r.state.work.inner_iterations + r.iterations());
  check_solution(slant::smalse{qp, constraints, newton_options{}}, p);
}

TEST_CASE("Newton steps for the multipliers: the same solution in fewer steps") {
  known_problem const p;
  auto const qp = p.qp();
  auto const constraints = p.constraints();
  auto const plain = check_solution(slant::smalse{qp, constraints}, p);
  slant::smalse_options<double> options;
  options.newton_multipliers = true;
  auto const newton = check_solution(slant::smalse{qp, constraints, options}, p);
  CHECK(2 * newton.iterations() <= plain.iterations());
  CHECK(newton.state.work.operator_applications < plain.state.work.operator_applications);
}

TEST_CASE("semidefinite A, redundant rows, any units") {
  for (double const unit : {1e-100, 1.0, 1e100}) {
    known_problem p(unit, 21);
    auto const qp = p.qp();
    MatrixXd rows(7, p.n);
    rows << p.G, 1e3 * p.G.row(1) - p.G.row(4), p.G.row(0);
    VectorXd e(7);
    e << p.e, 1e3 * p.e[1] - p.e[4], p.e[0];
    slant::equality_constraints const constraints(sparse(rows.sparseView()), e);
    CHECK(constraints.redundant().size() == 2);
    slant::smalse const method{qp, constraints};
    auto const r = slant::solve(method, VectorXd(VectorXd::Zero(p.n)), accurate(1e-11));
    CHECK(r.converged());
    CHECK((r.x() - p.x).norm() <= 1e-8);
    CHECK((rows.transpose() * method.multipliers(r.state) - p.G.transpose() * p.μ).norm() <=
          1e-8 * unit);
  }
}

TEST_CASE("M falls only finitely often, L grows, and the accuracy is confirmed from x") {
  known_problem const p;
  auto const qp = p.qp();
  auto const constraints = p.constraints();
  double last = 0, M = 0;
  int grown = 0, adapted = 0;
  auto const watch = [&](auto const& s) {
    if (s.iteration > 1) {
      if (s.lagrangian >= last) ++grown;
      if (s.M < M) ++adapted;
      CHECK((s.lagrangian >= last || s.M < M || s.feasibility_norm <= 1e-6));
    }
    last = s.lagrangian;
    M = s.M;
  };
  auto const r = slant::solve(slant::smalse{qp, constraints}, VectorXd(VectorXd::Ones(p.n)),
                              accurate(1e-10), watch);
  CHECK(r.converged());
  CHECK(grown >= 5);
  CHECK(adapted <= 4);
  VectorXd const x = r.x();
  VectorXd const gradient = p.A * (x - r.state.offset) - p.b +
                            p.G.transpose() * slant::smalse{qp, constraints}.multipliers(r.state);
  double const α = 1 / r.state.σ;
  VectorXd projected = x - α * gradient;
  slant::project(qp.set(), VectorXd(projected), projected);
  CHECK((x - projected).norm() / α <= 1e-8 * r.state.gradient_scale);
}

TEST_CASE("constraints that no point of the set satisfies are named") {
  known_problem p;
  p.G.row(0).setZero();
  p.G(0, 4) = p.G(0, 5) = 1;  // x_4 + x_5 = −1, both in half lines
  p.e[0] = -1;
  auto const qp = p.qp();
  auto const constraints = p.constraints();
  auto const r =
      slant::solve(slant::smalse{qp, constraints}, VectorXd(VectorXd::Zero(p.n)), accurate(1e-10));
  CHECK(r.status == status::stalled);
  CHECK(r.state.infeasible);
  CHECK(r.reason == "no point of the set satisfies the equality constraints");
}

TEST_CASE("a function without minimum is told from one with") {
  // x_0 does not appear in q but by −x_0.
  MatrixXd const A = VectorXd{{0.0, 1.0, 2.0}}.asDiagonal();
  VectorXd const b{{1.0, 1.0, 1.0}};
  slant::separable_qp const qp{slant::matrix<slant::self_adjoint, slant::positive_semidefinite>(A),
                               b, slant::half_lines(3)};
  MatrixXd const G{{0.0, 1.0, 1.0}};
  slant::equality_constraints const constraints(sparse(G.sparseView()),
                                                VectorXd(VectorXd::Ones(1)));
  auto const r =
      slant::solve(slant::smalse{qp, constraints}, VectorXd(VectorXd::Zero(3)), accurate(1e-10));
  CHECK(r.status == status::unbounded);
}

TEST_CASE("no equations at all; a step does not allocate; a start is projected") {
  known_problem const p;
  auto const qp = p.qp();
  slant::equality_constraints const none(sparse(0, p.n), VectorXd(0));
  auto const free_run =
      slant::solve(slant::smalse{qp, none}, VectorXd(VectorXd::Zero(p.n)), accurate(1e-10));
  auto const plain = slant::solve(slant::kprgp{qp}, VectorXd(VectorXd::Zero(p.n)),
                                  slant::reduced_gradient_below(1e-11) || slant::at_most(5000));
  CHECK(free_run.converged());
  CHECK((free_run.x() - plain.x()).norm() <= 1e-8);

  auto const constraints = p.constraints();
  slant::smalse const method{qp, constraints};
  auto state = method.start(VectorXd::Constant(p.n, -3.0));
  CHECK(qp.set().contains(state.x));
  slant::testing::allocation_guard guard;
  method.step(state);
  method.step(state);
  auto const allocations = guard.count();
  CHECK(allocations == 0);
}

TEST_CASE("bad input") {
  known_problem const p;
  auto const qp = p.qp();
  auto const constraints = p.constraints();
  slant::equality_constraints const other(sparse(1, 3), VectorXd(VectorXd::Zero(1)));
  CHECK_THROWS_AS((slant::smalse{qp, other}), slant::bad_input);
  slant::smalse const method{qp, constraints};
  CHECK_THROWS_AS(static_cast<void>(method.start(VectorXd::Zero(3))), slant::bad_input);
  using options = slant::smalse_options<double>;
  for (options const& o :
       {options{.penalty = 0}, options{.balance = -1}, options{.shrink = 1},
        options{.precision = 0}, options{.inner_steps = 0}, options{.patience = 0}}) {
    CHECK_THROWS_AS((slant::smalse{qp, constraints, o}), slant::bad_input);
  }
}

}  // namespace smalse_test
