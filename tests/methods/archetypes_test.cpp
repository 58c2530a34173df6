// SPDX-License-Identifier: MIT
//
// Methods ask their archetypes for nothing more than the concepts name.
#include <slant/slant.hpp>
#include <slant/testing/archetypes.hpp>

#include <support/minimise.hpp>
#include <support/testing.hpp>
#include "example_one.hpp"

namespace archetypes_test {

namespace archetype = slant::testing::archetype;
using one_block = archetype::basic_active_set_set<VectorXd>;

/// Points without negative entries, with one block an entry: faces of their own.
struct entrywise : one_block {
  using basic_active_set_set::basic_active_set_set;
  [[nodiscard]] archetype::face face_of(VectorXd const& x) const {
    archetype::face face;
    face.assign(*this, x);
    return face;
  }
};
static_assert(slant::face_for<archetype::face, entrywise, VectorXd, archetype::vector>);

TEST_CASE("operator, vector and set that can do the least") {
  archetype::psd_operator const A(MatrixXd{{2.0, 1.0}, {1.0, 2.0}});
  archetype::vector const b(VectorXd{{3.0, -3.0}}), x0(VectorXd{{1.0, 1.0}});
  auto const check = [&](auto const& method) {
    auto const r = test::minimise(method, x0, 1e-12, 100);
    REQUIRE(r.converged());
    CHECK(r.x().local()(0) == doctest::Approx(1.5));
    CHECK(r.x().local()(1) == 0.0);
    return r.state;
  };
  one_block const whole(2);
  auto const single = slant::separable_qp{A, b, whole};
  check(slant::kprgp{single});
  check(slant::gimssn{single});
  check(slant::imssn{single});
  entrywise const set(2);
  auto const qp = slant::separable_qp{A, b, set};
  check(slant::mssn{qp});
  check(slant::gimssn{qp});
  check(slant::as_s(qp));
  check(slant::qpq{qp});
  check(slant::qpc{qp});
  auto const state = check(slant::kprgp{qp});
  static_assert(std::is_same_v<std::decay_t<decltype(state.face)>, archetype::face>);
  CHECK(state.face.state(0) == slant::block_state::free);
  CHECK(state.face.state(1) == slant::block_state::fixed);
}

TEST_CASE("interior_point, symmetric_newton: blocks of the library on vectors of another kind") {
  archetype::psd_operator const A(MatrixXd{{4.0, 0.0, 0.0}, {0.0, 4.0, 1.0}, {0.0, 1.0, 4.0}});
  archetype::psd_operator const M(MatrixXd::Identity(3, 3));
  archetype::vector const b(VectorXd{{-3.0, 8.0, 8.0}}), zero(VectorXd::Zero(3));
  auto const set = slant::cartesian(slant::half_lines(1), slant::discs(VectorXd{{1.0}}));
  slant::separable_qp const qp{A, b, set};
  auto const check = [&](auto const& method) {
    auto const r = test::minimise(method, zero, 1e-10, 50);
    REQUIRE(r.converged());
    CHECK((r.x().local() - VectorXd{{0.0, std::sqrt(0.5), std::sqrt(0.5)}}).norm() <= 1e-9);
  };
  check(slant::interior_point{qp});
  check(slant::symmetric_newton{qp});
  check(slant::symmetric_newton{qp, M});
}

/// The vectors whose entries have a given sum.
struct of_given_sum {
  archetype::vector point;  // next to 0
  archetype::psd_operator Q, P;

  of_given_sum(Eigen::Index n, double sum)
      : point(VectorXd::Constant(n, sum / double(n))),
        Q(MatrixXd::Constant(n, n, 1.0 / double(n))),
        P(MatrixXd::Identity(n, n) - MatrixXd::Constant(n, n, 1.0 / double(n))) {}
  [[nodiscard]] Eigen::Index size() const { return point.local().size(); }
  [[nodiscard]] archetype::psd_operator range_projector() const { return Q; }
  [[nodiscard]] archetype::psd_operator kernel_projector() const { return P; }
  [[nodiscard]] archetype::vector const& nearest() const { return point; }
};

TEST_CASE("smalse: an affine space that can do the least") {
  archetype::psd_operator const A(MatrixXd{{2.0, 1.0, 0.0}, {1.0, 2.0, 0.0}, {0.0, 0.0, 1.0}});
  archetype::vector const b(VectorXd{{3.0, -3.0, 0.0}});
  one_block const set(3);
  auto const qp = slant::separable_qp{A, b, set};
  of_given_sum const constraints(3, 3.0);
  auto const r =
      slant::solve(slant::smalse{qp, constraints}, archetype::vector(VectorXd{{1.0, 1.0, 1.0}}),
                   (slant::reduced_gradient_below(1e-11) && slant::feasibility_below(1e-11)) ||
                       slant::at_most(100));
  REQUIRE(r.converged());
  // x_1 = 0, x_0 + x_2 = 3, 2 x_0 - 3 = x_2.
  CHECK(r.x().local()(0) == doctest::Approx(2.0));
  CHECK(r.x().local()(1) == 0.0);
  CHECK(r.x().local()(2) == doctest::Approx(1.0));
}

TEST_CASE("a scalar without silent conversions gives the bits of double") {
  using S = archetype::scalar;
  test::example_one<S> const strict;
  test::example_one<double> const plain;
  auto const qp = slant::separable_qp{strict.a(), strict.b, strict.set()};
  auto const reference = slant::separable_qp{plain.a(), plain.b, plain.set()};
  auto const check = [&](auto const& method, auto const& twin, double tolerance) {
    auto const r = test::minimise(method, strict.zero(), S(tolerance), 500);
    auto const expected = test::minimise(twin, plain.zero(), tolerance, 500);
    REQUIRE(r.converged());
    CHECK(r.iterations() == expected.iterations());
    VectorXd const x = r.x().unaryExpr([](S const& x_i) { return x_i.value(); });
    CHECK((x - expected.x()).norm() <= 1e-13 * expected.x().norm());
  };
  check(slant::kprgp{qp}, slant::kprgp{reference}, 1e-12);
  check(slant::imssn{qp}, slant::imssn{reference}, 1e-6);
  check(slant::gimssn{qp}, slant::gimssn{reference}, 1e-6);
  check(slant::qpq{qp}, slant::qpq{reference}, 1e-6);
}

}  // namespace archetypes_test
