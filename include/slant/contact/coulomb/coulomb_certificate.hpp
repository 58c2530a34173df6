// SPDX-License-Identifier: MIT
//
// The error of multipliers λ of contact with Coulomb friction, whatever method they come from:
//
//     law      the violation of the law at (λ, u), contact by contact        contact/coulomb_check
//     frozen   ‖u − u_T‖_K, u_T the solution of Tresca's problem with the slip bounds F λ_ν of λ
//              itself, by a bound that knows K and the data alone            contact/certificate
//
// A solution with Coulomb friction is a fixed point: it solves Tresca's problem with its own slip
// bounds. So both vanish exactly at solutions. `frozen` says how far u is from the body that obeys
// the law with the bounds F λ_ν, whose own pressure may differ from λ_ν by as much: it is no bound
// of the distance to a solution, of which there may be several, or none near by.
//
// A bound needs λ on its face: λ_t of exactly the length F λ_ν where the node slips, λ_ν = 0 where
// it is open. Methods that change the slip bounds at the end of a step leave it off by the last
// change, of which the certificate would see the square root. So λ is put there first, by nodes,
// unless that violates the law much more: λ − m g with the stiffness m of the node decides between
// open, sticking and slipping.
//
//     contact::coulomb_certificate certificate(problem, factor, K, data, F, 1e-8);
//     auto const e = certificate(λ);
//     if (e.relative() <= 1e-8) use(certificate.displacement());
//
// Cost: three solves with K, one of them only where λ has to be put on its face; conjugate
// gradients (12 applications of A at most) where the cheap norm does not show the goal.
#pragma once

#include <slant/certificates/dual_norm.hpp>
#include <slant/certificates/energy_error.hpp>
#include <slant/concepts/bad_input.hpp>
#include <slant/concepts/vector.hpp>
#include <slant/contact/certificate.hpp>
#include <slant/contact/contact_data.hpp>
#include <slant/contact/dual.hpp>
#include <slant/contact/friction_law.hpp>
#include <slant/contact/preconditioners.hpp>

#include <algorithm>
#include <limits>
#include <string>
#include <utility>

