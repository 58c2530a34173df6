// SPDX-License-Identifier: MIT
//
// Estimate of the error in the energy norm where there are equality constraints as well:
//
//     minimise  q(x) = ½ xᵀA x − bᵀx   over   x ∈ Λ,  G x = e,        A symmetric semidefinite.
//
// Let x* be a solution with the multiplier ν* ∈ range Gᵀ: g* = A x* − b + ν*, −g* normal to Λ at
// x*. For any p ∈ Λ with G p = e, any ν ∈ range Gᵀ and g = A p − b + ν, νᵀ(p − x*) = ν*ᵀ(p − x*) =
// 0, so that the derivation of energy_error.hpp holds word for word,
//
//     ‖p − x*‖_A² = (g − g*)ᵀ(p − x*) ≤ (g − s)ᵀ(p − x*) + γ,
//     ‖p − x*‖_A ≤ ½ (δ + √(δ² + 4γ)),         δ = sup (g − s)ᵀv/‖v‖_A over v ∈ ker G,
//
// with the dual norm of P A P, P the projector onto ker G. An x ∈ Λ off { G x = e } is as far from
// x* as from p, up to that:   ‖x − x*‖_A ≤ ‖x − p‖_A + ‖p − x*‖_A.   Nothing has to be known of ν*.
//
// p comes from Newton's method, started at y = x:
//
//     project     p = P(y − ρ (A y − b)) onto Λ ∩ { G x = e }, with ν (below)
//     step        t on the face there, cut by ker G                       face_correction.hpp
//     bound       g − s = −A t + rest,  δ ≤ ‖t‖_A + ‖rest‖,  for ν balanced on the face
//     go on       y = p + t, while p is not much nearer to x* than to x
//
// Near a solution p is next to x* after a step or two, and the estimate tends to ‖x − x*‖_A. Where
// a face is wrong the inequality says so: the estimate is large. Rows of G that depend on others on
// the face cut nothing more (problems/cut_face.hpp). Where no point of Λ satisfies G x = e, or none
// is found, it is ∞. Conjugate gradients see the dual norm only from below: an estimate, no bound.
//
// The norm. A may vanish along what x misses of G x = e. The error is therefore that in
//
//     ‖v‖² = ‖v‖_A² + ω ‖Q v‖²,    Q onto range Gᵀ,    ω = ‖x‖_A²/‖x‖²,
//
// where ‖Q (x − x*)‖ is the distance of x from { G x = e }, which is known; it counts relative to
// ‖x‖ as the energy does relative to ‖x‖_A. The error in A alone is never more. The size it is
// compared with is that of energy_error, ‖x‖_A.
//
// Where A is not declared definite, x* is any solution and what rounding leaves of a gradient is
// not counted, as in energy_error.hpp.
#pragma once

#include <slant/base/diagnosis.hpp>
#include <slant/certificates/dual_norm.hpp>
#include <slant/certificates/energy_error.hpp>
#include <slant/certificates/face_correction.hpp>
#include <slant/concepts/bad_input.hpp>
#include <slant/concepts/convex_set.hpp>
#include <slant/concepts/linear_operator.hpp>
#include <slant/concepts/vector.hpp>
#include <slant/krylov/mean_diagonal.hpp>
#include <slant/krylov/preconditioner.hpp>
#include <slant/operators/diagonal.hpp>
#include <slant/operators/identity.hpp>
#include <slant/problems/augmented_problem.hpp>
#include <slant/problems/cut_face.hpp>
#include <slant/problems/quadratic_program.hpp>
#include <slant/sets/block_queries.hpp>
#include <slant/sets/blocks.hpp>

#include <Eigen/Cholesky>
#include <Eigen/SparseCore>

#include <algorithm>
#include <cmath>
#include <concepts>
#include <limits>
#include <optional>
#include <type_traits>

