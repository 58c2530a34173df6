// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <slant/operators/declare.hpp>
#include <slant/operators/identity.hpp>
#include <slant/operators/matrix.hpp>
#include <slant/problems/quadratic_program.hpp>
#include <slant/problems/separable_qp.hpp>
#include <slant/sets/ball.hpp>
#include <slant/sets/blocks.hpp>
#include <slant/sets/cartesian.hpp>
#include <slant/sets/contact_sets.hpp>
#include <slant/sets/free_space.hpp>
#include <slant/sets/half_line.hpp>
#include <slant/sets/power.hpp>
#include <slant/sets/rotated.hpp>
#include <slant/sets/shifted.hpp>
#include <slant/testing/archetypes.hpp>

namespace kprgp_problem_test {

using vector = Eigen::VectorXd;

template <class C>
constexpr bool classified = slant::has_block_states<C, vector>;

/// A block that cannot say in which state a point of it is.
struct stateless {
  static constexpr int dimension = 2;
  Eigen::Vector2d project(auto const& x) const { return x; }
  bool contains(auto const&) const { return true; }
};

/// A product of a client that tells nothing but visit.
struct reticent {
  slant::index size() const { return 2; }
  void project(auto const& x, auto& y) const { y = x; }
  bool contains(auto const&) const { return true; }
  template <class F>
  void visit(F&& f) const {
    f(slant::ball<2>{}, slant::place<2>(0, 0, 2));
  }
};

template <class A>
using problem = slant::separable_qp<A, vector, decltype(slant::half_lines(1))>;

TEST_CASE("a set has block states if each of its blocks has a state") {
  CHECK(classified<slant::ball<2>>);
  CHECK(classified<slant::free_space<3>>);
  CHECK(classified<decltype(slant::rotated(slant::ball<2>{}, Eigen::Matrix2d()))>);
  CHECK(classified<decltype(slant::half_lines(3))>);
  CHECK(classified<decltype(slant::cartesian(slant::half_lines(3), slant::discs(vector())))>);
  CHECK(classified<decltype(slant::power(slant::cartesian(slant::half_line{}, slant::ball<2>{}),
                                         3))>);
  CHECK(classified<decltype(slant::shifted(slant::half_lines(3), vector()))>);
  CHECK(classified<reticent>);
}

TEST_CASE("one block without a state is enough to have none") {
  auto const power = [] { return slant::power(stateless{}, 3); };
  CHECK_FALSE(classified<stateless>);
  CHECK_FALSE(classified<decltype(power())>);
  CHECK_FALSE(classified<decltype(slant::cartesian(slant::half_lines(3), power()))>);
  CHECK_FALSE(classified<decltype(slant::cartesian(slant::half_line{}, stateless{}))>);
  CHECK_FALSE(classified<decltype(slant::shifted(power(), vector()))>);
}

TEST_CASE("vectors and sets of other kinds are asked in their own terms") {
  using slant::testing::archetype::basic_convex_set;
  using slant::testing::archetype::basic_separable_set;
  CHECK(classified<basic_separable_set<vector>>);
  CHECK_FALSE(classified<basic_convex_set<vector>>);
}

TEST_CASE("a problem of KPRGP has an operator that declares to be semidefinite") {
  using identity = slant::identity_operator;
  using undeclared = decltype(slant::matrix(Eigen::MatrixXd()));
  using self_adjoint = decltype(slant::declare<slant::self_adjoint>(Eigen::MatrixXd()));
  CHECK(slant::kprgp_problem<problem<identity>>);
  CHECK(slant::quadratic_program<problem<undeclared>>);
  CHECK_FALSE(slant::kprgp_problem<problem<undeclared>>);
  CHECK_FALSE(slant::kprgp_problem<problem<self_adjoint>>);
  CHECK_FALSE(slant::kprgp_problem<identity>);
}

}  // namespace kprgp_problem_test