namespace slant::contact {

// --- coulomb check -------------------------------------------------------------------------------
//
// The violation of Coulomb's law at multipliers λ and the displacements u = K⁻¹(f − Bᵀλ) that they
// lead to, node by node, as a force:
//
//     λ_ν − max(0, λ_ν + ρ (N u − d)),     λ_t − P(λ_t + ρ (T u − w)),    ‖P‖ ≤ F max(0, λ_ν).
//
// Relative to max(‖f‖, ‖Bᵀλ‖). Why not the gradient A λ − b: where bodies nearly move rigidly both
// A λ and b are far larger than u, and relative to ‖b‖ any forces are a solution. Here nothing is
// larger than what loads and forces of contact leave over: ρ = ‖f − Bᵀλ‖/‖u‖ is the stiffness that
// the body shows under p = f − Bᵀλ, at most λ_max(K), so that of rounding nothing is made but
// rounding. Forces and gaps are those of rows of N and T whose entries are about 1. It is no bound of
// the error: Coulomb's law minimises no energy. One product by B and one by Bᵀ; no projection or
// method of the library takes part.

/// What coulomb_check finds. NaN where λ or u holds one.
template <class S>
struct coulomb_violation {
  S relative = S(0);   ///< of all nodes, over max(‖f‖, ‖Bᵀλ‖)
  S largest = S(0);    ///< of one node, over the same
  index contact = -1;  ///< which node that is; −1: there is none
};

namespace detail {

/// What coulomb_check finds, from load, rows B and −(N u − d), −(T u − w).
template <class V>
[[nodiscard]] coulomb_violation<scalar_t<V>> violation_of_coulomb(
    V const& load, Eigen::SparseMatrix<scalar_t<V>> const& B, V const& gaps, V const& F, V const& λ,
    V const& u) {
  using scalar = scalar_t<V>;
  V const forces = B.transpose() * λ;
  scalar const unit = std::max<scalar>(load.stableNorm(), forces.stableNorm());
  scalar const size = unit > scalar(0) ? unit : scalar(1), moved = u.stableNorm();
  V const rows = units_of_rows(B, index(F.size())), wide = gaps.cwiseQuotient(rows);
  // u = 0 moves nothing: then any gap that is not there counts.
  scalar const widest = wide.size() > 0 ? scalar(wide.cwiseAbs().maxCoeff()) : scalar(0);
  scalar const ρ = moved > scalar(0)    ? (load - forces).stableNorm() / size / moved
                   : widest > scalar(0) ? scalar(1) / widest
                                        : scalar(1);
  coulomb_violation<scalar> v;
  index const m = F.size(), k = m > 0 ? index(λ.size()) / m - 1 : 0;
  V each(m), part(k + 1);
  for (index i = 0; i < m; ++i) {
    scalar const n = rows(i), t = k > 0 ? rows(m + k * i) : n;
    scalar const pressure = λ(i) / size * n, pushed = pressure - ρ * wide(i);
    scalar const bound = F(i) * (pressure > scalar(0) ? scalar(pressure / n * t) : scalar(0));
    part(0) = pushed > scalar(0) ? ρ * wide(i) : pressure;
    V const τ = λ.segment(m + k * i, k) / size * t;
    part.tail(k) = τ - ρ * wide.segment(m + k * i, k);
    scalar const length = part.tail(k).stableNorm();
    scalar const kept = length > bound ? bound / length : scalar(1);
    part.tail(k) = τ - kept * part.tail(k);
    // Norms may pass over a NaN.
    scalar const sum = pressure + wide(i) + τ.sum() + wide.segment(m + k * i, k).sum();
    each(i) = sum == sum ? scalar(part.stableNorm()) : sum;
    if (each(i) > v.largest || each(i) != each(i)) {
      v.largest = each(i);
      v.contact = i;
    }
  }
  bool const known = v.largest == v.largest;
  v.relative = m > 0 && known ? scalar(each.stableNorm()) : v.largest;
  return v;
}

}  // namespace detail

/// The check at the top of this file for a dual problem (contact/dual.hpp) and coefficients F of
/// its contact nodes. Refers to the problem.
template <class Dual>
class coulomb_check {
 public:
  using vector_type = typename Dual::vector_type;
  using scalar = scalar_t<vector_type>;

  coulomb_check(Dual const& problem, vector_type F) : problem_(&problem), F_(std::move(F)) {}
  coulomb_check(Dual const&&, vector_type) = delete;

  /// Throws bad_input if the sizes are not those of the problem.
  [[nodiscard]] coulomb_violation<scalar> operator()(vector_type const& λ,
                                                     vector_type const& u) const {
    auto const& p = *problem_;
    slant::detail::check_size("lambda", index(λ.size()), index(p.b().size()));
    slant::detail::check_size("u", index(u.size()), index(p.load().size()));
    return detail::violation_of_coulomb<vector_type>(p.load(), p.constraints(), p.openings(u), F_,
                                                     λ, u);
  }

 private:
  Dual const* problem_;
  vector_type F_;
};

// --- coulomb certificate -------------------------------------------------------------------------

/// What coulomb_certificate finds.
template <class S>
struct coulomb_error {
  coulomb_violation<S> law{};  ///< of Coulomb's law, as a force
  energy_error<S> frozen{};    ///< of Tresca's problem with the slip bounds F λ_ν

