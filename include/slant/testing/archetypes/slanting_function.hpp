// SPDX-License-Identifier: MIT
//
// The least that is a slanting function: two sizes, a value and a slanting operator, with concrete
// signatures on archetype vectors. No workspace, no renewal in place, no base class.
#pragma once

#include <slant/concepts/slanting_function.hpp>
#include <slant/testing/archetypes/linear_operator.hpp>
#include <slant/testing/archetypes/vector.hpp>

#include <Eigen/Core>

namespace slant::testing::archetype {

/// F(y)_i = |y_i| + y_i/2 on n unknowns; F°(y)_ii = 3/2 for y_i >= 0, else −1/2.
class slanting_function {
 public:
  explicit slanting_function(index n) : n_(n) {}

  [[nodiscard]] index rows() const { return n_; }
  [[nodiscard]] index cols() const { return n_; }
  void value(vector const& y, vector& f) const { f.local() = y.local().cwiseAbs() + y.local() / 2; }
  [[nodiscard]] linear_operator slant(vector const& y) const {
    Eigen::VectorXd const slopes =
        y.local().unaryExpr([](double y_i) { return y_i >= 0 ? 1.5 : -0.5; });
    return linear_operator(Eigen::MatrixXd(slopes.asDiagonal()));
  }

 private:
  index n_;
};

static_assert(slant::slanting_function<slanting_function, vector>);
static_assert(!slant::has_slant_update<slanting_function, vector>);

}  // namespace slant::testing::archetype
