// SPDX-License-Identifier: MIT
//
// A primal-dual interior-point method for Coulomb friction. In x = D⁻¹ r and s = D (u + μ‖u_t‖ n),
// D = diag(1/μ, 1(, 1)) or a multiple of it, the problem of friction_problem.hpp is
//
//     p(x, s) = A x + b + ‖s_t‖ e − s = 0,    x, s ∈ L,    x ∘ s = 0,    A = D W D,  b = D q,
//
// with the Lorentz cone L, its product ∘ and e = (1, 0) at each contact; D = diag(1, 0(, 0)) if
// μ = 0. For the convex problem, ‖s_t‖ given, see Acary, Armand, Nguyen and Shpakovych,
// "Second-order cone programming for frictional contact mechanics using interior point algorithm",
// 2024. Here ‖s_t‖ is linearised with the rest, so there is no outer iteration, and no symmetric
// system: E = I − e (s_t/‖s_t‖)ᵀ, T of Nesterov and Todd (lorentz_scaling),
//
//     A dx − E ds = −p,    λ ∘ (T dx + T⁻ᵀ ds) = c.
//
// c = −λ∘λ for the predictor dx, ds of length a, then −λ∘λ − a² (T dx)∘(T⁻ᵀ ds) + σγ e, γ the mean
// xᵀs of a contact (Mehrotra, "On the implementation of a primal-dual interior point method",
// 1992). What is solved: T = U Σ Vᵀ, and z is, direction by direction, dx where Σ is small (a free
// force) and −ds where it is large (a free velocity): dx = V D₁ z, ds = Tᵀ(λ\c) − V D₂ z,
// D₂ = Σ² D₁,
//
//     (A V D₁ + E V D₂) z = −p + E Tᵀ(λ\c),
//
// where no entry grows as γ → 0 and none is lost beside another. Two safeguards: α Λ dx, Λ the mean
// diagonal of A at a contact, is added after short steps, a proximal term that solves singular
// systems and leaves no bias; and until p is small the aim σγ is at least a part of the work of x
// on p, else x and s run into the boundary before, and stay there.
#pragma once

#include <slant/base/entries.hpp>
#include <slant/base/scaling.hpp>
#include <slant/concepts/bad_input.hpp>
#include <slant/concepts/iterative_method.hpp>
#include <slant/concepts/scalar.hpp>
#include <slant/contact/friction/friction_blocks.hpp>
#include <slant/contact/friction/friction_newton.hpp>
#include <slant/sets/second_order_cone.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace slant::contact::detail {

// --- lorentz scaling -----------------------------------------------------------------------------
//
// The Lorentz cone L = {x : ‖x_t‖ <= x_0} in N dimensions as interior-point methods see it: its
// Jordan algebra, and the scaling of Nesterov and Todd ("Self-scaled barriers and interior-point
// methods for convex programming", 1997) for a pair x, s inside of it,
//
//     T x = T⁻ᵀ s = λ,    T L = L,    xᵀs = λᵀλ.
//
// Near the boundary x_0 − ‖x_t‖ has no digits left. So x and s are no data here, but T⁻¹λ and Tᵀλ:
// a step is made from λ, which is well inside, and T is multiplied by the scaling of what the step
// has made of λ (Vandenberghe, "The CVXOPT linear and quadratic cone program solvers", 2010, §5).
// T is kept by its singular values, which are known in closed form: its smallest would be lost
// beside its largest, and T⁻¹ no longer be its inverse.

/// A pair x, s as λ and T = U diag(Σ) Vᵀ.
template <int N, class S>
class lorentz_scaling {
 public:
  using cone = slant::detail::lorentz_algebra<N, S>;
  using part = typename cone::part;
  using block = Eigen::Matrix<S, N, N>;

  /// x = x0 e, s = s0 e; x0, s0 > 0.
  lorentz_scaling(S const& x0, S const& s0) : η_(s0 / x0) {
    using slant::detail::from_entries;
    using std::sqrt;
    S const λ = sqrt(x0 * s0), T = sqrt(η_);
    λ_ = from_entries<part>([&](int i) { return i == 0 ? λ : S(0); });
    factor(from_entries<block>([&](int i, int j) { return i == j ? T : S(0); }));
  }

