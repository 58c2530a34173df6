// SPDX-License-Identifier: MIT
//
// The levels of multigrid: K, its Galerkin products K_coarse = PᵀK P, and what their sweeps and the
// last factor need. The same for every right-hand side and face, so that they are made once and
// shared.
//
// P: of the user, as interpolation on nested meshes; or by smoothed aggregation (aggregation.hpp),
// which represents the near kernel of K, what sweeps do not reach, exactly: constants of a
// Laplacian, rigid-body modes in elasticity.
//
// Precision. The levels are of floats: a cycle is a correction that an outer iteration in double
// takes as a preconditioner, and sweeps wait for memory. K itself is not kept. The levels are those
// of K/2^e, so that the range of floats is no limit in any units.
#pragma once

#include <slant/base/matrix_entries.hpp>
#include <slant/concepts/bad_input.hpp>
#include <slant/concepts/scalar.hpp>
#include <slant/multilevel/aggregation.hpp>
#include <slant/multilevel/block_matrix.hpp>
#include <slant/multilevel/parts/envelope_factor.hpp>
#include <slant/multilevel/parts/galerkin.hpp>
#include <slant/multilevel/parts/prolongation.hpp>

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

namespace slant {

// --- options -------------------------------------------------------------------------------------

/// Options of multigrid.
struct multigrid_options {
  /// Of the nodes, a column for each, in 2 or 3 rows; node i has the unknowns D i … D i + D − 1.
  /// From them come the rigid-body modes of elasticity. Empty: the near kernel is what is given
  /// otherwise, or constants.
  Eigen::MatrixXd coordinates{};
  /// P of yours in place of aggregation, the one from level 1 to level 0 first, as interpolation on
  /// nested meshes: weights of nodes (nodes × coarse nodes) or matrices of unknowns. Aggregation
  /// continues from a level with more than twice `coarsest` unknowns, unless its factors are cheap;
  /// in space with rotations, if those of level 0 are known and all coarse nodes are fine nodes.
  std::vector<Eigen::SparseMatrix<double>> prolongations{};
  index block_size = 0;  ///< unknowns of a node, consecutive; 0: from the pattern of K, 1 to 3
  double strength = 0.02;  ///< θ in [0, 1): nodes i, j are neighbours if ‖K_ij‖² > θ² ‖K_ii‖ ‖K_jj‖
  double damping = 4.0 / 3;  ///< ω λ_max(D⁻¹K) in (0, 2): the smoothing of the prolongation
  /// A level with so few unknowns is factored, >= 1. A last level with more, where there is none
  /// that is smaller, is factored if that costs no more than a dense matrix of twice as many (or of
  /// 1200), else smoothed.
  index coarsest = 500;
  index levels = 20;  ///< at most so many by aggregation, >= 1
  /// > 1: numbers of the matrices of all levels over those of the finest. A level that would exceed
  /// its share is coarsened along weaker couplings, θ/2, θ/4, …, 0; where that is not enough, its P
  /// is not smoothed, which costs up to twice the cycles.
  double complexity = 2;
  /// Levels are smoothed by Chebyshev polynomials of this degree, 1 to 4 (parts/cycle.hpp); 0: by
  /// sweeps of block Gauss–Seidel, which take less time where one thread does all.
  index chebyshev = 0;

  /// Multiplications: a last level whose factors take no more is factored.
  [[nodiscard]] double most_work() const {
    double const n = std::max(2.0 * static_cast<double>(coarsest), 1200.0);
    return n * n * n / 6;
  }
  /// Throws bad_input naming the option, its value and what was expected.
  [[gnu::cold]] void validate() const {
    using detail::check_option;
    check_option("rows of coordinates", index(coordinates.rows()),
                 coordinates.size() == 0 || coordinates.rows() == 2 || coordinates.rows() == 3,
                 "2 or 3");
    detail::require_finite_entries("coordinates", coordinates);
    check_option("block_size", block_size, block_size >= 0 && block_size <= 3,
                 "a number from 0 to 3");
    check_option("block_size", block_size,
                 coordinates.size() == 0 || block_size == 0 || block_size == coordinates.rows(),
                 "0, or the rows of coordinates");
    check_option("strength", strength, strength >= 0 && strength < 1, "a number in [0, 1)");
    check_option("damping", damping, damping > 0 && damping < 2, "a number in (0, 2)");
    check_option("coarsest", coarsest, coarsest >= 1, "at least 1");
    check_option("levels", levels, levels >= 1, "at least 1");
    check_option("complexity", complexity, complexity > 1, "a number > 1");
    check_option("chebyshev", chebyshev, chebyshev >= 0 && chebyshev <= 4, "a degree from 0 to 4");
  }
};

}  // namespace slant

