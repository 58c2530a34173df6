// SPDX-License-Identifier: MIT
//
// N numbers side by side in vector registers: a column of an N × N block.
//
//     s.add(a, x₀);  s.add(a + N, x₁);  s.add(a + 2N, x₂)        s += A x,  A stored by columns
//
// A column of three floats is loaded as four, of which the fourth belongs to what follows in memory
// and ends in a lane that nothing reads. So blocks lie close together, three registers instead of
// nine numbers pass through the processor, and what is read is allocated `size` − N numbers longer.
//
// The vector extensions of g++ and clang++ are what both compile to the registers of any processor;
// 16 bytes are those that every one has.
#pragma once

#include <cstring>
#include <type_traits>
#include <utility>

namespace slant::detail {

/// f(0), …, f(N − 1), each with its number as a constant.
template <int N, class F>
[[gnu::always_inline]] inline void unrolled(F&& f) {
  [&]<int... k>(std::integer_sequence<int, k...>) __attribute__((always_inline)) {
    (f(std::integral_constant<int, k>{}), ...);
  }
  (std::make_integer_sequence<int, N>{});
}

/// A register of numbers T; of scalars that have none, one number.
template <class T>
struct vector_register {
  static constexpr int width = 1;
  struct type {
    T value;
  };
};
template <>
struct vector_register<float> {
  static constexpr int width = 4;
  typedef float type __attribute__((vector_size(16)));
};
template <>
struct vector_register<double> {
  static constexpr int width = 2;
  typedef double type __attribute__((vector_size(16)));
};

/// N numbers in as few registers as hold them, or one by one where that leaves half of one empty.
template <class T, int N,
          bool = (2 * N > vector_register<T>::width && vector_register<T>::width > 1)>
struct lanes {
  using part = typename vector_register<T>::type;
  static constexpr int width = vector_register<T>::width;
  static constexpr int parts = (N + width - 1) / width;
  static constexpr int size = parts * width;  ///< numbers that load reads

  part v[parts];

  [[nodiscard, gnu::always_inline]] static lanes zero() {
    lanes l;
    for (int k = 0; k < parts; ++k) l.v[k] = part{};
    return l;
  }
  /// `size` numbers from p on, of which N count.
  [[nodiscard, gnu::always_inline]] static lanes load(T const* p) {
    lanes l;
    std::memcpy(static_cast<void*>(&l.v), p, sizeof l.v);
    return l;
  }
  /// All `size` of them.
  [[gnu::always_inline]] void store_padded(T* p) const { std::memcpy(p, &v, sizeof v); }
  /// The N that count.
  [[gnu::always_inline]] void store(T* p) const { std::memcpy(p, &v, N * sizeof(T)); }
  [[nodiscard, gnu::always_inline]] T operator[](int c) const { return v[c / width][c % width]; }
  /// += α p, p as in load.
  [[gnu::always_inline]] void add(T const* p, T α) {
    unrolled<parts>([&](auto k) __attribute__((always_inline)) {
      part a;
      std::memcpy(&a, p + k * width, sizeof a);
      v[k] += a * α;
    });
  }
  [[gnu::always_inline]] void add(lanes const& a, T α) {
    unrolled<parts>([&](auto k) __attribute__((always_inline)) { v[k] += a.v[k] * α; });
  }
  /// += a b, lane by lane.
  [[gnu::always_inline]] void add_product(lanes const& a, lanes const& b) {
    unrolled<parts>([&](auto k) __attribute__((always_inline)) { v[k] += a.v[k] * b.v[k]; });
  }
  [[gnu::always_inline]] lanes& operator+=(lanes const& a) {
    unrolled<parts>([&](auto k) __attribute__((always_inline)) { v[k] += a.v[k]; });
    return *this;
  }
  [[gnu::always_inline]] lanes& operator-=(lanes const& a) {
    unrolled<parts>([&](auto k) __attribute__((always_inline)) { v[k] -= a.v[k]; });
    return *this;
  }
};

template <class T, int N>
struct lanes<T, N, false> {
  static constexpr int size = N;

  T v[N];

  [[nodiscard, gnu::always_inline]] static lanes zero() {
    lanes l;
    for (int k = 0; k < N; ++k) l.v[k] = T(0);
    return l;
  }
  [[nodiscard, gnu::always_inline]] static lanes load(T const* p) {
    lanes l;
    for (int k = 0; k < N; ++k) l.v[k] = p[k];
    return l;
  }
  [[gnu::always_inline]] void store_padded(T* p) const { store(p); }
  [[gnu::always_inline]] void store(T* p) const {
    for (int k = 0; k < N; ++k) p[k] = v[k];
  }
  [[nodiscard, gnu::always_inline]] T const& operator[](int c) const { return v[c]; }
  [[gnu::always_inline]] void add(T const* p, T const& α) {
    unrolled<N>([&](auto k) __attribute__((always_inline)) { v[k] += p[k] * α; });
  }
  [[gnu::always_inline]] void add(lanes const& a, T const& α) { add(a.v, α); }
  [[gnu::always_inline]] void add_product(lanes const& a, lanes const& b) {
    unrolled<N>([&](auto k) __attribute__((always_inline)) { v[k] += a.v[k] * b.v[k]; });
  }
  [[gnu::always_inline]] lanes& operator+=(lanes const& a) {
    unrolled<N>([&](auto k) __attribute__((always_inline)) { v[k] += a.v[k]; });
    return *this;
  }
  [[gnu::always_inline]] lanes& operator-=(lanes const& a) {
    unrolled<N>([&](auto k) __attribute__((always_inline)) { v[k] -= a.v[k]; });
    return *this;
  }
};

/// The sum of the N numbers.
template <class T, int N>
[[nodiscard, gnu::always_inline]] inline T sum_of_lanes(lanes<T, N> const& l) {
  T s = l[0];
  for (int c = 1; c < N; ++c) s += l[c];
  return s;
}

}  // namespace slant::detail
