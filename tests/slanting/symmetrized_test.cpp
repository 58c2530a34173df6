// SPDX-License-Identifier: MIT
#include <slant/operators/operators.hpp>
#include <slant/sets/sets.hpp>
#include <slant/slanting/slanting.hpp>
#include <slant/testing/archetypes.hpp>

#include <support/testing.hpp>
#include "slanting_support.hpp"

namespace symmetrized_test {

using namespace test::evaluated;
using slanting_support::dense;

struct scene {
  MatrixXd m = slanting_support::random_spd(8, 1);
  VectorXd b = 20 * slanting_support::random_vector(8, 2);
  VectorXd x = slanting_support::random_vector(8, 3);
  double ρ = 0.1;
  [[nodiscard]] auto set() const {
    return slant::cartesian(slant::power(slant::half_line<>{}, 2),
                            slant::power(slant::ball<2>{}, VectorXd{{1.0, 5.0, 0.0}}));
  }
};

TEST_CASE("H = G (I − G) + ρ G A G") {
  scene const s;
  auto const a = slant::matrix<slant::self_adjoint, slant::positive_definite>(s.m);
  auto const f = slant::natural_residual(a, s.b, s.set(), s.ρ);
  auto const newton = f.slant(s.x);
  auto const h = slant::symmetrized(newton);
  static_assert(slant::psd_operator<std::remove_cvref_t<decltype(h)>, VectorXd>);
  MatrixXd const hd = dense(h, s.x);
  MatrixXd const g = dense(slant::slant_of_projection(newton), s.x);
  MatrixXd const id = MatrixXd::Identity(8, 8);
  CHECK((hd - (g * (id - g) + s.ρ * g * s.m * g)).norm() <= 1e-15 * hd.norm());
  VectorXd const radial = VectorXd::Unit(8, 6);  // the disc of radius 0 cannot move
  CHECK((hd * radial).norm() == 0);
}

TEST_CASE("one product by A each, no allocation, follows renewals of the operator") {
  scene const s;
  auto const a = slant::counted(slant::matrix<slant::self_adjoint, slant::positive_definite>(s.m));
  auto const f = slant::natural_residual(a, s.b, s.set(), s.ρ);
  auto newton = f.slant(VectorXd::Zero(8).eval());
  auto const h = slant::symmetrized(newton);
  auto wf = slant::workspace(f, s.x);
  auto w = slant::workspace(h, s.x);
  VectorXd y(8);
  CHECK(test::allocations_of([&] {
          slant::update_slant(f, s.x, newton, wf);
          a.reset_counts();
          slant::apply(h, s.x, y, w);
        }) == 0);
  CHECK(a.counts().applications == 1);
  CHECK(dense(h, s.x) == dense(slant::symmetrized(f.slant(s.x)), s.x));
}

TEST_CASE("archetypes") {
  namespace archetype = slant::testing::archetype;
  scene const s;
  archetype::spd_operator const a(s.m);
  auto const f = slant::natural_residual(a, s.b, s.set(), s.ρ);
  archetype::vector const x(s.x);
  auto const h = slant::symmetrized(f.slant(x));
  CHECK(dense(h, x).isApprox(dense(h, x).transpose(), 1e-13));
}

// symmetrizable is known from the types: each case that is not differs in one thing from one that
// is.

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

}  // namespace symmetrized_test
