// SPDX-License-Identifier: MIT
//
// Linear solvers of Newton's method by Krylov methods: cg_solver, bicgstab_solver, gmres_solver.
#pragma once

#include <slant/base/vector_algebra.hpp>
#include <slant/concepts/bad_input.hpp>
#include <slant/krylov/bicgstab.hpp>
#include <slant/krylov/cg.hpp>
#include <slant/newton/direction.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace slant {

// --- cg solver -----------------------------------------------------------------------------------
//
// Conjugate gradients for F°(y) dy = −F where F°(y) itself is self-adjoint and positive definite,
// as the Hessian of a convex function is.

/// krylov/cg.hpp on G d = F, dy = −d; for operators that declare definiteness.
struct cg_solver {
  index max_iterations = 0;  ///< in one Newton step; 0: 10 n + 100

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
  report_of<V> solve(G const& g, V const& f, request_of<V> const& request, V& dy, State& s) const {
    using S = scalar_t<V>;
    cg const method{g, f};
    S const target = detail::attainable(request.tolerance) * request.residual_norm;
    vectors::set_zero(s.x);
    method.restart(s);
    detail::run_until(method, s, target, detail::iteration_limit(max_iterations, f),
                      [](auto const&) {});
    vectors::negate(s.x, dy);
    return {detail::verdict_on(s, target), s.residual_norm, s.iteration,
            s.work.operator_applications, 0};
  }

  template <class G, class V>
  static consteval void refuse() {
    static_assert(spd_operator<G, V>,
                  "cg_solver: F°(y) must declare self_adjoint and positive_definite");
  }
};

// --- bicgstab solver -----------------------------------------------------------------------------
//
// BiCGSTAB for F°(y) dy = −F, F°(y) any square operator: the solver of [T §3.2, variant B] and
// [K (54)].
//
// Its residual is not monotone, and the recurrence may break down, which in [T Table 4.9] ends as
// NaN. Here the best iterate is kept. After a breakdown that krylov/bicgstab.hpp cannot mend by
// itself the iteration begins anew at that iterate; a breakdown in the very first step from there
// is final: the status is breakdown and dy the best iterate, never NaN.

