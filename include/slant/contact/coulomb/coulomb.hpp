// SPDX-License-Identifier: MIT
//
// Contact with Coulomb friction, ‖λ_t,i‖ ≤ Fᵢ λ_ν,i, by successive approximations over Newton's
// method:
//
//     contact::dual problem(contact::friction_disc{}, factor, data);
//     contact::coulomb_radii family(problem, contact::coefficients(F));
//     auto const M = contact::lumped_preconditioner(K, problem.constraints());
//     auto const r = slant::solve(contact::coulomb(family, M, {.goal = 1e-8}), problem.zero(),
//                                 slant::reduced_gradient_below(1e-8) || slant::at_most(100));
//     auto const u = problem.displacement(r.x());
//
// With the goal the last problem is not solved better than that. Relative to ‖b‖ any forces of a
// body that nearly moves rigidly are a solution (a brick 300 × 1 × 1: pressure and friction off by
// 1e-3, a thin one: by all): contact::certified_coulomb goes on where a certificate says so.
//
// Families: coulomb_radii (the slip bounds of Tresca's problem are F λ_ν; any coefficients of
// friction_law.hpp), coulomb_cones (cones, with shifts μ‖u_t‖; multipliers contact by
// contact). With contact::load_stepper it goes through a sequence of load steps:
//
//     contact::load_stepper stepper(family, contact::coulomb(family, M, {.goal = 1e-8}), stop);
//     auto const& step = stepper.advance({.f = f, .w = w});      // w: T u of the step before
#pragma once

#include <slant/contact/dual.hpp>
#include <slant/contact/friction_law.hpp>
#include <slant/contact/load_stepper.hpp>
#include <slant/krylov/spectrum.hpp>
#include <slant/methods/successive_approximations.hpp>
#include <slant/methods/symmetric_newton.hpp>
#include <slant/newton/forcing.hpp>
#include <slant/newton/krylov_solvers.hpp>
#include <slant/newton/semismooth_newton.hpp>
#include <slant/operators/identity.hpp>
#include <slant/problems/separable_qp.hpp>
#include <slant/sets/cartesian.hpp>
#include <slant/sets/contact_sets.hpp>
#include <slant/sets/ellipse.hpp>
#include <slant/sets/power.hpp>
#include <slant/sets/second_order_cone.hpp>
#include <slant/slanting/affine.hpp>
#include <slant/slanting/arithmetic.hpp>
#include <slant/slanting/coulomb_law.hpp>
#include <slant/slanting/projection.hpp>

#include <Eigen/SparseCore>

#include <algorithm>
#include <limits>
#include <type_traits>
#include <utility>

namespace slant::contact {

// --- coulomb radii -------------------------------------------------------------------------------
//
// Coulomb's law as a family of Tresca's problems [K (22); Haslinger 1983]: with the slip bounds g
// as parameters of
//
//     min ½ λᵀAλ − bᵀλ   over   λ_ν ≥ 0,  ‖λ_t,i‖ ≤ gᵢ,            P(λ) = F λ_ν,
//
// a fixed point g = F λ_ν(g) is a solution of contact with Coulomb friction. For orthotropic
// friction the discs are ellipses with the semi-axes F¹gᵢ, F²gᵢ, and P(λ) = λ_ν.

namespace detail {

/// Tangential sets of m contacts that let nothing slip.
template <bool Orthotropic, index Tangents, class V>
[[nodiscard]] auto sticking_sets(index m) {
  V const g = V::Constant(m, std::numeric_limits<scalar_t<V>>::infinity());
  if constexpr (Orthotropic) {
    return power(ellipse<scalar_t<V>>{}, g, g);
  } else if constexpr (Tangents == 1) {
    return intervals(g);
  } else {
    return discs(g);
  }
}

}  // namespace detail

/// The family at the top of this section, for methods/successive_approximations.hpp. Refers to the
/// dual problem, whose own slip bounds have no meaning here; not movable.
///
///     contact::coulomb_radii family(problem, contact::coefficients(F));
///
/// Before the first parameters every contact sticks, so that unconstrained_start(family.qp(), M)
/// keeps the tangential forces.
template <class Dual, class Coefficient>
class coulomb_radii {
 public:
  using vector_type = typename Dual::vector_type;
  using scalar = scalar_t<vector_type>;
  static constexpr bool orthotropic =
      std::is_same_v<Coefficient, orthotropic_friction<vector_type>>;
  static constexpr index tangents = static_tangents<typename Dual::friction_type>;
  static_assert(tangents > 0,
                "coulomb_radii: the dual problem must have the law friction_line or friction_disc");
  static_assert(!(orthotropic && tangents == 1),
                "coulomb_radii: orthotropic friction needs two tangents");

