// SPDX-License-Identifier: MIT
//
// A ⊗ B, applied and never formed: with X the matrix of cols(B) rows whose columns, one below the
// other, are x,
//
//     (A ⊗ B) x = vec(B X Aᵀ),      (A ⊗ B)ᵀ = Aᵀ ⊗ Bᵀ,      (A ⊗ B)⁻¹ = A⁻¹ ⊗ B⁻¹.
//
// Closure. Of self-adjoint A and B every law that both have: eigenvalues are the products αᵢ βⱼ. Of
// others, that they are projectors.
#pragma once

#include <slant/operators/composition.hpp>
#include <slant/operators/matrix.hpp>

#include <Eigen/Core>

#include <type_traits>
#include <utility>

namespace slant {

namespace detail {

[[nodiscard]] constexpr law_set kronecker_laws(law_set a, law_set b) {
  law_set const both = a & b;
  return both.contains(law::self_adjoint) ? both : both & slant::laws<law::projector>;
}

/// B X and its transpose, the transpose of the result, and workspaces for many columns.
template <class Matrix, class OfA, class OfB>
struct kronecker_workspace {
  Matrix x;   ///< X
  Matrix bx;  ///< B X
  Matrix xb;  ///< (B X)ᵀ
  Matrix yt;  ///< A (B X)ᵀ
  OfA a;
  OfB b;
};

}  // namespace detail

/// y = (A ⊗ B) x on Eigen vectors, also several side by side. A and B are `Operator const&`
/// (referenced) or operator types (owned), which are applied to matrices.
template <class A, class B>
class kronecker_operator {
  using left = std::remove_cvref_t<A>;
  using right = std::remove_cvref_t<B>;
  template <class X>
  using many = Eigen::Matrix<scalar_t<X>, Eigen::Dynamic, Eigen::Dynamic>;

 public:
  static constexpr law_set laws = detail::kronecker_laws(laws_of<A>, laws_of<B>);
  static constexpr bool full_row_rank = declares_full_row_rank<A> && declares_full_row_rank<B>;

  kronecker_operator(held<A> a, held<B> b) : a_(std::move(a)), b_(std::move(b)) {}

  [[nodiscard]] index rows() const { return a_.get().rows() * b_.get().rows(); }
  [[nodiscard]] index cols() const { return a_.get().cols() * b_.get().cols(); }

  template <class X>
    requires linear_operator<left, many<X>> && linear_operator<right, many<X>>
  [[nodiscard]] auto workspace(X const&) const {
    return make_workspace<false, X>();
  }
  template <eigen_matrix X, class Y, class W>
    requires linear_operator<left, many<X>> && linear_operator<right, many<X>>
  void apply(X const& x, Y& y, W& w) const {
    run<false>(x, y, w);
  }

  template <class X>
    requires has_adjoint<left, many<X>> && has_adjoint<right, many<X>>
  [[nodiscard]] auto adjoint_workspace(X const&) const {
    return make_workspace<true, X>();
  }
  template <eigen_matrix X, class Y, class W>
    requires has_adjoint<left, many<X>> && has_adjoint<right, many<X>>
  void apply_adjoint(X const& x, Y& y, W& w) const {
    run<true>(x, y, w);
  }

  template <class D>
    requires has_diagonal<left, plain_t<D>> && has_diagonal<right, plain_t<D>>
  void diagonal(D& d) const {
    detail::require_square("A", a_.get());
    detail::require_square("B", b_.get());
    auto of_a = slant::like(d, a_.get().rows());
    auto of_b = slant::like(d, b_.get().rows());
    a_.get().diagonal(of_a);
    b_.get().diagonal(of_b);
    for (index i = 0; i < index(of_a.size()); ++i) {
      d.segment(i * of_b.size(), of_b.size()) = of_a[i] * of_b;
    }
  }
  [[nodiscard]] auto inverse() const
    requires detail::knows_its_inverse<left> && detail::knows_its_inverse<right>
  {
    using of_a = std::remove_cvref_t<decltype(a_.get().inverse())>;
    using of_b = std::remove_cvref_t<decltype(b_.get().inverse())>;
    return kronecker_operator<of_a, of_b>(held<of_a>(a_.get().inverse()),
                                          held<of_b>(b_.get().inverse()));
  }

 private:
  template <bool Adjoint, class X>
  [[nodiscard]] auto make_workspace() const {
    auto const& a = a_.get();
    auto const& b = b_.get();
    index const from_a = Adjoint ? a.rows() : a.cols(), to_a = Adjoint ? a.cols() : a.rows();
    index const from_b = Adjoint ? b.rows() : b.cols(), to_b = Adjoint ? b.cols() : b.rows();
    many<X> x(from_b, from_a), xb(from_a, to_b);
    auto of_a = detail::oriented_workspace<Adjoint>(a, xb);
    auto of_b = detail::oriented_workspace<Adjoint>(b, x);
    return detail::kronecker_workspace<many<X>, decltype(of_a), decltype(of_b)>{
        std::move(x),        many<X>(to_b, from_a), std::move(xb),
        many<X>(to_a, to_b), std::move(of_a),       std::move(of_b)};
  }
  template <bool Adjoint, class X, class Y, class W>
  void run(X const& x, Y& y, W& w) const {
    for (index c = 0; c < index(x.cols()); ++c) {
      w.x.reshaped() = x.col(c);
      detail::apply_oriented<Adjoint>(b_.get(), w.x, w.bx, w.b);
      w.xb = w.bx.transpose();
      detail::apply_oriented<Adjoint>(a_.get(), w.xb, w.yt, w.a);
      for (index i = 0; i < index(w.yt.rows()); ++i) {
        y.col(c).segment(i * w.yt.cols(), w.yt.cols()) = w.yt.row(i).transpose();
      }
    }
  }

  held<A> a_;
  held<B> b_;
};

/// A ⊗ B. Lvalues are referenced.
template <operand A, operand B>
[[nodiscard]] auto kronecker(A&& a, B&& b) {
  return kronecker_operator<part_t<A>, part_t<B>>(
      held<part_t<A>>(slant::as_operator(std::forward<A>(a))),
      held<part_t<B>>(slant::as_operator(std::forward<B>(b))));
}

}  // namespace slant
