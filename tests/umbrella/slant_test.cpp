// SPDX-License-Identifier: MIT
//
// One thing of each room that comes through <slant/slant.hpp>, and what has a header of its own.
// A second translation unit (other_unit_test.cpp) includes the same header and is linked to this
// one.
#include <slant/slant.hpp>

// Nothing that only some clients want may come along.
#if defined(RANGES_V3_VERSION_HPP) || defined(RANGES_V3_CONFIG_HPP)
#error "<slant/slant.hpp> includes range-v3"
#endif
#if defined(_GLIBCXX_FILESYSTEM) || defined(_GLIBCXX_CHRONO) || defined(_GLIBCXX_RANGES)
#error "<slant/slant.hpp> includes <filesystem>, <chrono> or <ranges>"
#endif
#if defined(EIGEN_SVD_MODULE_H) || defined(EIGEN_EIGENVALUES_MODULE_H)
#error "<slant/slant.hpp> includes decompositions of Eigen that it has no use for"
#endif
#if defined(_GLIBCXX_IOSTREAM)
#error "<slant/slant.hpp> includes <iostream>, whose static objects end up in every client"
#endif
#if defined(_GLIBCXX_REGEX)
#error "<slant/slant.hpp> includes <regex>"
#endif
#if defined(DOCTEST_LIBRARY_INCLUDED) || defined(PUGIXML_VERSION)
#error "<slant/slant.hpp> includes a header of a component"
#endif

// A macro with a short name is the usual damage that a header does.
#if defined(check) || defined(index) || defined(laws) || defined(status) || defined(verify)
#error "<slant/slant.hpp> defines a macro with a common name"
#endif

// A header for those who need it.
#include <slant/iteration/iterates.hpp>

#include <umbrella/other_unit.hpp>

#include <doctest/doctest.h>

#include <range/v3/view/take.hpp>

namespace {

using vector = Eigen::VectorXd;
using sparse = Eigen::SparseMatrix<double>;

sparse stiffness() {
  sparse k(3, 3);
  for (int i = 0; i < 3; ++i) k.insert(i, i) = 2;
  return k;
}

auto forces() {
  return slant::cartesian(slant::half_line{}, slant::ball<2>{1});
}

}  // namespace

TEST_CASE("concepts") {
  static_assert(slant::scalar<double>);
  static_assert(slant::vector<vector>);
  static_assert(slant::convex_set<umbrella::forces, Eigen::Vector3d>);
  static_assert(slant::factorization<slant::ldlt<double>, vector>);
  CHECK(slant::inner_product(Eigen::Vector2d(1, 2), Eigen::Vector2d(3, 4)) == 11);
}

TEST_CASE("factorizations, operators, sets, krylov and methods") {
  auto const A = slant::counted(slant::inverse(slant::ldlt(stiffness())));
  vector const b = Eigen::Vector3d(2, 1.5, 2);
  vector const x0 = vector::Zero(3);

  auto const linear = slant::solve(slant::cg{A, b}, x0, slant::residual_below(1e-14));
  CHECK(linear.x().isApprox(2 * b, 1e-14));

  auto const constrained = slant::solve(slant::kprgp{slant::separable_qp{A, b, forces()}}, x0,
                                        slant::reduced_gradient_below(1e-13));
  CHECK(constrained.converged());
  CHECK(constrained.x().isApprox(Eigen::Vector3d(4, 0.6, 0.8), 1e-12));
  CHECK(A.counts().applications > 0);
}

TEST_CASE("slanting") {
  vector const b = Eigen::Vector3d(2, 1.5, 2);
  auto const A = slant::inverse(slant::ldlt(stiffness()));
  auto const set = forces();
  auto const residual = slant::natural_residual(A, b, set, 0.5);
  static_assert(slant::slanting_function<decltype(residual), vector>);
  vector const solution = Eigen::Vector3d(4, 0.6, 0.8);
  CHECK(slant::evaluate(residual, solution).norm() < 1e-15);
}

TEST_CASE("iteration") {
  auto const A = slant::diagonal<slant::positive_definite>(vector(Eigen::Vector3d(1, 2, 3)));
  vector const b = vector::Ones(3);
  slant::cg method{A, b};
  std::vector<double> residuals;
  for (auto const& s : slant::iterates(method, vector(vector::Zero(3))) | ranges::views::take(4))
    residuals.push_back(s.residual_norm);
  CHECK(residuals.size() == 4);  // x0 and three steps, enough for three unknowns
  CHECK(residuals.back() < 1e-14 * residuals.front());
}

TEST_CASE("two translation units are one program") {
  auto const there = umbrella::addresses_elsewhere();
  CHECK(there.apply == &slant::apply);
  CHECK(there.project == &slant::project);
  CHECK(there.evaluate == &slant::evaluate);
  CHECK(umbrella::project_elsewhere({2, 0, 3}) == forces().project(Eigen::Vector3d(2, 0, 3)));
  CHECK_THROWS_AS(umbrella::refuse_elsewhere(), slant::bad_input);
}
