// SPDX-License-Identifier: MIT
//
// LDLᵀ that counts its solves.
#pragma once

#include <slant/concepts/laws.hpp>
#include <slant/concepts/scalar.hpp>

#include <Eigen/SparseCholesky>

namespace test {

class counting_factor {
 public:
  static constexpr slant::law_set laws = slant::laws<slant::self_adjoint, slant::positive_definite>;
  explicit counting_factor(Eigen::SparseMatrix<double> const& K) : inner_(K) {}
  [[nodiscard]] slant::index rows() const { return inner_.rows(); }
  void solve(Eigen::VectorXd const& b, Eigen::VectorXd& x) const {
    ++solves;
    x = inner_.solve(b);
  }
  mutable slant::index solves = 0;

 private:
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> inner_;
};

}  // namespace test
