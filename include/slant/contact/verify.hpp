// SPDX-License-Identifier: MIT
//
// Are these forces a solution? The law of contacts with Coulomb friction, evaluated at r from the
// data alone: no set, operator or solver of the library takes part, only lengths of small vectors.
//
//     u = W r + q,   û = u + μ‖u_t‖ n,   r ∈ K_μ,   û ∈ K_μ*,   ûᵀ r = 0    (de Saxcé, Feng 1998)
//
// K_μ = {‖x_t‖ <= μ x_n}, and û ∈ K_μ* is no more than u_n >= 0. The natural map r − P_K(r − ρ û)
// is zero exactly at the solutions; it adds forces and velocities, so it takes a ρ in their ratio,
// for which collections of problems have 1. The other figures keep the units of the data, which may
// be anywhere in the range of the scalar: relative figures come from numbers near 1.
#pragma once

#include <slant/contact/friction_problem.hpp>
#include <slant/sets/detail/entries.hpp>
#include <slant/sets/detail/scaled_norm.hpp>

#include <limits>
#include <vector>

namespace slant::contact {

/// What a contact does: r − ρ û has its projection at 0, inside of the cone or on its boundary.
enum class contact_state : unsigned char { open, stick, slip };

/// The law at one contact; violations are 0 at a solution.
template <class S>
struct contact_check {
  contact_state state = contact_state::open;
  S natural_map = S(0);      ///< ‖r − P_K(r − ρ û)‖, a force
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
  S natural_map = S(0);           ///< Euclidean norm over all contacts
  S relative_natural_map = S(0);  ///< over ρ ‖q‖; infinite if q = 0 and r is no solution
  /// What the natural map may become by rounding r and evaluating u: a few of these are as good as
  /// none. ε ‖ |r| + ρ (1 + μ) (|W| |r| + |q|) ‖.
  S rounding = S(0);
  S relative_rounding = S(0);  ///< over ρ ‖q‖: where it is not small the natural map says nothing
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

template <class S>
[[nodiscard]] S size_of(S const& x) {
  return x < S(0) ? S(-x) : x;
}
/// |W| |r| + |q|.
template <class S>
[[nodiscard]] typename friction_problem<S>::vector_type sum_of_sizes(
    friction_problem<S> const& p, typename friction_problem<S>::vector_type const& r) {
  auto sum = p.q;
  for (S& entry : sum) entry = detail::size_of(entry);
  for (index j = 0; j < p.W.outerSize(); ++j) {
    S const size = detail::size_of(r[j]);
    for (typename Eigen::SparseMatrix<S>::InnerIterator e(p.W, j); e; ++e) {
      sum[e.row()] += detail::size_of(S(e.value())) * size;
    }
  }
  return sum;
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
/// over a velocity. A NaN in r shows in the figures. Throws bad_input for a problem that is not
/// valid, and for a size of r or a ρ that does not fit.
template <class S>
[[nodiscard]] friction_check<S> verify(friction_problem<S> const& p,
                                       typename friction_problem<S>::vector_type const& r,
                                       S ρ = S(1)) {
  using vector_type = typename friction_problem<S>::vector_type;
  using block = detail::contact_vector<S>;
  p.validate();
  slant::detail::check_size("r", index(r.size()), index(p.q.size()));
  if (!(ρ > S(0) && slant::detail::is_finite(ρ))) {
    throw bad_input("rho", slant::detail::show(ρ), "a finite number > 0");
  }
  vector_type const u = p.W * r + p.q;
  vector_type magnitude = detail::sum_of_sizes(p, r);
  auto const largest = [](vector_type const& x) {
    S const size = slant::detail::largest_of(x);
    return size > S(0) ? size : S(1);
  };
  S const force = largest(r), velocity = largest(u);  // units of their own for powers

  friction_check<S> all;
  index const d = p.dimension();
  all.contacts.resize(static_cast<std::size_t>(p.contacts()));
  vector_type residual(r.size());
  S dissipation = S(0);
  for (index i = 0; i < p.contacts(); ++i) {
    S const μ = p.mu[i];
    auto const part_of = [&](vector_type const& x) {
      return slant::detail::from_entries<block>([&](int k) { return k < d ? x[i * d + k] : S(0); });
    };
    block const ri = part_of(r), ui = part_of(u);
    block v = slant::detail::multiple_of(ρ, ui);
    v[0] += μ * detail::tangential_length(v);
    auto& c = all.contacts[static_cast<std::size_t>(i)];
    block const F = detail::natural_map(ri, v, μ, c.state);
    for (index k = 0; k < d; ++k) {
      residual[i * d + k] = F[k];
      S& size = magnitude[i * d + k];
      size = detail::size_of(ri[k]) + ρ * (S(1) + μ) * size;
    }
    c.natural_map = slant::detail::length_of(F);
    c.outside_cone = detail::distance_from_cone(ri, μ);
    c.outside_dual = detail::distance_from_dual(ui, μ);
    c.penetration = ui[0] >= S(0) ? S(0) : S(-ui[0]);

    auto const over = [](block const& x, S const& unit) {
      return slant::detail::from_entries<block>([&](int k) -> S { return x[k] / unit; });
    };
    block const f = over(ri, force), w = over(ui, velocity);
    S const tangential = f[1] * w[1] + f[2] * w[2];
    S const friction = μ * detail::tangential_length(w);
    S const power = detail::size_of(S(f[0] * w[0] + (f[0] * friction + tangential)));
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

}  // namespace slant::contact
