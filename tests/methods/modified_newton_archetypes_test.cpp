// SPDX-License-Identifier: MIT
//
// MSSN, IMSSN, GIMSSN, QPQ, QPC and CG_feas ask their archetypes for nothing more than the concepts
// name.
#include "example_one.hpp"

#include <slant/iteration/solve.hpp>
#include <slant/krylov/face_cg.hpp>
#include <slant/methods/kprgp.hpp>
#include <slant/methods/mssn.hpp>
#include <slant/testing/archetypes.hpp>

#include <doctest/doctest.h>

namespace modified_newton_archetypes_test {

namespace archetype = slant::testing::archetype;
using Eigen::VectorXd;

/// Points without negative entries, with one block an entry: faces of their own.
struct entrywise : archetype::basic_active_set_set<VectorXd> {
  using basic_active_set_set::basic_active_set_set;
  [[nodiscard]] archetype::face face_of(VectorXd const& x) const {
    archetype::face face;
    face.assign(*this, x);
    return face;
  }
};

TEST_CASE("operator, vector and set that can do the least") {
  archetype::psd_operator const A(Eigen::MatrixXd{{2.0, 1.0}, {1.0, 2.0}});
  archetype::vector const b(VectorXd{{3.0, -3.0}});
  archetype::vector const x0(VectorXd{{1.0, 1.0}});
  auto const check = [&](auto const& method) {
    auto const r =
        slant::solve(method, x0, slant::reduced_gradient_below(1e-12) || slant::at_most(100));
    REQUIRE(r.converged());
    CHECK(r.x().local()(0) == doctest::Approx(1.5));
    CHECK(r.x().local()(1) == 0.0);
  };
  archetype::basic_active_set_set<VectorXd> const one_block(2);
  auto const single = slant::separable_qp{A, b, one_block};
  check(slant::gimssn{single});
  check(slant::imssn{single});
  entrywise const set(2);
  auto const qp = slant::separable_qp{A, b, set};
  check(slant::mssn{qp});
  check(slant::imssn{qp});
  check(slant::gimssn{qp});
  check(slant::as_s(qp));
  check(slant::qpq{qp});
  check(slant::qpc{qp});
}

TEST_CASE("cg_feas: a face that can only keep, a set of one block") {
  archetype::psd_operator const A(Eigen::MatrixXd{{2.0, 1.0}, {1.0, 2.0}});
  archetype::vector const b(VectorXd{{3.0, -3.0}});
  archetype::basic_active_set_set<VectorXd> const set(2);
  archetype::face all;
  all.assign(set, VectorXd{{1.0, 1.0}});
  auto const r =
      slant::solve(slant::cg_feas{A, b, set, all}, archetype::vector(VectorXd{{1.0, 1.0}}),
                   slant::residual_below(1e-12) || slant::at_most(10));
  CHECK(r.state.at_boundary);
  CHECK(r.state.blocked == std::vector<slant::index>{0});
}

TEST_CASE("a scalar without silent conversions gives the bits of double") {
  using S = archetype::scalar;
  test::example_one<S> const strict;
  test::example_one<double> const plain;
  auto const qp = slant::separable_qp{strict.a(), strict.b, strict.set()};
  auto const reference = slant::separable_qp{plain.a(), plain.b, plain.set()};
  auto const check = [&](auto const& method, auto const& twin) {
    auto const r = slant::solve(method, strict.zero(),
                                slant::reduced_gradient_below(S(1e-6)) || slant::at_most(500));
    auto const expected = slant::solve(twin, plain.zero(),
                                       slant::reduced_gradient_below(1e-6) || slant::at_most(500));
    REQUIRE(r.converged());
    CHECK(r.iterations() == expected.iterations());
    VectorXd const x = r.x().unaryExpr([](S const& x_i) { return x_i.value(); });
    CHECK((x - expected.x()).norm() <= 1e-13 * expected.x().norm());
  };
  check(slant::imssn{qp}, slant::imssn{reference});
  check(slant::gimssn{qp}, slant::gimssn{reference});
  check(slant::qpq{qp}, slant::qpq{reference});
}

}  // namespace modified_newton_archetypes_test
