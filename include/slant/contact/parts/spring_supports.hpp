// SPDX-License-Identifier: MIT
//
// Contact of bodies that supports do not hold, by springs that give way: the proximal point method
//
//     u⁺ = argmin { q(u) + ½ ‖u − u⁻‖²_D },
//     D = σ diag(K) at the fixing rows of the kernel of K, 0 elsewhere.
//
// Springs at as many unknowns as there are free motions make K + D definite, so that each step is a
// problem of bodies that supports hold, with one factorisation for all. q(u) = ½ uᵀK u − fᵀu + … on
// the admissible u has a minimum u*, or not:
//
//     it has   the forces D (u⁻ − u⁺) of the springs go to 0 [Rockafellar 1976]: by about a factor σ
//              a step where contact holds the bodies as firmly as K itself does. D (u⁻ − u⁺) is a
//              subgradient of q at u⁺ and q is strongly convex in ‖·‖_K, so that
//
//                  ‖u⁺ − u*‖²_K ≤ (u⁻ − u⁺)ᵀD (u⁺ − u*) ≤ t ‖u⁺ − u*‖_D,    t = ‖u⁺ − u⁻‖_D,
//
//              with ‖u⁺ − u*‖_D ≈ t θ/(1 − θ), θ the factor by which t falls: an estimate
//     not      u⁺ − u⁻ tends to a motion along which the energy falls for ever [Brézis, Reich]; it
//              is checked (rigid_position.hpp) and is the proof
//
// Gaps. A spring that is to let a body through a gap has to be soft, so soft that B (K + D)⁻¹Bᵀ is
// nearly of the rank of the motions. So u⁻ = R α to begin with, α from rigid_position.hpp, and u =
// R α + v from there on: gaps, slips and norms are taken of v, which is of the size of the strains.
// ‖·‖_K of what the sum R α + v loses to rounding is part of the error, as is that of K R α, which
// ought to be 0: they are the floor where bodies move far beside what they deform.
//
// Cost: one factorisation of the size of K, and 2 to 4 problems, all but the first of which begin
// at the solution of the one before. One more factorisation for each other σ, where 2⁻⁶ is too
// stiff.
#pragma once

#include <slant/base/double_word.hpp>
#include <slant/base/matrix_entries.hpp>
#include <slant/contact/contact_data.hpp>
#include <slant/contact/free_motions.hpp>
#include <slant/contact/optimality.hpp>
#include <slant/contact/parts/rigid_position.hpp>
#include <slant/contact/solve_options.hpp>
#include <slant/factorizations/kernel_basis.hpp>

#include <Eigen/Eigenvalues>
#include <Eigen/SparseCore>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

namespace slant::contact::detail {

/// √(vᵀK v), from the products with K.
template <class S, class V>
[[nodiscard]] S elastic_norm(Eigen::SparseMatrix<S> const& K, V const& v) {
  using std::sqrt;
  S const size = v.stableNorm();
  if (!(size > S(0))) return size;
  V const unit = v / size;
  S const unit_of_K = slant::detail::largest_row_sum(K);
  S const square = unit.dot(V(K * unit)) / unit_of_K;
  return square > S(0) ? S(size * sqrt(square) * sqrt(unit_of_K)) : S(0);
}

/// The method at the top of this file. Run(law, K + D, data, options) is the problem of a step, for
/// bodies that are held; its reload(λ, w, tolerance, most steps) takes new data, and slips from w.
template <class Run>
class spring_supports {
 public:
  using S = typename Run::scalar;
  using vector_type = Eigen::VectorX<S>;
  using sparse_type = Eigen::SparseMatrix<S>;
  using friction_type = typename Run::friction_type;

  spring_supports(friction_type law, sparse_type const& K, data<S> const& c,
                  solve_options<S> const& o, free_motions<S> motions)
      : K_(&K), original_(&c), data_(c), options_(o), law_(law), R_(kernel_of(motions, K.rows())) {
    for (auto const& body : motions.free) {
      for (index const row : fixing_rows(body.motions)) {
        places_.push_back(body.unknowns[std::size_t(row)]);
      }
    }
    sum_.motions = std::move(motions);
    origin_.setZero(K.rows());
    rest_.setZero(K.rows());
  }
  spring_supports(spring_supports const&) = delete;
  spring_supports& operator=(spring_supports const&) = delete;

