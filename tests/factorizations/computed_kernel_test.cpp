// SPDX-License-Identifier: MIT
#include "spd_examples.hpp"

#include <slant/factorizations/computed_kernel.hpp>
#include <slant/factorizations/generalized_inverse.hpp>

#include <doctest/doctest.h>

namespace computed_kernel_test {

using sparse = Eigen::SparseMatrix<double>;

TEST_CASE("more directions than the iteration begins with") {
  // Twelve bars that nothing connects.
  sparse K(24, 24);
  for (int i = 0; i < 24; ++i) {
    K.insert(i, i) = 1;
    K.insert(i, i ^ 1) = -1;
  }
  CHECK(slant::computed_kernel(K).cols() == 12);
}

TEST_CASE("single precision") {
  Eigen::SparseMatrix<float> const K = test::grid_laplacian<float>(4, 0.0);
  slant::generalized_inverse<float> const inverse(K);
  CHECK(inverse.kernel().cols() == 1);
  Eigen::VectorXf b = Eigen::VectorXf::LinSpaced(64, -1.0F, 1.0F), x(64);
  slant::apply(inverse, b, x);
  CHECK((K * x - b).norm() <= 1e-5F * b.norm());
}

TEST_CASE("what has no kernel that can be told from the rest is refused") {
  sparse K = test::grid_laplacian(3, 0.0);
  CHECK(slant::computed_kernel(K).cols() == 1);
  // An eigenvalue of 200 rounding errors: neither zero nor not.
  K.coeffRef(5, 5) += 27 * 200 * std::numeric_limits<double>::epsilon() * 12;
  CHECK_THROWS_AS(static_cast<void>(slant::computed_kernel(K)), slant::bad_input);
  CHECK(slant::computed_kernel(test::grid_laplacian(3, 1e-6)).cols() == 0);
  CHECK_THROWS_AS(static_cast<void>(slant::computed_kernel(test::grid_laplacian(3, -1e-6))),
                  slant::bad_input);
}

}  // namespace computed_kernel_test
