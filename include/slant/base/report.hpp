// SPDX-License-Identifier: MIT
//
// What a run leaves behind: the last state, why it ended, and how much work it was.
#pragma once

#include <slant/concepts/iterative_method.hpp>

#include <string>

namespace slant {

/// Counts of work. A method counts what it does itself; `counted(A)` counts from outside.
struct work {
  index operator_applications = 0;  ///< applications of A in the iteration
  index setup_applications = 0;     ///< applications of A before it, e.g. for a spectral bound
  index inner_iterations = 0;       ///< steps of an inner solver
  index factorizations = 0;         ///< matrices factored

  work& operator+=(work const& other) {
    operator_applications += other.operator_applications;
    setup_applications += other.setup_applications;
    inner_iterations += other.inner_iterations;
    factorizations += other.factorizations;
    return *this;
  }
  friend bool operator==(work const&, work const&) = default;
};

/// Result of `solve`.
template <class State>
struct report {
  State state;           ///< the last state; state.x is the solution
  slant::status status;  ///< how the run ended
  std::string reason;    ///< the same as a sentence, from the rule or the method that ended it

  /// The last iterate.
  [[nodiscard]] auto const& x() const { return state.x; }
  /// Number of steps taken.
  [[nodiscard]] index iterations() const { return state.iteration; }
  /// True only if the accuracy asked for was reached.
  [[nodiscard]] bool converged() const { return status == slant::status::converged; }
};

}  // namespace slant
