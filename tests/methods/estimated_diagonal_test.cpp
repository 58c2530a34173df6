// SPDX-License-Identifier: MIT
#include <slant/slant.hpp>
#include <slant/testing/archetypes.hpp>

#include <krylov/spd_matrices.hpp>
#include <support/testing.hpp>

namespace estimated_diagonal_test {

/// Two parts of 40 and 20 unknowns, the second a hundred times as stiff.
MatrixXd two_scales() {
  MatrixXd M = test::with_spectrum(test::log_spaced(60, 10), 2);
  M.bottomRows(20) *= 10;
  M.rightCols(20) *= 10;
  return M;
}

TEST_CASE("exact, without a product, where the operator gives its diagonal") {
  MatrixXd const M = two_scales();
  auto const A = slant::counted(test::spd(M));
  VectorXd d(60);
  auto const mean = slant::estimate_diagonal(A, slant::half_lines(60), {.samples = 3}, d);
  CHECK(d == M.diagonal());
  CHECK(mean.value == doctest::Approx(M.trace() / 60));
  CHECK(mean.applications == 0);
  CHECK(A.applications() == 0);
}

TEST_CASE("one mean for each part of the set, also of its image") {
  namespace archetype = slant::testing::archetype;
  MatrixXd const M = two_scales();
  archetype::psd_operator const A(M);
  archetype::vector d(VectorXd::Zero(60));
  auto const set = slant::cartesian(slant::half_lines(40), slant::discs(VectorXd::Ones(10).eval()));
  auto const check = [&](slant::diagonal_mean<double> const& mean) {
    CHECK(mean.applications == 6);
    VectorXd const& e = d.local();
    CHECK(e.head(40).maxCoeff() == e.head(40).minCoeff());
    CHECK(e.tail(20).maxCoeff() == e.tail(20).minCoeff());
    CHECK(e(0) == doctest::Approx(M.diagonal().head(40).mean()).epsilon(0.2));
    CHECK(e(59) == doctest::Approx(M.diagonal().tail(20).mean()).epsilon(0.2));
    CHECK(mean.value == doctest::Approx(e.mean()));
  };
  check(slant::estimate_diagonal(A, set, {.samples = 3}, d));
  check(slant::estimate_diagonal(A, slant::scaled(2.0, set), {.samples = 3}, d));
}

TEST_CASE(
    "no entry is zero, and a diagonal that is no diagonal of a semidefinite matrix is refused") {
  namespace archetype = slant::testing::archetype;
  archetype::vector d(VectorXd::Zero(4));
  auto const set = slant::cartesian(slant::half_lines(2), slant::half_lines(2));
  MatrixXd M = MatrixXd::Zero(4, 4);
  static_cast<void>(slant::estimate_diagonal(archetype::psd_operator(M), set, {}, d));
  CHECK(d.local() == VectorXd::Ones(4));
  M(3, 3) = 8;
  auto const estimate = [&](slant::index samples) {
    return slant::estimate_diagonal(archetype::psd_operator(M), set, {.samples = samples}, d, "M");
  };
  CHECK(estimate(1).applications == 2);
  CHECK(d.local() == VectorXd{{2.0, 2.0, 4.0, 4.0}});
  // As many products as entries: they are the entries.
  CHECK(estimate(2).applications == 4);
  CHECK(d.local() == VectorXd{{2.0, 2.0, 2.0, 8.0}});
  M(0, 0) = -1;
  for (slant::index const samples : {1, 2}) {
    CHECK_THROWS_WITH_AS(static_cast<void>(estimate(samples)),
                         doctest::Contains("M: got mean of the diagonal -"), slant::bad_input);
  }
}

}  // namespace estimated_diagonal_test
