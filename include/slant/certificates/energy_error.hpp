// SPDX-License-Identifier: MIT
//
// How far a point is from the solution, in the energy norm: a bound that needs no knowledge of the
// solution, for
//
//     minimise  q(x) = ½ xᵀA x − bᵀx   over   x ∈ Λ,        A symmetric positive definite.
//
// Let x ∈ Λ, g = A x − b, and x* the solution with g* = A x* − b, e = ‖x − x*‖_A. For every s with
// a finite support value γ = sᵀx + σ_Λ(−s) ≥ 0 and
//
//     e² = (g − g*)ᵀ(x − x*) ≤ gᵀ(x − x*)              −g* is normal to Λ at x*
//        = (g − s)ᵀ(x − x*) + sᵀx − sᵀx*
//        ≤ δ e + γ,                                    δ = ‖g − s‖_{A⁻¹},  −sᵀx* ≤ σ_Λ(−s)
//
// so that   e ≤ ½ (δ + √(δ² + 4γ)).   With s = g this is the square root of the duality gap, with
// −s the normal next to −g it is the reduced gradient in the norm of A⁻¹; normal_part.hpp chooses
// block by block. If only an approximate gradient ĝ with ‖g − ĝ‖_{A⁻¹} ≤ ε is known, δ + ε stands
// for δ.
//
// δ needs A⁻¹ or something above it. energy_certificate{qp, dominates_inverse(M)} takes an operator
// M ⪰ A⁻¹: the result is a bound, up to the rounding of a few sums.
//
// energy_certificate{qp} and {qp, M} estimate. For any D, s may be the balanced part of g + A D:
// then g − s = −A D + rest and δ ≤ ‖D‖_A + ‖rest‖_{A⁻¹}. D is the Newton step
// (face_correction.hpp): next to the solution it is x* − x, the rest vanishes, and so does what is
// estimated too high. ‖rest‖_{A⁻¹} comes from conjugate gradients (dual_norm.hpp), which see A⁻¹
// only from below.
//
// Where A is only semidefinite the same inequalities hold for d = g − s in the range of A; x* is
// then any solution. What rounding leaves of d outside of the range is not counted: the error is
// that of a program whose b differs by as much.
#pragma once

#include <slant/certificates/dual_norm.hpp>
#include <slant/certificates/face_correction.hpp>
#include <slant/certificates/normal_part.hpp>
#include <slant/concepts/capabilities.hpp>
#include <slant/concepts/checks.hpp>
#include <slant/concepts/distributed.hpp>
#include <slant/concepts/linear_operator.hpp>
#include <slant/concepts/vector.hpp>
#include <slant/krylov/mean_diagonal.hpp>
#include <slant/krylov/unit.hpp>
#include <slant/methods/detail/block_slants.hpp>
#include <slant/operators/diagonal.hpp>
#include <slant/operators/identity.hpp>
#include <slant/sets/curved_face.hpp>

#include <algorithm>
#include <cmath>
#include <concepts>
#include <limits>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>

namespace slant {

/// What is known of ‖x − x*‖_A.
template <class S>
struct energy_error {
  S bound = std::numeric_limits<S>::infinity();  ///< of ‖x − x*‖_A
  S size{0};            ///< ‖x‖_A, what the error is relative to up to the error itself
  bool proven = false;  ///< a bound in floating point; else an estimate

