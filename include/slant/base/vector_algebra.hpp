// SPDX-License-Identifier: MIT
//
// What methods do with whole vectors besides inner products: copies, sums, multiples, products of
// entries. Arguments are vectors, or parts or expressions of Eigen; results come last.
//
//     vectors::axpy(-α, d, x);                x ← x − α d
//     vectors::waxpy(-α, d, x, y);            y ← x − α d
//
// Everything happens on local(x), by the loops of kernels.hpp where entries are contiguous.
#pragma once

#include <slant/concepts/kernels.hpp>
#include <slant/concepts/vector.hpp>

#include <Eigen/Core>

#include <type_traits>

namespace slant::vectors {

namespace detail {

/// Entries in memory; an expression has none.
template <class X>
concept has_memory = requires(X const& x) {
  x.data();
  x.innerStride();
  x.outerStride();
};

/// One entry beside the other within a column.
[[nodiscard]] bool is_contiguous(auto const& x) {
  return x.innerStride() == 1 && (x.outerSize() <= 1 || x.outerStride() == x.innerSize());
}

/// Entries of x and of the others lie in the same order.
template <class X, class... Others>
inline constexpr bool same_order =
    ((bool(X::IsRowMajor) == bool(Others::IsRowMajor) || X::IsVectorAtCompileTime) && ...);

/// f(n, pointers…) if all are contiguous; else f(1, …) for entry after entry. The last one is
/// written to.
template <class F, class Y, class... X>
void run(F const& f, Y& y, X const&... x) {
  eigen_assert(((x.rows() == y.rows() && x.cols() == y.cols()) && ...));
  if constexpr (has_memory<Y> && (has_memory<X> && ...)) {
    if constexpr (same_order<Y, X...>) {
      if (is_contiguous(y) && (is_contiguous(x) && ...)) {
        f(index(y.size()), x.data()..., y.data());
        return;
      }
    }
  }
  for (index j = 0; j < y.cols(); ++j) {
    for (index i = 0; i < y.rows(); ++i) {
      [&](auto const&... entry) {
        f(index(1), &entry..., &y.coeffRef(i, j));
      }(typename X::Scalar(x.coeff(i, j))...);
    }
  }
}

/// The same on the local parts of vectors, y with the size of the x.
template <class F, class Y, class X, class... Others>
void assign(F const& f, Y& y, X const& x, Others const&... others) {
  auto&& to = slant::local(y);
  auto const& from = slant::local(x);
  if (to.rows() != from.rows() || to.cols() != from.cols()) to.resize(from.rows(), from.cols());
  detail::run(f, to, from, slant::local(others)...);
}

template <class X>
using factor = std::type_identity_t<scalar_t<X>>;

}  // namespace detail

/// y ← α.
template <class Y>
void fill(detail::factor<Y> const& α, Y&& y) {
  using S = scalar_t<Y>;
  auto&& to = slant::local(y);
  detail::run([&](index n, S* t) { kernels::fill(n, α, t); }, to);
}

/// y ← 0.
template <class Y>
void set_zero(Y&& y) {
  vectors::fill(scalar_t<Y>(0), y);
}

/// y ← x; y takes the size of x.
template <class X, class Y>
void copy(X const& x, Y&& y) {
  detail::assign(kernels::copy<scalar_t<X>>, y, x);
}

/// y ← α x; y takes the size of x.
template <class X, class Y>
void scale(detail::factor<X> const& α, X const& x, Y&& y) {
  using S = scalar_t<X>;
  detail::assign([&](index n, S const* a, S* t) { kernels::scale(n, α, a, t); }, y, x);
}
/// y ← α y.
template <class Y>
void scale(detail::factor<Y> const& α, Y&& y) {
  vectors::scale(α, y, y);
}

/// y ← −x; y takes the size of x.
template <class X, class Y>
void negate(X const& x, Y&& y) {
  vectors::scale(scalar_t<X>(-1), x, y);
}

/// y ← y / α, rounded once where scale(1 / α, y) rounds twice.
template <class Y>
void divide(detail::factor<Y> const& α, Y&& y) {
  using S = scalar_t<Y>;
  detail::assign([&](index n, S const* a, S* t) { kernels::divide(n, α, a, t); }, y, y);
}

/// w ← α x + β y; w takes their size, and may be one of them.
template <class X, class Y, class W>
void waxpby(detail::factor<X> const& α, X const& x, detail::factor<X> const& β, Y const& y, W&& w) {
  using S = scalar_t<X>;
  detail::assign([&](index n, S const* a, S const* b, S* t) { kernels::waxpby(n, α, a, β, b, t); },
                 w, x, y);
}

/// y ← y + α x.
template <class X, class Y>
void axpy(detail::factor<X> const& α, X const& x, Y&& y) {
  vectors::waxpby(scalar_t<X>(1), y, α, x, y);
}
/// w ← α x + y; w takes their size, and may be one of them.
template <class X, class Y, class W>
void waxpy(detail::factor<X> const& α, X const& x, Y const& y, W&& w) {
  vectors::waxpby(scalar_t<X>(1), y, α, x, w);
}
/// z ← x + y; z takes their size, and may be one of them.
template <class X, class Y, class Z>
void sum(X const& x, Y const& y, Z&& z) {
  vectors::waxpby(scalar_t<X>(1), x, scalar_t<X>(1), y, z);
}
/// z ← x − y; z takes their size, and may be one of them.
template <class X, class Y, class Z>
void difference(X const& x, Y const& y, Z&& z) {
  vectors::waxpby(scalar_t<X>(1), x, scalar_t<X>(-1), y, z);
}
/// y ← y + x.
template <class X, class Y>
void add(X const& x, Y&& y) {
  vectors::axpy(scalar_t<X>(1), x, y);
}
/// y ← y − x.
template <class X, class Y>
void subtract(X const& x, Y&& y) {
  vectors::axpy(scalar_t<X>(-1), x, y);
}

/// z ← x y, entry by entry; z takes their size, and may be one of them.
template <class X, class Y, class Z>
void multiply(X const& x, Y const& y, Z&& z) {
  detail::assign(kernels::multiply<scalar_t<X>>, z, x, y);
}

/// z ← x / y, entry by entry; z takes their size, and may be one of them.
template <class X, class Y, class Z>
void quotient(X const& x, Y const& y, Z&& z) {
  detail::assign(kernels::quotient<scalar_t<X>>, z, x, y);
}

/// y ← x where the mask is not 0 and 0 elsewhere; y takes the size of x, and may be x.
template <class M, class X, class Y>
void keep(M const& mask, X const& x, Y&& y) {
  detail::assign(kernels::keep<scalar_t<X>>, y, mask, x);
}
/// y ← x where the mask is 0 and 0 elsewhere; y takes the size of x, and may be x.
template <class M, class X, class Y>
void keep_complement(M const& mask, X const& x, Y&& y) {
  detail::assign(kernels::keep_complement<scalar_t<X>>, y, mask, x);
}

/// x == y, in the entries that live here.
template <class X, class Y>
[[nodiscard]] bool equal(X const& x, Y const& y) {
  using S = scalar_t<X>;
  auto const& a = slant::local(x);
  auto const& b = slant::local(y);
  bool all = a.rows() == b.rows() && a.cols() == b.cols();
  if (all) {
    detail::run([&](index n, S const* p, S const* q) { all = all && kernels::equal(n, p, q); }, b,
                a);
  }
  return all;
}

}  // namespace slant::vectors