  /// Throws bad_input unless there is a coefficient for every contact node.
  coulomb_radii(Dual& problem, Coefficient F)
      : problem_(&problem),
        F_(detail::one_per_contact(std::move(F), problem.b().size() / (tangents + 1))),
        sets_(detail::sticking_sets<orthotropic, tangents, vector_type>(F_.size())),
        set_(half_lines<scalar>(F_.size()), sets_),
        qp_(problem.a(), problem.b(), set_) {}
  coulomb_radii(coulomb_radii const&) = delete;
  coulomb_radii& operator=(coulomb_radii const&) = delete;

  /// Tresca's problem for the present slip bounds.
  [[nodiscard]] auto const& qp() const { return qp_; }
  /// As of the dual problem.
  [[nodiscard]] vector_type const& b() const { return problem_->b(); }
  [[nodiscard]] auto const& set() const { return set_; }
  [[nodiscard]] vector_type zero() const { return problem_->zero(); }
  /// New data, as dual::update; slip bounds among them are without effect.
  void update(load_step<scalar> step) { problem_->update(std::move(step)); }

  [[nodiscard]] index parameter_count() const { return F_.size(); }
  /// F λ_ν, for no slip.
  void guess(vector_type const& λ, vector_type& g) const {
    for (index i = 0; i < F_.size(); ++i) g(i) = bound(i, λ(i), scalar(0));
  }
  /// F λ_ν, for the slip that the gradient r tells: r_t = −T u.
  void parameters(vector_type const& λ, vector_type const& r, vector_type& g) const {
    index const m = F_.size();
    for (index i = 0; i < m; ++i) {
      g(i) = bound(i, λ(i), norm(r.template segment<tangents>(m + tangents * i)));
    }
  }
  /// The slip bounds of qp(); a negative one becomes 0. Those too large to be added up are ∞ in
  /// qp(), but stay finite in g, which is calculated with.
  void assign(vector_type& g) {
    for (scalar& bound : g) bound = bound > scalar(0) ? std::min<scalar>(bound, most()) : scalar(0);
    if constexpr (orthotropic) {
      first_ = F_.first().cwiseProduct(g);
      second_ = F_.second().cwiseProduct(g);
      sets_.update(first_, second_);
    } else {
      bounds_ = g;
      for (scalar& bound : bounds_) {
        if (!(bound < most())) bound = std::numeric_limits<scalar>::infinity();
      }
      sets_.update(bounds_);
    }
  }

 private:
  [[nodiscard]] scalar bound(index i, scalar const& pressure, scalar const& slip) const {
    if (!(pressure > scalar(0))) return scalar(0);
    if constexpr (orthotropic) {
      return pressure;
    } else {
      return std::min<scalar>(F_(i, slip) * pressure, most());
    }
  }
  /// The largest bound: sums and norms of as many as there are do not overflow.
  [[nodiscard]] scalar most() const {
    return std::numeric_limits<scalar>::max() / scalar(8 * (F_.size() + 1));
  }

  using sets_type = decltype(detail::sticking_sets<orthotropic, tangents, vector_type>(index(0)));
  using set_type = cartesian_product<decltype(half_lines<scalar>(index(0))), sets_type const&>;
  using qp_type =
      separable_qp<decltype(std::declval<Dual const&>().a()), vector_type const&, set_type const&>;

  Dual* problem_;
  Coefficient F_;
  sets_type sets_;
  set_type set_;
  qp_type qp_;
  vector_type bounds_{};            // of the discs
  vector_type first_{}, second_{};  // semi-axes
};

// --- coulomb cones -------------------------------------------------------------------------------
//
// Coulomb's law as a family of convex problems over cones [Acary, Cadoux, Lemaréchal, Malick 2011]:
// with the shifts s as parameters of
//
//     min ½ λᵀAλ − (b − s)ᵀλ   over   ‖λ_t,i‖ ≤ μᵢ λ_ν,i,           P(λ) = μ‖u_t‖,
//
// s acting on the normal components. The gradient A λ − b is u in local coordinates, its normal
// part the gap and its tangential part the slip with the opposite sign, so that a fixed point has
// u + μ‖u_t‖ n ∈ K_μ*: de Saxcé's form of Coulomb's law, see contact/friction/friction_problem.hpp.
//
// Multipliers are ordered contact by contact here, [ν, t₁(, t₂)].

/// The family at the top of this section, for methods/successive_approximations.hpp. Refers to the
/// dual problem, whose slip bounds have no meaning here; not movable.
template <class Dual>
class coulomb_cones {
 public:
  using vector_type = typename Dual::vector_type;
  using scalar = scalar_t<vector_type>;
  using sparse_type = typename Dual::sparse_type;
  /// Components of a contact.
  static constexpr int dimension = 1 + int(static_tangents<typename Dual::friction_type>);
  static_assert(dimension > 1,
                "coulomb_cones: the dual problem must have the law friction_line or friction_disc");

