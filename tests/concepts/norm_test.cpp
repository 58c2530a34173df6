// SPDX-License-Identifier: MIT
#include <slant/concepts/vector.hpp>
#include <slant/testing/archetypes.hpp>

#include <doctest/doctest.h>

#include <Eigen/Core>
#include <cmath>
#include <limits>

namespace norm_test {

using Eigen::VectorXd;
using own_vector = slant::testing::archetype::vector;

TEST_CASE("3-4-5 at every scale, for vectors of Eigen and for vectors of one's own") {
  VectorXd const v{{3.0, 0.0, -4.0}};
  for (int e : {0, -1070, -1000, -540, -500, -250, 250, 500, 540, 1000, 1020}) {
    CAPTURE(e);
    VectorXd const scaled = v.unaryExpr([e](double x) { return std::ldexp(x, e); });
    CHECK(slant::norm(scaled) == std::ldexp(5.0, e));
    CHECK(slant::norm(own_vector(scaled)) == std::ldexp(5.0, e));
  }
}

TEST_CASE("zero, nothing, infinity and NaN stay what they are") {
  auto const both = [](VectorXd const& v, auto check) {
    check(slant::norm(v));
    check(slant::norm(own_vector(v)));
  };
  both(VectorXd::Zero(3), [](double norm) { CHECK(norm == 0); });
  both(VectorXd(), [](double norm) { CHECK(norm == 0); });
  both(VectorXd{{1.0, std::numeric_limits<double>::infinity()}},
       [](double norm) { CHECK(std::isinf(norm)); });
  both(VectorXd{{1.0, std::nan("")}}, [](double norm) { CHECK(std::isnan(norm)); });
}

}  // namespace norm_test
