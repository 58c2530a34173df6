// SPDX-License-Identifier: MIT
//
// The points and directions at which the laws of a set are sampled: many scales, axes, the boundary
// and its close neighbourhood.
#pragma once

#include <slant/concepts/convex_set.hpp>
#include <slant/concepts/linear_operator.hpp>
#include <slant/sets/blocks.hpp>
#include <slant/testing/breach.hpp>

#include <Eigen/Core>

#include <cstdint>
#include <limits>
#include <random>
#include <vector>

namespace slant::testing {

// --- set probe -----------------------------------------------------------------------------------

/// How thoroughly a set is sampled.
struct set_options {
  unsigned seed = 1;     ///< of all random choices
  int points = 60;       ///< number of points; laws about two points take pairs of them
  int directions = 4;    ///< random directions at a point, besides the adversarial ones
  double size = 1;       ///< typical length of a point: radius, bound, distance of the centre
  bool interior = true;  ///< false: the interior is empty, and no inequality form describes the set
  double rounding = 64;  ///< accepted error in units of ε (‖x‖ + ‖P(x)‖ + ‖P(0)‖ + size)
};

namespace detail {

/// What a set can do, for dense vectors of scalar S. Functions that the set lacks are empty. The
/// laws are compiled once per scalar, not once per set: that is worth the indirection here.
template <class S>
struct set_probe {
  using scalar = S;
  using dense = Eigen::Matrix<S, Eigen::Dynamic, 1>;
  using matrix = Eigen::Matrix<S, Eigen::Dynamic, Eigen::Dynamic>;

  index size = 0;
  index block_count = 1;
  set_options options;
  S origin{0};                 ///< ‖P(0)‖: how far off the set is
  bool unconstrained = false;  ///< says that it is the whole space

  ability<dense(dense const&)> project;
  ability<dense(dense const&)> project_in_place;  ///< project(x, x)
  ability<dense(dense const&)> project_over_nan;  ///< project(x, y), y full of NaN
  ability<bool(dense const&)> contains;
  ability<matrix(dense const&)> slant;
  ability<matrix(dense const&)> renewed_slant;  ///< into the operator of another point
  ability<S(dense const&, dense const&)> step;
  ability<S(dense const&, dense const&, S const&)> early_step;
  ability<S(dense const&)> support;
  ability<block_state(dense const&)> state;

  int inequalities = 0;
  ability<dense(dense const&)> inequality;
  ability<matrix(dense const&)> inequality_gradient;
  ability<matrix(dense const&, dense const&)> inequality_hessian;

  [[nodiscard]] S distance(dense const& p) const { return slant::norm(dense(p - project(p))); }
  /// Distances that are short or long seen from x.
  [[nodiscard]] S extent(dense const& x) const { return slant::norm(x) + origin; }
  /// Size of the numbers in play at x. A set may compute with its own numbers even at x = 0.
  [[nodiscard]] S magnitude(dense const& x) const { return extent(x) + S(options.size); }
  /// Accepted error of a vector computed from numbers of this size.
  [[nodiscard]] S rounding(S const& magnitude) const {
    return S(options.rounding) * std::numeric_limits<S>::epsilon() * magnitude;
  }
};

/// Copies entry by entry: what GCC makes of Eigen's assignment between static and dynamic sizes it
/// then calls out of bounds.
template <class From, class To>
void copy_entries(From const& from, To& to) {
  for (index j = 0; j < from.cols(); ++j) {
    for (index i = 0; i < from.rows(); ++i) to.coeffRef(i, j) = from.coeff(i, j);
  }
}

/// A vector or matrix as one of dynamic size.
template <class V>
[[nodiscard]] auto dense_of(V const& v) {
  auto const& from = slant::local(v);
  constexpr int columns = local_t<V>::ColsAtCompileTime == 1 ? 1 : Eigen::Dynamic;
  Eigen::Matrix<scalar_t<V>, Eigen::Dynamic, columns> copy(from.rows(), from.cols());
  copy_entries(from, copy);
  return copy;
}

/// G as a dense matrix, from a matrix or column by column from an operator.
template <class G, class V>
[[nodiscard]] auto matrix_of(G const& g, V const& prototype, index n) {
  using S = scalar_t<V>;
  if constexpr (requires { typename G::PlainObject; }) {
    return dense_of(g);
  } else {
    Eigen::Matrix<S, Eigen::Dynamic, Eigen::Dynamic> m(n, n);
    V e = slant::like(prototype, n);
    V column = slant::like(prototype, n);
    for (index j = 0; j < n; ++j) {
      slant::local(e).setZero();
      slant::local(e)[j] = S(1);
      slant::local(column).setConstant(std::numeric_limits<S>::quiet_NaN());
      slant::apply(g, e, column);
      m.col(j) = slant::local(column);
    }
    return m;
  }
}

/// A set, and how a dense vector becomes one of the kind that it takes.
template <class C, class V>
struct seen_set {
  C const& set;
  V prototype;

