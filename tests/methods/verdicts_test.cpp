// SPDX-License-Identifier: MIT
//
// Verdicts of the projected gradient family on random programs and from starts far away:
// `converged` beside an independent residual, no `unbounded` for a definite A, and an end at the
// rounding floor.
#include <slant/slant.hpp>

#include <oracle/random_programs.hpp>
#include <support/minimise.hpp>
#include <support/program_sets.hpp>
#include <support/testing.hpp>

namespace verdicts_test {

using slant::status;

/// f(name, method) for all methods of the family.
template <class QP, class F>
void with_each_method(QP const& qp, F const& f) {
  f("kprgp", slant::kprgp{qp});
  f("qpq", slant::qpq{qp});
  f("qpc", slant::qpc{qp});
  f("gimssn", slant::gimssn{qp});
  f("imssn", slant::imssn{qp});
  f("mssn", slant::mssn{qp});
  f("symmetric_newton", slant::symmetric_newton{qp});
}

/// The program with A declared semidefinite only, so that nothing about it is taken for granted.
template <class F>
void solve_with_each(oracle::random_program const& p, double start, double tolerance,
                     slant::index limit, F const& f) {
  auto const A = slant::matrix<slant::self_adjoint, slant::positive_semidefinite>(p.A);
  auto const set = test::set_of(p);
  slant::separable_qp const qp{A, p.b, set};
  VectorXd const x0 = VectorXd::Constant(p.size(), start);
  with_each_method(qp, [&](char const* name, auto const& method) {
    CAPTURE(name);
    f(name, test::minimise(method, x0, tolerance, limit));
  });
}

/// A = [2 1; 1 2], b = (1, 1), x ≥ 0, from (size, size): the solution is (1/3, 1/3).
oracle::random_program two_half_lines() {
  oracle::random_program p;
  p.A = MatrixXd{{2.0, 1.0}, {1.0, 2.0}};
  p.b = VectorXd::Ones(2);
  p.lower = VectorXd::Zero(2);
  return p;
}

TEST_CASE("starts far away: solved, and never called solved at a point that the step has passed") {
  auto const p = two_half_lines();
  for (double size : {1e16, 1e17, 1e30, 1e150, 1e153, 1e160, 1e300, 1e307, 1e-16, 1e-150, 1e-300}) {
    CAPTURE(size);
    solve_with_each(p, size, 1e-8, 2000, [&](char const*, auto const& r) {
      CHECK(r.converged());
      CHECK((r.x() - VectorXd::Constant(2, 1.0 / 3)).norm() <= 1e-7);
      CHECK(oracle::relative_residual(p, r.x()) <= 1e-7);
    });
  }
}

TEST_CASE("converged is said beside an independent residual, unbounded of no definite program") {
  for (auto suite : {oracle::program_suite::nasty, oracle::program_suite::tiny}) {
    for (std::uint64_t k = 0; k < 8; ++k) {
      CAPTURE(k);
      auto const p = oracle::make_program(suite, k);
      for (double start : {0.0, 1e12}) {
        solve_with_each(p, start, 1e-10, 500, [&](char const*, auto const& r) {
          CHECK(r.status != status::unbounded);
          if (r.converged()) {
            CHECK(std::min(oracle::relative_residual(p, r.x()) / 1e-10,
                           oracle::floors_above(p, r.x()) / 10) <= 30);
          }
        });
      }
    }
  }
}

TEST_CASE("A of 1e-307: curvatures that vanish are no proof that there is no minimum") {
  for (std::uint64_t k : {2U, 5U, 8U, 16U, 17U, 21U}) {
    CAPTURE(k);
    oracle::program_shape const shape{.half_lines = 1 + int(k % 3),
                                      .intervals = 1,
                                      .discs = 1,
                                      .free_unknowns = 2,
                                      .condition = 1e6,
                                      .pinned = 0.5};
    auto const p = oracle::in_units(oracle::make_program(shape, k), -1018, 0);
    solve_with_each(p, 0, 1e-8, 300,
                    [&](char const*, auto const& r) { CHECK(r.status != status::unbounded); });
    auto const definite = slant::matrix<slant::self_adjoint, slant::positive_definite>(p.A);
    auto const set = test::set_of(p);
    slant::separable_qp const qp{definite, p.b, set};
    auto const r = test::minimise(slant::gimssn{qp}, test::zeros(p.size()), 1e-8, 300);
    CHECK(r.status != status::unbounded);
  }
}

TEST_CASE("no digit is left: stalled, with the level, soon after the floor was reached") {
  for (std::uint64_t k = 0; k < 25; ++k) {
    CAPTURE(k);
    auto const p = oracle::make_program(oracle::program_suite::tiny, k);
    solve_with_each(p, 0, 0, 20000, [&](char const*, auto const& r) {
      CHECK((r.status == status::stalled || r.converged()));
      if (r.status == status::stalled)
        CHECK(r.reason.find("relative reduced gradient") != std::string::npos);
    });
  }
}

}  // namespace verdicts_test
