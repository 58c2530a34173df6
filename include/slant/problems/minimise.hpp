// SPDX-License-Identifier: MIT
//
// Quadratic programs as they are written on paper:
//
//     auto const program = slant::minimise(slant::quadratic(A, b)).over(half_lines(n) * discs(g));
//     auto const run = slant::solve(program, 1e-8);
//
// is separable_qp{A, b, Λ}, the problem min ½ xᵀA x − bᵀx over x ∈ Λ. With a function added, and with
// equations, it is
//
//     auto const program = slant::minimise(slant::quadratic(A, b) + slant::support(discs(g)));
//     auto const program = slant::minimise(slant::quadratic(A, b)).over(Λ).subject_to(G, e);
//
// separable_qp{A, b, φ}, the problem min ½ xᵀA x − bᵀx + Σ gᵢ‖xᵢ‖; and what smalse{program.qp(),
// program.constraints()} and the like are made of. Both are solved by solve(program, 1e-8), the
// latter with methods/solve_constrained_program.hpp.
#pragma once

#include <slant/problems/equality_constraints.hpp>
#include <slant/problems/separable_qp.hpp>

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include <concepts>
#include <type_traits>
#include <utility>

namespace slant {

/// q(x) = ½ xᵀA x − bᵀx. A and V are `T const&` (referenced) or plain types (owned).
template <class A, class V>
struct quadratic_function {
  held<A> a;
  held<V> b;
};

namespace detail {

/// b as it is kept: an expression or a view of Eigen as a vector of its own.
template <class V>
struct kept_term {
  using type = kept_t<V>;
};
template <class V>
  requires(!vector<std::remove_cvref_t<V>> && vector<typename std::remove_cvref_t<V>::PlainObject>)
struct kept_term<V> {
  using type = typename std::remove_cvref_t<V>::PlainObject;
};

}  // namespace detail

/// q(x) = ½ xᵀA x − bᵀx. Lvalues are referenced; an expression or a view in the
/// place of b, such as 2 * f, is evaluated.
template <class A, class V>
[[nodiscard]] auto quadratic(A&& a, V&& b) {
  using term = typename detail::kept_term<V>::type;
  return quadratic_function<kept_t<A>, term>{held<kept_t<A>>(std::forward<A>(a)),
                                             held<term>(static_cast<term>(std::forward<V>(b)))};
}

/// min q(x) over x ∈ Λ, G x = e. Not movable, as its constraints are not.
template <class A, class V, class C>
class constrained_qp {
 public:
  using program_type = separable_qp<A, V, C>;
  using vector_type = typename program_type::vector_type;
  using scalar = typename program_type::scalar;
  using constraints_type = equality_constraints<scalar>;

  /// Throws bad_input if G has another number of columns than there are unknowns, and as
  /// equality_constraints{G, e} does.
  constrained_qp(program_type qp, Eigen::SparseMatrix<scalar> const& G, vector_type const& e)
      : qp_(std::move(qp)), constraints_(G, e) {
    detail::check_size("columns of G", index(G.cols()), qp_.size(), "the size of b,");
  }

  /// min q(x) over x ∈ Λ.
  [[nodiscard]] program_type const& qp() const { return qp_; }
  /// G x = e.
  [[nodiscard]] constraints_type const& constraints() const { return constraints_; }

 private:
  program_type qp_;
  constraints_type constraints_;
};

/// min q(x) over x ∈ Λ: a separable_qp to which equations can be added.
template <class A, class V, class C>
class minimisation_over : public separable_qp<A, V, C> {
 public:
  using base = separable_qp<A, V, C>;
  using base::base;
  using typename base::scalar;
  using typename base::vector_type;

  /// min q(x) over x ∈ Λ, G x = e; G has n columns, and is not kept.
  /// @throws bad_input as constrained_qp does.
  [[nodiscard]] constrained_qp<A, V, C> subject_to(Eigen::SparseMatrix<scalar> const& G,
                                                   vector_type const& e) &&
        requires std::same_as<vector_type, Eigen::Matrix<scalar, Eigen::Dynamic, 1>>
  {
    return {base(std::move(*this)), G, e};
  }
};

/// What is to be minimised, before it is said where.
template <class A, class V>
class minimisation {
 public:
  explicit minimisation(quadratic_function<A, V> q) : q_(std::move(q)) {}

  /// min q(x) over x ∈ Λ. A set passed as an lvalue is referenced.
  /// @throws bad_input if sizes differ or b has an entry that is not finite.
  template <class C>
  [[nodiscard]] auto over(C&& set) && {
    // Arguments that lack something get the answer of separable_qp.
    constexpr bool good =
        separable_qp_parts<std::remove_cvref_t<A>, std::remove_cvref_t<V>, std::remove_cvref_t<C>>;
    using program =
        std::conditional_t<good, minimisation_over<A, V, kept_t<C>>, separable_qp<A, V, kept_t<C>>>;
    return program(std::move(q_.a), std::move(q_.b), held<kept_t<C>>(std::forward<C>(set)));
  }

 private:
  quadratic_function<A, V> q_;
};

/// min q(x) over what follows: minimise(quadratic(A, b)).over(Λ).
template <class A, class V>
[[nodiscard]] minimisation<A, V> minimise(quadratic_function<A, V> q) {
  return minimisation<A, V>(std::move(q));
}

/// q + φ. A function passed as an lvalue is referenced.
template <class A, class V, class F>
struct composite_function {
  quadratic_function<A, V> q;
  held<F> φ;
};
template <class A, class V, class F>
  requires proximable<std::remove_cvref_t<F>, local_t<std::remove_cvref_t<V>>>
[[nodiscard]] auto operator+(quadratic_function<A, V> q, F&& φ) {
  return composite_function<A, V, kept_t<F>>{std::move(q), held<kept_t<F>>(std::forward<F>(φ))};
}

/// Refused: q − φ need not be convex.
template <class A, class V, class F>
  requires proximable<std::remove_cvref_t<F>, local_t<std::remove_cvref_t<V>>>
composite_function<A, V, kept_t<F>> operator-(quadratic_function<A, V> q, F&& φ) {
  static_assert(!std::same_as<F, F>, "q - phi need not be convex: only q + phi is minimised");
  return std::move(q) + std::forward<F>(φ);
}
/// Refused: the proximal map of a sum does not follow from those of its terms.
template <class A, class V, class F, class G>
  requires proximable<std::remove_cvref_t<G>, local_t<std::remove_cvref_t<V>>>
composite_function<A, V, F> operator+(composite_function<A, V, F> f, G&&) {
  static_assert(!std::same_as<G, G>,
                "q + phi + psi: only one function is added; a separable_sum is one");
  return f;
}

/// min q(x) + φ(x). @throws bad_input if sizes differ or b has an entry that is not finite.
template <class A, class V, class F>
[[nodiscard]] auto minimise(composite_function<A, V, F> f) {
  return separable_qp<A, V, F>(std::move(f.q.a), std::move(f.q.b), std::move(f.φ));
}

}  // namespace slant
