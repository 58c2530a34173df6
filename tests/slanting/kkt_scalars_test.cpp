// SPDX-License-Identifier: MIT
#include <slant/sets/sets.hpp>
#include <slant/slanting/kkt_function.hpp>
#include <slant/testing/archetypes.hpp>

#include <support/testing.hpp>
#include "slanting_support.hpp"

namespace kkt_scalars_test {

using slanting_support::dense_slant;

template <class S>
using matrix_of = Eigen::Matrix<S, Eigen::Dynamic, Eigen::Dynamic>;
template <class S>
using vector_of = Eigen::Matrix<S, Eigen::Dynamic, 1>;

/// F and F° for one bound, one free unknown and one circle, in another scalar.
template <class S>
void check_scalar() {
  matrix_of<S> const A = 4 * matrix_of<S>::Identity(4, 4);
  vector_of<S> const b = vector_of<S>::Constant(4, S(1));
  auto const set = slant::cartesian(slant::half_lines<S>(1), slant::free_components<S>(1),
                                    slant::discs(vector_of<S>{{S(1)}}));
  auto const F = slant::kkt(A, b, set, S(0.5));
  vector_of<S> const y{{S(-1), S(2), S(1), S(2), S(3), S(-0.5)}};
  // μ + ρ (1 + 4 − 1) = 1.5: active; λ + ρ (0 + 1) = 3.5: active
  CHECK(slant::evaluate(F, y) == vector_of<S>{{S(-8), S(7), S(2), S(5), S(-0.5), S(-2)}});
  matrix_of<S> G = matrix_of<S>::Zero(6, 6);
  G.diagonal() << S(4), S(4), S(3), S(3), S(0), S(0);
  G(0, 4) = S(-1);
  G(2, 5) = S(2);
  G(3, 5) = S(4);
  G(4, 0) = S(0.5);
  G(5, 2) = S(-1);
  G(5, 3) = S(-2);
  CHECK(dense_slant(F, y) == G);
}

TEST_CASE("another scalar") {
  check_scalar<float>();
}

TEST_CASE("vectors of which only the concept is known") {
  using slant::testing::archetype::vector;
  MatrixXd const A = 4 * MatrixXd::Identity(4, 4);
  auto const set = slant::cartesian(slant::half_lines(1), slant::free_components(1),
                                    slant::discs(VectorXd{{1.0}}));
  vector const b(VectorXd::Constant(4, 1.0));
  auto const F = slant::kkt(A, b, set, 0.5);
  vector const y(VectorXd{{-1, 2, 1, 2, 3, -0.5}});
  CHECK(slant::evaluate(F, y).local() == VectorXd{{-8, 7, 2, 5, -0.5, -2}});
  CHECK(dense_slant(F, y).row(4).transpose() == VectorXd{{0.5, 0, 0, 0, 0, 0}});
}

}  // namespace kkt_scalars_test
