// SPDX-License-Identifier: MIT
//
// The slanting function of a client's own that README.md shows; readme.cmake compares the two.
#include <slant/operators/diagonal.hpp>
#include <slant/slanting/affine.hpp>
#include <slant/slanting/arithmetic.hpp>

#include <slant/testing/laws.hpp>

#include <doctest/doctest.h>

#include <Eigen/Core>
#include <utility>

struct absolute_value : slant::slanting_base {  // yᵢ ↦ |yᵢ|; the base is for f + g, A * f, …
  Eigen::Index n;
  explicit absolute_value(Eigen::Index size) : n(size) {}
  Eigen::Index rows() const { return n; }
  Eigen::Index cols() const { return n; }
  void value(Eigen::VectorXd const& y, Eigen::VectorXd& f) const { f = y.cwiseAbs(); }
  auto slant(Eigen::VectorXd const& y) const {
    Eigen::VectorXd sign = (y.array() < 0).select(-1.0, Eigen::VectorXd::Ones(n));
    return slant::diagonal(std::move(sign));  // not diagonal(sign), which would refer to it
  }
};
static_assert(slant::slanting_function<absolute_value, Eigen::VectorXd>);

TEST_CASE("my function keeps its word") {
  Eigen::VectorXd const kink{{0.0, 1.0, -2.0}};
  slant::testing::check_slanting_laws(absolute_value(3), kink);
  slant::testing::check_slanting_laws(0.5 * (absolute_value(3) + slant::identity_map(3)), kink);
}
