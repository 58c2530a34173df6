// SPDX-License-Identifier: MIT
//
// Options and results of contact::solve and contact::certified_coulomb.
#pragma once

#include <slant/base/report.hpp>
#include <slant/certificates/energy_error.hpp>
#include <slant/concepts/bad_input.hpp>
#include <slant/concepts/iterative_method.hpp>
#include <slant/contact/coulomb/coulomb_certificate.hpp>
#include <slant/contact/free_motions.hpp>
#include <slant/contact/node_layout.hpp>
#include <slant/contact/route.hpp>
#include <slant/factorizations/condensation_options.hpp>
#include <slant/iteration/stopping.hpp>
#include <slant/multilevel/multigrid.hpp>

#include <Eigen/Core>

#include <functional>
#include <optional>
#include <ostream>
#include <string>
#include <string_view>

namespace slant::contact {

/// Where a run of contact::solve is.
template <class S = double>
struct solve_step {
  index iteration;     ///< of Newton's method, from 0; anew for each route and problem with springs
  S reduced_gradient;  ///< relative to that at P_Λ(0); 0 if that is
};

/// Options of contact::solve.
template <class S = double>
struct solve_options {
  S tolerance = S(1e-8);   ///< relative error in the energy norm, in [0, 1); 0: as far as possible
  bool prove = false;      ///< prove the bound: one more factorisation of the size of K
  index max_steps = 5000;  ///< of each method that is tried
  bool scale = true;       ///< rows of B for equal stiffness; beyond 2^±64 they are in any case
  condensation_options condensation{};
  /// λ to start from, by factors of K; none: conjugate gradients without the constraints.
  std::optional<Eigen::VectorX<S>> start{};
  /// Where the unknowns are. Gives motions of bodies without supports their names, and multigrid the
  /// rigid-body modes. Without it K is factored first, unless `route` says otherwise: bodies without
  /// supports are not known as such then.
  node_layout<S> layout{};
  /// Factors of K, or multigrid and no factors.
  solution_route route = solution_route::automatic;
  multigrid_options multigrid{};
  route_costs costs = default_route_costs<S>();
  /// Called with every iterate, the start included; twice with one from which a correction goes on.
  /// Empty: nothing is called.
  std::function<void(solve_step<S> const&)> progress{};

  /// Throws bad_input naming the option, its value and what was expected.
  [[gnu::cold]] void validate() const {
    slant::detail::check_limits(tolerance, max_steps);
    multigrid.validate();
    condensation.validate();
  }
};

/// What contact::solve found.
template <class S = double>
struct solution {
  using vector_type = Eigen::VectorX<S>;

  vector_type u;            ///< displacements, n_u
  vector_type multipliers;  ///< (λ_ν, λ_t): forces of the contact nodes, in Λ
  slant::status status = slant::status::running;
  std::string reason;       ///< the status as a sentence
  energy_error<S> error{};  ///< what is known of ‖u − u*‖_K
  S condition{0};           ///< estimate of the condition number of K; 0: none, K was not factored
  index iterations = 0;     ///< steps of the method
  slant::work work{};       ///< applications of A, factorisations
  index solves = 0;         ///< solves with K
  index springs = 0;        ///< problems with springs that were solved for bodies without supports
  index corrections = 0;    ///< how often b was corrected
  bool scaled = false;      ///< whether rows of B were scaled
  std::string factorization;  ///< what factored K, and how; or the levels of multigrid
  route_choice choice{};      ///< which route was taken, and why
  free_motions<S>
      motions{};  ///< what K leaves free, or hardly holds; empty if supports hold all bodies
  vector_type descent{};  ///< where unbounded by a free motion: that motion

