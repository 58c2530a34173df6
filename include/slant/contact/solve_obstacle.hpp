// SPDX-License-Identifier: MIT
//
// Contact without friction in one call, by whichever route is faster:
//
//     auto s = slant::contact::solve_obstacle(K, f, N, d);
//     if (s.converged()) use(s.u, s.λ);
//
//     minimise  ½ uᵀKu − fᵀu   over   N u ≤ d
//
// The method stops by its reduced gradient, relative to that of P(0). Of the dual problem, and of
// bodies that nearly move rigidly, that is no measure of the error: b = N K⁻¹f − d is as large as
// the motion that the contact prevents. So what has converged is judged by check_optimality, from
// K, f, N, d, u and λ alone. Where the check contradicts, the method goes on with a tolerance that
// is smaller by as much, as long as this helps; where it does not, the precision is exhausted.
#pragma once

#include <slant/compiled.hpp>
#include <slant/concepts/bad_input.hpp>
#include <slant/contact/dual.hpp>
#include <slant/contact/obstacle.hpp>
#include <slant/contact/optimality.hpp>
#include <slant/contact/preconditioners.hpp>
#include <slant/contact/route.hpp>
#include <slant/factorizations/factorize.hpp>
#include <slant/iteration/solve.hpp>
#include <slant/methods/symmetric_newton.hpp>
#include <slant/multilevel/multigrid.hpp>

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include <algorithm>
#include <string>
#include <type_traits>
#include <utility>

namespace slant::contact {

// --- route ---------------------------------------------------------------------------------------

/// Which route to take for K (n × n, both triangles) and N (m × n), as choose_route of route.hpp.
/// Rows of N that are no bounds in any coordinates leave only `factor`.
template <class S>
[[nodiscard]] route_choice choose_route(Eigen::SparseMatrix<S> const& K,
                                        Eigen::SparseMatrix<S> const& N,
                                        solution_route wanted = solution_route::automatic,
                                        route_costs const& cost = default_route_costs<S>()) {
  return choose_route(K, detail::shared_unknown(N), wanted, cost);
}

// --- solve obstacle ------------------------------------------------------------------------------

/// Options of solve_obstacle.
template <class S = double>
struct obstacle_options {
  solution_route route = solution_route::automatic;
  /// Of the reduced gradient, relative to that of P(0), of u or of λ; and a hundredth of what
  /// check_optimality may find at the end.
  S tolerance = S(1e-10);
  index steps = 200;  ///< Newton steps at most
  /// Candidates of the near kernel of K, n × r, for multigrid: rigid_body_modes(nodes) of a body.
  /// Empty: constants, which is right for membranes; in elasticity it takes twice the cycles, which
  /// are cheaper, and about the same time.
  Eigen::Matrix<S, Eigen::Dynamic, Eigen::Dynamic> near_kernel{};
  multigrid_options multigrid{};
  route_costs costs = default_route_costs<S>();
};

/// Result of solve_obstacle.
template <class S>
struct obstacle_solution {
  Eigen::Matrix<S, Eigen::Dynamic, 1> u;  ///< displacements, n
  Eigen::Matrix<S, Eigen::Dynamic, 1> λ;  ///< contact forces, one per row of N; f − K u = Nᵀλ
  slant::status status = slant::status::running;  ///< of the method
  std::string reason;                             ///< the same as a sentence
  S kkt_residual = S(0);                          ///< check_optimality(K, data, u, λ).residual()
  route_choice choice;                            ///< which route was taken, and why
  index steps = 0;                                ///< Newton steps
  slant::work work{};  ///< inner_iterations: cycles, or applications of K⁻¹ in inner systems