namespace slant::detail {

// --- levels --------------------------------------------------------------------------------------

/// The inverse of the diagonal block i of a coarse level, for the sweeps; pivots are measured by
/// those of `free` as well, the level while nothing is held.
template <int N, class T>
void invert_diagonal(block_matrix<N, T> const& A, block_matrix<N, T> const& free, int i,
                     T* inverses) {
  constexpr int stride = block_matrix<N, T>::stride;
  double a[N * N], least[N], scale[N];
  for (int k = 0; k < N * N; ++k) a[k] = static_cast<double>(A.diagonal(i)[k]);
  for (int c = 0; c < N; ++c) {
    scale[c] = a[(N + 1) * c];
    // Unknowns that others of the node make up, as rotations of what a face leaves of an aggregate.
    double const size = std::max(scale[c], static_cast<double>(free.diagonal(i)[(N + 1) * c]));
    least[c] = 16 * static_cast<double>(std::numeric_limits<T>::epsilon()) * std::max(size, 0.0);
  }
  invert_semidefinite<N>(a, least, scale);
  T* const to = inverses + static_cast<std::size_t>(i) * (N * stride);
  for (int c = 0; c < N; ++c) {
    for (int q = 0; q < stride; ++q) to[stride * c + q] = q < N ? T(a[N * c + q]) : T(0);
  }
}

/// A level, and P from the next coarser one with nodes of M unknowns.
template <int N, int M, class T>
struct multigrid_level {
  block_matrix<N, T> A;
  std::vector<T> inverses;  // of the diagonal blocks
  prolongation<N, M, T> P;
  std::size_t longest = 0;     // of the rows of A P
  aggregation aggregates{};    // of its nodes, if nodes of the next level stand for them
  near_kernel<M, M> kernel{};  // of the next level, if it has a node for each of them
  T largest = 0;               // eigenvalue of D⁻¹A, about; 0 where it was not asked for

  [[nodiscard]] T find_largest(bool in_any_units) const {
    std::vector<T> x(A.padded_size()), y(x.size());
    return largest_jacobi_eigenvalue(A, inverses.data(), x, y, in_any_units);
  }
};

/// Constants, one for each unknown of a node.
template <int N, int M>
[[nodiscard]] near_kernel<N, M> constants(int nodes) {
  near_kernel<N, M> B;
  B.blocks.assign(static_cast<std::size_t>(nodes) * N * M, 0.0);
  for (std::size_t i = 0; i < static_cast<std::size_t>(nodes); ++i) {
    for (std::size_t c = 0; c < N; ++c) B.blocks[i * N * M + c * M + c] = 1;
  }
  return B;
}

/// What is the same for every right-hand side and face: level 0 has nodes of N unknowns, the others
/// of M.
template <int N, int M, class T>
class hierarchy {
 public:
  using fine_level = multigrid_level<N, M, T>;
  using coarse_level = multigrid_level<M, M, T>;

  fine_level fine;
  std::vector<double> diagonal;      // D of level 0, N² numbers each
  std::vector<coarse_level> coarse;  // the last one without P
  envelope_factor<N, T> only;        // of level 0 if there is no other
  envelope_factor<M, T> last;        // of the last level
  bool factored = false;             // whether there is such a factor
  double most_work = 0;              // where factors of the last level take more, there are none
  bool smoothed = true;              // all P by smoothing, none above the limit of complexity
  index degree = 0;                  // of polynomials in place of sweeps

  /// Level 1. Throws bad_input if there is none.
  [[nodiscard]] coarse_level const& first_coarse() const {
    if (coarse.empty()) throw bad_input("levels", "1", "a level 1 to begin with");
    return coarse.front();
  }
  [[nodiscard]] std::vector<index> sizes() const {
    std::vector<index> list{fine.A.rows()};
    for (auto const& l : coarse) list.push_back(l.A.rows());
    return list;
  }
  /// Numbers of all matrices over those of the first.
  [[nodiscard]] double complexity() const {
    double sum = 0;
    for (auto const& l : coarse) sum += double(l.A.blocks()) * (M * M);
    return fine.A.blocks() == 0 ? 1 : 1 + sum / (double(fine.A.blocks()) * (N * N));
  }

