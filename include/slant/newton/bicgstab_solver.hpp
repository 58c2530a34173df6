// SPDX-License-Identifier: MIT
//
// BiCGSTAB for F°(y) dy = −F, F°(y) any square operator: the solver of [T §3.2, variant B] and
// [K (54)].
//
// Its residual is not monotone, and the recurrence may break down, which in [T Table 4.9] ends as
// NaN. Here the best iterate is kept. After a breakdown that krylov/bicgstab.hpp cannot mend by
// itself the iteration begins anew at that iterate; a breakdown in the very first step from there
// is final: the status is breakdown and dy the best iterate, never NaN.
#pragma once

#include <slant/concepts/vector_algebra.hpp>
#include <slant/krylov/bicgstab.hpp>
#include <slant/newton/detail/iteration_limit.hpp>
#include <slant/newton/direction.hpp>

#include <utility>

namespace slant {

/// krylov/bicgstab.hpp on G d = F, dy = −d.
struct bicgstab_solver {
  index max_iterations = 0;  ///< in one Newton step; 0: 10 n + 100
  bool warm_start = false;   ///< begin with what a shortened step left over: one product more

  /// Throws bad_input naming the option, its value and what was expected.
  [[gnu::cold]] void validate() const { detail::check_iteration_limit(max_iterations); }

  template <class G, class V>
    requires linear_operator<G, V>
  [[nodiscard]] auto prepare(G const& g, V const& f) const {
    auto zero = like(f, slant::local(f).size());
    vectors::set_zero(zero);
    return bicgstab{g, f}.start(zero);
  }

  template <class G, class V, class State>
    requires linear_operator<G, V>
  direction_report<scalar_t<V>> solve(G const& g, V const& f,
                                      direction_request<scalar_t<V>> const& request, V& dy,
                                      State& s) const {
    using S = scalar_t<V>;
    bicgstab const method{g, f};
    S const target = detail::attainable(request.tolerance) * request.residual_norm;
    index const limit = detail::iteration_limit(max_iterations, f);
    direction_report<S> report;

    vectors::scale(warm_start ? request.leftover : S(0), s.x);
    report.residual_norm = request.residual_norm;
    // Where G is nearly singular a vector of any size changes the residual in its last digits.
    using std::sqrt;
    S const noticeably = S(1) - sqrt(std::numeric_limits<S>::epsilon());
    auto const keep_best = [&](auto const& state) {
      S const now = state.residual_norm;
      bool const enough = now <= target && now < report.residual_norm;
      if (!enough && !(now <= noticeably * report.residual_norm)) return;
      if (!detail::is_finite(S(norm(state.x)))) return;
      report.residual_norm = now;
      vectors::negate(state.x, dy);
    };
    vectors::set_zero(dy);
    while (true) {
      method.restart(s);
      keep_best(s);
      S const before = report.residual_norm;
      detail::run_until(method, s, target, limit - report.iterations, keep_best);
      report.iterations += s.iteration;
      report.operator_applications += s.work.operator_applications;
      report.status = report.residual_norm <= target ? status::converged : ended(s);
      bool const mendable = report.status == status::breakdown && report.residual_norm < before;
      if (!mendable) return report;
      vectors::negate(dy, s.x);
    }
  }

 private:
  /// A small residual that came with an infinite x is none.
  template <class State>
  static status ended(State const& s) {
    if (s.status == status::running || s.status == status::converged) {
      return detail::is_finite(norm(s.x)) ? status::iteration_limit : status::breakdown;
    }
    return s.status;
  }
};

}  // namespace slant