  /// Throws bad_input unless there is a coefficient for every contact node, finite and >= 0.
  coulomb_cones(Dual& problem, vector_type μ)
      : problem_(&problem),
        μ_(detail::one_per_contact(std::move(μ), problem.b().size() / dimension)),
        shift_(vector_type::Zero(μ_.size())),
        P_(order_of(μ_.size())),
        C_(P_ * problem.constraints()),
        q_(-by_contacts(problem.b())),
        b_(-q_),
        set_(power(second_order_cone<dimension, scalar>{}, μ_)),
        qp_(problem.a(C_), b_, set_) {}
  coulomb_cones(coulomb_cones const&) = delete;
  coulomb_cones& operator=(coulomb_cones const&) = delete;

  /// The convex problem for the present shifts.
  [[nodiscard]] auto const& qp() const { return qp_; }
  /// B with its rows contact by contact, for preconditioners.
  [[nodiscard]] sparse_type const& constraints() const { return C_; }
  [[nodiscard]] vector_type const& mu() const { return μ_; }
  /// What u = A λ + q is without forces, no shift in it: −b contact by contact; changes in place.
  [[nodiscard]] vector_type const& q() const { return q_; }
  [[nodiscard]] vector_type const& b() const { return b_; }
  [[nodiscard]] auto const& set() const { return set_; }
  [[nodiscard]] vector_type zero() const { return problem_->zero(); }

  /// λ = (λ_ν, λ_t) of the dual problem, contact by contact.
  [[nodiscard]] vector_type by_contacts(vector_type const& λ) const { return P_ * λ; }
  /// And back.
  [[nodiscard]] vector_type by_directions(vector_type const& x) const { return P_.transpose() * x; }

  /// New data, as dual::update; slip bounds among them are without effect.
  void update(load_step<scalar> step) {
    problem_->update(std::move(step));
    q_ = -by_contacts(problem_->b());
    assign(shift_);
  }

  [[nodiscard]] index parameter_count() const { return μ_.size(); }
  /// The present shifts; 0 before there are any.
  void guess(vector_type const&, vector_type& s) const { s = shift_; }
  /// μ‖u_t‖ of the gradient r of qp().
  void parameters(vector_type const&, vector_type const& r, vector_type& s) const {
    for (index i = 0; i < μ_.size(); ++i) {
      s(i) = μ_(i) * norm(r.template segment<dimension - 1>(dimension * i + 1));
    }
  }
  /// The shifts of qp(); a negative one becomes 0.
  void assign(vector_type& s) {
    for (index i = 0; i < μ_.size(); ++i) {
      if (!(s(i) > scalar(0))) s(i) = scalar(0);
      b_(dimension * i) = -q_(dimension * i) - s(i);
      b_.template segment<dimension - 1>(dimension * i + 1) =
          -q_.template segment<dimension - 1>(dimension * i + 1);
    }
    if (&s != &shift_) shift_ = s;
  }

 private:
  using permutation = Eigen::PermutationMatrix<Eigen::Dynamic>;
  /// From (λ_ν, λ_t) of m nodes to contact by contact.
  static permutation order_of(index m) {
    permutation P(dimension * m);
    for (index i = 0; i < m; ++i) {
      P.indices()(i) = int(dimension * i);
      for (index k = 1; k < dimension; ++k) {
        P.indices()(m + (dimension - 1) * i + k - 1) = int(dimension * i + k);
      }
    }
    return P;
  }

  using set_type =
      decltype(power(second_order_cone<dimension, scalar>{}, std::declval<vector_type const&>()));
  using qp_type =
      separable_qp<decltype(std::declval<Dual const&>().a(std::declval<sparse_type const&>())),
                   vector_type const&, set_type const&>;