  /// Level 0: factor · K.
  template <class K>
  void begin(K const& k, typename K::Scalar const& factor) {
    fine = level_of(k, factor, diagonal);
  }

  /// Levels by aggregation until one is small enough. B: near kernel of level 0.
  void aggregate_all(near_kernel<N, M> const& B, multigrid_options const& o) {
    if (done(fine.A, o)) return;
    near_kernel<M, M> next;
    auto below = aggregate_below(fine, B, o, next);
    if (!below) return;
    append(fine, std::move(*below));
    aggregate_rest(std::move(next), o);
  }
  /// The same where level 0 is G⁻ᵀK G⁻¹, of unknowns v = G u: P = G P_K, with P_K and near kernel
  /// those of factor · K.
  template <class K, class G>
  void aggregate_mixed(K const& k, typename K::Scalar const& factor, G const& g,
                       near_kernel<N, M> const& B, multigrid_options const& o) {
    if (done(fine.A, o)) return;
    std::vector<double> unused;
    fine_level apart = level_of(k, factor, unused);
    near_kernel<M, M> next;
    auto below = aggregate_below(apart, B, o, next);
    if (!below) return;
    apart = {};
    below->P = mixed_prolongation(below->P, g);
    below->C = galerkin_pattern(fine.A, below->P, fine.longest);
    append(fine, std::move(*below));
    aggregate_rest(std::move(next), o);
  }
  /// Levels by prolongations of the user, of unknowns v = G u where G is given, then by aggregation
  /// until one is small enough. B: near kernel of level 0, or nothing for constants.
  template <class G, int W>
  void interpolate_all(multigrid_options const& o, G const* g, near_kernel<N, W> B) {
    static_assert(N == M);
    for (std::size_t l = 0; l < o.prolongations.size(); ++l) {
      fine_level& above = l == 0 ? fine : coarse.back();
      auto P = prolongation_from<N, T>(o.prolongations[l], above.A.nodes(),
                                       "prolongation " + show(static_cast<index>(l)));
      auto nodes = heaviest_parents(P);
      B = injected(P, B);
      if (l == 0 && g) P = mixed_prolongation(P, *g);
      auto kernel = constants<M, M>(P.coarse_nodes);
      append_by(above, std::move(P), std::move(nodes), std::move(kernel));
    }
    // Aggregates take more cycles: factors for every face are better while they cost no more than
    // four products with level 0.
    double const most = std::min(o.most_work(), 4.0 * double(fine.A.blocks()) * (N * N));
    auto const& A = coarse.back().A;
    if (A.rows() / 2 <= o.coarsest || envelope(A).work(M) <= most) return;
    if (B.blocks.empty()) {
      aggregate_rest(constants<M, M>(A.nodes()), o);
    } else {
      aggregate_rest(std::move(B), o);
    }
  }
  /// Level 0 for factor · k = G⁻ᵀA G⁻¹, where A is level 1 of `finer` and G of unknowns or without
  /// rows for the identity; its other levels, formed anew if G couples what A does not.
  template <int F, class K, class G>
  void take_below(hierarchy<F, M, T> const& finer, K const& k, typename K::Scalar const& factor,
                  G const& g) {
    begin(k, factor);
    if (finer.coarse.size() < 2) return;
    auto const& from = finer.coarse;
    auto P = rows_apart<N>(from[0].P);
    if (g.rows() > 0) P = mixed_prolongation(P, g);
    level_below<N> below{std::move(P), {}, {}, from[0].kernel};
    below.C = galerkin_pattern(fine.A, below.P, fine.longest);
    below.aggregates.count = from[0].aggregates.count;
    for (int const node : from[0].aggregates.of) {
      for (int part = 0; part < M / N; ++part) below.aggregates.of.push_back(node);
    }
    if (!below.C.has_pattern_of(from[1].A)) {
      append(fine, std::move(below));
      for (std::size_t l = 1; l + 1 < from.size(); ++l) {
        append_by(coarse.back(), from[l].P, from[l].aggregates, from[l].kernel);
      }
      return;
    }
    adopt(fine, below);
    coarse.assign(from.begin() + 1, from.end());
    last = finer.last;
    factored = finer.factored;  // where it is not, finish() finds the same
  }

