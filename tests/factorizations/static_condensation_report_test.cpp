// SPDX-License-Identifier: MIT
#include <slant/factorizations/static_condensation.hpp>

#include <doctest/doctest.h>
#include <Eigen/SparseCore>

#include <cmath>
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
  Eigen::VectorXd const sums = k * Eigen::VectorXd::Ones(k.cols());
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
  Eigen::VectorXd const x = Eigen::VectorXd::Random(a.rows());
  Eigen::VectorXd y(x.size());
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
  Eigen::VectorXd const x = Eigen::VectorXd::Random(5);
  Eigen::VectorXd y(5), z(5);
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
  std::vector<Eigen::Triplet<double>> entries;
  for (index j = 0; j < s.K.outerSize(); ++j) {
    for (Eigen::SparseMatrix<double>::InnerIterator e(s.K, j); e; ++e) {
      for (int i = 0; i < 3; ++i) {
        for (int k = 0; k < 3; ++k) {
          entries.emplace_back(3 * int(e.row()) + i, 3 * int(j) + k,
                               e.value() * (i == k ? 1.0 : 0.1));
        }
      }
    }
  }
  Eigen::SparseMatrix<double> K(3 * s.K.rows(), 3 * s.K.cols());
  K.setFromTriplets(entries.begin(), entries.end());
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
