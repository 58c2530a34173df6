// SPDX-License-Identifier: MIT
//
// One load step after the other by the displacements, K never factored: with given slip bounds,
//
//     contact::primal_stepper stepper(K, data, {.tolerance = 1e-8, .layout = layout});
//     auto const& first = stepper.advance({});                            // the data that are there
//     auto const& next = stepper.advance({.f = 2 * f, .w = T * first.u});  // friction on increments
//
// or with Coulomb's law, where F is a coefficient for each contact:
//
//     contact::primal_coulomb_stepper stepper(K, data, F, {.tolerance = 1e-8, .layout = layout});
//
// Levels of multigrid, step lengths and all memory stay. The first step starts from the same problem
// on the coarser levels, each other one on the line through the last two solutions, where the line
// through their loads is nearest to the new load, as do pressures in Coulomb's law.
// Springs of bodies that contact alone holds end there. Rejected: where the energy of the body is
// least on that line, which knows nothing of what contact holds back (5 steps where nothing has
// changed).
#pragma once

#include <slant/base/entries.hpp>
#include <slant/base/scaling.hpp>
#include <slant/certificates/energy_certificate.hpp>
#include <slant/concepts/bad_input.hpp>
#include <slant/contact/certified_coulomb.hpp>
#include <slant/contact/contact_data.hpp>
#include <slant/contact/friction_law.hpp>
#include <slant/contact/load_stepper.hpp>
#include <slant/contact/parts/alart_curnier_steps.hpp>
#include <slant/contact/parts/iterated_coulomb.hpp>
#include <slant/contact/parts/iterated_run.hpp>
#include <slant/contact/solve_options.hpp>

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include <algorithm>
#include <optional>
#include <type_traits>
#include <utility>

namespace slant::contact::detail {

/// A primal_run that goes from one load step to the next. Refers to K; not movable.
template <class S>
class stepped_run {
 public:
  using vector_type = Eigen::VectorX<S>;
  using sparse_type = Eigen::SparseMatrix<S>;

  /// Of options with layout and multigrid; at most `most` steps of Newton's method in each.
  template <class Options>
  stepped_run(sparse_type const& K, data<S> c, Options const& o, index most)
      : c_(std::move(c)),
        layout_(o.layout),
        multigrid_(o.multigrid),
        most_(most),
        floating_(bodies_that_float(K, c_, o)),
        springs_(K, floating_, layout_.dimension()) {}

  [[nodiscard]] friction_of_data law() const { return friction_of_data{c_.tangents()}; }
  [[nodiscard]] data<S> const& scene() const { return c_; }
  [[nodiscard]] vector_type const& positions() const { return w_; }
  [[nodiscard]] free_motions<S> const& floating() const { return floating_; }
  [[nodiscard]] primal_run<S>& run() { return *run_; }
  [[nodiscard]] moving_springs<S>& springs() { return springs_; }
  [[nodiscard]] auto& certificate() { return *certificate_; }

  /// Begins the step. Throws bad_input, and has then done nothing, for data that do not fit or a K
  /// that is found not to be definite.
  void begin(load_step<S> step) {
    if (step.w) {
      slant::detail::check_size("w", step.w->size(), c_.T.rows(), "one per row of T,");
      slant::detail::check_finite("w", *step.w);
    }
    exchange(step);
    try {
      c_.validate();
      slant::detail::check_size("f", c_.f.size(), springs_.held().rows(), "the size of K,");
      if (certificate_) {
        go_on(step);
      } else {
        // After a step that was cut off: springs begin where the new run does.
        if (springs_.size() > S(0)) springs_.restart(vector_type::Zero(c_.f.size()));
        run_.emplace(springs_.held(), c_, layout_, multigrid_, most_, w_);
        certificate_.emplace(run_->qp(), run_->levels());
      }
    } catch (bad_input const&) {
      exchange(step);
      throw;
    } catch (...) {  // half of the step may be in the run
      exchange(step);
      certificate_.reset();
      run_.reset();
      throw;
    }
  }

  /// Where the line through the last two loads is nearest to f: 0 at the last one, 1 as far again.
  /// Before the first load stands 0.
  [[nodiscard]] S line_to(vector_type const& f) const {
    if (v_.size() == 0) return S(0);
    vector_type const rest = f - f_;
    S const unit = unit_near(std::max<S>(slant::norm(way_of_f_), slant::norm(rest)));
    vector_type const way = way_of_f_ / unit;
    S const τ = way.dot(rest / unit) / way.squaredNorm();
    return slant::detail::is_finite(τ) ? τ : S(0);
  }