  /// Factors the last level, once, and bounds spectra for polynomials. Throws bad_input if K is
  /// found not to be semidefinite by more than √ε.
  void finish(double most, index chebyshev) {
    most_work = most;
    degree = chebyshev;
    if (degree > 0) {
      fine.largest = fine.find_largest(true);
      for (auto& l : coarse) l.largest = l.find_largest(true);
    }
    if (factored) return;
    auto const factor = [&]<int B>(envelope_factor<B, T>& to, block_matrix<B, T> const& A) {
      // A level that would not become smaller has few couplings, and sweeps solve it well enough.
      envelope e(A);
      if (e.work(B) > most_work) return;
      to = envelope_factor<B, T>(std::move(e));
      double const lowest = to.factor(A, A, whole_blocks{});
      // Rounding leaves slender bodies eigenvalues below zero, level after level, and pivots far
      // below: is it more than a rise of the diagonal undoes?
      double const rise = std::sqrt(static_cast<double>(std::numeric_limits<T>::epsilon()));
      if (lowest < -64 * rise) {
        T raised[B * B];
        auto const raise = [&](int i, int j, T const* entries) -> T const* {
          if (i != j) return entries;
          std::copy(entries, entries + B * B, raised);
          for (int c = 0; c < B; ++c) raised[(B + 1) * c] *= T(1 + rise);
          return raised;
        };
        if (envelope_factor<B, T>(to).factor(A, A, raise) < 0) {
          throw bad_input("K",
                          "a negative pivot on level " + show(static_cast<index>(coarse.size())),
                          "a symmetric positive definite matrix");
        }
      }
      factored = true;
    };
    if (coarse.empty()) {
      factor(only, fine.A);
    } else {
      factor(last, coarse.back().A);
    }
  }

 private:
  template <int F>
  [[nodiscard]] bool done(block_matrix<F, T> const& A, multigrid_options const& o) const {
    return A.rows() <= o.coarsest || static_cast<index>(coarse.size()) + 1 >= o.levels;
  }

  [[nodiscard]] static double weaker(double θ) { return θ > 0.01 ? θ / 2 : 0; }

  /// What a level below is made of: P, the pattern of PᵀA P, the aggregates, and their near kernel
  /// where each is one node.
  template <int F>
  struct level_below {
    prolongation<F, M, T> P;
    block_matrix<M, T> C;
    aggregation aggregates;
    near_kernel<M, M> kernel;
  };

  template <int F>
  static void adopt(multigrid_level<F, M, T>& above, level_below<F>& below) {
    above.P = std::move(below.P);
    above.aggregates = std::move(below.aggregates);
    above.kernel = std::move(below.kernel);
  }
  /// A new last level, below the one that has been that.
  template <int F>
  void append(multigrid_level<F, M, T>& above, level_below<F> below) {
    constexpr int stride = block_matrix<M, T>::stride;
    adopt(above, below);
    auto& C = below.C;
    galerkin_scratch<F, M, T> scratch(above.P, above.longest);
    galerkin(above.A, above.P, C, scratch);
    std::vector<T> inverses(static_cast<std::size_t>(C.nodes()) * M * stride, T(0));
    for (int i = 0; i < C.nodes(); ++i) invert_diagonal(C, C, i, inverses.data());
    coarse.push_back({std::move(C), std::move(inverses), {}, 0});
  }
  template <int F>
  void append_by(multigrid_level<F, M, T>& above, prolongation<F, M, T> P, aggregation aggregates,
                 near_kernel<M, M> kernel) {
    auto C = galerkin_pattern(above.A, P, above.longest);
    append(above, {std::move(P), std::move(C), std::move(aggregates), std::move(kernel)});
  }
  /// B: of the last level. Where that has more columns than a node has unknowns, each aggregate
  /// becomes two nodes.
  template <int W>
  void aggregate_rest(near_kernel<M, W> B, multigrid_options const& o) {
    while (!done(coarse.back().A, o)) {
      near_kernel<W, W> next;
      auto below = aggregate_below(coarse.back(), B, o, next);
      if (!below) return;
      B.blocks = std::move(next.blocks);
      append(coarse.back(), std::move(*below));
    }
  }
  /// The near kernel of coarse nodes that are nodes of the fine level, as those of nested meshes are;
  /// nothing if P does not say so of all.
  template <int W>
  static near_kernel<N, W> injected(prolongation<N, N, T> const& P, near_kernel<N, W> const& B) {
    near_kernel<N, W> coarse;
    if (B.blocks.empty() || !P.weights) return coarse;
    std::vector<int> of(static_cast<std::size_t>(P.coarse_nodes), -1);
    for (int i = 0; i < P.nodes(); ++i) {
      int const e = P.begin(i);
      if (P.end(i) == e + 1 && P.weight(e) == T(1)) of[static_cast<std::size_t>(P.at(e))] = i;
    }
    if (std::find(of.begin(), of.end(), -1) != of.end()) return coarse;
    for (int const i : of) coarse.blocks.insert(coarse.blocks.end(), B.at(i), B.at(i) + N * W);
    return coarse;
  }

