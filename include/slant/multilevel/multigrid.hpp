// SPDX-License-Identifier: MIT
//
// Multigrid: an operator M ≈ K⁻¹ for a sparse symmetric positive definite K, of the cost of a few
// products by K and with a condition number of M K that hardly depends on the mesh.
//
//     cycle(b):   x ← forwards sweep of block Gauss–Seidel from 0,   r ← b − K x
//                 x ← x + P cycle(Pᵀr)            K_coarse = PᵀK P, the last one factored
//                 x ← backwards sweep
//
// P: of the user, as interpolation on nested meshes; or by smoothed aggregation (aggregation.hpp),
// which represents the near kernel of K, what sweeps do not reach, exactly: constants of a
// Laplacian, rigid-body modes in elasticity.
//
// Precision. The levels are of floats: a cycle is a correction that an outer iteration in double
// takes as a preconditioner, and sweeps wait for memory. K itself is not kept. The levels are those
// of K/2^e and a cycle works on x/2^k, so that the range of floats is no limit in any units.
//
// Definite. Forwards before and backwards after the coarse correction make M = S + B Bᵀ with the
// symmetrised sweep S = (D + Lᵀ)⁻¹ D (D + L)⁻¹, definite for every matrix with definite diagonal
// blocks, and a semidefinite rest, however inexact the coarse levels are. No bound of a spectrum is
// needed that would have to be right. On a singular K, of bodies that float, M is definite as well.
//
// Faces. On a face H = Π K Π + C takes the place of K (parts/node_face.hpp): the inverses of the
// diagonal blocks at the surface are all that the sweeps know of it, and P is truncated by Π. In the
// rows of the coarse levels that come from nodes where the face has changed, and no others, the
// change is added [truncated multigrid: Gräser, Kornhuber 2009]. Levels hold no face: a workspace
// does. Every 256 changes it begins again from the levels without a face, before what rounding
// leaves of them adds up.
#pragma once

#include <slant/base/matrix_entries.hpp>
#include <slant/base/partitions.hpp>
#include <slant/base/scaling.hpp>
#include <slant/compiled.hpp>
#include <slant/concepts/bad_input.hpp>
#include <slant/concepts/laws.hpp>
#include <slant/concepts/scalar.hpp>
#include <slant/concepts/vector.hpp>
#include <slant/multilevel/aggregation.hpp>
#include <slant/multilevel/block_matrix.hpp>
#include <slant/multilevel/parts/dense_factor.hpp>
#include <slant/multilevel/parts/galerkin.hpp>
#include <slant/multilevel/parts/node_face.hpp>
#include <slant/multilevel/parts/prolongation.hpp>

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include <algorithm>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
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
  /// nested meshes: weights of nodes (nodes × coarse nodes) or matrices of unknowns. If they end at a
  /// level with more than twice `coarsest` unknowns, aggregation continues.
  std::vector<Eigen::SparseMatrix<double>> prolongations{};
  index block_size = 0;  ///< unknowns of a node, consecutive; 0: from the pattern of K, 1 to 3
  double strength = 0.02;  ///< θ in [0, 1): nodes i, j are neighbours if ‖K_ij‖² > θ² ‖K_ii‖ ‖K_jj‖
  double damping = 4.0 / 3;  ///< ω λ_max(D⁻¹K) in (0, 2): the smoothing of the prolongation
  /// A level with so few unknowns is factored, >= 1. A last level with more, where there is none
  /// that is smaller, is factored up to twice as many (or 1200), else smoothed.
  index coarsest = 500;
  index levels = 20;  ///< at most so many, >= 1
  /// > 1: numbers of the matrices of all levels over those of the finest. A level that would exceed
  /// its share is coarsened along weaker couplings, θ/2, θ/4, …, 0; where that is not enough, its P
  /// is not smoothed, which costs up to twice the cycles.
  double complexity = 2;

  /// A last level with so many unknowns is factored.
  [[nodiscard]] index most_factored() const { return std::max<index>(2 * coarsest, 1200); }
  /// Throws bad_input naming the option, its value and what was expected.
  [[gnu::cold]] void validate() const {
    using detail::show;
    if (coordinates.size() > 0 && coordinates.rows() != 2 && coordinates.rows() != 3) {
      throw bad_input("rows of coordinates", show(coordinates.rows()), "2 or 3");
    }
    detail::require_finite_entries("coordinates", coordinates);
    if (block_size < 0 || block_size > 3) {
      throw bad_input("block_size", show(block_size), "a number from 0 to 3");
    }
    if (!(strength >= 0 && strength < 1)) {
      throw bad_input("strength", show(strength), "a number in [0, 1)");
    }
    if (!(damping > 0 && damping < 2)) {
      throw bad_input("damping", show(damping), "a number in (0, 2)");
    }
    if (coarsest < 1) throw bad_input("coarsest", show(coarsest), "at least 1");
    if (levels < 1) throw bad_input("levels", show(levels), "at least 1");
    if (!(complexity > 1)) throw bad_input("complexity", show(complexity), "a number > 1");
  }
};

