// SPDX-License-Identifier: MIT
#include <slant/factorizations/static_condensation.hpp>

#include <doctest/doctest.h>
#include <Eigen/SparseCore>

#include <utility>
#include <vector>

#include "factorizations/condensation_scene.hpp"

namespace static_condensation_report_test {

using scene = test::condensation_scene;
using slant::index;

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
    CHECK(report.plans[swept + i].forming_flops() > 0);
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

TEST_CASE("an inverse that floats would make indefinite is left, and the report says so") {
  scene s(5);
  // The bottom of the cube hangs by weak springs.
  for (index j = 0; j < s.K.outerSize(); ++j) {
    for (Eigen::SparseMatrix<double>::InnerIterator e(s.K, j); e; ++e) {
      bool const bottom = e.row() < 25 && e.col() < 25;
      if (bottom)
        e.valueRef() *= 1e-7;
      else if (e.row() < 25 || e.col() < 25)
        e.valueRef() *= 1e-9;
    }
  }
  slant::static_condensation const factor(s.K, s.contact, {.inverse = true});
  CHECK(!factor.report().chosen.inverse);
  CHECK(test::contains(factor.report().reason, "condition"));
  Eigen::MatrixXd const A = s.dual();
  Eigen::VectorXd const x = Eigen::VectorXd::Random(A.rows());
  Eigen::VectorXd y(x.size());
  slant::apply(factor.restricted(s.B).rounded(), x, y);
  CHECK((y - A * x).norm() < 1e-4 * y.norm());
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
  std::vector<Eigen::Triplet<double>> entries;
  for (index j = 0; j < n; ++j) {
    for (Eigen::SparseMatrix<double>::InnerIterator e(s.K, j); e; ++e) {
      for (index const shift : {index(0), n}) {
        entries.emplace_back(int(e.row() + shift), int(j + shift), e.value());
      }
    }
  }
  Eigen::SparseMatrix<double> two(2 * n, 2 * n);
  two.setFromTriplets(entries.begin(), entries.end());
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

}  // namespace static_condensation_report_test