  /// The level below, and its near kernel; nothing if there is none that is smaller.
  template <int F, int W>
  std::optional<level_below<F>> aggregate_below(multigrid_level<F, M, T>& above,
                                                near_kernel<F, W> const& B,
                                                multigrid_options const& o,
                                                near_kernel<W, W>& next) {
    // A level may have so many of the numbers of the one above that all have what the limit allows.
    double const most = (1 - 1 / o.complexity) * double(above.A.blocks()) * (F * F);
    T const λ = above.find_largest(false);
    double θ = o.strength;
    bool smooth = true;
    while (true) {
      aggregation a = aggregate(above.A, θ);
      if (a.count == 0 || 10 * a.count * (W / M) > 9 * index(above.A.nodes())) {
        if (θ == 0) return std::nullopt;
        θ = weaker(θ);
        continue;
      }
      auto const Q = orthonormal_candidates<F, W, T>(a, B, next);
      T const ω = smooth ? T(o.damping) / λ : T(0);
      auto P =
          columns_apart<M>(smoothed_prolongation<F, W, T>(above.A, above.inverses.data(), a, Q, ω));
      auto C = galerkin_pattern(above.A, P, above.longest);
      if (smooth && double(C.blocks()) * (M * M) > most) {
        if (θ == 0) smooth = false;
        θ = weaker(θ);
        continue;
      }
      smoothed = smoothed && smooth;
      level_below<F> below{std::move(P), std::move(C), std::move(a), {}};
      if constexpr (W == M) below.kernel = next;
      return below;
    }
  }

  /// The matrix factor · K, the blocks D of its diagonal, and their inverses.
  template <class K>
  static fine_level level_of(K const& k, typename K::Scalar const& factor,
                             std::vector<double>& diagonal) {
    using S = typename K::Scalar;
    constexpr int stride = block_matrix<N, T>::stride;
    fine_level l{block_matrix<N, T>(k, factor), {}, {}, 0};
    auto const n = static_cast<std::size_t>(l.A.nodes());
    diagonal.assign(n * N * N, 0.0);
    l.inverses.assign(n * N * stride, T(0));
    for (std::size_t i = 0; i < n; ++i) {
      double* const a = diagonal.data() + i * (N * N);
      for (int c = 0; c < N; ++c) {
        index const column = static_cast<index>(i) * N + c;
        auto const* const inner = k.innerIndexPtr();
        index const end = k.isCompressed() ? index(k.outerIndexPtr()[column + 1])
                                           : index(k.outerIndexPtr()[column]) +
                                                 index(k.innerNonZeroPtr()[column]);
        index e = std::lower_bound(inner + k.outerIndexPtr()[column], inner + end,
                                   static_cast<index>(i) * N) -
                  inner;
        for (; e < end && inner[e] < static_cast<index>(i) * N + N; ++e) {
          a[N * c + (inner[e] - static_cast<index>(i) * N)] =
              static_cast<double>(S(k.valuePtr()[e] * factor));
        }
        // In double it may be a number that is none in T.
        if (!(T(a[(N + 1) * c]) >= std::numeric_limits<T>::min())) {
          throw bad_input("K",
                          "diagonal entry " + show(column) + " = " + show(k.coeff(column, column)),
                          "a symmetric positive definite matrix");
        }
      }
      double inverse[N * N], least[N], scale[N];
      std::copy(a, a + N * N, inverse);
      for (int c = 0; c < N; ++c) {
        scale[c] = a[(N + 1) * c];
        least[c] = 64 * std::numeric_limits<double>::epsilon() * scale[c];
      }
      invert_semidefinite<N>(inverse, least, scale);
      for (int c = 0; c < N; ++c) {
        for (int q = 0; q < N; ++q) {
          l.inverses[(i * N + std::size_t(c)) * stride + std::size_t(q)] = T(inverse[N * c + q]);
        }
      }
    }
    return l;
  }
};

}  // namespace slant::detail
