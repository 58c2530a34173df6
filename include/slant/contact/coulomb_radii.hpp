// SPDX-License-Identifier: MIT
//
// Coulomb's law as a family of Tresca's problems [K (22); Haslinger 1983]: with the slip bounds g
// as parameters of
//
//     min ½ λᵀAλ − bᵀλ   over   λ_ν ≥ 0,  ‖λ_t,i‖ ≤ gᵢ,            P(λ) = F λ_ν,
//
// a fixed point g = F λ_ν(g) is a solution of contact with Coulomb friction. For orthotropic
// friction the discs are ellipses with the semi-axes F¹gᵢ, F²gᵢ, and P(λ) = λ_ν.
#pragma once

#include <slant/contact/friction_coefficient.hpp>
#include <slant/contact/load_step.hpp>
#include <slant/contact/tresca.hpp>
#include <slant/methods/separable_qp.hpp>
#include <slant/sets/cartesian.hpp>
#include <slant/sets/contact_sets.hpp>
#include <slant/sets/ellipse.hpp>
#include <slant/sets/power.hpp>

#include <algorithm>
#include <limits>
#include <type_traits>
#include <utility>

namespace slant::contact {

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

}  // namespace slant::contact
