// SPDX-License-Identifier: MIT
#include <slant/contact/contact_data.hpp>
#include <slant/factorizations/condensation_options.hpp>
#include <slant/factorizations/static_condensation.hpp>

#include <support/testing.hpp>
#include "factorizations/spd_examples.hpp"

namespace static_condensation_test {

using slant::index;
using by_sweeps = std::false_type;
using by_inverse = std::true_type;

/// Nodes of the bottom of the cube, two of three, each in a row of its own; and a row that couples
/// two.
struct scene {
  sparse K, B;
  std::vector<index> contact;

  explicit scene(int k) : K(test::grid_laplacian(k, 0.1)) {
    std::vector<Eigen::Triplet<double>> entries;
    int rows = 0;
    for (int i = 0; i < k * k; ++i)
      if (i % 3 != 2) entries.emplace_back(rows++, i, 1.0 + 0.01 * i);
    entries.emplace_back(rows, 0, -1.0);
    entries.emplace_back(rows++, k * k - 1 - (k * k - 1) % 3, 2.0);
    B.resize(rows, K.cols());
    B.setFromTriplets(entries.begin(), entries.end());
    contact = slant::contact::touched_unknowns(B);
  }
  [[nodiscard]] MatrixXd dual() const {
    return B * test::solutions_of(MatrixXd(K), MatrixXd(B.transpose()));
  }
};

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
                     test::solutions_of(MatrixXd(k), MatrixXd(B.cast<double>().transpose()));
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
      CHECK(test::allocations_of([&] { slant::apply(a, x, y, w); }) == 0);
      CHECK((y - Y.col(3)).norm() < 1e-14 * y.norm());
    }
  }
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
  CHECK(test::contains(SLANT_COMPLAINT(factor.refactorized(sparse(3, 3))), "rows of K"));
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
    return SLANT_COMPLAINT(slant::static_condensation(s.K, contact));
  };
  CHECK(test::contains(make({0, 99}), "contact[1]: got 99"));
  CHECK(test::contains(make({-1}), "contact[0]: got -1"));
  CHECK(test::contains(make({4, 4}), "contact[1]: got 4"));
  CHECK(test::contains(SLANT_COMPLAINT(slant::static_condensation(sparse(2, 3), {})), "K"));
  CHECK(test::contains(SLANT_COMPLAINT(slant::static_condensation(sparse(-s.K), s.contact)),
                       "pivot"));
  sparse with_nan = s.K;
  with_nan.coeffRef(2, 2) = std::numeric_limits<double>::quiet_NaN();
  CHECK(test::contains(SLANT_COMPLAINT(slant::static_condensation(with_nan, s.contact)), "nan"));

  slant::static_condensation const factor(s.K, {0, 1, 3, 4});
  CHECK(test::contains(SLANT_COMPLAINT(factor.restricted(s.B)), "touch contact unknowns only"));
  CHECK(test::contains(SLANT_COMPLAINT(factor.restricted(sparse(2, 3))), "B"));
}

#if defined(SLANT_HAS_CHOLMOD) && SLANT_HAS_CHOLMOD

TEST_CASE("the report says what was compared, what was done, and why") {
  scene const s(8);
  slant::static_condensation const factor(s.K, s.contact);
  auto const& report = factor.report();
  CHECK(report.factorization == "cholmod");
  CHECK(report.unknowns == 512);
  CHECK(report.contact == index(s.contact.size()));
  REQUIRE(report.plans.size() >= 4);
  CHECK(report.plans[0].levels == 0);
  CHECK(report.plans[0].tail == doctest::Approx(double(s.contact.size())));
  std::size_t const swept = report.plans.size() / 2;
  for (std::size_t i = 0; i < swept; ++i) {  // the same with the inverse
    CHECK(!report.plans[i].inverse);
    CHECK(report.plans[swept + i].inverse);
    CHECK(report.plans[swept + i].levels == report.plans[i].levels);
    CHECK(report.plans[swept + i].forming > 0);
    CHECK(report.plans[swept + i].contact == double(s.contact.size()));
  }
  for (std::size_t i = 1; i < swept; ++i) {
    CHECK(report.plans[i].flops <= report.plans[i - 1].flops);
    CHECK(report.plans[i].tail_entries >= report.plans[i - 1].tail_entries);
  }
  for (auto const& plan : report.plans) CHECK(report.chosen.seconds <= plan.seconds);
  CHECK(test::contains(report.reason, "least time predicted"));

  slant::static_condensation const forced(s.K, s.contact, {.levels = 3, .inverse = true});
  CHECK(forced.report().plans.size() == 1);
  CHECK(forced.report().chosen.levels == 3);
  CHECK(forced.report().chosen.inverse);
  CHECK(forced.report().reason == "as asked for");
}

