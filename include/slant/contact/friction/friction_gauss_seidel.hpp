// SPDX-License-Identifier: MIT
//
// Block Gauss–Seidel for Coulomb friction (friction_sweeps) with extrapolation.
//
// With redundant contacts W has a kernel, along which forces wander at a speed that is proportional
// to a velocity that is nearly 0 already: thousands of sweeps in nearly the same direction. After
// some sweeps r⁰ → r¹ the point P_K(r¹ + t (r¹ − r⁰)), made smooth by as many sweeps, is taken if
// its error is no larger than that of r¹, and t doubled; otherwise t is quartered.
#pragma once

#include <slant/base/entries.hpp>
#include <slant/base/scaling.hpp>
#include <slant/concepts/iterative_method.hpp>
#include <slant/concepts/scalar.hpp>
#include <slant/contact/friction/friction_blocks.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace slant::contact::detail {

// --- one contact ---------------------------------------------------------------------------------
//
// One contact with Coulomb friction, solved exactly: u = W r + q with a small positive definite W.
//
// q_n >= 0 is met by r = 0. Otherwise the contact is closed, u_n = 0, and elimination of r_n leaves
//
//     S r_t + b = u_t,   S = W_tt − W_tn W_nt / W_nn,   b = q_t − W_tn q_n / W_nn,
//     r_n = −(q_n + W_nt r_t) / W_nn.
//
// Stick is u_t = 0 with ‖r_t‖ <= μ r_n. Slip is u_t = −λ r_t with λ > 0, so that
// r_t(λ) = −(S + λI)⁻¹ b, and λ is the root of
//
//     ψ(λ) = μ r_n(λ)/‖r_t(λ)‖ − 1,
//
// negative at 0, where stick has failed, and growing like λ in the end: there is a root for every μ
// and every W, and since ψ is nearly linear Newton's method within a bracket needs a few steps (in
// 3D the root of a quartic: Bonnefon and Daviet, "Quartic formulation of Coulomb 3D frictional
// contact", 2011). In 2D the sign of r_t is that of −b, which says it all.

/// A contact's r, and λ of u_t = −λ r_t (0: it sticks or is open).
template <int N, class S>
struct one_contact {
  Eigen::Matrix<S, N, 1> r;
  S slip{0};
};

/// m (S + λI)⁻¹ b for 1 × 1 and 2 × 2 matrices, m the largest entry of S and λ: neither squares
/// nor inverses leave the range of numbers where λ is huge.
template <int T, class S>
[[nodiscard]] Eigen::Matrix<S, T, 1> shifted_inverse(Eigen::Matrix<S, T, T> const& matrix,
                                                     S const& λ, S const& m,
                                                     Eigen::Matrix<S, T, 1> const& b) {
  using slant::detail::from_entries;
  if constexpr (T == 1) {
    return Eigen::Matrix<S, T, 1>(S(b(0) / ((matrix(0, 0) + λ) / m)));
  } else {
    auto const s = from_entries<Eigen::Matrix<S, T, T>>(
        [&](int i, int j) -> S { return matrix(i, j) / m + (i == j ? λ / m : S(0)); });
    S const determinant = s(0, 0) * s(1, 1) - s(0, 1) * s(1, 0);
    return {S((s(1, 1) * b(0) - s(0, 1) * b(1)) / determinant),
            S((s(0, 0) * b(1) - s(1, 0) * b(0)) / determinant)};
  }
}