  /// The larger of both, each relative; NaN where one is.
  [[nodiscard]] S relative() const {
    S const error = frozen.relative();
    return law.relative >= error || law.relative != law.relative ? law.relative : error;
  }
  /// "Coulomb's law violated by 1e-9, most at contact 3; relative energy error 2e-9, estimated, for
  /// its slip bounds".
  [[nodiscard, gnu::cold]] std::string sentence() const {
    std::string where =
        law.contact >= 0 ? ", most at contact " + slant::detail::show(law.contact) : std::string();
    return "Coulomb's law violated by " + slant::detail::brief(law.relative) + where + "; " +
           frozen.sentence() + ", for its slip bounds";
  }
};

/// The certificate at the top of this file. Refers to problem, factorisation and K, and follows the
/// load steps of the problem; not movable.
template <class Dual, class Factorization>
class coulomb_certificate {
 public:
  using vector_type = typename Dual::vector_type;
  using sparse_type = typename Dual::sparse_type;
  using scalar = scalar_t<vector_type>;

  /// `factor` of K, c the data that the problem was made of, F a coefficient for every contact
  /// node, goal: the relative error that is to be shown, beyond which nothing is refined. Throws
  /// bad_input if sizes do not fit, or a coefficient is negative or not finite.
  coulomb_certificate(Dual const& problem, Factorization const& factor, sparse_type const& K,
                      data<scalar> c, vector_type F, scalar goal = scalar(1e-8))
      : problem_(&problem),
        factor_(&factor),
        F_(detail::one_per_contact(std::move(F), c.nodes())),
        law_(problem, F_),
        data_(std::move(c)),
        certificate_(K, data_),
        M_(lumped_preconditioner(K, problem.constraints())),
        goal_(goal),
        of_a_(workspace(problem.a(), problem.b())),
        of_norm_(M_, problem.b()) {
    detail::check_coefficients("F", F_);
  }
  coulomb_certificate(coulomb_certificate const&) = delete;
  coulomb_certificate& operator=(coulomb_certificate const&) = delete;

  /// Of multipliers as the dual problem orders them.
  [[nodiscard]] coulomb_error<scalar> operator()(vector_type const& λ) {
    return (*this)(λ, problem_->displacement(λ));
  }
  /// The same where u = displacement(λ) is known.
  [[nodiscard]] coulomb_error<scalar> operator()(vector_type const& λ, vector_type const& u) {
    slant::detail::check_size("lambda", λ.size(), problem_->b().size());
    coulomb_error<scalar> e;
    λ_ = λ;
    u_ = u;
    if (!λ.allFinite() || !u.allFinite()) {
      e.law = law_(λ_, u_);
      return e;
    }
    if (put_on_face(problem_->openings(u_))) {
      // Far from a solution a small step of λ may move the body far.
      u_ = problem_->displacement(λ_);
      bool const is_near = law_(λ_, u_).relative <= scalar(4) * law_(λ, u).relative;
      if (!is_near) {
        λ_ = λ;
        u_ = u;
      }
    }
    bool const is_known = follow();
    data_.g = F_.cwiseProduct(λ_.head(F_.size()).cwiseMax(scalar(0)));
    auto const set = detail::feasible_set(problem_->friction(), data_.nodes(), data_.g);
    if (shift_.size() > 0) u_ -= shift_;
    e.frozen = certificate_(set, λ_, u_, goal_, solver(*factor_));
    if (e.frozen.relative() > goal_) {
      auto const norm =
          dual_norm(problem_->a(), M_, certificate_.rest(), 12, true, of_a_, of_norm_);
      applications_ += norm.applications;
      e.frozen = certificate_.sharpened(norm.value);
    }
    if (shift_.size() > 0) {
      u_ += shift_;
      e.frozen.size = certificate_.energy_norm(u_);
    }
    if (!is_known) e.frozen.bound = std::numeric_limits<scalar>::infinity();
    e.law = law_(λ_, u_);
    return e;
  }

