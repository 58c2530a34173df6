// SPDX-License-Identifier: MIT
//
// Symmetric semismooth Newton method for a quadratic plus any separable convex function,
//
//     minimise   q(x) + φ(x),      q(x) = ½ xᵀA x − bᵀx,   r(x) = A x − b,
//
// globalised by the forward–backward envelope. It is Newton's method for
//
//     F(y) = y − prox_{ρφ}(z),     z = y − ρ r(y).
//
// With x = prox_{ρφ}(z), v = (z − x)/ρ ∈ ∂φ(x), G a slanting operator of the proximal map at z and
// Π, C as in methods/symmetric_newton.hpp, the step from x is
//
//     (Π A Π + C/ρ) t = −Π (r(x) + v),     t ∈ range(G).
//
// For a set Π v = 0, and this is the system there. For φ = g‖·‖ a block that sticks is fixed, and one
// that slides has C/ρ = (g/‖x‖)(I − n nᵀ), n = z/‖z‖.
//
//     x ← prox_{ρφ}(z), r ← A x − b                          one product
//     t and A t by conjugate gradients                       one product a step
//     y ← x + β t, β = 1, ½, … until E_γ has fallen          no product
//     y ← prox_{γφ}(y − γ r(y)) where no β is good enough    one product
//
// The envelope [Patrinos, Bemporad 2013; Themelis, Stella, Patrinos 2018, ZeroFPR]
//
//     E_γ(y) = q(y) + min_w  r(y)ᵀ(w − y) + ‖w − y‖²/(2γ) + φ(w)
//
// has the minimum and the minimisers of q + φ if γ ≤ α/σ_max, α < 1, and for w = prox_{γφ}(y − γ r(y))
// E_γ(w) ≤ E_γ(y) − (1 − α)/(2γ) ‖w − y‖². So the iteration converges from everywhere, and steps are
// full and superlinear near a solution with an invertible system. σ_max is not known: γ is made
// smaller where the gradients show more curvature, and, where ‖F‖ grows without end, on a step to w.
// ρ is another one and may be longer: it says how far off blocks change their states, and with a ρ
// of 1/σ_max the front of what slides and opens moves a node or two a step.
#pragma once

#include <slant/base/diagnosis.hpp>
#include <slant/base/held.hpp>
#include <slant/base/progress_watch.hpp>
#include <slant/base/report.hpp>
#include <slant/base/vector_algebra.hpp>
#include <slant/concepts/bad_input.hpp>
#include <slant/concepts/linear_operator.hpp>
#include <slant/concepts/proximable.hpp>
#include <slant/concepts/vector.hpp>
#include <slant/krylov/preconditioner.hpp>
#include <slant/krylov/spectrum.hpp>
#include <slant/methods/parts/curved_minimum.hpp>
#include <slant/methods/parts/gradient_point.hpp>
#include <slant/methods/proportioning.hpp>
#include <slant/newton/forcing.hpp>
#include <slant/operators/identity.hpp>
#include <slant/problems/quadratic_program.hpp>
#include <slant/sets/block_queries.hpp>
#include <slant/sets/curved_face.hpp>

#include <algorithm>
#include <concepts>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>

