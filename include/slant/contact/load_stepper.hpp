// SPDX-License-Identifier: MIT
//
// One load step after the other, by any method for the dual problem.
//
//     update     f, d, g of the step                          at most one solve with K, for f
//     predict    where q is least on the line through the
//                last two solutions                           no product
//     start      there, or at the last solution if that has
//                a smaller q in Λ                             one or two products
//     solve      from there, until the rule fires
//
// Nothing is factored, and what the method learnt about A in its first step stays: σ_max, mean(diag
// A), step lengths, all memory. A method takes part by
//
//     resume(state, x0)      start(x0) in a state that it has made, after b or Λ have changed
//
// one without it (interior_point) makes a new state in every step. The prediction needs the
// gradient as states of projected gradient methods keep it, x, r and unit; else the last solution
// is the start.
#pragma once

#include <slant/base/held.hpp>
#include <slant/concepts/bad_input.hpp>
#include <slant/concepts/convex_set.hpp>
#include <slant/concepts/vector.hpp>
#include <slant/contact/contact_data.hpp>
#include <slant/iteration/solve.hpp>

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include <concepts>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>

namespace slant::contact {

// --- load step -----------------------------------------------------------------------------------
//
// What changes from one load step to the next: f or c = (d, w) in b = B K⁻¹ f − c, and g in Λ; only
// f takes a solve with K. K, N and T stay, and with them A = B K⁻¹ Bᵀ, its factors, its bounds and
// everything else that was learnt about it.
//
// w is where the contact nodes stood when friction began to act: Σ gᵢ‖(T u)ᵢ − wᵢ‖ instead of
// Σ gᵢ‖(T u)ᵢ‖. In a quasi-static sequence friction resists the increment of a step, so w is T u of
// the step before; it is 0 until it is given.

/// New data of a contact problem, of the sizes and with the meaning they have in contact::data.
/// What is not given stays: load_step<>{.f = 2 * f}.
template <class S = double>
struct load_step {
  using vector_type = Eigen::VectorX<S>;

  std::optional<vector_type> f{};  ///< load
  std::optional<vector_type> d{};  ///< gaps; infinite exactly where they have been
  std::optional<vector_type> g{};  ///< slip bounds
  std::optional<vector_type> w{};  ///< tangential positions without friction, one per row of T
};

namespace detail {

/// Throws bad_input, as contact::data::validate does, unless the step fits a problem of n_u
/// unknowns with the gaps d and B = [N; T].
template <class S>
void check_step(load_step<S> const& step, index unknowns, Eigen::VectorX<S> const& d,
                Eigen::SparseMatrix<S> const& B) {
  if (step.f) {
    slant::detail::check_size("f", step.f->size(), unknowns, "one load per unknown,");
    slant::detail::check_finite("f", *step.f);
  }
  if (step.d) {
    check_gaps(*step.d, d.size());
    for (index i = 0; i < d.size(); ++i) {
      bool const closes = slant::detail::is_finite(d(i));
      if (slant::detail::is_finite((*step.d)(i)) == closes) continue;
      throw bad_input("d", slant::detail::show((*step.d)(i)),
                      closes ? "a finite number, since this gap was finite when B was made"
                             : "+inf, since this gap was infinite when B was made")
          .at(i);
    }
    check_reach(B, *step.d);
  }
  if (step.g) check_slip_bounds(*step.g, d.size(), B.rows() > d.size());
  if (step.w) {
    slant::detail::check_size("w", step.w->size(), B.rows() - d.size(), "one per row of T,");
    slant::detail::check_finite("w", *step.w);
  }
}

// --- solution line -------------------------------------------------------------------------------
//
// Where the next load step starts. λ_k, λ_{k−1} solve the last two steps, d = λ_k − λ_{k−1}; b is
// new. On the line through them
//
//     q(λ_k + τ d) = q(λ_k) + τ dᵀ(A λ_k − b) + ½ τ² dᵀA d
//
// has its minimum at τ = −dᵀ(A λ_k − b) / dᵀA d, and since A λ_k and A λ_{k−1} are known from the
// gradients there, finding it takes no product. That point is as good as the last solution (τ = 0)
// and as the extrapolated one (τ = 1), if blocks at their bounds do not make it leave Λ. Before the
// first solution stands 0: what is proportional to the load is found exactly.
//
// Measured on bricks (k = 8, twenty steps, three scenes): 41 to 70 products a step from here, 42 to
// 72 from τ = 1, 81 to 97 from the last solution. Rejected: the minimum over more directions (the
// last three solutions, or more), which is better for q and worse for the bounds: a tenth to a
// third more products.

/// The last two solutions with their images by A.
template <class V>
class solution_line {
 public:
  using scalar = scalar_t<V>;

  /// For vectors of n entries; both solutions are 0.
  explicit solution_line(index n)
      : last_(V::Zero(n)), before_(V::Zero(n)), A_last_(V::Zero(n)), A_before_(V::Zero(n)) {}

  [[nodiscard]] V const& last() const { return last_; }

  /// A new solution x with its gradient r = A x − b, in multiples of unit.
  void record(V const& x, V const& r, scalar const& unit, V const& b) {
    std::swap(last_, before_);
    std::swap(A_last_, A_before_);
    last_ = x;
    A_last_ = unit * r + b;
  }

  /// The same without a gradient: there is no line then.
  void record(V const& x) { last_ = x; }

  /// q at the last solution for this b.
  [[nodiscard]] scalar energy(V const& b) const {
    return last_.dot(A_last_) / scalar(2) - last_.dot(b);
  }