/// Solves one contact; `guess` is a λ from before, or 0.
template <int N, class S>
[[nodiscard]] one_contact<N, S> solve_one_contact(Eigen::Matrix<S, N, N> const& W,
                                                  Eigen::Matrix<S, N, 1> const& q, S const& μ,
                                                  S const& guess) {
  using slant::detail::dot_of;
  using slant::detail::from_entries;
  using slant::detail::length_of;
  using slant::detail::multiple_of;
  using slant::detail::over;
  using std::abs;
  constexpr int T = N - 1;
  using tangent = Eigen::Matrix<S, T, 1>;
  using matrix = Eigen::Matrix<S, T, T>;
  auto const force = [&](S const& n, tangent const& t) {
    return from_entries<Eigen::Matrix<S, N, 1>>([&](int i) { return i == 0 ? n : t(i - 1); });
  };
  one_contact<N, S> c{.r = from_entries<Eigen::Matrix<S, N, 1>>([](int) { return S(0); })};
  if (q(0) >= S(0)) return c;
  S const w = W(0, 0);
  if (μ == S(0)) {
    c.r(0) = -q(0) / w;
    return c;
  }
  auto const coupling = from_entries<tangent>([&](int i) { return W(0, i + 1); });
  auto const lever = from_entries<tangent>([&](int i) -> S { return W(i + 1, 0) / w; });
  auto const schur = from_entries<matrix>(
      [&](int i, int j) -> S { return W(i + 1, j + 1) - lever(i) * coupling(j); });
  auto const b = from_entries<tangent>([&](int i) -> S { return q(i + 1) - lever(i) * q(0); });
  auto const normal = [&](tangent const& t) { return S(-(q(0) + dot_of(coupling, t)) / w); };

  S const largest = slant::detail::largest_of(schur);
  tangent const t = over(shifted_inverse<T, S>(schur, S(0), largest, b), -largest);
  S n = normal(t);
  if (length_of(t) <= μ * n) {
    c.r = force(n, t);
    return c;
  }
  if constexpr (T == 1) {
    S const sign = b(0) > S(0) ? S(-1) : S(1);
    n = -q(0) / (w + sign * μ * coupling(0));
    c.slip = -b(0) / (sign * μ * n) - schur(0, 0);
    c.r = force(n, tangent(S(sign * μ * n)));
    return c;
  }
  S const push = length_of(b), first = push / μ * (w / -q(0));
  if (!(first <= std::numeric_limits<S>::max())) {  // λ → ∞: r_t against b
    tangent const e = over(b, push);
    n = -q(0) / (w - μ * dot_of(coupling, e));
    c.slip = std::numeric_limits<S>::max();
    c.r = force(n, multiple_of(-μ * n, e));
    return c;
  }
  S low = S(0), high = std::numeric_limits<S>::infinity();
  S λ = guess > S(0) ? guess : first;
  tangent e = b;  // direction of r_t
  for (int k = 0; k < 80; ++k) {
    S const m = std::max(largest, λ);
    tangent const y = multiple_of(S(-1), shifted_inverse<T, S>(schur, λ, m, b));  // m r_t
    S const size = length_of(y);
    e = over(y, size);
    n = normal(over(y, m));
    S const ψ = μ * n / size * m - S(1);
    if (abs(ψ) <= S(4) * std::numeric_limits<S>::epsilon()) break;
    (ψ < S(0) ? low : high) = λ;
    tangent const z = shifted_inverse<T, S>(schur, λ, m, e);  // −(dr_t/dλ) m / ‖r_t‖
    S const slope = μ * (dot_of(coupling, z) / w / m + n * (dot_of(e, z) / size));
    S next = λ - ψ / slope;
    if (!(next > low && next < high)) {
      next = high < std::numeric_limits<S>::infinity() ? S(low + (high - low) / S(2)) : S(8) * λ;
    }
    if (next == λ) break;
    λ = next;
  }
  c.slip = λ;
  c.r = force(n, multiple_of(μ * n, e));
  return c;
}

}  // namespace slant::contact::detail