  [[nodiscard]] part const& λ() const { return λ_; }
  [[nodiscard]] part x() const {
    part const y = slant::detail::transposed_product(U_, λ_);
    return slant::detail::product_of(
        V_, slant::detail::from_entries<part>([&](int i) -> S { return y[i] / Σ_[i]; }));
  }
  [[nodiscard]] part s() const { return adjoint(λ_); }
  /// Tᵀ y.
  [[nodiscard]] part adjoint(part const& y) const {
    part const z = slant::detail::transposed_product(U_, y);
    return slant::detail::product_of(
        V_, slant::detail::from_entries<part>([&](int i) -> S { return z[i] * Σ_[i]; }));
  }
  [[nodiscard]] block const& U() const { return U_; }
  [[nodiscard]] block const& V() const { return V_; }
  [[nodiscard]] part const& Σ() const { return Σ_; }

  /// How far λ + t dx and λ + t ds are both in the cone.
  [[nodiscard]] S length(part const& dx, part const& ds) const {
    second_order_cone<N, S> const L(S(1));
    return std::min(L.step_to_boundary(λ_, dx), L.step_to_boundary(λ_, ds));
  }
  /// x and s move by T⁻¹dx and Tᵀds; both stay inside of the cone.
  void move(part const& dx, part const& ds) {
    using slant::detail::combination;
    using slant::detail::over;
    using slant::detail::product_of;
    using std::sqrt;
    part const x = combination(S(1), λ_, S(1), dx), s = combination(S(1), λ_, S(1), ds);
    S const x_length = sqrt(cone::determinant(x)), s_length = sqrt(cone::determinant(s));
    part const x1 = over(x, x_length), s1 = over(s, s_length);
    part const w = over(combination(S(1), s1, S(1), cone::reflected(x1)),
                        sqrt(S(2) * (S(1) + slant::detail::dot_of(x1, s1))));
    part v = w;
    v[0] += S(1);
    v = over(v, sqrt(S(2) * (w[0] + S(1))));
    S const β = sqrt(s_length / x_length);
    block const step = slant::detail::multiple_of(β, cone::hyperbolic(v));
    λ_ = product_of(step, x);
    η_ *= β * β;
    factor(product_of(
        product_of(step, U_),
        slant::detail::from_entries<block>([&](int i, int j) -> S { return Σ_[i] * V_(j, i); })));
  }

 private:
  /// TᵀT = η (2 w wᵀ − J) with w_0² − ‖w_t‖² = 1, so that Σ² / η is k² = (w_0 + ‖w_t‖)², 1/k² and
  /// 1: on the light rays (1, ±w_t/‖w_t‖), and across. TᵀT e has the tangential part 2 η w_0 w_t.
  void factor(block const& T) {
    using slant::detail::entries_at;
    using std::sqrt;
    part const z = slant::detail::transposed_product(T, entries_at<N>(T.data()));
    S const h = cone::tangential_length(z) / η_;
    S const k = sqrt(h + sqrt(S(1) + h * h));
    V_ = frame(z);
    U_ = frame(slant::detail::product_of(T, entries_at<N>(V_.data())));
    S const middle = sqrt(η_);
    Σ_ = slant::detail::from_entries<part>([&](int i) -> S {
      return i == 0 ? middle * k : i == 1 ? middle / k : middle;
    });
  }
  /// (1, d), (1, −d) over √2 and (0, d⊥), d the direction of x_t.
  [[nodiscard]] static block frame(part const& x) {
    using std::sqrt;
    S const t = cone::tangential_length(x), half = sqrt(S(0.5));
    part const d = slant::detail::from_entries<part>([&](int i) -> S {
      if (i == 0) return S(0);
      return t > S(0) ? S(x[i] / t) : S(i == 1 ? 1 : 0);
    });
    return slant::detail::from_entries<block>([&](int i, int j) -> S {
      if (j == 2) return i == 0 ? S(0) : i == 1 ? S(-d[N - 1]) : d[1];
      if (i == 0) return half;
      return j == 0 ? half * d[i] : -half * d[i];
    });
  }

  part λ_;
  S η_;  ///< T J Tᵀ = η J
  block U_, V_;
  part Σ_;
};

