// SPDX-License-Identifier: MIT
//
// Contact with Tresca friction without factors of K: Newton's method for the displacements
// (contact/primal.hpp, methods/envelope_newton.hpp), its systems by conjugate gradients with
// multigrid on the face, to a relative error in the energy norm that a certificate confirms.
//
//     start      from the same problem on a coarser level            contact/parts/nested_start.hpp
//     step       until ‖Π(r + v)‖_M, which costs one cycle, is half of the tolerance times ‖u‖_K
//     certify    certificates/energy_certificate.hpp, ‖·‖_{K⁻¹} by conjugate gradients with M
//     go on      where that asks for more, with a goal that is smaller by as much
#pragma once

#include <slant/certificates/energy_certificate.hpp>
#include <slant/compiled.hpp>
#include <slant/contact/contact_data.hpp>
#include <slant/contact/free_motions.hpp>
#include <slant/contact/friction_law.hpp>
#include <slant/contact/node_layout.hpp>
#include <slant/contact/parts/nested_start.hpp>
#include <slant/contact/primal.hpp>
#include <slant/contact/route.hpp>
#include <slant/contact/solve_options.hpp>
#include <slant/methods/envelope_newton.hpp>
#include <slant/multilevel/multigrid.hpp>

#include <Eigen/Core>
#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <Eigen/SparseCore>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <utility>

namespace slant::contact::detail {

/// The rigid-body motions of a layout.
template <class S>
[[nodiscard]] Eigen::MatrixX<S> rigid_motions(node_layout<S> const& layout) {
  auto const of = [](auto const& list) {
    return [&list](index j) { return index(list[static_cast<std::size_t>(j)]); };
  };
  return slant::detail::rigid_motions<S>(layout.x, static_cast<index>(layout.node.size()),
                                         of(layout.node), of(layout.axis));
}

/// Bodies with rigid motions that K resists by less than `share` of what its diagonal would.
template <class S>
[[nodiscard]] free_motions<S> floating_bodies(Eigen::SparseMatrix<S> const& K,
                                              node_layout<S> const& layout, S const& share) {
  using matrix = Eigen::MatrixX<S>;
  using six = Eigen::Matrix<S, 6, 6>;
  auto const R = rigid_motions(layout);
  free_motions<S> floating;
  // By rows, so that one pass through K does; in the plane with zeros.
  Eigen::Matrix<S, Eigen::Dynamic, 6, Eigen::RowMajor> rows;
  rows.setZero(R.rows(), 6);
  rows.leftCols(R.cols()) = R;
  for (auto& body : bodies_of(K)) {
    index const number = floating.bodies++;
    six all = six::Zero(), own = six::Zero();
    for (index const j : body) {
      Eigen::Matrix<S, 1, 6> image = Eigen::Matrix<S, 1, 6>::Zero();
      for (typename Eigen::SparseMatrix<S>::InnerIterator e(K, j); e; ++e) {
        image += e.value() * rows.row(e.row());
        if (e.row() == j) own += rows.row(j).transpose() * (e.value() * rows.row(j));
      }
      all += rows.row(j).transpose() * image;
    }
    matrix const G = all.topLeftCorner(R.cols(), R.cols());
    matrix const H = own.topLeftCorner(R.cols(), R.cols());
    // In motions of which H is the identity; what H does not see moves nothing.
    Eigen::SelfAdjointEigenSolver<matrix> const scale(H);
    S const least = S(1e-10) * scale.eigenvalues().maxCoeff();
    matrix W(R.cols(), 0);
    for (index k = 0; k < R.cols(); ++k) {
      if (!(scale.eigenvalues()[k] > least)) continue;
      W.conservativeResize(Eigen::NoChange, W.cols() + 1);
      using std::sqrt;
      W.col(W.cols() - 1) = scale.eigenvectors().col(k) / sqrt(scale.eigenvalues()[k]);
    }
    if (W.cols() == 0) continue;
    matrix const small = W.transpose() * G * W;
    Eigen::SelfAdjointEigenSolver<matrix> const resistance(
        matrix(small / 2 + small.transpose() / 2));
    index count = 0;
    while (count < W.cols() && !(resistance.eigenvalues()[count] > share)) ++count;
    if (count == 0) continue;
    matrix const combined = W * resistance.eigenvectors().leftCols(count);
    auto const size = static_cast<index>(body.size());
    matrix part(size, count);
    for (index j = 0; j < size; ++j) {
      part.row(j) = R.row(body[static_cast<std::size_t>(j)]) * combined;
    }
    Eigen::HouseholderQR<matrix> const qr(part);
    matrix motions = qr.householderQ() * matrix::Identity(size, count);
    std::string text = body_text(number, body) + motions_text(layout, body, motions);
    floating.free.push_back({number, std::move(body), std::move(motions), std::move(text)});
  }
  return floating;
}

/// Whether a scene can be iterated.
template <class S>
struct iteration_outlook {
  std::optional<std::string> refusal{};  ///< why not to begin with that, or nothing
  bool is_possible = false;              ///< whether it may follow where factors do not do
  free_motions<S> floating{};            ///< of bodies that contact or friction holds, or hardly
                                         ///< anything else
};

/// Of options with layout and route. Coordinates tell whether a body floats. Throws bad_input for
/// sizes that do not fit.
template <class S, class Options>
[[nodiscard]] iteration_outlook<S> outlook_of_iteration(Eigen::SparseMatrix<S> const& K,
                                                        data<S> const& c, Options const& o) {
  node_layout<S> const& layout = o.layout;
  auto why = primal_refusal(c);
  bool const is_possible = !why;
  if (!layout.is_known() && o.route != solution_route::iterate) {
    return {"no coordinates of nodes are given", is_possible};
  }
  if (why || !layout.is_known()) return {std::move(why), is_possible};
  slant::detail::check_size("columns of K", K.cols(), c.f.size(), "the size of f,");
  layout.validate(K.rows());
  return {std::nullopt, true, floating_bodies<S>(K, layout, S(1e-9))};
}

/// The problem, its levels and Newton's method, begun on the coarser ones. Not movable: parts refer
/// to others.
template <class S>
class primal_run {
  using qp_type = decltype(std::declval<primal<S> const&>().qp());
  using method_type = envelope_newton<qp_type const&, slant::multigrid<S> const&>;

