// SPDX-License-Identifier: MIT
//
// A * x for Eigen vectors: computed when it is assigned, straight into the vector on the left.
//
//     y = A * x;      y += A * x;      VectorXd y = A * x;      y.segment(0, m) = A * x;
//     y = (A * x).in(w);               // with a workspace made earlier: no allocation
//     r = A * x - b;                   // Eigen's arithmetic: one temporary for A x
//     x = A * x;                       // bad_input: x is read and written
//
// Matrices with several columns are factors, not arguments: for those slant::apply(A, X, Y).
#pragma once

#include <slant/base/diagnosis.hpp>
#include <slant/operators/syntax.hpp>

#include <Eigen/Core>

#include <functional>
#include <type_traits>

namespace slant::expr {
template <class A, class X, class W = void>
class applied;
}  // namespace slant::expr

namespace Eigen::internal {
template <class A, class X, class W>
struct traits<slant::expr::applied<A, X, W>> {
  using plain = slant::plain_t<std::remove_cvref_t<X>>;
  // What the type of x says of its rows holds for A x if A is known to be square.
  static constexpr bool same_rows =
      plain::RowsAtCompileTime == Dynamic || slant::declares_self_adjoint<A>;
  using ReturnType =
      std::conditional_t<same_rows, plain, Matrix<typename plain::Scalar, Dynamic, 1>>;
  enum { Flags = EvalBeforeNestingBit };
};
}  // namespace Eigen::internal

namespace slant::expr {

/// Throws bad_input if y and x share memory, as far as both have any that can be seen: rows of a
/// matrix by columns lie in each other's gaps.
void refuse_overlap(auto const& x, auto const& y) {
  if constexpr (requires { x.data(), y.data(), x.innerStride(), y.innerStride(); }) {
    auto const end = [](auto const& v) { return v.data() + (v.size() - 1) * v.innerStride() + 1; };
    std::less<void const*> const before{};
    if (x.size() > 0 && y.size() > 0 && before(x.data(), end(y)) && before(y.data(), end(x))) {
      if constexpr (requires { x.data() - y.data(); }) {
        auto const step = x.innerStride();
        if (step == y.innerStride() && step > 1 && (x.data() - y.data()) % step != 0) return;
      }
      throw bad_input("y = A * x", "a y that shares memory with x", "two different vectors");
    }
  }
}

/// What is said of an A that cannot be applied to vectors of type V.
template <class A, class V>
struct argument_demands {
  using a = slant::detail::questions_about<A, V>;
  static_assert(linear_operator<typename a::whole, typename a::vector_type>,
                "A * x: A must be a linear operator on vectors like x");
  static_assert(slant::detail::usable_part<typename a::part, typename a::vector_type>,
                "A * x: a part of A, or its adjoint, cannot be used on vectors like x");
  static constexpr bool told = true;
};

template <class A, class X, class Y, class W>
void assign_application(A const& a, X const& x, Y& y, W& w) {
  expr::refuse_overlap(x, y);
  if constexpr (slant::detail::applies<A, X, Y>) {
    slant::apply(a, x, y, w);
  } else if constexpr (linear_operator<A, plain_t<X>>) {  // an operator on one type of vectors
    plain_t<X> const from = x;
    plain_t<X> to = slant::like(from, a.rows());
    slant::apply(a, from, to, w);
    y = to;
  } else {
    static_assert(argument_demands<A, plain_t<X>>::told);
  }
}

/// A x, not yet computed. Lvalues that are no handles are referenced. W: temporaries that the
/// caller keeps; void: none.
template <class A, class X, class W>
class applied : public Eigen::ReturnByValue<applied<A, X, W>> {
  using operator_type = std::remove_cvref_t<A>;
  using vector_type = plain_t<std::remove_cvref_t<X>>;

 public:
  applied(held<A> a, held<X> x, W* w = nullptr) : a_(std::move(a)), x_(std::move(x)), w_(w) {}

  [[nodiscard]] index rows() const { return a_.get().rows(); }
  [[nodiscard]] index cols() const { return 1; }

  void evalTo(auto& y) const {
    if constexpr (std::is_void_v<W>) {
      auto w = slant::workspace(a_.get(), x_.get());
      expr::assign_application(a_.get(), x_.get(), y, w);
    } else {
      expr::assign_application(a_.get(), x_.get(), y, *w_);
    }
  }
  /// y ← y + A x.
  template <class Y>
  void add_to(Y& y) const {
    auto const& a = a_.get();
    expr::refuse_overlap(x_.get(), y);
    if constexpr (slant::detail::adds<operator_type, std::remove_cvref_t<X>, Y>) {
      auto w = slant::detail::accumulate_workspace(a, x_.get());
      slant::detail::accumulate(a, scalar_t<Y>(1), x_.get(), y, w);
    } else {
      y += this->eval();
    }
  }
  /// The same with the temporaries slant::workspace(A, x).
  template <class Kept>
    requires std::same_as<Kept, workspace_t<operator_type, vector_type>>
  [[nodiscard]] applied<A, X, Kept> in(Kept& w) const {
    return {a_, x_, &w};
  }

 private:
  held<A> a_;
  held<X> x_;
  W* w_;
};

/// A column of Eigen.
template <class X>
concept eigen_vector = eigen_matrix<X> && (std::remove_cvref_t<X>::ColsAtCompileTime == 1);

/// How x is kept: like any part, views as they are, so that overlap shows; expressions evaluated.
template <class X>
using kept_vector_t = std::conditional_t<slant::detail::is_stored_matrix<X>, kept_t<X>,
                                         typename std::remove_cvref_t<X>::PlainObject>;

template <class A>
std::remove_cvref_t<A> refuse_column(A&& a) {
  static_assert(!std::same_as<A, A>,
                "an operator and a vector cannot be added; x -> A x + c is slant::affine(A, c)");
  return a;
}

}  // namespace slant::expr

namespace slant {

/// A x, see the top of this file. @throws bad_input if x has not cols() entries.
template <linear_term A, expr::eigen_vector X>
[[nodiscard]] auto operator*(A&& a, X&& x) {
  using kept = expr::kept_vector_t<X>;
  detail::check_rows("x", x, index(a.cols()), "cols() of the operator");
  return expr::applied<kept_t<A>, kept>(held<kept_t<A>>(std::forward<A>(a)),
                                        held<kept>(static_cast<kept>(std::forward<X>(x))));
}

/// Refused: a sum or a difference with a column is no operator.
template <linear_term A, expr::eigen_vector X>
std::remove_cvref_t<A> operator+(A&& a, X&&) {
  return expr::refuse_column(a);
}
template <linear_term A, expr::eigen_vector X>
std::remove_cvref_t<A> operator-(A&& a, X&&) {
  return expr::refuse_column(a);
}
template <linear_term A, expr::eigen_vector X>
std::remove_cvref_t<A> operator+(X&&, A&& a) {
  return expr::refuse_column(a);
}
template <linear_term A, expr::eigen_vector X>
std::remove_cvref_t<A> operator-(X&&, A&& a) {
  return expr::refuse_column(a);
}

/// y ← y + A x without a temporary, where A can add.
template <class Y, class A, class X>
Y& operator+=(Eigen::MatrixBase<Y>& y, expr::applied<A, X> const& ax) {
  ax.add_to(y.derived());
  return y.derived();
}

}  // namespace slant