  /// What was found is a solution, from which the next step starts. Whether it gives the line another
  /// direction, which loads that hardly differ do not.
  bool remember() {
    vector_type v = run_->state().x;
    if (auto const& s = run_->problem().offset(); s.size() > 0) v += s;
    if (v_.size() == 0) v_ = f_ = way_ = way_of_f_ = vector_type::Zero(v.size());
    vector_type const way_of_f = c_.f - f_;
    bool const differs =
        slant::norm(way_of_f) > S(1e-6) * std::max<S>(slant::norm(c_.f), slant::norm(f_));
    if (differs) {
      way_ = v - v_;
      way_of_f_ = way_of_f;
    }
    v_ = std::move(v);
    f_ = c_.f;
    return differs;
  }

 private:
  template <class Options>
  static free_motions<S> bodies_that_float(sparse_type const& K, data<S> const& c, Options o) {
    o.route = solution_route::iterate;
    auto outlook = outlook_of_iteration(K, c, o);
    if (!outlook.refusal) return std::move(outlook.floating);
    throw bad_input("N and T", *outlook.refusal, "rows that displacements can be solved for with");
  }

  /// The data of the step in place of those before, which it keeps.
  void exchange(load_step<S>& step) {
    if (step.f) c_.f.swap(*step.f);
    if (step.d) c_.d.swap(*step.d);
    if (step.g) c_.g.swap(*step.g);
    if (step.w) w_.swap(*step.w);
  }

  void go_on(load_step<S> const& step) {
    run_->restart([&](primal<S>& p, vector_type& x) {
      if (step.w) p.set_positions(w_);
      if (step.f) p.set_load(c_.f);
      if (step.d) p.set_gaps(c_.d);
      if (c_.g.size() > 0) p.set_slip_bounds(c_.g);
      x = predicted();
      if (p.offset().size() > 0) x -= p.offset();
      if (springs_.empty()) return;
      springs_.restart(p.displacement(x));
      p.set_load(springs_.load(c_.f));
    });
  }

  [[nodiscard]] vector_type predicted() const {
    // Without a load nothing moves; where bodies have been says nothing then.
    if (v_.size() == 0 || slant::detail::all_zero(c_.f)) return vector_type::Zero(c_.f.size());
    return v_ + line_to(c_.f) * way_;
  }

  using certificate_type = decltype(energy_certificate(
      std::declval<primal_run<S> const&>().qp(), std::declval<primal_run<S> const&>().levels()));

  data<S> c_;
  vector_type w_{};  // empty: 0
  node_layout<S> layout_;
  multigrid_options multigrid_;
  index most_;
  free_motions<S> floating_;
  moving_springs<S> springs_;
  std::optional<primal_run<S>> run_{};
  std::optional<certificate_type> certificate_{};
  vector_type v_{}, f_{};           // the last solution as G u, and its load; empty: none
  vector_type way_{}, way_of_f_{};  // from those before
};

}  // namespace slant::contact::detail

namespace slant::contact {

/// With slip bounds of the data. Refers to K. Not movable.
template <class S = double>
class primal_stepper {
 public:
  using report_type = solution<S>;

  /// K: n × n, both triangles; bodies that it leaves free are known where options.layout is. Of the
  /// options `route`, `costs`, `scale`, `condensation` and `start`
  /// have no part. Throws bad_input for data that do not fit or options out of range, and where
  /// displacements cannot be solved for, for the reason that contact::solve would give for factors.
  primal_stepper(Eigen::SparseMatrix<S> const& K, data<S> c, solve_options<S> options = {})
      : options_(checked(std::move(options), K, c)),
        steps_(K, std::move(c), options_, options_.max_steps) {
    if (!steps_.springs().empty()) report_.motions = steps_.floating();
    report_.choice.route = solution_route::iterate;
    report_.choice.reason = "iterated, as asked for";
  }

  /// Solves the next step; the report is that of contact::solve, and stays until the one after it.
  /// `iterations` and `work` are of the step. Throws bad_input, and has then done nothing, for data
  /// that do not fit or a K that is found not to be definite; numerical trouble is a status. A step
  /// that did not converge is not remembered: the next one starts from those before.
  [[nodiscard]] report_type const& advance(load_step<S> step) {
    steps_.begin(std::move(step));
    auto& run = steps_.run();
    if (report_.factorization.empty()) report_.factorization = run.levels().description();
    detail::run_to_certified(steps_.law(), run, steps_.springs(), steps_.certificate(),
                             steps_.scene(), options_, report_);
    if (report_.converged()) static_cast<void>(steps_.remember());
    return report_;
  }

