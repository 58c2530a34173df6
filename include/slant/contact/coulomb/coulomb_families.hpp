// SPDX-License-Identifier: MIT
//
// Coulomb friction as families of quadratic programs: by slip bounds, and by cones.
#pragma once

#include <slant/contact/dual.hpp>
#include <slant/contact/friction_law.hpp>
#include <slant/contact/load_stepper.hpp>
#include <slant/problems/separable_qp.hpp>
#include <slant/sets/cartesian.hpp>
#include <slant/sets/contact_sets.hpp>
#include <slant/sets/ellipse.hpp>
#include <slant/sets/power.hpp>
#include <slant/sets/second_order_cone.hpp>

#include <Eigen/SparseCore>

#include <algorithm>
#include <limits>
#include <type_traits>
#include <utility>
#include <vector>

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

/// The family at the top of this file, for methods/successive_approximations.hpp. Refers to the
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
  /// Tangential directions: 1 for friction_line, 2 for friction_disc.
  static constexpr index tangents =
      std::is_same_v<typename Dual::friction_type, friction_line> ? 1 : 2;
  static_assert(std::is_same_v<typename Dual::friction_type, friction_line> ||
                    std::is_same_v<typename Dual::friction_type, friction_disc>,
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
  [[nodiscard]] Dual const& problem() const { return *problem_; }
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

/// The family at the top of this file, for methods/successive_approximations.hpp. Refers to the
/// dual problem, whose slip bounds have no meaning here; not movable.
template <class Dual>
class coulomb_cones {
 public:
  using vector_type = typename Dual::vector_type;
  using scalar = scalar_t<vector_type>;
  using sparse_type = typename Dual::sparse_type;
  static_assert(std::is_same_v<typename Dual::friction_type, friction_line> ||
                    std::is_same_v<typename Dual::friction_type, friction_disc>,
                "coulomb_cones: the dual problem must have the law friction_line or friction_disc");
  /// Components of a contact.
  static constexpr int dimension =
      std::is_same_v<typename Dual::friction_type, friction_line> ? 2 : 3;

  /// Throws bad_input unless there is a coefficient for every contact node, finite and >= 0.
  coulomb_cones(Dual& problem, vector_type μ)
      : problem_(&problem),
        μ_(detail::one_per_contact(std::move(μ), problem.b().size() / dimension)),
        shift_(vector_type::Zero(μ_.size())),
        C_(by_contacts(problem.constraints(), μ_.size())),
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
  [[nodiscard]] vector_type by_contacts(vector_type const& λ) const {
    vector_type x(λ.size());
    for (index row = 0; row < λ.size(); ++row) x(place_of(row, μ_.size())) = λ(row);
    return x;
  }
  /// And back.
  [[nodiscard]] vector_type by_directions(vector_type const& x) const {
    vector_type λ(x.size());
    for (index row = 0; row < x.size(); ++row) λ(row) = x(place_of(row, μ_.size()));
    return λ;
  }

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
  /// Where row `row` of m nodes stands contact by contact.
  static index place_of(index row, index m) {
    constexpr index t = dimension - 1;
    if (row < m) return dimension * row;
    return dimension * ((row - m) / t) + 1 + (row - m) % t;
  }
  static sparse_type by_contacts(sparse_type const& B, index m) {
    std::vector<Eigen::Triplet<scalar>> entries;
    entries.reserve(static_cast<std::size_t>(B.nonZeros()));
    for (index j = 0; j < B.outerSize(); ++j) {
      for (typename sparse_type::InnerIterator e(B, j); e; ++e) {
        entries.emplace_back(static_cast<int>(place_of(e.row(), m)), static_cast<int>(j),
                             e.value());
      }
    }
    sparse_type C(B.rows(), B.cols());
    C.setFromTriplets(entries.begin(), entries.end());
    return C;
  }

  using set_type =
      decltype(power(second_order_cone<dimension, scalar>{}, std::declval<vector_type const&>()));
  using qp_type =
      separable_qp<decltype(std::declval<Dual const&>().a(std::declval<sparse_type const&>())),
                   vector_type const&, set_type const&>;

  Dual* problem_;
  vector_type μ_;
  vector_type shift_;
  sparse_type C_;
  vector_type q_;
  vector_type b_;
  set_type set_;
  qp_type qp_;
};

}  // namespace slant::contact
