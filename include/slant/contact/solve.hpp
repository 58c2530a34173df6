// SPDX-License-Identifier: MIT
//
// Contact with Tresca friction from matrices to displacements, to an accuracy in the energy norm:
//
//     min ½ uᵀK u − fᵀu + Σ gᵢ‖(T u)ᵢ‖   subject to   N u ≤ d,       ‖u − u*‖_K ≤ tolerance ·
//     ‖u*‖_K
//
//     condense    K factored with the contact unknowns late factorizations/static_condensation
//     scale       rows of B so that every contact is about equally stiff, by powers of two; not at
//                 all where they are already
//     start       conjugate gradients without the constraints       methods/unconstrained_start
//     solve       symmetric_newton on the dual problem, with the lumped preconditioner
//     certify     ‖u − u*‖_K from K and the data alone              contact/certificate
//     correct     where the certificate asks for more: b is replaced by the one whose gradient, as
//     the
//                 method computes it, is the accurate one of the certificate; Newton's method goes
//                 on to a smaller reduced gradient (iterative refinement of the quadratic program)
//
// One certificate is all that a well-conditioned scene costs: one solve with K beyond that for u.
#pragma once

#include <slant/certificates/dual_norm.hpp>
#include <slant/contact/certificate.hpp>
#include <slant/contact/contact_unknowns.hpp>
#include <slant/contact/preconditioner.hpp>
#include <slant/contact/tresca.hpp>
#include <slant/factorizations/factorize.hpp>
#include <slant/factorizations/static_condensation.hpp>
#include <slant/iteration/solve.hpp>
#include <slant/iteration/stopping.hpp>
#include <slant/methods/symmetric_newton.hpp>
#include <slant/methods/unconstrained_start.hpp>

#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <utility>

namespace slant::contact {

/// Options of contact::solve.
template <class S = double>
struct solve_options {
  S tolerance = S(1e-8);   ///< relative error in the energy norm, in [0, 1); 0: as far as possible
  bool prove = false;      ///< prove the bound: one more factorisation of the size of K
  index max_steps = 5000;  ///< of Newton's method, and of its fallback, in all
  bool scale = true;       ///< whether rows of B may be scaled
  condensation_options condensation{};
  /// λ to start from; none: conjugate gradients without the constraints.
  std::optional<Eigen::Matrix<S, Eigen::Dynamic, 1>> start{};

  /// Throws bad_input naming the option, its value and what was expected.
  void validate() const {
    slant::detail::checked_tolerance(tolerance);
    if (max_steps < 0) throw bad_input("max_steps", slant::detail::show(max_steps), "at least 0");
    condensation.validate();
  }
};

/// What contact::solve found.
template <class S = double>
struct solution {
  using vector_type = Eigen::Matrix<S, Eigen::Dynamic, 1>;

  vector_type u;            ///< displacements, n_u
  vector_type multipliers;  ///< (λ_ν, λ_t): forces of the contact nodes, in Λ
  slant::status status = slant::status::running;
  std::string reason;         ///< the status as a sentence
  energy_error<S> error{};    ///< what is known of ‖u − u*‖_K
  S condition{0};             ///< estimate of the condition number of K
  index iterations = 0;       ///< steps of the method
  slant::work work{};         ///< applications of A, factorisations
  index solves = 0;           ///< solves with K
  index corrections = 0;      ///< how often b was corrected
  bool scaled = false;        ///< whether rows of B were scaled
  std::string factorization;  ///< what factored K, and how

  [[nodiscard]] bool converged() const { return status == slant::status::converged; }
};

namespace detail {

/// One factor for each row of B, a power of two, the same for the tangents of a node: 2ᵏ ≈ √mᵢ, so
/// that D A D has a diagonal of the order 1. Empty if the stiffnesses m are alike within `spread`.
template <class S>
[[nodiscard]] Eigen::Matrix<S, Eigen::Dynamic, 1> row_factors(
    Eigen::Matrix<S, Eigen::Dynamic, 1> const& m, index nodes, index tangents, S const& spread) {
  using std::sqrt;
  Eigen::Matrix<S, Eigen::Dynamic, 1> d(m.size());
  S least = std::numeric_limits<S>::infinity(), most(0);
  auto const assign = [&](index first, index count) {
    S sum(0);
    for (index j = 0; j < count; ++j) sum += m(first + j);
    bool const acts = sum > S(0) && slant::detail::is_finite(sum);
    S const mean = acts ? S(sum / S(count)) : S(0);
    if (acts) {
      least = std::min<S>(least, mean);
      most = std::max<S>(most, mean);
    }
    for (index j = 0; j < count; ++j) d(first + j) = acts ? unit_near(S(sqrt(mean))) : S(0);
  };
  for (index i = 0; i < nodes; ++i) assign(i, 1);
  for (index i = 0; i < nodes && tangents > 0; ++i) assign(nodes + i * tangents, tangents);
  if (!(most > spread * least)) return {};
  for (S& factor : d) {
    if (factor == S(0)) factor = S(1);  // an empty row, of which nothing is asked
  }
  return d;
}

/// Newton's method on the scaled dual problem, under the control of the certificate.
template <class Friction, class S>
class certified_run {
 public:
  using vector_type = Eigen::Matrix<S, Eigen::Dynamic, 1>;
  using sparse_type = Eigen::SparseMatrix<S>;