// --- friction cone pair --------------------------------------------------------------------------

using slant::detail::combination;
using slant::detail::dot_of;
using slant::detail::from_entries;
using slant::detail::multiple_of;
using slant::detail::product_of;

/// One contact: x and s of the top of this file, and what the linearised equations hold of them.
template <int N, class S>
struct friction_cone_pair {
  using cone = slant::detail::lorentz_algebra<N, S>;
  using part = typename cone::part;
  using block = Eigen::Matrix<S, N, N>;

  /// W: the diagonal block of the contact.
  friction_cone_pair(S const& μ, block const& W) : at(S(1), S(1)) {
    S const normal = S(1) / std::max(μ, S(1)), tangential = std::min(μ, S(1));
    D = from_entries<part>([&](int i) { return i == 0 ? normal : tangential; });
    has_tangents = μ > S(0);
    S const trace = slant::detail::sum_of<N>([&](int i) -> S { return D[i] * W(i, i) * D[i]; });
    S const mean = trace / S(has_tangents ? N : 1);
    weight = mean > S(0) ? mean : S(1);
  }
  /// D y.
  [[nodiscard]] part scaled(part const& y) const {
    return from_entries<part>([&](int i) -> S { return D[i] * y[i]; });
  }
  /// All of it at u = W r + q, r = D x.
  void look(part const& u) {
    s = at.s();
    p = combination(S(1), scaled(u), S(-1), s);
    S const speed = cone::tangential_length(s);
    p[0] += speed;
    E = from_entries<block>([&](int i, int j) -> S {
      if (i == j) return S(1);
      return i == 0 && speed > S(0) ? S(-s[j] / speed) : S(0);
    });
    auto const square = [&](int i) -> S { return at.Σ()[i] * at.Σ()[i]; };
    D1 = from_entries<part>([&](int i) -> S { return std::min(S(weight / square(i)), S(1)); });
    D2 = from_entries<part>([&](int i) -> S { return std::min(square(i), weight); });
  }
  /// The aim of the predictor.
  void aim_at_nothing() { aim = multiple_of(S(-1), at.λ()); }
  /// That of the corrector after a predictor of length a.
  void aim_at(S const& γ, S const& a) {
    part second = multiple_of(a * a, cone::product(dx, ds));
    second[0] -= γ;
    aim = combination(S(-1), at.λ(), S(-1), cone::quotient(second, at.λ()));
  }
  /// The block of A V D₁ + E V D₂ on the diagonal, α Λ added to A, and one beside.
  [[nodiscard]] block own_block(block const& W, S const& α) const {
    S const proximal = α * weight;
    block const A = from_entries<block>(
        [&](int i, int j) -> S { return D[i] * W(i, j) * D[j] + (i == j ? proximal : S(0)); });
    block const AV = product_of(A, at.V()), EV = product_of(E, at.V());
    return from_entries<block>(
        [&](int i, int j) -> S { return AV(i, j) * D1[j] + EV(i, j) * D2[j]; });
  }
  [[nodiscard]] block block_of(friction_cone_pair const& other, block const& W) const {
    block const A =
        from_entries<block>([&](int i, int j) -> S { return D[i] * W(i, j) * other.D[j]; });
    block const AV = product_of(A, other.at.V());
    return from_entries<block>([&](int i, int j) -> S { return AV(i, j) * other.D1[j]; });
  }
  /// −p + E Tᵀ(λ\c).
  [[nodiscard]] part right_hand_side() const {
    return combination(S(1), product_of(E, at.adjoint(aim)), S(-1), p);
  }
  /// dx and ds from z; how far it is along them to the boundary. A direction along tangents that
  /// there are none of is rounding.
  S turn(part const& z) {
    dx = product_of(at.U(),
                    from_entries<part>([&](int i) -> S { return at.Σ()[i] * D1[i] * z[i]; }));
    for (int i = 1; i < N && !has_tangents; ++i) dx[i] = S(0);
    ds = combination(S(1), aim, S(-1), dx);
    return at.length(dx, ds);
  }

