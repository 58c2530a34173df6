// SPDX-License-Identifier: MIT
//
// symmetrizable is known from the types: each case that is not differs in one thing from one that
// is.
#include <slant/operators/operators.hpp>
#include <slant/sets/sets.hpp>
#include <slant/slanting/slanting.hpp>

#include <support/testing.hpp>
#include "slanting_support.hpp"

namespace symmetrizable_test {

MatrixXd const m = slanting_support::random_spd(4, 1);
VectorXd const b = slanting_support::random_vector(4, 2);
auto const spd = slant::matrix<slant::self_adjoint, slant::positive_definite>(m);
auto const discs = slant::power(slant::ball<2>{}, VectorXd{{1.0, 2.0}});
slant::identity_map const id(4);
auto const step = id - slant::positive(0.5) * slant::affine(spd, b);

template <class F>
constexpr bool known(F const&) {
  return slant::slanting_function<F, VectorXd> &&
         slant::symmetrizable<slant::slant_operator_t<F, VectorXd>>;
}

TEST_CASE("the natural residual with a definite A is symmetrizable") {
  CHECK(known(slant::natural_residual(spd, b, discs, 0.5)));
  CHECK(known(id - slant::projection(discs) * step));
  CHECK(known(id - slant::projection(slant::power(slant::interval<>{}, 4)) * step));
}

TEST_CASE("the laws decide, not the name: any G with 0 <= G <= I will do") {
  CHECK(known(id - slant::positive_part(4) * step));
  auto const halving = slant::smooth<slant::self_adjoint, slant::firmly_nonexpansive>(
      4, 4, [](auto const& y, auto& f) { f = y / 2; },
      [](auto const& y) { return MatrixXd(MatrixXd::Identity(y.size(), y.size()) / 2); });
  CHECK(known(id - halving * step));
  auto const promises_nothing = slant::smooth(
      4, 4, [](auto const& y, auto& f) { f = y / 2; },
      [](auto const& y) { return MatrixXd(MatrixXd::Identity(y.size(), y.size()) / 2); });
  CHECK_FALSE(known(id - promises_nothing * step));
}

TEST_CASE("one thing missing") {
  auto const p = slant::projection(discs);
  auto const symmetric = slant::matrix<slant::self_adjoint>(m);
  auto const semidefinite = slant::matrix<slant::self_adjoint, slant::positive_semidefinite>(m);
  CHECK_FALSE(known(slant::natural_residual(m, b, discs, 0.5)));             // no law of A
  CHECK_FALSE(known(slant::natural_residual(symmetric, b, discs, 0.5)));     // not definite
  CHECK_FALSE(known(slant::natural_residual(semidefinite, b, discs, 0.5)));  // not definite
  CHECK_FALSE(
      known(id - p * (id - slant::any_sign(0.5) * slant::affine(spd, b))));  // sign of ρ unknown
  CHECK_FALSE(known(id + p * step));                                         // + for −
  CHECK_FALSE(known(id - p * (id + slant::positive(0.5) * slant::affine(spd, b))));
  CHECK_FALSE(known(id - p * slant::affine(spd, b)));      // no I − ρA
  CHECK_FALSE(known(p * step));                            // no I −
  CHECK_FALSE(known(slant::positive_part(4) - p * step));  // not I
}

TEST_CASE("the parts of the operator") {
  auto const f = slant::natural_residual(spd, b, discs, 0.5);
  VectorXd const x = slanting_support::random_vector(4, 3);
  auto const newton = f.slant(x);
  CHECK(slant::step_length(newton) == 0.5);
  CHECK((slanting_support::dense(slant::hessian(newton), x) - m).norm() == 0);
  VectorXd const z = x - 0.5 * (m * x - b);
  CHECK((slanting_support::dense(slant::slant_of_projection(newton), x) -
         slanting_support::dense_slant(slant::projection(discs), z))
            .norm() <= 1e-15);
}

}  // namespace symmetrizable_test
