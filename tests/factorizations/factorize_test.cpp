// SPDX-License-Identifier: MIT
#include <slant/factorizations/factorize.hpp>

#include <support/testing.hpp>
#include "factorizations/spd_examples.hpp"

namespace factorize_test {

TEST_CASE("the best factorisation for the matrix") {
  auto const k = test::grid_laplacian(3, 0.1);
  auto const sparse_factors = slant::factorize(k);
#if defined(SLANT_HAS_CHOLMOD) && SLANT_HAS_CHOLMOD
  CHECK(sparse_factors.name() == "cholmod");
#else
  CHECK(sparse_factors.name() == "ldlt");
#endif
  CHECK(test::residual(sparse_factors, k) < 1e-14);

  MatrixXd const dense(k);
  auto const dense_factors = slant::factorize(dense);
  CHECK(dense_factors.name() == "dense_ldlt");
  CHECK(test::residual(dense_factors, dense) < 1e-14);

  auto const single = test::grid_laplacian<float>(3, 0.1);
  CHECK(slant::factorize(single).name() == "ldlt");
}

TEST_CASE("complaints are those of the factorisation") {
  auto const floating = test::grid_laplacian(3, 0);
  auto const text = test::complaint([](auto const& k) { return slant::factorize(k); }, floating);
  CHECK(test::contains(text, "K: got pivot 26"));
  CHECK(test::contains(text, "zero up to rounding"));
}

}  // namespace factorize_test
