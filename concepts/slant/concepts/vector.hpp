// SPDX-License-Identifier: MIT
//
// Vectors: an Eigen object plus an inner product.
//
// Intuition. Elementwise work is done on `local(x)`, the part of the vector that lives here, by
// base/vector_algebra.hpp; only inner products, the two reductions below, and operators
// may communicate.
//
// Minimal definition. Nothing for Eigen column vectors. Otherwise members
//     local()            the local part, an Eigen column vector (lvalue, const and non-const),
//     inner_product(y)   the global inner product, the same value on every process,
//     like(n)            a vector of the same kind with n local entries (contents arbitrary).
// Entries that live elsewhere: keep an Eigen::Map of them beside and return that; copies need a Map
// of their own.
//
// Laws.   inner_product(x, y) = inner_product(y, x),   inner_product(x, x) ≥ 0,   linear in x,
//         norm(x)² = inner_product(x, x).
//
// Models. Eigen::VectorXd and friends of any scalar, slant::testing::archetype::vector.
//
// Rejected: a concept listing axpy, scal, pointwise maps. Every method needs a few more of those,
// each distributed vector would have to supply them all, and they are the same for all: on
// local(x).
#pragma once

#include <slant/concepts/kernels.hpp>
#include <slant/concepts/scalar.hpp>

#include <cassert>
#include <cmath>
#include <concepts>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>

namespace slant {

template <class V> concept has_local_member = requires(V& v) { v.local(); };

namespace detail {

struct local_fn {
  // An lvalue is returned as an lvalue: elementwise code can assign to local(y).
  template <class V>
  [[nodiscard]] constexpr decltype(auto) operator()(V&& v) const noexcept {
    if constexpr (has_local_member<std::remove_reference_t<V>>) {
      return v.local();
    } else {
      return static_cast<V&&>(v);
    }
  }
};

}  // namespace detail

/// The (local part of the) vector as an Eigen object: v.local() if there is one, else v itself.
inline constexpr detail::local_fn local{};

/// The Eigen type behind a vector.
template <class V>
using local_t = std::remove_cvref_t<decltype(slant::local(std::declval<V&>()))>;

/// The scalar of a vector.
template <class V>
using scalar_t = typename local_t<V>::Scalar;

/// A vector or matrix of numbers S.
template <class V, class S> concept has_scalar = std::same_as<scalar_t<V>, S>;

template <class V>
concept has_local = requires(V& v, V const& c) {
  { slant::local(c).size() } -> std::convertible_to<index>;
  typename local_t<V>::Scalar;
  slant::local(v).setZero();
};

/// local(x) is an object that stays, not a view made for the occasion: what is passed on by
/// reference can be written to.
template <class V>
concept local_is_lvalue =
    std::is_lvalue_reference_v<decltype(slant::local(std::declval<V&>()))> &&
    std::is_lvalue_reference_v<decltype(slant::local(std::declval<V const&>()))>;

template <class V> concept has_inner_product_member = requires(V const& x) { x.inner_product(x); };

namespace detail {

template <class X, class Y> concept has_dot = requires(X const& x, Y const& y) { x.dot(y); };

/// A column vector of Eigen that owns its entries: they are contiguous, and kernels.hpp does what
/// its expressions would.
template <class X>
concept plain_column = requires {
  requires std::is_same_v<typename X::PlainObject, X>;
  requires X::ColsAtCompileTime == 1;
  requires X::InnerStrideAtCompileTime == 1;
};

/// What the vectors themselves return, whatever its type. An own vector answers for itself: a dot
/// that it inherits is not asked.
template <class X, class Y>
  requires has_inner_product_member<X> || has_dot<X, Y>
[[nodiscard]] decltype(auto) own_inner_product(X const& x, Y const& y) {
  if constexpr (has_inner_product_member<X>) {
    return x.inner_product(y);
  } else if constexpr (plain_column<X> && std::is_same_v<X, Y>) {
    assert(x.size() == y.size());
    return kernels::dot(index(x.size()), x.data(), y.data());
  } else {
    return x.dot(y);
  }
}

struct inner_product_fn {
  template <class X, class Y>
  [[nodiscard]] auto operator()(X const& x, Y const& y) const -> scalar_t<X>
    requires requires {
      { detail::own_inner_product(x, y) } -> std::convertible_to<scalar_t<X>>;
    }
  {
    return detail::own_inner_product(x, y);
  }
};

}  // namespace detail

/// Global inner product xᵀy. Both vectors have the same number of entries.
inline constexpr detail::inner_product_fn inner_product{};

/// inner_product(x, x) is a number that the vector's own scalar can hold.
template <class V>
concept has_inner_product = requires(V const& x) {
  { detail::own_inner_product(x, x) } -> std::convertible_to<scalar_t<V>>;
};

namespace detail {

struct norm_fn {
  template <class X>
  [[nodiscard]] auto operator()(X const& x) const -> scalar_t<X> {
    using std::sqrt;
    using S = scalar_t<X>;
    S const square = slant::inner_product(x, x);
    if (in_range(square)) return sqrt(square);
    if constexpr (has_inner_product_member<X>) {
      return rescaled_norm(x, square);
    } else {
      return scaled_norm<S>(slant::local(x));
    }
  }