namespace slant::contact {

// --- friction sweeps -----------------------------------------------------------------------------
//
// Sweeps of block Gauss–Seidel for Coulomb friction: one contact after the other is solved exactly,
// the forces of the others held (nonlinear Gauss–Seidel: Jourdan, Alart and Jean, 1998).
//
// Contacts that are open cost nothing as neighbours, and after some sweeps in which they stayed
// open are looked at only every now and then.

/// What sweeps know of the contacts from the sweeps before.
template <class S>
struct friction_sweep_memory {
  std::vector<S> slip{};    ///< λ of the last slip, where the next begins to look
  std::vector<int> idle{};  ///< sweeps since the contact was closed, up to a few
};

/// The sweeps. Refers to the blocks; what changes is in the memory.
template <int N, scalar S = double>
class friction_sweeps {
 public:
  using blocks_type = friction_blocks<N, S>;
  using vector_type = typename blocks_type::vector_type;
  using block_type = typename blocks_type::block_type;
  using part_type = typename blocks_type::part_type;
  using memory_type = friction_sweep_memory<S>;

  explicit friction_sweeps(blocks_type const& blocks)
      : blocks_(&blocks), shift_(blocks.contacts()) {
    for (index i = 0; i < blocks.contacts(); ++i) shift_[i] = needed_shift(blocks.diagonal(i));
  }

  /// Of someone who has seen no sweep yet.
  [[nodiscard]] memory_type memory() const {
    auto const m = std::size_t(blocks_->contacts());
    return {.slip = std::vector<S>(m, S(0)), .idle = std::vector<int>(m, 0)};
  }
  /// One sweep over the contacts; those long open are passed over unless `all`. Returns the blocks
  /// of W that were multiplied.
  index sweep(vector_type& r, memory_type& memory, bool all = true) const {
    auto const& p = *blocks_;
    index products = 0;
    for (index i = 0; i < p.contacts(); ++i) {
      auto const k = std::size_t(i);
      if (!all && memory.idle[k] >= patience) continue;
      S* const ri = r.data() + N * i;
      part_type q = slant::detail::entries_at<N>(p.q().data() + N * i);
      p.for_row(i, [&](index j, block_type const& b) {
        S const* const rj = r.data() + N * j;
        if (*rj == S(0)) return;  // the apex: open
        slant::detail::add_product(b, rj, q);
        ++products;
      });
      block_type W = p.diagonal(i);
      S const shift = shift_[i];
      for (int a = 0; a < N; ++a) {
        W(a, a) += shift;
        q(a) -= shift * ri[a];
      }
      auto const c = detail::solve_one_contact<N, S>(W, q, p.mu(i), memory.slip[k]);
      ++products;
      slant::detail::put_entries(c.r, ri);
      if (c.slip > S(0)) memory.slip[k] = c.slip;
      memory.idle[k] = c.r(0) > S(0) ? 0 : std::min(memory.idle[k] + 1, patience);
    }
    return products;
  }
  /// What is added to the diagonal of W_ii so that it is definite; 0 where it is.
  [[nodiscard]] S shift(index i) const { return shift_[i]; }

 private:
  static constexpr int patience = 3;

  /// What is added to a diagonal block, and taken away by r of the last sweep, so that its smallest
  /// eigenvalue is more than a millionth of its size: a step of the proximal point method for this
  /// contact. 0 where it is as it is.
  static S needed_shift(block_type const& d) {
    S const size = slant::detail::largest_of(d);
    if (size == S(0)) return S(1);
    slant::detail::symmetric_eigen<S, N> const eigen(slant::detail::from_entries<block_type>(
        [&](int i, int j) -> S { return (d(i, j) + d(j, i)) / (S(2) * size); }));
    S least = eigen.values(0);
    for (int i = 1; i < N; ++i) least = std::min(least, S(eigen.values(i)));
    return least > S(1e-6) ? S(0) : S(size * (S(1e-2) + std::max(S(0), S(-least))));
  }

  blocks_type const* blocks_;
  vector_type shift_;
};

// --- friction gauss seidel -----------------------------------------------------------------------

/// Options of friction_gauss_seidel.
template <class S>
struct gauss_seidel_options {
  index patience = 3000;  ///< steps without a new smallest error that mean stalled