  certified_run(Friction friction, sparse_type const& K, data<S> const& c,
                solve_options<S> const& o)
      : options_(o),
        data_(&c),
        factor_(K, contact_unknowns(c), o.condensation),
        dual_(friction, factor_, c),
        certificate_(K, c),
        b_(dual_.b()),
        C_(dual_.constraints()) {
    auto const d = o.scale
                       ? row_factors<S>(certificate_.stiffness(), c.nodes(), c.tangents(), S(64))
                       : vector_type();
    result_.scaled = d.size() > 0;
    d_ = result_.scaled ? d : vector_type::Ones(b_.size());
    b_ = b_.cwiseProduct(d_);
    g_ = c.g;
    if (c.tangents() > 0) {
      for (index i = 0; i < c.nodes(); ++i) g_(i) /= d_(c.nodes() + i * c.tangents());
    }
    if (result_.scaled) C_ = sparse_type(d_.asDiagonal() * C_);
    if (o.prove) {
      certificate_.prove(solver(factor_), [&](sparse_type const& matrix) {
        ++result_.work.factorizations;
        static_cast<void>(factorize(matrix));
      });
    }
  }
  certified_run(certified_run const&) = delete;
  certified_run& operator=(certified_run const&) = delete;

  template <class... Observers>
  [[nodiscard]] solution<S> run(Observers&... observers) {
    auto const set = feasible_set(Friction{}, data_->nodes(), g_);
    separable_qp const qp{dual_.a(C_), b_, set};
    auto const M = lumped_preconditioner(certificate_matrix(), C_);
    vector_type const x0 = start(qp, M);
    // The reduced gradient is some 3 to 10 times smaller than the error that goes with it.
    S threshold = S(0.06) * options_.tolerance;
    index budget = options_.max_steps;
    auto const method = [&] {
      symmetric_newton_options<S> o;
      o.forcing.goal = static_cast<double>(threshold);
      return symmetric_newton{qp, M, o};
    };
    auto state = method().start(x0);
    image_.resize(b_.size());
    S best = std::numeric_limits<S>::infinity();
    auto wa = workspace(qp.a(), state.x);
    dual_norm_workspace norm_workspace(M, state.x);
    while (true) {
      auto newton = method();
      auto stop = reduced_gradient_below(threshold) || at_most(budget);
      auto end = slant::detail::run_to_end(newton, state, stop, observers...);
      // A later phase that takes longer than all before it is at its floor.
      bool const is_later = budget < options_.max_steps;
      if (is_later && end.how == status::iteration_limit) end.how = status::stalled;
      bool const can_go_on = end.how == status::converged || end.how == status::stalled;
      certify(qp, M, state.x, wa, norm_workspace, !can_go_on);
      S error = result_.error.relative();
      bool const progresses = error < best / S(2) || end.how == status::converged;
      bool const goes_on = can_go_on && progresses && result_.corrections < 20;
      if (error > options_.tolerance && !goes_on) {
        certify(qp, M, state.x, wa, norm_workspace, true);
        error = result_.error.relative();
      }
      bool const is_enough = error <= options_.tolerance && end.how != status::unbounded;
      if (is_enough || !goes_on) {
        finish(end, is_enough);
        break;
      }
      budget = std::min<index>(options_.max_steps, 4 * state.iteration + 100);
      best = std::min<S>(best, error);
      // The gradient as the method computes it becomes that of the certificate.
      slant::apply(qp.a(), state.x, image_, wa);
      ++state.work.operator_applications;
      b_ = image_ - d_.cwiseProduct(certificate_.gradient());
      ++result_.corrections;
      S const ask = S(0.3) * options_.tolerance / error;
      S const reached = state.gradient_scale > S(0)
                            ? S(state.reduced_gradient_norm / state.gradient_scale)
                            : S(0);
      S const factor = ask < S(1e-3) || !(ask == ask) ? S(1e-3) : ask < S(0.3) ? ask : S(0.3);
      threshold = std::min<S>(threshold, reached) * factor;
      newton.resume(state);
    }
    result_.iterations = state.iteration;
    result_.work.operator_applications += state.work.operator_applications;
    result_.work.setup_applications += state.work.setup_applications;
    result_.work.inner_iterations += state.work.inner_iterations;
    ++result_.work.factorizations;
    result_.solves += certificate_.solves();
    result_.condition = certificate_.condition();
    result_.factorization = std::string(factor_.name());
    return std::move(result_);
  }