  part D;    ///< its diagonal
  S weight;  ///< Λ
  bool has_tangents;
  lorentz_scaling<N, S> at;
  part s, p;
  part aim;     ///< λ \ c
  part dx, ds;  ///< T dx and T⁻ᵀ ds
  part D1, D2;
  block E;
};

}  // namespace slant::contact::detail

namespace slant::contact {

// --- friction interior point ---------------------------------------------------------------------

/// Options of friction_interior_point. No setting is of a problem: q and W are of the size of 1 in
/// the units of friction_blocks.
template <class S>
struct friction_interior_options {
  S small = S(1e-10);    ///< ‖p‖/‖q‖ that needs no aim
  index patience = 100;  ///< steps without a clearly smaller error that mean stalled
  /// Throws bad_input naming the option, its value and what was expected.
  [[gnu::cold]] void validate() const {
    slant::detail::check_fraction("small", small);
    slant::detail::check_option("patience", patience, patience >= 1, "at least 1");
  }
};

/// State of friction_interior_point; x is inside of the cones.
template <int N, class S>
struct friction_interior_state : friction_iterate<S> {
  S γ{};            ///< mean xᵀs of the contacts: 0 at a solution
  S α = S(0);       ///< of the proximal term
  S length = S(0);  ///< of the last step, a factorisation and two solutions; 0 if none was made
  std::vector<detail::friction_cone_pair<N, S>> contacts{};
  Eigen::VectorX<S> right{}, z{};
  detail::block_lu<N, S> lu{};
};

/// The method at the top of this file; it ends by itself only if it gets no further (stalled) or
/// finds no direction (breakdown), as it does without a solution. γ falls to about ε, and the error
/// to √ε only if neither x nor s is inside at a contact. Refers to the blocks.
template <int N, scalar S = double>
class friction_interior_point {
 public:
  using vector_type = typename friction_blocks<N, S>::vector_type;
  using state_type = friction_interior_state<N, S>;

  explicit friction_interior_point(friction_blocks<N, S> const& blocks,
                                   friction_interior_options<S> options = {})
      : blocks_(&blocks), options_(options) {
    options_.validate();
  }

  /// In the middle of the cones, wherever x0 is: on their boundary no interior-point method could
  /// begin.
  [[nodiscard]] state_type start(vector_type const& x0) const {
    slant::detail::check_size("x0", index(x0.size()), blocks_->size());
    slant::detail::check_finite("x0", x0);
    state_type s;
    s.x = s.best = s.u = s.right = s.z = x0;
    s.best_error.scaled = std::numeric_limits<S>::infinity();
    place(s);
    look(s);
    judge(s);
    return s;
  }

  void step(state_type& s) const {
    if (s.status != slant::status::running) return;
    ++s.iteration;
    s.length = S(0);
    if (!factor(s)) {
      s.α = std::max(S(S(10) * s.α), S(proximal));
      if (!(s.α < S(1))) s.status = slant::status::breakdown;
    } else if (!advance(s)) {
      s.status = slant::status::breakdown;
    } else {
      look(s);
    }
    judge(s);
  }

 private:
  static constexpr double fraction = 0.99;   // of the way to the boundary
  static constexpr double balance = 0.2;     // of the work of x on p, at least, is aimed at
  static constexpr double largest_aim = 10;  // σ at most
  static constexpr double proximal =
      1e-3;  // first α; then × 3 after a short step, × ½ after a long one

  using pair = detail::friction_cone_pair<N, S>;
  using part = typename pair::part;
  using block = typename pair::block;

