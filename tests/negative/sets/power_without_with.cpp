// SPDX-License-Identifier: MIT
// expect: takes_parameters
// max-lines-gcc: 20
// max-lines-clang: 30
//
// A block with a parameter, but without a way to give each copy its own: with(parameter).
#include <slant/sets/power.hpp>

#include <vector>

struct above {
  static constexpr int dimension = 1;
  using vector_type = Eigen::Matrix<double, 1, 1>;
  double bound = 0;
  vector_type project(auto const& x) const { return vector_type(x[0] < bound ? bound : x[0]); }
  bool contains(auto const& x) const { return x[0] >= bound; }
#ifdef SLANT_COMPLETE
  above with(double b) const { return {b}; }
#endif
};

auto const product = slant::power(above{}, std::vector<double>{1, 2});
