// SPDX-License-Identifier: MIT
//
// Multigrid by smoothed aggregation [Vaněk, Mandel, Brezina 1996]: an operator M ≈ K⁻¹ for a sparse
// symmetric positive definite K, of the cost of a few products by K and with a condition number of
// M K that hardly depends on the mesh.
//
//     cycle(b):   x ← forwards sweep of Gauss–Seidel from 0
//                 x ← x + P cycle(Pᵀ(b − K x))                  K_coarse = PᵀK P, the last one
//                 factored x ← backwards sweep
//
// What sweeps do not reach is the near kernel of K: constants of a Laplacian, rigid-body modes in
// elasticity. It is given by candidates, which the coarse levels represent exactly.
//
// Faces. With some unknowns held at zero the same hierarchy serves the matrix K_FF of the others:
// the sweeps pass over what is held and the coarse correction leaves it out. Such a cycle is the
// sum of the symmetrised sweep, definite on the face, and of a semidefinite term, so it is definite
// for every face, and nothing is set up anew when the face changes.
#pragma once

#include <slant/concepts/factorization.hpp>
#include <slant/concepts/laws.hpp>
#include <slant/factorizations/detail/spd_checks.hpp>
#include <slant/factorizations/factorize.hpp>
#include <slant/krylov/unit.hpp>
#include <slant/multilevel/detail/gauss_seidel.hpp>
#include <slant/multilevel/detail/smoothed_prolongation.hpp>
#include <slant/multilevel/detail/tentative_prolongation.hpp>
#include <slant/multilevel/multigrid_options.hpp>
#include <slant/operators/inverse.hpp>

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include <concepts>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace slant {

/// The V-cycle for a matrix of scalars S. Copies share the levels, which never change.
template <class S = double>
class multigrid {
 public:
  using scalar = S;
  using vector_type = Eigen::Matrix<S, Eigen::Dynamic, 1>;
  using matrix_type = Eigen::Matrix<S, Eigen::Dynamic, Eigen::Dynamic>;
  using sparse_type = detail::row_major_sparse<S>;
  using factor_type = decltype(slant::factorize(std::declval<Eigen::SparseMatrix<S> const&>()));
  using inverse_type = decltype(slant::inverse(std::declval<factor_type const&>()));
  static constexpr law_set laws = slant::laws<slant::self_adjoint, slant::positive_definite>;

  /// A vector of scalars S, no matrix of several.
  template <class X>
  static constexpr bool column =
      std::same_as<scalar_t<X>, S> && int(local_t<X>::ColsAtCompileTime) == 1;

  /// For K (n × n, both triangles) whose near kernel consists of constants, one for each unknown of
  /// a node. Throws bad_input if K is not square, finite and symmetric, or found not to be
  /// definite, if the block size does not divide n, and for options out of range.
  template <class M>
  explicit multigrid(Eigen::SparseMatrixBase<M> const& k, multigrid_options const& o = {})
      : multigrid(k, matrix_type(0, 0), o) {}
  /// For candidates of the near kernel: n × r with r ≥ 1 columns, finite; such as
  /// contact::rigid_body_modes of the nodes. No columns: constants.
  template <class M, class B>
  multigrid(Eigen::SparseMatrixBase<M> const& k, Eigen::MatrixBase<B> const& candidates,
            multigrid_options const& o = {})
      : levels_(std::make_shared<hierarchy>()), sweeps_(o.sweeps) {
    o.validate();
    sparse_type K = k.derived();
    detail::require_symmetric_matrix("K", K);
    K.makeCompressed();
    rows_ = K.rows();
    index const b = o.block_size > 0 ? o.block_size : detected_block_size(K);
    if (rows_ % b != 0) {
      throw bad_input("block_size", detail::show(b), "a divisor of " + detail::show(rows_));
    }
    matrix_type modes = candidates;
    if (modes.cols() == 0) modes = matrix_type::Identity(b, b).replicate(rows_ / b, 1);
    detail::check_size("rows of the candidates", modes.rows(), rows_, "the size of K,");
    detail::require_finite_entries("candidates", modes);
    if (rows_ > 0) build(std::move(K), node_blocks(rows_, b), std::move(modes), o);
  }

  [[nodiscard]] index rows() const { return rows_; }
  [[nodiscard]] index cols() const { return rows_; }
  /// Unknowns of each level, the finest first, the factored one last.
  [[nodiscard]] std::vector<index> sizes() const {
    std::vector<index> list;
    for (auto const& l : levels_->smooth) list.push_back(l.sweep.matrix().rows());
    if (levels_->coarsest) list.push_back(levels_->coarsest->rows());
    return list;
  }
  /// Entries of all matrices that a cycle passes through over those of K: 1.2 to 1.6 as a rule.
  [[nodiscard]] double complexity() const {
    if (levels_->smooth.empty()) return 1;
    double sum = 0;
    for (auto const& l : levels_->smooth) sum += double(l.sweep.matrix().nonZeros());
    return (sum + double(levels_->coarsest_entries)) /
           double(levels_->smooth.front().sweep.matrix().nonZeros());
  }

  /// Vectors of all levels, and which unknowns are held.
  struct workspace_type {
    struct vectors {
      vector_type x, b, r;
    };
    std::vector<vectors> levels;
    std::vector<unsigned char> held;
    std::optional<workspace_t<inverse_type, vector_type>> factor;
  };
  template <class X>
    requires column<X>
  [[nodiscard]] workspace_type workspace(X const&) const {
    workspace_type w;
    for (index const n : sizes()) {
      w.levels.push_back({vector_type(n), vector_type(n), vector_type(n)});
    }
    w.held.assign(static_cast<std::size_t>(rows_), 0);
    if (levels_->coarsest) {
      w.factor.emplace(slant::workspace(levels_->inverse(), w.levels.back().b));
    }
    return w;
  }

  /// y = M x.
  template <class X, class Y>
    requires column<X>
  void apply(X const& x, Y& y, workspace_type& w) const {
    run(x, y, w, detail::nothing_held{});
  }

  /// Unknowns that the face does not keep are held from now on. Not for curved faces, which mix
  /// them.
  template <class Face>
  void enter(Face const& face, workspace_type& w) const {
    if (rows_ == 0) return;
    auto& [kept, ones, r] = w.levels.front();
    ones.setOnes();
    face.keep(ones, kept);
    for (index i = 0; i < rows_; ++i) {
      w.held[static_cast<std::size_t>(i)] = kept[i] == S(0) ? 1 : 0;
    }
  }
  /// y ≈ (K_FF)⁻¹ x on the face entered last, 0 elsewhere.
  template <class X, class Y>
    requires column<X>
  void apply_on_face(X const& x, Y& y, workspace_type& w) const {
    run(x, y, w, detail::held_where{w.held.data()});
  }

 private:
  struct smooth_level {
    detail::gauss_seidel<S> sweep;
    sparse_type P;  // from the next coarser level
  };
  struct hierarchy {
    std::vector<smooth_level> smooth;
    std::optional<factor_type> coarsest;
    index coarsest_entries = 0;
    S unit{1};  // 1/2^e; the levels are those of K/2^e

    [[nodiscard]] inverse_type inverse() const { return slant::inverse(*coarsest); }
  };

  void build(sparse_type K, node_blocks nodes, matrix_type candidates, multigrid_options const& o) {
    auto& h = *levels_;
    h.unit = S(1) / unit_near(S(K.diagonal().cwiseAbs().maxCoeff()));
    K *= h.unit;
    while (true) {
      require_positive_diagonal(K, h.smooth.size(), h.unit);
      bool const last =
          K.rows() <= o.coarsest || static_cast<index>(h.smooth.size()) + 1 >= o.levels;
      detail::tentative_prolongation<S> t =
          last ? detail::tentative_prolongation<S>({}, {}, matrix_type(0, 0))
               : detail::tentative_prolongation<S>(aggregate(K, nodes, o.strength), nodes,
                                                   candidates);
      // Where aggregation gets nowhere little is coupled, and a factorisation is cheap.
      if (last || t.P.cols() == 0 || 10 * t.P.cols() > 9 * K.rows()) break;
      sparse_type P = detail::smoothed_prolongation<S>(K, t.P, S(o.damping));
      sparse_type const KP = K * P;
      sparse_type coarse = sparse_type(P.transpose()) * KP;
      h.smooth.push_back({detail::gauss_seidel<S>(std::move(K)), std::move(P)});
      K = std::move(coarse);
      nodes = std::move(t.nodes);
      candidates = std::move(t.candidates);
    }
    h.coarsest_entries = K.nonZeros();
    Eigen::SparseMatrix<S> const transposed = K.transpose();
    Eigen::SparseMatrix<S> const symmetric = S(0.5) * (Eigen::SparseMatrix<S>(K) + transposed);
    h.coarsest.emplace(slant::factorize(symmetric));
  }

  static void require_positive_diagonal(sparse_type const& K, std::size_t depth, S const& unit) {
    vector_type const d = K.diagonal() / unit;
    for (index i = 0; i < d.size(); ++i) {
      if (d[i] > S(0)) continue;
      throw bad_input("K",
                      "diagonal entry " + detail::show(i) + " = " + detail::show(d[i]) +
                          " on level " + detail::show(static_cast<index>(depth)),
                      "a symmetric positive definite matrix");
    }
  }

  template <class X, class Y, class Held>
  void run(X const& x, Y& y, workspace_type& w, Held held) const {
    if (rows_ == 0) return;
    w.levels.front().b = slant::local(x);
    cycle(0, w, held);
    slant::local(y) = levels_->unit * w.levels.front().x;
  }

  template <class Held>
  void cycle(std::size_t depth, workspace_type& w, Held held) const {
    auto& here = w.levels[depth];
    if (depth == levels_->smooth.size()) {
      slant::apply(levels_->inverse(), here.b, here.x, *w.factor);
      for (index i = 0; i < here.x.size(); ++i) {
        if (held(i)) here.x[i] = S(0);
      }
      return;
    }
    auto const& level = levels_->smooth[depth];
    auto& below = w.levels[depth + 1];
    level.sweep.forwards_from_zero(here.b, here.x, here.r, held);
    for (index i = 1; i < sweeps_; ++i) level.sweep.forwards(here.b, here.x, held);
    if (sweeps_ > 1) level.sweep.residual(here.b, here.x, here.r, held);
    below.b.noalias() = level.P.transpose() * here.r;
    cycle(depth + 1, w, detail::nothing_held{});
    here.r.noalias() = level.P * below.x;
    for (index i = 0; i < here.x.size(); ++i) {
      if (!held(i)) here.x[i] += here.r[i];
    }
    for (index i = 0; i < sweeps_; ++i) level.sweep.backwards(here.b, here.x, held);
  }

  std::shared_ptr<hierarchy> levels_;
  index rows_ = 0;
  index sweeps_;
};

template <class M>
multigrid(Eigen::SparseMatrixBase<M> const&, multigrid_options const& = {})
    -> multigrid<typename M::Scalar>;
template <class M, class B>
multigrid(Eigen::SparseMatrixBase<M> const&, B const&, multigrid_options const& = {})
    -> multigrid<typename M::Scalar>;

}  // namespace slant
