// SPDX-License-Identifier: MIT
//
// Multigrid: an operator M ≈ K⁻¹ for a sparse symmetric positive definite K, of the cost of a few
// products by K and with a condition number of M K that hardly depends on the mesh. Its levels are
// described in hierarchy.hpp, its cycle in parts/cycle.hpp.
#pragma once

#include <slant/base/matrix_entries.hpp>
#include <slant/base/partitions.hpp>
#include <slant/base/scaling.hpp>
#include <slant/compiled.hpp>
#include <slant/concepts/bad_input.hpp>
#include <slant/concepts/laws.hpp>
#include <slant/concepts/scalar.hpp>
#include <slant/concepts/vector.hpp>
#include <slant/multilevel/hierarchy.hpp>
#include <slant/multilevel/parts/cycle.hpp>

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include <algorithm>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <limits>
#include <memory>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

namespace slant {

/// K, and G of unknowns v = G u: of a multigrid for G⁻ᵀK G⁻¹.
template <class S>
struct mixed_unknowns {
  Eigen::SparseMatrix<S> const& K;
  Eigen::SparseMatrix<S, Eigen::RowMajor> const& G;
};

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
      : multigrid(viewed(k), nullptr, matrix_type(candidates.derived()), o) {}
  /// For unknowns v = G u that mix those of several nodes of K, as jumps and means of the two sides
  /// of a contact do: levels for k = G⁻ᵀK G⁻¹ of P = G P_K, where P_K is by aggregation of K with
  /// its candidates, or the first of options.prolongations. Throws bad_input as above, also where
  /// sizes of k, K, G differ.
  template <class M, class B>
  multigrid(Eigen::SparseMatrixBase<M> const& k, mixed_unknowns<S> const& mixed,
            Eigen::MatrixBase<B> const& candidates, multigrid_options const& o = {})
      : multigrid(viewed(k), &mixed, matrix_type(candidates.derived()), o) {}
  [[nodiscard]] index rows() const { return rows_; }
  [[nodiscard]] index cols() const { return rows_; }
  /// Whether the last level is factored; else it is smoothed.
  [[nodiscard]] bool factors_last_level() const {
    return std::visit([](auto const& h) { return h.factored; }, *levels_);
  }
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
  /// greatest weight; empty if there is no such level. Of aggregates where coarse_kernel() is empty.
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
  /// prolongations of the user R = I, for constants as candidates. No rows where rotations follow
  /// such prolongations: nodes of level 1 are then halves of aggregates.
  [[nodiscard]] matrix_type coarse_kernel() const;
  /// PᵀK P, of full blocks. As for the next three, there has to be a level 1: bad_input otherwise,
  /// and for an x that is not of the size of its level.
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
    requires(detail::contiguous_column<X, S> && detail::contiguous_column<Y, S>)
  void apply(X const& x, Y& y, workspace_type& w) const {
    run(slant::local(x).data(), slant::local(y).data(), w, false);
  }

  /// y ≈ K x by the finest level, in numbers T.
  static constexpr S roughness = S(std::numeric_limits<T>::epsilon());
  template <class X, class Y>
    requires(detail::contiguous_column<X, S> && detail::contiguous_column<Y, S>)
  void multiply_roughly(X const& x, Y& y, workspace_type& w) const {
    rough(slant::local(x).data(), slant::local(y).data(), w);
  }
  /// The same for the x that apply or apply_on_face has found last, by half of the level.
  template <class X, class Y>
    requires(detail::contiguous_column<X, S> && detail::contiguous_column<Y, S>)
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
    requires(detail::contiguous_column<X, S> && detail::contiguous_column<Y, S>)
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

  /// k itself, or a copy where its indices are not int.
  template <class M>
  static decltype(auto) viewed(Eigen::SparseMatrixBase<M> const& k) {
    if constexpr (std::same_as<typename M::StorageIndex, int>) {
      return (k.derived());
    } else {
      typename M::PlainObject const whole = k.derived();
      index const entries = whole.nonZeros();
      detail::check_option("entries of K", entries, entries <= std::numeric_limits<int>::max(),
                           "as many as an int counts");
      return Eigen::SparseMatrix<S>(whole);
    }
  }
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
      h.finish(o.most_work(), o.chebyshev);
    });
    note(std::visit([](auto const& h) { return h.smoothed; }, *levels_), candidates, o);
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
    Eigen::Map<vector_type const> const values(x, n);
    S const unit = unit_near(n > 0 ? S(values.cwiseAbs().maxCoeff()) : S(0)), inverse = S(1) / unit;
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
    detail::require_finite_entries("G", mixed->G);
  }
  matrix_type const modes = candidates_for(std::move(candidates), o);
  sparse_view const given = mixed ? sparse_view(mixed->K) : sparse_view(K);
  index const b = block_size(given, modes.cols(), o);
  build(b, modes.cols(), o, [&]<int N, int W>(levels<N, W>& h) {
    h.begin(K, factor_);
    if (!o.prolongations.empty()) {
      if constexpr (N == W) {
        constexpr int both = N == 3 ? 6 : N;
        bool const rotates = both > N && modes.cols() == both;
        h.interpolate_all(o, mixed ? &mixed->G : nullptr,
                          rotates ? kernel<N, both>(modes) : detail::near_kernel<N, both>{});
      }
    } else if (mixed) {
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
        auto const& A = h.first_coarse().A;
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
        auto const& A = h.first_coarse().A;
        detail::check_size("x", x.size(), rows_, "the size of K,");
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
        auto const& A = h.first_coarse().A;
        detail::check_size("x", x.size(), A.rows(), "the unknowns of level 1,");
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
        index const n = h.first_coarse().A.rows();
        detail::check_size("rows of k", k.rows(), n, "the unknowns of level 1,");
        detail::check_size("columns of k", k.cols(), n, "the unknowns of level 1,");
        if (G.rows() > 0) {
          detail::check_size("rows of G", G.rows(), n, "the unknowns of level 1,");
          detail::check_size("columns of G", G.cols(), n, "the unknowns of level 1,");
          detail::require_finite_entries("G", G);
        }
        multigrid c;
        c.rows_ = n;
        c.factor_ = factor_;
        auto all = std::make_shared<all_levels>(std::in_place_type<levels<node, M>>);
        auto& own = std::get<levels<node, M>>(*all);
        own.take_below(h, k, factor_, G);
        own.finish(h.most_work, h.degree);
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
    bool const held = faced && v.on_face->face.complete(x, y, factor_);
    w.is_short = !held && h.degree == 0;  // sweeps have found half of the image
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
