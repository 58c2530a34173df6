// SPDX-License-Identifier: MIT
//
// Are these forces a solution? The law of contacts with Coulomb friction, evaluated at r from the
// data alone: no set, operator or solver of the library takes part, only lengths of small vectors.
//
//     u = W r + q,   û = u + μ‖u_t‖ n,   r ∈ K_μ,   û ∈ K_μ*,   ûᵀ r = 0    (de Saxcé, Feng 1998)
//
// K_μ = {‖x_t‖ <= μ x_n}, and û ∈ K_μ* is no more than u_n >= 0. The natural map r − P_K(r − ρ û)
// is zero exactly at the solutions; it adds forces and velocities, so it takes a ρ in their ratio.
//
// Two are evaluated. For ρ = 1 it is what the literature compares (Acary, Brémond and Huber, 2018),
// and depends on the units of W: of W in the unit 1e-150 it says nothing. The unit-free one takes
// ρᵢ = 1/wᵢ at contact i, wᵢ the largest |entry| of W_ii, and measures
//
//     xᵢ = √wᵢ rᵢ,   vᵢ = ûᵢ/√wᵢ,      ‖x − P_K(x − v)‖ / ‖(qᵢ/√wᵢ)‖,
//
// roots of energies above and below. For W → s W, q → t q, and for D W D, D q, D⁻¹r with a factor
// for each contact, which is a change of its units, the figure stays as it is.
//
// The other figures keep the units of the data, which may be anywhere in the range of the scalar:
// relative figures come from numbers near 1.
#pragma once

#include <slant/base/entries.hpp>
#include <slant/base/scaling.hpp>
#include <slant/compiled.hpp>
#include <slant/contact/friction/friction_problem.hpp>

#include <cmath>
#include <limits>
#include <vector>