namespace slant {

/// min ½ xᵀA x − bᵀx + φ(x), A symmetric positive semidefinite, φ of blocks with slant(ρ, z); or over
/// a set of blocks with slant(x).
template <class QP>
concept envelope_newton_problem =
    composite_problem<QP> && psd_operator<typename QP::operator_type, typename QP::vector_type> &&
    has_block_slants<typename QP::set_type, local_t<typename QP::vector_type>>;

/// Options of envelope_newton and symmetric_newton; the defaults are those of README's tables.
template <class S = double>
struct symmetric_newton_options {
  /// ρ in x − P_Λ(x − ρ r), in units of 1/A; none: step_factor / mean(diag A).
  std::optional<S> step_length{};
  /// > 0, of the order 1. An undamped step leaves r = 0 on blocks that were free and x on its bound
  /// where it was fixed, so that signs decide what is free next and not ρ; damped steps mix the
  /// two. Measured on bricks (k = 4 … 16): ¼ and ½ alike, 1 up to a quarter more products. On the
  /// wire from zero, with A⁻¹ as preconditioner, 2 needs half of the steps that ½ needs.
  S step_factor = S(0.5);
  mean_diagonal_options mean_diagonal{};  ///< how mean(diag A) is estimated, if it is needed
  /// Inner accuracy. The exponent 3/2 makes the steps superlinear of that order; η_max is what a
  /// step deserves that will be shortened; with a goal the last step is not solved too well.
  eisenstat_walker forcing{.γ = 0.9, .exponent = 1.5, .η_max = 0.5, .η_first = 0.3};
  index inner_steps = 1000;  ///< conjugate gradient steps of one Newton step at most
  S sufficient = S(0.1);  ///< c in (0, 1): a step of length β lowers ‖F‖ by c β ‖F‖ at least
  /// Of envelope_newton with a preconditioner that knows faces: ‖x − x*‖_A, as ‖Π(r + v)‖_M
  /// estimates it, at which x is good enough; 0: never.
  S energy_goal = S(0);
  index halvings = 30;  ///< β = 1, ½, …: so often at most
  /// Steps in which ‖F‖ does not fall that mean stalled; of envelope_newton for a definite A steps in
  /// which neither ‖F‖ nor the envelope does.
  index patience = 100;
  kprgp_options<S> descent{.patience = 200};  ///< of the method that takes over where Newton fails

  [[gnu::cold]] void validate() const {
    if (step_length) detail::check_positive("step_length", *step_length);
    detail::check_positive("step_factor", step_factor);
    if (inner_steps < 1) throw bad_input("inner_steps", detail::show(inner_steps), "at least 1");
    detail::check_fraction("sufficient", sufficient);
    if (halvings < 0) throw bad_input("halvings", detail::show(halvings), "a number >= 0");
    if (patience < 0) throw bad_input("patience", detail::show(patience), "a number >= 0");
    mean_diagonal.validate();
    forcing.validate();
    descent.validate();
  }
};

namespace detail {

/// ρ of a state, `factor`/mean(diag A) if the options name none, and s = mean(diag M). What knows
/// the inverse on each face is not weighed against the curvature of its boundary. Not inlined:
/// g++ 12 would see *step_length read where there is none.
template <class QP, class M, class S, class State>
[[gnu::noinline]] void set_sizes(QP const& qp, M const& m, symmetric_newton_options<S> const& o,
                                 S const& factor, State& s) {
  using face = curved_face<S>;
  if (o.step_length) {
    s.step_length = *o.step_length;
  } else {
    auto const step = mean_step(qp.a(), s.x, factor, o.mean_diagonal);
    s.step_length = step.length;
    s.work.setup_applications += step.applications;
  }
  if constexpr (std::is_same_v<M, identity_operator> ||
                preconditions_faces<M, typename QP::vector_type, face>) {
    s.preconditioner_size = s.step_length / factor;
  } else {
    s.preconditioner_size = mean_diagonal(m, s.x, o.mean_diagonal).value;
  }
}

}  // namespace detail

/// State of envelope_newton: x = prox_{ρφ}(z) with its gradient r, computed from x, and its reduced
/// gradient (x − prox_{ρφ}(x − ρ r))/ρ; ρ is step_length.
template <class QP, class M>
struct envelope_newton_state : gradient_point<QP> {
  using typename gradient_point<QP>::vector_type;
  using typename gradient_point<QP>::scalar;

  vector_type y = this->x;               ///< Newton's iterate
  vector_type gradient = y;              ///< r(y), in multiples of unit
  vector_type z = y;                     ///< y − ρ r(y)
  curved_face<scalar> face;              ///< range(G) and C at z
  curved_minimum<vector_type, M> inner;  ///< the step t on it
  forcing_history<scalar> forcing{};     ///< errors and inner tolerances so far
  progress_watch<scalar> progress;       ///< looks for steps that get nowhere
  vector_type lowered = y;               ///< w = prox_{γφ}(y − γ r(y))
  vector_type base = y;                  ///< y before the step
  vector_type base_gradient = y;         ///< r(y) before the step

