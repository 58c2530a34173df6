// SPDX-License-Identifier: MIT
//
// A quadratic program solved to a relative error in the energy norm, with nothing else to choose:
//
//     auto const run = slant::solve(qp, 1e-8);         // ‖x − x*‖_A ≤ 1e-8 ‖x*‖_A, estimated
//     auto const run = slant::solve(qp, x0, 1e-8);     // from x0, a solution nearby
//     auto const run = slant::solve(qp, M, 1e-8);      // with a preconditioner M ≈ A⁻¹
//
//     scale         blocks whose stiffness diag(A) differs by more than 64 become alike
//                   (problems/equilibrated.hpp), where A gives its diagonal
//     precondition  by A⁻¹ where A offers it; by multigrid on the face (multilevel/multigrid.hpp)
//                   where A is a sparse matrix, once conjugate gradients have taken long without
//     solve         symmetric_newton to a reduced gradient of a tenth of the tolerance; with a
//                   longer ρ where A is a sparse matrix: what is active changes its neighbours first
//     certify       the energy error by energy_certificate; while that is too large, a smaller one
//     otherwise     where 300 steps do not do, interior_point goes first, and Newton's method again;
//                   for a function forward_backward goes on
//
// What A is, its type says, so that what is not chosen is not compiled. `run.choice` tells.
//
// The certificate estimates ‖·‖_{A⁻¹} by conjugate gradients, in up to 200 applications of A. Give
// `solve(method, x0, energy_error_below(tolerance, certificate))` a bound where one is known.
#pragma once

#include <slant/base/vector_algebra.hpp>
#include <slant/certificates/energy_certificate.hpp>
#include <slant/iteration/solve.hpp>
#include <slant/methods/forward_backward.hpp>
#include <slant/methods/interior_point.hpp>
#include <slant/methods/symmetric_newton.hpp>
#include <slant/multilevel/multigrid.hpp>
#include <slant/operators/identity.hpp>
#include <slant/operators/letter.hpp>
#include <slant/problems/equilibrated.hpp>

#include <algorithm>
#include <concepts>
#include <limits>
#include <optional>
#include <ostream>
#include <string>
#include <string_view>
#include <utility>

namespace slant {

/// What solve(qp, tolerance) found.
template <class V>
struct certified_point {
  using scalar = scalar_t<V>;

  V point{};                     ///< in Λ
  slant::status status{};        ///< converged: the estimated error is at most the tolerance
  std::string reason{};          ///< the status as a sentence
  energy_error<scalar> error{};  ///< what is known of ‖x − x*‖_A
  index steps = 0;               ///< of the method
  std::string_view method = "symmetric_newton";  ///< its name
  slant::work work{};    ///< all applications of A, those of certificates included
  V descent{};           ///< where unbounded: a direction in which the function falls for ever
  V multipliers{};       ///< with equations G x = e: their μ, as many as G has rows
  std::string choice{};  ///< what was chosen for A and why, as sentences; or empty