TEST_CASE("the inverse is formed where there will be many applications") {
  scene const s(8);
  slant::condensation_options options;
  options.most_memory = 10;
  options.applications = 0;
  slant::static_condensation const idle(s.K, s.contact, options);
  CHECK(!idle.report().chosen.inverse);
  options.applications = 100000;
  slant::static_condensation const factor(s.K, s.contact, options);
  CHECK(factor.report().chosen.inverse);
  CHECK(test::contains(factor.report().reason, "inverse"));
  options.inverse = false;
  slant::static_condensation const swept(s.K, s.contact, options);
  CHECK(!swept.report().chosen.inverse);
  CHECK(factor.restricted(s.B).bytes() < swept.restricted(s.B).bytes());
}

/// The same forces held by n unknowns that are all but free to move together: S is nearly singular.
Eigen::SparseMatrix<double> floating(scene const& s, double held) {
  Eigen::SparseMatrix<double> k = s.K;
  VectorXd const sums = k * VectorXd::Ones(k.cols());
  k.diagonal() -= (1 - held) * sums;
  return k;
}

TEST_CASE("an inverse that floats would make indefinite is left, and the report says so") {
  scene const s(5);
  auto const K = floating(s, 1e-9);
  slant::static_condensation const factor(K, s.contact, {.inverse = true});
  CHECK(!factor.report().chosen.inverse);
  CHECK(test::contains(factor.report().reason, "not kept"));
  auto const a = factor.restricted(s.B);
  VectorXd const x = VectorXd::Random(a.rows());
  VectorXd y(x.size());
  slant::apply(a.rounded(), x, y);
  CHECK(x.dot(y) > 0);

  // Another matrix is judged anew.
  slant::static_condensation const fine = factor.refactorized(s.K);
  CHECK(fine.report().chosen.inverse);
  CHECK(!test::contains(fine.report().reason, "not kept"));
  CHECK(fine.restricted(s.B).bytes() != a.bytes());
  slant::static_condensation const again = fine.refactorized(K);
  CHECK(!again.report().chosen.inverse);
  CHECK(test::contains(again.report().reason, "not kept"));
  CHECK(again.restricted(s.B).bytes() == a.bytes());
}

TEST_CASE("whether the inverse is kept does not depend on units, nor on what is stiff elsewhere") {
  scene const s(5);
  slant::condensation_options const options{.inverse = true};
  Eigen::SparseMatrix<double> clamped = s.K;
  clamped.coeffRef(124, 124) += 1e10;  // as a penalty does
  CHECK(slant::static_condensation(clamped, s.contact, options).restricted(s.B).bytes() ==
        slant::static_condensation(s.K, s.contact, options).restricted(s.B).bytes());
  for (int const e : {-500, 500}) {
    Eigen::SparseMatrix<double> const K = s.K * std::ldexp(1.0, e);
    slant::static_condensation const factor(K, s.contact, options);
    CHECK(factor.report().chosen.inverse);
  }
  // A body so soft beside another that floats do not hold its compliance.
  clamped.coeffRef(124, 124) += 1e60;
  slant::static_condensation const soft(clamped, s.contact, options);
  CHECK(!soft.report().chosen.inverse);
}

TEST_CASE("a workspace fits the operator of another matrix, with the inverse or without") {
  scene const s(8);
  // Few unknowns in contact, and deep condensation: the buffers differ.
  std::vector<index> const contact{0, 9, 27, 36, 63};
  Eigen::SparseMatrix<double> B(5, s.K.cols());
  for (int i = 0; i < 5; ++i) B.insert(i, contact[std::size_t(i)]) = 1;
  slant::static_condensation const fine(s.K, contact, {.levels = 30, .inverse = true});
  auto const poor = fine.refactorized(floating(s, 1e-9));
  REQUIRE(fine.report().chosen.inverse);
  REQUIRE(!poor.report().chosen.inverse);
  auto const a = fine.restricted(B), c = poor.restricted(B);
  VectorXd const x = VectorXd::Random(5);
  VectorXd y(5), z(5);
  auto w = slant::workspace(a, x);
  slant::apply(c, x, y, w);
  slant::apply(c, x, z);
  CHECK(y == z);
  slant::apply(a, x, y, w);
  slant::apply(a, x, z);
  CHECK(y == z);
}

TEST_CASE("contact unknowns are counted, not the nodes they belong to") {
  // Three unknowns a node, one of them in contact.
  scene const s(4);
  MatrixXd node = MatrixXd::Constant(3, 3, 0.1);
  node.diagonal().setOnes();
  sparse const K = test::blown_up(s.K, node);
  std::vector<index> const contact{2, 5, 14, 23};
  slant::static_condensation const factor(K, contact, {.inverse = true});
  CHECK(factor.report().chosen.contact == 4);
  CHECK(factor.report().chosen.applied() == 8);
}