  [[nodiscard]] bool converged() const { return status == slant::status::converged; }
};

/// How well, how, and at what cost:
///
///     converged: relative energy error 2.1e-10, estimated, at most 1e-08
///       unknowns               41616
///       steps                  9
///       inner steps            20
///       applications of A      47
///       chosen                 iterated: factors are estimated at 1.9 s, multigrid at 0.3 s
template <class S>
std::ostream& operator<<(std::ostream& out, solution<S> const& run) {
  slant::detail::print_run(out, run.status, run.reason, index(run.u.size()),
                           std::to_string(run.iterations), run.work, run.choice.reason);
  return out;
}

// --- with Coulomb's law --------------------------------------------------------------------------

/// What certified_coulomb solves with.
enum class coulomb_method {
  automatic,  ///< Newton's method, radii where that fails, solve_friction where both do
  newton,     ///< of Alart and Curnier's residual
  radii,      ///< successive approximations, coulomb_radii
  cones       ///< successive approximations, coulomb_cones
};

/// Options of certified_coulomb.
template <class S = double>
struct certified_coulomb_options {
  double tolerance = 1e-8;  ///< of what the certificate finds, in [0, 1); 0: as far as possible
  coulomb_method method = coulomb_method::automatic;
  index newton_steps = 60;  ///< of Newton's method at most
  index outer_steps = 300;  ///< of successive approximations at most
  bool scale = true;        ///< as in solve_options
  /// Where the unknowns are: gives multigrid the rigid-body modes. Without it K is factored first,
  /// unless `route` says otherwise: bodies without supports are not known as such then.
  node_layout<S> layout{};
  /// Factors of K, or multigrid and no factors, which the method has to be `automatic` for.
  solution_route route = solution_route::automatic;
  multigrid_options multigrid{};
  route_costs costs = default_route_costs<S>();

  /// Throws bad_input naming the option, its value and what was expected.
  [[gnu::cold]] void validate() const {
    multigrid.validate();
    slant::detail::checked_tolerance(tolerance);
    slant::detail::check_option("newton_steps", newton_steps, newton_steps >= 1, "at least 1");
    slant::detail::check_option("outer_steps", outer_steps, outer_steps >= 1, "at least 1");
  }
};

/// What certified_coulomb found.
template <class V>
struct certified_coulomb_result {
  V λ;                                 ///< (λ_ν, λ_t)
  V u{};                               ///< displacements
  coulomb_error<scalar_t<V>> error{};  ///< of (λ, u)
  slant::status status = status::running;
  std::string reason{};  ///< the status as a sentence
  /// "Newton", "successive approximations", "solve_friction", "cones"; without factors "slip bounds
  /// and Newton", or "successive slip bounds" alone.
  std::string_view method{};
  index steps = 0;              ///< of that method; of slip bounds each of Tresca's problems is one
  slant::work work{};           ///< of all methods and the certificate
  scalar_t<V> condition{0};     ///< estimate of the condition number of K; 0: K was not factored
  bool scaled = false;          ///< whether rows of B were scaled
  std::string factorization{};  ///< what factored K; or the levels of multigrid
  route_choice choice{};        ///< which route was taken, and why

  [[nodiscard]] bool converged() const { return status == slant::status::converged; }
};

/// As a solution of contact::solve prints itself.
template <class V>
std::ostream& operator<<(std::ostream& out, certified_coulomb_result<V> const& run) {
  slant::detail::print_run(out, run.status, run.reason, index(run.u.size()),
                           std::to_string(run.steps) + " of " + std::string(run.method), run.work,
                           run.choice.reason);
  return out;
}

namespace detail {

/// Status and reason of a run that ended with an error that is known to be at most the tolerance,
/// or not, and then why.
template <class Result, class T>
void conclude(Result& r, bool is_enough, status how, T const& tolerance, std::string const& why) {
  using slant::detail::show;
  r.status = is_enough ? status::converged : how == status::converged ? status::stalled : how;
  r.reason = r.error.sentence() +
             (is_enough ? ", at most " + show(tolerance) : "; asked was " + show(tolerance) + why);
}

}  // namespace detail

}  // namespace slant::contact
