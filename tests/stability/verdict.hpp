// SPDX-License-Identifier: MIT
//
// The verdict on a verdict: one ratio for each run,
//
//     ratio = (relative energy error reached) / (error allowed),    allowed = max(tolerance,
//     floor),
//
// and one threshold for all, as LAPACK's test programs have it. The floor is that of reference.hpp,
// with ε of the scalar that the method computes in.
#pragma once

#include <stability/methods.hpp>
#include <stability/reference.hpp>
#include <string_view>

namespace stability {

inline constexpr double threshold = 30;

enum class verdict : unsigned char {
  right,      ///< converged, and it is
  wrong,      ///< converged, and it is not
  unclaimed,  ///< not converged, though it is
  stalled,    ///< no further progress at this precision, though it is possible
  limit,      ///< no end within the limits
  unbounded,  ///< declared unbounded; no program here is
  breakdown,  ///< ended by itself as breakdown or interrupted
  refused,    ///< bad_input
  crashed     ///< any other exception, or a NaN behind `converged`
};
inline constexpr int verdict_count = 9;

[[nodiscard]] std::string_view name_of(verdict v);

struct judgement {
  verdict said = verdict::crashed;
  double error = 0;    ///< relative energy error
  double floor = 0;    ///< attainable relative energy error in the scalar of the method
  double allowed = 0;  ///< max(tolerance, floor)
  double ratio = 0;
  double kkt = 0;  ///< relative residual of the optimality conditions, from the data alone
  bool contradicted = false;  ///< wrong, and kkt alone shows it: above threshold × allowed
  bool claim_broken = false;  ///< an error was claimed that is below the true one
};

[[nodiscard]] judgement judge(prepared const& p, reference const& exact, method const& m,
                              request const& asked, outcome const& o);

/// Counts over many runs.
struct tally {
  long runs = 0;
  long counts[verdict_count] = {};
  long contradicted = 0, claims = 0, claims_broken = 0;
  double largest = 0;  ///< ratio of a run that said `converged`

  void add(outcome const& o, judgement const& j);
  [[nodiscard]] long count(verdict v) const { return counts[static_cast<int>(v)]; }
  /// Runs that ended without the accuracy that is possible.
  [[nodiscard]] long missed() const {
    return count(verdict::stalled) + count(verdict::limit) + count(verdict::unbounded) +
           count(verdict::breakdown) + count(verdict::crashed);
  }
};

/// "stability: 0 of 12480 above 30 (…)".
[[nodiscard]] std::string summary_line(tally const& t);

}  // namespace stability