  /// The bound over the energy norm of the solution, of which size − bound is a lower bound, and
  /// size − 2 bound where the bound is estimated: far from the solution the two terms nearly agree,
  /// and an estimate a trifle too small would leave a difference that means nothing. ∞ if nothing
  /// of the solution is known, 0 if the bound is 0.
  [[nodiscard]] S relative() const {
    if (bound == S(0)) return S(0);
    S const least = proven ? S(size - bound) : S(size - S(2) * bound);
    return least > S(0) ? S(bound / least) : std::numeric_limits<S>::infinity();
  }
  /// "energy error at most 3e-10 (proven)".
  [[nodiscard]] std::string sentence() const {
    return "relative energy error " + detail::show(relative()) +
           (proven ? ", proven" : ", estimated");
  }
};

/// ½ (δ + √(δ² + 4γ)), rounded upwards; NaN if δ or γ is.
template <class S>
[[nodiscard]] S error_bound(S const& δ, S const& γ) {
  using std::sqrt;
  S const root = S(2) * sqrt(γ);
  S const larger = δ > root ? δ : root, smaller = δ > root ? root : δ;
  if (!(larger > S(0))) return δ + γ;
  S const ratio = smaller / larger;
  return (δ + larger * sqrt(S(1) + ratio * ratio)) / S(2) *
         (S(1) + S(8) * std::numeric_limits<S>::epsilon());
}

/// d = g − s for all blocks of Λ at x, with the sum of the gaps; m holds the stiffness of each
/// component, of the size of diag(A⁻¹), ∞ where nothing resists. d may be g. Whether every gap is
/// free of cancellation is known from the type: `exact`.
template <class S>
struct balanced_gradient {
  S gap{0};
  bool exact = true;
};

template <class C, class X, class G, class M, class D>
[[nodiscard]] auto balance(C const& set, X const& x, G const& g, M const& m, D& d)
    -> balanced_gradient<scalar_t<X>> {
  using S = scalar_t<X>;
  balanced_gradient<S> result;
  index terms = 0;
  if constexpr (std::is_same_v<G, D>) {
    if (&g != &d) slant::local(d) = slant::local(g);
  } else {
    slant::local(d) = slant::local(g);
  }
  slant::visit_blocks(set, [&](auto const& block, auto const& p) {
    using block_type = std::remove_cvref_t<decltype(block)>;
    if constexpr (!whole_space<block_type>) {
      S ρ(0);
      for (index j = 0; j < p.size(); ++j) ρ += slant::local(m).coeff(p.component(j));
      ρ /= S(2 * p.size());
      auto const part = split_gradient(block, p.value(x), p.value(d), ρ);
      p.put(d, part.rest);
      result.gap += part.gap;
      ++terms;
      if constexpr (!has_exact_normal_part<block_type>) result.exact = false;
    }
  });
  result.gap *= S(1) + S(terms + 64) * std::numeric_limits<S>::epsilon();
  return result;
}

namespace detail {

/// √(xᵀy) for a product that is ≥ 0 but for rounding.
template <class V>
[[nodiscard]] auto root_of_product(V const& x, V const& y) {
  using S = scalar_t<V>;
  using std::sqrt;
  S const ux = unit_near(slant::norm(x)), uy = unit_near(slant::norm(y));
  S const product = (slant::local(x) / ux).dot(slant::local(y) / uy);
  if (!(product > S(0))) return product == product ? S(0) : product;
  return S(S(sqrt(product)) * S(sqrt(ux)) * S(sqrt(uy)));
}

/// What rounding the entries of x is worth in the energy norm, of which g knows nothing.
template <class V>
[[nodiscard]] auto rounding_of(V const& x, V const& stiffness) {
  using S = scalar_t<V>;
  S sum(0);
  S const unit = unit_near(slant::norm(x));
  for (index i = 0; i < slant::local(x).size(); ++i) {
    S const entry = slant::local(x).coeff(i) / unit;
    sum += entry * entry / slant::local(stiffness).coeff(i);
  }
  using std::sqrt;
  return S(unit * (std::numeric_limits<S>::epsilon() / S(2)) * S(sqrt(sum)));
}

/// 1/diag A if A gives it or, with `probe`, has no more than 64 rows, else `typical`, the size of
/// A⁻¹. x and g are scratch. Returns the applications of A.
template <bool probe, class A, class V, class W>
index set_stiffness(A const& a, scalar_t<V> const& typical, V& stiffness, V& x, V& g, W& w) {
  using S = scalar_t<V>;
  auto const invert = [&] {
    for (index i = 0; i < slant::local(stiffness).size(); ++i) {
      auto& entry = slant::local(stiffness).coeffRef(i);
      entry = entry > S(0) ? S(S(1) / entry) : typical;
    }
  };
  slant::local(stiffness).setConstant(typical);
  if constexpr (has_diagonal<A, V>) {
    a.diagonal(stiffness);
    invert();
  } else if constexpr (probe) {
    index const n = slant::local(stiffness).size();
    if (!slant::everywhere(stiffness, n == slant::global_size(stiffness) && n <= 64)) return 0;
    for (index i = 0; i < n; ++i) {
      slant::local(x).setZero();
      slant::local(x).coeffRef(i) = S(1);
      slant::apply(a, x, g, w);
      slant::local(stiffness).coeffRef(i) = slant::local(g).coeff(i);
    }
    invert();
    return n;
  }
  return 0;
}

/// How a bound is put together: δ = √(moved² + missing²) + ‖rest‖_{A⁻¹}, γ, and what comes on
/// top.
template <class S>
struct bound_split {
  S bound = std::numeric_limits<S>::infinity();
  S moved{0}, gap{0}, above{0};
};

/// Splits the gradient at the end of a Newton step, `balanced`, into s and `rest` for x; curved
/// blocks with a part of the gradient or by the gap alone. What the diagonal of A says is less
/// becomes `best`. `moved`, `curvature`: of the step; `remainder`: what of it is missing on the
/// face, and counted elsewhere. m and d are scratch.
template <class Set, class Face, class V>
void consider_split(bound_split<scalar_t<V>>& best, Set const& set, Face const& face, V const& x,
                    V const& balanced, V const& remainder, V const& stiffness,
                    scalar_t<V> const& moved, scalar_t<V> const& curvature,
                    scalar_t<V> const& above, V& rest, V& m, V& d) {
  using S = scalar_t<V>;
  for (S const factor : {S(1), S(0x1p27)}) {
    slant::local(m) = slant::local(stiffness);
    face.curved_components([&](index i) { slant::local(m).coeffRef(i) *= factor; });
    auto const split = balance(set, x, balanced, m, d);
    slant::local(d) -= slant::local(remainder);
    S const γ = std::max<S>(split.gap, curvature / S(2));
    slant::local(m) = slant::local(stiffness).cwiseProduct(slant::local(d));
    S const bound = error_bound<S>(moved + root_of_product(d, m), γ) + above;
    if (!(bound < best.bound)) continue;
    best = {bound, moved, γ, above};
    slant::local(rest) = slant::local(d);
  }
}

}  // namespace detail

/// An operator M ⪰ A⁻¹, with that promise.
template <class M>
struct dominating_inverse {
  M const* inverse;
};
template <class M>
[[nodiscard]] dominating_inverse<M> dominates_inverse(M const& m) {
  return {&m};
}
template <class M>
dominating_inverse<M> dominates_inverse(M const&&) = delete;

/// certificate(x) → energy_error of P_Λ(x). Refers to the problem and to M. One application of A
/// and one of M with `dominates_inverse(M)`, which gives a bound up to rounding; else some 10 of
/// each, for conjugate gradients preconditioned by M, and an estimate. Without M they are
/// preconditioned by diag(A)⁻¹ where A gives its diagonal or has no more than 64 rows, for as many
/// applications: unknowns in units of their own would else hide the error from the estimate.
template <class QP, class M = identity_operator>
class energy_certificate {
 public:
  using vector_type = typename QP::vector_type;
  using scalar = typename QP::scalar;