 private:
  sparse_type const& certificate_matrix() const { return certificate_.matrix(); }

  template <class QP, class M>
  [[nodiscard]] vector_type start(QP const& qp, M const& m) {
    if (options_.start) {
      slant::detail::check_size("start", options_.start->size(), b_.size());
      slant::detail::check_finite("start", *options_.start);
      return options_.start->cwiseQuotient(d_);
    }
    if (options_.max_steps == 0) return vector_type::Zero(b_.size());
    auto found = unconstrained_start(qp, m);
    result_.work.setup_applications += found.applications;
    return std::move(found.x);
  }

  /// The error at x, u and λ with it.
  template <class QP, class M, class W>
  void certify(QP const& qp, M const& m, vector_type const& x, W& wa,
               dual_norm_workspace<vector_type, M>& norm_workspace, bool is_last) {
    result_.multipliers = d_.cwiseProduct(x);
    result_.u = dual_.displacement(result_.multipliers);
    ++result_.solves;
    auto const sharper = [&](vector_type const& rest, S const& by_zero) {
      // The extension by zero is rarely off by more than 30, and this is not the last word.
      if (!is_last && by_zero > S(64) * options_.tolerance) return S(-1);
      vector_type const scaled = rest.cwiseProduct(d_);
      auto const norm = dual_norm(qp.a(), m, scaled, 12, true, wa, norm_workspace);
      result_.work.operator_applications += norm.applications;
      return norm.value;
    };
    result_.error = certificate_(dual_.set(), result_.multipliers, result_.u, options_.tolerance,
                                 solver(factor_), sharper);
  }

  void finish(slant::detail::ending& end, bool is_enough) {
    auto const known = result_.error.sentence();
    if (is_enough) {
      result_.status = status::converged;
      result_.reason = known + ", at most " + slant::detail::show(options_.tolerance);
      return;
    }
    result_.status = end.how == status::converged ? status::stalled : end.how;
    if (result_.status == status::stalled) {
      result_.reason = known + ": rounding errors allow no more (condition of K about " +
                       slant::detail::show(certificate_.condition()) + ")";
    } else if (result_.status == status::unbounded) {
      result_.reason =
          "no u satisfies the constraints, so that the contact forces grow without bound";
    } else {
      result_.reason = end.why + "; " + known;
    }
  }

  solve_options<S> options_;
  data<S> const* data_;
  static_condensation<S> factor_;
  dual<Friction, static_condensation<S> const&, S> dual_;
  certificate<S> certificate_;
  vector_type b_;
  sparse_type C_;
  vector_type d_{}, g_{}, image_{};
  solution<S> result_{};
};

}  // namespace detail

/// Solves with this friction law, which the data must have: no other one is compiled. Observers see
/// every state of symmetric_newton. Throws bad_input if K is not symmetric positive definite, for
/// data that do not fit, or for options out of range.
template <class Friction, class S, class... Observers>
[[nodiscard]] solution<S> solve(Friction friction, Eigen::SparseMatrix<S> const& K,
                                data<S> const& c, solve_options<S> const& o = {},
                                Observers&&... observers) {
  o.validate();
  detail::validated(friction, c, K.rows());
  return detail::certified_run<Friction, S>(friction, K, c, o).run(observers...);
}

/// The same with the law that T stands for.
template <class S, class... Observers>
[[nodiscard]] solution<S> solve(Eigen::SparseMatrix<S> const& K, data<S> const& c,
                                solve_options<S> const& o = {}, Observers&&... observers) {
  c.validate();
  switch (c.tangents()) {
    case 0:
      return solve(frictionless{}, K, c, o, observers...);
    case 1:
      return solve(friction_line{}, K, c, o, observers...);
    default:
      return solve(friction_disc{}, K, c, o, observers...);
  }
}

}  // namespace slant::contact
