// SPDX-License-Identifier: MIT
//
// The natural residual with other scalars than double; apart from the rest for the compiler's sake.
#include <slant/sets/sets.hpp>
#include <slant/slanting/projection.hpp>

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <support/testing.hpp>
#include "slanting_support.hpp"

namespace natural_residual_scalars_test {

TEST_CASE_TEMPLATE("float and multiprecision", S, float,
                   boost::multiprecision::number<boost::multiprecision::cpp_bin_float<50>,
                                                 boost::multiprecision::et_off>) {
  using vector = Eigen::Matrix<S, Eigen::Dynamic, 1>;
  using matrix = Eigen::Matrix<S, Eigen::Dynamic, Eigen::Dynamic>;
  matrix const m = slanting_support::random_spd(4, 1).cast<S>();
  vector const b = vector::Constant(4, S(10));
  auto const set = slant::power(slant::ball<2, S>{}, vector(vector::Ones(2)));
  auto const f = slant::natural_residual(m, b, set, S(1) / S(8));
  vector x = vector::Zero(4);
  for (int k = 0; k < 12; ++k) {
    x -= slanting_support::solve(slanting_support::dense_slant(f, x), slant::evaluate(f, x));
  }
  CHECK(slant::evaluate(f, x).norm() <= S(16) * std::numeric_limits<S>::epsilon());
}

}  // namespace natural_residual_scalars_test
