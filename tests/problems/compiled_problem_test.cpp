// SPDX-License-Identifier: MIT
//
// The instances that a method made of a problem is: in a build with slant::compiled those of the
// component, in one without its own. tests/compiled compares their bits.
#include <slant/problems/compiled_problem.hpp>

#include <slant/iteration/solve.hpp>
#include <slant/methods/interior_point.hpp>
#include <slant/methods/kprgp.hpp>
#include <slant/methods/symmetric_newton.hpp>
#include <slant/operators/diagonal.hpp>
#include <slant/operators/matrix.hpp>
#include <slant/problems/separable_qp.hpp>
#include <slant/sets/cartesian.hpp>
#include <slant/sets/contact_sets.hpp>

#include <doctest/doctest.h>

#include <concepts>
#include <support/allocation_guard.hpp>
#include <type_traits>

namespace compiled_problem_test {

template <class S>
using vector_of = Eigen::Matrix<S, Eigen::Dynamic, 1>;

/// Half lines and discs, one of each kind of them active.
template <class S>
struct scene {
  Eigen::Matrix<S, Eigen::Dynamic, Eigen::Dynamic> K =
      Eigen::Matrix<S, Eigen::Dynamic, Eigen::Dynamic>::Identity(9, 9) * S(2);
  vector_of<S> b = vector_of<S>::LinSpaced(9, -3, 4), g = vector_of<S>::LinSpaced(3, 0.5, 2);
  vector_of<S> inverse = vector_of<S>::Constant(9, 0.5);

  scene() {
    K.diagonal(1).setConstant(S(-1));
    K.diagonal(-1).setConstant(S(-1));
  }
  auto a() const { return slant::matrix<slant::self_adjoint, slant::positive_definite>(K); }
  auto set() const { return slant::cartesian(slant::half_lines(3), slant::discs(g)); }
  auto m() const { return slant::diagonal<slant::positive_definite>(inverse); }
  auto qp() const { return slant::separable_qp{a(), vector_of<S>(b), set()}; }
};

TEST_CASE("compiled problems: methods of a usual program are those of the component") {
  scene<double> const s;
  auto const M = s.m();
  auto const qp = s.qp();
  using given = std::remove_const_t<decltype(qp)>;
  slant::symmetric_newton const newton{qp};
  slant::symmetric_newton const preconditioned_newton{qp, M};
  slant::interior_point const path{qp};
  slant::interior_point const preconditioned_path{qp, M};
  slant::kprgp const kprgp{qp};
#if SLANT_USES_COMPILED
  using any = slant::any_qp<double, slant::definite_laws>;
  using any_preconditioner = slant::any_operator<Eigen::VectorXd, slant::semidefinite_laws>;
  CHECK(std::same_as<decltype(newton), slant::symmetric_newton<any> const>);
  CHECK(std::same_as<decltype(path), slant::interior_point<any> const>);
  CHECK(std::same_as<decltype(kprgp), slant::kprgp<any> const>);
  CHECK(std::same_as<decltype(preconditioned_newton),
                     slant::symmetric_newton<any, any_preconditioner> const>);
  CHECK(std::same_as<decltype(preconditioned_path),
                     slant::interior_point<any, any_preconditioner> const>);
#else
  CHECK(std::same_as<decltype(newton), slant::symmetric_newton<given const&> const>);
  CHECK(std::same_as<decltype(path), slant::interior_point<given const&> const>);
  CHECK(std::same_as<decltype(kprgp), slant::kprgp<given const&> const>);
#endif
  // Types that are spelt out are what they say, and all come to the same point.
  slant::symmetric_newton<given const&> const own{qp};
  slant::interior_point<given const&, decltype((M))> const own_path{qp, M};
  Eigen::VectorXd const x0 = Eigen::VectorXd::Zero(9);
  auto const stop = slant::reduced_gradient_below(1e-10) || slant::at_most(100);
  auto const expected = slant::solve(own, x0, stop);
  auto const run = slant::solve(newton, x0, stop);
  auto const inner = slant::solve(own_path, x0, stop);
  auto const inner_run = slant::solve(preconditioned_path, x0, stop);
  REQUIRE(expected.converged());
  REQUIRE(inner.converged());
  CHECK(run.x() == expected.x());
  CHECK(run.iterations() == expected.iterations());
  CHECK(inner_run.x() == inner.x());
  CHECK(inner_run.iterations() == inner.iterations());
  CHECK(inner_run.state.work.operator_applications == inner.state.work.operator_applications);
}

TEST_CASE("compiled problems: other scalars and owned programs") {
  scene<float> const s;
  auto const qp = s.qp();
  using given = std::remove_const_t<decltype(qp)>;
  slant::symmetric_newton const newton{qp};
  CHECK(std::same_as<decltype(newton), slant::symmetric_newton<given const&> const>);

  // What was a temporary is owned, also when its type is forgotten.
  scene<double> const t;
  slant::symmetric_newton const owner{t.qp()};
  auto const run =
      slant::solve(owner, Eigen::VectorXd::Zero(9).eval(), slant::reduced_gradient_below(1e-10));
  CHECK(run.converged());
}

TEST_CASE("compiled problems: steps allocate nothing") {
  scene<double> const s;
  auto const M = s.m();
  auto const qp = s.qp();
  slant::symmetric_newton const newton{qp, M};
  slant::interior_point const path{qp, M};
  auto x = newton.start(Eigen::VectorXd::Zero(9));
  auto y = path.start(Eigen::VectorXd::Zero(9));
  slant::testing::allocation_guard const guard;
  for (int i = 0; i < 3; ++i) {
    newton.step(x);
    path.step(y);
  }
  auto const allocations = guard.count();
  CHECK(allocations == 0);
}

}  // namespace compiled_problem_test