  [[nodiscard]] solution<S> run() {
    if (options_.start) λ_ = *options_.start;
    origin_ = R_ * rigid_position<S>(*K_, *original_, R_)();
    is_moved_ = !(origin_.array() == S(0)).all();
    for (S soft = S(0x1p-16);; soft *= S(0x1p-10)) {
      // Stiff springs make good systems; soft ones cover distances, for which three digits do.
      if (run_with_springs(S(0x1p-6), false)) break;
      if (soft < S(0x1p-40)) {
        conclude_unbounded(*K_, *original_, options_.layout, sum_);
        break;
      }
      if (run_with_springs(soft, true)) break;
    }
    if (!sum_.converged() && sum_.status != status::unbounded) {
      go_back_to_best();
      sum_.reason += " (" + sum_.motions.sentence() + ")";
    }
    return std::move(sum_);
  }

 private:
  void set_springs(S const& σ) {
    S const typical = slant::detail::largest_row_sum(*K_);
    D_.setZero(K_->rows());
    supported_ = *K_;
    for (index const j : places_) {
      S const own = K_->coeff(j, j);
      D_(j) = σ * (own > S(0) ? own : typical > S(0) ? typical : S(1));
      supported_.coeffRef(j, j) += D_(j);
    }
    supported_.makeCompressed();
  }

  /// ‖v‖_D.
  [[nodiscard]] S spring_norm(vector_type const& v) const {
    vector_type const part = D_(places_).cwiseSqrt().cwiseProduct(v(places_));
    return part.stableNorm();
  }

  /// The load and the data as seen from the rigid part of the anchor. K times that is rounding of K
  /// and R: its resultants, which are 0 as K is symmetric, are removed, and its size as ‖·‖_{K⁻¹},
  /// with diag(K) for K, is part of the error.
  void move_origin() {
    using std::hypot;
    using std::sqrt;
    vector_type const image = *K_ * origin_;
    data_.f = original_->f - image + R_ * vector_type(R_.transpose() * image);
    lost_ = S(0);
    for (index j = 0; j < image.size(); ++j) {
      S const own = K_->coeff(j, j);
      if (own > S(0)) lost_ = hypot(lost_, S(image(j) / sqrt(own)));
    }
    data_.f += D_.cwiseProduct(rest_);
    data_.d = original_->d - original_->N * origin_;
    positions_ = -(original_->T * origin_);
  }

  /// u becomes the anchor: its rigid part the origin, the rest what is small beside it.
  void move_anchor(vector_type const& v) {
    vector_type const moved = R_ * vector_type(R_.transpose() * v);
    origin_ += moved;
    rest_ = v - moved;
  }