namespace slant {

// --- constrained projection ----------------------------------------------------------------------
//
// The projection onto separable and equality constraints together,
//
//     minimise  ½ ‖y − z‖²   over   y ∈ Λ = Λ₁ × … × Λ_m,   N y = n,
//
// by its dual problem, which has as many unknowns as there are equations:
//
//     minimise  θ(m) = ½ ‖z − Nᵀm‖² − ½ dist²(z − Nᵀm, Λ) + nᵀm,     ∇θ(m) = n − N P_Λ(z − Nᵀm)
//
// θ is convex with a slanting Hessian N G Nᵀ, G the slanting operator of P_Λ. Newton's method with
// the term λ I, λ of the size of the residual: where a face leaves an equation nothing to act on,
// the step is as long as z is far from Λ, or Λ and n are large, and leaves that face. It is halved
// while it ends beyond the minimum along it, at a slope of more than half the first.
//
// Where no point of Λ satisfies N y = n, θ is unbounded and there is no result.
//
// Cost: a dense factorisation of the size of N Nᵀ a step, no operator of the problem. Hintermüller,
// Ito, Kunisch, SIAM J. Optim. 13 (2002); regularised as in Qi, Sun, SIAM J. Matrix Anal. 28
// (2006).

/// The projection at the top of this file, for rows of N of length 1, n = N x̄ and Eigen vectors.
template <class S>
class constrained_projection {
 public:
  using vector_type = Eigen::Matrix<S, Eigen::Dynamic, 1>;
  using sparse_type = Eigen::SparseMatrix<S>;

  vector_type point;   ///< y
  vector_type normal;  ///< Nᵀm: y = P_Λ(z − Nᵀm)
  vector_type base;    ///< z − Nᵀm

  /// Room for N; allocates.
  explicit constrained_projection(sparse_type const& N)
      : point(N.cols()),
        normal(N.cols()),
        base(N.cols()),
        hessian_(N.rows(), N.rows()),
        factors_(N.rows()),
        step_(N.rows()),
        residual_(N.rows()),
        along_(N.cols()),
        trial_(N.cols()) {}

  /// point, normal and base for z. False if none was found. Allocates nothing but what a large
  /// dense factorisation needs for itself.
  template <class Set>
  [[nodiscard]] bool compute(Set const& set, sparse_type const& N, vector_type const& nearest,
                             vector_type const& z) {
    using std::sqrt;
    S const ε = std::numeric_limits<S>::epsilon();
    S const room = S(4) * ε * sqrt(S(z.size()));
    S const of_nearest = slant::norm(nearest);
    base = z;
    evaluate(set, N, nearest, base);
    S violation = slant::norm(residual_), size(0);
    for (int k = 0; k < most_steps; ++k) {
      size = std::max<S>(slant::norm(point), of_nearest);
      if (!detail::is_finite(violation)) return false;
      if (violation <= room * size) break;
      add_up_hessian(set, N);
      trial_ = base - point;
      S const reach = std::max<S>(size, slant::norm(trial_));
      if (!factor(S(1e-3) * (violation / std::max<S>(reach, violation)))) return false;
      step_ = residual_ / violation;
      factors_.solveInPlace(step_);
      step_ *= violation;
      if (!search(set, N, nearest)) break;
      S const left = slant::norm(residual_);
      bool const is_slow = !(left < violation / S(2));
      violation = left;
      if (is_slow && violation <= S(8) * room * size) break;
    }
    normal = z - base;
    return violation <= S(8) * room * size;
  }

 private:
  static constexpr int most_steps = 100;

  /// y = P_Λ(base) and residual = N y − n.
  template <class Set>
  void evaluate(Set const& set, sparse_type const& N, vector_type const& nearest,
                vector_type const& at) {
    slant::project(set, at, point);
    normal = point - nearest;
    residual_.noalias() = N * normal;
  }

  /// The base along the step; false, and unchanged, if no length will do. The base itself is kept,
  /// not m: so rounding errors of z and Nᵀm, which may be large, do not enter the equations.
  template <class Set>
  bool search(Set const& set, sparse_type const& N, vector_type const& nearest) {
    // In units of both, so that no product leaves the range.
    S const unit = slant::norm(residual_), length = slant::norm(step_);
    auto const slope = [&] { return S((residual_ / unit).dot(step_ / length)); };
    S const first = slope();
    along_.noalias() = N.transpose() * step_;
    S β(1);
    for (int j = 0; first > S(0) && j < 60; ++j, β /= S(2)) {
      trial_ = base - β * along_;
      evaluate(set, N, nearest, trial_);
      if (slope() >= -first / S(2)) {
        base = trial_;
        return true;
      }
    }
    evaluate(set, N, nearest, base);
    return false;
  }

