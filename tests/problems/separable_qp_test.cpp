// SPDX-License-Identifier: MIT
#include <slant/operators/operators.hpp>
#include <slant/problems/problems.hpp>
#include <slant/sets/cartesian.hpp>
#include <slant/testing/archetypes.hpp>

#include <support/testing.hpp>
#include "methods/mixture.hpp"

namespace separable_qp_test {

using vector = Eigen::VectorXd;

TEST_CASE("lvalues are referenced, rvalues owned") {
  auto const A = test::spd(test::with_spectrum(test::log_spaced(3, 2)));
  VectorXd const b = VectorXd::Ones(3);
  auto const set = slant::half_lines(3);
  slant::separable_qp const views{A, b, set};
  CHECK(&views.a() == &A);
  CHECK(&views.b() == &b);
  CHECK(&views.set() == &set);
  CHECK(views.size() == 3);
  slant::separable_qp const owner{A, VectorXd(2 * b), slant::half_lines(3)};
  CHECK(owner.b() == 2 * b);
}

TEST_CASE("the energy costs no product") {
  test::mixture const p(10);
  auto const A = slant::counted(test::spd(p.A));
  slant::separable_qp const qp{A, p.b, p.set()};
  VectorXd const x = test::random_vector(20), r = p.A * x - p.b;
  CHECK(slant::energy(qp, x, r) ==
        doctest::Approx(0.5 * x.dot(p.A * x) - p.b.dot(x)).epsilon(1e-13));
  CHECK(A.applications() == 0);
}

TEST_CASE("sizes that do not match and numbers that are none are named") {
  test::mixture const p(10);
  auto const A = test::spd(p.A);
  using slant::bad_input;
  CHECK_THROWS_WITH_AS((slant::separable_qp{A, VectorXd(VectorXd::Ones(19)), p.set()}),
                       "A.rows(): got 20, expected the size of b, 19", bad_input);
  CHECK_THROWS_WITH_AS((slant::separable_qp{A, p.b, slant::half_lines(21)}),
                       "dimension of the set: got 21, expected the size of b, 20", bad_input);
  VectorXd b = p.b;
  b(4) = std::nan("");
  CHECK_THROWS_WITH_AS((slant::separable_qp{A, b, p.set()}),
                       "b[4]: got nan, expected a finite number", bad_input);
}

template <class C>
constexpr bool classified = slant::has_block_states<C, vector>;

/// A block that cannot say in which state a point of it is.
struct stateless {
  static constexpr int dimension = 2;
  Vector2d project(auto const& x) const { return x; }
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
  using undeclared = decltype(slant::matrix(MatrixXd()));
  using self_adjoint = decltype(slant::declare<slant::self_adjoint>(MatrixXd()));
  CHECK(slant::kprgp_problem<problem<identity>>);
  CHECK(slant::quadratic_program<problem<undeclared>>);
  CHECK_FALSE(slant::kprgp_problem<problem<undeclared>>);
  CHECK_FALSE(slant::kprgp_problem<problem<self_adjoint>>);
  CHECK_FALSE(slant::kprgp_problem<identity>);
}

}  // namespace separable_qp_test
