// SPDX-License-Identifier: MIT
#include <slant/factorizations/static_condensation.hpp>

#include <slant/contact/contact_unknowns.hpp>
#include <slant/testing/operator_laws.hpp>

#include <doctest/doctest.h>
#include <Eigen/LU>

#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "factorizations/spd_examples.hpp"
#include "support/allocation_guard.hpp"

namespace static_condensation_test {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using sparse = Eigen::SparseMatrix<double>;
using slant::index;

static_assert(slant::factorization<slant::static_condensation<double>, VectorXd>);
static_assert(slant::declares_positive_definite<slant::static_condensation<double>>);

/// Nodes of the bottom of the cube, two of three, each in a row of its own; and a row that couples
/// two.
struct scene {
  sparse K;
  sparse B;
  std::vector<index> contact;

  explicit scene(int k) : K(test::grid_laplacian(k, 0.1)) {
    std::vector<Eigen::Triplet<double>> entries;
    int rows = 0;
    for (int i = 0; i < k * k; ++i) {
      if (i % 3 != 2) entries.emplace_back(rows++, i, 1.0 + 0.01 * i);
    }
    entries.emplace_back(rows, 0, -1.0);
    entries.emplace_back(rows++, k * k - 1 - (k * k - 1) % 3, 2.0);
    B.resize(rows, K.cols());
    B.setFromTriplets(entries.begin(), entries.end());
    contact = slant::contact::touched_unknowns(B);
  }
  [[nodiscard]] MatrixXd dual() const {
    return MatrixXd(B) * MatrixXd(K).partialPivLu().solve(MatrixXd(B.transpose()));
  }
};

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

std::string complaint(auto const& make) {
  try {
    make();
  } catch (slant::bad_input const& e) {
    return e.what();
  }
  return "accepted";
}

bool has(std::string const& text, char const* part) {
  return text.find(part) != std::string::npos;
}

TEST_CASE("B K⁻¹Bᵀ and K⁻¹ as by a dense matrix, however far the condensation goes") {
  scene const s(7);
  MatrixXd const A = s.dual();
  for (std::optional<index> const levels : {std::optional<index>{}, {0}, {1}, {2}, {4}, {40}}) {
    slant::condensation_options options;
    options.levels = levels;
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
    CHECK((y - Y.col(3)).norm() < 1e-15 * y.norm());
  }
}

TEST_CASE("the operator keeps its laws") {
  scene const s(4);
  slant::static_condensation const factor(s.K, s.contact);
  slant::testing::check_operator_laws(factor.restricted(s.B));
}

TEST_CASE("another matrix with the same unknowns") {
  scene const s(5);
  slant::static_condensation const factor(s.K, s.contact);
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
  CHECK(has(complaint([&] { (void)factor.refactorized(sparse(3, 3)); }), "rows of K"));
}

TEST_CASE("units change no digit") {
  scene const s(4);
  slant::static_condensation const factor(s.K, s.contact);
  VectorXd const x = VectorXd::Random(s.B.rows());
  VectorXd y(x.size()), z(x.size());
  slant::apply(factor.restricted(s.B), x, y);
  for (int const e : {-500, 500}) {
    sparse const K = s.K * std::ldexp(1.0, e);
    slant::static_condensation const scaled(K, s.contact);
    slant::apply(scaled.restricted(s.B), x, z);
    CHECK(z * std::ldexp(1.0, e) == y);
  }
}

TEST_CASE("degenerate: nothing in contact, everything, empty rows, no unknowns") {
  scene const s(3);
  slant::static_condensation const none(s.K, {});
  VectorXd y = VectorXd::Ones(2);
  slant::apply(none.restricted(sparse(2, s.K.cols())), VectorXd(VectorXd::Ones(2)), y);
  CHECK(y.isZero(0));

  std::vector<index> all;
  for (index i = 0; i < s.K.rows(); ++i) all.push_back(i);
  slant::static_condensation const whole(s.K, all);
  sparse identity(s.K.rows(), s.K.cols());
  identity.setIdentity();
  VectorXd const b = test::load(s.K.rows());
  VectorXd x(b.size());
  slant::apply(whole.restricted(identity), b, x);
  CHECK((s.K * x - b).norm() < 1e-13 * b.norm());

  slant::static_condensation const empty(sparse(0, 0), {});
  VectorXd zero(0);
  slant::apply(slant::inverse(empty), VectorXd(zero), zero);
  CHECK(empty.restricted(sparse(0, 0)).rows() == 0);
}

TEST_CASE("bad input is named") {
  scene const s(3);
  auto const make = [&](std::vector<index> const& contact) {
    return complaint([&] { slant::static_condensation(s.K, contact); });
  };
  CHECK(has(make({0, 99}), "contact[1]: got 99"));
  CHECK(has(make({-1}), "contact[0]: got -1"));
  CHECK(has(make({4, 4}), "contact[1]: got 4"));
  CHECK(has(complaint([&] { slant::static_condensation(sparse(2, 3), {}); }), "K"));
  CHECK(has(complaint([&] { slant::static_condensation(sparse(-s.K), s.contact); }), "pivot"));
  sparse with_nan = s.K;
  with_nan.coeffRef(2, 2) = std::numeric_limits<double>::quiet_NaN();
  CHECK(has(complaint([&] { slant::static_condensation(with_nan, s.contact); }), "nan"));

  slant::static_condensation const factor(s.K, {0, 1, 3, 4});
  CHECK(has(complaint([&] { (void)factor.restricted(s.B); }), "touch contact unknowns only"));
  CHECK(has(complaint([&] { (void)factor.restricted(sparse(2, 3)); }), "B"));
}

#if defined(SLANT_HAS_CHOLMOD) && SLANT_HAS_CHOLMOD

TEST_CASE("the report says what was compared, what was done, and why") {
  scene const s(8);
  slant::static_condensation const factor(s.K, s.contact);
  auto const& report = factor.report();
  CHECK(report.factorization == "cholmod");
  CHECK(report.unknowns == 512);
  CHECK(report.contact == index(s.contact.size()));
  REQUIRE(report.plans.size() >= 2);
  CHECK(report.plans[0].levels == 0);
  CHECK(report.plans[0].tail == doctest::Approx(double(s.contact.size())));
  for (std::size_t i = 1; i < report.plans.size(); ++i) {
    CHECK(report.plans[i].flops <= report.plans[i - 1].flops);
    CHECK(report.plans[i].tail_entries >= report.plans[i - 1].tail_entries);
  }
  for (auto const& plan : report.plans) CHECK(report.chosen.seconds <= plan.seconds);
  CHECK(has(report.reason, "least time predicted"));

  slant::static_condensation const forced(s.K, s.contact, {.levels = 3});
  CHECK(forced.report().plans.size() == 1);
  CHECK(forced.report().chosen.levels == 3);
  CHECK(forced.report().reason == "as asked for");
}

TEST_CASE("what is reported is what was done, whatever the memory") {
  scene const s(6);
  auto const bytes = [&](slant::condensation_options const& o) {
    slant::static_condensation const factor(s.K, s.contact, o);
    return std::pair(factor.report().chosen.levels, factor.restricted(s.B).bytes());
  };
  for (index const applications : {0, 20}) {
    for (double most = 1; most < 3; most += 0.1) {
      auto const [levels, size] =
          bytes({.applications = applications, .cache = 1, .most_memory = most});
      CHECK(bytes({.levels = levels}).second == size);
    }
  }
  CHECK(bytes({.levels = index(1) << 40}).second == bytes({.levels = 1000}).second);
}

TEST_CASE("workspaces fit other numbers of right-hand sides; twins are made once") {
  scene const s(4);
  slant::static_condensation const factor(s.K, s.contact);
  auto const a = factor.restricted(s.B);
  VectorXd const x = VectorXd::Random(a.cols());
  auto w = slant::workspace(a, x);
  MatrixXd const X = MatrixXd::Random(a.cols(), 3);
  MatrixXd Y(a.rows(), 3), Z(a.rows(), 3);
  slant::apply(a, X, Y);
  slant::apply(a, X, Z, w);
  CHECK(Y == Z);
  (void)a.rounded();
  slant::testing::allocation_guard guard;
  (void)a.rounded();
  auto const allocations = guard.count();
  CHECK(allocations == 0);
}

TEST_CASE("a body without contact never enters") {
  scene const s(5);
  index const n = s.K.rows();
  std::vector<Eigen::Triplet<double>> entries;
  for (index j = 0; j < n; ++j) {
    for (sparse::InnerIterator e(s.K, j); e; ++e) {
      for (index const shift : {index(0), n}) {
        entries.emplace_back(int(e.row() + shift), int(j + shift), e.value());
      }
    }
  }
  sparse two(2 * n, 2 * n);
  two.setFromTriplets(entries.begin(), entries.end());
  for (index const levels : {0, 1, 30}) {
    slant::static_condensation const one(s.K, s.contact, {.levels = levels});
    slant::static_condensation const both(two, s.contact, {.levels = levels});
    CHECK(both.report().chosen.tail <= double(n));
    if (levels == 0) CHECK(both.report().chosen.tail == one.report().chosen.tail);
  }
}

TEST_CASE("rounded products: floats, for right-hand sides of any scale") {
  scene const s(6);
  slant::static_condensation const factor(s.K, s.contact);
  auto const a = factor.restricted(s.B);
  auto const twin = a.rounded();
  static_assert(slant::psd_operator<decltype(twin), VectorXd>);
  VectorXd const direction = VectorXd::Random(a.cols());
  VectorXd x = direction, y(a.rows()), z(a.rows());
  auto w = slant::workspace(twin, x);
  for (double const scale : {1.0, 1e-150, 1e150, 1e-300}) {
    x = scale * direction;
    slant::apply(a, x, y);
    slant::testing::allocation_guard guard;
    slant::apply(twin, x, z, w);
    auto const allocations = guard.count();
    CHECK(allocations == 0);
    double const size = y.cwiseAbs().maxCoeff();
    CHECK((y - z).cwiseAbs().maxCoeff() < 1e-6 * size);
    CHECK((y - z).cwiseAbs().maxCoeff() > 1e-12 * size);
  }
  x.setZero();
  slant::apply(twin, x, z, w);
  CHECK(z.isZero(0));
}

TEST_CASE("A as a dense matrix") {
  scene const s(5);
  slant::static_condensation const factor(s.K, s.contact);
  MatrixXd const A = factor.restricted(s.B).formed();
  CHECK((A - s.dual()).norm() < 1e-13 * A.norm());
  CHECK(A == A.transpose());
}

#else

TEST_CASE("without SuiteSparse the report says what would be faster") {
  scene const s(3);
  slant::static_condensation const factor(s.K, s.contact);
  CHECK(factor.report().factorization == "ldlt");
  CHECK(has(factor.report().reason, "SuiteSparse"));
}

#endif

}  // namespace static_condensation_test