  /// N G Nᵀ + λ I, with a larger λ where that is not definite up to rounding.
  [[nodiscard]] bool factor(S λ) {
    λ = std::max<S>(λ, S(4) * std::numeric_limits<S>::epsilon());
    for (; λ < S(1); λ *= S(16)) {
      hessian_.diagonal().array() += λ;
      factors_.compute(hessian_);
      if (factors_.info() == Eigen::Success) return true;
    }
    return false;
  }

  /// N G Nᵀ at the base.
  template <class Set>
  void add_up_hessian(Set const& set, sparse_type const& N) {
    hessian_.setZero();
    auto const add = [&](index i, index j, S const& value) {
      for (typename sparse_type::InnerIterator a(N, i); a; ++a) {
        for (typename sparse_type::InnerIterator b(N, j); b; ++b) {
          hessian_(a.row(), b.row()) += value * a.value() * b.value();
        }
      }
    };
    slant::visit_blocks(set, [&](auto const& block, auto const& p) {
      using block_type = std::remove_cvref_t<decltype(block)>;
      if constexpr (whole_space<block_type>) {
        for (index j = 0; j < p.size(); ++j) add(p.component(j), p.component(j), S(1));
      } else {
        Eigen::Matrix<S, block_type::dimension, block_type::dimension> const g =
            block.slant(p.value(base));
        for (index j = 0; j < p.size(); ++j) {
          for (index l = 0; l < p.size(); ++l) {
            if (g(j, l) != S(0)) add(p.component(j), p.component(l), g(j, l));
          }
        }
      }
    });
  }

  using dense_type = Eigen::Matrix<S, Eigen::Dynamic, Eigen::Dynamic>;

  dense_type hessian_;
  Eigen::LLT<dense_type> factors_;
  vector_type step_, residual_, along_, trial_;
};

// --- constrained energy certificate --------------------------------------------------------------

/// What constrained_energy_certificate asks of its problem and its constraints.
template <class QP, class C>
concept constrained_program =
    quadratic_program<QP> && psd_operator<typename QP::operator_type, typename QP::vector_type> &&
    has_block_slants<typename QP::set_type, local_t<typename QP::vector_type>> &&
    affine_space_with_rows<C, typename QP::vector_type>;

/// Arguments that lack something end here and are told so; see base/diagnosis.hpp.
template <class QP, class C, class M = identity_operator>
class constrained_energy_certificate : public detail::refused {
  using vector_type = typename QP::vector_type;
  using a = detail::questions_about<typename QP::operator_type, vector_type>;
  static constexpr bool has_slants = has_block_slants<typename QP::set_type, local_t<vector_type>>;
  static constexpr bool good_problem = has_slants && psd_operator<typename a::promise, vector_type>;

  static_assert(psd_operator<typename a::promise, vector_type>,
                "constrained_energy_certificate: A must declare that it is self-adjoint and "
                "positive semidefinite");
  static_assert(has_slants,
                "constrained_energy_certificate: the set must be made of blocks with slant(x), "
                "which tell its faces");
  static_assert(!good_problem || affine_space_with_rows<C, vector_type>,
                "constrained_energy_certificate: the constraints must be equality_constraints of "
                "vectors like b, which must be an Eigen vector");
  static_assert(psd_operator<M, vector_type>,
                "constrained_energy_certificate: the preconditioner must be a linear operator on "
                "vectors like b that declares self_adjoint and positive_semidefinite");

