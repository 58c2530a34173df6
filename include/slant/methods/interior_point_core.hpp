// SPDX-License-Identifier: MIT
//
// What interior_point needs besides its step: the sizes and the start taken from the data, and the
// judgement of a trial point.
#pragma once

#include <slant/concepts/checks.hpp>
#include <slant/concepts/distributed.hpp>
#include <slant/methods/estimated_diagonal.hpp>
#include <slant/methods/interior_point_options.hpp>
#include <slant/methods/interior_point_state.hpp>
#include <slant/methods/recession.hpp>
#include <slant/operators/held.hpp>
#include <slant/operators/identity.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>
#include <utility>

namespace slant::detail {

/// Problem and options of interior_point, with its smaller steps; symbols as in interior_point.hpp.
template <class QP, class M>
class interior_point_core {
 public:
  using problem = std::remove_cvref_t<QP>;
  using vector_type = typename problem::vector_type;
  using scalar = typename problem::scalar;
  using options = interior_point_options<scalar>;
  using preconditioner = std::remove_cvref_t<M>;
  using state_type = interior_point_state<problem, preconditioner>;
  static constexpr bool preconditioned = !std::is_same_v<preconditioner, identity_operator>;

  interior_point_core(held<QP> qp, options o)
      : qp_(std::move(qp)), m_(identity_operator(qp_.get().size())), options_(std::move(o)) {
    options_.validate();
  }
  interior_point_core(held<QP> qp, held<M> m, options o)
      : qp_(std::move(qp)), m_(std::move(m)), options_(std::move(o)) {
    check_size("rows of the preconditioner", index(m_.get().rows()), qp_.get().size());
    check_size("columns of the preconditioner", index(m_.get().cols()), qp_.get().size());
    options_.validate();
  }

 protected:
  [[nodiscard]] auto const& blocks() const { return qp_.get().set(); }

  static constexpr scalar infinity = std::numeric_limits<scalar>::infinity();
  using column = Eigen::Array<scalar, Eigen::Dynamic, 1>;

  static scalar root(scalar const& v) {
    using std::sqrt;
    return sqrt(v);
  }

  /// D and α. Not inlined: g++ 12 would see *step_length read where there is none.
  [[gnu::noinline]] void set_diagonal(state_type& s) const {
    auto const& qp = qp_.get();
    auto const of_a = [&] {
      if constexpr (preconditioned) {
        static_cast<void>(
            estimate_diagonal(m_.get(), qp.set(), options_.mean_diagonal, s.diagonal, "M"));
        slant::local(s.diagonal) = slant::local(s.diagonal).cwiseInverse();
        return mean_diagonal(qp.a(), s.x, options_.mean_diagonal);
      } else {
        return estimate_diagonal(qp.a(), qp.set(), options_.mean_diagonal, s.diagonal);
      }
    };
    auto const mean = of_a();
    s.work.setup_applications += mean.applications;
    s.trace = mean.value * scalar(slant::global_size(s.x));
    if (options_.step_length) {
      s.step_length = *options_.step_length;
      return;
    }
    s.step_length = mean.value > scalar(0) ? scalar(scalar(0.5) / mean.value) : scalar(1);
    if (!(s.step_length > scalar(0)) || !is_finite(s.step_length)) {
      throw bad_input("A", "mean of the diagonal " + show(mean.value),
                      "one whose reciprocal is a finite number > 0");
    }
  }

  /// The length of the first projected gradient step with the best step length: that of what Λ does
  /// not bound. α, the step length of a typical direction, would be too short by far where A is ill
  /// conditioned and b is smooth. One product.
  scalar first_way(state_type& s) const {
    if (s.reduced_gradient_norm == scalar(0)) return scalar(0);
    slant::apply(qp_.get().a(), s.reduced, s.lagrangian, s.a_workspace);
    ++s.work.setup_applications;
    scalar const bend = inner_product(s.reduced, s.lagrangian);
    scalar const best = inner_product(s.reduced, s.reduced) / bend;
    bool const bent = bend > flatness(s.reduced, s.trace) && is_finite(best);
    return s.reduced_gradient_norm * (bent ? best : s.step_length);
  }

  /// ν_i z_i = ϑ at x.
  void begin(state_type& s, scalar const& force, scalar const& length) const {
    auto const& qp = qp_.get();
    s.gradient(qp);
    check_finite("A x0 - b", s.r);
    s.reduce(qp);
    auto const& live = s.barrier.per_unit().array();
    slant::local(s.row_scratch) = (live > scalar(0)).template cast<scalar>().matrix();
    scalar const count = inner_product(s.row_scratch, s.row_scratch);
    s.constraints = static_cast<index>(count + scalar(0.5));
    static_cast<void>(s.barrier.slacks(blocks(), s.x, s.slacks));
    slant::local(s.trial_slacks) =
        ((live > scalar(0)).template cast<scalar>() * slant::local(s.slacks).array().min(length))
            .matrix();
    scalar const ϑ = s.constraints > 0
                         ? scalar(force * inner_product(s.trial_slacks, s.row_scratch) / count)
                         : scalar(0);
    slant::local(s.multipliers) =
        (live > scalar(0))
            .select(ϑ / slant::local(s.slacks).array(), column::Zero(live.size()))
            .matrix();
    s.barrier.linearise(blocks(), s.x);
    set_lagrangian(s, s.r, s.multipliers);
    s.measure = ϑ;
    s.residual_bound =
        options_.residual_factor * std::max<scalar>(s.lagrangian_norm, s.gradient_scale / s.unit);
    if (s.constraints > 0) s.residual_bound /= ϑ;
    s.x_norm = norm(s.x);
    s.forcing = forcing_history<scalar>::starting_at(scalar(1));
    if (!is_finite(s.lagrangian_norm) || !is_finite(s.measure)) {
      s.status = status::breakdown;
    }
  }

