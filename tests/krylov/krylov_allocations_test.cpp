// SPDX-License-Identifier: MIT
//
// No Krylov method allocates between its first and its last step, composed operators included.
#include <slant/factorizations/dense_ldlt.hpp>
#include <slant/krylov/krylov.hpp>
#include <slant/operators/operators.hpp>

#include <support/testing.hpp>
#include "spd_matrices.hpp"

namespace krylov_allocations_test {

template <class Method>
std::size_t allocations_of(Method const& method, VectorXd const& x0, int steps) {
  auto s = method.start(x0);
  slant::testing::allocation_guard guard;
  for (int k = 0; k < steps; ++k) method.step(s);
  auto const count = guard.count();
  CHECK(s.iteration == steps);
  return count;
}

TEST_CASE("cg, preconditioned cg and bicgstab do not allocate") {
  auto const M = test::with_spectrum(test::log_spaced(40, 1e4));
  auto const K = slant::dense_ldlt(test::with_spectrum(test::log_spaced(60, 100), 3));
  MatrixXd const B = test::random_vector(40 * 60, 4).reshaped(40, 60);
  auto const plain = test::spd(M);
  auto const A = slant::sum(plain, slant::congruence(B, slant::inverse(K)));
  auto const preconditioner = slant::scaled(slant::positive(0.5), plain);
  VectorXd const b = test::random_vector(40), x0 = test::random_vector(40, 8);
  CHECK(allocations_of(slant::cg{A, b}, x0, 20) == 0);
  CHECK(allocations_of(slant::cg{A, b, preconditioner}, x0, 20) == 0);
  CHECK(allocations_of(slant::bicgstab{A, b}, x0, 20) == 0);
}

}  // namespace krylov_allocations_test