 public:
  using vector_type = Eigen::VectorX<S>;
  using matrix_type = Eigen::MatrixX<S>;
  using state_type = typename method_type::state_type;

  /// At most `most` steps; with tangential positions w, none: 0. Throws bad_input where K is found
  /// not to be definite or does not fit the nodes.
  primal_run(Eigen::SparseMatrix<S> const& K, data<S> const& c, node_layout<S> const& layout,
             multigrid_options const& o, index most, vector_type const& w = {});
  primal_run(primal_run const&) = delete;
  primal_run& operator=(primal_run const&) = delete;

  [[nodiscard]] primal<S> const& problem() const { return problem_; }
  [[nodiscard]] primal<S>& problem() { return problem_; }
  [[nodiscard]] slant::multigrid<S> const& levels() const { return M_; }
  [[nodiscard]] qp_type const& qp() const { return qp_; }
  [[nodiscard]] state_type const& state() const { return state_; }

  /// ‖u‖_K, from x and r.
  [[nodiscard]] S size() const {
    auto const force = state_.unit * state_.r + qp_.b();
    if (auto const& s = problem_.offset(); s.size() > 0) {
      return energy_norm(state_.x + s, force + problem_.image_of_offset());
    }
    return energy_norm(state_.x, force);
  }
  /// A step while one is left, unless the energy error is estimated to be at most `goal`: the run
  /// is converged then.
  void step(S const& goal);
  void go_on() { state_.status = status::running; }
  /// No step is left either where this is spent. Refers to it.
  void set_budget(route_budget<S>& budget) { budget_ = &budget; }
  /// What the status means.
  [[nodiscard]] std::string reason() const {
    bool const is_spent =
        state_.status == status::iteration_limit && budget_ && budget_->is_spent();
    return is_spent ? budget_->reason() : state_.reason();
  }
  /// λ_ν of all contacts, as x and its gradient have it.
  void pressures(vector_type& λ) const {
    problem_.pressures(state_.x, state_.r, state_.step_length * state_.unit, λ);
    λ *= state_.unit;
  }
  [[nodiscard]] vector_type displacement() const { return problem_.displacement(state_.x); }
  /// Goes on from another x. One product.
  void go_to(vector_type const& x) {
    state_.x = x;
    resume();
  }
  /// Goes on from x with another load.
  void set_load(vector_type const& f) {
    problem_.set_load(f);
    resume();
  }
  /// Goes on from x with other slip bounds.
  void set_slip_bounds(vector_type const& g);
  /// change(problem, x) of its data and of the point, from which steps begin anew. One product.
  template <class Change>
  void restart(Change change) {
    change(problem_, state_.x);
    state_.iteration = 0;
    state_.work = {};
    resume();
  }