  [[nodiscard]] bool converged() const { return status == slant::status::converged; }
};

namespace detail {

template <class S>
using obstacle_vector = Eigen::Matrix<S, Eigen::Dynamic, 1>;

/// The run itself: u, λ and all that is known of them go to the solution. back(x) → puts u and λ
/// of the iterate x there.
template <class S, class QP, class M, class Back>
void solve_bounded(QP const& qp, M const& m, Eigen::SparseMatrix<S> const& K, data<S> const& c,
                   obstacle_options<S> const& o, obstacle_solution<S>& s, Back const& back) {
  using slant::detail::show;
  constexpr index rounds = 8;  // the tolerance falls by orders of magnitude from one to the next
  S const allowed = S(100) * o.tolerance;
  obstacle_vector<S> x = obstacle_vector<S>::Zero(qp.size());
  S asked = o.tolerance, before(0);
  for (index round = 0;; ++round) {
    symmetric_newton_options<S> newton;
    newton.forcing.goal = static_cast<double>(asked);
    auto run = slant::solve(symmetric_newton{qp, m, newton}, x,
                            reduced_gradient_below(asked) || at_most(o.steps - s.steps));
    s.steps += run.state.iteration;
    s.work.operator_applications += run.state.work.operator_applications;
    s.work.setup_applications += run.state.work.setup_applications;
    s.work.inner_iterations += run.state.work.inner_iterations;
    s.status = run.status;
    s.reason = std::move(run.reason);
    x = std::move(run.state.x);
    back(x);
    s.kkt_residual = c.f.size() == 0 ? S(0) : check_optimality(K, c, s.u, s.λ).residual();
    bool const holds = s.kkt_residual <= allowed;
    if (round == 0 && !s.converged()) return;
    if (holds) {  // also where the smaller tolerance of this round was out of reach
      s.status = status::converged;
      s.reason += "; check_optimality finds " + show(s.kkt_residual);
      return;
    }
    bool const helps = round == 0 || s.kkt_residual <= S(0.5) * before;
    if (!s.converged() || !helps || round == rounds || s.steps >= o.steps) {
      if (s.converged()) s.status = status::stalled;
      s.reason = "check_optimality finds " + show(s.kkt_residual) + ", more than " + show(allowed) +
                 "; " + s.reason;
      return;
    }
    before = s.kkt_residual;
    asked *= S(0.5) * std::max(std::numeric_limits<S>::epsilon(), S(allowed / s.kkt_residual));
  }
}

/// Never factors K.
template <class S>
void iterate(Eigen::SparseMatrix<S> const& K, data<S> const& c, obstacle_options<S> const& o,
             obstacle_solution<S>& s) {
  obstacle<S> const problem(K, c);
  auto modes = o.near_kernel;
  if (modes.cols() > 0) modes = problem.coordinates(modes);
  slant::multigrid<S> const m(problem.matrix(), std::move(modes), o.multigrid);
  detail::solve_bounded(problem.qp(), m, K, c, o, s, [&](obstacle_vector<S> const& v) {
    s.u = problem.displacement(v);
    s.λ = problem.multipliers(v);
  });
}

/// By factors of K and the dual problem.
template <class S>
void factor_and_solve(Eigen::SparseMatrix<S> const& K, data<S> const& c,
                      obstacle_options<S> const& o, obstacle_solution<S>& s) {
  auto const factors = slant::factorize(K);
  dual const problem(frictionless{}, factors, c);
  auto const m = lumped_preconditioner(K, c.N);
  detail::solve_bounded(problem.qp(), m, K, c, o, s, [&](obstacle_vector<S> const& λ) {
    s.λ = λ;
    s.u = problem.displacement(λ);
  });
  s.work.factorizations += 1;
}

}  // namespace detail

/// Solves the problem at the top of this file: K (n × n, both triangles, definite), f (n), N (m ×
/// n), d (m, +∞ where nothing is met). Throws bad_input for data that do not fit, for a K that is
/// found not to be definite, and where N cannot be had by the route that is asked for; with a K
/// that is not definite without being found out any status may be the end. `converged` is what
/// check_optimality does not contradict; `stalled` names what it finds instead. If the route is
/// left to the cost model and iterating does not converge, K is factored after all.
template <class S>
[[nodiscard]] obstacle_solution<S> solve_obstacle(
    Eigen::SparseMatrix<S> const& K,
    std::type_identity_t<Eigen::Matrix<S, Eigen::Dynamic, 1>> const& f,
    Eigen::SparseMatrix<S> const& N,
    std::type_identity_t<Eigen::Matrix<S, Eigen::Dynamic, 1>> const& d,
    std::type_identity_t<obstacle_options<S>> const& o = {}) {
  data<S> const c{N, Eigen::SparseMatrix<S>(0, f.size()), f, d, {}};
  c.validate();
  slant::detail::check_size("rows of K", K.rows(), f.size(), "the size of f,");
  slant::detail::check_size("columns of K", K.cols(), f.size(), "the size of f,");
  if (o.near_kernel.cols() > 0) {
    slant::detail::check_size("rows of near_kernel", o.near_kernel.rows(), f.size(),
                              "the size of f,");
  }
  obstacle_solution<S> s;
  s.choice = choose_route(K, N, o.route, o.costs);
  if (s.choice.route == solution_route::iterate) {
    detail::iterate(K, c, o, s);
    if (s.converged() || o.route == solution_route::iterate) return s;
    s.choice.route = solution_route::factor;
    s.choice.reason += "; factored after all, because that ended " +
                       std::string(to_string(s.status)) + ": " + s.reason;
    s.steps = 0;
  }
  detail::factor_and_solve(K, c, o, s);
  return s;
}

#if SLANT_USES_COMPILED
extern template obstacle_solution<double> solve_obstacle<double>(Eigen::SparseMatrix<double> const&,
                                                                 Eigen::VectorXd const&,
                                                                 Eigen::SparseMatrix<double> const&,
                                                                 Eigen::VectorXd const&,
                                                                 obstacle_options<double> const&);
#endif

}  // namespace slant::contact