  [[nodiscard]] V in(Eigen::Matrix<scalar_t<V>, Eigen::Dynamic, 1> const& p) const {
    V v = slant::like(prototype, p.size());
    copy_entries(p, slant::local(v));
    return v;
  }
};
template <class C, class V>
seen_set(C const&, V) -> seen_set<C, V>;

/// Refers to what is seen.
template <class C, class V>
[[nodiscard]] auto probe_of(seen_set<C, V> const& seen, set_options const& options) {
  using S = scalar_t<V>;
  using dense = typename set_probe<S>::dense;
  using seen_type = seen_set<C, V>;
  C const& set = seen.set;
  V const& prototype = seen.prototype;
  set_probe<S> probe;
  probe.size = slant::dimension_of(set);
  probe.options = options;
  probe.unconstrained = whole_space<C>;
  probe.project = {seen, [](seen_type const& s, dense const& p) {
                     auto const y = slant::project(s.set, s.in(p));
                     return dense_of(y);
                   }};
  probe.project_in_place = {seen, [](seen_type const& s, dense const& p) {
                              auto v = s.in(p);
                              slant::project(s.set, v, v);
                              return dense_of(v);
                            }};
  probe.project_over_nan = {
      seen, [](seen_type const& s, dense const& p) {
        auto const x = s.in(p);
        auto y = s.in(dense::Constant(p.size(), std::numeric_limits<S>::quiet_NaN()));
        slant::project(s.set, x, y);
        return dense_of(y);
      }};
  if constexpr (has_contains<C, V>) {
    probe.contains = {
        seen, [](seen_type const& s, dense const& p) { return bool(s.set.contains(s.in(p))); }};
  }
  if constexpr (has_slant<C, V>) {
    probe.slant = {seen, [](seen_type const& s, dense const& p) {
                     return matrix_of(s.set.slant(s.in(p)), s.prototype, p.size());
                   }};
    using G = decltype(set.slant(prototype));
    if constexpr (requires(G& g) { set.slant(prototype, g); }) {
      probe.renewed_slant = {seen, [](seen_type const& s, dense const& p) {
                               auto g = s.set.slant(s.in(dense::Zero(p.size())));
                               s.set.slant(s.in(p), g);
                               return matrix_of(g, s.prototype, p.size());
                             }};
    }
  }
  if constexpr (has_step_to_boundary<C, V>) {
    probe.step = {seen, [](seen_type const& s, dense const& x, dense const& d) {
                    return S(s.set.step_to_boundary(s.in(x), s.in(d)));
                  }};
    if constexpr (requires(S const& t) { set.step_to_boundary(prototype, prototype, t); }) {
      probe.early_step = {seen,
                          [](seen_type const& s, dense const& x, dense const& d, S const& enough) {
                            return S(s.set.step_to_boundary(s.in(x), s.in(d), enough));
                          }};
    }
  }
  if constexpr (has_support<C, V>) {
    probe.support = {seen,
                     [](seen_type const& s, dense const& y) { return S(s.set.support(s.in(y))); }};
  }
  if constexpr (has_state<C, V>) {
    probe.state = {seen, [](seen_type const& s, dense const& x) { return s.set.state(s.in(x)); }};
  }
  if constexpr (has_inequality_form<C, V>) {
    probe.inequalities = C::inequalities;
    probe.inequality = {seen, [](seen_type const& s, dense const& x) {
                          return dense_of(s.set.inequality(s.in(x)));
                        }};
    probe.inequality_gradient = {seen, [](seen_type const& s, dense const& x) {
                                   return dense_of(s.set.inequality_gradient(s.in(x)));
                                 }};
    probe.inequality_hessian = {seen,
                                [](seen_type const& s, dense const& x, dense const& multipliers) {
                                  Eigen::Matrix<S, C::inequalities, 1> ν;
                                  copy_entries(multipliers, ν);
                                  return dense_of(s.set.inequality_hessian(s.in(x), ν));
                                }};
  }
  probe.origin = slant::norm(probe.project(dense::Zero(probe.size)));
  return probe;
}

// --- set sampler ---------------------------------------------------------------------------------

/// Random numbers and directions, the same on every platform.
template <class S>
class set_sampler {
  using dense = typename set_probe<S>::dense;

 public:
  explicit set_sampler(set_probe<S> const& probe) : probe_(probe), engine_(probe.options.seed) {}

  /// Uniform in [−1, 1].
  [[nodiscard]] S number() {
    constexpr std::int32_t half = 1 << 30;
    return S(static_cast<std::int32_t>(engine_() >> 1U) - half) / S(half);
  }
  [[nodiscard]] dense box() {
    dense v(probe_.size);
    for (index i = 0; i < v.size(); ++i) v[i] = number();
    return v;
  }
  [[nodiscard]] index below(index n) { return static_cast<index>(engine_()) % n; }

  /// A direction of length about 1: random, sparse, or ± a coordinate axis.
  [[nodiscard]] dense direction(int kind) {
    dense v = box();
    if (kind % 3 == 1)
      v = (number() < S(0) ? S(-1) : S(1)) * dense::Unit(v.size(), below(v.size()));
    if (kind % 3 == 2) {
      for (index i = 0; i < v.size(); ++i) v[i] = number() < S(0) ? S(0) : v[i];
    }
    return v;
  }

  /// Points to try: see the top of the file.
  [[nodiscard]] std::vector<dense> points() {
    S const scales[] = {S(1), S(10), S(1) / S(10), S(1000), S(1) / S(1000)};
    std::vector<dense> list{dense(dense::Zero(probe_.size))};
    for (int k = 1; k < probe_.options.points; ++k) {
      dense const x = S(probe_.options.size) * scales[k % 5] * direction(k / 5 % 3);
      dense const y = probe_.project(x);
      if (k % 4 == 0) list.push_back(y);                          // on the boundary
      if (k % 4 == 1) list.push_back(y + (x - y) / S(1 << 12));   // close to it
      if (k % 4 == 2) list.push_back(y + (y - x) * S(number()));  // on both sides
      if (k % 4 == 3) list.push_back(x);
    }
    return list;
  }

 private:
  set_probe<S> const& probe_;
  std::mt19937 engine_;
};

}  // namespace detail

}  // namespace slant::testing