  [[nodiscard]] V const& x() const { return point; }
  [[nodiscard]] index iterations() const { return steps; }
  [[nodiscard]] bool converged() const { return status == slant::status::converged; }
};

/// How well, how, and at what cost:
///
///     converged: relative energy error 2.1e-10, estimated, at most 1e-08
///       unknowns               12
///       steps                  9 of symmetric_newton
///       inner steps            40
///       applications of A      51, and 20 before the first step
///       chosen                 blocks scaled, because their stiffness differs by more than 64
template <class V>
std::ostream& operator<<(std::ostream& out, certified_point<V> const& run) {
  detail::print_run(out, run.status, run.reason, detail::unknowns_of(run.point),
                    std::to_string(run.steps) + " of " + std::string(run.method), run.work,
                    run.choice);
  return out;
}

namespace detail {

/// A offers an inverse that may precondition.
template <class QP>
concept inverse_preconditions = requires(QP const& qp) {
  requires has_inverse<typename QP::operator_type, typename QP::vector_type>;
  { qp.a().inverse() } -> preconditioner_for<QP>;
};

/// A is a sparse matrix of the scalars of levels.
template <class QP>
concept levels_precondition =
    matrix_behind<typename QP::operator_type>::sparse &&
    std::same_as<typename QP::vector_type, Eigen::Matrix<typename QP::scalar, Eigen::Dynamic, 1>>;

/// How far a method goes.
struct run_limits {
  index steps;
  index applications = std::numeric_limits<index>::max();  ///< of A, those of certificates apart
  /// A front moves as many nodes a step as ρ A reaches, which matters where A is sparse; a longer ρ
  /// sets free too much.
  bool sparse = false;
};

/// The method make(threshold) from x0 under the control of certificates.
template <class V, class S, class Make, class Certificate>
[[nodiscard]] certified_point<V> run_certified(Make const& make, V const& x0,
                                               Certificate& certificate, S const& tolerance,
                                               run_limits most) {
  S threshold = tolerance / S(10), best = detail::infinity<S>();
  auto state = make(threshold).start(x0);
  certified_point<V> result{.point = x0, .status = status::running, .reason = {}, .choice = {}};
  while (true) {
    auto method = make(threshold);
    auto stop = reduced_gradient_below(threshold) || slant::at_most(most.steps) ||
                slant::at_most_applications(most.applications);
    auto end = run_to_end(method, state, stop);
    bool const may_go_on = state.iteration < most.steps && end.how != status::converged;
    if (state.work.operator_applications >= most.applications && may_go_on) {
      result.status = status::iteration_limit;
      result.error = {};  // of another point
      vectors::copy(state.x, result.point);
      break;
    }
    auto now = certificate(state.x);
    // No relative error of a point without energy is finite but 0, and that is what it is here.
    if (now.size == S(0) && is_finite(now.bound) && end.how == status::converged &&
        state.reduced_gradient_norm == S(0)) {
      now.bound = S(0);
    }
    S const error = now.relative();
    // Further steps may have led away from the best point.
    if (error < best || !is_finite(best)) {
      result.error = now;
      vectors::copy(state.x, result.point);
    }
    result.status = end.how;
    bool const is_enough = error <= tolerance && end.how != status::unbounded;
    bool const is_better = error < best / S(1.5) || !is_finite(error);  // or nothing is known yet
    bool const can_go_on = end.how == status::converged && is_better && threshold > S(0) &&
                           state.reduced_gradient_norm > S(0);
    if (is_enough || !can_go_on) {
      if (is_enough) {
        result.status = status::converged;
        result.reason = result.error.sentence() + ", at most " + show(tolerance);
      } else {
        if (end.how == status::converged) result.status = status::stalled;
        result.reason = end.how == status::converged || end.how == status::stalled
                            ? result.error.sentence() + ": rounding errors allow no more"
                            : end.why + "; " + result.error.sentence();
      }
      break;
    }
    best = std::min<S>(best, error);
    S const missing = tolerance / error;
    threshold = std::min<S>(threshold, state.reduced_gradient_norm / state.gradient_scale) *
                std::clamp<S>(missing / S(3), S(1e-3), S(0.3));
    if constexpr (requires { method.resume(state); }) method.resume(state);
  }
  if constexpr (requires { state.descent.state()->directions.p; }) {
    if (result.status == status::unbounded && state.descent.state()) {
      result.descent = state.descent.state()->directions.p;
      vectors::negate(result.descent, result.descent);
    }
  }
  result.steps = state.iteration;
  result.work = state.work;
  return result;
}

/// Newton's method.
template <class QP, class M, class Certificate>
[[nodiscard]] auto newton_certified(QP const& qp, M const& m, typename QP::vector_type const& x0,
                                    Certificate& certificate, typename QP::scalar tolerance,
                                    run_limits most) {
  using S = typename QP::scalar;
  auto const make = [&](S const& threshold) {
    symmetric_newton_options<S> o;
    o.forcing.goal = static_cast<double>(threshold);
    o.inner_steps = std::min<index>(o.inner_steps, most.applications);
    if (most.sparse) o.step_factor = S(4);
    if constexpr (std::same_as<M, identity_operator>) {
      return symmetric_newton{qp, o};
    } else {
      return symmetric_newton{qp, m, o};
    }
  };
  return run_certified(make, x0, certificate, tolerance, most);
}

/// A point from within the set for Newton's method to start from; whether there is one. Sets
/// without an interior have none.
template <class QP>
[[nodiscard]] bool start_inside(QP const& qp, typename QP::vector_type& x,
                                typename QP::scalar tolerance, work& spent) {
  using S = typename QP::scalar;
  if constexpr (interior_point_problem<QP>) {
    try {
      // Where Newton's method needs help, a small reduced gradient may leave a large error.
      S const goal = std::max<S>(S(16) * detail::epsilon<S>(), S(1e-4) * tolerance);
      auto const run =
          slant::solve(interior_point{qp}, x, reduced_gradient_below(goal) || slant::at_most(150));
      spent.operator_applications += run.state.work.operator_applications;
      spent.setup_applications += run.state.work.setup_applications;
      if (run.status == status::breakdown || run.status == status::unbounded) return false;
      vectors::copy(run.x(), x);
      return is_finite(slant::norm(x));
    } catch (bad_input const&) {
      return false;
    }
  }
  return false;
}

/// After Newton's method from x0, which has ended at `result` without a solution: an interior-point
/// method and Newton's again, or forward_backward for a function. Nothing if there is no other way.
template <class QP, class M, class Certificate>
[[nodiscard]] auto another_way(QP const& qp, M const& m, typename QP::vector_type x0,
                               certified_point<typename QP::vector_type> const& result,
                               Certificate& certificate, typename QP::scalar tolerance,
                               run_limits most) {
  std::optional<certified_point<typename QP::vector_type>> found;
  if constexpr (quadratic_program<QP>) {
    work spent{};
    bool const has_start = start_inside(qp, x0, tolerance, spent);
    if (has_start || result.status == status::iteration_limit) {
      found = newton_certified(qp, m, has_start ? x0 : result.point, certificate, tolerance, most);
      found->work += spent;
    }
  } else {
    try {
      auto const make = [&](auto const&) { return forward_backward{qp}; };
      found = run_certified(make, result.point, certificate, tolerance, most);
      found->method = "symmetric_newton, then forward_backward";
    } catch (bad_input const&) {  // a point or a step length that is not finite
    }
  }
  return found;
}

/// Newton's method from x0; where 300 of its steps do not do, another way.
template <class QP, class M>
[[nodiscard]] auto solve_certified(QP const& qp, M const& m, typename QP::vector_type const& x0,
                                   typename QP::scalar tolerance, index most, bool sparse)
    -> certified_point<typename QP::vector_type> {
  energy_certificate certificate(qp, m);
  index const first = std::min<index>(most, 300);
  auto result =
      newton_certified(qp, m, x0, certificate, tolerance, {.steps = first, .sparse = sparse});
  bool const is_open = result.status == status::stalled || result.status == status::breakdown ||
                       result.status == status::iteration_limit;
  if (is_open && result.steps < most && result.error.relative() > tolerance) {
    run_limits const rest{.steps = most - result.steps, .sparse = sparse};
    if (auto other = another_way(qp, m, x0, result, certificate, tolerance, rest)) {
      index const steps = result.steps + other->steps;
      work spent = result.work;
      spent += other->work;
      if (other->error.relative() <= result.error.relative()) result = std::move(*other);
      result.steps = steps;
      result.work = spent;
    }
  }
  result.work.operator_applications += certificate.applications();
  return result;
}
template <class QP>
[[nodiscard]] typename QP::vector_type zero_of(QP const& qp) {
  auto x = like(qp.b(), qp.size());
  vectors::set_zero(x);
  return x;
}

/// Multigrid for D K D, or for K if d is empty.
template <class K, class S>
[[nodiscard]] auto multigrid_of(K const& k, Eigen::Matrix<S, Eigen::Dynamic, 1> const& d) {
  if (d.size() == 0) return slant::multigrid<S>(k);
  Eigen::SparseMatrix<S> const scaled = d.asDiagonal() * k * d.asDiagonal();
  // What was constant: one column for each unknown of a node.
  multigrid_options const o{.block_size = std::min<index>(3, detected_block_size(scaled))};
  Eigen::Matrix<S, Eigen::Dynamic, Eigen::Dynamic> constants;
  constants.setZero(d.size(), o.block_size);
  for (index i = 0; i < d.size(); ++i) constants(i, i % o.block_size) = S(1) / d(i);
  return slant::multigrid<S>(scaled, constants, o);
}

/// Applications of K after which conjugate gradients have taken about what levels and a face on
/// them would: the coarsest one is factored for each face, 500³/3 operations, and K may have few
/// entries.
template <class K>
[[nodiscard]] index enough_without_levels(K const& k) {
  return 300 + index(2e7 / (1 + static_cast<double>(k.nonZeros())));
}

/// go_on(M, what was chosen and why) with multigrid for D K D, or without where there is none.
template <class K, class S, class F>
[[nodiscard]] auto with_levels(K const& k, Eigen::Matrix<S, Eigen::Dynamic, 1> const& d,
                               index applications, F const& go_on) {
  std::string const why =
      "because " + show(applications) + " applications of A were not enough without: ";
  try {
    auto const m = multigrid_of(k, d);
    return go_on(m, "multigrid, " + why + m.description());
  } catch (bad_input const& e) {  // A is not definite, or of a kind that levels do not fit
    return go_on(identity_operator(k.rows()), "no multigrid, " + why + e.what());
  }
}

/// Solves qp with A = D K D: without a preconditioner as long as that costs about what levels would,
/// then with multigrid from where that has come.
template <class QP, class K, class S>
[[nodiscard]] auto solve_sparse(QP const& qp, K const& k,
                                Eigen::Matrix<S, Eigen::Dynamic, 1> const& d,
                                typename QP::vector_type const& x0, S tolerance, index most) {
  identity_operator const I(qp.size());
  index const enough = enough_without_levels(k);
  energy_certificate certificate(qp, I);
  auto first = newton_certified(
      qp, I, x0, certificate, tolerance,
      {.steps = std::min<index>(most, 300), .applications = enough, .sparse = true});
  bool const ended = first.status == status::converged || first.status == status::unbounded;
  if (ended || first.steps >= most) {
    first.work.operator_applications += certificate.applications();
    return first;
  }
  auto const go_on = [&](auto const& m, std::string choice) {
    auto run = solve_certified(qp, m, first.point, tolerance, most - first.steps, true);
    run.steps += first.steps;
    run.work += first.work;
    run.work.operator_applications += certificate.applications();
    run.choice = std::move(choice);
    return run;
  };
  if (first.work.operator_applications < enough) return go_on(I, {});
  return with_levels(k, d, first.work.operator_applications, go_on);
}

/// Solves qp with the preconditioner that A offers.
template <class QP>
[[nodiscard]] auto solve_by_parts(QP const& qp, typename QP::vector_type const& x0,
                                  typename QP::scalar tolerance, index most) {
  using A = typename QP::operator_type;
  using S = typename QP::scalar;
  if constexpr (inverse_preconditions<QP>) {
    auto run = solve_certified(qp, qp.a().inverse(), x0, tolerance, most, false);
    run.choice = "A⁻¹ as preconditioner, because A offers it";
    return run;
  } else if constexpr (levels_precondition<QP>) {
    return solve_sparse(qp, matrix_behind<A>::of(qp.a()), Eigen::Matrix<S, Eigen::Dynamic, 1>(), x0,
                        tolerance, most);
  } else {
    return solve_certified(qp, identity_operator(qp.size()), x0, tolerance, most, false);
  }
}

/// Blocks of QP can be scaled.
template <class QP>
concept scales_blocks = may_have_diagonal<typename QP::operator_type, typename QP::vector_type> &&
                        has_visit<typename QP::set_type>;

/// One factor for each unknown if the stiffness of the blocks spreads by more than 64; else none.
template <class QP>
[[nodiscard]] auto block_factors_if_needed(QP const& qp) {
  using S = typename QP::scalar;
  using V = typename QP::vector_type;
  Eigen::Matrix<S, Eigen::Dynamic, 1> d;
  if (V a = like(qp.b(), qp.size()); slant::diagonal_if_known(qp.a(), a)) {
    Eigen::Matrix<S, Eigen::Dynamic, 1> const entries = slant::local(a);
    auto const factors = block_factors(function_of(qp), entries);
    S least = detail::infinity<S>(), most(0);
    for (index i = 0; i < factors.size(); ++i) {
      if (!(entries(i) > S(0))) continue;
      least = std::min<S>(least, factors(i));
      most = std::max<S>(most, factors(i));
    }
    // Powers of two: bounds are met to the last bit.
    if (most > S(8) * least && is_finite(most)) {
      d = factors.unaryExpr([](S const& factor) { return unit_near(factor); });
    }
  }
  return d;
}

/// The result for x of one for y with x = D y.
template <class Result, class Scaled>
void unscale(Result& result, Scaled const& scaled) {
  result.point = scaled.back(std::move(result.point));
  if (result.status == status::unbounded) result.descent = scaled.back(std::move(result.descent));
  result.choice.insert(0, result.choice.empty() ? "" : "; ");
  result.choice.insert(0, "blocks scaled, because their stiffness differs by more than 64");
}

}  // namespace detail

/// Solves min ½xᵀA x − bᵀx over Λ, or + φ(x); see the top of this file. From x0: any point, such as
/// the solution of the problem before. Requires what symmetric_newton does. Throws bad_input for a
/// tolerance that is not in [0, 1), a limit < 0, a problem that the method refuses, or an x0 of
/// another size or with numbers that are not finite.
template <class QP>
  requires symmetric_newton_problem<QP>
[[nodiscard]] auto solve(QP const& qp, typename QP::vector_type const& x0,
                         typename QP::scalar tolerance, index max_steps = 5000) {
  using A = typename QP::operator_type;
  detail::check_limits(tolerance, max_steps);
  detail::check_start_in_set(x0, qp.b());
  if constexpr (detail::scales_blocks<QP>) {
    auto d = detail::block_factors_if_needed(qp);
    if (d.size() > 0) {
      equilibrated<QP const&> const scaled(qp, std::move(d));
      auto const alike = scaled.qp();
      auto const y0 = scaled.from(x0);
      auto result = [&] {
        if constexpr (detail::levels_precondition<QP>) {
          return detail::solve_sparse(alike, detail::matrix_behind<A>::of(qp.a()), scaled.d(), y0,
                                      tolerance, max_steps);
        } else {
          return detail::solve_by_parts(alike, y0, tolerance, max_steps);
        }
      }();
      detail::unscale(result, scaled);
      return result;
    }
  }
  return detail::solve_by_parts(qp, x0, tolerance, max_steps);
}
/// The same from 0.
template <class QP>
  requires symmetric_newton_problem<QP>
[[nodiscard]] auto solve(QP const& qp, typename QP::scalar tolerance, index max_steps = 5000) {
  return slant::solve(qp, detail::zero_of(qp), tolerance, max_steps);
}

/// The same with a preconditioner M ≈ A⁻¹, self-adjoint and semidefinite; blocks are not scaled.
template <class QP, class M>
  requires symmetric_newton_problem<QP> && preconditioner_for<M, QP>
[[nodiscard]] auto solve(QP const& qp, M const& m, typename QP::scalar tolerance,
                         index max_steps = 5000) {
  detail::check_limits(tolerance, max_steps);
  return detail::solve_certified(qp, m, detail::zero_of(qp), tolerance, max_steps,
                                 detail::levels_precondition<QP>);
}

/// A program that lacks something ends here and is told so by symmetric_newton; or was told before.
template <class QP>
  requires(!symmetric_newton_problem<QP>) && requires(QP const& qp) {
    typename QP::set_type;
    qp.a(), qp.b();
  }
auto solve(QP const&, typename QP::scalar, index = 0)
    -> certified_point<Eigen::VectorX<typename QP::scalar>> {
  if constexpr (!detail::was_refused<QP>) static_assert(sizeof(symmetric_newton<QP const&>) > 0);
  return {};
}

}  // namespace slant
