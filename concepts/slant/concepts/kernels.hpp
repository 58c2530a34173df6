// SPDX-License-Identifier: MIT
//
// The loops over entries that all long vectors go through: contiguous spans, one instance for each
// scalar.
//
// Why not Eigen's expressions: each distinct one is dozens of classes and functions, 30 ms of the
// compiler, and the library has hundreds; and g++ -O2 does not vectorise a loop whose length it
// does not know. So loops take the entries in packs, the vectors of the compiler, as wide as
// Eigen's packets, and sums are added in the order of Eigen's: the same bits as x.dot(y).
//
// Other scalars than float and double go entry by entry.
#pragma once

#include <slant/concepts/scalar.hpp>

#include <type_traits>

namespace slant::kernels {

#if defined(__AVX512F__)
inline constexpr int pack_bytes = 64;
#elif defined(__AVX__)
inline constexpr int pack_bytes = 32;
#else
inline constexpr int pack_bytes = 16;
#endif

/// Scalars that the compiler has vectors of.
template <class S>
inline constexpr bool has_packs = std::is_same_v<S, double> || std::is_same_v<S, float>;

/// So many entries at once.
template <class S>
struct pack_of {
  typedef S type __attribute__((vector_size(pack_bytes)));
  static constexpr index size = pack_bytes / static_cast<index>(sizeof(S));

  [[gnu::always_inline]] static type load(S const* p) {
    type v;
    __builtin_memcpy(&v, p, sizeof v);
    return v;
  }
  [[gnu::always_inline]] static void store(type const& v, S* p) {
    __builtin_memcpy(p, &v, sizeof v);
  }
};

/// y[i] = f(x[i]…); f takes packs and scalars. y may be one of the x.
template <class S, class F, class... X>
[[gnu::always_inline]] inline void each(F const& f, index n, S* y, X const*... x) {
  index i = 0;
  if constexpr (has_packs<S>) {
    using pack = pack_of<S>;
    for (; i + pack::size <= n; i += pack::size) pack::store(f(pack::load(x + i)...), y + i);
  }
  for (; i < n; ++i) y[i] = f(x[i]...);
}

/// Σ f(x[i]…), added as Eigen adds: two packs in turn, then their entries by halves, then the rest.
template <class S, class F, class... X>
[[gnu::always_inline]] inline S sum_of(F const& f, index n, X const*... x) {
  index i = 0;
  S sum(0);
  if constexpr (has_packs<S>) {
    using pack = pack_of<S>;
    if (n >= pack::size) {
      typename pack::type even = f(pack::load(x)...);
      i = pack::size;
      if (n >= 2 * pack::size) {
        typename pack::type odd = f(pack::load(x + i)...);
        for (i += pack::size; i + 2 * pack::size <= n; i += 2 * pack::size) {
          even += f(pack::load(x + i)...);
          odd += f(pack::load(x + i + pack::size)...);
        }
        even += odd;
        if (i + pack::size <= n) {
          even += f(pack::load(x + i)...);
          i += pack::size;
        }
      }
      for (index half = pack::size / 2; half > 0; half /= 2) {
        for (index j = 0; j < half; ++j) even[j] += even[j + half];
      }
      sum = even[0];
    }
  }
  for (; i < n; ++i) sum += f(x[i]...);
  return sum;
}

/// Σ x[i] y[i].
template <class S>
[[nodiscard, gnu::noinline]] S dot(index n, S const* x, S const* y) {
  return sum_of<S>([](auto const& a, auto const& b) { return a * b; }, n, x, y);
}

/// Σ (α x[i])².
template <class S>
[[nodiscard, gnu::noinline]] S scaled_square(index n, S const& α, S const* x) {
  return sum_of<S>([&](auto const& a) { return (α * a) * (α * a); }, n, x);
}

/// The largest |x[i]|, or NaN if there is one among them; 0 for no entries.
template <class S>
[[nodiscard, gnu::noinline]] S largest(index n, S const* x) {
  S size(0);
  for (index i = 0; i < n; ++i) {
    S const now = x[i] < S(0) ? S(-x[i]) : x[i];
    if (size == size && !(now <= size)) size = now;
  }
  return size;
}

/// y ← α.
template <class S>
[[gnu::noinline]] void fill(index n, S const& α, S* y) {
  for (index i = 0; i < n; ++i) y[i] = α;
}

/// y ← x.
template <class S>
[[gnu::noinline]] void copy(index n, S const* x, S* y) {
  each([](auto const& a) { return a; }, n, y, x);
}

/// y ← α x; y may be x.
template <class S>
[[gnu::noinline]] void scale(index n, S const& α, S const* x, S* y) {
  each([&](auto const& a) { return α * a; }, n, y, x);
}

/// y ← x / α; y may be x.
template <class S>
[[gnu::noinline]] void divide(index n, S const& α, S const* x, S* y) {
  each([&](auto const& a) { return a / α; }, n, y, x);
}

/// w ← α x + β y; w may be x or y. A factor of ±1 is not multiplied with.
template <class S>
[[gnu::noinline]] void waxpby(index n, S const& α, S const* x, S const& β, S const* y, S* w) {
  if (α == S(1) && β == S(1)) {
    each([](auto const& a, auto const& b) { return a + b; }, n, w, x, y);
  } else if (α == S(1) && β == S(-1)) {
    each([](auto const& a, auto const& b) { return a - b; }, n, w, x, y);
  } else if (α == S(1)) {
    each([&](auto const& a, auto const& b) { return a + β * b; }, n, w, x, y);
  } else {
    each([&](auto const& a, auto const& b) { return α * a + β * b; }, n, w, x, y);
  }
}

/// z ← x y, entry by entry; z may be x or y.
template <class S>
[[gnu::noinline]] void multiply(index n, S const* x, S const* y, S* z) {
  each([](auto const& a, auto const& b) { return a * b; }, n, z, x, y);
}

/// z ← x / y, entry by entry; z may be x or y.
template <class S>
[[gnu::noinline]] void quotient(index n, S const* x, S const* y, S* z) {
  each([](auto const& a, auto const& b) { return a / b; }, n, z, x, y);
}

/// 0, or a pack of zeros.
template <class S, class T>
[[gnu::always_inline]] inline T zero_of(T const&) {
  if constexpr (std::is_same_v<S, T>) {
    return S(0);
  } else {
    return T{};
  }
}

/// y ← x where the mask is not 0, and 0 elsewhere: a selection, since 0 · ∞ would be NaN. y may be
/// x.
template <class S>
[[gnu::noinline]] void keep(index n, S const* mask, S const* x, S* y) {
  each([](auto const& m, auto const& a) { return m == zero_of<S>(a) ? zero_of<S>(a) : a; }, n, y,
       mask, x);
}
/// y ← x where the mask is 0, and 0 elsewhere; y may be x.
template <class S>
[[gnu::noinline]] void keep_complement(index n, S const* mask, S const* x, S* y) {
  each([](auto const& m, auto const& a) { return m == zero_of<S>(a) ? a : zero_of<S>(a); }, n, y,
       mask, x);
}

/// x[i] == y[i] for all i.
template <class S>
[[nodiscard, gnu::noinline]] bool equal(index n, S const* x, S const* y) {
  for (index i = 0; i < n; ++i) {
    if (!(x[i] == y[i])) return false;
  }
  return true;
}

}  // namespace slant::kernels
