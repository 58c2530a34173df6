// SPDX-License-Identifier: MIT
#include <slant/methods/methods.hpp>

#include <krylov/spd_matrices.hpp>
#include <support/testing.hpp>
#include "methods/mixture.hpp"

namespace any_qp_test {

/// Half lines, intervals and discs, n of each.
struct usual_program {
  MatrixXd A;
  VectorXd b, g;
  usual_program(Eigen::Index n, double κ)
      : A(test::with_spectrum(test::log_spaced(4 * n, κ), 7)),
        b(test::random_vector(4 * n, 3)),
        g(VectorXd::LinSpaced(n, 0.1, 2)) {}
  auto set() const {
    auto const n = g.size();
    return slant::cartesian(slant::half_lines(n), slant::intervals(g), slant::discs(g));
  }
};

/// A x and no more: no diagonal, which any_operator forgets.
struct product_only {
  static constexpr auto laws = slant::laws<slant::self_adjoint, slant::positive_definite>;
  MatrixXd const& A;
  Eigen::Index rows() const { return A.rows(); }
  Eigen::Index cols() const { return A.cols(); }
  void apply(auto const& x, auto& y) const { y.noalias() = A * x; }
};

/// The same steps from 0 to the end, and the same work, by Make{}(qp).
template <class Make>
void check_same_run(Make const& make, double κ) {
  usual_program const p(6, κ);
  product_only const A{p.A};
  auto const set = p.set();
  slant::separable_qp const qp{A, p.b, set};
  auto const forgotten = slant::erased(qp);
  VectorXd const x0 = VectorXd::Zero(p.b.size());
  auto const stop = slant::reduced_gradient_below(1e-10) || slant::at_most(3000);
  auto const expected = slant::solve(make(qp), x0, stop);
  auto const run = slant::solve(make(forgotten), x0, stop);
  REQUIRE(expected.converged());
  CHECK(run.converged());
  CHECK(run.x() == expected.x());
  CHECK(run.iterations() == expected.iterations());
  CHECK(run.state.work.operator_applications == expected.state.work.operator_applications);
}

TEST_CASE("erased programs: the same iterates and counts, to the last bit") {
  for (double const κ : {10.0, 1e4}) {
    check_same_run([](auto const& qp) { return slant::kprgp{qp, {.step_length = 1.0}}; }, κ);
    check_same_run([](auto const& qp) { return slant::symmetric_newton{qp}; }, κ);
  }
  check_same_run([](auto const& qp) { return slant::interior_point{qp}; }, 100);
}

TEST_CASE("erased programs: steps beside an erased preconditioner allocate nothing") {
  usual_program const p(6, 100);
  product_only const A{p.A};
  auto const set = p.set();
  slant::separable_qp const qp{A, p.b, set};
  VectorXd const inverse = VectorXd::Constant(p.b.size(), 0.1);
  auto const M = slant::diagonal<slant::positive_definite>(inverse);
  slant::symmetric_newton const newton{slant::erased(qp), slant::erased(M)};
  slant::interior_point const path{slant::erased(qp), slant::erased(M)};
  VectorXd const x0 = VectorXd::Zero(p.b.size());
  auto x = newton.start(x0);
  auto y = path.start(x0);
  slant::testing::allocation_guard const guard;
  for (int i = 0; i < 3; ++i) {
    newton.step(x);
    path.step(y);
  }
  auto const allocations = guard.count();
  CHECK(allocations == 0);
}

TEST_CASE("erased programs: one type for all, as definite as they were") {
  usual_program const p(2, 10);
  auto const definite = slant::matrix<slant::self_adjoint, slant::positive_definite>(p.A);
  auto const semidefinite = slant::matrix<slant::self_adjoint, slant::positive_semidefinite>(p.A);
  auto const set = p.set();
  auto const lines = slant::half_lines(p.b.size());
  slant::separable_qp const first{definite, p.b, set};
  slant::separable_qp const second{semidefinite, p.b, set};
  slant::separable_qp const third{semidefinite, p.b, lines};
  static_assert(std::same_as<decltype(slant::erased(third)), slant::any_qp<>>);
  static_assert(std::same_as<decltype(slant::erased(second)), decltype(slant::erased(third))>);
  static_assert(slant::declares_positive_definite<decltype(slant::erased(first).a())>);
  CHECK(slant::erased(third).set().block_count() == p.b.size());
}

TEST_CASE("erased programs: the diagonal is kept where there is one") {
  usual_program const p(2, 10);
  auto const lines = slant::half_lines(p.b.size());
  auto const with = slant::matrix<slant::self_adjoint, slant::positive_definite>(p.A);
  product_only const without{p.A};
  VectorXd d = VectorXd::Constant(p.b.size(), -1);
  auto const same = d;
  CHECK_FALSE(slant::erased(slant::separable_qp{without, p.b, lines}).a().diagonal_if_known(d));
  CHECK(d == same);
  CHECK(slant::erased(slant::separable_qp{with, p.b, lines}).a().diagonal_if_known(d));
  CHECK(d == p.A.diagonal());
}

TEST_CASE("erased programs: they refer to an lvalue, own an rvalue, and copies share it") {
  usual_program p(3, 10);
  auto const A = slant::matrix<slant::self_adjoint, slant::positive_definite>(p.A);
  auto intervals = slant::intervals(p.g);
  auto const set = slant::cartesian(slant::half_lines(3), intervals, slant::discs(p.g));
  slant::separable_qp const given{A, p.b, set};
  auto const forgotten = slant::erased(given);
  CHECK(&forgotten.b() == &p.b);
  VectorXd const z = VectorXd::Constant(12, 50);
  CHECK(slant::project(forgotten.set(), z)[3] == p.g[0]);
  p.g *= 3;
  intervals.update(p.g);  // bounds that change in their place have changed here as well
  CHECK(slant::project(forgotten.set(), z)[3] == p.g[0]);

  auto const owning = [&] {
    auto const inner = slant::erased(slant::separable_qp{
        A, VectorXd(2 * p.b),
        slant::cartesian(slant::half_lines(3), slant::intervals(p.g), slant::discs(p.g))});
    return inner;
  }();
  auto const copy = owning;
  CHECK(copy.b() == 2 * p.b);
  CHECK(&copy.b() == &owning.b());
  CHECK(slant::project(copy.set(), z)[3] == p.g[0]);
  CHECK(slant::project(copy.set(), z).tail(2).norm() == doctest::Approx(p.g[2]));
}

TEST_CASE("erased programs: solve by a tolerance, with units chosen and without") {
  usual_program const p(6, 50);
  auto const set = p.set();
  for (double const spread : {1.0, 1e3}) {
    // Half lines of very different units; the other blocks keep theirs.
    VectorXd units = VectorXd::Ones(p.b.size());
    for (Eigen::Index i = 0; i < p.g.size(); ++i) units[i] = i % 2 == 0 ? spread : 1;
    MatrixXd scaled = units.asDiagonal() * p.A * units.asDiagonal();
    scaled = (0.5 * (scaled + scaled.transpose())).eval();
    auto const A = slant::matrix<slant::self_adjoint, slant::positive_definite>(scaled);
    slant::separable_qp const qp{A, p.b, set};
    auto const expected = slant::solve(qp, 1e-9);
    auto const run = slant::solve(slant::erased(qp), 1e-9);
    CHECK(expected.converged());
    CHECK(run.converged());
    CHECK((expected.choice.find("blocks scaled") == 0) == (spread > 64));
    CHECK(run.choice == expected.choice);
    CHECK(run.steps == expected.steps);
    CHECK(run.point == expected.point);
  }
}

TEST_CASE("erased programs: one of few kinds is one of many") {
  usual_program const p(2, 10);
  auto const A = slant::matrix<slant::self_adjoint, slant::positive_semidefinite>(p.A);
  auto const forces =
      slant::cartesian(slant::half_lines(2), slant::half_lines(2), slant::discs(p.g));
  slant::separable_qp const given{A, p.b, forces};
  auto const few = slant::erased<slant::contact_runs<double>>(given);
  auto const many = slant::erased(few);
  static_assert(std::same_as<decltype(many), slant::any_qp<> const>);
  VectorXd const z = test::random_vector(8, 9);
  CHECK(slant::project(many.set(), z) == slant::project(forces, z));
}

}  // namespace any_qp_test
