// SPDX-License-Identifier: MIT
//
// KPRGP asks its archetypes for nothing more than the concepts name.
#include "example_one.hpp"

#include <slant/iteration/solve.hpp>
#include <slant/methods/kprgp.hpp>
#include <slant/testing/archetypes.hpp>

#include <doctest/doctest.h>

namespace kprgp_archetypes_test {

namespace archetype = slant::testing::archetype;
using Eigen::VectorXd;

TEST_CASE("operator, vector and set that can do the least") {
  archetype::psd_operator const A(Eigen::MatrixXd{{2.0, 1.0}, {1.0, 2.0}});
  archetype::vector const b(VectorXd{{3.0, -3.0}});
  archetype::basic_active_set_set<VectorXd> const set(2);
  auto const qp = slant::separable_qp{A, b, set};
  auto const r = slant::solve(slant::kprgp{qp}, archetype::vector(VectorXd{{1.0, 1.0}}),
                              slant::reduced_gradient_below(1e-12) || slant::at_most(100));
  REQUIRE(r.converged());
  CHECK(r.x().local()(0) == doctest::Approx(1.5));
  CHECK(r.x().local()(1) == 0.0);
}

/// Points without negative entries, with one block an entry: faces of their own.
struct entrywise : archetype::basic_active_set_set<VectorXd> {
  using basic_active_set_set::basic_active_set_set;
  [[nodiscard]] archetype::face face_of(VectorXd const& x) const {
    archetype::face face;
    face.assign(*this, x);
    return face;
  }
};
static_assert(slant::face_for<archetype::face, entrywise, VectorXd, archetype::vector>);

TEST_CASE("a set that brings faces of its own") {
  archetype::psd_operator const A(Eigen::MatrixXd{{2.0, 1.0}, {1.0, 2.0}});
  archetype::vector const b(VectorXd{{3.0, -3.0}});
  entrywise const set(2);
  auto const r = slant::solve(slant::kprgp{slant::separable_qp{A, b, set}},
                              archetype::vector(VectorXd{{1.0, 1.0}}),
                              slant::reduced_gradient_below(1e-12) || slant::at_most(100));
  static_assert(std::is_same_v<decltype(r.state.face), archetype::face>);
  REQUIRE(r.converged());
  CHECK(r.x().local()(0) == doctest::Approx(1.5));
  CHECK(r.x().local()(1) == 0.0);
  CHECK(r.state.face.state(0) == slant::block_state::free);
  CHECK(r.state.face.state(1) == slant::block_state::fixed);
}

TEST_CASE("a scalar without silent conversions gives the bits of double") {
  using S = archetype::scalar;
  test::example_one<S> const strict;
  test::example_one<double> const plain;
  auto const qp = slant::separable_qp{strict.a(), strict.b, strict.set()};
  auto const reference = slant::separable_qp{plain.a(), plain.b, plain.set()};
  auto const r = slant::solve(slant::kprgp{qp}, strict.zero(),
                              slant::reduced_gradient_below(S(1e-12)) || slant::at_most(500));
  auto const expected = slant::solve(slant::kprgp{reference}, plain.zero(),
                                     slant::reduced_gradient_below(1e-12) || slant::at_most(500));
  REQUIRE(r.converged());
  CHECK(r.iterations() == expected.iterations());
  VectorXd const x = r.x().unaryExpr([](S const& x_i) { return x_i.value(); });
  CHECK((x - expected.x()).norm() <= 1e-13 * expected.x().norm());
}

}  // namespace kprgp_archetypes_test