  /// ν and ϑ of the size that the Newton step Δx, Δν asks for, if those at hand are too small by
  /// far: Δx leaves Λ almost at once, as no force holds it back. Whether they were.
  bool raise(state_type& s) const {
    if (s.constraints == 0 || s.under_way || s.raises == options_.raises) return false;
    slant::local(s.trial_multipliers) =
        slant::local(s.multipliers) + slant::local(s.multiplier_step);
    scalar const growth = norm(s.trial_multipliers) / norm(s.multipliers);
    if (!(growth > options_.raise_above) || !is_finite(growth) ||
        options_.raise_above * way_out(s, s.step) > scalar(1)) {
      return false;
    }
    slant::local(s.multipliers) *= growth;
    s.measure *= growth;
    set_lagrangian(s, s.r, s.multipliers);
    ++s.raises;
    return true;
  }

  /// ∇L = gradient + G ν, G as it stands.
  void set_lagrangian(state_type& s, vector_type const& gradient, vector_type const& ν) const {
    slant::local(s.lagrangian) = slant::local(gradient);
    s.barrier.jacobian().apply_adjoint_add(scalar(1), ν, s.lagrangian);
    s.barrier.keep_fixed(s.lagrangian);
    s.lagrangian_norm = norm(s.lagrangian);
  }

  /// min ν_i z_i over the constraints with a bound, on all processes.
  static scalar least_product(state_type const& s, vector_type const& ν, vector_type const& z) {
    scalar least = infinity;
    auto const& multiplier = slant::local(ν);
    auto const& slack = slant::local(z);
    for (index i = 0; i < index(multiplier.size()); ++i) {
      if (!(s.barrier.per_unit()(i) > scalar(0))) continue;
      scalar const product = multiplier.coeff(i) * slack.coeff(i);
      if (!(product >= least)) least = product;
    }
    return slant::minimum(s.x, least);
  }

  /// sup{α : x + α d ∈ Λ} on all processes.
  scalar way_out(state_type const& s, vector_type const& d) const {
    return slant::minimum(s.x,
                          scalar(blocks().step_to_boundary(slant::local(s.x), slant::local(d))));
  }

  /// The point at the fraction α of the step: 1 if it will do, else the factor that shortens α.
  scalar judge(state_type& s, scalar const& α) const {
    slant::local(s.trial) = slant::local(s.x) + α * slant::local(s.step);
    slant::local(s.trial_multipliers) =
        slant::local(s.multipliers) + α * slant::local(s.multiplier_step);
    bool const inside = s.barrier.slacks(blocks(), s.trial, s.trial_slacks) ||
                        (draw_inside(s), s.barrier.slacks(blocks(), s.trial, s.trial_slacks));
    if (!slant::everywhere(s.x, inside)) return options_.shorten_centred;
    if (s.constraints == 0) return scalar(1);
    scalar const measure =
        inner_product(s.trial_multipliers, s.trial_slacks) / scalar(s.constraints);
    if (!(least_product(s, s.trial_multipliers, s.trial_slacks) >= options_.closeness * measure)) {
      return options_.shorten_centred;
    }
    scalar const fall = scalar(1) - α * options_.sufficient * (scalar(1) - s.centring);
    if (!(measure <= fall * s.measure)) return options_.shorten_measure;
    s.barrier.linearise(blocks(), s.trial);
    slant::local(s.rhs) = slant::local(s.r) + α * slant::local(s.inner.image);
    set_lagrangian(s, s.rhs, s.trial_multipliers);
    if (!(s.lagrangian_norm <= s.residual_bound * measure)) return options_.shorten_residual;
    s.measure = measure;
    return scalar(1);
  }

  /// Blocks of the trial point that were rounded onto their boundary go back towards their middle,
  /// by rounding errors, so that A x is what it was.
  void draw_inside(state_type& s) const {
    slant::visit_blocks(blocks(), [&](auto const& block, auto const& place) {
      using block_type = std::remove_cvref_t<decltype(block)>;
      if constexpr (detail::inequalities_of<block_type> > 0) {
        auto const from = place.value(s.trial);
        auto const middle = place.value(s.centre);
        auto at = from;
        scalar back = scalar(2) * std::numeric_limits<scalar>::epsilon();
        while (!(block.inequality(at).maxCoeff() < scalar(0)) &&
               back < scalar(1024) * std::numeric_limits<scalar>::epsilon()) {
          at = from + back * (middle - from);
          back *= scalar(2);
        }
        place.put(s.trial, at);
      }
    });
  }

  held<QP> qp_;
  held<M> m_;
  options options_;
};

}  // namespace slant::detail