 private:
  [[nodiscard]] method_type method(S const& goal) const {
    symmetric_newton_options<S> o;
    // A step reports its estimate only where it has a goal.
    o.energy_goal = std::max<S>(goal, std::numeric_limits<S>::min());
    return method_type(qp_, M_, o);
  }
  [[nodiscard]] state_type begin(multigrid_options const& o, vector_type const& w);
  void resume();

  primal<S> problem_;
  matrix_type motions_;
  slant::multigrid<S> M_;
  qp_type qp_;
  index most_;
  route_budget<S>* budget_ = nullptr;
  state_type state_;
};

template <class S>
primal_run<S>::primal_run(Eigen::SparseMatrix<S> const& K, data<S> const& c,
                          node_layout<S> const& layout, multigrid_options const& o, index most,
                          vector_type const& w)
    : problem_(K, c),
      motions_(layout.is_known() ? rigid_motions(layout) : matrix_type(0, 0)),
      M_(problem_.levels(motions_, o)),
      qp_(problem_.qp()),
      most_(most),
      state_(begin(o, w)) {}

template <class S>
auto primal_run<S>::begin(multigrid_options const& o, vector_type const& w) -> state_type {
  if (w.size() > 0) problem_.set_positions(w);
  // What level 1 stands for: rigid motions of aggregates, or translations.
  index const size = M_.node_size(), nodes = qp_.b().size() / size;
  matrix_type const motions =
      o.prolongations.empty() ? motions_
                              : matrix_type(matrix_type::Identity(size, size).replicate(nodes, 1));
  nested_start<S> const coarse(qp_.b(), problem_.surface(), M_, motions, problem_.turning());
  if (!coarse.found()) return method(S(0)).start(problem_.zero());
  return method(S(0)).start_on_face([&](S const& ρ) { return coarse.at(ρ); });
}

template <class S>
void primal_run<S>::step(S const& goal) {
  bool const is_left = state_.iteration < most_ &&
                       !(budget_ && budget_->is_spent(state_.work.operator_applications));
  if (is_left) {
    method(goal).step(state_);
  } else if (state_.status == status::running) {
    state_.status = status::iteration_limit;
  }
}

template <class S>
void primal_run<S>::resume() {
  method(S(0)).resume(state_);
}

template <class S>
void primal_run<S>::set_slip_bounds(vector_type const& g) {
  problem_.set_slip_bounds(g);
  method(S(0)).adopt_function(state_);
}

#if SLANT_USES_COMPILED
extern template free_motions<double> floating_bodies<double>(Eigen::SparseMatrix<double> const&,
                                                             node_layout<double> const&,
                                                             double const&);
extern template class primal_run<double>;
#endif

/// The reduced gradient of a state relative to that at P_Λ(0); 0 if that is.
template <class S, class State>
[[nodiscard]] S relative_gradient(State const& state) {
  return state.gradient_scale > S(0) ? S(state.reduced_gradient_norm / state.gradient_scale) : S(0);
}
/// Tells options.progress of a state.
template <class S, class State>
void tell_progress(solve_options<S> const& o, State const& state) {
  if (o.progress) o.progress({state.iteration, relative_gradient<S>(state)});
}

/// Steps to an energy error of goal().
template <class S, class Goal>
void run_to_goal(primal_run<S>& run, solve_options<S> const& o, Goal const& goal) {
  auto const& state = run.state();
  tell_progress(o, state);
  while (state.status == status::running) {
    run.step(goal());
    if (state.status != status::iteration_limit) tell_progress(o, state);
  }
}

/// Steps until the certificate agrees.
template <class S, class Certificate>
void run_held(primal_run<S>& run, Certificate& certificate, solve_options<S> const& o,
              solution<S>& result) {
  auto const& state = run.state();
  S share = o.tolerance / S(2), best = std::numeric_limits<S>::infinity();
  constexpr index rounds = 12;
  index idle = 0;
  for (index round = 0;; ++round) {
    run_to_goal(run, o, [&] { return S(share * run.size()); });
    result.error = certificate(state.x);
    if (run.problem().offset().size() > 0) result.error.size = run.size();
    S const error = result.error.relative();
    bool const is_enough = error <= o.tolerance;
    // The bound of a step may be loose where that of the next is not, and none at all far away.
    idle = error < best / S(2) || !slant::detail::is_finite(error) ? 0 : idle + 1;
    bool const goes_on = state.status == status::converged && idle < 2 &&
                         state.reduced_gradient_norm > S(0) && round < rounds;
    if (is_enough || !goes_on) {
      conclude(result, is_enough, state.status, o.tolerance, "; " + run.reason());
      return;
    }
    best = std::min<S>(best, error);
    // Below the estimate at x, or the next step would stay there.
    share = std::min<S>(share, state.energy_estimate / run.size()) *
            std::clamp<S>(o.tolerance / error / S(2), S(1e-3), S(0.3));
    run.go_on();
  }
}

// --- bodies that float ---------------------------------------------------------------------------
//
// Contact or friction holds them, or nothing. The proximal point method [Rockafellar 1976]
//
//     u⁺ = argmin  ½ vᵀK v − fᵀv + φ(v) + ½ ‖v − u‖²_D,       D = δ diag(K) on these bodies,
//
// solves problems with springs that end where they began: they need nothing but another load, f + D
// u, and levels of K + D. Where contact holds the bodies by a stiffness c it contracts by D/(D +
// c), a hundredth or less on bricks; where it does not, u goes away and the run ends. On the mesh of
// n unknowns of a body in d dimensions, K resists an even strain by some n^(−2/d) of its diagonal:
// with δ = 2e-3 n^(−2/d), from 1e-7, which levels in floats see, to 1e-5, the mesh says nothing of
// how fast the springs are.
//
// Error. With w = ‖u⁺ − u‖_D and r(u⁺) + v = −D(u⁺ − u), v ∈ ∂φ(u⁺), monotonicity gives
//
//     ‖u⁺ − u*‖²_K ≤ ⟨D(u − u⁺), u⁺ − u*⟩ ≤ w d,        d = ‖u⁺ − u*‖_D ≤ θ w/(1 − θ),
//
// θ twice the last contraction as it was observed: an estimate, as that of the problem with springs
// is. For that all problems are solved as accurately as the last. With Coulomb's law the bounds of
// each problem come from the one before.

/// The springs, and how far they have come.
template <class S>
class moving_springs {
 public:
  using vector_type = Eigen::VectorX<S>;
  using sparse_type = Eigen::SparseMatrix<S>;

