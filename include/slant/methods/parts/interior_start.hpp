// SPDX-License-Identifier: MIT
//
// A point in the interior of a product of small convex sets, known by nothing but how far one can
// go in them: from any point of a block, go to the middle of the chord along each axis in turn;
// from a chord of infinite length take a piece of the length δ at its end. Two rounds centre a
// ball, a box, a cone about an axis and an ellipse along the axes. From a corner that no axis
// enters, as of a narrow cone at an angle, one goes first to the mean of the projections of points
// all around: it is in the set, and inside if they are not all in one face.
#pragma once

#include <slant/base/scaling.hpp>
#include <slant/base/vector_algebra.hpp>
#include <slant/concepts/bad_input.hpp>
#include <slant/concepts/capabilities.hpp>
#include <slant/concepts/random.hpp>
#include <slant/concepts/vector.hpp>
#include <slant/krylov/mean_diagonal.hpp>
#include <slant/sets/blocks.hpp>
#include <slant/slanting/inequality_jacobian.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>

namespace slant {

namespace detail {

/// A point of a block well inside, and how far it is from the boundary along the axes.
template <class X>
struct chord_centre {
  X point;
  typename X::Scalar distance;
};

/// From x in the block, δ > 0 the length of what has none.
template <class Block, class X>
[[nodiscard]] chord_centre<X> centre_by_chords(Block const& block, X const& x,
                                               typename X::Scalar const& δ) {
  using S = typename X::Scalar;
  chord_centre<X> c{x, δ};
  for (int round = 0; round < 3; ++round) {
    c.distance = δ;
    for (index j = 0; j < index(x.size()); ++j) {
      X const axis = X::Unit(x.size(), j);
      S const up = block.step_to_boundary(c.point, axis);
      S const down = block.step_to_boundary(c.point, X(-axis));
      bool const above = is_finite(up), below = is_finite(down);
      S move(0);
      if (above && below) move = (up - down) / S(2);
      if (below && !above) move = std::max<S>(δ - down, S(0));
      if (above && !below) move = std::min<S>(up - δ, S(0));
      c.point(j) += move;
      S const near = std::min<S>(above ? S(up - move) : S(δ), below ? S(down + move) : S(δ));
      c.distance = std::min<S>(c.distance, near);
    }
  }
  return c;
}

/// The mean of the projections of x ± δ e, e along all axes and diagonals (of the first six axes).
template <class Block, class X>
[[nodiscard]] X mean_of_projections(Block const& block, X const& x, typename X::Scalar const& δ) {
  using S = typename X::Scalar;
  index const n = index(x.size());
  X sum = X::Zero(n);
  S count(0);
  auto const add = [&](X const& e) {
    sum += X(block.project(X(x + δ * e)));
    count += S(1);
  };
  for (index j = 0; j < n; ++j) {
    add(X::Unit(n, j));
    add(X(-X::Unit(n, j)));
  }
  index const turning = std::min<index>(n, 6);
  for (unsigned signs = 0; signs < 1U << turning; ++signs) {
    X e = X::Ones(n);
    for (index j = 0; j < turning; ++j) {
      if ((signs >> j & 1U) != 0) e(j) = S(-1);
    }
    add(e);
  }
  return sum / count;
}

/// Whether the block is the point x alone: e and −e of every axis are normal to it there.
template <class Block, class X>
[[nodiscard]] bool is_single_point(Block const& block, X const& x, typename X::Scalar const& δ) {
  for (index j = 0; j < index(x.size()); ++j) {
    X const axis = δ * X::Unit(x.size(), j);
    if (X(block.project(X(x + axis))) != x || X(block.project(X(x - axis))) != x) return false;
  }
  return true;
}

/// `block`: its number, none if it is on another process. The message also reaches users of files
/// alone.
[[noreturn]] inline void refuse_empty_interior(std::optional<index> block) {
  throw bad_input(
      block ? "block " + show(*block) + " of the set"
            : std::string("a block of the set on another process"),
      "no point inside that f(x) tells",
      "points with f(x) < 0, which an interval between neighbouring numbers or a cone with "
      "friction coefficient 0 does not have; another method takes it (symmetric_newton, kprgp)");
}

}  // namespace detail

/// x ∈ Λ moves the fraction `pull` of the way to the interior; the middle it moves towards goes to
/// `centre`, and 1/σ of every inequality, 0 for those without a bound, to per_unit (see
/// barrier.hpp). Blocks that are a single point, a ball of radius 0 or an interval with equal ends,
/// keep it, count as without a bound and are told to hold(place).
/// Throws bad_input, on all processes, naming another block that has no interior: none that a
/// number can tell, also a ball of a radius whose square leaves the range of the numbers.
template <class C, class V, class R, class Hold>
void enter_interior(C const& set, scalar_t<V> const& δ, scalar_t<V> const& pull, V& x, V& centre,
                    R& per_unit, Hold hold) {
  using S = scalar_t<V>;
  index row = 0;
  std::optional<index> empty;
  vectors::copy(x, centre);
  slant::visit_blocks(set, [&](auto const& block, auto const& place) {
    using block_type = std::remove_cvref_t<decltype(block)>;
    constexpr int k = detail::inequalities_of<block_type>;
    if constexpr (k > 0) {
      auto const start = place.value(x);
      auto c = detail::centre_by_chords(block, start, δ);
      if (!(block.inequality(c.point).maxCoeff() < S(0))) {
        c = detail::centre_by_chords(block, detail::mean_of_projections(block, start, δ), δ);
      }
      auto const f = block.inequality(c.point).eval();
      if (!(f.maxCoeff() < S(0)) && detail::is_single_point(block, start, δ)) {
        for (int i = 0; i < k; ++i) per_unit(row + i) = S(0);
        row += k;
        hold(place);
        return;
      }
      for (int i = 0; i < k; ++i) {
        S const depth = -f(i);
        if (!(depth > S(0)) && !empty) empty = place.index();
        per_unit(row + i) =
            detail::is_finite(depth) ? S(1) / unit_near(S(depth / c.distance)) : S(0);
      }
      row += k;
      place.put(centre, c.point);
      place.put(x, (start + pull * (c.point - start)).eval());
      if (!(block.inequality(place.value(x)).maxCoeff() < S(0))) place.put(x, c.point);
    }
  });
  if (!slant::everywhere(x, !empty)) detail::refuse_empty_interior(empty);
}

// --- estimated diagonal --------------------------------------------------------------------------
//
// diag(A) for a preconditioner: exact where A gives it at no product or n products are not more
// than an estimate takes, else one mean for each part of the set, since the parts of a cartesian
// product are where A changes its scale (pressures and wall forces, normal and tangential forces).
// A part P of n_P unknowns gets Hutchinson's estimate
//
//     d_P = mean over k random v of vᵀA v / n_P ≥ 0,     v = ±1 on P, 0 elsewhere
//
// Rejected, by measurement on the bricks: the exact diagonal at n products, an estimate of each
// entry [Bekas, Kokiopoulou, Saad 2007] from 10 to 30 products, and one mean of all. Noise from
// entry to entry costs products, and the exact diagonal saves fewer than the n that it takes.

namespace detail {

/// f(first, size) for the components of each part of a cartesian product, or for all of another
/// set.
template <class C, class F>
void visit_parts(C const& set, F const& f) {
  if constexpr (requires { C::part_count; }) {
    [&]<std::size_t... I>(std::index_sequence<I...>) {
      index first = 0;
      auto const one = [&](index size) { f(first, size), first += size; };
      (one(index(slant::dimension_of(set.template part<I>()))), ...);
    }(std::make_index_sequence<C::part_count>{});
  } else if constexpr (requires { set.visit_parts(f); }) {
    set.visit_parts(f);
  } else if constexpr (requires { set.map(), set.part(); }) {
    visit_parts(set.part(), f);
  } else {
    f(index(0), index(slant::dimension_of(set)));
  }
}

}  // namespace detail

/// d ≈ diag(A), all entries > 0; mean(d) and the products spent, samples for each part. Throws
/// bad_input that calls A by its name if a mean is not finite or negative.
template <class A, class C, class V>
  requires psd_operator<A, V>
[[nodiscard]] auto estimate_diagonal(A const& a, C const& set, mean_diagonal_options const& options,
                                     V& d, char const* name = "A") -> diagonal_mean<scalar_t<V>> {
  using S = scalar_t<V>;
  options.validate();
  index const here = slant::local(d).size();
  V v = like(d, here), image = like(d, here);
  auto const mean_of = [&](S const& sum, S const& count) {
    S const mean = count > S(0) ? S(sum / count) : S(0);
    if (!(mean >= S(0)) || !detail::is_finite(mean)) {
      throw bad_input(name, "mean of the diagonal " + detail::show(mean), "a finite number >= 0");
    }
    return mean;
  };
  vectors::fill(S(1), v);
  S const size = inner_product(v, v);
  index applications = 0;
  if (!slant::diagonal_if_known(a, d)) {
    auto temporaries = workspace(a, d);
    index parts = 0;
    detail::visit_parts(set, [&](index, index) { ++parts; });
    bool const exactly =
        slant::everywhere(d, here == slant::global_size(d) && here <= options.samples * parts);
    for (; exactly && applications < here; ++applications) {
      vectors::set_zero(v);
      slant::local(v).coeffRef(applications) = S(1);
      slant::apply(a, v, image, temporaries);
      S const entry = slant::local(image).coeff(applications);
      bool const rounded =
          entry < S(0) && -entry <= S(8) * std::numeric_limits<S>::epsilon() * norm(image);
      slant::local(d).coeffRef(applications) = rounded ? S(0) : mean_of(entry, S(1));
    }
    detail::random_bits bits(options.seed);
    detail::visit_parts(set, [&](index first, index count) {
      if (exactly) return;
      vectors::set_zero(v);
      slant::local(v).segment(first, count).setOnes();
      S const unknowns = inner_product(v, v);
      S sum(0), noise(0);
      for (index k = 0; k < options.samples && unknowns > S(0); ++k, ++applications) {
        for (index i = first; i < first + count; ++i) {
          slant::local(v).coeffRef(i) = bits.coin() ? S(1) : S(-1);
        }
        slant::apply(a, v, image, temporaries);
        sum += inner_product(v, image);
        noise += S(8) * std::numeric_limits<S>::epsilon() * norm(v) * norm(image);
      }
      if (sum < S(0) && -sum <= noise) sum = S(0);
      slant::local(d)
          .segment(first, count)
          .setConstant(mean_of(sum, S(options.samples) * unknowns));
    });
    vectors::fill(S(1), v);
  }
  S const mean = mean_of(inner_product(v, d), size);
  // Where A has nothing to say anything will do that has its size.
  S const typical = mean > S(0) ? mean : S(1);
  slant::local(d) = slant::local(d).unaryExpr([&](S const& e) { return e > S(0) ? e : typical; });
  return {mean, applications};
}

}  // namespace slant
