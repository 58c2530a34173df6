// SPDX-License-Identifier: MIT
#include <slant/krylov/spectrum.hpp>
#include <slant/operators/operators.hpp>
#include <slant/testing/archetypes.hpp>

#include <support/testing.hpp>
#include "spd_matrices.hpp"

namespace mean_diagonal_test {

TEST_CASE("exact, without a product, where the operator gives its diagonal") {
  MatrixXd const M = test::with_spectrum(test::log_spaced(12, 1e3), 3);
  auto const A = slant::counted(test::spd(M));
  auto const mean = slant::mean_diagonal(A, test::zeros(12));
  CHECK(mean.value == doctest::Approx(M.trace() / 12));
  CHECK(mean.applications == 0);
  CHECK(A.applications() == 0);
}

TEST_CASE("estimated by random signs otherwise, within the variance that is stated") {
  namespace archetype = slant::testing::archetype;
  MatrixXd const M = test::with_spectrum(test::log_spaced(60, 1e2), 8);
  archetype::psd_operator const A(M);
  archetype::vector const like(VectorXd::Zero(60));
  double const off = M.squaredNorm() - M.diagonal().squaredNorm();
  double sum_of_squares = 0;
  for (unsigned seed = 1; seed <= 50; ++seed) {
    auto const mean = slant::mean_diagonal(A, like, {.samples = 4, .seed = seed});
    CHECK(mean.applications == 4);
    sum_of_squares += std::pow(mean.value - M.trace() / 60, 2);
  }
  double const variance = 2 * off / (4 * 60.0 * 60.0);
  CHECK(sum_of_squares / 50 <= 2 * variance);
  CHECK(sum_of_squares / 50 >= variance / 2);
  // A diagonal matrix has no variance.
  archetype::psd_operator const D(MatrixXd(VectorXd::LinSpaced(60, 1, 60).asDiagonal()));
  CHECK(slant::mean_diagonal(D, like, {.samples = 1}).value == doctest::Approx(30.5));
}

TEST_CASE("a step length of its size, or a word about why there is none") {
  namespace archetype = slant::testing::archetype;
  archetype::vector const like(VectorXd::Zero(2));
  auto const step = [&](double size) {
    return slant::mean_step(archetype::psd_operator(size * MatrixXd::Identity(2, 2)), like, 0.5);
  };
  CHECK(step(4.0).length == 0.125);
  CHECK(step(0.0).length == 1.0);  // any: A = 0
  for (double size : {-1.0, 1e-310, std::numeric_limits<double>::quiet_NaN()}) {
    CAPTURE(size);
    CHECK_THROWS_AS(static_cast<void>(step(size)), slant::bad_input);
  }
  archetype::psd_operator const I(MatrixXd::Identity(2, 2));
  CHECK_THROWS_WITH(static_cast<void>(slant::mean_diagonal(I, like, {.samples = 0})),
                    "samples: got 0, expected a number >= 1");
}

}  // namespace mean_diagonal_test
