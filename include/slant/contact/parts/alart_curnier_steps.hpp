// SPDX-License-Identifier: MIT
//
// Newton's method for Coulomb's law written in displacements: the equation of Alart and Curnier
// (slanting/coulomb_law.hpp) as a proximal map whose slip bounds follow the pressures,
//
//     F(y) = y − prox_{ρφ(z)}(z),     z = y − ρ r(y),     gᵢ = Fᵢ λ_ν(z)ᵢ.
//
// With x = prox_{ρφ(z)}(z), range(G), Π and C as in methods/envelope_newton.hpp for these bounds,
// e = z_t/‖z_t‖, and c = ±Fᵢ such that −c r_p is the slip bound (in the coordinates of
// contact/primal.hpp), the step from x is
//
//     (L A Π + C/ρ) t = −L r(x),     t ∈ range(G),     (L s)_t = (Π s)_t − c e s_p
//
// at contacts that are closed and slide, L = Π elsewhere: friction follows the pressure that the
// step itself brings about. The system is not symmetric. BiCGSTAB solves it, with multigrid for
// Π A Π + C/ρ as preconditioner:
//
//     x ← prox_{ρφ(z)}(z), r ← A x − b                                        one product
//     t to a residual of η, but no better than the goal asks   two products and cycles a step
//     A t, y ← x + β t, β = 1, ½, … until ‖F‖ has fallen                      one product
//
// No energy is minimised and nothing is globalised: it begins where successive slip bounds
// (iterated_coulomb.hpp) have come, and ends where no β is good. From there steps are superlinear.
#pragma once

#include <slant/base/report.hpp>
#include <slant/base/vector_algebra.hpp>
#include <slant/concepts/linear_operator.hpp>
#include <slant/concepts/vector.hpp>
#include <slant/contact/primal.hpp>
#include <slant/krylov/bicgstab.hpp>
#include <slant/krylov/preconditioner.hpp>
#include <slant/multilevel/multigrid.hpp>
#include <slant/newton/forcing.hpp>
#include <slant/problems/quadratic_program.hpp>
#include <slant/sets/curved_face.hpp>
#include <slant/sets/proximal_step.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

namespace slant::contact::detail {

/// Where a contact is closed and slides: s_q ← s_q − first s_p, and the same `stride` further with
/// `second` in space.
template <class S>
struct sliding_contact {
  index p, q, stride;
  S first, second;
};

/// L A Π + C/ρ on range(G); `roughly`: with A as multigrid knows it, in short numbers.
template <class A, class S>
class sliding_system {
 public:
  using vector_type = Eigen::VectorX<S>;

  sliding_system(A const& a, slant::multigrid<S> const& M, curved_face<S> const& face,
                 std::vector<sliding_contact<S>> const& sliding, bool const& roughly, S const& ρ)
      : a_(&a), m_(&M), face_(&face), sliding_(&sliding), roughly_(&roughly), weight_(S(1) / ρ) {}

  [[nodiscard]] index rows() const { return m_->rows(); }
  [[nodiscard]] index cols() const { return m_->rows(); }
  [[nodiscard]] auto workspace(vector_type const& x) const {
    return workspace_of{x, slant::workspace(*a_, x), m_->workspace(x)};
  }
  template <class W>
  void apply(vector_type const& t, vector_type& y, W& w) const {
    if (*roughly_) {
      m_->multiply_roughly(t, w.image, w.of_m);
    } else {
      slant::apply(*a_, t, w.image, w.of_a);
    }
    keep_sliding(w.image, y);
    face_->add_curvature(weight_, t, y);
  }
  /// y = L s; s is scratch afterwards.
  void keep_sliding(vector_type& s, vector_type& y) const {
    for (auto const& c : *sliding_) {
      s[c.q] -= c.first * s[c.p];
      if (c.stride != 0) s[c.q + c.stride] -= c.second * s[c.p];
    }
    face_->keep(s, y);
  }

 private:
  struct workspace_of {
    vector_type image;
    workspace_t<A, vector_type> of_a;
    workspace_t<slant::multigrid<S>, vector_type> of_m;
  };