  /// On these bodies in `dimension` dimensions; none: nothing is copied or done. Refers to K.
  moving_springs(sparse_type const& K, free_motions<S> const& floating, index dimension) : K_(&K) {
    if (floating.free.empty()) return;
    D_ = centre_ = u_ = vector_type::Zero(K.rows());
    held_ = K;
    for (auto const& body : floating.free) {
      auto const n = static_cast<double>(body.unknowns.size());
      double const share = 2e-3 * std::pow(n, -2.0 / static_cast<double>(dimension));
      S const δ =
          std::max<S>(S(std::clamp(share, 1e-7, 1e-5)), S(64) * std::numeric_limits<S>::epsilon());
      for (index const j : body.unknowns) {
        D_[j] = δ * K.coeff(j, j);
        held_.coeffRef(j, j) += D_[j];
      }
    }
  }
  moving_springs(moving_springs const&) = delete;
  moving_springs& operator=(moving_springs const&) = delete;

  [[nodiscard]] bool empty() const { return D_.size() == 0; }
  /// K + D.
  [[nodiscard]] sparse_type const& held() const { return empty() ? *K_ : held_; }

  /// They end at u, and nothing is known of another problem but how contact has held so far. One
  /// product.
  void restart(vector_type const& u) {
    S const c = contraction();
    unknown_ = slant::detail::is_finite(c) ? std::max<S>(S(0.25), c) : S(0.25);
    products_ = 0;
    measure(u, S(0));
    centre_ = u_;
    way_ = last_ = before_ = S(0);
  }