  /// Whether there is a verdict; none where the springs are too stiff, or after a few steps with
  /// soft ones.
  [[nodiscard]] bool run_with_springs(S const& σ, bool is_soft) {
    using std::sqrt;
    S t_before = std::numeric_limits<S>::infinity();
    auto θ = S(0.9);  // until it is measured
    S goal = is_soft ? S(1e-3) : S(S(0.3) * options_.tolerance);
    S tolerance = std::max<S>(goal, S(1e-3));
    int const steps = is_soft ? 3 : 100;
    std::optional<Run> problem;
    set_springs(σ);
    for (int step = 0, slow = 0; step < steps && slow < 4; ++step) {
      index const left = options_.max_steps - sum_.iterations;
      index const budget = is_soft ? std::min<index>(left, 200) : left;
      if (!problem) {
        auto o = options_;
        o.prove = false;
        o.tolerance = tolerance;
        o.max_steps = budget;
        if (λ_.size() > 0) o.start = λ_;
        data_.d = original_->d;
        problem.emplace(law_, supported_, data_, o);
        ++sum_.work.factorizations;
      }
      if (sum_.springs > 0 || is_moved_) {
        move_origin();
        problem->reload(λ_, positions_, tolerance, budget);
      }
      auto found = problem->solve();
      S const supported_size = found.error.size, inner = found.error.bound;
      vector_type const v = found.u;
      found.u += origin_;
      vector_type moved = v - rest_;
      S const t = spring_norm(moved);
      take(std::move(found));
      bool const is_over = sum_.status == status::unbounded ||
                           (sum_.status == status::iteration_limit && budget == left);
      // The rigid part of the motion, if it goes on like that.
      moved = R_ * vector_type(R_.transpose() * moved);
      S const length = moved.stableNorm();
      if (!is_over && step > 0 && length > S(0) && slant::detail::is_finite(length) &&
          falls_for_ever(*original_, vector_type(moved / length))) {
        // The shortest such motion has the simplest name.
        conclude_unbounded(*K_, *original_, options_.layout, sum_);
        if (sum_.status != status::unbounded) {
          conclude_unbounded(*K_, *original_, options_.layout, std::move(moved), sum_);
        }
        return true;
      }
      // u itself is rounded, by much where it is large beside the strains; so are the gaps.
      S const rounded = S(2) * (lost_ + elastic_norm(*K_, lost_digits(v)));
      bool const at_rest = !(t > S(4) * (inner + rounded));
      if (step > 0 && !at_rest) {
        S const factor = t / t_before;
        θ = std::clamp<S>(factor, S(0x1p-12), S(0.999));
        slow = factor > S(0.8) ? slow + 1 : 0;
      }
      t_before = t;
      S const spring = t > S(0) ? S((t + inner) * sqrt(θ / (S(1) - θ))) : S(0);
      sum_.error.bound = inner + spring + rounded;
      sum_.error.size = elastic_norm(*K_, v);
      sum_.error.proven = false;
      // A motion that is hardly held moves little in a step and has far to go; θ is not its rate.
      if (sum_.error.relative() <= S(100) * options_.tolerance) {
        S const held = way_of_forces(D_.cwiseProduct(v - rest_));
        sum_.error.bound = inner + std::max<S>(spring, held) + rounded;
        if (step > 0) keep_best();
      }
      if (is_over) return true;  // also where no u satisfies the constraints
      if ((step > 0 || t == S(0)) && sum_.error.relative() <= options_.tolerance) {
        finish(status::converged);
        return true;
      }
      if (step > 0 && sum_.error.bound <= S(2) * rounded) {
        finish(status::stalled);
        sum_.reason += ", for the bodies move far beside what they deform";
        return true;
      }
      // With soft springs that is their own floor, or the end of their budget.
      if (at_rest && step > 1 && !is_soft && sum_.status == status::stalled) {
        finish(status::stalled);
        return true;
      }
      move_anchor(v);
      if (at_rest) goal *= S(0.3);  // the rest is what the inner tolerance leaves
      // What the springs store is no part of the elastic energy that the tolerance is relative to.
      S const share = supported_size > S(0) ? S(sum_.error.size / supported_size) : S(1);
      S const next = std::max<S>(S(0.1) * θ * tolerance, goal);
      tolerance = next * std::min<S>(S(1), share);
    }
    return false;
  }

  /// Soft springs may lead away from what stiff ones had found.
  void keep_best() {
    if (best_.u.size() > 0 && !(sum_.error.relative() < best_.error.relative())) return;
    best_.u = sum_.u;
    best_.multipliers = sum_.multipliers;
    best_.error = sum_.error;
  }
  void go_back_to_best() {
    bool const is_better = best_.error.relative() < sum_.error.relative();
    if (best_.u.size() == 0 || !is_better || sum_.status != status::stalled) return;
    sum_.u = std::move(best_.u);
    sum_.multipliers = std::move(best_.multipliers);
    sum_.error = best_.error;
    sum_.reason = sum_.error.sentence() + ": no springs around the bodies lead further";
  }

