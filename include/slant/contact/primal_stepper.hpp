// SPDX-License-Identifier: MIT
//
// One load step after the other by the displacements, K never factored:
//
//     contact::primal_stepper stepper(K, data, {.tolerance = 1e-8, .layout = layout});
//     auto const& first = stepper.advance({});                            // the data that are there
//     auto const& next = stepper.advance({.f = 2 * f, .w = T * first.u});  // friction on increments
//
// Levels of multigrid, step lengths and all memory stay. The first step starts from the same problem
// on the coarser levels, each other one on the line through the last two solutions, where the line
// through their loads is nearest to the new load. Rejected: where the energy of the body is least on
// that line, which knows nothing of what contact holds back (5 steps where nothing has changed).
#pragma once

#include <slant/certificates/energy_certificate.hpp>
#include <slant/concepts/bad_input.hpp>
#include <slant/contact/contact_data.hpp>
#include <slant/contact/friction_law.hpp>
#include <slant/contact/load_stepper.hpp>
#include <slant/contact/parts/iterated_run.hpp>
#include <slant/contact/solve_options.hpp>

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include <algorithm>
#include <optional>
#include <string>
#include <utility>

namespace slant::contact {

/// Refers to K. Not movable.
template <class S = double>
class primal_stepper {
 public:
  using vector_type = Eigen::Matrix<S, Eigen::Dynamic, 1>;
  using report_type = solution<S>;

  /// K: n × n, both triangles. Of the options `route`, `costs`, `scale`, `condensation` and `start`
  /// have no part. Throws bad_input for data that do not fit or options out of range; where
  /// displacements cannot be solved for, for the reason that contact::solve would give for factors;
  /// and for bodies that K leaves free,
  /// which options.layout tells.
  primal_stepper(Eigen::SparseMatrix<S> const& K, data<S> c, solve_options<S> options)
      : K_(&K), c_(std::move(c)), options_(std::move(options)) {
    options_.validate();
    detail::validated(law(), c_, K.rows());
    if (options_.prove) throw bad_input("prove", "true", "false, as a proof takes factors");
    options_.route = solution_route::iterate;
    auto const outlook = detail::outlook_of_iteration(K, c_, options_);
    if (outlook.refusal) {
      throw bad_input("N and T", *outlook.refusal,
                      "rows that displacements can be solved for with");
    }
    if (!outlook.floating.free.empty()) {
      throw bad_input("K", outlook.floating.free.front().text, "supports of every body");
    }
  }
  primal_stepper(primal_stepper const&) = delete;
  primal_stepper& operator=(primal_stepper const&) = delete;

  /// Solves the next step; the report is that of contact::solve, and stays until the one after it.
  /// `iterations` and `work` are of the step. Throws bad_input, and has then done nothing, for data
  /// that do not fit or a K that is found not to be definite; numerical trouble is a status. A step
  /// that did not converge is not remembered: the next one starts from those before.
  [[nodiscard]] report_type const& advance(load_step<S> step) {
    take(step);
    try {
      begin(step);
    } catch (bad_input const&) {
      exchange(step);
      throw;
    }
    detail::run_to_certified(law(), *run_, *certificate_, c_, options_, report_);
    if (report_.converged()) remember();
    return report_;
  }

 private:
  [[nodiscard]] friction_of_data law() const { return friction_of_data{c_.tangents()}; }

  /// The data of the step in place of those before, which it keeps.
  void exchange(load_step<S>& step) {
    if (step.f) c_.f.swap(*step.f);
    if (step.d) c_.d.swap(*step.d);
    if (step.g) c_.g.swap(*step.g);
    if (step.w) w_.swap(*step.w);
  }
  void take(load_step<S>& step) {
    if (step.w) {
      slant::detail::check_size("w", step.w->size(), c_.T.rows(), "one per row of T,");
      slant::detail::check_finite("w", *step.w);
    }
    exchange(step);
    try {
      c_.validate();
      slant::detail::check_size("f", c_.f.size(), K_->rows(), "the size of K,");
    } catch (bad_input const&) {
      exchange(step);
      throw;
    }
  }

  void begin(load_step<S> const& step) {
    if (!run_) {
      run_.emplace(*K_, c_, options_.layout, options_.multigrid, options_.max_steps, w_);
      certificate_.emplace(run_->qp(), run_->levels());
      report_.factorization = run_->levels().description();
      report_.choice.route = solution_route::iterate;
      report_.choice.reason = "iterated, as asked for";
      return;
    }
    run_->restart([&](primal<S>& p, vector_type& x) {
      if (step.w) p.set_positions(w_);
      if (step.f) p.set_load(c_.f);
      if (step.d) p.set_gaps(c_.d);
      if (step.g) p.set_slip_bounds(c_.g);
      x = predicted(whole_load());
      if (p.offset().size() > 0) x -= p.offset();
    });
  }

  /// Before the first solution stands 0, of the load 0.
  [[nodiscard]] vector_type predicted(vector_type const& f) const {
    if (v_.size() == 0) return vector_type::Zero(f.size());
    S const unit = unit_near(std::max<S>(way_of_f_.norm(), vector_type(f - f_).norm()));
    vector_type const way = way_of_f_ / unit;
    S const square = way.squaredNorm();
    S const τ = square > S(0) ? S(way.dot((f - f_) / unit) / square) : S(0);
    return v_ + τ * way_;
  }

  /// G⁻ᵀf.
  [[nodiscard]] vector_type whole_load() const {
    primal<S> const& p = run_->problem();
    vector_type b = run_->qp().b();
    if (p.offset().size() > 0) b += p.image_of_offset();
    return b;
  }
  void remember() {
    primal<S> const& p = run_->problem();
    vector_type v = run_->state().x, f = whole_load();
    if (p.offset().size() > 0) v += p.offset();
    bool const is_first = v_.size() == 0;
    way_ = is_first ? v : vector_type(v - v_);
    way_of_f_ = is_first ? f : vector_type(f - f_);
    v_ = std::move(v);
    f_ = std::move(f);
  }

  using run_type = detail::primal_run<S>;
  using certificate_type = decltype(energy_certificate(std::declval<run_type const&>().qp(),
                                                       std::declval<run_type const&>().levels()));

  Eigen::SparseMatrix<S> const* K_;
  data<S> c_;
  vector_type w_{};  // empty: 0
  solve_options<S> options_;
  std::optional<run_type> run_{};
  std::optional<certificate_type> certificate_{};
  vector_type v_{}, f_{};           // the last solution as G u, and G⁻ᵀf; empty: none
  vector_type way_{}, way_of_f_{};  // from those before
  report_type report_{};
};

template <class S>
primal_stepper(Eigen::SparseMatrix<S> const&, data<S>, solve_options<S>) -> primal_stepper<S>;
template <class S>
primal_stepper(Eigen::SparseMatrix<S> const&, data<S>) -> primal_stepper<S>;

}  // namespace slant::contact