  /// Without a preconditioner.
  explicit energy_certificate(QP const& qp)
    requires std::same_as<M, identity_operator>
      : energy_certificate(qp, identity_operator(qp.size()), false) {}
  energy_certificate(QP const& qp, M const& m) : energy_certificate(qp, m, false) {}
  energy_certificate(QP const& qp, dominating_inverse<M> m)
      : energy_certificate(qp, *m.inverse, true) {}
  energy_certificate(QP const&&, M const&) = delete;

  [[nodiscard]] energy_error<scalar> operator()(vector_type const& x0) {
    slant::project(qp_->set(), slant::local(x0), slant::local(x_));
    slant::apply(qp_->a(), x_, g_, a_workspace_);
    ++applications_;
    energy_error<scalar> e;
    e.size = detail::root_of_product(x_, g_);
    slant::local(g_) -= slant::local(qp_->b());
    if (dominates_) {
      auto const balanced = balance(qp_->set(), x_, g_, stiffness_, g_);
      slant::apply(m_, g_, norm_.z, norm_.of_m);
      e.bound = error_bound<scalar>(detail::root_of_product(g_, norm_.z), balanced.gap);
    } else {
      e.bound = estimate() + detail::rounding_of(x_, stiffness_);
    }
    return e;
  }
  /// Applications of A so far.
  [[nodiscard]] index applications() const { return applications_; }

 private:
  static constexpr bool has_faces = has_block_slants<typename QP::set_type, local_t<vector_type>>;

  energy_certificate(QP const& qp, M const& m, bool dominates)
      : qp_(&qp),
        m_(m),
        dominates_(dominates),
        most_(qp.size() < 200 ? qp.size() + 8 : index(200)),
        x_(like(qp.b(), qp.size())),
        g_(like(qp.b(), qp.size())),
        stiffness_(like(qp.b(), qp.size())),
        a_workspace_(workspace(qp.a(), qp.b())),
        norm_(preconditioner(), qp.b()),
        face_(qp.set()),
        correction_(x_, preconditioner()),
        projected_(x_),
        step_(x_),
        image_(x_),
        balanced_(x_),
        rest_(x_) {
    detail::check_size("rows of M", index(m.rows()), qp.size(), "the size of the problem,");
    set_stiffness();
  }

  static constexpr bool is_plain = std::same_as<M, identity_operator>;
  using diagonal_inverse = diagonal_operator<vector_type const&>;
  using preconditioner_type = std::conditional_t<is_plain, diagonal_inverse, M>;

  /// M, or diag(stiffness) in its place.
  [[nodiscard]] decltype(auto) preconditioner() const {
    if constexpr (is_plain) {
      return diagonal_inverse(held<vector_type const&>(stiffness_));
    } else {
      return (m_);
    }
  }

  /// What A x − b was computed from, for an A that may be singular.
  [[nodiscard]] std::optional<gradient_size<scalar>> sizes() const {
    if constexpr (declares_positive_definite<typename QP::operator_type>) return {};
    return gradient_size<scalar>{slant::norm(x_), slant::norm(qp_->b())};
  }

