// SPDX-License-Identifier: MIT
#include <slant/factorizations/factorizations.hpp>
#include <slant/testing/laws.hpp>

#include <support/testing.hpp>
#include "factorizations/tail_factor.hpp"

namespace condensed_operator_test {

using namespace test::evaluated;
using slant::index;
using exact = slant::condensed_operator<double>;
using rounded = slant::condensed_operator<float>;

static_assert(slant::psd_operator<exact, VectorXd>);
static_assert(slant::psd_operator<rounded, VectorXd>);
static_assert(slant::has_rounded<exact, VectorXd>);
static_assert(!slant::has_rounded<rounded, VectorXd>);

// How A is applied.
using by_sweeps = std::false_type;
using by_inverse = std::true_type;

std::shared_ptr<sparse const> shared(sparse const& b) {
  return std::make_shared<sparse const>(b);
}

/// 20 rows, each with two entries or three.
struct scene {
  test::tail_factor factor;
  sparse B{20, 44};
  std::shared_ptr<slant::detail::tail_columns const> columns;
  std::shared_ptr<slant::detail::packed_symmetric<double> const> inverse;  // may be missing
  double unit = 0.25;

  explicit scene(bool formed) {
    for (int i = 0; i < 20; ++i) {
      B.insert(i, 2 * i) = 1.0 + 0.1 * i;
      B.insert(i, 43 - i) = -0.5;
      if (i % 3 == 0) B.insert(i, 2 * i + 1) = 2;
    }
    columns = std::shared_ptr<slant::detail::tail_columns const>(
        new slant::detail::tail_columns(factor.columns()));
    if (!formed) return;
    std::vector<int> all(44);
    std::iota(all.begin(), all.end(), 0);
    inverse = slant::detail::tail_inverse(*columns, all);
  }
  [[nodiscard]] exact condensed() const {
    if (inverse) return {shared(B), inverse, unit};
    return {shared(B), columns, unit};
  }
  /// u B (L Lᵀ)⁻¹Bᵀ.
  [[nodiscard]] MatrixXd dense() const {
    return unit * MatrixXd(B) * factor.solved(MatrixXd(B.transpose()));
  }
};

TEST_CASE_TEMPLATE("u B L⁻ᵀL⁻¹Bᵀ as by dense matrices, for one or several right-hand sides", Way,
                   by_sweeps, by_inverse) {
  scene const s(Way::value);
  auto const a = s.condensed();
  MatrixXd const A = s.dense();
  CHECK(a.rows() == 20);
  CHECK(a.cols() == 20);
  CHECK(a.bytes() == (s.inverse ? s.inverse->bytes() : 2 * 8 * s.factor.shape->entries()));
  for (index const k : {1, 2, 7}) {
    MatrixXd const X = MatrixXd::Random(20, k);
    MatrixXd Y = MatrixXd::Constant(20, k, std::numeric_limits<double>::quiet_NaN());
    auto w = slant::workspace(a, X);
    CHECK(test::allocations_of([&] { slant::apply(a, X, Y, w); }) == 0);
    CHECK((Y - A * X).norm() < 1e-14 * Y.norm());
  }
}

TEST_CASE_TEMPLATE("its laws, and those of its rounded twin", Way, by_sweeps, by_inverse) {
  auto const a = scene(Way::value).condensed();
  slant::testing::check_operator_laws(a);
  slant::testing::check_operator_laws(a.rounded(), {.roundings = 1e10});
}

TEST_CASE_TEMPLATE("a workspace fits other numbers of right-hand sides", Way, by_sweeps,
                   by_inverse) {
  auto const a = scene(Way::value).condensed();
  auto w = slant::workspace(a, test::zeros(20));
  MatrixXd const X = MatrixXd::Random(20, 3);
  MatrixXd Y(20, 3), Z(20, 3);
  slant::apply(a, X, Y);
  slant::apply(a, X, Z, w);
  CHECK(Y == Z);
}

TEST_CASE_TEMPLATE("the rounded twin: floats, made once, for right-hand sides of any scale", Way,
                   by_sweeps, by_inverse) {
  scene const s(Way::value);
  auto const a = s.condensed();
  auto const twin = a.rounded();
  CHECK(twin.bytes() < a.bytes());
  {
    CHECK(test::allocations_of([&] { (void)a.rounded(); }) == 0);
  }
  VectorXd const direction = VectorXd::Random(20);
  VectorXd x = direction, y(20), z(20);
  auto w = slant::workspace(twin, x);
  for (double const scale : {1.0, 1e-150, 1e150, 1e-300, 1e300}) {
    x = scale * direction;
    slant::apply(a, x, y);
    CHECK(test::allocations_of([&] { slant::apply(twin, x, z, w); }) == 0);
    double const size = y.cwiseAbs().maxCoeff();
    CHECK((y - z).cwiseAbs().maxCoeff() < 1e-5 * size);
    CHECK((y - z).cwiseAbs().maxCoeff() > 1e-12 * size);
  }
  // Each column in its own units: the small one is as good as alone.
  MatrixXd pair(20, 2), images(20, 2);
  pair << 1e-200 * direction, 1e200 * direction;
  slant::apply(twin, pair, images);
  slant::apply(twin, direction, z);
  CHECK((images.col(0) * 1e200 - z).norm() < 1e-6 * z.norm());
  CHECK((images.col(1) * 1e-200 - z).norm() < 1e-6 * z.norm());
  x.setZero();
  slant::apply(twin, x, z, w);
  CHECK(z.isZero(0));
}

TEST_CASE_TEMPLATE("the unit of K is a factor, and changes no digit", Way, by_sweeps, by_inverse) {
  scene s(Way::value);
  VectorXd const x = VectorXd::Random(20);
  VectorXd y(20), z(20);
  slant::apply(s.condensed(), x, y);
  for (int const e : {-500, 500}) {
    s.unit = std::ldexp(0.25, e);
    slant::apply(s.condensed(), x, z);
    CHECK(z * std::ldexp(1.0, -e) == y);
  }
}

TEST_CASE_TEMPLATE("an operator outlives what it was made of", Way, by_sweeps, by_inverse) {
  std::optional<scene> s(std::in_place, Way::value);
  VectorXd const x = VectorXd::Random(20);
  VectorXd const expected = s->dense() * x;
  auto const a = s->condensed();
  s.reset();
  VectorXd y(20);
  slant::apply(a, x, y);
  CHECK((y - expected).norm() < 1e-14 * y.norm());
}

TEST_CASE("nothing in contact, and no rows") {
  auto const shape = std::make_shared<slant::detail::tail_shape>();
  std::shared_ptr<slant::detail::tail_columns const> const nothing(new slant::detail::tail_columns(
      shape, std::vector<slant::detail::tail_columns::matrix>{}, nullptr));
  exact const none(shared(sparse(2, 0)), nothing, 1.0);
  VectorXd y = VectorXd::Ones(2);
  slant::apply(none, VectorXd(VectorXd::Ones(2)), y);
  CHECK(y.isZero(0));
  y.setOnes();
  slant::apply(none.rounded(), VectorXd(VectorXd::Ones(2)), y);
  CHECK(y.isZero(0));

  scene const s(false);
  exact const empty(shared(sparse(0, 44)), s.columns, s.unit);
  VectorXd zero(0);
  slant::apply(empty, VectorXd(zero), zero);
}

TEST_CASE_TEMPLATE("sizes that do not fit are refused", Way, by_sweeps, by_inverse) {
  scene const s(Way::value);
  auto const a = s.condensed();
  VectorXd y(20);
  CHECK(SLANT_COMPLAINT(slant::apply(a, VectorXd(VectorXd::Ones(19)), y)).starts_with("x: got 19"));
  VectorXd few(3);
  CHECK(
      SLANT_COMPLAINT(slant::apply(a, VectorXd(VectorXd::Ones(20)), few)).starts_with("y: got 3"));
  CHECK(SLANT_COMPLAINT(exact(shared(sparse(2, 43)), s.columns, 1.0))
            .starts_with("columns of B: got 43"));
  if (!s.inverse) return;
  CHECK(SLANT_COMPLAINT(exact(shared(sparse(2, 43)), s.inverse, 1.0))
            .starts_with("columns of B: got 43"));
}

}  // namespace condensed_operator_test
