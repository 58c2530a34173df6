// SPDX-License-Identifier: MIT
//
// The least that is a linear operator: two sizes and one function, with a concrete signature on
// archetype vectors. Not a template, no workspace, no capability. An algorithm that compiles with
// it asks for nothing more; the ones below add the laws that algorithms ask for.
#pragma once

#include <slant/concepts/capabilities.hpp>
#include <slant/testing/archetypes/vector.hpp>

#include <Eigen/Core>

#include <utility>

namespace slant::testing::archetype {

/// y = M x, and promises nothing.
class linear_operator {
 public:
  explicit linear_operator(Eigen::MatrixXd m) : m_(std::move(m)) {}

  [[nodiscard]] index rows() const { return m_.rows(); }
  [[nodiscard]] index cols() const { return m_.cols(); }
  void apply(vector const& x, vector& y) const { y.local().noalias() = m_ * x.local(); }

 private:
  Eigen::MatrixXd m_;
};

/// The same for a matrix that the caller knows to be symmetric.
class self_adjoint_operator : public linear_operator {
 public:
  static constexpr law_set laws = slant::laws<law::self_adjoint>;
  using linear_operator::linear_operator;
};

/// The same for a symmetric positive semidefinite matrix.
class psd_operator : public linear_operator {
 public:
  static constexpr law_set laws = slant::laws<law::self_adjoint, law::positive_semidefinite>;
  using linear_operator::linear_operator;
};

/// The same for a symmetric positive definite matrix.
class spd_operator : public linear_operator {
 public:
  static constexpr law_set laws = slant::laws<law::self_adjoint, law::positive_definite>;
  using linear_operator::linear_operator;
};

/// linear_operator and its adjoint.
class operator_with_adjoint : public linear_operator {
 public:
  explicit operator_with_adjoint(Eigen::MatrixXd const& m)
      : linear_operator(m), transpose_(m.transpose()) {}
  void apply_adjoint(vector const& x, vector& y) const { transpose_.apply(x, y); }

 private:
  linear_operator transpose_;
};

static_assert(slant::linear_operator<linear_operator, vector>);
static_assert(!slant::has_adjoint<linear_operator, vector>);
static_assert(slant::spd_operator<spd_operator, vector>);
static_assert(slant::has_adjoint<operator_with_adjoint, vector>);

}  // namespace slant::testing::archetype
