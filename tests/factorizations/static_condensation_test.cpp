// SPDX-License-Identifier: MIT
#include <slant/factorizations/static_condensation.hpp>

#include <slant/testing/operator_laws.hpp>

#include <doctest/doctest.h>
#include <Eigen/LU>

#include <cmath>
#include <limits>
#include <optional>
#include <type_traits>
#include <vector>

#include "factorizations/condensation_scene.hpp"
#include "factorizations/spd_examples.hpp"
#include "support/allocation_guard.hpp"
#include "support/message.hpp"

namespace static_condensation_test {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using sparse = Eigen::SparseMatrix<double>;
using scene = test::condensation_scene;
using slant::index;

static_assert(slant::factorization<slant::static_condensation<double>, VectorXd>);
static_assert(slant::declares_positive_definite<slant::static_condensation<double>>);

TEST_CASE("an operator outlives the factorisation, other scalars included") {
  sparse const k = test::grid_laplacian(3, 0.1);
  Eigen::SparseMatrix<float> const K = k.cast<float>();
  Eigen::SparseMatrix<float> B(2, K.cols());
  B.insert(0, 0) = 1;
  B.insert(1, 2) = -1;
  auto const a = [&] {
    slant::static_condensation const factor(K, {0, 2});
    CHECK(factor.name() == "ldlt");
    return factor.restricted(B);
  }();
  Eigen::VectorXf const x = Eigen::VectorXf::Ones(2);
  Eigen::VectorXf y(2);
  slant::apply(a, x, y);
  MatrixXd const A = MatrixXd(B.cast<double>()) *
                     MatrixXd(k).partialPivLu().solve(MatrixXd(B.cast<double>().transpose()));
  CHECK((y.cast<double>() - A * x.cast<double>()).norm() < 1e-5 * y.norm());
}

TEST_CASE("B K⁻¹Bᵀ and K⁻¹ as by a dense matrix, however far the condensation goes") {
  scene const s(7);
  MatrixXd const A = s.dual();
  for (std::optional<index> const levels : {std::optional<index>{}, {0}, {1}, {2}, {4}, {40}}) {
    for (bool const inverse : {false, true}) {
      slant::condensation_options options;
      options.levels = levels;
      options.inverse = inverse;
      slant::static_condensation const factor(s.K, s.contact, options);
      CHECK(test::residual(factor, s.K) < 1e-13);
      auto const a = factor.restricted(s.B);
      MatrixXd const X = MatrixXd::Random(a.cols(), 5);
      MatrixXd Y = MatrixXd::Constant(a.rows(), 5, std::numeric_limits<double>::quiet_NaN());
      slant::apply(a, X, Y);
      CHECK((Y - A * X).norm() < 1e-13 * Y.norm());
      VectorXd const x = X.col(3);
      VectorXd y = Y.col(0);
      auto w = slant::workspace(a, x);
      slant::testing::allocation_guard guard;
      slant::apply(a, x, y, w);
      auto const allocations = guard.count();
      CHECK(allocations == 0);
      CHECK((y - Y.col(3)).norm() < 1e-14 * y.norm());
    }
  }
}

// How A is applied.
using by_sweeps = std::false_type;
using by_inverse = std::true_type;

TEST_CASE_TEMPLATE("the operator keeps its laws", Way, by_sweeps, by_inverse) {
  scene const s(4);
  slant::static_condensation const factor(s.K, s.contact, {.inverse = Way::value});
  slant::testing::check_operator_laws(factor.restricted(s.B));
}

TEST_CASE_TEMPLATE("another matrix with the same unknowns", Way, by_sweeps, by_inverse) {
  scene const s(5);
  slant::static_condensation const factor(s.K, s.contact, {.inverse = Way::value});
  sparse K = 3 * s.K;
  K.diagonal().array() += 0.5;
  slant::static_condensation const anew(K, s.contact);
  auto const again = factor.refactorized(K);
  VectorXd const x = VectorXd::Random(s.B.rows());
  VectorXd y(x.size()), z(x.size());
  slant::apply(anew.restricted(s.B), x, y);
  slant::apply(again.restricted(s.B), x, z);
  CHECK((y - z).norm() < 1e-13 * y.norm());
  slant::apply(factor.restricted(s.B), x, z);
  CHECK((y - z).norm() > 0.1 * y.norm());  // the first one is what it was
  CHECK(test::contains(test::complaint([&] { (void)factor.refactorized(sparse(3, 3)); }),
                       "rows of K"));
}

TEST_CASE_TEMPLATE("units change no digit", Way, by_sweeps, by_inverse) {
  scene const s(4);
  slant::condensation_options const options{.inverse = Way::value};
  slant::static_condensation const factor(s.K, s.contact, options);
  VectorXd const x = VectorXd::Random(s.B.rows());
  VectorXd y(x.size()), z(x.size());
  slant::apply(factor.restricted(s.B), x, y);
  for (int const e : {-500, 500}) {
    sparse const K = s.K * std::ldexp(1.0, e);
    slant::static_condensation const scaled(K, s.contact, options);
    slant::apply(scaled.restricted(s.B), x, z);
    CHECK(z * std::ldexp(1.0, e) == y);
  }
}

TEST_CASE_TEMPLATE("degenerate: nothing in contact, everything, empty rows, no unknowns", Way,
                   by_sweeps, by_inverse) {
  scene const s(3);
  slant::condensation_options const options{.inverse = Way::value};
  slant::static_condensation const none(s.K, {}, options);
  VectorXd y = VectorXd::Ones(2);
  slant::apply(none.restricted(sparse(2, s.K.cols())), VectorXd(VectorXd::Ones(2)), y);
  CHECK(y.isZero(0));

  std::vector<index> all;
  for (index i = 0; i < s.K.rows(); ++i) all.push_back(i);
  slant::static_condensation const whole(s.K, all, options);
  sparse identity(s.K.rows(), s.K.cols());
  identity.setIdentity();
  VectorXd const b = test::load(s.K.rows());
  VectorXd x(b.size());
  slant::apply(whole.restricted(identity), b, x);
  CHECK((s.K * x - b).norm() < 1e-13 * b.norm());

  slant::static_condensation const empty(sparse(0, 0), {}, options);
  VectorXd zero(0);
  slant::apply(slant::inverse(empty), VectorXd(zero), zero);
  CHECK(empty.restricted(sparse(0, 0)).rows() == 0);
}

TEST_CASE("bad input is named") {
  scene const s(3);
  auto const make = [&](std::vector<index> const& contact) {
    return test::complaint([&] { slant::static_condensation(s.K, contact); });
  };
  CHECK(test::contains(make({0, 99}), "contact[1]: got 99"));
  CHECK(test::contains(make({-1}), "contact[0]: got -1"));
  CHECK(test::contains(make({4, 4}), "contact[1]: got 4"));
  CHECK(
      test::contains(test::complaint([&] { slant::static_condensation(sparse(2, 3), {}); }), "K"));
  CHECK(test::contains(
      test::complaint([&] { slant::static_condensation(sparse(-s.K), s.contact); }), "pivot"));
  sparse with_nan = s.K;
  with_nan.coeffRef(2, 2) = std::numeric_limits<double>::quiet_NaN();
  CHECK(test::contains(test::complaint([&] { slant::static_condensation(with_nan, s.contact); }),
                       "nan"));

  slant::static_condensation const factor(s.K, {0, 1, 3, 4});
  CHECK(test::contains(test::complaint([&] { (void)factor.restricted(s.B); }),
                       "touch contact unknowns only"));
  CHECK(test::contains(test::complaint([&] { (void)factor.restricted(sparse(2, 3)); }), "B"));
}

}  // namespace static_condensation_test
