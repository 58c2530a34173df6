// SPDX-License-Identifier: MIT
//
// Contact with Tresca friction: from displacements to multipliers and back
// [K (14)–(21)], [T (4.2)–(4.4)].
//
//     primal   min ½ uᵀKu − fᵀu + Σ gᵢ‖(T u)ᵢ‖   s.t.  N u ≤ d
//
//     dual     min ½ λᵀAλ − bᵀλ   over   λ_ν ≥ 0,  ‖λ_t,i‖ ≤ gᵢ,       λ = (λ_ν, λ_t)
//              A = B K⁻¹ Bᵀ,   b = B K⁻¹ f − c,   B = [N; T],   c = (d, 0)
//
//     back     u = K⁻¹ (f − Bᵀλ)
//
// The set is a matter of types: a frictionless scene has half lines and nothing else, so no disc is
// compiled into its solver; two-dimensional bodies have intervals, three-dimensional ones discs.
#pragma once

#include <slant/concepts/bad_input.hpp>
#include <slant/concepts/factorization.hpp>
#include <slant/concepts/vector.hpp>
#include <slant/contact/contact_data.hpp>
#include <slant/contact/friction_law.hpp>
#include <slant/contact/load_stepper.hpp>
#include <slant/operators/inverse.hpp>
#include <slant/operators/product.hpp>
#include <slant/problems/separable_qp.hpp>

#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace slant::contact::detail {

// --- known loads ---------------------------------------------------------------------------------
//
// Displacements under loads that are combinations of loads solved before: K⁻¹(α f₁ + β f₂) is
// α K⁻¹f₁ + β K⁻¹f₂. Load steps on a line, such as a constant load and one that grows, need two
// solves however many they are, unless one is a small difference of the two.

/// The last two loads that a solve was spent on, with their displacements.
template <class V>
class known_loads {
 public:
  using scalar = scalar_t<V>;

  [[nodiscard]] bool empty() const { return pairs_.empty(); }

  /// A load that was solved for, in place of the older one of the two.
  void add(V f, V u) {
    if (pairs_.size() == 2) pairs_.erase(pairs_.begin());
    pairs_.emplace_back(std::move(f), std::move(u));
  }

  /// After `add`: u = K⁻¹f if f is such a combination up to rounding in each component; else false.
  /// Coefficients beyond 64, which would multiply the errors of the displacements, are none, nor is
  /// a small difference of the two, which would be left with their errors.
  [[nodiscard]] bool combine(V const& f, V& u) const {
    scalar α(0), β(0);
    auto const& [f1, u1] = pairs_.front();
    auto const& [f2, u2] = pairs_.back();  // the same if there is only one
    V rest = f;
    scalar const length = f1.squaredNorm();
    scalar const shared = length > scalar(0) ? scalar(f1.dot(f2) / length) : scalar(0);
    V const across = f2 - shared * f1;
    scalar const width = across.squaredNorm();
    scalar const least = std::numeric_limits<scalar>::epsilon() * f2.squaredNorm();
    for (int pass = 0; pass < 2; ++pass) {  // the second one mends rounding errors of the first
      scalar const δ = width > least ? scalar(across.dot(rest) / width) : scalar(0);
      scalar const γ = length > scalar(0) ? scalar(f1.dot(rest) / length - δ * shared) : scalar(0);
      α += γ;
      β += δ;
      rest = f - α * f1 - β * f2;
    }
    using std::abs;
    scalar const most(64);
    if (!(abs(α) + abs(β) <= most)) return false;  // also if it is a NaN
    // Component by component: beside a large one, such as that of a penalty, others matter too.
    scalar const rounding = scalar(8) * std::numeric_limits<scalar>::epsilon();
    for (Eigen::Index i = 0; i < f.size(); ++i) {
      scalar const size = abs(f[i]) + (abs(α * f1[i]) + abs(β * f2[i]));
      if (!(abs(rest[i]) <= rounding * size)) return false;
    }
    u = α * u1 + β * u2;
    return abs(α) * u1.stableNorm() + abs(β) * u2.stableNorm() <= most * u.stableNorm();
  }

