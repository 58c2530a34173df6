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
// system: E = I − e (s_t/‖s_t‖)ᵀ, T of Nesterov and Todd (detail/lorentz_scaling.hpp),
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

#include <slant/concepts/checks.hpp>
#include <slant/concepts/iterative_method.hpp>
#include <slant/contact/detail/block_lu.hpp>
#include <slant/contact/detail/friction_cone_pair.hpp>
#include <slant/contact/friction_blocks.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace slant::contact {

/// Options of friction_interior_point. No setting is of a problem: q and W are of the size of 1 in
/// the units of friction_blocks.
template <class S>
struct friction_interior_options {
  S small = S(1e-10);     ///< ‖p‖/‖q‖ that needs no aim
  S fraction = S(0.99);   ///< of the way to the boundary
  S balance = S(0.2);     ///< of the work of x on p, at least, is aimed at
  S largest_aim = S(10);  ///< σ at most
  S proximal = S(1e-3);   ///< first α; then × 3 after a short step, × ½ after a long one
  index patience = 100;   ///< steps without a clearly smaller error that mean stalled
  /// Throws bad_input naming the option, its value and what was expected.
  [[gnu::cold]] void validate() const {
    using slant::detail::show;
    within("small", small, S(1));
    within("fraction", fraction, S(1));
    within("balance", balance, std::numeric_limits<S>::infinity());
    within("largest_aim", largest_aim, std::numeric_limits<S>::infinity());
    within("proximal", proximal, S(1));
    if (patience < 1) throw bad_input("patience", show(patience), "at least 1");
  }

 private:
  static void within(char const* name, S const& value, S const& end) {
    using slant::detail::show;
    if (value > S(0) && value < end) return;
    throw bad_input(name, show(value), "a number in (0, " + show(end) + ")");
  }
};

/// State of friction_interior_point.
template <int N, class S>
struct friction_interior_state {
  using vector_type = Eigen::Matrix<S, Eigen::Dynamic, 1>;
  vector_type x{};            ///< forces, inside of their cones, in the units of the blocks
  vector_type u{};            ///< W x + q
  friction_error<S> error{};  ///< of x
  vector_type best{};         ///< the x with the smallest error so far
  friction_error<S> best_error{};
  S γ{};                     ///< mean xᵀs of the contacts: 0 at a solution
  S α = S(0);                ///< of the proximal term
  S length = S(0);           ///< of the last step; 0 if none was made
  index iteration = 0;       ///< steps: of each a factorisation and two solutions
  index evaluations = 0;     ///< of the error: a product by W each
  index factorizations = 0;  ///< matrices factored
  index factored_rows = 0;   ///< of all matrices together
  index sparse = 0;          ///< how many of them were sparse
  index since_best = 0;      ///< steps
  slant::status status = slant::status::running;
  std::vector<detail::friction_cone_pair<N, S>> contacts{};
  vector_type right{}, z{};
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
      s.α = std::max(S(S(10) * s.α), options_.proximal);
      if (!(s.α < S(1))) s.status = slant::status::breakdown;
    } else if (!advance(s)) {
      s.status = slant::status::breakdown;
    } else {
      look(s);
    }
    judge(s);
  }

 private:
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
      σ = std::max(σ, std::min(options_.largest_aim, S(options_.balance * mean(work) / s.γ)));
    }
    each(s, [&](pair& c, index) { c.aim_at(σ * s.γ, a); });
    S const t = std::min(S(1), S(options_.fraction * find_direction(s)));
    if (!(t > std::numeric_limits<S>::epsilon())) return false;
    each(s, [&](pair& c, index) { c.at.move(multiple_of(t, c.dx), multiple_of(t, c.ds)); });
    s.length = t;
    if (t < S(0.1)) s.α = std::max(S(S(3) * s.α), options_.proximal);
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
    bool const good = s.lu.factor(count(), blocks_->block_count(), assemble);
    ++s.factorizations;
    s.factored_rows += blocks_->size();
    s.sparse += s.lu.is_sparse() ? 1 : 0;
    return good;
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