  A const* a_;
  slant::multigrid<S> const* m_;
  curved_face<S> const* face_;
  std::vector<sliding_contact<S>> const* sliding_;
  bool const* roughly_;
  S weight_;
};

/// Multigrid on the face that its workspace has entered.
template <class S>
class inverse_on_face {
 public:
  using vector_type = Eigen::VectorX<S>;

  explicit inverse_on_face(slant::multigrid<S> const& M) : m_(&M) {}
  [[nodiscard]] index rows() const { return m_->rows(); }
  [[nodiscard]] index cols() const { return m_->rows(); }
  [[nodiscard]] auto workspace(vector_type const& x) const { return m_->workspace(x); }
  template <class W>
  void apply(vector_type const& x, vector_type& y, W& w) const {
    m_->apply_on_face(x, y, w);
  }

 private:
  slant::multigrid<S> const* m_;
};

/// The method at the top of this file, with coefficients F.
template <class S>
class alart_curnier_steps {
  using qp_type = decltype(std::declval<primal<S> const&>().qp());
  using operator_type = typename qp_type::operator_type;
  using system_type = sliding_system<operator_type, S>;
  using solver_type =
      bicgstab<system_type const&, Eigen::VectorX<S> const&, inverse_on_face<S> const&>;

 public:
  using vector_type = Eigen::VectorX<S>;

  /// qp is that of the problem, M multigrid for its matrix. Refers to all but ρ; not movable.
  alart_curnier_steps(primal<S>& problem, qp_type const& qp, slant::multigrid<S> const& M,
                      vector_type const& F, S const& ρ)
      : problem_(&problem),
        qp_(&qp),
        F_(&F),
        ρ_(ρ),
        y_(problem.zero()),
        face_(function_of(qp)),
        m_(&M),
        system_(qp.a(), M, face_, sliding_, roughly_, ρ),
        inverse_(M),
        solver_(system_, load_, inverse_),
        inner_(solver_.start(y_)) {
    sliding_.reserve(static_cast<std::size_t>(F.size()));
  }
  alart_curnier_steps(alart_curnier_steps const&) = delete;
  alart_curnier_steps& operator=(alart_curnier_steps const&) = delete;

  /// Of all runs so far.
  [[nodiscard]] index steps() const { return steps_; }

  /// At most `most` steps from x with its gradient r, in multiples of unit, until x is about as
  /// near as `goal` in the energy norm: whether it is. Else x is where ‖F‖ was least, as it came if
  /// no step was good. Inner products `roughly` or not; `spent` grows. Changes the slip bounds of the
  /// problem. Allocates where a face has nodes that no face had before.
  [[nodiscard]] bool run(vector_type& x, vector_type const& r, S const& unit, bool roughly,
                         S const& goal, index most, work& spent) {
    using std::sqrt;
    unit_ = unit;
    roughly_ = roughly;
    vectors::copy(x, y_);
    vectors::copy(r, gradient_);
    S residual = project(), expected = std::numeric_limits<S>::infinity();
    if (residual == S(0)) return true;
    vectors::copy(projected_, base_);
    bool was_slow = false;
    auto history = forcing_history<S>::starting_at(residual);
    for (index k = 0; k < most; ++k) {
      ++steps_;
      find_gradient(spent);
      see_face();
      // A step that reaches the goal is not solved any better.
      S const η = std::max<S>(history.next(forcing), goal / expected / S(4));
      if (!solve_system(η, spent)) return false;
      S const square = inner_product(inner_.x, image_);
      S const size = square > S(0) ? S(unit_ * sqrt(square)) : S(0);
      S β(1), shorter = advance(β);
      for (; !(shorter <= (S(1) - β / S(10)) * residual); shorter = advance(β)) {
        β /= S(2);
        if (β < S(0.1)) return false;
      }
      vectors::copy(projected_, base_);
      vectors::copy(projected_, x);
      // What is left of a full step is the part of it that is left of F.
      expected = β < S(1) ? size : S(size * (shorter / residual));
      if (expected <= goal) return true;
      bool const is_slow = shorter > residual / S(2);
      if (is_slow && was_slow) return false;
      was_slow = is_slow;
      residual = shorter;
      history.record(residual);
    }
    return false;
  }