  /// λ on its face, of the last call.
  [[nodiscard]] vector_type const& multipliers() const { return λ_; }
  /// u that belongs to it, refined as far as the goal asks for.
  [[nodiscard]] vector_type const& displacement() const { return u_; }
  /// m: the stiffness that acts on each multiplier, as of contact/certificate.hpp.
  [[nodiscard]] vector_type const& stiffness() const { return certificate_.stiffness(); }
  /// Estimate of the condition number of K; 0 before the first call.
  [[nodiscard]] scalar condition() const { return certificate_.condition(); }
  /// Applications of A so far.
  [[nodiscard]] index applications() const { return applications_; }

 private:
  /// Whether that has changed λ_; the opening is g = c − B u.
  bool put_on_face(vector_type const& g) {
    index const m = F_.size(), k = m > 0 ? index(λ_.size()) / m - 1 : 0;
    vector_type const& stiff = certificate_.stiffness();
    vector_type pushed(k);
    bool is_moved = false;
    auto const step = [&](index row) {
      return slant::detail::is_finite(stiff(row)) ? scalar(stiff(row) * g(row)) : scalar(0);
    };
    for (index i = 0; i < m; ++i) {
      if (λ_(i) != scalar(0) && !(λ_(i) - step(i) > scalar(0))) {
        λ_(i) = scalar(0);
        is_moved = true;
      }
      auto τ = λ_.segment(m + k * i, k);
      for (index j = 0; j < k; ++j) pushed(j) = τ(j) - step(m + k * i + j);
      scalar const bound = λ_(i) > scalar(0) ? scalar(F_(i) * λ_(i)) : scalar(0);
      scalar const length = τ.stableNorm(), far = pushed.stableNorm();
      if (!slant::detail::is_finite(bound) || !(far > bound) || length == bound) continue;
      // A little beyond the circle: its projection is on it to the last bit.
      scalar const beyond =
          bound * (scalar(1) + scalar(8) * std::numeric_limits<scalar>::epsilon());
      if (scalar(2) * length >= bound) {
        if (length > scalar(0)) τ *= beyond / length;
      } else {
        τ = pushed * (beyond / far);
      }
      is_moved = true;
    }
    return is_moved;
  }

  /// Load, gaps and tangential positions w of the problem as they are now. With v such that N v =
  /// 0, T v = w the problem for u − v has none; false where no v of the form Bᵀy with one entry a
  /// row does it (rows that are not orthogonal).
  bool follow() {
    auto const& B = problem_->constraints();
    index const m = F_.size();
    vector_type const none = vector_type::Zero(problem_->load().size());
    vector_type c = problem_->openings(none);
    for (index i = 0; i < m; ++i) {
      if (slant::detail::is_finite(data_.d(i))) data_.d(i) = c(i);
      c(i) = scalar(0);
    }
    data_.f = problem_->load();
    shift_.resize(0);
    scalar const size = c.size() > 0 ? scalar(c.cwiseAbs().maxCoeff()) : scalar(0);
    if (!(size > scalar(0))) return true;
    vector_type y = c, squares = detail::row_squares(B);
    for (index i = 0; i < y.size(); ++i)
      y(i) = y(i) == scalar(0) ? y(i) : scalar(y(i) / squares(i));
    shift_ = B.transpose() * y;
    data_.f -= certificate_.matrix() * shift_;
    vector_type const off = B * shift_ - c;
    return off.cwiseAbs().maxCoeff() <= scalar(64) * std::numeric_limits<scalar>::epsilon() * size;
  }

  using preconditioner_type = decltype(lumped_preconditioner(std::declval<sparse_type const&>(),
                                                             std::declval<sparse_type const&>()));
  using operator_type = decltype(std::declval<Dual const&>().a());

  Dual const* problem_;
  Factorization const* factor_;
  vector_type F_;
  coulomb_check<Dual> law_;
  data<scalar> data_;
  certificate<scalar> certificate_;
  preconditioner_type M_;
  scalar goal_;
  workspace_t<operator_type, vector_type> of_a_;
  dual_norm_workspace<vector_type, preconditioner_type> of_norm_;
  index applications_ = 0;
  vector_type λ_{}, u_{}, shift_{};
};

}  // namespace slant::contact
