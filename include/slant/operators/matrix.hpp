// SPDX-License-Identifier: MIT
//
// A sparse or dense Eigen matrix as an operator.
//
//     auto A = slant::matrix(M);                                          // promises nothing
//     auto K = slant::matrix<slant::self_adjoint, slant::positive_definite>(M);
//     auto S = slant::matrix<slant::self_adjoint>(M, slant::check_symmetry);
//
// Laws are asserted by the caller: definiteness costs a factorisation to verify. Symmetry is
// verified only on request, in one pass over the entries.
#pragma once

#include <slant/base/held.hpp>
#include <slant/base/long_arrays.hpp>
#include <slant/base/matrix_entries.hpp>
#include <slant/concepts/capabilities.hpp>
#include <slant/concepts/member_names.hpp>

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include <concepts>
#include <cstdint>
#include <type_traits>
#include <utility>

namespace slant {

namespace detail {

// By overload: x.head(3) derives from EigenBase of another class than its own.
template <class M>
void eigen_object(Eigen::EigenBase<M> const&);

}  // namespace detail

/// An Eigen matrix or matrix expression, dense or sparse, of real numbers.
template <class M>
concept eigen_matrix = requires(std::remove_cvref_t<M> const& m) {
  typename std::remove_cvref_t<M>::PlainObject;
  detail::eigen_object(m);
  requires scalar<typename std::remove_cvref_t<M>::Scalar>;
};

namespace detail {

/// Whether m x is a sum for each row of a sparse matrix, over a stream of entries.
template <class M, class X, class Y>
concept streamed_by_rows =
    std::is_base_of_v<Eigen::SparseCompressedBase<M>, M> && M::IsRowMajor != 0 &&
    M::IsVectorAtCompileTime == 0 && std::is_floating_point_v<typename M::Scalar> &&
    std::is_base_of_v<Eigen::PlainObjectBase<X>, X> &&
    std::is_base_of_v<Eigen::PlainObjectBase<Y>, Y> && X::ColsAtCompileTime == 1 &&
    Y::ColsAtCompileTime == 1 && std::same_as<typename Y::Scalar, typename M::Scalar>;

/// Row i of m times x.
template <class M, class X>
[[nodiscard]] typename M::Scalar times_row(M const& m, index i, X const& x) {
  using S = typename M::Scalar;
  constexpr std::intptr_t distance = 2048;  // bytes of entries
  auto const* const sizes = m.innerNonZeroPtr();
  auto const* const column = m.innerIndexPtr();
  S const* const entry = m.valuePtr();
  index e = m.outerIndexPtr()[i];
  index const end = sizes ? e + sizes[i] : index(m.outerIndexPtr()[i + 1]);
  S a(0), b(0);
  for (; e + 8 <= end; e += 8) {
    read_ahead<8 * sizeof(S)>(entry + e, distance);
    read_ahead<8 * sizeof(*column)>(column + e, distance / 2);
    for (index k = e; k < e + 8; k += 2) {
      a += entry[k] * x[column[k]];
      b += entry[k + 1] * x[column[k + 1]];
    }
  }
  for (; e + 2 <= end; e += 2) {
    a += entry[e] * x[column[e]];
    b += entry[e + 1] * x[column[e + 1]];
  }
  if (e < end) a += entry[e] * x[column[e]];
  return a + b;
}

/// y = m x, with OpenMP by as many threads as Eigen takes.
template <class M, class X, class Y>
void multiply(M const& m, X const& x, Y&& y) {
  if constexpr (!streamed_by_rows<M, X, std::remove_cvref_t<Y>>) {
    y.noalias() = m * x;
  } else {
#if defined(EIGEN_HAS_OPENMP)
#pragma omp parallel for num_threads(Eigen::nbThreads()) if (m.nonZeros() > 20000)
#endif
    for (index i = 0; i < m.rows(); ++i) y[i] = times_row(m, i, x);
  }
}

}  // namespace detail

/// y = M x. M is `Matrix const&` (referenced) or a matrix type (owned); L are the asserted laws.
template <class M, law_set L = law_set{}>
class matrix_operator {
 public:
  static constexpr char const* symbol = "matrix";
  using matrix_type = std::remove_cvref_t<M>;
  using scalar = typename matrix_type::Scalar;
  static constexpr law_set laws = L;

  explicit matrix_operator(held<M> m) : m_(std::move(m)) {}

  [[nodiscard]] index rows() const { return m_.get().rows(); }
  [[nodiscard]] index cols() const { return m_.get().cols(); }
  /// The matrix itself.
  [[nodiscard]] matrix_type const& get() const noexcept { return m_.get(); }

  void apply(has_scalar<scalar> auto const& x, auto& y) const {
    if constexpr (reads_rows) {
      apply_adjoint(x, y);
    } else {
      detail::multiply(m_.get(), slant::local(x), slant::local(y));
    }
  }
  void apply_add(scalar α, has_scalar<scalar> auto const& x, auto& y) const {
    if constexpr (reads_rows) {
      apply_adjoint_add(α, x, y);
    } else {
      multiply_add(m_.get(), α, slant::local(x), slant::local(y));
    }
  }
  void apply_adjoint(has_scalar<scalar> auto const& x, auto& y) const {
    detail::multiply(m_.get().transpose(), slant::local(x), slant::local(y));
  }
  void apply_adjoint_add(scalar α, has_scalar<scalar> auto const& x, auto& y) const {
    multiply_add(m_.get().transpose(), α, slant::local(x), slant::local(y));
  }