namespace slant::contact {

/// What a contact does: r − ρ û has its projection at 0, inside of the cone or on its boundary.
enum class contact_state : unsigned char { open, stick, slip };

/// The law at one contact; violations are 0 at a solution.
template <class S>
struct contact_check {
  contact_state state = contact_state::open;
  S natural_map = S(0);  ///< ‖r − P_K(r − ρ û)‖, a force
  S unit_free_map = S(0);  ///< ‖x − P_K(x − v)‖ / ‖(q/√w)‖: its part of that of all contacts
  S outside_cone = S(0);     ///< distance of r from K_μ, a force
  S outside_dual = S(0);     ///< distance of û from K_μ*, a velocity
  S penetration = S(0);      ///< max(−u_n, 0): the same but for a factor up to √(1 + μ²)
  S complementarity = S(0);  ///< |ûᵀ r|, a power
  S dissipation = S(0);      ///< −u_tᵀ r_t, a power; >= 0 wherever friction resists
};

/// The largest of a kind, and where it is; NaN if one of them is.
template <class S>
struct violation {
  S value = S(0);     ///< in units of the data
  S relative = S(0);  ///< forces over ‖r‖, velocities over ‖q‖, powers over ‖r‖ ‖q‖
  index contact = -1;  ///< −1: there is none
};

/// The law at all contacts.
template <class S>
struct friction_check {
  S natural_map = S(0);  ///< Euclidean norm over all contacts
  /// Over ρ ‖q‖; infinite if q = 0 and r is no solution. For ρ = 1 the measure of the literature.
  S relative_natural_map = S(0);
  /// What the natural map may become by rounding r and evaluating u: a few of these are as good as
  /// none. ε ‖ |r| + ρ (1 + μ) (|W| |r| + |q|) ‖.
  S rounding = S(0);
  S relative_rounding = S(0);  ///< over ρ ‖q‖: where it is not small the natural map says nothing
  /// That of the top of this file; infinite as the other. Sliding below the rounding of u is none.
  S unit_free_map = S(0);
  /// What the unit-free natural map may become by rounding, as `relative_rounding`.
  S unit_free_rounding = S(0);
  S unit_free_penetration = S(0);  ///< ‖max(0, −u_n)/√w‖ / ‖(q/√w)‖: where μ is large it says more
  violation<S> worst{};  ///< the contact with the largest unit-free map; relative = value
  violation<S> outside_cone{};
  violation<S> outside_dual{};
  violation<S> penetration{};
  violation<S> complementarity{};
  violation<S> propulsion{};  ///< −dissipation: friction that drives the motion
  S dissipation = S(0);       ///< sum over the contacts
  index open = 0, stick = 0, slip = 0;
  std::vector<contact_check<S>> contacts{};  ///< one by one
};

namespace detail {

/// Of a contact in the plane the last component is 0.
template <class S>
using contact_vector = Eigen::Matrix<S, 3, 1>;

/// ‖x_t‖.
template <class S>
[[nodiscard]] S tangential_length(contact_vector<S> const& x) {
  return slant::detail::length_of(slant::detail::tail_of(x));
}

/// √(1 + μ²).
template <class S>
[[nodiscard]] S slope(S const& μ) {
  using std::sqrt;
  return μ <= S(1) ? S(sqrt(S(1) + μ * μ)) : S(μ * sqrt(S(1) + S(1) / μ / μ));
}

/// r − P_K(r − v) of one contact, and which of the three faces of K the projection is on.
template <class S>
[[nodiscard]] contact_vector<S> natural_map(contact_vector<S> const& r, contact_vector<S> const& v,
                                            S const& μ, contact_state& state) {
  contact_vector<S> const z = slant::detail::combination(S(1), r, S(-1), v);
  S const tangential = detail::tangential_length(z);
  state = contact_state::open;
  if (μ * tangential <= -z[0]) return r;
  state = contact_state::stick;
  if (tangential <= μ * z[0]) return v;
  state = contact_state::slip;
  // P = s (1, μ e) with e = z_t / ‖z_t‖, s = (z_n + μ‖z_t‖) / (1 + μ²); here in terms of v, which
  // the difference of two long vectors would lose: with δ = ‖z_t‖ − μ r_n
  //     F_n = (v_n − μ δ) / (1 + μ²),   F_t = (δ r_t + μ r_n v_t) / ‖z_t‖ + μ F_n e.
  S const r_t = tangential_length(r), v_t = tangential_length(v), sum = tangential + r_t;
  S const δ = (r_t - μ * r[0]) + (v_t / sum * v_t - S(2) * (r[1] / sum * v[1] + r[2] / sum * v[2]));
  contact_vector<S> F;
  F[0] = μ <= S(1) ? S((v[0] - μ * δ) / (S(1) + μ * μ)) : S((v[0] / μ - δ) / (S(1) / μ + μ));
  S const of_r = δ / tangential, of_v = μ * r[0] / tangential, of_z = μ * F[0] / tangential;
  for (int i = 1; i < 3; ++i) F[i] = of_r * r[i] + of_v * v[i] + of_z * z[i];
  return F;
}

/// Distance from {x : ‖x_t‖ <= μ x_n}.
template <class S>
[[nodiscard]] S distance_from_cone(contact_vector<S> const& x, S const& μ) {
  S const tangential = detail::tangential_length(x);
  if (tangential <= μ * x[0]) return S(0);
  if (μ * tangential <= -x[0]) return slant::detail::length_of(x);
  return (tangential - μ * x[0]) / slope(μ);
}

/// Distance of u + μ‖u_t‖ n from {x : μ‖x_t‖ <= x_n}, without the rounding of that sum.
template <class S>
[[nodiscard]] S distance_from_dual(contact_vector<S> const& u, S const& μ) {
  if (u[0] >= S(0)) return S(0);
  S const tangential = detail::tangential_length(u);
  S const normal = u[0] + μ * tangential;
  if (tangential <= -μ * normal) {
    contact_vector<S> v = u;
    v[0] = normal;
    return slant::detail::length_of(v);
  }
  return -u[0] / slope(μ);
}

/// x / y where 0 / 0 is 0.
template <class S>
[[nodiscard]] S ratio(S const& x, S const& y) {
  return x == S(0) ? S(0) : S(x / y);
}

template <class S>
void take_larger(violation<S>& worst, S const& value, index contact) {
  if (value != value || value > worst.value) {
    worst.value = value;
    worst.contact = contact;
  }
}

}  // namespace detail

/// Evaluates the law at the forces r of a problem, contact by contact as its q. ρ > 0 is a force
/// over a velocity. A force that is not finite gives NaN as its maps. Throws bad_input for a
/// problem that is not valid, and for a size of r or a ρ that does not fit.
template <class S>
[[nodiscard]] friction_check<S> verify(friction_problem<S> const& p,
                                       typename friction_problem<S>::vector_type const& r,
                                       S ρ = S(1)) {
  using vector_type = typename friction_problem<S>::vector_type;
  using block = detail::contact_vector<S>;
  using slant::detail::over;
  using std::abs;
  p.validate();
  slant::detail::check_size("r", index(r.size()), index(p.q.size()));
  if (!(ρ > S(0) && slant::detail::is_finite(ρ))) {
    throw bad_input("rho", slant::detail::show(ρ), "a finite number > 0");
  }
  vector_type const u = p.W * r + p.q;
  vector_type magnitude = p.q.cwiseAbs();
  magnitude.noalias() += p.W.cwiseAbs() * r.cwiseAbs();
  auto const largest = [](vector_type const& x) {
    S const size = slant::detail::largest_of(x);
    return size > S(0) ? size : S(1);
  };
  S const force = largest(r), velocity = largest(u);  // units of their own for powers

  friction_check<S> all;
  index const d = p.dimension();
  all.contacts.resize(std::size_t(p.contacts()));
  vector_type residual(r.size()), unit_free(r.size()), size_in_units(r.size());
  vector_type penetrations = vector_type::Zero(p.contacts()), loads(r.size());
  vector_type const root = detail::compliances(p.W, p.contacts()).cwiseSqrt();
  S dissipation = S(0);
  for (index i = 0; i < p.contacts(); ++i) {
    S const μ = p.mu[i];
    auto const part_of = [&](vector_type const& x) {
      return slant::detail::from_entries<block>([&](int k) { return k < d ? x[i * d + k] : S(0); });
    };
    block const ri = part_of(r), ui = part_of(u);
    block v = slant::detail::multiple_of(ρ, ui);
    v[0] += μ * detail::tangential_length(v);
    auto& c = all.contacts[std::size_t(i)];
    block F = detail::natural_map(ri, v, μ, c.state);
    // The same in units of the contact: forces times √w, velocities over it.
    contact_state ignored{};
    block const own = slant::detail::multiple_of(root[i], ri);
    block y = over(ui, root[i]);
    penetrations[i] = y[0] >= S(0) ? S(0) : S(-y[0]);
    // Sliding slower than the rounding of u is none: times a large μ it would hide all the rest.
    block const sizes = part_of(magnitude);
    S const sliding_μ = detail::tangential_length(ui) <= S(4) * std::numeric_limits<S>::epsilon() *
                                                             detail::tangential_length(sizes)
                            ? S(0)
                            : μ;
    bool const forceless = slant::detail::all_zero(own);
    y[0] += sliding_μ * detail::tangential_length(y);
    block E = detail::natural_map(own, y, μ, ignored);
    // Where nothing depends on a force (W = 0, say) an infinite one would pass.
    if (!slant::detail::all_finite(ri)) {
      F.setConstant(std::numeric_limits<S>::quiet_NaN());
      E = F;
    }
    c.unit_free_map = slant::detail::length_of(E);
    detail::take_larger(all.worst, c.unit_free_map, i);
    for (index k = 0; k < d; ++k) {
      residual[i * d + k] = F[k];
      unit_free[i * d + k] = E[k];
      loads[i * d + k] = p.q[i * d + k] / root[i];
      S& size = magnitude[i * d + k];
      // Without a force all depends on the sign of u_n.
      size_in_units[i * d + k] = forceless ? (k == 0 ? S(size / root[i]) : S(0))
                                           : S(abs(own[k]) + (S(1) + sliding_μ) * (size / root[i]));
      size = abs(ri[k]) + ρ * (S(1) + μ) * size;
    }
    c.natural_map = slant::detail::length_of(F);
    c.outside_cone = detail::distance_from_cone(ri, μ);
    c.outside_dual = detail::distance_from_dual(ui, μ);
    c.penetration = ui[0] >= S(0) ? S(0) : S(-ui[0]);

    block const f = over(ri, force), w = over(ui, velocity);
    S const tangential = f[1] * w[1] + f[2] * w[2];
    S const friction = μ * detail::tangential_length(w);
    S const power = abs(S(f[0] * w[0] + (f[0] * friction + tangential)));
    dissipation -= tangential;
    c.complementarity = power * force * velocity;
    c.dissipation = -tangential * force * velocity;

    detail::take_larger(all.outside_cone, c.outside_cone, i);
    detail::take_larger(all.outside_dual, c.outside_dual, i);
    detail::take_larger(all.penetration, c.penetration, i);
    detail::take_larger(all.complementarity, power, i);
    detail::take_larger(all.propulsion, tangential, i);
    ++(c.state == contact_state::open    ? all.open
       : c.state == contact_state::stick ? all.stick
                                         : all.slip);
  }

  S const r_norm = slant::norm(r), q_norm = slant::norm(p.q);
  all.natural_map = slant::norm(residual);
  all.relative_natural_map = detail::ratio(S(all.natural_map / ρ), q_norm);
  all.rounding = std::numeric_limits<S>::epsilon() * slant::norm(magnitude);
  all.relative_rounding = detail::ratio(S(all.rounding / ρ), q_norm);
  S const loads_norm = slant::norm(loads);
  all.unit_free_map = detail::ratio(slant::norm(unit_free), loads_norm);
  all.unit_free_rounding =
      std::numeric_limits<S>::epsilon() * detail::ratio(slant::norm(size_in_units), loads_norm);
  all.unit_free_penetration = detail::ratio(slant::norm(penetrations), loads_norm);
  for (auto& c : all.contacts) c.unit_free_map = detail::ratio(c.unit_free_map, loads_norm);
  all.worst.value = all.worst.relative = detail::ratio(all.worst.value, loads_norm);
  all.outside_cone.relative = detail::ratio(all.outside_cone.value, r_norm);
  all.outside_dual.relative = detail::ratio(all.outside_dual.value, q_norm);
  all.penetration.relative = detail::ratio(all.penetration.value, q_norm);
  all.dissipation = dissipation * force * velocity;
  for (auto* power : {&all.complementarity, &all.propulsion}) {
    if (power->value == S(0)) continue;
    power->relative = power->value * (force / r_norm) * (velocity / q_norm);
    power->value *= force * velocity;
  }
  return all;
}

#if SLANT_USES_COMPILED
extern template friction_check<double> verify<double>(friction_problem<double> const&,
                                                      Eigen::VectorXd const&, double);
#endif

}  // namespace slant::contact
