// SPDX-License-Identifier: MIT
//
// An observer that keeps what the lecture's Figures 12 and 13 show of a run: the values of q, and
// the relative reduced gradient or, for methods without one, residual, against products with A.
#pragma once

#include <fem/plots/history_plot.hpp>
#include <slant/concepts/linear_operator.hpp>
#include <slant/iteration/stopping.hpp>
#include <slant/problems/separable_qp.hpp>
#include <string>
#include <utility>

namespace examples {

/// Computes q by itself, one product per state that no method counts, so it is for pictures only.
/// Every state of a method with inner iterations is a Newton step.
template <class QP>
class run_recorder {
 public:
  explicit run_recorder(QP qp) : qp_(std::move(qp)), r_(qp_.b()) {}

  template <class State>
  void operator()(State const& s) {
    slant::apply(qp_.a(), s.x, r_);
    r_ -= qp_.b();
    auto const products = static_cast<double>(s.work.operator_applications);
    energy_.push_back({products, slant::energy(qp_, s.x, r_)});
    if constexpr (slant::has_reduced_gradient_norm<State>) {
      residual_.push_back({products, s.reduced_gradient_norm / s.gradient_scale});
    } else {
      first_residual_ = residual_.empty() ? s.residual_norm : first_residual_;
      residual_.push_back({products, s.residual_norm / first_residual_});
    }
    is_newton_ = is_newton_ || s.work.inner_iterations > 0;
  }

  /// Values of q; subtract the least one to see them on a logarithmic scale.
  [[nodiscard]] fem::history_series energy(std::string label) const {
    return series(std::move(label), energy_);
  }
  /// ‖r̃‖ relative to its value next to zero, or the residual relative to its first value.
  [[nodiscard]] fem::history_series residual(std::string label) const {
    return series(std::move(label), residual_);
  }

 private:
  [[nodiscard]] fem::history_series series(std::string label,
                                           std::vector<fem::history_point> const& points) const {
    return {std::move(label), points, is_newton_ ? points : std::vector<fem::history_point>{}};
  }

  QP qp_;
  typename QP::vector_type r_;
  std::vector<fem::history_point> energy_{};
  std::vector<fem::history_point> residual_{};
  double first_residual_ = 1;
  bool is_newton_ = false;
};

}  // namespace examples
