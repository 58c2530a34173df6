// SPDX-License-Identifier: MIT
//
// What interior_point needs besides its step: the sizes and the start taken from the data, and the
// judgement of a trial point.
#pragma once

#include <slant/concepts/checks.hpp>
#include <slant/concepts/distributed.hpp>
#include <slant/concepts/vector_algebra.hpp>
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

  /// x, which is P_Λ(0), becomes P_Λ(x0) unless q is larger there: far from everything the method
  /// would have to find its forces anew on the way. One product, none if the two are the same.
  void choose_start(state_type& s, vector_type const& x0) const {
    auto const& qp = qp_.get();
    slant::project(qp.set(), slant::local(x0), slant::local(s.projected));
    vectors::difference(s.projected, s.x, s.trial);
    if (norm(s.trial) == scalar(0)) return;
    // q(P_Λ(x0)) − q(x) = dᵀ(r + ½ A d), d the way there.
    slant::apply(qp.a(), s.trial, s.reduced, s.a_workspace);
    ++s.work.setup_applications;
    check_finite("A x0", s.reduced);
    vectors::waxpy(scalar(1) / (scalar(2) * s.unit), s.reduced, s.r, s.reduced);
    if (!(inner_product(s.trial, s.reduced) > scalar(0))) s.x = s.projected;
  }

  /// ν_i z_i = ϑ at x.
  void begin(state_type& s, scalar const& force, scalar const& length) const {
    auto const& qp = qp_.get();
    s.gradient(qp);
    check_finite("A x0 - b", s.r);
    s.reduce(qp);
    static_cast<void>(s.barrier.slacks(blocks(), s.x, s.slacks));
    count(s);
    slant::local(s.products) =
        slant::local(s.counted).cwiseProduct(slant::local(s.slacks).cwiseMin(length));
    scalar const ϑ = s.degree > scalar(0)
                         ? scalar(force * inner_product(s.products, s.counted) / s.degree)
                         : scalar(0);
    slant::local(s.multipliers) =
        slant::local(s.smooth).cwiseProduct((ϑ / slant::local(s.slacks).array()).matrix());
    vectors::scale(ϑ, s.counted, s.products);
    s.measure = ϑ;
    s.first_measure = ϑ;
    s.infeasible = scalar(1);
    s.least = ϑ;
    s.pairs.begin(blocks(), s.x, s.barrier.per_unit(), ϑ);
    estimate_multipliers(s);
    s.barrier.linearise(blocks(), s.x);
    set_lagrangian(s, s.r, s.multipliers, scalar(0));
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
    vectors::sum(s.multipliers, s.multiplier_step, s.trial_multipliers);
    s.pairs.growth(blocks(), [&](index row, scalar const& factor) {
      slant::local(s.trial_multipliers).coeffRef(row) =
          factor * slant::local(s.multipliers).coeff(row);
    });
    scalar const growth = norm(s.trial_multipliers) / norm(s.multipliers);
    if (!(growth > options_.raise_above) || !is_finite(growth) ||
        options_.raise_above * way_out(s, s.step) > scalar(1)) {
      return false;
    }
    vectors::scale(growth, s.multipliers);
    vectors::scale(growth, s.products);
    s.pairs.raise(growth);
    s.measure *= growth;
    s.first_measure = s.measure / s.infeasible;
    s.least *= growth;
    set_lagrangian(s, s.r, s.multipliers, scalar(0));
    ++s.raises;
    return true;
  }

  /// Which rows are counted, and which of them have a multiplier of their own.
  void count(state_type& s) const {
    auto& counted = slant::local(s.counted);
    counted = (s.barrier.per_unit().array() > scalar(0)).template cast<scalar>().matrix();
    s.constraints = static_cast<index>(inner_product(s.counted, s.counted) + scalar(0.5));
    vectors::copy(s.counted, s.smooth);
    s.pairs.visit(blocks(), [&](auto const& block, auto const&, auto const& at) {
      constexpr int k = detail::inequalities_of<std::remove_cvref_t<decltype(block)>>;
      for (int i = 0; i < k; ++i) {
        slant::local(s.smooth).coeffRef(at.row + i) = scalar(0);
        if (i > 0) counted.coeffRef(at.row + i) = scalar(0);
      }
    });
    s.degree = inner_product(s.counted, s.counted);
  }

  /// The multipliers of the inequalities of pairs: y_0/(2 p_0) of the first, next to none of the
  /// one that tells the two halves of a cone apart.
  void estimate_multipliers(state_type& s) const {
    auto& ν = slant::local(s.multipliers);
    auto const& z = slant::local(s.slacks);
    s.pairs.visit_bound(blocks(), [&](auto const& block, auto const& place, auto const& at) {
      constexpr int k = detail::inequalities_of<std::remove_cvref_t<decltype(block)>>;
      ν.coeffRef(at.row) = s.pairs.multiplier(block, place, at, s.x) / s.barrier.per_unit()(at.row);
      for (int i = 1; i < k; ++i) ν.coeffRef(at.row + i) = s.measure / z.coeff(at.row + i);
    });
  }

  /// ∇L = gradient + G ν − Σ Tᵀ(y + αΔy), G as it stands.
  void set_lagrangian(state_type& s, vector_type const& gradient, vector_type const& ν,
                      scalar const& α) const {
    vectors::copy(gradient, s.lagrangian);
    vectors::multiply(s.smooth, ν, s.row_scratch);
    s.barrier.jacobian().apply_adjoint_add(scalar(1), s.row_scratch, s.lagrangian);
    s.pairs.subtract_forces(blocks(), α, s.lagrangian);
    s.barrier.keep_fixed(s.lagrangian);
    s.lagrangian_norm = norm(s.lagrangian);
  }

  /// The smallest of the counted products of rows without a pair, on this process.
  static scalar least_product(state_type const& s) {
    scalar least = infinity;
    auto const& smooth = slant::local(s.smooth);
    for (index i = 0; i < index(smooth.size()); ++i) {
      scalar const& product = slant::local(s.products).coeff(i);
      if (smooth.coeff(i) > scalar(0) && !(product >= least)) least = product;
    }
    return least;
  }

  /// sup{α : x + α d ∈ Λ} on all processes.
  scalar way_out(state_type const& s, vector_type const& d) const {
    return slant::minimum(s.x,
                          scalar(blocks().step_to_boundary(slant::local(s.x), slant::local(d))));
  }

  /// The point at the fraction α of the step: 1 if it will do, else the factor that shortens α.
  scalar judge(state_type& s, scalar const& α) const {
    vectors::waxpy(α, s.step, s.x, s.trial);
    vectors::waxpy(α, s.multiplier_step, s.multipliers, s.trial_multipliers);
    bool inside = s.barrier.slacks(blocks(), s.trial, s.trial_slacks) ||
                  (draw_inside(s), s.barrier.slacks(blocks(), s.trial, s.trial_slacks));
    slant::local(s.products) = slant::local(s.smooth)
                                   .cwiseProduct(slant::local(s.trial_multipliers))
                                   .cwiseProduct(slant::local(s.trial_slacks));
    scalar least = least_product(s);
    inside = inside && s.pairs.judge(blocks(), s.trial, α, s.products, least);
    if (!slant::everywhere(s.x, inside)) return options_.shorten_centred;
    if (s.constraints == 0) return scalar(1);
    scalar const measure = inner_product(s.products, s.counted) / s.degree;
    if (!(slant::minimum(s.x, least) >= options_.closeness * measure)) {
      return options_.shorten_centred;
    }
    scalar const fall = scalar(1) - α * options_.sufficient * (scalar(1) - s.centring);
    scalar const due = (scalar(1) - α) * s.infeasible * s.first_measure;
    if (!(measure <= std::max<scalar>(fall * s.measure, options_.grow * due)))
      return options_.shorten_measure;
    if (!(measure >= options_.ahead * due)) {
      return options_.shorten_residual;
    }
    s.barrier.linearise(blocks(), s.trial);
    vectors::waxpy(α, s.inner.image, s.r, s.rhs);
    set_lagrangian(s, s.rhs, s.trial_multipliers, α);
    if (!(s.lagrangian_norm <= s.residual_bound * measure)) return options_.shorten_residual;
    s.trial_measure = measure;
    s.trial_least = slant::minimum(s.x, least);
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