 private:
  std::vector<std::pair<V, V>> pairs_;
};

}  // namespace slant::contact::detail

namespace slant::contact {

// --- tresca --------------------------------------------------------------------------------------

/// The dual problem of a contact scene. Holds B, b and the set; refers to the factorisation.
/// Not movable: its operators refer to one another. What refers to it is not to be had from a
/// temporary, which would be gone before the solver looks at it.
///
///     slant::contact::dual problem(slant::contact::friction_disc{}, slant::factorize(K), data);
///     auto r = slant::solve(slant::kprgp{problem.qp()}, problem.zero(), …);
///     auto u = problem.displacement(r.x());
template <class Friction, class Factorization, class S>
  requires factorization<std::remove_cvref_t<Factorization>, Eigen::VectorX<S>>
class dual {
 public:
  using vector_type = Eigen::VectorX<S>;
  using sparse_type = Eigen::SparseMatrix<S>;
  using friction_type = Friction;

  /// One solve with K, for b. Throws bad_input if the data do not fit (see
  /// contact::data::validate), or if K⁻¹f overflows.
  dual(Friction friction, held<Factorization> factor, data<S> const& c)
      : law_(friction),
        factor_(std::move(factor)),
        f_(detail::validated(friction, c, factor_.get().rows()).f),
        d_(c.d),
        B_(detail::stacked_constraints(c)),
        set_(detail::feasible_set(friction, c)),
        free_displacement_(f_.size()),
        b_(B_.rows()) {
    solve_once(f_, free_displacement_);
    check_range(free_displacement_);
    b_.noalias() = B_ * free_displacement_;
    detail::subtract_gaps(d_, b_, b_);
  }
  dual(dual const&) = delete;
  dual& operator=(dual const&) = delete;

  /// A = B K⁻¹ Bᵀ, never formed; by the condensed factor if the factorisation is a
  /// static_condensation.
  [[nodiscard]] auto a() const& { return a(B_); }
  auto a() const&& = delete;
  /// The same for another C in place of B, such as its rows in another order. Refers to C too.
  [[nodiscard]] auto a(sparse_type const& C) const& {
    if constexpr (requires { factor_.get().restricted(C); }) {
      return factor_.get().restricted(C);
    } else {
      return congruence(C, inverse(factor_.get()));
    }
  }
  auto a(sparse_type const&) const&& = delete;
  /// The dual problem; refers to this object. It has no minimum (status `unbounded`) exactly if no
  /// u satisfies N u ≤ d with (T u)ᵢ = 0 where gᵢ = ∞.
  [[nodiscard]] auto qp() const& { return separable_qp{a(), b_, set_}; }
  auto qp() const&& = delete;
  /// The linear term b = B K⁻¹ f − c.
  [[nodiscard]] vector_type const& b() const& { return b_; }
  vector_type const& b() const&& = delete;
  /// The feasible set Λ.
  [[nodiscard]] auto const& set() const& { return set_; }
  auto const& set() const&& = delete;
  /// The law of friction.
  [[nodiscard]] Friction friction() const { return law_; }
  /// B = [N; T].
  [[nodiscard]] sparse_type const& constraints() const& { return B_; }
  sparse_type const& constraints() const&& = delete;
  /// f.
  [[nodiscard]] vector_type const& load() const& { return f_; }
  vector_type const& load() const&& = delete;
  /// c − B u, c = (d, w): what is open, or slips, at displacements u. In exact arithmetic A λ − b
  /// for u = displacement(λ), but no difference of numbers larger than u. A node with an infinite
  /// gap, whose row of B is empty, has a positive entry.
  [[nodiscard]] vector_type openings(vector_type const& u) const {
    slant::detail::check_size("u", u.size(), f_.size());
    vector_type x = B_ * u;
    if (w_.size() > 0) x.tail(B_.rows() - d_.size()) -= w_;
    detail::subtract_gaps(d_, x, x);
    return -x;
  }
  /// λ = 0, the start that costs nothing.
  [[nodiscard]] vector_type zero() const { return vector_type::Zero(b_.size()); }

