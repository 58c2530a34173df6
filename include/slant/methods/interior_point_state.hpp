// SPDX-License-Identifier: MIT
//
// The state of the interior-point method, its options, and the point where it starts.
#pragma once

#include <slant/base/progress_watch.hpp>
#include <slant/base/report.hpp>
#include <slant/base/scaling.hpp>
#include <slant/base/vector_algebra.hpp>
#include <slant/concepts/bad_input.hpp>
#include <slant/concepts/capabilities.hpp>
#include <slant/concepts/random.hpp>
#include <slant/concepts/vector.hpp>
#include <slant/krylov/spectrum.hpp>
#include <slant/methods/barrier.hpp>
#include <slant/methods/parts/gradient_point.hpp>
#include <slant/methods/parts/lorentz_pairs.hpp>
#include <slant/newton/forcing.hpp>
#include <slant/sets/blocks.hpp>
#include <slant/slanting/inequality_jacobian.hpp>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>

namespace slant {

/// State of interior_point for a separable_qp of type QP with the preconditioner M. x in the
/// interior of Λ with its gradient r and its reduced gradient are those of gradient_point. Vectors
/// of multipliers have one entry per inequality of the set, those of unknowns qp.size().
template <class QP, class M>
struct interior_point_state : gradient_point<QP> {
  using typename gradient_point<QP>::vector_type;
  using typename gradient_point<QP>::scalar;

  slant::barrier<scalar> barrier;  ///< inequalities, G, W, P_SC at x
  lorentz_pairs<scalar> pairs;     ///< forces on discs and cones, in multiples of unit
  vector_type multipliers;         ///< ν > 0; 0 where there is no bound. The multiplier of f_i is
                                   ///< unit · ν_i · barrier.per_unit()_i; of pairs an estimate
  vector_type slacks = multipliers;    ///< z = −f(x)/σ > 0, lengths
  vector_type lagrangian = this->r;    ///< ∇L = r + G ν − Σ Tᵀy, in multiples of unit
  vector_type products = multipliers;  ///< ν_i z_i; pᵀy in the first row of a pair
  vector_type counted = multipliers;   ///< 1 in the rows of which ϑ is the mean of the products
  vector_type smooth = multipliers;    ///< 1 in those of them that belong to no pair, else 0
  vector_type diagonal = this->r;      ///< D ≈ diag(A), of M if there is one
  vector_type centre = this->r;        ///< a point in the middle of every block
  vector_type step = this->r;          ///< Δx
  vector_type multiplier_step = multipliers;  ///< Δν
  vector_type slack_step = multipliers;       ///< −Δz = GᵀΔx
  vector_type rhs = this->r;                  ///< scratch: minus the right-hand side of [K (43)]
  vector_type row_scratch = multipliers;      ///< scratch, one entry per inequality
  vector_type trial_slacks = multipliers, trial_multipliers = multipliers;  ///< of the trial point
  barrier_minimum<vector_type, M> inner;                                    ///< solves for Δx
  forcing_history<scalar> forcing{};              ///< errors and inner tolerances so far
  progress_watch<scalar> progress{scalar(1e-4)};  ///< looks for steps that get nowhere

  index constraints = 0;    ///< number of inequalities with a bound, on all processes
  scalar degree{0};         ///< Σ counted
  scalar trace{0};          ///< of A, at least its largest eigenvalue; an estimate
  scalar measure{0};        ///< ϑ = (νᵀz + Σ pᵀy) / degree, in multiples of unit
  scalar least{0};          ///< the smallest of the products, for pairs λ_min²
  scalar infeasible{1};     ///< φ, the product of 1 − α: what steps leave of the first ∇L
  scalar first_measure{0};  ///< ϑ of the start
  scalar trial_measure{0}, trial_least{0};        ///< those of the trial point
  scalar lagrangian_norm{0};                      ///< ‖∇L‖
  scalar residual_bound{0};                       ///< β
  scalar centring{0};                             ///< c of the last step
  scalar step_fraction{0};                        ///< α of the last step
  scalar step_norm = detail::infinity<scalar>();  ///< ‖Δx‖, of the whole step
  scalar x_norm{0};                               ///< ‖x‖
  index inner_iterations = 0;                     ///< of the last step
  bool under_way = false;  ///< a step was longer than half of what Newton proposed
  index raises = 0;        ///< how often ϑ was raised
  index iteration = 0;
  slant::status status = slant::status::running;

  interior_point_state(QP const& qp, M const& m, vector_type const& x0)
      : gradient_point<QP>(qp, x0),
        barrier(qp.set()),
        pairs(qp.set()),
        multipliers(like(x0, barrier.rows())),
        inner(x0, qp.size(), m) {}

  [[nodiscard, gnu::cold]] std::string reason() const {
    return detail::reason_of(
        status, {.converged = "the reduced gradient is zero: x is the solution",
                 .stalled = "no step gets any further at this precision",
                 .unbounded = "the function decreases for ever along step",
                 .breakdown = "a number left the range of the scalar, or A is not semidefinite"});
  }
};

/// Options of interior_point.
template <class S = double>
struct interior_point_options {
  mean_diagonal_options mean_diagonal{.samples = 3};  ///< of diag(A), for each part of the set
  /// In [0, 1): inner iterations end, too, where the last terms add less than
  /// this part to ‖Δx‖_A. 0: never. 0.3 is for an M that makes conjugate gradients fast, as
  /// contact::lumped_preconditioner: on bricks, k = 4 … 10, 93 to 307 products to an error of 5e-9
  /// become 93 to 187. With a poor M terms are small long before the end, and steps lead nowhere.
  S inner_share = S(0);

  [[gnu::cold]] void validate() const {
    detail::check_option("inner_share", inner_share, inner_share >= S(0) && inner_share < S(1),
                         "a number in [0, 1)");
    mean_diagonal.validate();
  }
};

// --- start ---------------------------------------------------------------------------------------
//
// A point in the interior of a product of small convex sets, known by nothing but how far one can
// go in them: from any point of a block, go to the middle of the chord along each axis in turn;
// from a chord of infinite length take a piece of the length δ at its end. Two rounds centre a
// ball, a box, a cone about an axis and an ellipse along the axes. From a corner that no axis
// enters, as of a narrow cone at an angle, one goes first to the mean of the projections of points
// all around: it is in the set, and inside if they are not all in one face.

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

/// x ∈ Λ moves to the middle of each block, and 1/σ of every inequality, 0 for those without a
/// bound, goes to per_unit (see barrier.hpp). Blocks that are a single point, a ball of radius 0 or
/// an interval with equal ends, keep it, count as without a bound and are told to hold(place).
/// Throws bad_input, on all processes, naming another block that has no interior: none that a
/// number can tell, also a ball of a radius whose square leaves the range of the numbers.
template <class C, class V, class R, class Hold>
void enter_interior(C const& set, scalar_t<V> const& δ, V& x, R& per_unit, Hold hold) {
  using S = scalar_t<V>;
  index row = 0;
  std::optional<index> empty;
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
      place.put(x, c.point);
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
      bool const rounded = entry < S(0) && -entry <= S(8) * detail::epsilon<S>() * norm(image);
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
        noise += S(8) * detail::epsilon<S>() * norm(v) * norm(image);
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