  /// Throws bad_input naming the option, its value and what was expected.
  [[gnu::cold]] void validate() const {
    slant::detail::check_option("patience", patience, patience >= 1, "at least 1");
  }
};

/// State of friction_gauss_seidel.
template <class S>
struct gauss_seidel_state : friction_iterate<S> {
  S length = S(1);           ///< t
  index sweeps = 0;          ///< passes over the contacts
  index block_products = 0;  ///< blocks of W multiplied in them
  Eigen::VectorX<S> trial{}, trial_u{};
  friction_sweep_memory<S> memory{};
};

/// Block Gauss–Seidel with extrapolation; see the top of this file. No allocation in a step.
template <int N, scalar S = double>
class friction_gauss_seidel {
 public:
  using vector_type = typename friction_blocks<N, S>::vector_type;
  using state_type = gauss_seidel_state<S>;

  explicit friction_gauss_seidel(friction_blocks<N, S> const& blocks,
                                 gauss_seidel_options<S> options = {})
      : blocks_(&blocks), sweeps_(blocks), options_(options) {
    options_.validate();
  }

  [[nodiscard]] state_type start(vector_type const& x0) const {
    slant::detail::check_size("x0", index(x0.size()), blocks_->size());
    slant::detail::check_finite("x0", x0);
    state_type s;
    s.x = x0;
    s.u.resize(x0.size());
    s.trial.resize(x0.size());
    s.trial_u.resize(x0.size());
    s.error = measure(s, s.x, s.u);
    s.best = s.x;
    s.best_error = s.error;
    s.memory = sweeps_.memory();
    return s;
  }

  /// One step; of at most `most` sweeps if there is a limit.
  void step(state_type& s, index most = std::numeric_limits<index>::max()) const {
    if (s.status != slant::status::running) return;
    ++s.iteration;
    s.trial = s.x;
    pass(s, s.x, most);
    s.error = measure(s, s.x, s.u);
    if (most > sweeps_of_pass) extrapolate(s, most - sweeps_of_pass);
    judge(s);
  }

 private:
  static constexpr index sweeps_of_pass = 10;  // before and after the extrapolation of a step
  static constexpr index full_every = 10;      // every which sweep looks at all contacts

  void extrapolate(state_type& s, index most) const {
    for (index k = 0; k < s.x.size(); ++k) s.trial[k] = s.x[k] + s.length * (s.x[k] - s.trial[k]);
    for (index i = 0; i < blocks_->contacts(); ++i) {
      blocks_->put(blocks_->cone(i).project(blocks_->part_of(s.trial, i)), i, s.trial);
    }
    pass(s, s.trial, most);
    S const slack(1.02);  // accepted if the error is at most that multiple
    auto const extrapolated = measure(s, s.trial, s.trial_u);
    if (extrapolated.worst() <= slack * s.error.worst()) {
      s.x.swap(s.trial);
      s.u.swap(s.trial_u);
      s.error = extrapolated;
      s.length = std::min(S(S(2) * s.length), S(1) / std::numeric_limits<S>::epsilon());
    } else {
      s.length = std::max(S(1), S(s.length * S(0.25)));
    }
  }
  void judge(state_type& s) const {
    if (!slant::detail::is_finite(s.error.worst())) {
      s.status = slant::status::breakdown;
    } else if (s.error.worst() < s.best_error.worst()) {
      s.best = s.x;
      s.best_error = s.error;
      s.since_best = 0;
    } else if (++s.since_best >= options_.patience) {
      s.status = slant::status::stalled;
    }
  }
  friction_error<S> measure(state_type& s, vector_type const& x, vector_type& u) const {
    blocks_->velocity(x, u);
    ++s.evaluations;
    return blocks_->error(x, u);
  }
  void pass(state_type& s, vector_type& x, index most) const {
    for (index k = 0; k < std::min(sweeps_of_pass, most); ++k) {
      s.block_products += sweeps_.sweep(x, s.memory, s.sweeps % full_every == 0);
      ++s.sweeps;
    }
  }

  friction_blocks<N, S> const* blocks_;
  friction_sweeps<N, S> sweeps_;
  gauss_seidel_options<S> options_;
};

}  // namespace slant::contact