  Dual* problem_;
  vector_type μ_;
  vector_type shift_;
  permutation P_;
  sparse_type C_;
  vector_type q_;
  vector_type b_;
  set_type set_;
  qp_type qp_;
};

// --- successive approximations -------------------------------------------------------------------

/// Options of `coulomb`.
struct coulomb_options {
  double goal = 0;  ///< the relative reduced gradient one stops at: nothing is solved much better
};

/// The method at the top of this file, with a preconditioner M ≈ A⁻¹ of family.qp(). Refers to
/// both. Throws bad_input for options out of range.
template <class Family, class M>
[[nodiscard]] auto coulomb(Family& family, M const& m, coulomb_options o = {}) {
  using S = typename Family::scalar;
  auto const newton = [&family, &m](S goal) {
    // Newton steps are few in each outer one: solved by a factor 10 they save about a tenth of the
    // products, measured on bricks (k = 6).
    symmetric_newton_options<S> const options{.forcing = {.γ = 0.9,
                                                          .exponent = 1.5,
                                                          .η_max = 0.1,
                                                          .η_first = 0.1,
                                                          .goal = static_cast<double>(goal)}};
    return symmetric_newton{family.qp(), m, options};
  };
  successive_options<S> outer;
  outer.forcing.goal = o.goal;
  return successive_approximations(family, newton, std::move(outer));
}
template <class Family, class M>
auto coulomb(Family&, M const&&, coulomb_options = {}) = delete;

// --- coulomb newton ------------------------------------------------------------------------------
//
// Contact with Coulomb friction by Newton's method for a natural residual of the whole law, over
// the problem of coulomb_cones, multipliers contact by contact:
//
//     coulomb_residual    λ − P(λ − ρ (A λ − b)),   P of slanting/coulomb_law.hpp
//     de_saxce_residual   λ − P_K(λ − ρ (A λ − b + μ‖u_t‖ n))
//
//     contact::coulomb_cones cones(problem, mu);
//     auto const F = contact::coulomb_residual(cones, ρ);
//     auto const r = slant::solve(contact::coulomb_newton(F), cones.zero(),
//                                 slant::residual_below(1e-8) || slant::at_most(100));
//     auto const u = problem.displacement(cones.by_directions(r.x()));
//
// Both refer to the data of the family and see new ones, so load steps go as with any method:
//
//     contact::load_stepper stepper(cones, contact::coulomb_newton(F), residual_below(1e-8) || …);
//
// Where radii and cones are fixed points of linear convergence, this is a Newton method for the
// same equations: superlinear, at the price of nonsymmetric systems and of the safety that each
// convex problem has for itself.

/// ρ = ½ / mean(diag A), and what it cost.
template <class Family>
[[nodiscard]] auto residual_step(Family const& family) {
  using S = scalar_t<typename Family::vector_type>;
  return mean_step(family.qp().a(), family.zero(), S(0.5), mean_diagonal_options{});
}

/// λ − P(λ − ρ (A λ − b)); ρ in units of 1/A. Refers to the family.
template <class Family, class S>
[[nodiscard]] auto coulomb_residual(Family const& family, S const& ρ) {
  index const n = family.q().size();
  return identity_map(n) -
         slant::alart_curnier_projection<Family::dimension>(family.mu()) *
             (identity_map(n) - slant::positive(ρ) * slant::affine(family.qp().a(), family.q()));
}

/// λ − P_K(λ − ρ û), û = A λ − b + μ‖u_t‖ n; ρ in units of 1/A. Refers to the family.
template <class Family, class S>
[[nodiscard]] auto de_saxce_residual(Family const& family, S const& ρ) {
  index const n = family.q().size();
  return identity_map(n) -
         slant::projection(family.set()) *
             (identity_map(n) -
              slant::positive(ρ) * (slant::de_saxce<Family::dimension>(family.mu()) *
                                    slant::affine(family.qp().a(), family.q())));
}

/// Newton's method for one of them: GMRES, halving line search. `goal` is the relative residual one
/// stops at. F is referenced if it is an lvalue.
template <class F>
[[nodiscard]] auto coulomb_newton(F&& f, double goal = 0) {
  eisenstat_walker const forcing{
      .γ = 0.9, .exponent = 1.5, .η_max = 0.3, .η_first = 0.3, .goal = goal};
  return semismooth_newton{std::forward<F>(f), gmres_solver{},
                           halving_line_search{.sufficient = 0.1}, forcing};
}

}  // namespace slant::contact
