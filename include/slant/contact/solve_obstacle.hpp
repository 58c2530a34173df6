// SPDX-License-Identifier: MIT
//
// Contact without friction in one call, by whichever route is faster:
//
//     auto s = slant::contact::solve_obstacle(K, f, N, d);
//     if (s.converged()) use(s.u, s.λ);
//
//     minimise  ½ uᵀKu − fᵀu   over   N u ≤ d
#pragma once

#include <slant/contact/obstacle.hpp>
#include <slant/contact/obstacle_route.hpp>
#include <slant/contact/preconditioner.hpp>
#include <slant/contact/tresca.hpp>
#include <slant/iteration/solve.hpp>
#include <slant/methods/symmetric_newton.hpp>
#include <slant/multilevel/multigrid.hpp>

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include <string>
#include <type_traits>
#include <utility>

namespace slant::contact {

/// Options of solve_obstacle.
template <class S = double>
struct obstacle_options {
  obstacle_route route = obstacle_route::automatic;
  S tolerance = S(1e-10);  ///< of the reduced gradient, relative to that of P(0); of u or of λ
  index steps = 200;       ///< Newton steps at most
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
  route_choice choice;                            ///< which route was taken, and why
  index steps = 0;                                ///< Newton steps
  slant::work work{};  ///< inner_iterations: cycles, or applications of K⁻¹ in inner systems

  [[nodiscard]] bool converged() const { return status == slant::status::converged; }
};

namespace detail {

/// The run itself; what is known after it except u and λ goes to the solution.
template <class S, class QP, class M>
[[nodiscard]] auto solve_bounded(QP const& qp, M const& m, obstacle_options<S> const& o,
                                 obstacle_solution<S>& s) {
  symmetric_newton_options<S> newton;
  newton.forcing.goal = static_cast<double>(o.tolerance);
  Eigen::Matrix<S, Eigen::Dynamic, 1> const zero =
      Eigen::Matrix<S, Eigen::Dynamic, 1>::Zero(qp.size());
  auto run = slant::solve(symmetric_newton{qp, m, newton}, zero,
                          reduced_gradient_below(o.tolerance) || at_most(o.steps));
  s.status = run.status;
  s.reason = std::move(run.reason);
  s.steps = run.state.iteration;
  s.work = run.state.work;
  return std::move(run.state.x);
}

}  // namespace detail

/// Solves the problem at the top of this file: K (n × n, both triangles, definite), f (n), N (m ×
/// n), d (m, +∞ where nothing is met). Throws bad_input for data that do not fit, for a K that is
/// found not to be definite, and where N cannot be had by the route that is asked for; with a K
/// that is not definite without being found out any status may be the end.
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
  if (s.choice.route == obstacle_route::iterate) {
    obstacle<S> const problem(K, c);
    auto modes = o.near_kernel;
    if (modes.cols() > 0) modes = problem.coordinates(modes);
    slant::multigrid<S> const m(problem.matrix(), std::move(modes), o.multigrid);
    auto const v = detail::solve_bounded(problem.qp(), m, o, s);
    s.u = problem.displacement(v);
    s.λ = problem.multipliers(v);
  } else {
    auto const factors = slant::factorize(K);
    dual const problem(frictionless{}, factors, c);
    auto const m = lumped_preconditioner(K, N);
    s.λ = detail::solve_bounded(problem.qp(), m, o, s);
    s.u = problem.displacement(s.λ);
    s.work.factorizations = 1;
  }
  return s;
}

}  // namespace slant::contact