  /// u⁺ = u has been found, up to `noise` in ‖·‖_{K + D}. One product.
  void measure(vector_type u, S const& noise) {
    using std::sqrt;
    u_ = std::move(u);
    S const unit = unit_near(std::max<S>(slant::norm(u_), slant::norm(centre_)));
    vector_type const δ = (u_ - centre_) / unit, x = u_ / unit;
    way_ = unit * sqrt(S(δ.dot(D_.cwiseProduct(δ))));
    S const square = x.dot(vector_type(*K_ * x));
    ++products_;
    size_ = square > S(0) ? S(unit * sqrt(square)) : S(0);
    noise_ = noise;
  }
  /// The springs end there.
  void move() {
    if (way_ > noise_ || before_ > S(0)) before_ = contraction();
    last_ = way_;
    centre_ = u_;
  }
  /// The load that keeps the springs at ease where they have been moved to.
  [[nodiscard]] vector_type load(vector_type const& f) const {
    return f + D_.cwiseProduct(centre_);
  }

  /// ‖u‖_K; 0 before anything has been found.
  [[nodiscard]] S size() const { return size_; }
  /// Applications of K since the last restart.
  [[nodiscard]] index products() const { return products_; }
  /// w over that of the step before, from above; ∞ where there was none. A way that is all noise
  /// says no more than that the springs are at rest.
  [[nodiscard]] S contraction() const {
    if (!(way_ > noise_)) {
      bool const was_good = S(0) < before_ && before_ < S(0.25);
      return was_good ? before_ : unknown_;
    }
    return last_ > S(0) ? S((way_ + noise_) / last_) : std::numeric_limits<S>::infinity();
  }
  /// Of ‖u − u*‖_K, where the error of the problem with springs is at most `inner`; ∞ from a
  /// contraction of ½ on, and unless the one before was known and hardly smaller: the first way, as
  /// across a gap, may be long beside those of slow motions and hides them.
  [[nodiscard]] energy_error<S> error(S const& inner) const {
    using std::sqrt;
    S const c = contraction(), θ = S(2) * c;
    bool const is_steady = slant::detail::is_finite(before_) && c <= S(4) * before_;
    bool const is_known = θ < S(1) && (is_steady || !(way_ > noise_));
    S const bound = is_known ? S((way_ + inner) * sqrt(S(θ / (S(1) - θ))) + inner)
                             : std::numeric_limits<S>::infinity();
    return {.bound = bound, .size = size_};
  }