 private:
  /// Did squares neither overflow nor lose digits? The same answer on all processes.
  template <class S>
  static bool in_range(S const& square) {
    using limits = std::numeric_limits<S>;
    return square > limits::min() * power_of_two<S>(2 * limits::digits) && square < limits::max();
  }
  /// For a vector of which only the inner product is known: scaled by powers of two until it fits.
  template <class X, class S>
  static S rescaled_norm(X const& x, S square) {
    using std::ldexp;
    using std::sqrt;
    constexpr int stride =
        std::numeric_limits<S>::max_exponent / 2 - std::numeric_limits<S>::digits;
    X y = x;
    int e = 0;
    for (int attempt = 0; attempt < 3 && !in_range(square); ++attempt) {
      int const shift = square < S(1) ? stride : -stride;
      e += shift;
      slant::local(y) *= power_of_two<S>(shift);
      square = slant::inner_product(y, y);
    }
    return ldexp(S(sqrt(square)), -e);
  }
  /// Scaled by a power of two, which is exact: the same bits in all units 2^k (stableNorm rounds).
  template <class S, class L>
  static S scaled_norm(L const& v) {
    using std::ldexp;
    using std::sqrt;
    S const largest = largest_entry<S>(v);
    if (!(largest > S(0)) || !(largest <= std::numeric_limits<S>::max())) return largest;
    constexpr int least = 3 - std::numeric_limits<S>::max_exponent;
    int const e = binary_exponent(largest) < least ? least : binary_exponent(largest);
    return ldexp(S(sqrt(scaled_square(v, power_of_two<S>(-e)))), e);
  }
  /// max |v_i|, or NaN.
  template <class S, class L>
  static S largest_entry(L const& v) {
    if constexpr (plain_column<L>) {
      return kernels::largest(index(v.size()), v.data());
    } else {
      S largest(0);
      for (index i = 0; i < index(v.size()); ++i) {
        S const entry = v.coeff(i);
        S const now = kernels::largest(1, &entry);
        if (largest == largest && !(now <= largest)) largest = now;
      }
      return largest;
    }
  }
  /// Σ (α v_i)².
  template <class S, class L>
  static S scaled_square(L const& v, S const& α) {
    if constexpr (plain_column<L>) {
      return kernels::scaled_square(index(v.size()), α, v.data());
    } else {
      S sum(0);
      for (index i = 0; i < index(v.size()); ++i) {
        S const entry = α * v.coeff(i);
        sum += entry * entry;
      }
      return sum;
    }
  }
};

}  // namespace detail

/// Euclidean norm belonging to inner_product; safe against overflow and underflow of the squares.
inline constexpr detail::norm_fn norm{};

template <class V> concept has_like_member = requires(V const& x, index n) { x.like(n); };

namespace detail {

template <class X> concept has_plain_object = requires { typename X::PlainObject; };

struct like_fn {
  template <class X>
    requires has_like_member<X> || has_plain_object<X>
  [[nodiscard]] auto operator()(X const& x, index n) const {
    if constexpr (has_like_member<X>) {
      return x.like(n);
    } else {
      return sized<typename X::PlainObject>(n, x.cols());  // several right-hand sides stay several
    }
  }