/// K, and G of unknowns v = G u: of a multigrid for G⁻ᵀK G⁻¹.
template <class S>
struct mixed_unknowns {
  Eigen::SparseMatrix<S> const& K;
  Eigen::SparseMatrix<S, Eigen::RowMajor> const& G;
};

}  // namespace slant

namespace slant::detail {

// --- hierarchy -----------------------------------------------------------------------------------

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
  near_kernel<M, M> kernel{};  // of the next level, in that case
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
  dense_factor<N, T> only;           // of level 0 if there is no other
  dense_factor<M, T> last;           // of the last level
  bool factored = false;             // whether there is such a factor
  index most_factored = 0;           // a last level with more unknowns is not
  bool smoothed = true;              // all P by smoothing, none above the limit of complexity

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
    auto below = aggregate_below(fine, B, o);
    if (!below) return;
    append(fine, std::move(*below));
    aggregate_rest(o);
  }
  /// The same where level 0 is G⁻ᵀK G⁻¹, of unknowns v = G u: P = G P_K, with P_K and near kernel
  /// those of factor · K.
  template <class K, class G>
  void aggregate_mixed(K const& k, typename K::Scalar const& factor, G const& g,
                       near_kernel<N, M> const& B, multigrid_options const& o) {
    if (done(fine.A, o)) return;
    std::vector<double> unused;
    fine_level apart = level_of(k, factor, unused);
    auto below = aggregate_below(apart, B, o);
    if (!below) return;
    apart = {};
    below->P = mixed_prolongation(below->P, g);
    below->C = galerkin_pattern(fine.A, below->P, fine.longest);
    append(fine, std::move(*below));
    aggregate_rest(o);
  }
  /// Levels by prolongations of the user, of unknowns v = G u where G is given, then by aggregation
  /// until one is small enough.
  template <class G>
  void interpolate_all(multigrid_options const& o, G const* g) {
    static_assert(N == M);
    for (std::size_t l = 0; l < o.prolongations.size(); ++l) {
      fine_level& above = l == 0 ? fine : coarse.back();
      auto P = prolongation_from<N, T>(o.prolongations[l], above.A.nodes(),
                                       "prolongation " + show(static_cast<index>(l)));
      auto nodes = heaviest_parents(P);
      if (l == 0 && g) P = mixed_prolongation(P, *g);
      auto kernel = constants<M, M>(P.coarse_nodes);
      append_by(above, std::move(P), std::move(nodes), std::move(kernel));
    }
    if (coarse.back().A.rows() > 2 * o.coarsest) aggregate_rest(o);
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

  /// Factors the last level, once. Throws bad_input if K is found not to be semidefinite.
  void finish(index most) {
    most_factored = most;
    if (factored) return;
    auto const factor = [&](auto& to, auto const& A) {
      // A level that would not become smaller has few couplings, and sweeps solve it well enough.
      if (A.rows() > most_factored) return;
      to = std::remove_reference_t<decltype(to)>(A.nodes());
      double const lowest = to.factor(A, A, whole_blocks{});
      // Less is what rounding leaves of pivots of slender bodies, level after level.
      if (lowest < -64 * std::sqrt(static_cast<double>(std::numeric_limits<T>::epsilon()))) {
        throw bad_input("K", "a negative pivot on level " + show(static_cast<index>(coarse.size())),
                        "a symmetric positive definite matrix");
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

  /// What a level below is made of: P, the pattern of PᵀA P, the aggregates and their near kernel.
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
  void aggregate_rest(multigrid_options const& o) {
    near_kernel<M, M> B = coarse.size() > 1 ? coarse[coarse.size() - 2].kernel : fine.kernel;
    while (!done(coarse.back().A, o)) {
      auto below = aggregate_below(coarse.back(), B, o);
      if (!below) return;
      B = below->kernel;
      append(coarse.back(), std::move(*below));
    }
  }

  /// The level below; nothing if there is none that is smaller.
  template <int F>
  std::optional<level_below<F>> aggregate_below(multigrid_level<F, M, T>& above,
                                                near_kernel<F, M> const& B,
                                                multigrid_options const& o) {
    // A level may have so many of the numbers of the one above that all have what the limit allows.
    double const most = (1 - 1 / o.complexity) * double(above.A.blocks()) * (F * F);
    T const λ = largest_jacobi_eigenvalue(above.A, above.inverses.data());
    double θ = o.strength;
    bool smooth = λ > T(0);
    while (true) {
      aggregation a = aggregate(above.A, θ);
      if (a.count == 0 || 10 * a.count > 9 * index(above.A.nodes())) {
        if (θ == 0) return std::nullopt;
        θ = weaker(θ);
        continue;
      }
      near_kernel<M, M> next;
      auto const Q = orthonormal_candidates<F, M, T>(a, B, next);
      T const ω = smooth ? T(o.damping) / λ : T(0);
      auto P = smoothed_prolongation<F, M, T>(above.A, above.inverses.data(), a, Q, ω);
      auto C = galerkin_pattern(above.A, P, above.longest);
      if (smooth && double(C.blocks()) * (M * M) > most) {
        if (θ == 0) smooth = false;
        θ = weaker(θ);
        continue;
      }
      smoothed = smoothed && smooth;
      return level_below<F>{std::move(P), std::move(C), std::move(a), std::move(next)};
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

// --- cycle ---------------------------------------------------------------------------------------

/// Block vectors of a level.
template <class T>
struct level_vectors {
  std::vector<T> x, b, r;

  explicit level_vectors(std::size_t n) : x(n, T(0)), b(n, T(0)), r(n, T(0)) {}
};

/// What belongs to a face: copies of the coarse levels whose rows follow it, and as much again for
/// the changes.
template <int N, int M, class T>
struct levels_on_face {
  node_face<N, T> face;
  std::vector<block_matrix<M, T>> A;  // of coarse levels
  std::vector<block_matrix<M, T>> D;  // what the last face has changed of them
  std::vector<std::vector<T>> inverses;
  int changes = 0;  // of A since it was that of no face: each leaves some rounding
  dense_factor<N, T> only;
  dense_factor<M, T> last;
  galerkin_scratch<N, M, T> first_scratch;
  std::vector<galerkin_scratch<M, M, T>> scratch;
  std::vector<int> moved, parents;

  explicit levels_on_face(hierarchy<N, M, T> const& h)
      : face(h.fine.A.nodes(), h.fine.inverses), only(h.only), last(h.last) {
    if (!h.coarse.empty()) first_scratch = {h.fine.P, h.fine.longest};
    std::size_t const most = static_cast<std::size_t>(h.fine.A.nodes());
    moved.reserve(most);
    parents.reserve(most);
    for (std::size_t l = 0; l < h.coarse.size(); ++l) {
      A.push_back(h.coarse[l].A);
      D.push_back(h.coarse[l].A.of_same_pattern());
      inverses.push_back(h.coarse[l].inverses);
      scratch.emplace_back();
      if (l + 1 < h.coarse.size()) scratch.back() = {h.coarse[l].P, h.coarse[l].longest};
    }
  }
};

/// The workspace of a cycle.
template <int N, int M, class T>
struct cycle_workspace {
  level_vectors<T> fine;
  std::vector<level_vectors<T>> coarse;
  std::optional<levels_on_face<N, M, T>> on_face;

  explicit cycle_workspace(hierarchy<N, M, T> const& h) : fine(h.fine.A.padded_size()) {
    for (auto const& l : h.coarse) coarse.emplace_back(l.A.padded_size());
  }
};

/// x = cycle(b) on the levels below the finest, from l on.
template <int N, int M, class T>
void coarse_cycle(hierarchy<N, M, T> const& h, cycle_workspace<N, M, T>& w, bool on_face,
                  std::size_t l) {
  auto const& A = on_face ? w.on_face->A[l] : h.coarse[l].A;
  auto const& inverses = on_face ? w.on_face->inverses[l] : h.coarse[l].inverses;
  auto& v = w.coarse[l];
  bool const last = l + 1 == h.coarse.size();
  if (last && h.factored) {
    (on_face ? w.on_face->last : h.last).solve(v.b.data(), v.x.data());
    return;
  }
  A.forwards_from_zero(inverses.data(), v.b.data(), v.x.data(), v.r.data());
  if (!last) {
    auto const& P = h.coarse[l].P;
    P.restrict_to(v.r.data(), w.coarse[l + 1].b.data());
    coarse_cycle(h, w, on_face, l + 1);
    P.add_to(w.coarse[l + 1].x.data(), v.x.data());
  }
  A.backwards(inverses.data(), v.b.data(), v.x.data(), v.r.data());
}

/// x = cycle(b) on all levels.
template <int N, int M, class T>
void cycle(hierarchy<N, M, T> const& h, cycle_workspace<N, M, T>& w, bool on_face) {
  auto& v = w.fine;
  auto* const face = on_face ? &w.on_face->face : nullptr;
  T const* const inverses = face ? face->inverses() : h.fine.inverses.data();
  // r = b − A x, or at a surface what Π makes of it.
  h.fine.A.forwards_from_zero(inverses, v.b.data(), v.x.data(), v.r.data());
  if (!h.coarse.empty() || h.factored) {
    if (face) {
      face->project(v.r.data());
      face->remember(v.x.data());
    }
    if (h.coarse.empty()) {
      (on_face ? w.on_face->only : h.only).solve(v.r.data(), v.r.data());
      for (std::size_t k = 0; k < v.x.size(); ++k) v.x[k] += v.r[k];
    } else {
      h.fine.P.restrict_to(v.r.data(), w.coarse.front().b.data());
      coarse_cycle(h, w, on_face, 0);
      h.fine.P.add_to(w.coarse.front().x.data(), v.x.data());
    }
    if (face) face->project_change(v.x.data());
  }
  h.fine.A.backwards(inverses, v.b.data(), v.x.data(), v.r.data());
}

/// The coarse levels follow a face of which w.on_face->moved are the nodes that have changed. Returns
/// how many of their rows that were.
template <int N, int M, class T>
index follow_face(hierarchy<N, M, T> const& h, cycle_workspace<N, M, T>& w) {
  auto& f = *w.on_face;
  if (f.moved.empty()) return 0;
  if (h.coarse.empty()) {
    if (h.factored) f.only.factor(h.fine.A, h.fine.A, f.face.formed_blocks());
    return 0;
  }
  constexpr int most = 256;
  bool const begins_again = ++f.changes > most;
  if (begins_again) {
    f.changes = 1;
    for (std::size_t l = 0; l < f.A.size(); ++l) {
      f.A[l] = h.coarse[l].A;
      f.inverses[l] = h.coarse[l].inverses;
    }
    f.face.forget_levels(f.moved);
  }
  index rows = 0;
  for (std::size_t l = 0; l < f.A.size(); ++l) {
    if (l == 0) {
      galerkin_change(h.fine.A, h.fine.P, f.A[0], f.D[0], f.moved, f.parents, f.first_scratch,
                      f.face.change_of_blocks());
    } else {
      galerkin_change(f.D[l - 1], h.coarse[l - 1].P, f.A[l], f.D[l], f.moved, f.parents,
                      f.scratch[l - 1], whole_blocks{});
    }
    for (int const i : f.parents) {
      invert_diagonal(f.A[l], h.coarse[l].A, i, f.inverses[l].data());
    }
    rows += static_cast<index>(f.parents.size());
    std::swap(f.moved, f.parents);
  }
  if (h.factored && (begins_again || !f.moved.empty())) {
    f.last.factor(f.A.back(), h.coarse.back().A, whole_blocks{});
  }
  return rows;
}

}  // namespace slant::detail

namespace slant {

// --- multigrid -----------------------------------------------------------------------------------

/// The V-cycle for vectors of scalars S, with levels of scalars T. Copies share the levels, which
/// never change.
template <class S = double, class T = float>
class multigrid {
  using sparse_view = Eigen::Ref<Eigen::SparseMatrix<S> const>;
  template <int N, int M>
  using levels = detail::hierarchy<N, M, T>;
  using all_levels =
      std::variant<levels<3, 6>, levels<3, 3>, levels<2, 3>, levels<2, 2>, levels<1, 1>>;

 public:
  using scalar = S;
  using vector_type = Eigen::Matrix<S, Eigen::Dynamic, 1>;
  using matrix_type = Eigen::Matrix<S, Eigen::Dynamic, Eigen::Dynamic>;
  static constexpr law_set laws = slant::laws<slant::self_adjoint, slant::positive_definite>;

  /// A vector of scalars S, no matrix of several.
  template <class X>
  static constexpr bool column =
      std::same_as<scalar_t<X>, S> && int(local_t<X>::ColsAtCompileTime) == 1;

  /// By aggregation, for K (n × n, both triangles) whose near kernel consists of the rigid-body
  /// modes of options.coordinates, or without these of constants, one for each unknown of a node.
  /// Throws bad_input if K is not square, finite and symmetric, or found not to be semidefinite, if
  /// sizes do not fit, and for options out of range.
  template <class M>
  explicit multigrid(Eigen::SparseMatrixBase<M> const& k, multigrid_options const& o = {})
      : multigrid(k, matrix_type(0, 0), o) {}
  /// For candidates of the near kernel: n × r, finite, r at most 6 in space, 3 in the plane, 1 with
  /// one unknown a node; such as contact::rigid_body_modes of the nodes. No columns: constants.
  template <class M, class B>
  multigrid(Eigen::SparseMatrixBase<M> const& k, Eigen::MatrixBase<B> const& candidates,
            multigrid_options const& o = {})
      : multigrid(sparse_view(k.derived()), nullptr, matrix_type(candidates.derived()), o) {}
  /// For unknowns v = G u that mix those of several nodes of K, as jumps and means of the two sides
  /// of a contact do: levels for k = G⁻ᵀK G⁻¹ of P = G P_K, where P_K is by aggregation of K with
  /// its candidates, or the first of options.prolongations. Throws bad_input as above, also where
  /// sizes of k, K, G differ.
  template <class M, class B>
  multigrid(Eigen::SparseMatrixBase<M> const& k, mixed_unknowns<S> const& mixed,
            Eigen::MatrixBase<B> const& candidates, multigrid_options const& o = {})
      : multigrid(sparse_view(k.derived()), &mixed, matrix_type(candidates.derived()), o) {}
  [[nodiscard]] index rows() const { return rows_; }
  [[nodiscard]] index cols() const { return rows_; }
  /// Unknowns of each level, the finest first.
  [[nodiscard]] std::vector<index> sizes() const {
    return std::visit([](auto const& h) { return h.sizes(); }, *levels_);
  }
  /// Numbers of the matrices of all levels over those of the finest: 1.2 to 1.6 as a rule.
  [[nodiscard]] double complexity() const {
    return std::visit([](auto const& h) { return h.complexity(); }, *levels_);
  }
  /// A sentence: which levels, and what would make better ones.
  [[nodiscard]] std::string const& description() const { return description_; }

  // --- the next coarser level, for problems that are solved there first ---------------------------

  /// Which node of level 1 each node of K belongs to, with prolongations of the user the one of the
  /// greatest weight; empty if there is no such level.
  [[nodiscard]] aggregation const& aggregates() const {
    return std::visit([](auto const& h) -> aggregation const& { return h.fine.aggregates; },
                      *levels_);
  }
  /// Unknowns of a node of K.
  [[nodiscard]] index node_size() const {
    return std::visit([]<int N, int M>(levels<N, M> const&) { return index(N); }, *levels_);
  }
  /// The near kernel of level 1, n₁ × r for nodes of r unknowns, upper triangular blocks R: on an
  /// aggregate the candidates of K are Q R, Q what its unknowns stand for before smoothing. With
  /// prolongations of the user R = I, for constants as candidates.
  [[nodiscard]] matrix_type coarse_kernel() const;
  /// PᵀK P, of full blocks.
  [[nodiscard]] Eigen::SparseMatrix<S> coarse_matrix() const;
  /// Pᵀx.
  [[nodiscard]] vector_type restricted(vector_type const& x) const;
  /// P x.
  [[nodiscard]] vector_type prolonged(vector_type const& x) const;
  /// The multigrid of level 1 in unknowns G w, for k = G⁻ᵀ(PᵀK P)G⁻¹; G without rows: the identity.
  /// Its other levels are those of this one, formed anew only where G couples what PᵀK P does not,
  /// and so are their units: numbers of G and G⁻¹ are of size 1. Nodes of six unknowns are two of
  /// three; candidates and kernels stay those of w. There has to be a level 1. Throws bad_input for
  /// sizes that do not fit, and if k is found not to be finite, symmetric and semidefinite.
  [[nodiscard]] multigrid coarser(sparse_view const& k,
                                  Eigen::SparseMatrix<S, Eigen::RowMajor> const& G) const;

  /// Vectors of all levels, and the face entered last with the coarse levels that follow it.
  struct workspace_type {
    std::variant<detail::cycle_workspace<3, 6, T>, detail::cycle_workspace<3, 3, T>,
                 detail::cycle_workspace<2, 3, T>, detail::cycle_workspace<2, 2, T>,
                 detail::cycle_workspace<1, 1, T>>
        levels;
    index rows_formed = 0;  ///< rows of blocks of coarse levels changed for faces so far
    S unit{1};              ///< of the x that was found last
    bool is_short = false;  ///< whether that is what the finest level holds, in units and short
  };
  template <class X>
    requires column<X>
  [[nodiscard]] workspace_type workspace(X const&) const {
    return make_workspace();
  }

  /// y = M x.
  template <class X, class Y>
    requires column<X>
  void apply(X const& x, Y& y, workspace_type& w) const {
    run(slant::local(x).data(), slant::local(y).data(), w, false);
  }

  /// y ≈ K x by the finest level, in numbers T.
  static constexpr S roughness = S(std::numeric_limits<T>::epsilon());
  template <class X, class Y>
    requires column<X>
  void multiply_roughly(X const& x, Y& y, workspace_type& w) const {
    rough(slant::local(x).data(), slant::local(y).data(), w);
  }
  /// The same for the x that apply or apply_on_face has found last, by half of the level.
  template <class X, class Y>
    requires column<X>
  void multiply_last_roughly(X const& x, Y& y, workspace_type& w) const {
    rough_last(slant::local(x).data(), slant::local(y).data(), w);
  }

  /// From now on apply_on_face is for H = Π K Π + weight · C with Π and C of a face that knows their
  /// entries (sets/curved_face.hpp); its blocks lie within nodes.
  /// Rows of coarse levels change where the face has changed. The first face of a workspace
  /// allocates, later ones where they have nodes that no face had before. Throws bad_input if Π is
  /// no projector on every node.
  template <detail::face_of_entries Face>
  void enter(Face const& face, S const& weight, workspace_type& w) const {
    if (rows_ == 0) return;
    prepare_face(w);
    with_workspace(w, [&](auto const& h, auto& v) {
      double const κ = static_cast<double>(S(weight * factor_));
      auto& f = *v.on_face;
      f.face.assign(face, κ, h.diagonal, f.moved);
    });
    follow_face(w);
  }
  /// The same without curvature.
  template <detail::face_of_entries Face>
  void enter(Face const& face, workspace_type& w) const {
    enter(face, S(0), w);
  }
  /// y ≈ H⁻¹x on the face entered last, 0 off it.
  template <class X, class Y>
    requires column<X>
  void apply_on_face(X const& x, Y& y, workspace_type& w) const {
    run(slant::local(x).data(), slant::local(y).data(), w, true);
  }

 private:
  multigrid() = default;
  multigrid(sparse_view const& K, mixed_unknowns<S> const* mixed, matrix_type candidates,
            multigrid_options const& o);
  [[nodiscard]] workspace_type make_workspace() const;
  /// y = M x, or on the face.
  void run(S const* x, S* y, workspace_type& w, bool on_face) const;
  void rough(S const* x, S* y, workspace_type& w) const;
  void rough_last(S const* x, S* y, workspace_type& w) const;
  /// Memory for a face, once.
  void prepare_face(workspace_type& w) const;
  void follow_face(workspace_type& w) const;

  /// Size and unit of K.
  void prepare(sparse_view const& K) {
    detail::require_square("K", K);
    rows_ = K.rows();
    S most(0);
    for (index j = 0; j < K.outerSize(); ++j) {
      using std::abs;
      S const d = K.coeff(j, j);
      if (!detail::is_finite(d)) detail::require_finite_entries("K", K);
      most = std::max<S>(most, abs(d));
    }
    factor_ = S(1) / unit_near(most);
  }

  [[nodiscard]] matrix_type candidates_for(matrix_type given, multigrid_options const& o) const {
    if (given.cols() > 0) {
      detail::check_size("rows of the candidates", given.rows(), rows_, "the size of K,");
      detail::require_finite_entries("candidates", given);
      return given;
    }
    if (o.coordinates.size() == 0) return matrix_type(0, 0);
    index const D = o.coordinates.rows();
    detail::check_size("coordinates", o.coordinates.size(), rows_, "a column for each node of K,");
    return detail::rigid_motions<S>(
        o.coordinates, rows_, [D](index j) { return j / D; }, [D](index j) { return j % D; });
  }

  /// Unknowns of a node for so many candidates.
  [[nodiscard]] index block_size(sparse_view const& K, index candidates,
                                 multigrid_options const& o) const {
    index b = o.block_size;
    if (b == 0 && o.coordinates.size() > 0) b = o.coordinates.rows();
    if (b == 0) {
      b = detected_block_size(K);
      for (index const wider : {2, 3}) {
        if (most_candidates(b) < candidates && rows_ % wider == 0) b = std::max(b, wider);
      }
    }
    if (rows_ % b != 0) {
      throw bad_input("block_size", detail::show(b), "a divisor of " + detail::show(rows_));
    }
    if (candidates > most_candidates(b)) {
      throw bad_input("columns of the candidates", detail::show(candidates),
                      "at most " + detail::show(most_candidates(b)) + " for nodes of " +
                          detail::show(b) + " unknowns");
    }
    return b;
  }
  static index most_candidates(index b) { return b == 3 ? 6 : b == 2 ? 3 : 1; }

  /// Levels for nodes of b unknowns: fill(levels) makes them.
  template <class F>
  void build(index b, index candidates, multigrid_options const& o, F fill) {
    with_levels(b, candidates > b && o.prolongations.empty(), [&](auto& h) {
      fill(h);
      h.finish(o.most_factored());
    });
    note(std::visit([](auto const& h) { return h.smoothed; }, *levels_), candidates, o);
  }
  /// Whether there are prolongations of the user; the levels that they make.
  template <int N, int W>
  static bool interpolates(levels<N, W>& h, multigrid_options const& o,
                           Eigen::SparseMatrix<S, Eigen::RowMajor> const* G) {
    if (o.prolongations.empty()) return false;
    if constexpr (N == W) h.interpolate_all(o, G);
    return true;
  }

  /// f(levels) for nodes of b unknowns, coarse ones with rotations or without.
  template <class F>
  void with_levels(index b, bool rotations, F f) {
    auto const with = [&]<int N, int M>(std::integral_constant<int, N>,
                                        std::integral_constant<int, M>) {
      auto all = std::make_shared<all_levels>(std::in_place_type<levels<N, M>>);
      f(std::get<levels<N, M>>(*all));
      levels_ = std::move(all);
    };
    constexpr std::integral_constant<int, 1> one;
    constexpr std::integral_constant<int, 2> two;
    constexpr std::integral_constant<int, 3> three;
    constexpr std::integral_constant<int, 6> six;
    if (b == 3 && rotations) with(three, six);
    if (b == 3 && !rotations) with(three, three);
    if (b == 2 && rotations) with(two, three);
    if (b == 2 && !rotations) with(two, two);
    if (b == 1) with(one, one);
  }
  template <class F>
  void with_workspace(workspace_type& w, F f) const {
    std::visit(
        [&]<int N, int M>(levels<N, M> const& h) {
          f(h, std::get<detail::cycle_workspace<N, M, T>>(w.levels));
        },
        *levels_);
  }

  template <int N, int M>
  [[nodiscard]] detail::near_kernel<N, M> kernel(matrix_type const& modes) const {
    if (modes.cols() == 0) return detail::constants<N, M>(static_cast<int>(rows_ / N));
    detail::near_kernel<N, M> B;
    B.blocks.assign(static_cast<std::size_t>(rows_) * M, 0.0);
    for (index c = 0; c < modes.cols(); ++c) {
      for (index i = 0; i < rows_; ++i) {
        B.blocks[static_cast<std::size_t>(i * M + c)] = static_cast<double>(modes(i, c));
      }
    }
    return B;
  }

  [[nodiscard]] std::string levels_text() const {
    std::string text;
    for (index const n : sizes()) {
      text += (text.empty() ? "levels of " : ", ") + detail::show(n);
    }
    return text + " unknowns, complexity " + detail::show(std::round(100 * complexity()) / 100);
  }
  void note(bool smoothed, index candidates, multigrid_options const& o) {
    bool const nodes =
        std::visit([]<int N, int M>(levels<N, M> const&) { return N > 1; }, *levels_);
    if (!o.prolongations.empty()) {
      description_ = "prolongations of the user: " + levels_text();
      return;
    }
    std::string const kernel =
        o.coordinates.size() > 0 && candidates > 0 ? "rigid-body modes of the coordinates"
        : candidates > 0                           ? detail::show(candidates) + " candidates given"
        : nodes ? "translations only, which in elasticity takes up to twice the cycles that "
                  "coordinates of the nodes would"
                : "constants";
    description_ = "smoothed aggregation with " + kernel + ": " + levels_text();
    if (!smoothed) description_ += "; not smoothed where that would exceed the limit of complexity";
  }

  /// b ← x, n numbers, in units of which the power of two is returned.
  template <int N>
  static S shorten(S const* x, index n, std::vector<T>& b) {
    constexpr std::size_t stride = block_matrix<N, T>::stride;
    S most(0);
    for (index i = 0; i < n; ++i) {
      S const size = x[i] < S(0) ? S(-x[i]) : x[i];
      if (!(size <= most)) most = size;
    }
    S const unit = unit_near(most), inverse = S(1) / unit;
    for (std::size_t i = 0; i < static_cast<std::size_t>(n) / N; ++i) {
      for (std::size_t c = 0; c < N; ++c) b[i * stride + c] = T(S(x[i * N + c] * inverse));
    }
    return unit;
  }
  /// y ← factor · x, n numbers.
  template <int N>
  static void lengthen(std::vector<T> const& x, S const& factor, S* y, index n) {
    constexpr std::size_t stride = block_matrix<N, T>::stride;
    for (std::size_t i = 0; i < static_cast<std::size_t>(n) / N; ++i) {
      for (std::size_t c = 0; c < N; ++c) y[i * N + c] = S(x[i * stride + c]) * factor;
    }
  }

  std::shared_ptr<all_levels const> levels_;
  index rows_ = 0;
  S factor_{1};  // a power of two; the levels are those of factor · K
  std::string description_;
};

// --- what does not depend on types of vectors and faces -----------------------------------------

template <class S, class T>
multigrid<S, T>::multigrid(sparse_view const& K, mixed_unknowns<S> const* mixed,
                           matrix_type candidates, multigrid_options const& o) {
  o.validate();
  prepare(K);
  if (mixed) {
    detail::check_size("rows of K", mixed->K.rows(), rows_, "the size of k,");
    detail::check_size("columns of K", mixed->K.cols(), rows_, "the size of k,");
    detail::check_size("rows of G", mixed->G.rows(), rows_, "the size of k,");
    detail::check_size("columns of G", mixed->G.cols(), rows_, "the size of k,");
  }
  matrix_type const modes = candidates_for(std::move(candidates), o);
  sparse_view const given = mixed ? sparse_view(mixed->K) : sparse_view(K);
  index const b = block_size(given, modes.cols(), o);
  build(b, modes.cols(), o, [&]<int N, int W>(levels<N, W>& h) {
    h.begin(K, factor_);
    if (interpolates(h, o, mixed ? &mixed->G : nullptr)) return;
    if (mixed) {
      h.aggregate_mixed(given, factor_, mixed->G, kernel<N, W>(modes), o);
    } else {
      h.aggregate_all(kernel<N, W>(modes), o);
    }
  });
}

template <class S, class T>
auto multigrid<S, T>::coarse_kernel() const -> matrix_type {
  return std::visit(
      []<int N, int M>(levels<N, M> const& h) {
        auto const& blocks = h.fine.kernel.blocks;
        auto const n = static_cast<index>(blocks.size()) / M;
        matrix_type R(n, M);
        for (index i = 0; i < n; ++i) {
          for (index c = 0; c < M; ++c) {
            R(i, c) = S(blocks[static_cast<std::size_t>(i * M + c)]);
          }
        }
        return R;
      },
      *levels_);
}

template <class S, class T>
Eigen::SparseMatrix<S> multigrid<S, T>::coarse_matrix() const {
  return std::visit(
      [&]<int N, int M>(levels<N, M> const& h) {
        auto const& A = h.coarse.front().A;
        Eigen::SparseMatrix<S> C(A.rows(), A.rows());
        C.resizeNonZeros(A.blocks() * M * M);
        index at = 0;
        for (int j = 0; j < A.nodes(); ++j) {  // columns are rows
          for (int c = 0; c < M; ++c) {
            C.outerIndexPtr()[index(j) * M + c] = static_cast<int>(at);
            A.for_each_in_row(j, [&](int i, T const* block) {
              for (int q = 0; q < M; ++q, ++at) {
                C.innerIndexPtr()[at] = i * M + q;
                C.valuePtr()[at] = S(block[M * q + c]) / factor_;
              }
            });
          }
        }
        C.outerIndexPtr()[A.rows()] = static_cast<int>(at);
        return C;
      },
      *levels_);
}

template <class S, class T>
auto multigrid<S, T>::restricted(vector_type const& x) const -> vector_type {
  return std::visit(
      [&]<int N, int M>(levels<N, M> const& h) {
        auto const& A = h.coarse.front().A;
        std::vector<T> from(h.fine.A.padded_size(), T(0)), to(A.padded_size(), T(0));
        vector_type y(A.rows());
        S const unit = shorten<N>(x.data(), x.size(), from);
        h.fine.P.restrict_to(from.data(), to.data());
        lengthen<M>(to, unit, y.data(), y.size());
        return y;
      },
      *levels_);
}

template <class S, class T>
auto multigrid<S, T>::prolonged(vector_type const& x) const -> vector_type {
  return std::visit(
      [&]<int N, int M>(levels<N, M> const& h) {
        auto const& A = h.coarse.front().A;
        std::vector<T> from(A.padded_size(), T(0)), to(h.fine.A.padded_size(), T(0));
        vector_type y(rows_);
        S const unit = shorten<M>(x.data(), x.size(), from);
        h.fine.P.add_to(from.data(), to.data());
        lengthen<N>(to, unit, y.data(), y.size());
        return y;
      },
      *levels_);
}

template <class S, class T>
multigrid<S, T> multigrid<S, T>::coarser(sparse_view const& k,
                                         Eigen::SparseMatrix<S, Eigen::RowMajor> const& G) const {
  return std::visit(
      [&]<int N, int M>(levels<N, M> const& h) {
        constexpr int node = M == 6 ? 3 : M;
        if (h.coarse.empty()) throw bad_input("levels", "1", "a level 1 to begin with");
        index const n = h.coarse.front().A.rows();
        detail::check_size("rows of k", k.rows(), n, "the unknowns of level 1,");
        detail::check_size("columns of k", k.cols(), n, "the unknowns of level 1,");
        if (G.rows() > 0) {
          detail::check_size("rows of G", G.rows(), n, "the unknowns of level 1,");
          detail::check_size("columns of G", G.cols(), n, "the unknowns of level 1,");
        }
        multigrid c;
        c.rows_ = n;
        c.factor_ = factor_;
        auto all = std::make_shared<all_levels>(std::in_place_type<levels<node, M>>);
        auto& own = std::get<levels<node, M>>(*all);
        own.take_below(h, k, factor_, G);
        own.finish(h.most_factored);
        c.levels_ = std::move(all);
        c.description_ = "from level 1 on: " + c.levels_text();
        return c;
      },
      *levels_);
}

template <class S, class T>
auto multigrid<S, T>::make_workspace() const -> workspace_type {
  return std::visit(
      []<int N, int M>(levels<N, M> const& h) {
        return workspace_type{.levels = detail::cycle_workspace<N, M, T>(h)};
      },
      *levels_);
}

template <class S, class T>
void multigrid<S, T>::run(S const* x, S* y, workspace_type& w, bool on_face) const {
  if (rows_ == 0) return;
  with_workspace(w, [&]<int N, int M>(levels<N, M> const& h, detail::cycle_workspace<N, M, T>& v) {
    w.unit = shorten<N>(x, rows_, v.fine.b);
    bool const faced = on_face && v.on_face.has_value();
    detail::cycle(h, v, faced);
    lengthen<N>(v.fine.x, w.unit * factor_, y, rows_);
    w.is_short = !faced || !v.on_face->face.complete(x, y, factor_);
  });
}

template <class S, class T>
void multigrid<S, T>::rough(S const* x, S* y, workspace_type& w) const {
  if (rows_ == 0) return;
  with_workspace(w, [&]<int N, int M>(levels<N, M> const& h, detail::cycle_workspace<N, M, T>& v) {
    S const unit = shorten<N>(x, rows_, v.fine.b);
    h.fine.A.multiply(v.fine.b.data(), v.fine.r.data());
    lengthen<N>(v.fine.r, unit / factor_, y, rows_);
  });
  w.is_short = false;  // what was known of its image is gone
}

template <class S, class T>
void multigrid<S, T>::rough_last(S const* x, S* y, workspace_type& w) const {
  if (!w.is_short) return rough(x, y, w);
  with_workspace(w, [&]<int N, int M>(levels<N, M> const& h, detail::cycle_workspace<N, M, T>& v) {
    h.fine.A.complete_product(v.fine.x.data(), v.fine.r.data());
    lengthen<N>(v.fine.r, w.unit, y, rows_);
  });
  w.is_short = false;  // what was half of the image is all of it
}

template <class S, class T>
void multigrid<S, T>::prepare_face(workspace_type& w) const {
  with_workspace(w, [](auto const& h, auto& v) {
    if (!v.on_face) v.on_face.emplace(h);
  });
}

template <class S, class T>
void multigrid<S, T>::follow_face(workspace_type& w) const {
  with_workspace(w, [&](auto const& h, auto& v) { w.rows_formed += detail::follow_face(h, v); });
}

#if SLANT_USES_COMPILED
extern template class multigrid<double, float>;
#endif

template <class M>
multigrid(Eigen::SparseMatrixBase<M> const&, multigrid_options const& = {})
    -> multigrid<typename M::Scalar>;
template <class M, class B>
multigrid(Eigen::SparseMatrixBase<M> const&, Eigen::MatrixBase<B> const&,
          multigrid_options const& = {}) -> multigrid<typename M::Scalar>;

}  // namespace slant
