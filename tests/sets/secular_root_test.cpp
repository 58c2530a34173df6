// SPDX-License-Identifier: MIT
#include <slant/sets/elliptic_cone.hpp>

#include "oracle/precise.hpp"

#include <doctest/doctest.h>

#include <limits>

namespace secular_root_test {

using slant::detail::double_word;

/// a/(b + z) = 1 on [0, ∞): the root a − b, however small b is, by Newton's method for a/(b + z).
struct hyperbola {
  double a, b;
  mutable int evaluations = 0;

  template <class T>
  T residual(T const& z) const {
    ++evaluations;
    return T(a) / (T(b) + z) - T(1.0);
  }
  double gain(double z) const { return (b + z) * (b + z) / a; }
  double lower() const { return 0; }
  double upper() const { return 2 * a; }
  double threshold() const { return b; }
  double scale(double z) const { return b + z; }
};

TEST_CASE("secular_root: the root and a few bits more, in a bounded number of steps") {
  using real = oracle::float_50;
  for (double b : {0.3, 1e-8, 1e-16, 1e-100}) {
    hyperbola const equation{1.0 / 3, b};
    auto const z = slant::detail::secular_root<double>(equation);
    real const exact = real(equation.a) - real(b);
    CHECK(double(abs((real(z.hi) + real(z.lo) - exact) / exact)) <=
          std::numeric_limits<double>::epsilon() / 64);
    CHECK(equation.evaluations <= 24);
  }
}

TEST_CASE("secular_root: a root at 0") {
  CHECK(slant::detail::secular_root<double>(hyperbola{0.25, 0.25}).hi == 0.0);
}

}  // namespace secular_root_test