/// krylov/bicgstab.hpp on G d = F, dy = −d.
struct bicgstab_solver {
  index max_iterations = 0;  ///< in one Newton step; 0: 10 n + 100

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
  report_of<V> solve(G const& g, V const& f, request_of<V> const& request, V& dy, State& s) const {
    using S = scalar_t<V>;
    bicgstab const method{g, f};
    S const target = detail::attainable(request.tolerance) * request.residual_norm;
    index const limit = detail::iteration_limit(max_iterations, f);
    direction_report<S> report;

    vectors::set_zero(s.x);
    report.residual_norm = request.residual_norm;
    // Where G is nearly singular a vector of any size changes the residual in its last digits.
    using std::sqrt;
    S const noticeably = S(1) - sqrt(detail::epsilon<S>());
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

// --- gmres solver --------------------------------------------------------------------------------
//
// GMRES for F°(y) dy = −F, F°(y) any square operator [Saad, Schultz 1986]: of all dy in the Krylov
// space the one with the smallest residual,
//
//     V_{j+1} H_j = F° V_j,      dy = V_j argmin ‖β e₁ − H_j t‖,      β = ‖F‖, v₁ = −F/β.
//
// One application a step, where BiCGSTAB has two, and a residual that never grows; in exchange for
// memory, a vector a step, and for inner products with all of them. So it is the solver of choice
// where an application is dear and some tens of steps are enough, as for B K⁻¹ Bᵀ. After `restart`
// steps it begins anew at what it has. The residual reported is computed, with an application more,
// where rounding errors could have made another one of it than that of the recurrence.

/// What gmres_solver keeps: the basis and the triangular factor of H.
template <class V, class W>
struct gmres_memory {
  using scalar = scalar_t<V>;
  std::vector<V> basis;        ///< v₁, v₂, …
  std::vector<scalar> h;       ///< columns of R, packed: column j has j + 1 entries
  std::vector<scalar> column;  ///< the new column of H
  std::vector<scalar> c, s;    ///< rotations
  std::vector<scalar> t;       ///< rotated right-hand side, then the coefficients
  W workspace;                 ///< temporaries of F°
};

/// GMRES(restart) as a linear solver of Newton's method.
struct gmres_solver {
  index restart = 60;        ///< vectors that are kept, >= 1; that of an unknown each is enough
  index max_iterations = 0;  ///< in one Newton step; 0: 10 n + 100

  [[gnu::cold]] void validate() const {
    if (restart < 1) throw bad_input("restart", detail::show(restart), "at least 1");
    detail::check_iteration_limit(max_iterations);
  }

  template <class G, class V>
    requires linear_operator<G, V>
  [[nodiscard]] auto prepare(G const& g, V const& f) const {
    index const n = slant::local(f).size();
    auto const most = std::size_t(std::min<index>(restart, slant::global_size(f)));
    using S = scalar_t<V>;
    std::vector<S> const room(most), more(most + 1);
    std::vector<S> h(most * (most + 1) / 2);
    gmres_memory<V, workspace_t<G, V>> m{{}, std::move(h), more, room, room, more, workspace(g, f)};
    m.basis.reserve(most + 1);
    for (std::size_t i = 0; i <= most; ++i) m.basis.push_back(like(f, n));
    return m;
  }

  template <class G, class V, class Memory>
    requires linear_operator<G, V>
  report_of<V> solve(G const& g, V const& f, request_of<V> const& request, V& dy, Memory& m) const {
    using S = scalar_t<V>;
    S const target = detail::attainable(request.tolerance) * request.residual_norm;
    index const limit = detail::iteration_limit(max_iterations, f);
    direction_report<S> report;
    report.residual_norm = request.residual_norm;
    vectors::set_zero(dy);
    vectors::negate(f, m.basis[0]);
    S size = request.residual_norm;
    S largest(0);
    while (size > target && report.iterations < limit) {
      vectors::divide(size, m.basis[0]);
      auto const [used, rotated] = cycle(g, target, size, limit, report, dy, largest, m);
      bool const last = rotated <= target || report.iterations >= limit;
      if (last && rotated < report.residual_norm &&
          rotated > doubtful(request.residual_norm, S(largest * norm(dy)))) {
        report.residual_norm = rotated;
        break;
      }
      V& r = m.basis[used];
      if (used > 0) {
        slant::apply(g, std::as_const(dy), r, m.workspace);
        ++report.operator_applications;
        vectors::waxpby(S(-1), f, S(-1), r, r);
        size = norm(r);
      }
      if (used == 0 || !(size < report.residual_norm)) {  // no progress, or not a number
        take_back(used, report, request.residual_norm, dy, m);
        report.status = status::breakdown;
        return report;
      }
      report.residual_norm = size;
      std::swap(m.basis[0], r);
    }
    report.status = report.residual_norm <= target ? status::converged : status::iteration_limit;
    return report;
  }

 private:
  template <class S>
  struct run {
    std::size_t used;  ///< vectors
    S residual;        ///< as the rotations have it
  };

  /// What rotations say of the residual is true up to rounding errors of ‖f‖ + ‖F°‖‖dy‖: down to
  /// half of the digits of that it is believed, below it is computed.
  template <class S>
  static S doubtful(S const& f, S const& image) {
    using std::sqrt;
    return sqrt(detail::epsilon<S>()) * (f + image);
  }

  /// One run from v₁; adds to dy. `largest` becomes that of the ‖F° v_j‖, if it is larger.
  template <class G, class S, class V, class Memory>
  static run<S> cycle(G const& g, S const& target, S const& size, index limit,
                      direction_report<S>& report, V& dy, S& largest, Memory& m) {
    std::size_t const most = m.c.size();
    std::size_t used = 0;
    m.t[0] = size;
    S residual = size;
    for (std::size_t j = 0; j < most && residual > target && report.iterations < limit; ++j) {
      V& next = m.basis[j + 1];
      slant::apply(g, std::as_const(m.basis[j]), next, m.workspace);
      ++report.operator_applications;
      ++report.iterations;
      S const whole = norm(next);
      if (!detail::is_finite(whole)) break;
      largest = std::max(largest, whole);
      for (std::size_t i = 0; i <= j; ++i) {
        m.column[i] = inner_product(m.basis[i], next);
        vectors::axpy(-m.column[i], m.basis[i], next);
      }
      S below = norm(next);
      // What is left is a rounding error: the space holds the solution, or F° is singular on it.
      bool const last = below <= S(8) * detail::epsilon<S>() * whole;
      if (last) below = S(0);
      if (!last) vectors::divide(below, next);
      if (!rotate(m, j, below, whole)) break;
      used = j + 1;
      using std::abs;
      residual = abs(m.t[used]);
      if (last) break;
    }
    for (std::size_t i = used; i-- > 0;) {
      for (std::size_t l = i + 1; l < used; ++l) m.t[i] -= entry(m, i, l) * m.t[l];
      m.t[i] /= entry(m, i, i);
      vectors::axpy(m.t[i], m.basis[i], dy);
    }
    return {used, residual};
  }

  /// dy as it was before the last cycle; 0 if that is not a number.
  template <class S, class V, class Memory>
  static void take_back(std::size_t used, direction_report<S>& report, S const& whole, V& dy,
                        Memory const& m) {
    for (std::size_t i = 0; i < used; ++i) vectors::axpy(-m.t[i], m.basis[i], dy);
    if (detail::is_finite(norm(dy))) return;
    vectors::set_zero(dy);
    report.residual_norm = whole;
  }

  /// R_il.
  template <class Memory>
  static auto& entry(Memory& m, std::size_t i, std::size_t l) {
    return m.h[l * (l + 1) / 2 + i];
  }

  /// Takes the new column of H into R; false if R is singular then.
  template <class Memory, class S>
  static bool rotate(Memory& m, std::size_t j, S const& below, S const& whole) {
    for (std::size_t i = 0; i < j; ++i) {
      S const upper = m.column[i];
      m.column[i] = m.c[i] * upper + m.s[i] * m.column[i + 1];
      m.column[i + 1] = m.c[i] * m.column[i + 1] - m.s[i] * upper;
      entry(m, i, j) = m.column[i];
    }
    using std::abs;
    S const length = detail::root_of_squares<S>(abs(m.column[j]), below);
    if (!(length > S(8) * detail::epsilon<S>() * whole)) return false;
    m.c[j] = m.column[j] / length;
    m.s[j] = below / length;
    entry(m, j, j) = length;
    m.t[j + 1] = -m.s[j] * m.t[j];
    m.t[j] *= m.c[j];
    return true;
  }
};

}  // namespace slant
