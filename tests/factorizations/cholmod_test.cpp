// SPDX-License-Identifier: MIT
#include <slant/factorizations/cholmod.hpp>

#include <support/testing.hpp>
#include <thread>
#include "factorizations/spd_examples.hpp"

namespace cholmod_test {

auto const factor = [](sparse const& k) { return slant::cholmod(k); };

static_assert(slant::factorization<slant::cholmod, VectorXd>);
static_assert(slant::factorization<slant::cholmod, MatrixXd>);
static_assert(!slant::factorization<slant::cholmod, Eigen::VectorXf>);
static_assert(slant::declares_positive_definite<slant::cholmod>);

TEST_CASE("both kinds of factors, one or several right-hand sides") {
  for (int const size : {3, 9}) {
    sparse const k = test::grid_laplacian(size, 0.1);
    slant::cholmod const factors(k);
    CHECK(factors.name() == "cholmod");
    CHECK(factors.supernodal() == (size == 9));
    CHECK(test::residual(factors, k) < 1e-13);
    for (int const columns : {2, 4, 7}) {
      MatrixXd b(k.rows(), columns);
      for (int j = 0; j < columns; ++j) b.col(j) = test::load(k.rows()).array() + j;
      MatrixXd x(k.rows(), columns);
      auto w = factors.workspace(b);
      for (int k_th = 0; k_th < 2; ++k_th) {
        x.setConstant(std::numeric_limits<double>::quiet_NaN());
        factors.solve(b, x, w);
        CHECK((k * x - b).norm() < 1e-13 * b.norm());
      }
    }
  }
}

TEST_CASE("sizes of a solve") {
  test::check_sizes_of_solve(slant::cholmod(test::grid_laplacian(3, 0.1)));
}

TEST_CASE("units do not matter") {
  test::check_units(factor, test::grid_laplacian(3, 0.1));
  test::check_units(factor, test::grid_laplacian(9, 0.1));
}

TEST_CASE("complaints name the entry or the pivot, whichever the kind of factors") {
  test::check_complaints(factor, test::grid_laplacian(3, 0.1), test::grid_laplacian(3, 0));
  test::check_complaints(factor, test::grid_laplacian(9, 0.1), test::grid_laplacian(9, 0));
}

TEST_CASE("the pivot that is named is what elimination of the rows before it leaves") {
  for (int const size : {3, 9}) {
    sparse k = test::grid_laplacian(size, 0.1);
    k.coeffRef(size, size) = -1;
    auto view = slant::detail::cholmod_view(k);
    slant::detail::cholmod_factors const factors(view);
    auto const n = factors.size();
    // Simplicial factors go on after a negative pivot, supernodal ones stop before it.
    slant::index failed = factors.failed_column();
    double pivot = 0;
    if (failed < n) {
      pivot =
          factors.failed_pivot(k.coeff(factors.original_row(failed), factors.original_row(failed)));
    } else {
      factors.for_each_pivot([&](slant::index i, double p) {
        if (p < 0 && failed == n) {
          failed = i;
          pivot = p;
        }
      });
    }
    REQUIRE(failed < n);
    MatrixXd permuted(failed + 1, failed + 1);
    for (slant::index i = 0; i <= failed; ++i) {
      for (slant::index j = 0; j <= failed; ++j)
        permuted(i, j) = k.coeff(factors.original_row(i), factors.original_row(j));
    }
    VectorXd const row = permuted.col(failed).head(failed);
    double const expected = permuted(failed, failed) -
                            row.dot(test::solution_of(permuted.topLeftCorner(failed, failed), row));
    CHECK(pivot < 0);
    CHECK(std::abs(pivot - expected) < 1e-10 * std::abs(expected));
    CHECK(test::contains(test::complaint(factor, k),
                         "pivot " + std::to_string(failed) + " (row " +
                             std::to_string(factors.original_row(failed)) + ") = -"));
  }
  // A diagonal matrix needs no elimination: the pivot is the entry.
  sparse diagonal(5, 5);
  for (int i = 0; i < 5; ++i) diagonal.insert(i, i) = i == 3 ? -0.75 : 2 + i;
  CHECK(test::contains(test::complaint(factor, diagonal), "(row 3) = -0.75, expected"));
}

TEST_CASE("a solve with a workspace allocates nothing") {
  for (int const size : {3, 9}) {
    sparse const k = test::grid_laplacian(size, 0.1);
    auto const a = slant::inverse(slant::cholmod(k));
    VectorXd const b = test::load(k.rows());
    VectorXd x(k.rows());
    auto w = slant::workspace(a, b);
    slant::testing::allocation_guard guard;
    slant::apply(a, b, x, w);
    slant::apply(a, b, x, w);
    auto const allocations = guard.count();
    CHECK(allocations == 0);
  }
}

TEST_CASE("a copied or assigned workspace is as ready as the original, and independent of it") {
  for (int const size : {3, 9}) {
    sparse const k = test::grid_laplacian(size, 0.1);
    slant::cholmod const factors(k);
    for (int const columns : {1, 4, 7}) {
      MatrixXd b(k.rows(), columns);
      for (int j = 0; j < columns; ++j) b.col(j) = test::load(k.rows()).array() + j;
      MatrixXd x(k.rows(), columns);
      auto const allocations_of_a_solve = [&](auto& w) {
        x.setConstant(std::numeric_limits<double>::quiet_NaN());
        slant::testing::allocation_guard guard;
        factors.solve(b, x, w);
        return guard.count();
      };
      using workspace_type = slant::workspace_t<slant::cholmod, MatrixXd>;
      auto original = std::make_unique<workspace_type>(factors.workspace(b));
      auto const usual = allocations_of_a_solve(*original);  // of BLAS, for several columns
      if (columns == 1) CHECK(usual == 0);
      auto copy = *original;
      auto assigned = factors.workspace(VectorXd(b.col(0)));
      assigned = *original;
      original.reset();
      auto moved = std::move(copy);
      copy = moved;  // one that was moved from
      for (auto* w : {&copy, &assigned, &moved}) {
        auto const allocations = allocations_of_a_solve(*w);
        CHECK(allocations == usual);
        CHECK((k * x - b).norm() < 1e-13 * b.norm());
      }
    }
  }
  slant::cholmod const empty(sparse(0, 0));
  auto w = empty.workspace(VectorXd(0));
  auto const copy = w;
  w = copy;
}

TEST_CASE("two threads, two workspaces") {
  sparse const k = test::grid_laplacian(9, 0.1);
  slant::cholmod const factors(k);
  auto const copy = factors;
  VectorXd const b = test::load(k.rows());
  std::vector<VectorXd> x(2, b);
  auto const work = [&](slant::cholmod const& f, VectorXd& solution, double scale) {
    VectorXd const own = scale * b;
    auto w = f.workspace(own);
    for (int k_th = 0; k_th < 50; ++k_th) f.solve(own, solution, w);
  };
  std::thread other([&] { work(copy, x[1], 2.0); });
  work(factors, x[0], 1.0);
  other.join();
  CHECK((k * x[0] - b).norm() < 1e-13 * b.norm());
  CHECK(x[1] == VectorXd(2 * x[0]));
}

TEST_CASE("the empty matrix; factors outlive what they were moved from") {
  slant::cholmod const empty(sparse(0, 0));
  VectorXd none(0);
  slant::apply(slant::inverse(empty), VectorXd(0), none);
  CHECK(empty.rows() == 0);
  CHECK(SLANT_COMPLAINT(slant::cholmod(sparse(2, 2))).starts_with("K: got pivot 0 (row 0) = 0"));
  sparse const k = test::grid_laplacian(3, 0.1);
  auto a = slant::inverse(slant::cholmod(k));
  auto const b = std::move(a);
  CHECK(test::residual(b.factors(), k) < 1e-13);
}

}  // namespace cholmod_test
