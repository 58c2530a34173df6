// SPDX-License-Identifier: MIT
//
// Friction: its laws as types, and its coefficients.
#pragma once

#include <slant/concepts/bad_input.hpp>
#include <slant/concepts/vector.hpp>
#include <slant/contact/contact_data.hpp>
#include <slant/sets/any_set.hpp>
#include <slant/sets/cartesian.hpp>
#include <slant/sets/contact_sets.hpp>

#include <concepts>
#include <utility>

namespace slant::contact {

// --- friction law --------------------------------------------------------------------------------

/// No tangential multipliers.
struct frictionless {
  static constexpr index tangents = 0;  ///< per node
};
/// 2D bodies: |λ_t,i| ≤ gᵢ.
struct friction_line {
  static constexpr index tangents = 1;
};
/// 3D bodies: ‖λ_t,i‖ ≤ gᵢ.
struct friction_disc {
  static constexpr index tangents = 2;
};

/// Tangents per node of a law that knows them by its type; 0 of others.
template <class Friction>
inline constexpr index static_tangents = 0;
template <class Friction>
  requires std::same_as<decltype(&Friction::tangents), index const*>
inline constexpr index static_tangents<Friction> = Friction::tangents;

/// The law that data stand for by the rows of T; its set is an any_set, so that what is written for
/// it is one type for all of them.
struct friction_of_data {
  index tangents;  ///< per node: 0, 1 or 2

  explicit friction_of_data(index k) : tangents(k) {}
};

namespace detail {

/// Λ for m nodes with the slip bounds g.
template <class V>
auto feasible_set(frictionless, index m, V const&) {
  return half_lines<scalar_t<V>>(m);
}
template <class V>
auto feasible_set(friction_line, index m, V const& g) {
  return cartesian(half_lines<scalar_t<V>>(m), intervals(g));
}
template <class V>
auto feasible_set(friction_disc, index m, V const& g) {
  return cartesian(half_lines<scalar_t<V>>(m), discs(g));
}
template <class V>
auto feasible_set(friction_of_data law, index m, V const& g) {
  using set = any_set<scalar_t<V>, contact_runs<scalar_t<V>>>;
  if (law.tangents == 0) return set(detail::feasible_set(frictionless{}, m, g));
  if (law.tangents == 1) return set(detail::feasible_set(friction_line{}, m, g));
  return set(detail::feasible_set(friction_disc{}, m, g));
}
template <class Friction, class S>
auto feasible_set(Friction friction, data<S> const& c) {
  return detail::feasible_set(friction, c.nodes(), c.g);
}

template <class Friction, class S>
using feasible_set_t =
    decltype(detail::feasible_set(std::declval<Friction>(), std::declval<data<S> const&>()));

/// The data, after a look at them. Throws bad_input unless they are valid, K has as many rows as f
/// and the friction law as many tangents as T.
template <class Friction, class S>
data<S> const& validated(Friction friction, data<S> const& c, index unknowns) {
  c.validate();
  slant::detail::check_size("rows of K", unknowns, c.f.size(), "the size of f,");
  if (c.tangents() != friction.tangents) {
    throw bad_input("tangents per contact node", slant::detail::show(c.tangents()),
                    slant::detail::show(friction.tangents) + " for this friction law");
  }
  return c;
}

// --- friction coefficient ------------------------------------------------------------------------
//
// Friction coefficients of Coulomb's law, one for each contact:
//
//     coefficients(F)                ‖λ_t,i‖ ≤ Fᵢ λ_ν,i                       depends on the place
//     slip_dependent(m, f)           ‖λ_t,i‖ ≤ f(i, ‖u_t,i‖) λ_ν,i            and on the slip
//     orthotropic_coefficients(F¹, F²)   (λ¹/F¹ᵢ)² + (λ²/F²ᵢ)² ≤ λ_ν,i²      and on the direction
//
// F λ_ν beyond the range of the scalar is ∞: the contact sticks.
//
// Slip: f should be continuous, and where it falls with the slip, slowly: uniqueness is lost where
// its slope exceeds the stiffness of the bodies, and with it the convergence of whatever iterates.

/// The coefficients of as many contacts as there are; else bad_input.
template <class Coefficient>
[[nodiscard]] Coefficient one_per_contact(Coefficient F, index contacts) {
  slant::detail::check_size("number of friction coefficients", index(F.size()), contacts,
                            "one per contact node,");
  return F;
}

}  // namespace detail

/// Fᵢ, whatever the slip; made by `coefficients`.
template <class V>
class place_dependent_friction {
 public:
  using scalar = scalar_t<V>;
  explicit place_dependent_friction(V F) : F_(std::move(F)) { detail::check_coefficients("F", F_); }
  [[nodiscard]] index size() const { return F_.size(); }
  [[nodiscard]] scalar operator()(index i, scalar const&) const { return F_(i); }

 private:
  V F_;
};

/// f(i, ‖u_t,i‖); made by `slip_dependent`.
template <class S, class Function>
class slip_dependent_friction {
 public:
  using scalar = S;
  slip_dependent_friction(index contacts, Function f) : contacts_(contacts), f_(std::move(f)) {}
  [[nodiscard]] index size() const { return contacts_; }
  /// Throws bad_input "f[3]: …" where f has no value >= 0 for contact 3, whatever calls it.
  [[nodiscard]] scalar operator()(index i, scalar const& slip) const {
    scalar const F = f_(i, slip);
    if (F >= scalar(0)) return F;
    throw bad_input("f", slant::detail::show(F),
                    "a friction coefficient >= 0 for the slip " + slant::detail::show(slip))
        .at(i);
  }

 private:
  index contacts_;
  Function f_;
};

/// F¹ along the first tangent, F² along the second; made by `orthotropic_coefficients`.
template <class V>
class orthotropic_friction {
 public:
  using scalar = scalar_t<V>;
  orthotropic_friction(V first, V second) : first_(std::move(first)), second_(std::move(second)) {
    slant::detail::check_size("F2", second_.size(), first_.size(), "as many as F1,");
    detail::check_coefficients("F1", first_);
    detail::check_coefficients("F2", second_);
  }
  [[nodiscard]] index size() const { return first_.size(); }
  [[nodiscard]] V const& first() const { return first_; }
  [[nodiscard]] V const& second() const { return second_; }

 private:
  V first_, second_;
};

/// A coefficient per contact. @throws bad_input "F[3]: …" unless all are finite and >= 0.
template <class V>
[[nodiscard]] auto coefficients(V F) {
  return place_dependent_friction<V>(std::move(F));
}
/// f(i, slip) >= 0 for contact i and the length of its slip, a displacement; ∞ sticks. What calls f
/// throws bad_input naming the contact where the value is negative or NaN.
template <class S = double, class Function>
  requires std::convertible_to<std::invoke_result_t<Function const&, index, S>, S>
[[nodiscard]] auto slip_dependent(index contacts, Function f) {
  return slip_dependent_friction<S, Function>(contacts, std::move(f));
}
/// Two coefficients per contact of bodies in space. @throws bad_input as `coefficients`.
template <class V>
[[nodiscard]] auto orthotropic_coefficients(V first, V second) {
  return orthotropic_friction<V>(std::move(first), std::move(second));
}

}  // namespace slant::contact