 private:
  static constexpr index inner_steps = 10;

  /// z, the bounds there, prox_{ρφ(z)}(z), and ‖F(y)‖.
  [[nodiscard]] S project() {
    vectors::waxpy(-(ρ_ * unit_), gradient_, y_, z_);
    problem_->pressures(y_, gradient_, ρ_ * unit_, λ_);
    λ_ *= unit_;
    λ_.array() *= F_->array();
    problem_->set_slip_bounds(λ_);
    slant::project(slant::at_step(function_of(*qp_), ρ_), z_, projected_);
    vectors::difference(projected_, y_, load_);
    return slant::norm(load_);
  }
  /// y = x + β t, and ‖F(y)‖.
  [[nodiscard]] S advance(S const& β) {
    vectors::waxpy(β * unit_, inner_.x, base_, y_);
    vectors::waxpy(β, image_, r_, gradient_);
    return project();
  }
  void find_gradient(work& spent) {
    slant::apply(qp_->a(), base_, r_, a_workspace_);
    ++spent.operator_applications;
    vectors::subtract(qp_->b(), r_);
    vectors::divide(unit_, r_);
  }
  void see_face() {
    face_.assign(slant::at_step(function_of(*qp_), ρ_), z_, S(1));
    sliding_.clear();
    bool const in_space = problem_->surface().tangents() == 2;
    for (auto const& c : problem_->surface().contacts()) {
      S const excess = z_[c.p] - std::clamp<S>(z_[c.p], c.gap.lower(), c.gap.upper());
      if (excess == S(0) || !(c.g > S(0))) continue;
      index const stride = in_space ? c.stride : 0;
      S const first = z_[c.q], second = in_space ? z_[c.q + stride] : S(0);
      using std::hypot;
      S const length = hypot(first, second);
      if (!(length > ρ_ * c.g)) continue;
      S const coefficient = c.g / (excess / ρ_);
      sliding_.push_back(
          {c.p, c.q, stride, coefficient * (first / length), coefficient * (second / length)});
    }
  }
  /// t in inner_.x and A t, in multiples of unit; whether BiCGSTAB has come as far as η.
  [[nodiscard]] bool solve_system(S const& η, work& spent) {
    vectors::negate(r_, image_);
    system_.keep_sliding(image_, load_);
    enter_face(*m_, face_, S(1) / ρ_, inner_.m_workspace);
    vectors::set_zero(inner_.x);
    solver_.restart(inner_);
    S const target = η * inner_.residual_norm;
    while (inner_.residual_norm > target && inner_.iteration < inner_steps &&
           inner_.status == status::running) {
      solver_.step(inner_);
    }
    spent.inner_iterations += inner_.work.operator_applications;
    spent.operator_applications += inner_.work.operator_applications + 1;
    slant::apply(qp_->a(), inner_.x, image_, a_workspace_);
    return inner_.residual_norm <= target;
  }

  primal<S>* problem_;
  qp_type const* qp_;
  vector_type const* F_;
  S ρ_, unit_{1};
  index steps_ = 0;
  bool roughly_ = true;
  vector_type y_;
  vector_type base_ = y_;  // x, whether or not ‖F‖ has fallen
  vector_type r_ = y_, gradient_ = y_, z_ = y_, projected_ = y_, image_ = y_, load_ = y_;
  vector_type λ_ = *F_;
  workspace_t<operator_type, vector_type> a_workspace_ = slant::workspace(qp_->a(), y_);
  curved_face<S> face_;
  std::vector<sliding_contact<S>> sliding_{};
  slant::multigrid<S> const* m_;
  system_type system_;
  inverse_on_face<S> inverse_;
  solver_type solver_;
  typename solver_type::state_type inner_;
  static constexpr eisenstat_walker forcing{
      .γ = 0.9, .exponent = 1.5, .η_max = 0.1, .η_first = 0.1};
};

}  // namespace slant::contact::detail