  /// u = K⁻¹ (f − Bᵀλ): one solve, performed only when asked for.
  [[nodiscard]] vector_type displacement(vector_type const& λ) const {
    slant::detail::check_size("lambda", λ.size(), b_.size());
    vector_type load = f_;
    load.noalias() -= B_.transpose() * λ;
    vector_type u(load.size());
    solve_once(load, u);
    return u;
  }

  /// New data; nothing is factored again. One solve with K if the step brings a load, none if that
  /// is a combination of the last two that were solved for, and no small difference of them, none
  /// without one. What qp() gave and what was made of that sees the new b and Λ; a method's state
  /// has to be told, by resume(state, x). Throws bad_input, as the constructor does, and is then
  /// unchanged; also if a gap becomes infinite or ceases to be, because B depends on that.
  void update(load_step<S> step) {
    detail::check_step(step, f_.size(), d_, B_);
    vector_type displacement(0), b(0);
    if (step.f) {
      if (known_.empty()) known_.add(f_, free_displacement_);
      displacement.resize(f_.size());
      if (!known_.combine(*step.f, displacement)) {
        solve_once(*step.f, displacement);
        check_range(displacement);
        known_.add(*step.f, displacement);
      }
    }
    if (step.f || step.d || step.w) {
      b.noalias() = B_ * (step.f ? displacement : free_displacement_);
      if (step.w || w_.size() > 0) b.tail(B_.rows() - d_.size()) -= step.w ? *step.w : w_;
      detail::subtract_gaps(step.d ? *step.d : d_, b, b);
      slant::detail::check_finite("b", b);
    }
    if (step.g) set_ = detail::feasible_set(law_, d_.size(), *step.g);
    // Nothing throws from here on.
    if (step.f) {
      f_.swap(*step.f);
      free_displacement_.swap(displacement);
    }
    if (step.d) d_.swap(*step.d);
    if (step.w) w_.swap(*step.w);
    if (b.size() > 0) b_.swap(b);
  }
  /// update with a new load alone: one solve with K at most.
  void update_load(vector_type f) { update({.f = std::move(f)}); }
  /// update with new gaps alone: no solve.
  void update_gaps(vector_type d) { update({.d = std::move(d)}); }
  /// update with new slip bounds alone: no solve.
  void update_bounds(vector_type g) { update({.g = std::move(g)}); }

 private:
  void solve_once(vector_type const& load, vector_type& u) const {
    slant::detail::solve_once(factor_.get(), load, u);
  }

  /// u without contact, about which the user has only f to look at.
  static void check_range(vector_type const& u) {
    for (index i = 0; i < u.size(); ++i) {
      if (!slant::detail::is_finite(u(i))) {
        throw bad_input("f",
                        "a load under which u[" + slant::detail::show(i) + "] of K u = f is " +
                            slant::detail::show(u(i)),
                        "displacements within the range of the scalar type");
      }
    }
  }

  [[no_unique_address]] Friction law_;
  held<Factorization> factor_;
  vector_type f_;
  vector_type d_;
  vector_type w_{};  // empty: 0
  sparse_type B_;
  detail::feasible_set_t<Friction, S> set_;
  vector_type free_displacement_;  // K⁻¹ f
  vector_type b_;
  detail::known_loads<vector_type> known_{};  // empty before the first new load
};

template <class Friction, class Factorization, class S>
dual(Friction, Factorization&&, data<S> const&) -> dual<Friction, kept_t<Factorization>, S>;

}  // namespace slant::contact