  [[nodiscard]] scalar norm_of(vector_type const& d) {
    if (!(slant::norm(d) > scalar(0))) return slant::norm(d);
    auto const e = dual_norm(qp_->a(), preconditioner(), d, most_, false, a_workspace_, norm_,
                             scalar(0), sizes());
    applications_ += e.applications;
    return e.value;
  }

  /// From x and g. The Newton step D = (x₁ − x) + t goes to x₁ = P_Λ(x − ρ g) and from there on the
  /// face of x₁. With s the balanced part of g + A D, the rest of g − s is −A D.
  [[nodiscard]] scalar estimate() {
    if constexpr (has_faces) {
      scalar const ρ = typical_;
      auto& z = norm_.p;
      slant::local(z) = slant::local(x_) - ρ * slant::local(g_);
      slant::project(qp_->set(), slant::local(z), slant::local(projected_));
      face_.assign(qp_->set(), slant::local(z), scalar(1));
      slant::local(step_) = slant::local(projected_) - slant::local(x_);
      slant::local(image_).setZero();
      if (slant::norm(step_) > scalar(0)) {
        slant::apply(qp_->a(), step_, image_, a_workspace_);
        ++applications_;
      }
      slant::local(rest_) = slant::local(g_) + slant::local(image_);
      applications_ += correction_.compute(qp_->a(), a_workspace_, preconditioner(), rest_, face_,
                                           ρ, ρ, most_, sizes());
      if (correction_.found && detail::is_finite(correction_.energy)) {
        scalar const bound = after_correction();
        if (detail::is_finite(bound)) return bound;
      }
    }
    auto const balanced = balance(qp_->set(), x_, g_, stiffness_, g_);
    return error_bound<scalar>(norm_of(g_), balanced.gap);
  }

  /// The bound for x from s balanced at x, or for x₁ from s balanced there and ‖x₁ − x‖_A on top: a
  /// point inside Λ has a gap of the first order that x₁ has not. Curved blocks are balanced with a
  /// part of the gradient or by the gap alone. What the diagonal of A says is best is taken.
  [[nodiscard]] scalar after_correction() {
    using std::sqrt;
    slant::local(image_) += slant::local(correction_.image);
    slant::local(balanced_) = slant::local(g_) + slant::local(image_);
    slant::local(image_) -= slant::local(correction_.image);
    scalar const way = detail::root_of_product(step_, image_);
    detail::bound_split<scalar> best;
    consider(best, projected_, correction_.energy, correction_.curvature, way);
    slant::local(step_) += slant::local(correction_.t);
    slant::local(image_) += slant::local(correction_.image);
    slant::local(norm_.p).setZero();
    face_.add_curvature(scalar(1) / typical_, step_, norm_.p);
    consider(best, x_, detail::root_of_product(step_, image_), slant::inner_product(step_, norm_.p),
             scalar(0));
    if (!detail::is_finite(best.bound)) return best.bound;
    scalar const δ =
        sqrt(best.moved * best.moved + correction_.missing * correction_.missing) + norm_of(rest_);
    return error_bound<scalar>(δ, best.gap) + best.above;
  }
  void consider(detail::bound_split<scalar>& best, vector_type const& x, scalar const& moved,
                scalar const& curvature, scalar const& above) {
    detail::consider_split(best, qp_->set(), face_, x, balanced_, correction_.remainder, stiffness_,
                           moved, curvature, above, rest_, norm_.z, norm_.r);
  }

  /// 1/diag A if A gives it, else the size of A⁻¹ that mean(diag A) or M says.
  void set_stiffness() {
    auto const mean = mean_diagonal(qp_->a(), qp_->b());
    applications_ += mean.applications;
    typical_ = mean.value > scalar(0) ? scalar(scalar(1) / mean.value) : scalar(1);
    applications_ +=
        detail::set_stiffness<is_plain>(qp_->a(), typical_, stiffness_, x_, g_, a_workspace_);
  }

  QP const* qp_;
  M m_;
  bool dominates_;
  index most_;
  index applications_ = 0;
  vector_type x_, g_, stiffness_;
  workspace_t<typename QP::operator_type, vector_type> a_workspace_;
  dual_norm_workspace<vector_type, preconditioner_type> norm_;
  curved_face<scalar> face_;
  face_correction<vector_type, preconditioner_type> correction_;
  vector_type projected_, step_, image_, balanced_, rest_;
  scalar typical_{1};  ///< 1/mean(diag A)
};

template <class QP>
energy_certificate(QP const&) -> energy_certificate<QP, identity_operator>;
template <class QP, class M>
energy_certificate(QP const&, M const&) -> energy_certificate<QP, M>;
template <class QP, class M>
energy_certificate(QP const&, dominating_inverse<M>) -> energy_certificate<QP, M>;

}  // namespace slant
