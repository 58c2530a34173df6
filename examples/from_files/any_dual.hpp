// SPDX-License-Identifier: MIT
//
// The dual problem with its friction law forgotten, so that each method is compiled once for all
// laws. An application of A costs a few virtual calls more, beside a solve with K.
#pragma once

#include <Eigen/SparseCore>
#include <functional>
#include <slant/problems/any_qp.hpp>
#include <utility>

namespace from_files {

/// Refers to the dual problem that it is made of, and to its quadratic program.
class any_dual {
 public:
  using set_type = slant::any_set<double, slant::contact_runs<double>>;
  using problem_type = slant::any_qp<double, slant::semidefinite_laws, slant::contact_runs<double>>;

  template <class Dual, class QP>
  any_dual(Dual const& dual, QP const& qp)
      : qp_(qp),
        constraints_(&dual.constraints()),
        displacement_([&dual](Eigen::VectorXd const& λ) { return dual.displacement(λ); }) {}
  any_dual(any_dual const&) = delete;
  any_dual& operator=(any_dual const&) = delete;

  [[nodiscard]] problem_type const& qp() const { return qp_; }
  [[nodiscard]] auto const& a() const { return qp_.a(); }
  [[nodiscard]] Eigen::VectorXd const& b() const { return qp_.b(); }
  [[nodiscard]] auto const& set() const { return qp_.set(); }
  [[nodiscard]] Eigen::VectorXd zero() const { return Eigen::VectorXd::Zero(qp_.size()); }
  /// B.
  [[nodiscard]] Eigen::SparseMatrix<double> const& constraints() const { return *constraints_; }
  /// K⁻¹(f − Bᵀλ).
  [[nodiscard]] Eigen::VectorXd displacement(Eigen::VectorXd const& λ) const {
    return displacement_(λ);
  }

 private:
  problem_type qp_;
  Eigen::SparseMatrix<double> const* constraints_;
  std::function<Eigen::VectorXd(Eigen::VectorXd const&)> displacement_;
};

}  // namespace from_files
