// SPDX-License-Identifier: MIT
//
// The inner problems of the proximal point method for Coulomb friction: u = W r + q + α Λ (r − c),
// solved by Newton's method, with some sweeps of Gauss–Seidel where that finds no descent. The
// problem is the easier for both the larger α is.
#pragma once

#include <slant/contact/friction_newton.hpp>
#include <slant/contact/friction_options.hpp>
#include <slant/contact/friction_sweeps.hpp>
#include <slant/methods/proximal_point.hpp>

#include <algorithm>
#include <limits>

namespace slant::contact::detail {

/// Inner solver of proximal_point; see the top of this file. Refers to its arguments.
template <int N, class S>
class friction_proximal_step {
 public:
  using vector_type = typename friction_blocks<N, S>::vector_type;

  friction_proximal_step(friction_blocks<N, S> const& blocks, friction_newton<N, S>& newton,
                         friction_options<S> const& options, friction_work& work)
      : blocks_(&blocks),
        newton_(&newton),
        sweeps_(blocks),
        memory_(sweeps_.memory()),
        options_(&options),
        work_(&work),
        u_(blocks.size()) {}

  proximal_inner_report operator()(vector_type const& center, S const& α, vector_type& x) {
    proximal_inner_report report;
    newton_->set_proximal(α, center);
    S first(-1);
    for (index rescue = 0; rescue <= options_->rescues; ++rescue) {
      for (index k = 0; k < 20 * rescue * rescue && work_->sweeps < options_->sweeps; ++k) {
        work_->block_products += sweeps_.sweep(x, memory_, k == 0, α, newton_->weight(), center);
        ++work_->sweeps;
      }
      S now = newton_->begin(x);
      if (first < S(0)) first = now;
      for (index k = 0;; ++k) {
        S const moved = α / (S(1) + α) * (x - center).norm();
        S const rounding = S(16) * std::numeric_limits<S>::epsilon() * x.norm();
        if (now <= std::max(rounding, S(S(0.01) * std::min(first, moved)))) {
          report.solved = true;
          return report;
        }
        if (k == options_->inner_steps || no_steps_left()) break;
        ++report.steps;
        if (!newton_->advance(x, S(0), options_->halvings)) break;
        now = newton_->residual_norm();
      }
      if (no_steps_left()) break;
    }
    report.accept = error_at(x) < error_at(center);
    return report;
  }

 private:
  [[nodiscard]] bool no_steps_left() const {
    return newton_->work().steps + work_->interior_steps >= options_->newton_steps;
  }
  S error_at(vector_type const& x) {
    blocks_->velocity(x, u_);
    ++work_->products;
    return blocks_->error(x, u_).worst();
  }

  friction_blocks<N, S> const* blocks_;
  friction_newton<N, S>* newton_;
  friction_sweeps<N, S> sweeps_;
  friction_sweep_memory<S> memory_;
  friction_options<S> const* options_;
  friction_work* work_;
  vector_type u_;
};

}  // namespace slant::contact::detail