  /// f(contact, its number) for all of them.
  template <class F>
  static void each(state_type& s, F const& f) {
    for (std::size_t i = 0; i < s.contacts.size(); ++i) f(s.contacts[i], index(i));
  }
  [[nodiscard]] index count() const { return blocks_->contacts(); }
  [[nodiscard]] S mean(S const& sum) const { return sum / S(std::max<index>(1, count())); }
  void place(state_type& s) const {
    s.contacts.reserve(std::size_t(count()));
    S size = std::numeric_limits<S>::epsilon(), weight(0);
    for (index i = 0; i < count(); ++i) {
      auto const& c = s.contacts.emplace_back(blocks_->mu(i), blocks_->diagonal(i));
      part const b = c.scaled(blocks_->part_of(blocks_->q(), i));
      size = std::max(size, slant::detail::largest_of(b));
      weight += c.weight;
    }
    S const force = size / mean(weight);
    each(s, [&](pair& c, index) { c.at = detail::lorentz_scaling<N, S>(force, size); });
  }
  /// Everything at the x and s of the contacts.
  void look(state_type& s) const {
    each(s, [&](pair& c, index i) { blocks_->put(c.scaled(c.at.x()), i, s.x); });
    blocks_->velocity(s.x, s.u);
    ++s.evaluations;
    s.error = blocks_->error(s.x, s.u);
    S sum(0);
    each(s, [&](pair& c, index i) {
      c.look(blocks_->part_of(s.u, i));
      sum += detail::dot_of(c.at.λ(), c.at.λ());
    });
    s.γ = mean(sum);
  }
  void judge(state_type& s) const {
    S const now = s.error.worst(), before = s.best_error.worst();
    s.since_best = now <= S(0.9) * before ? 0 : s.since_best + 1;
    if (now < before) {
      s.best = s.x;
      s.best_error = s.error;
    }
    if (s.status != slant::status::running) return;
    if (!slant::detail::is_finite(now)) s.status = slant::status::breakdown;
    if (s.since_best > options_.patience) s.status = slant::status::stalled;
  }

  /// False if there is no direction.
  [[nodiscard]] bool advance(state_type& s) const {
    using detail::combination, detail::dot_of, detail::multiple_of;
    using std::sqrt;
    each(s, [](pair& c, index) { c.aim_at_nothing(); });
    S const a = std::min(S(1), find_direction(s));
    if (!(a > S(0))) return false;
    S after(0), work(0), p(0);
    each(s, [&](pair& c, index) {
      after += dot_of(combination(S(1), c.at.λ(), a, c.dx), combination(S(1), c.at.λ(), a, c.ds));
      part const x = c.at.x();
      work += sqrt(dot_of(c.p, c.p)) * sqrt(dot_of(x, x));
      p += dot_of(c.p, c.p);
    });
    S σ = std::clamp(S(mean(after) / s.γ), S(0), S(1));
    σ *= σ;
    if (sqrt(p) > options_.small * blocks_->q_norm()) {
      σ = std::max(σ, std::min(S(largest_aim), S(S(balance) * mean(work) / s.γ)));
    }
    each(s, [&](pair& c, index) { c.aim_at(σ * s.γ, a); });
    S const t = std::min(S(1), S(S(fraction) * find_direction(s)));
    if (!(t > std::numeric_limits<S>::epsilon())) return false;
    each(s, [&](pair& c, index) { c.at.move(multiple_of(t, c.dx), multiple_of(t, c.ds)); });
    s.length = t;
    if (t < S(0.1)) s.α = std::max(S(S(3) * s.α), S(proximal));
    if (t > S(0.5)) s.α = s.α > S(1e-14) ? S(s.α / S(2)) : S(0);
    return true;
  }
  /// The factors of A V D₁ + E V D₂, with α.
  [[nodiscard]] bool factor(state_type& s) const {
    auto const& c = s.contacts;
    auto const assemble = [&](auto const& put) {
      for (index i = 0; i < count(); ++i) {
        auto const& row = c[std::size_t(i)];
        put(i, i, row.own_block(blocks_->diagonal(i), s.α));
        blocks_->for_row(
            i, [&](index j, block const& W) { put(i, j, row.block_of(c[std::size_t(j)], W)); });
      }
    };
    return s.lu.factor(count(), blocks_->block_count(), assemble);
  }
  /// dx and ds for the aim, and how far it is to the boundary; 0 if they are no numbers.
  [[nodiscard]] S find_direction(state_type& s) const {
    each(s, [&](pair& c, index i) { blocks_->put(c.right_hand_side(), i, s.right); });
    if (!s.lu.solve(s.right, s.z)) return S(0);
    S length = std::numeric_limits<S>::infinity();
    each(s, [&](pair& c, index i) { length = std::min(length, c.turn(blocks_->part_of(s.z, i))); });
    return length;
  }

  friction_blocks<N, S> const* blocks_;
  friction_interior_options<S> options_;
};

}  // namespace slant::contact