  /// The point of least energy in x; false, and the last solution, where there is no line.
  bool minimum(V const& b, V& x) const {
    scalar const curvature = (last_ - before_).dot(A_last_ - A_before_);
    scalar const slope = (last_ - before_).dot(A_last_ - b);
    scalar const τ = -slope / curvature;
    bool const line = curvature > scalar(0) && slant::detail::is_finite(τ);
    x = last_;
    if (line) x += τ * (last_ - before_);
    return line;
  }

 private:
  V last_, before_, A_last_, A_before_;
};

/// The state keeps its gradient as methods/parts/gradient_point.hpp does.
template <class State, class V>
concept keeps_gradient = requires(State const& s, V const& v) {
  { s.x } -> std::convertible_to<V const&>;
  { s.r } -> std::convertible_to<V const&>;
  { s.unit* s.gradient_scale };
};

}  // namespace detail

// --- load stepper --------------------------------------------------------------------------------

/// One step of load_stepper. Refers to its state: what is to be kept beyond the next step has to be
/// copied.
template <class State>
struct load_step_report {
  index number;          ///< 1, 2, …
  slant::status status;  ///< how the step ended
  std::string reason;    ///< the same as a sentence
  slant::work work;      ///< of this step alone
  State const* state;    ///< the last state of the method

  /// The multipliers λ.
  [[nodiscard]] auto const& x() const { return state->x; }
  /// Number of steps of the method.
  [[nodiscard]] index iterations() const { return state->iteration; }
  /// True only if the accuracy asked for was reached.
  [[nodiscard]] bool converged() const { return status == slant::status::converged; }
};

/// Load steps of a problem, contact::dual:
///
///     contact::load_stepper stepper(problem, symmetric_newton{problem.qp()}, stop);
///     auto const& first = stepper.advance({});                 // the data that are there
///     auto const& next = stepper.advance({.f = 2 * f});
///
/// Refers to the problem, which it updates, and to the method if that is an lvalue; the method has
/// to be one of problem.qp(). Each step begins with a new copy of the rule.
template <class Dual, class Method, class Rule>
class load_stepper {
 public:
  using vector_type = typename Dual::vector_type;
  using scalar = scalar_t<vector_type>;
  using method_type = std::remove_cvref_t<Method>;
  using state_type = state_t<method_type const, vector_type>;
  using report_type = load_step_report<state_type>;
  static_assert(slant::detail::solvable<method_type const&, vector_type, Rule>,
                "load_stepper: expected a method for vectors like b, and a rule for its states");

  /// The first step starts from x0, or 0. Throws bad_input if that is of the wrong size.
  load_stepper(Dual& problem, held<Method> method, Rule stop,
               std::optional<vector_type> x0 = std::nullopt)
      : problem_(&problem),
        method_(std::move(method)),
        stop_(std::move(stop)),
        line_(problem.b().size()),
        start_(x0 ? std::move(*x0) : problem.zero()) {
    slant::detail::check_size("x0", start_.size(), problem.b().size(), "the size of b,");
  }

  /// Solves the next step. Throws bad_input, and has then done nothing, if dual::update refuses the
  /// data; numerical trouble is a status. A step that did not converge is not remembered: the one
  /// after it starts from those before.
  [[nodiscard]] report_type const& advance(load_step<scalar> step) {
    problem_->update(std::move(step));
    report_.work = {};
    begin();
    Rule stop = stop_;
    auto end = slant::detail::run_to_end(method_.get(), *state_, stop);
    ++report_.number;
    report_.status = end.how;
    report_.reason = std::move(end.why);
    report_.state = &*state_;
    if constexpr (requires { state_->work; }) report_.work += state_->work;
    if (report_.converged()) remember();
    return report_;
  }

 private:
  static constexpr bool predicts = detail::keeps_gradient<state_type, vector_type>;

  /// The state of the predicted point, or of the last solution where that turns out to be better.
  void begin() {
    if (!has_last_) {
      place(start_);
      return;
    }
    vector_type const& b = problem_->b();
    bool const predicted = predicts && line_.minimum(b, start_);
    if (!predicted) start_ = line_.last();
    place(start_);
    if constexpr (predicts) {
      if (!predicted) return;
      scalar const here = (state_->x.dot(state_->unit * state_->r) - state_->x.dot(b)) / scalar(2);
      // New slip bounds may have cut the last solution: its q is then a bound of nothing.
      slant::project(problem_->set(), line_.last(), start_);
      if (here <= line_.energy(b) || start_ != line_.last()) return;
      report_.work.operator_applications = state_->work.operator_applications;
      place(line_.last());
    }
  }

  void place(vector_type const& x) {
    if constexpr (has_resume_at<method_type, state_type, vector_type>) {
      if (state_) {
        method_.get().resume(*state_, x);
        return;
      }
    }
    state_.emplace(method_.get().start(x));
  }

  void remember() {
    has_last_ = true;
    if constexpr (predicts) {
      line_.record(state_->x, state_->r, state_->unit, problem_->b());
    } else {
      line_.record(state_->x);
    }
  }

  Dual* problem_;
  held<Method> method_;
  Rule stop_;
  detail::solution_line<vector_type> line_;
  vector_type start_;
  bool has_last_ = false;  // a solution, in line_; else steps start from start_
  std::optional<state_type> state_;
  report_type report_{0, status::running, {}, {}, nullptr};
};

template <class Dual, class Method, class Rule>
load_stepper(Dual&, Method&&, Rule, std::optional<typename Dual::vector_type> = std::nullopt)
    -> load_stepper<Dual, kept_t<Method>, Rule>;

}  // namespace slant::contact