 private:
  // Apart: g++ 12 moves y out of a function with `if constexpr`, and warns that it is not set.
  template <class P>
  [[nodiscard]] static P sized(index n, index columns) {
    if constexpr (requires { requires int(P::RowsAtCompileTime) >= 0; }) {
      constexpr index rows = P::RowsAtCompileTime;
      if (n != rows) {
        throw std::invalid_argument("vector: got a type of " + std::to_string(rows) +
                                    " entries where " + std::to_string(n) +
                                    " are needed, expected one whose size is not part of its type");
      }
    }
    P y;
    y.resize(n, columns);
    return y;
  }
};

}  // namespace detail

/// A vector of the kind of x with n (local) entries and arbitrary contents.
inline constexpr detail::like_fn like{};

template <class V> concept has_like = requires(V const& x, index n) { slant::like(x, n); };

/// The owning type of a vector expression: what `like` returns.
template <class X>
using plain_t = decltype(slant::like(std::declval<X const&>(), index{}));

/// An expression such as 2 * x, or a view, refers to entries of others: a state cannot keep it.
template <class V> concept owns_its_entries = std::is_same_v<plain_t<V>, V>;

/// A row of Eigen is the transpose of a vector.
template <class V>
concept is_no_row = local_t<V>::RowsAtCompileTime != 1 || local_t<V>::ColsAtCompileTime == 1;

/// A vector; see the top of this file.
template <class V>
concept vector =
    has_local<V> && is_no_row<V> && local_is_lvalue<V> && has_like<V> && owns_its_entries<V> &&
    std::copyable<V> && has_inner_product<V> && scalar<scalar_t<V>>;

// --- distributed ---------------------------------------------------------------------------------
//
// Vectors spread over processes.
//
// Intuition. All processes run the same method on their own parts. Whatever decides the next step
// must come out the same on all of them: norms do, since inner products are global, but "is x in
// Λ?" and "how far is the boundary?" are answered by each process for its own blocks.
//
// Minimal definition. Nothing for vectors of one process. Otherwise, besides those of this file,
// members
//     minimum(s)       the smallest of the numbers s that the processes come with, the same for
//     all, global_size()    the number of entries on all processes together.
//
// Laws.   minimum(s) ≤ s, with equality on one process at least;   global_size() = Σ local sizes.
//
// Models. Every vector; those of one process trivially. A block of a set lies on one process.

template <class V>
concept has_minimum = requires(V const& x, scalar_t<V> s) {
  { x.minimum(s) } -> std::convertible_to<scalar_t<V>>;
};
template <class V>
concept has_global_size = requires(V const& x) {
  { x.global_size() } -> std::convertible_to<index>;
};

/// The smallest of the values that all processes holding x come with.
template <class V>
[[nodiscard]] scalar_t<V> minimum(V const& x, scalar_t<V> const& value) {
  if constexpr (has_minimum<V>) {
    return x.minimum(value);
  } else {
    return value;
  }
}

/// Does it hold on all processes that hold x?
template <class V>
[[nodiscard]] bool everywhere(V const& x, bool holds) {
  using S = scalar_t<V>;
  return slant::minimum(x, S(holds ? 1 : 0)) > S(0);
}

/// Number of entries of x on all processes.
template <class V>
[[nodiscard]] index global_size(V const& x) {
  if constexpr (has_global_size<V>) {
    return x.global_size();
  } else {
    return index(slant::local(x).size());
  }
}

/// The sum of the values that all processes holding x come with.
template <class V>
[[nodiscard]] scalar_t<V> total(V const& x, scalar_t<V> const& value) {
  if constexpr (has_global_size<V>) {
    V values = like(x, 1), ones = like(x, 1);
    slant::local(values).coeffRef(0) = value;
    slant::local(ones).coeffRef(0) = scalar_t<V>(1);
    return slant::inner_product(values, ones);
  } else {
    return value;
  }
}

// --- numbers like --------------------------------------------------------------------------------
//
// What a member returns: numbers of the right kind, as many as expected.
//
// Why ask. The members of a set are often templates that take whatever they are given, and Eigen
// converts between scalars of different precision by a constructor: a block that computes in float
// or returns three components instead of two would pass as a block of double precision in the
// plane, and be found out far from where the mistake is, or not at all.
//
// Everything is asked of the structure of a type (Scalar, RowsAtCompileTime, ColsAtCompileTime, as
// Eigen's have them); what a type does not tell is taken for right.

namespace detail {

/// A number of rows or columns that is not known before the program runs.
inline constexpr index unknown_size = -1;

/// M has so many rows and columns, as far as its type tells.
template <class M>
[[nodiscard]] consteval bool may_be_sized(index rows, index cols) {
  auto const differ = [](index told, index asked) {
    return told >= 0 && asked != unknown_size && told != asked;
  };
  bool fits = true;
  if constexpr (requires { index(M::RowsAtCompileTime); }) {
    fits = !differ(M::RowsAtCompileTime, rows);
  }
  if constexpr (requires { index(M::ColsAtCompileTime); }) {
    fits = fits && !differ(M::ColsAtCompileTime, cols);
  }
  return fits;
}

template <class S>
struct numbers {};

/// numbers<S> if X consists of them, X itself if it does not tell.
template <class X>
struct made_of {
  using type = std::remove_cvref_t<X>;
};
template <class X>
  requires requires { typename scalar_t<std::remove_cvref_t<X>>; }
struct made_of<X> {
  using type = numbers<scalar_t<std::remove_cvref_t<X>>>;
};

}  // namespace detail

/// R consists of numbers of the kind that V consists of; where V does not tell, R is V.
template <class R, class V>
concept same_scalar =
    std::is_same_v<typename detail::made_of<R>::type, typename detail::made_of<V>::type>;

/// R has so many rows and columns (unknown_size: any), as far as its type tells.
template <class R, index Rows, index Cols>
concept may_have_size = detail::may_be_sized<local_t<std::remove_cvref_t<R>>>(Rows, Cols);

/// R is a vector or matrix of such size, of numbers of the kind that V consists of.
template <class R, class V, index Rows, index Cols>
concept numbers_like = same_scalar<R, V> && may_have_size<R, Rows, Cols>;

}  // namespace slant