  scalar gradient_error{0};       ///< what rough products may have r(y) wrong by, in units
  scalar γ{0};                    ///< of the envelope, in units of 1/A
  scalar way{0};                  ///< ‖w − y‖
  scalar value{0};                ///< E_γ(y) / unit
  scalar value_noise{0};          ///< how far it may be off, by rounding or rough products
  scalar residual_norm{0};        ///< ‖F(y)‖/ρ, in units of the gradient
  scalar first_residual{0};       ///< that of the start
  scalar preconditioner_size{1};  ///< s = mean(diag M)
  scalar step_fraction{1};        ///< β of the last Newton step
  scalar energy_estimate{0};  ///< ‖Π(r + v)‖_M at x before the last step, about ‖x − x*‖_A
  bool at_projection = false;                         ///< x = prox_{ρφ}(z)
  bool roughly = multiplies_roughly<M, vector_type>;  ///< products of inner steps by M
  index inner_iterations = 0;                         ///< of the last Newton step
  index descents = 0;  ///< steps to w, where no Newton step was good enough
  index iteration = 0;
  slant::status status = slant::status::running;

  envelope_newton_state(QP const& qp, M const& m, vector_type const& x0)
      : gradient_point<QP>(qp, x0), face(function_of(qp)), inner(x0, qp.size(), m) {}

  /// What a status other than running means here.
  [[nodiscard, gnu::cold]] std::string reason() const {
    switch (status) {
      case slant::status::converged:
        return this->reduced_gradient_norm == scalar(0)
                   ? "the reduced gradient is zero: x is the solution"
                   : "the energy error is estimated at " + detail::brief(energy_estimate);
      case slant::status::stalled:
        return "no step lowers the residual any further at this precision: " + this->accuracy();
      case slant::status::breakdown:
        return "a number left the range of the scalar, or A is not semidefinite";
      default:
        return std::string(to_string(status));
    }
  }
};

/// The method at the top of this file: solve(envelope_newton{qp}, x0, reduced_gradient_below(1e-8) ||
/// at_most(100)); envelope_newton{qp, M} with a preconditioner M ≈ A⁻¹, options last. Begins at
/// prox(x0). Statuses of its own: converged (r̃ = 0, or energy_goal reached), stalled, breakdown. The
/// options `sufficient` and `descent` have no part here.
template <class QP, class M = identity_operator>
  requires envelope_newton_problem<std::remove_cvref_t<QP>> &&
           preconditioner_for<std::remove_cvref_t<M>, std::remove_cvref_t<QP>>
class envelope_newton : public detail::preconditioned_program<QP, M, symmetric_newton_options> {
  using base = detail::preconditioned_program<QP, M, symmetric_newton_options>;
  using base::qp_, base::m_, base::options_;

 public:
  using typename base::problem, typename base::preconditioner, typename base::vector_type,
      typename base::scalar;
  using state_type = envelope_newton_state<problem, preconditioner>;
  using base::base;

  /// The state of prox(x0). Throws bad_input if x0 or A x0 is not finite or of the wrong size, or if
  /// ρ is not a finite number.
  [[nodiscard]] state_type start(vector_type const& x0) const {
    detail::check_start_in_set(x0, qp_.get().b());
    state_type s(qp_.get(), m_.get(), x0);
    set_sizes(s);
    begin(s, s.begin(qp_.get(), x0));
    return s;
  }

  /// The state of prox_{ρφ}(z), z = z_of(ρ), of which the first step takes the face as it is and
  /// accepts what it finds: where a coarser problem has shown which blocks are held. Throws as
  /// start.
  template <class F>
    requires std::convertible_to<std::invoke_result_t<F const&, scalar const&>, vector_type>
  [[nodiscard]] state_type start_on_face(F const& z_of) const {
    state_type s(qp_.get(), m_.get(), qp_.get().b());
    set_sizes(s);
    vector_type const z = z_of(s.step_length);
    detail::check_start_in_set(z, qp_.get().b());
    begin(s, s.begin(qp_.get(), z));
    vectors::copy(z, s.z);
    s.value = detail::infinity<scalar>();
    s.at_projection = true;
    return s;
  }