 public:
  template <class... Arguments>
  explicit constrained_energy_certificate(Arguments const&...);
  energy_error<typename QP::scalar> operator()(auto const& x);
  index applications() const;
};

/// A problem that was told so already, or none at all.
template <class QP, class C, class M>
  requires(!quadratic_program<QP>)
class constrained_energy_certificate<QP, C, M> : public detail::refused {
  static_assert(quadratic_program<QP> || detail::was_refused<QP>,
                "constrained_energy_certificate: expected a separable_qp");

 public:
  template <class... Arguments>
  explicit constrained_energy_certificate(Arguments const&...);
  energy_error<double> operator()(auto const& x);
  index applications() const;
};

/// certificate(x) → energy_error of P_Λ(x), estimated. For a separable_qp, equality_constraints and
/// a preconditioner M ≈ A⁻¹; without M, diag(A)⁻¹ where A gives its diagonal or has no more than 64
/// rows. Refers to the problem, the constraints and M. Two applications of A a Newton step, of
/// which there are up to four, and those of conjugate gradients.
///
///     slant::constrained_energy_certificate certificate(qp, constraints);
///     solve(constrained_newton{qp, constraints}, x0,
///           energy_error_below(1e-8, certificate) || at_most(100));
template <class QP, class C, class M>
  requires constrained_program<QP, C> && preconditioner_for<M, QP>
class constrained_energy_certificate<QP, C, M> {
 public:
  using vector_type = typename QP::vector_type;
  using scalar = typename QP::scalar;

  /// Without a preconditioner. Throws bad_input if sizes do not match.
  constrained_energy_certificate(QP const& qp, C const& constraints)
    requires std::same_as<M, identity_operator>
      : constrained_energy_certificate(qp, constraints, identity_operator(qp.size())) {}
  /// Throws bad_input if sizes do not match.
  constrained_energy_certificate(QP const& qp, C const& constraints, M const& m)
      : qp_(&qp),
        constraints_(&constraints),
        m_(m),
        most_(qp.size() < 200 ? 2 * qp.size() + 8 : index(400)),
        x_(qp.size()),
        g_(qp.size()),
        stiffness_(qp.size()),
        a_workspace_(workspace(qp.a(), qp.b())),
        whole_workspace_(workspace(augmented_hessian(qp.a(), constraints, scalar(1)), qp.b())),
        q_workspace_(workspace(constraints.range_projector(), qp.b())),
        norm_(augmented_hessian(preconditioner(), constraints, scalar(1)), qp.b()),
        projection_(constraints.unit_rows()),
        face_(qp.set(), constraints.unit_rows()),
        correction_(x_, preconditioner()),
        y_(qp.size()),
        ν_(qp.size()),
        balanced_(qp.size()),
        rest_(qp.size()),
        scratch_(qp.size()) {
    detail::check_size("columns of G", index(constraints.size()), qp.size(), "the size of b,");
    detail::check_size("rows of M", index(m.rows()), qp.size(), "the size of the problem,");
    set_sizes();
  }
  constrained_energy_certificate(QP const&&, C const&) = delete;
  constrained_energy_certificate(QP const&, C const&&) = delete;
  constrained_energy_certificate(QP const&&, C const&, M const&) = delete;
  constrained_energy_certificate(QP const&, C const&&, M const&) = delete;

  [[nodiscard]] energy_error<scalar> operator()(vector_type const& x0) {
    slant::project(qp_->set(), x0, x_);
    slant::apply(qp_->a(), x_, g_, a_workspace_);
    ++applications_;
    energy_error<scalar> e;
    e.size = detail::root_of_product(x_, g_);
    g_ -= qp_->b();
    y_ = x_;
    range_part(g_, ν_);
    ν_ = -ν_;
    scalar bound = std::numeric_limits<scalar>::infinity();
    for (int k = 0; k < most_steps; ++k) {
      auto const [way, beyond] = newton_step();
      bool const is_better = way + beyond < bound / scalar(2);
      bound = std::min<scalar>(bound, way + beyond);
      if (!is_better || beyond <= way / scalar(4)) break;
    }
    e.bound = detail::root_of_squares<scalar>(bound + detail::rounding_of(x_, stiffness_),
                                              violation(e.size));
    return e;
  }
  /// Applications of A so far.
  [[nodiscard]] index applications() const { return applications_; }