  /// d = diag(M) of a square matrix.
  void diagonal(has_scalar<scalar> auto& d) const {
    detail::copy_diagonal(m_.get(), slant::local(d));
  }
  void columns(index first, has_scalar<scalar> auto& y) const {
    slant::local(y) = m_.get().middleCols(first, slant::local(y).cols());
  }

 private:
  /// A symmetric matrix by columns, whose columns are its rows: sums in place of scattered terms.
  static constexpr bool reads_rows = [] {
    if constexpr (std::is_base_of_v<Eigen::SparseCompressedBase<matrix_type>, matrix_type>) {
      return L.contains(law::self_adjoint) && !matrix_type::IsRowMajor;
    }
    return false;
  }();

  template <class T, class X, class Y>
  static void multiply_add(T const& m, scalar α, X const& x, Y&& y) {
    if constexpr (std::is_base_of_v<Eigen::SparseMatrixBase<T>, T>) {
      // Eigen's kernel takes α; `y += α * (m * x)` would scale every entry of m, and
      // `y += m * (α * x)` allocates for row-major m.
      Eigen::internal::sparse_time_dense_product(m, x, y, α);
    } else {
      y.noalias() += α * (m * x);
    }
  }

  held<M> m_;
};

namespace detail {

/// How a matrix is kept: stored matrices (also Map and Ref) like any part, expressions evaluated.
template <class M>
inline constexpr bool is_stored_matrix = [] {
  using T = std::remove_cvref_t<M>;
  if constexpr (std::is_base_of_v<Eigen::SparseMatrixBase<T>, T>) {
    return std::is_base_of_v<Eigen::SparseCompressedBase<T>, T>;
  } else {
    return (Eigen::internal::traits<T>::Flags & Eigen::DirectAccessBit) != 0;
  }
}();

template <class M>
using kept_matrix_t = std::conditional_t<std::is_lvalue_reference_v<M> && is_stored_matrix<M>,
                                         kept_t<M>, typename std::remove_cvref_t<M>::PlainObject>;

}  // namespace detail

struct check_symmetry_t {};
/// Asks matrix() to verify that its argument is symmetric up to rounding.
inline constexpr check_symmetry_t check_symmetry{};

/// The operator y = M x with the asserted laws. Throws bad_input if an entry is NaN or infinite,
/// or if laws are asserted that only square matrices have.
template <law... L, class M>
  requires eigen_matrix<M>
[[nodiscard]] auto matrix(M&& m) {
  matrix_operator<detail::kept_matrix_t<M>, slant::laws<L...>> a{
      held<detail::kept_matrix_t<M>>(std::forward<M>(m))};
  if constexpr (sizeof...(L) > 0) detail::require_square("M", a);
  detail::require_finite_entries("M", a.get());
  return a;
}

/// As above, and throws bad_input naming the worst pair if M is not symmetric up to rounding.
template <law... L, class M>
  requires eigen_matrix<M>
[[nodiscard]] auto matrix(M&& m, check_symmetry_t) {
  auto a = slant::matrix<L...>(std::forward<M>(m));
  detail::require_square("M", a);
  detail::require_symmetric_entries("M", a.get());
  return a;
}

// --- as operator ---------------------------------------------------------------------------------
//
// What the factories of compositions do with their arguments: operators pass through, Eigen
// matrices are wrapped, so `congruence(B, inverse(ldlt(K)))` takes a sparse matrix B as it is.

/// What can be a part of a composition: an Eigen matrix, or an operator as far as can be known
/// before the vectors are.
template <class A>
concept operand = has_rows<std::remove_cvref_t<A>> && has_cols<std::remove_cvref_t<A>> &&
                  (eigen_matrix<A> || has_apply_member<std::remove_cvref_t<A>>);

/// The same with an adjoint, so that Aᵀ can be a part.
template <class A>
concept adjoint_operand =
    operand<A> && (eigen_matrix<A> || has_apply_adjoint_member<std::remove_cvref_t<A>> ||
                   declares_self_adjoint<std::remove_cvref_t<A>>);

namespace detail {

struct as_operator_fn {
  template <operand A>
    requires(!eigen_matrix<A>)
  [[nodiscard]] constexpr A&& operator()(A&& a) const noexcept {
    return std::forward<A>(a);
  }
  template <eigen_matrix M>
  [[nodiscard]] auto operator()(M&& m) const {
    return slant::matrix(std::forward<M>(m));
  }
};

}  // namespace detail

/// The argument as an operator: itself, or slant::matrix(argument) for an Eigen matrix.
inline constexpr detail::as_operator_fn as_operator{};

/// How an argument of deduced type A is kept as a part: `Operator const&` or an operator type.
template <operand A>
using part_t = kept_t<decltype(slant::as_operator(std::declval<A>()))>;

}  // namespace slant