  /// One Newton step.
  void step(state_type& s) const {
    if (s.status != status::running) return;
    if (!s.at_projection) advance(s);
    if (s.status == status::running) newton_step(s);
    ++s.iteration;
    // ‖F‖ may rise for a long time while E_γ falls, which it may do for ever where A is singular.
    constexpr bool bounded = declares_positive_definite<typename problem::operator_type>;
    auto const value = [&] {
      return std::pair(bounded ? s.value : detail::infinity<scalar>(), s.value_noise);
    };
    if (s.status == status::running &&
        s.progress.stalled(s.iteration, s.residual_norm, options_.patience, value, s.rounding())) {
      s.status = status::stalled;
    }
  }

  /// Goes on from s.x after b of the problem has changed. One product; no allocation.
  void resume(state_type& s) const {
    s.status = status::running;
    s.progress = {};
    scalar const size = norm(qp_.get().b());
    if (size > s.unit) s.unit = unit_near(size);
    s.size_of_b = size / s.unit;
    static_cast<void>(s.gradient_and_unit(qp_.get()));
    s.reduce(qp_.get());
    begin(s, false);
  }
  /// Goes on from s.x after φ has changed, and only φ. No product; no allocation.
  void adopt_function(state_type& s) const {
    s.status = status::running;
    s.progress = {};
    s.reduce(qp_.get());
    begin(s, false);
  }
  /// As start(x0), in a state that start has made, after b or φ of the problem have changed. x0 must
  /// not be s.x. One product; no allocation.
  void resume(state_type& s, vector_type const& x0) const {
    detail::check_start_in_set(x0, qp_.get().b());
    s.progress = {};
    s.iteration = s.inner_iterations = s.descents = 0;
    s.status = status::running;
    begin(s, s.begin_again(qp_.get(), x0));
  }

 private:
  /// ρ and γ in units of step_factor/mean(diag A). On bricks with friction a third of the steps that
  /// a ρ of one unit takes.
  static constexpr scalar long_step = scalar(4), short_step = scalar(0.5);
  static constexpr scalar share = scalar(0.95);  // α
  static constexpr scalar decrease = scalar(0.01);  // of E, in units of ‖w − y‖²/γ; < (1 − α)/2

  void set_sizes(state_type& s) const {
    detail::set_sizes(qp_.get(), m_.get(), options_, long_step * options_.step_factor, s);
    s.γ = s.step_length * (short_step / long_step);
  }

  void begin(state_type& s, bool solved) const {
    stay(s);
    s.first_residual = s.residual_norm;
    s.forcing = forcing_history<scalar>::starting_at(s.residual_norm);
    s.forcing.first_error = s.gradient_scale;
    detail::judge_reduced_gradient(s);
    if (solved) s.status = status::converged;
  }
  /// y = x, with its z, E and ‖F‖.
  void stay(state_type& s) const {
    vectors::copy(s.x, s.y);
    vectors::copy(s.r, s.gradient);
    s.gradient_error = scalar(0);
    project(s);
    evaluate(s);
    s.at_projection = false;
  }

  /// ρ per unit of the gradient: z = y − ρ r.
  static scalar ρ(state_type const& s) { return s.step_length * s.unit; }

  /// z, prox_{ρφ}(z) in s.projected, and ‖F(y)‖.
  void project(state_type& s) const {
    vectors::waxpy(-ρ(s), s.gradient, s.y, s.z);
    slant::project(s.step_of(qp_.get()), slant::local(s.z), slant::local(s.projected));
    vectors::difference(s.projected, s.y, s.trial);
    s.residual_norm = norm(s.trial) / s.step_length;
  }
  /// w and E_γ(y).
  void evaluate(state_type& s) const {
    auto const& b = qp_.get().b();
    vectors::waxpy(-(s.γ * s.unit), s.gradient, s.y, s.trial);
    slant::project(slant::at_step(function_of(qp_.get()), s.γ), slant::local(s.trial),
                   slant::local(s.lowered));
    vectors::difference(s.lowered, s.y, s.trial);
    s.way = norm(s.trial);
    scalar const near = s.way * (s.way / (s.γ * s.unit)) / scalar(2);
    scalar const steep = inner_product(s.gradient, s.trial);
    scalar const with_r = inner_product(s.y, s.gradient), with_b = inner_product(s.y, b) / s.unit;
    scalar extra(0);
    if constexpr (!quadratic_program<problem>) {
      extra = function_value(function_of(qp_.get()), slant::local(s.lowered)) / s.unit;
    }
    s.value = (with_r - with_b) / scalar(2) + steep + near + extra;
    scalar const size = norm(s.y), slope = norm(s.gradient);
    scalar const bent = extra < scalar(0) ? -extra : extra;
    s.value_noise = scalar(16) * detail::epsilon<scalar>() *
                        (size * (slope + s.size_of_b) + s.way * slope + near + bent) +
                    size * s.gradient_error;
  }