 private:
  static constexpr int most_steps = 4;
  static constexpr bool is_plain = std::same_as<M, identity_operator>;
  using diagonal_inverse = diagonal_operator<vector_type const&>;
  using preconditioner_type = std::conditional_t<is_plain, diagonal_inverse, M>;
  /// P A P + α Q.
  template <class A>
  using definite = decltype(slant::augmented_hessian(
      std::declval<A const&>(), std::declval<C const&>(), typename QP::scalar(1)));

  /// ‖x − p‖_A and what ‖p − x*‖_A is at most.
  struct distances {
    scalar to_x = std::numeric_limits<scalar>::infinity();
    scalar to_solution = std::numeric_limits<scalar>::infinity();
  };

  /// M, or diag(stiffness) in its place.
  [[nodiscard]] decltype(auto) preconditioner() const {
    if constexpr (is_plain) {
      return diagonal_inverse(held<vector_type const&>(stiffness_));
    } else {
      return (m_);
    }
  }

  /// y = Q x.
  void range_part(vector_type const& x, vector_type& y) {
    slant::apply(constraints_->range_projector(), x, y, q_workspace_);
  }

  /// √ω ‖Q x − x̄‖; where ‖x‖_A is 0, ω is the size of A.
  [[nodiscard]] scalar violation(scalar const& size_of_x) {
    using std::sqrt;
    range_part(x_, scratch_);
    scratch_ -= constraints_->nearest();
    scalar const distance = slant::norm(scratch_);
    if (!(size_of_x > scalar(0))) return distance / sqrt(typical_);
    return size_of_x * (distance / slant::norm(x_));
  }

  /// What A x − b + ν was computed from, for an A that may be singular.
  [[nodiscard]] std::optional<gradient_size<scalar>> sizes() const {
    if constexpr (declares_positive_definite<typename QP::operator_type>) return {};
    return gradient_size<scalar>{slant::norm(x_), slant::norm(qp_->b()) + slant::norm(ν_)};
  }

  /// From y with the gradient g = A y − b and ν: p, t and the bound. Leaves y = p + t, with g and ν
  /// there.
  [[nodiscard]] distances newton_step() {
    scalar const ρ = typical_;
    scratch_ = y_ - ρ * (g_ + ν_);
    if (!projection_.compute(qp_->set(), constraints_->unit_rows(), constraints_->nearest(),
                             scratch_)) {
      return {};
    }
    auto const& p = projection_.point;
    ν_ += (scalar(1) / ρ) * projection_.normal;
    face_.assign_independent(qp_->set(), projection_.base, scalar(1));

    distances d;
    y_ = x_ - p;
    slant::apply(qp_->a(), y_, g_, a_workspace_);
    d.to_x = detail::root_of_product(y_, g_);
    slant::apply(qp_->a(), p, g_, a_workspace_);
    applications_ += 2;
    g_ -= qp_->b();
    balanced_ = g_ + ν_;
    applications_ += correction_.compute(qp_->a(), a_workspace_, preconditioner(), balanced_, face_,
                                         ρ, ρ, most_, sizes());
    if (!correction_.found || !detail::is_finite(correction_.energy)) stand_still();
    balance_on_face();
    d.to_solution = bound_at(p);
    y_ = p + correction_.t;
    g_ += correction_.image;
    return d;
  }

  /// t = 0, where the face has no curvature along g.
  void stand_still() {
    correction_.t.setZero();
    correction_.image.setZero();
    correction_.remainder.setZero();
    correction_.energy = correction_.bend = correction_.missing = scalar(0);
  }

  /// balanced = g + A t + ν with the ν that leaves least of it, and of the curvature, on the face.
  /// What ν has changed by stays in rest.
  void balance_on_face() {
    balanced_ += correction_.image;
    scratch_ = balanced_;
    face_.whole().add_curvature(scalar(1) / typical_, correction_.t, scratch_);
    face_.balance(scratch_, rest_);
    balanced_ -= rest_;
    ν_ -= rest_;
  }