 private:
  sparse_type const* K_;
  sparse_type held_;
  vector_type D_, centre_, u_;
  S way_{0}, last_{0}, size_{0}, noise_{0};
  S before_{0};      // the contraction of the step before; 0: there was none, and none is known
  S unknown_{0.25};  // what is taken for it where ways are noise
  index products_ = 0;
};

/// As run_held, where bodies float.
template <class S, class Certificate>
void run_floating(primal_run<S>& run, moving_springs<S>& springs, Certificate& certificate,
                  data<S> const& c, solve_options<S> const& o, solution<S>& result) {
  constexpr index rounds = 40, patience = 12;
  auto const& state = run.state();
  S const share =
      std::clamp<S>(o.tolerance / S(8), S(1e3) * std::numeric_limits<S>::epsilon(), S(1e-4));
  // ‖u‖_K, where that is known: far from where they began bodies have a large ‖u‖_D.
  auto const goal = [&] {
    return S(share * (springs.size() > S(0) ? springs.size() : run.size()));
  };
  result.springs = 0;
  for (index slow = 0;;) {
    run_to_goal(run, o, goal);
    ++result.springs;
    // Far from where bodies began rounding may allow no more; the next problem is nearer.
    bool const ended = state.status != status::converged && state.status != status::stalled;
    S const noise =
        state.status == status::stalled ? std::max<S>(goal(), state.energy_estimate) : goal();
    springs.measure(run.displacement(), noise);
    result.error = springs.error(noise);
    if (result.error.relative() <= o.tolerance || ended) {
      result.error = springs.error(certificate(state.x).bound);
    } else {
      result.error.bound = std::numeric_limits<S>::infinity();
    }
    S const error = result.error.relative();
    bool const is_enough = error <= o.tolerance;
    slow = springs.contraction() < S(0.5) ? 0 : slow + 1;
    if (is_enough || ended || slow > patience || result.springs >= rounds) {
      conclude(result, is_enough, state.status, o.tolerance,
               ended ? "; " + run.reason() : "; contact hardly holds bodies without supports");
      return;
    }
    springs.move();
    run.set_load(springs.load(c.f));
  }
}

/// Steps until the certificate agrees, and what has come of them but for the choice of a route.
template <class Friction, class S, class Certificate>
void run_to_certified(Friction law, primal_run<S>& run, moving_springs<S>& springs,
                      Certificate& certificate, data<S> const& c, solve_options<S> const& o,
                      solution<S>& result) {
  index const before = certificate.applications();
  if (springs.empty()) {
    run_held(run, certificate, o, result);
  } else {
    run_floating(run, springs, certificate, c, o, result);
  }
  auto const& state = run.state();
  result.u = run.displacement();
  result.multipliers = run.problem().multipliers(state.x);
  slant::project(feasible_set(law, c), result.multipliers, result.multipliers);
  result.iterations = state.iteration;
  result.work = state.work;
  result.work.operator_applications += certificate.applications() + springs.products() - before;
}

/// Contact with given slip bounds, or none; `floating` bodies that it holds.
template <class Friction, class S>
[[nodiscard]] solution<S> iterated_run(Friction law, Eigen::SparseMatrix<S> const& K,
                                       data<S> const& c, free_motions<S> const& floating,
                                       solve_options<S> const& o, route_budget<S>& budget) {
  moving_springs<S> springs(K, floating, o.layout.dimension());
  solution<S> result;
  primal_run<S> run(springs.held(), c, o.layout, o.multigrid, o.max_steps);
  run.set_budget(budget);
  result.factorization = run.levels().description();
  if (!springs.empty()) result.motions = floating;
  energy_certificate certificate(run.qp(), run.levels());
  run_to_certified(law, run, springs, certificate, c, o, result);
  return result;
}

}  // namespace slant::contact::detail