  /// r of x, whose predecessor y has the gradient s.gradient; whether γ had to become smaller for
  /// the curvature of q on the way.
  bool measure(state_type& s) const {
    scalar const before = s.unit;
    if (s.gradient_and_unit(qp_.get())) {
      vectors::scale(before / s.unit, s.gradient);
      s.gradient_error *= before / s.unit;
      s.value *= before / s.unit;
      s.value_noise *= before / s.unit;
      s.progress.forget_energy();
    }
    vectors::difference(s.x, s.y, s.trial);
    vectors::difference(s.r, s.gradient, s.reduced);
    scalar const way = norm(s.trial), bend = inner_product(s.trial, s.reduced);
    scalar const noise =
        scalar(16) * detail::epsilon<scalar>() * way *
            (norm(s.r) + norm(s.gradient) + s.size_of_b + norm(s.x) / (s.γ * s.unit)) +
        way * s.gradient_error;
    scalar const allowed = share * way * (way / (s.γ * s.unit));
    if (!(bend > allowed + noise)) return false;
    s.γ *= allowed / bend;
    s.progress.forget_energy();  // a shorter γ has higher values
    return true;
  }

  /// x = prox_{ρφ}(z) with r and r̃.
  void advance(state_type& s) const {
    std::swap(s.x, s.projected);
    if (measure(s) && detail::is_finite(s.value)) evaluate(s);
    s.reduce(qp_.get());
    s.at_projection = true;
    detail::judge_reduced_gradient(s);
  }

  /// Π (r + v) is the gradient on the face; v = (z − x)/ρ, which a set has normal to its faces.
  static vector_type const& force(state_type& s) {
    if constexpr (quadratic_program<problem>) {
      return s.r;
    } else {
      vectors::difference(s.z, s.x, s.trial);
      vectors::divide(ρ(s), s.trial);
      vectors::add(s.r, s.trial);
      return s.trial;
    }
  }

  /// Where A may be singular a face may hold motions that nothing resists: A + shift I resists them,
  /// with a shift that vanishes with ‖F‖ and leaves steps superlinear.
  static scalar shift(state_type const& s) {
    if constexpr (declares_positive_definite<typename problem::operator_type>) return scalar(0);
    scalar const left = s.residual_norm / s.forcing.first_error;
    return (left < scalar(1) ? left : scalar(1)) * scalar(0.01) / s.step_length;
  }