TEST_CASE("what is reported is what was done, whatever the memory") {
  scene const s(6);
  auto const bytes = [&](slant::condensation_options const& o) {
    slant::static_condensation const factor(s.K, s.contact, o);
    return std::pair(factor.report().chosen, factor.restricted(s.B).bytes());
  };
  for (index const applications : {0, 20}) {
    for (double most = 1; most < 3; most += 0.1) {
      auto const [plan, size] =
          bytes({.applications = applications, .cache = 1, .most_memory = most});
      CHECK(bytes({.levels = plan.levels, .inverse = plan.inverse}).second == size);
    }
  }
  CHECK(bytes({.levels = index(1) << 40}).second == bytes({.levels = 1000}).second);
}

TEST_CASE("a body without contact never enters") {
  scene const s(5);
  index const n = s.K.rows();
  sparse two(2, 2);
  two.setIdentity();
  two = test::blown_up(two, MatrixXd(s.K));
  for (index const levels : {0, 1, 30}) {
    slant::static_condensation const one(s.K, s.contact, {.levels = levels});
    slant::static_condensation const both(two, s.contact, {.levels = levels});
    CHECK(both.report().chosen.tail <= double(n));
    if (levels == 0) CHECK(both.report().chosen.tail == one.report().chosen.tail);
  }
}

#else

TEST_CASE("without SuiteSparse the report says what would be faster") {
  scene const s(3);
  slant::static_condensation const factor(s.K, s.contact);
  CHECK(factor.report().factorization == "ldlt");
  CHECK(test::contains(factor.report().reason, "SuiteSparse"));
}

#endif

std::string complaint(slant::condensation_options const& o) {
  return SLANT_COMPLAINT(o.validate());
}

TEST_CASE("options out of range are named") {
  CHECK(complaint({}) == "nothing thrown");
  CHECK(test::contains(complaint({.levels = -1}), "levels"));
  CHECK(test::contains(complaint({.applications = -1}), "applications"));
  CHECK(test::contains(complaint({.flops_per_second = 0}), "flops_per_second"));
  CHECK(test::contains(complaint({.forming_per_second = -1}), "forming_per_second"));
  CHECK(test::contains(complaint({.bytes_per_second = std::numeric_limits<double>::quiet_NaN()}),
                       "bytes_per_second"));
  CHECK(test::contains(complaint({.cached_per_second = -1}), "cached_per_second"));
  CHECK(test::contains(complaint({.cache = 0}), "cache"));
  CHECK(test::contains(complaint({.most_memory = 0.5}), "most_memory"));
}

TEST_CASE("the fastest plan that fits the memory; the smallest if none does") {
  slant::condensation_options o;
  o.applications = 10;
  o.flops_per_second = o.bytes_per_second = o.cached_per_second = 1;
  auto const plan = [&](double flops, double entries, double tail) {
    slant::condensation_plan p{
        .flops = flops, .entries = entries, .stored = entries + 20, .tail_entries = tail};
    p.predict(o);
    return p;
  };
  std::vector const plans{plan(5000, 300, 10), plan(3000, 200, 20), plan(1000, 100, 60)};
  auto const alone = plan(1000, 80, 0);
  CHECK(plans[0].seconds == 5000 + 10 * 2 * 8 * 10);
  CHECK(plans[0].bytes() == 8 * 320 + 4 * 10);
  o.cache = 1;
  o.most_memory = 4;
  CHECK(&slant::detail::cheapest(plans, alone, o) == &plans[1]);  // 6200 against 6600 and 10600
  o.most_memory = 2;
  CHECK(&slant::detail::cheapest(plans, alone, o) == &plans[2]);
  o.most_memory = 1;
  CHECK(&slant::detail::cheapest(plans, alone, o) == &plans[2]);
  o.cache = 1e6;  // so little that it does not matter
  CHECK(&slant::detail::cheapest(plans, alone, o) == &plans[1]);
}

TEST_CASE("the price of a plan with the inverse, by hand") {
  slant::condensation_options o;
  o.applications = 10;
  o.flops_per_second = o.forming_per_second = o.bytes_per_second = o.cached_per_second = 1;
  slant::condensation_plan const swept{
      .flops = 5000, .stored = 320, .contact = 6, .forming = 240, .tail_entries = 30};
  auto const plan = swept.with_inverse(o);
  CHECK(plan.inverse);
  CHECK(plan.applied() == 18);
  CHECK(plan.bytes() == 8 * 320 + 12 * 18);
  CHECK(plan.seconds == doctest::Approx(5000 + 240 + 10 * 8 * 18));
}

}  // namespace static_condensation_test
