// SPDX-License-Identifier: MIT
//
// A quadratic program with equations, solved to a relative error in the energy norm:
//
//     auto const run = slant::solve(minimise(quadratic(A, b)).over(Λ).subject_to(G, e), 1e-8);
//     run.x(), run.multipliers;                          // x ∈ Λ, μ of G x = e
//
// as solve_program.hpp does it without: blocks scaled where their stiffness differs, then
// constrained_newton under the control of constrained_certificate, preconditioned by A⁻¹ where A
// offers it, and by multigrid where A is a sparse matrix, once conjugate gradients have taken long
// without. `run.choice` tells.
#pragma once

#include <slant/base/vector_algebra.hpp>
#include <slant/certificates/constrained_certificate.hpp>
#include <slant/methods/constrained_newton.hpp>
#include <slant/methods/solve_program.hpp>

#include <algorithm>
#include <concepts>
#include <optional>
#include <string>
#include <utility>

namespace slant {

/// A quadratic program with its equality constraints: what minimise(q).over(Λ).subject_to(G, e) is.
template <class P>
concept equality_constrained_program = requires(P const& p) {
  { p.qp() } -> std::same_as<typename P::program_type const&>;
  { p.constraints() } -> std::same_as<typename P::constraints_type const&>;
};

namespace detail {

/// constrained_newton from x0 until the certificate says that it is enough.
template <class QP, class C, class M>
[[nodiscard]] auto constrained_and_certified(QP const& qp, C const& c, M const& m,
                                             typename QP::vector_type const& x0,
                                             typename QP::scalar tolerance, run_limits most)
    -> certified_point<typename QP::vector_type> {
  using V = typename QP::vector_type;
  using S = typename QP::scalar;
  constrained_newton_options<S> o;
  o.inner_steps = std::min<index>(o.inner_steps, most.applications);
  auto const run = [&](auto const& method, auto&& certificate) {
    certified_point<V> result{.point = x0, .method = "constrained_newton"};
    auto state = method.start(x0);
    index for_multipliers = 0;
    auto const certify = [&](V const& x, V const& ν) {
      auto now = certificate(x, ν);
      // Where rows are nearly dependent on the face, the digits are missing that would tell.
      if constexpr (requires { c.meets(x, tolerance); }) {
        if (now.relative() <= tolerance && !c.meets(x, tolerance)) now.bound = infinity<S>();
      }
      // Further steps may have led away from the best point.
      S const best = result.error.relative();
      if (now.relative() < best || !is_finite(best)) {
        result.error = now;
        slant::project(qp.set(), x, result.point);  // which a last step may leave by a rounding
        result.multipliers = method.multipliers(state);
        ++for_multipliers;
      }
      return result.error;
    };
    auto stop = energy_error_below(tolerance, certify) || slant::at_most(most.steps) ||
                slant::at_most_applications(most.applications);
    auto end = run_to_end(method, state, stop);
    if (end.how != status::converged) static_cast<void>(certify(state.x, state.ν));
    result.status = end.how;
    // Only SMALSE-M finds one: on it G d = 0, as the penalty does not rise.
    if (end.how == status::unbounded && state.fallback) {
      result.descent = -state.fallback->inner.directions.p;
    }
    result.reason = state.infeasible ? state.reason() : std::move(end.why);
    result.steps = state.iteration;
    result.work = state.work;
    result.work.operator_applications += certificate.applications() + for_multipliers;
    return result;
  };
  if constexpr (std::same_as<M, identity_operator>) {
    return run(constrained_newton{qp, c, o}, constrained_certificate<QP, C>(qp, c));
  } else {
    return run(constrained_newton{qp, c, m, o}, constrained_certificate<QP, C, M>(qp, c, m));
  }
}

/// qp in unknowns y with x = D y, or in its own with an empty d, under equations in these unknowns.
template <class Original, class QP, class C, class S>
[[nodiscard]] auto solve_constrained(Original const& original, QP const& qp, C const& c,
                                     Eigen::Matrix<S, Eigen::Dynamic, 1> const& d, S tolerance,
                                     index max_steps) {
  auto const by = [&](auto const& m, auto const& x0, run_limits most) {
    return constrained_and_certified(qp, c, m, x0, tolerance, most);
  };
  auto const zero = zero_of(qp);
  identity_operator const I(qp.size());
  if constexpr (inverse_preconditions<QP>) {
    auto run = by(qp.a().inverse(), zero, {.steps = max_steps});
    run.choice = "A⁻¹ as preconditioner, because A offers it";
    return run;
  } else if constexpr (levels_precondition<Original>) {
    auto const& k = matrix_behind<typename Original::operator_type>::of(original.a());
    index const enough = enough_without_levels(k);
    auto first = by(I, zero, {.steps = max_steps, .applications = enough});
    index const spent = first.work.operator_applications;
    bool const is_long = first.status == status::iteration_limit && first.steps < max_steps;
    if (!is_long) return first;
    return with_levels(k, d, spent, [&](auto const& m, std::string choice) {
      auto run = by(m, first.point, {.steps = max_steps - first.steps});
      run.steps += first.steps;
      run.work += first.work;
      run.choice = std::move(choice);
      return run;
    });
  } else {
    return by(I, zero, {.steps = max_steps});
  }
}

}  // namespace detail

/// Solves min ½ xᵀA x − bᵀx over x ∈ Λ, G x = e from 0; see the top of this file. `converged` means
/// that the estimated error is at most the tolerance, and |G x − e| beside |G| |x| + |e| in each row,
/// up to the rounding of rows that have unknowns in common with it and, where e is 0, of x; x is in
/// Λ. Throws bad_input for a tolerance that is not in [0, 1), a limit < 0, or a program that
/// constrained_newton refuses.
template <equality_constrained_program P>
  requires constrained_newton_problem<typename P::program_type, typename P::constraints_type>
[[nodiscard]] auto solve(P const& p, typename P::scalar tolerance, index max_steps = 1000) {
  using QP = typename P::program_type;
  using S = typename P::scalar;
  using V = Eigen::Matrix<S, Eigen::Dynamic, 1>;
  detail::check_limits(tolerance, max_steps);
  QP const& qp = p.qp();
  auto const& c = p.constraints();
  if constexpr (detail::scales_blocks<QP> && requires { c.unit_values(); }) {
    if (auto d = detail::block_factors_if_needed(qp); d.size() > 0) {
      equilibrated<QP const&> const scaled(qp, std::move(d));
      auto const alike = scaled.qp();
      std::optional<equality_constraints<S>> rows;
      try {
        rows.emplace(Eigen::SparseMatrix<S>(c.unit_rows() * scaled.d().asDiagonal()),
                     c.unit_values());
      } catch (bad_input const&) {
      }
      // In these unknowns they may depend on each other up to rounding, and not in their own.
      if (rows && rows->redundant().empty()) {
        auto result = detail::solve_constrained(qp, alike, *rows, scaled.d(), tolerance, max_steps);
        detail::unscale(result, scaled);
        result.multipliers = c.of_unit_rows(result.multipliers);
        return result;
      }
    }
  }
  return detail::solve_constrained(qp, qp, c, V(), tolerance, max_steps);
}

/// A program that lacks something ends here and is told so by constrained_newton.
template <equality_constrained_program P>
  requires(!constrained_newton_problem<typename P::program_type, typename P::constraints_type>)
auto solve(P const&, typename P::scalar, index = 0) -> certified_point<typename P::vector_type> {
  static_assert(sizeof(constrained_newton<typename P::program_type const&,
                                          typename P::constraints_type const&, identity_operator>) >
                0);
  return {};
}

}  // namespace slant