  void newton_step(state_type& s) const {
    auto const& qp = qp_.get();
    s.face.assign(s.step_of(qp), slant::local(s.z), s.preconditioner_size / s.step_length);
    scalar const target = s.forcing.next(options_.forcing) * s.residual_norm / s.unit;
    auto const minimise = [&] {
      return s.inner.minimise(qp.a(), s.a_workspace, m_.get(), force(s), s.face, s.step_length,
                              s.preconditioner_size, target, options_.inner_steps, scalar(0),
                              options_.energy_goal / s.unit, shift(s), s.roughly);
    };
    auto inner = minimise();
    // What is not seen of A may cost a step a part of what it gains, but not more.
    scalar const allowed = std::max<scalar>(target, s.residual_norm / s.unit / scalar(20));
    if (s.roughly && (!inner.finite || inner.flat || error_of_image(s) > allowed)) {
      multiply_exactly(s);
      s.work.inner_iterations += inner.iterations;
      s.work.operator_applications += inner.iterations;
      inner = minimise();
    }
    s.energy_estimate = inner.first_energy * s.unit;
    if (!note_inner(inner, s)) return;
    bool const asks = options_.energy_goal > scalar(0);
    if (asks && inner.iterations == 0 && s.energy_estimate <= options_.energy_goal) {
      s.energy_estimate = std::max<scalar>(s.energy_estimate, energy_of_release(s));
      if (s.energy_estimate <= options_.energy_goal) {
        s.status = status::converged;
        return;
      }
    }
    if (!shorten(s) || diverges(s)) {
      if (s.residual_norm <= s.rounding() && s.reduced_gradient_norm <= s.rounding()) {
        s.status = status::stalled;
        return;
      }
      multiply_exactly(s);  // rough products may have been why
      descend(s);
    }
    s.forcing.record(s.residual_norm);
    if (s.status == status::running) advance(s);
  }
  /// What a step of the length ρ gains from blocks that the face holds and the gradient at x does
  /// not: z is that of the point before.
  static scalar energy_of_release(state_type& s) {
    using std::sqrt;
    s.face.keep(s.reduced, s.trial);
    vectors::subtract(s.reduced, s.trial);
    return s.unit * sqrt(s.step_length) * norm(s.trial);
  }
  /// With a γ that is too long E_γ may fall without end, and ‖F‖ grows with every step. Nothing less
  /// is a reason to shorten γ: where cells differ in size by 1e4, short ones take a hundred times
  /// the steps.
  static bool diverges(state_type const& s) {
    return s.residual_norm > scalar(1e4) * std::max<scalar>(s.first_residual, s.rounding());
  }

  /// The longest β = 2⁻ʲ for which E_γ(x + β t) is low enough. Spends no product.
  bool shorten(state_type& s) const {
    scalar const value = s.value, residual = s.residual_norm;
    scalar const rough = error_of_image(s);
    scalar const noise = s.value_noise + rough * norm(s.x);
    scalar const enough = decrease * s.way * (s.way / (s.γ * s.unit));
    std::swap(s.y, s.base);
    std::swap(s.gradient, s.base_gradient);
    scalar β(1);
    for (index j = 0; j <= options_.halvings; ++j, β /= scalar(2)) {
      vectors::waxpy(β * s.unit, s.inner.t, s.x, s.y);
      vectors::waxpy(β, s.inner.image, s.r, s.gradient);
      s.gradient_error = β * rough;
      project(s);
      evaluate(s);
      // Where the values differ by rounding only, ‖F‖ decides.
      bool const level = s.value <= value + noise && s.residual_norm < residual / scalar(2);
      if (s.value <= value - enough || (noise >= enough && level)) {
        s.step_fraction = β;
        return true;
      }
    }
    return false;
  }

  /// From now on all products are by A itself.
  static void multiply_exactly(state_type& s) { s.roughly = false; }
  /// What A t may be off.
  static scalar error_of_image(state_type const& s) {
    if constexpr (multiplies_roughly<preconditioner, vector_type>) {
      if (s.roughly) return preconditioner::roughness * norm(s.inner.t) / s.γ;
    }
    return scalar(0);
  }

  /// y ← w of the y before the step, for a γ that fits the curvature of q on the way.
  void descend(state_type& s) const {
    constexpr index most = 100;  // of values of γ
    std::swap(s.y, s.base);
    std::swap(s.gradient, s.base_gradient);
    s.step_fraction = scalar(0);
    s.gradient_error = scalar(0);  // that of the step not taken
    ++s.descents;
    for (index k = 0; k < most; ++k) {
      evaluate(s);
      std::swap(s.x, s.lowered);
      if (!measure(s)) break;
    }
    if constexpr (!declares_positive_definite<typename problem::operator_type>) {
      // With a long ρ a face may be freer than A is stiff.
      s.step_length = std::max<scalar>(s.γ, s.step_length / scalar(2));
    }
    stay(s);
  }
};

template <class QP>
envelope_newton(QP&&, symmetric_newton_options<typename std::remove_cvref_t<QP>::scalar> = {})
    -> envelope_newton<kept_t<QP>>;
template <class QP, class M>
envelope_newton(QP&&, M&&, symmetric_newton_options<typename std::remove_cvref_t<QP>::scalar> = {})
    -> envelope_newton<kept_t<QP>, kept_t<M>>;

}  // namespace slant