  /// How far, in energy, those forces would move the bodies as rigid ones on the contacts that
  /// press or stick now: √(dᵀG⁻¹d), d = Rᵀp, G = Rᵀ B_aᵀ κ B_a R. κ is the stiffness of the nodes
  /// alone, which is some ten times that of the bodies behind them: the factor 4.
  [[nodiscard]] S way_of_forces(vector_type const& p) const {
    index const m = original_->nodes(), k = original_->tangents();
    sparse_type const B = stacked_constraints(*original_);
    vector_type const squares = row_squares(B);
    vector_type κ = vector_type::Zero(B.rows());
    auto const holds = [&](index i) {
      if (i < m) return λ_(i) > S(0);
      index const node = (i - m) / k;
      return λ_.segment(m + k * node, k).stableNorm() < (S(1) - S(1e-9)) * original_->g(node);
    };
    slant::detail::for_each_entry(B, [&](index i, index j, S const& value) {
      if (!(squares(i) > S(0)) || !holds(i)) return;
      S const part = value / squares(i);
      κ(i) += part * part * K_->coeff(j, j);
    });
    sparse_type const BR = B * R_;
    sparse_type const weighted = κ.asDiagonal() * BR;
    sparse_type const G = sparse_type(BR.transpose()) * weighted;
    vector_type const d = R_.transpose() * p;
    // Motions that no contact resists belong to no force but rounding.
    using dense_type = Eigen::MatrixX<S>;
    Eigen::SelfAdjointEigenSolver<dense_type> const modes{dense_type(G)};
    S const largest = modes.eigenvalues().size() > 0 ? S(modes.eigenvalues().maxCoeff()) : S(0);
    S way(0);
    for (index i = 0; i < d.size(); ++i) {
      S const stiff = modes.eigenvalues()(i);
      if (!(stiff > S(1024) * std::numeric_limits<S>::epsilon() * largest)) continue;
      using std::hypot;
      using std::sqrt;
      way = hypot(way, S(modes.eigenvectors().col(i).dot(d) / sqrt(stiff)));
    }
    return S(4) * way;
  }

  /// (origin + v) − u, exactly.
  [[nodiscard]] vector_type lost_digits(vector_type const& v) const {
    return origin_.binaryExpr(
        v, [](S const& a, S const& b) { return slant::detail::exact_sum<S>(a, b).lo; });
  }

  /// The last problem, with the work of all.
  void take(solution<S> found) {
    λ_ = found.multipliers;
    found.motions = std::move(sum_.motions);
    found.springs = sum_.springs + 1;
    found.iterations += sum_.iterations;
    found.work.factorizations = 0;  // counted where it was made
    found.work += sum_.work;
    found.solves += sum_.solves;
    found.corrections += sum_.corrections;
    sum_ = std::move(found);
  }

  /// The verdict, beside an independent check.
  void finish(slant::status verdict) {
    auto const known = sum_.error.sentence();
    sum_.status = verdict;
    if (verdict == status::converged) {
      S const residual = check_optimality(*K_, *original_, sum_.u, sum_.multipliers).residual();
      // K u has rounding errors of ε ‖K‖ ‖u‖, however far the bodies have moved.
      auto const& c = *original_;
      vector_type const pressures = c.N.transpose() * sum_.multipliers.head(c.nodes());
      S const force = std::max<S>(c.f.stableNorm(), pressures.stableNorm());
      S const rounding = S(64) * std::numeric_limits<S>::epsilon() *
                         slant::detail::largest_row_sum(*K_) * sum_.u.stableNorm();
      S const allowed = S(1000) * options_.tolerance + (force > S(0) ? S(rounding / force) : S(0));
      sum_.reason = known + ", at most " + slant::detail::show(options_.tolerance);
      if (residual <= allowed) return;
      sum_.status = status::stalled;
      sum_.reason = known + ", but the optimality conditions have the residual " +
                    slant::detail::brief(residual) + ", more than " + slant::detail::brief(allowed);
    } else {
      sum_.reason = known + ": rounding errors allow no more";
    }
  }

  sparse_type const* K_;
  data<S> const* original_;
  data<S> data_;  // with the forces of the springs
  solve_options<S> options_;
  friction_type law_;
  sparse_type R_, supported_{};
  std::vector<index> places_{};    // unknowns that hold all bodies if they are fixed
  vector_type D_{};                // diagonal, 0 but at the places
  vector_type origin_{}, rest_{};  // of the anchor
  vector_type positions_{}, λ_{};
  S lost_{0};              // to rounding, of the origin
  bool is_moved_ = false;  // before the first problem
  solution<S> sum_{}, best_{};
};

}  // namespace slant::contact::detail
