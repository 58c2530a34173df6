// SPDX-License-Identifier: MIT
//
// Vectors spread over processes.
//
// Intuition. All processes run the same method on their own parts. Whatever decides the next step
// must come out the same on all of them: norms do, since inner products are global, but "is x in
// Λ?" and "how far is the boundary?" are answered by each process for its own blocks.
//
// Minimal definition. Nothing for vectors of one process. Otherwise, besides those of vector.hpp,
// members
//     minimum(s)       the smallest of the numbers s that the processes come with, the same for
//     all, global_size()    the number of entries on all processes together.
//
// Laws.   minimum(s) ≤ s, with equality on one process at least;   global_size() = Σ local sizes.
//
// Models. Every vector; those of one process trivially. A block of a set lies on one process.
#pragma once

#include <slant/concepts/vector.hpp>

#include <concepts>

namespace slant {

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
  if constexpr (has_minimum<V>) {
    using S = scalar_t<V>;
    return x.minimum(holds ? S(1) : S(0)) > S(0);
  } else {
    return holds;
  }
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

}  // namespace slant
