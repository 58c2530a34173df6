// SPDX-License-Identifier: MIT
//
// What came of the problem of a body, with the time and the work that it took.
#pragma once

#include <Eigen/Core>
#include <chrono>
#include <slant/certificates/energy_error.hpp>
#include <slant/contact/free_motions.hpp>
#include <string>

#include "outcome.hpp"

namespace from_files {

struct solution {
  outcome run;
  Eigen::VectorXd u;
  std::string solved_by{};      ///< what found it, where several methods have a turn; else empty
  std::string factorization{};  ///< what factored K
  slant::energy_error<double> error{};  ///< what is known of the error in the energy norm
  double condition = 0;                 ///< estimate of that of K; 0: none
  slant::contact::free_motions<double> motions{};  ///< what K leaves free
  double setup_seconds = 0;  ///< factorisation, right-hand side, what the method prepares
  double solve_seconds = 0;  ///< iteration and recovery of u
  double kkt_residual = 0;   ///< relative; NaN if the run broke down

  /// Sets the times of a solution that was begun and has ended now.
  void take_times(clock::time_point begin) {
    auto const seconds = [](auto duration) {
      return std::chrono::duration<double>(duration).count();
    };
    setup_seconds = seconds(run.started - begin);
    solve_seconds = seconds(clock::now() - run.started);
  }
  [[nodiscard]] bool converged() const { return run.status == slant::status::converged; }
  [[nodiscard]] bool is_finite() const { return u.allFinite() && run.λ.allFinite(); }
};

}  // namespace from_files
