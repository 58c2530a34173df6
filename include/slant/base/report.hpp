// SPDX-License-Identifier: MIT
//
// What a run leaves behind: the last state, why it ended, and how much work it was.
#pragma once

#include <slant/concepts/iterative_method.hpp>
#include <slant/concepts/vector.hpp>

#include <ostream>
#include <string>
#include <string_view>

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

namespace detail {

/// What the statuses of a method mean; empty: no more than their names say. The usual ones are
/// those of descent by the reduced gradient.
struct status_meanings {
  std::string_view converged = "the reduced gradient vanishes";
  std::string_view stalled{};
  std::string_view unbounded = "the function decreases for ever along a direction of the set";
  std::string_view breakdown =
      "a number left the range of the scalar, or A is not positive semidefinite";
};

/// The meaning of a status, or its name.
[[nodiscard, gnu::cold]] inline std::string reason_of(status how, status_meanings const& meaning) {
  std::string_view const text = how == status::converged   ? meaning.converged
                                : how == status::stalled   ? meaning.stalled
                                : how == status::unbounded ? meaning.unbounded
                                : how == status::breakdown ? meaning.breakdown
                                                           : std::string_view();
  return std::string(text.empty() ? to_string(how) : text);
}

/// The lines of a run; those of numbers that are 0 are left out.
[[gnu::cold]] inline void print_run(std::ostream& out, status how, std::string const& why,
                                    index unknowns, std::string const& steps, work const& spent,
                                    std::string const& choice = {}) {
  out << to_string(how) << ": " << why;
  if (unknowns > 0) out << "\n  unknowns               " << unknowns;
  out << "\n  steps                  " << steps;
  if (spent.inner_iterations > 0) out << "\n  inner steps            " << spent.inner_iterations;
  index const products = spent.operator_applications, before = spent.setup_applications;
  if (products + before > 0) out << "\n  applications of A      " << products;
  if (before > 0) out << ", and " << before << " before the first step";
  if (spent.factorizations > 0) out << "\n  factorizations         " << spent.factorizations;
  if (!choice.empty()) out << "\n  chosen                 " << choice;
  out << "\n";
}

/// Number of entries of a vector, of all its parts; 0 of what is none, such as a number.
template <class X>
[[nodiscard]] index unknowns_of(X const& x) {
  if constexpr (vector<X>) {
    return slant::global_size(x);
  } else {
    return 0;
  }
}

}  // namespace detail

/// How it ended, and at what cost:
///
///     converged: relative reduced gradient 1.2e-09 / 3.5 is at most 1e-08
///       unknowns               12
///       steps                  9
///       inner steps            40
///       applications of A      51, and 20 before the first step
template <class State>
std::ostream& operator<<(std::ostream& out, report<State> const& run) {
  work spent{};
  if constexpr (requires { spent = run.state.work; }) spent = run.state.work;
  detail::print_run(out, run.status, run.reason, detail::unknowns_of(run.x()),
                    std::to_string(run.iterations()), spent);
  return out;
}

}  // namespace slant