 private:
  static solve_options<S> checked(solve_options<S> o, Eigen::SparseMatrix<S> const& K,
                                  data<S> const& c) {
    o.validate();
    detail::validated(friction_of_data{c.tangents()}, c, K.rows());
    if (o.prove) throw bad_input("prove", "true", "false, as a proof takes factors");
    return o;
  }

  solve_options<S> options_;
  detail::stepped_run<S> steps_;
  report_type report_{};
};

template <class S>
primal_stepper(Eigen::SparseMatrix<S> const&, data<S>, solve_options<S>) -> primal_stepper<S>;
template <class S>
primal_stepper(Eigen::SparseMatrix<S> const&, data<S>) -> primal_stepper<S>;

/// With Coulomb's law; the slip bounds of the data have no meaning. Refers to K. Not movable.
template <class S = double>
class primal_coulomb_stepper {
 public:
  using vector_type = Eigen::VectorX<S>;
  using report_type = certified_coulomb_result<vector_type>;

  /// F: a coefficient for each contact. Of the options `route`, `method`, `costs`, `newton_steps` and
  /// `scale` have no part. Throws bad_input as primal_stepper does, and for coefficients that are
  /// negative or not finite.
  primal_coulomb_stepper(Eigen::SparseMatrix<S> const& K, data<S> c, vector_type F,
                         certified_coulomb_options<S> options = {})
      : F_(std::move(F)),
        options_(checked(std::move(options), K, c, F_)),
        steps_(K, std::move(c), options_, detail::steps_for_problems(options_.outer_steps)) {}

  /// Solves the next step, as primal_stepper::advance; the report is that of certified_coulomb. A
  /// step has no slip bounds g: bad_input.
  [[nodiscard]] report_type const& advance(load_step<S> step) {
    if (step.g) throw bad_input("g", "slip bounds", "none, which are F times the pressures");
    auto const& f = step.f ? *step.f : steps_.scene().f;
    S const τ = f.size() == steps_.scene().f.size() ? steps_.line_to(f) : S(0);
    step.g = (g_ + τ * way_of_g_).cwiseMax(S(0));
    steps_.begin(std::move(step));
    report_ = rests() ? at_rest()
                      : detail::run_coulomb_to_certified(
                            steps_.law(), steps_.run(), newton_, steps_.springs(),
                            steps_.certificate(), steps_.scene(), steps_.positions(), F_, options_);
    report_.choice.route = solution_route::iterate;
    report_.choice.reason = "iterated, as asked for";
    if (report_.converged()) {
      vector_type const g = F_.cwiseProduct(report_.λ.head(F_.size()));
      if (steps_.remember()) way_of_g_ = g - g_;
      g_ = g;
    }
    return report_;
  }

 private:
  /// Without a load u = 0 and λ = 0 obey the law, wherever friction began to act, unless a gap is
  /// negative. An error relative to that solution could not be told from rounding.
  [[nodiscard]] bool rests() const {
    auto const& c = steps_.scene();
    return slant::detail::all_zero(c.f) && !(c.d.array() < S(0)).any();
  }
  [[nodiscard]] report_type at_rest() {
    report_type result{vector_type::Zero(F_.size() + steps_.scene().T.rows())};
    result.u = vector_type::Zero(steps_.scene().f.size());
    result.error.frozen.bound = S(0);
    detail::conclude(result, true, status::converged, options_.tolerance, "");
    result.method = "successive slip bounds";
    result.factorization = steps_.run().levels().description();
    result.work = steps_.run().state().work;
    return result;
  }

  static certified_coulomb_options<S> checked(certified_coulomb_options<S> o,
                                              Eigen::SparseMatrix<S> const& K, data<S>& c,
                                              vector_type& F) {
    o.validate();
    detail::clear_slip_bounds(c);
    detail::validated(friction_of_data{c.tangents()}, c, K.rows());
    F = detail::one_per_contact(std::move(F), c.nodes());
    detail::check_coefficients("F", F);
    return o;
  }

  vector_type F_;
  certified_coulomb_options<S> options_;
  detail::stepped_run<S> steps_;
  std::optional<detail::alart_curnier_steps<S>> newton_{};
  vector_type g_ = vector_type::Zero(F_.size());  // of the last solution
  vector_type way_of_g_ = g_;                     // from the one before
  report_type report_{};
};

template <class S>
primal_coulomb_stepper(Eigen::SparseMatrix<S> const&, data<S>,
                       std::type_identity_t<Eigen::VectorX<S>>, certified_coulomb_options<S> = {})
    -> primal_coulomb_stepper<S>;

}  // namespace slant::contact
