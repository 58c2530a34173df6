// SPDX-License-Identifier: MIT
//
// Conjugate gradients for F°(y) dy = −F where F°(y) itself is self-adjoint and positive definite,
// as the Hessian of a convex function is.
#pragma once

#include <slant/concepts/vector_algebra.hpp>
#include <slant/krylov/cg.hpp>
#include <slant/newton/detail/iteration_limit.hpp>
#include <slant/newton/direction.hpp>

namespace slant {

/// krylov/cg.hpp on G d = F, dy = −d; for operators that declare definiteness.
struct cg_solver {
  index max_iterations = 0;  ///< in one Newton step; 0: 10 n + 100
  bool warm_start = false;   ///< begin with what a shortened step left over

  /// Throws bad_input naming the option, its value and what was expected.
  [[gnu::cold]] void validate() const { detail::check_iteration_limit(max_iterations); }

  template <class G, class V>
    requires spd_operator<G, V>
  [[nodiscard]] auto prepare(G const& g, V const& f) const {
    auto zero = like(f, slant::local(f).size());
    vectors::set_zero(zero);
    return cg{g, f}.start(zero);
  }

  template <class G, class V, class State>
    requires spd_operator<G, V>
  direction_report<scalar_t<V>> solve(G const& g, V const& f,
                                      direction_request<scalar_t<V>> const& request, V& dy,
                                      State& s) const {
    using S = scalar_t<V>;
    cg const method{g, f};
    S const target = detail::attainable(request.tolerance) * request.residual_norm;
    vectors::scale(warm_start ? request.leftover : S(0), s.x);
    method.restart(s);
    detail::run_until(method, s, target, detail::iteration_limit(max_iterations, f),
                      [](auto const&) {});
    vectors::negate(s.x, dy);
    return {detail::verdict_on(s, target), s.residual_norm, s.iteration,
            s.work.operator_applications, 0};
  }

  /// The complaint about operators that it cannot handle.
  template <class G, class V>
  static consteval void refuse() {
    static_assert(spd_operator<G, V>,
                  "cg_solver: F°(y) must declare self_adjoint and positive_definite");
  }
};

}  // namespace slant