  /// What ‖p − x*‖_A is at most. p misses G p = e by rounding, for which the multiplier and the
  /// shortest way back on the face are charged.
  [[nodiscard]] scalar bound_at(vector_type const& p) {
    using std::sqrt;
    scalar const changed = slant::norm(rest_);
    range_part(p, y_);
    y_ -= constraints_->nearest();
    scalar const missed = slant::norm(y_);
    face_.lift(y_, scratch_);
    scalar const back = slant::norm(scratch_);

    detail::bound_split<scalar> best;
    detail::consider_split(best, qp_->set(), face_.whole(), p, balanced_, correction_.remainder,
                           stiffness_, correction_.energy, correction_.bend, scalar(0), rest_,
                           norm_.z, norm_.r);
    if (!detail::is_finite(best.bound)) return best.bound;
    scalar const moved = detail::root_of_squares<scalar>(best.moved, correction_.missing);
    scalar const root =
        detail::root_of_squares<scalar>(best.root_of_gap, scalar(sqrt(changed) * sqrt(missed)));
    return error_bound_of_root<scalar>(moved + dual_norm_of_rest(), root) + back / sqrt(typical_);
  }

  /// sup restᵀv/‖v‖_A over ker G: of P A P + Q/ρ, for which nothing but rounding is left in range
  /// Gᵀ.
  [[nodiscard]] scalar dual_norm_of_rest() {
    using std::sqrt;
    scalar const whole = slant::norm(rest_);
    for (int k = 0; k < 2; ++k) {
      range_part(rest_, scratch_);
      rest_ -= scratch_;
    }
    // All of it was in range Gᵀ: what is left is its rounding.
    scalar const rounding =
        scalar(4) * sqrt(scalar(rest_.size())) * std::numeric_limits<scalar>::epsilon() * whole;
    if (slant::norm(rest_) <= rounding) return scalar(0);
    auto const e = dual_norm(augmented_hessian(qp_->a(), *constraints_, scalar(1) / typical_),
                             augmented_hessian(preconditioner(), *constraints_, typical_), rest_,
                             most_, false, whole_workspace_, norm_, scalar(0), sizes());
    applications_ += e.applications;
    return e.value;
  }

  /// ρ = 1/mean(diag P A P), of A if that is rounding, and the stiffness.
  void set_sizes() {
    scalar const whole = detail::size_on_ones(qp_->a(), qp_->b());
    ++applications_;
    scalar mean(0);
    if (!detail::is_one_point(*constraints_)) {
      auto const of_a = mean_diagonal(projected_hessian(qp_->a(), *constraints_), qp_->b());
      mean = of_a.value;
      applications_ += of_a.applications;
    }
    if (!(mean > scalar(32) * std::numeric_limits<scalar>::epsilon() * whole)) mean = whole;
    typical_ = mean > scalar(0) ? scalar(scalar(1) / mean) : scalar(1);
    applications_ +=
        detail::set_stiffness<is_plain>(qp_->a(), typical_, stiffness_, x_, g_, a_workspace_);
  }

  QP const* qp_;
  C const* constraints_;
  M m_;
  index most_;
  index applications_ = 0;
  vector_type x_, g_, stiffness_;
  workspace_t<typename QP::operator_type, vector_type> a_workspace_;
  workspace_t<definite<typename QP::operator_type>, vector_type> whole_workspace_;
  workspace_t<decltype(std::declval<C const&>().range_projector()), vector_type> q_workspace_;
  dual_norm_workspace<vector_type, definite<preconditioner_type>> norm_;
  constrained_projection<scalar> projection_;
  cut_face<scalar> face_;
  face_correction<vector_type, preconditioner_type> correction_;
  vector_type y_, ν_, balanced_, rest_, scratch_;
  scalar typical_{1};  ///< ρ
};

template <class QP, class C>
constrained_energy_certificate(QP const&, C const&)
    -> constrained_energy_certificate<QP, C, identity_operator>;
template <class QP, class C, class M>
constrained_energy_certificate(QP const&, C const&, M const&)
    -> constrained_energy_certificate<QP, C, M>;

}  // namespace slant
