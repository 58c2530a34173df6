// SPDX-License-Identifier: MIT
//
// Multigrid by smoothed aggregation [Vaněk, Mandel, Brezina 1996]: an operator M ≈ K⁻¹ for a sparse
// symmetric positive definite K, of the cost of a few products by K and with a condition number of
// M K that hardly depends on the mesh.
//
//     cycle(b):   x ← forwards sweep of Gauss–Seidel from 0
//                 x ← x + P cycle(Pᵀ(b − K x))          K_coarse = PᵀK P, the last one factored
//                 x ← backwards sweep
//
// What sweeps do not reach is the near kernel of K: constants of a Laplacian, rigid-body modes in
// elasticity. It is given by candidates, which the coarse levels represent exactly.
//
// Faces. With some unknowns held at zero the same hierarchy serves the matrix K_FF of the others:
// the sweeps pass over what is held and the coarse correction leaves it out. Such a cycle is the
// sum of the symmetrised sweep, definite on the face, and of a semidefinite term, so it is definite
// for every face, and nothing is set up anew when the face changes.
#pragma once

#include <slant/base/matrix_entries.hpp>
#include <slant/base/scaling.hpp>
#include <slant/concepts/bad_input.hpp>
#include <slant/concepts/factorization.hpp>
#include <slant/concepts/laws.hpp>
#include <slant/concepts/scalar.hpp>
#include <slant/factorizations/factorize.hpp>
#include <slant/multilevel/aggregation.hpp>
#include <slant/operators/inverse.hpp>

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include <concepts>
#include <cstddef>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace slant {

// --- options -------------------------------------------------------------------------------------

/// Options of multigrid.
struct multigrid_options {
  index block_size = 0;  ///< unknowns of a node, consecutive; 0: from the pattern of K, 1 to 3
  double strength = 0.04;  ///< θ in [0, 1): nodes i, j are neighbours if ‖K_ij‖² > θ² ‖K_ii‖ ‖K_jj‖
  double damping = 4.0 / 3;  ///< ω λ_max(D⁻¹K) in (0, 2): the smoothing of the prolongation
  index sweeps = 1;          ///< of Gauss–Seidel before and after each coarse correction, >= 1
  index coarsest = 600;      ///< a level with so few unknowns is factored, >= 1
  index levels = 20;         ///< at most so many, >= 1

  /// Throws bad_input naming the option, its value and what was expected.
  [[gnu::cold]] void validate() const {
    using detail::show;
    if (block_size < 0) throw bad_input("block_size", show(block_size), "a number >= 0");
    if (!(strength >= 0 && strength < 1)) {
      throw bad_input("strength", show(strength), "a number in [0, 1)");
    }
    if (!(damping > 0 && damping < 2)) {
      throw bad_input("damping", show(damping), "a number in (0, 2)");
    }
    if (sweeps < 1) throw bad_input("sweeps", show(sweeps), "at least 1");
    if (coarsest < 1) throw bad_input("coarsest", show(coarsest), "at least 1");
    if (levels < 1) throw bad_input("levels", show(levels), "at least 1");
  }
};

}  // namespace slant

namespace slant::detail {

// --- gauss seidel --------------------------------------------------------------------------------
//
// Sweeps of Gauss–Seidel over a symmetric matrix, perhaps with unknowns that are held at zero:
// those are passed over, which is the sweep over the principal submatrix of the others.
//
// Why Gauss–Seidel: forwards before and backwards after the coarse correction makes the cycle
// self-adjoint and definite for every definite matrix, whatever is held. No bound of a spectrum is
// needed that would have to be right.

/// Nothing is held.
struct nothing_held {
  constexpr bool operator()(index) const { return false; }
};

/// Unknown i is held if entry i of a list is not zero.
struct held_where {
  unsigned char const* entries;
  bool operator()(index i) const { return entries[i] != 0; }
};

/// A symmetric matrix, prepared for sweeps. Rows are compressed, their entries sorted.
template <class S>
class gauss_seidel {
 public:
  using matrix_type = Eigen::SparseMatrix<S, Eigen::RowMajor>;

  gauss_seidel() = default;
  /// The diagonal of K must be positive.
  explicit gauss_seidel(matrix_type k) : k_(std::move(k)), inverse_(k_.rows()) {
    k_.makeCompressed();
    diagonal_.resize(static_cast<std::size_t>(k_.rows()));
    for (index i = 0; i < k_.rows(); ++i) {
      int e = k_.outerIndexPtr()[i];
      while (k_.innerIndexPtr()[e] != i) ++e;
      diagonal_[static_cast<std::size_t>(i)] = e;
      inverse_[i] = S(1) / k_.valuePtr()[e];
    }
  }

  [[nodiscard]] matrix_type const& matrix() const { return k_; }

  /// x = (D + L)⁻¹ b and r = b − K x = −Lᵀx: together they cost one product.
  template <class V, class Held>
  void forwards_from_zero(V const& b, V& x, V& r, Held held) const {
    for (index i = 0; i < k_.rows(); ++i) {
      x[i] = held(i) ? S(0) : S((b[i] - row(begin(i), middle(i), x)) * inverse_[i]);
    }
    for (index i = 0; i < k_.rows(); ++i) {
      r[i] = held(i) ? S(0) : S(-row(middle(i) + 1, end(i), x));
    }
  }
  /// r = b − K x, 0 where x is held.
  template <class V, class Held>
  void residual(V const& b, V const& x, V& r, Held held) const {
    for (index i = 0; i < k_.rows(); ++i) {
      r[i] = held(i) ? S(0) : S(b[i] - row(begin(i), end(i), x));
    }
  }
  template <class V, class Held>
  void forwards(V const& b, V& x, Held held) const {
    for (index i = 0; i < k_.rows(); ++i) relax(i, b, x, held);
  }
  template <class V, class Held>
  void backwards(V const& b, V& x, Held held) const {
    for (index i = k_.rows() - 1; i >= 0; --i) relax(i, b, x, held);
  }

 private:
  [[nodiscard]] int begin(index i) const { return k_.outerIndexPtr()[i]; }
  [[nodiscard]] int end(index i) const { return k_.outerIndexPtr()[i + 1]; }
  [[nodiscard]] int middle(index i) const { return diagonal_[static_cast<std::size_t>(i)]; }

  /// Σ K_ij x_j over entries [from, to); four sums that do not wait for each other.
  template <class V>
  [[nodiscard]] S row(int from, int to, V const& x) const {
    S const* const values = k_.valuePtr();
    int const* const columns = k_.innerIndexPtr();
    S a(0), b(0), c(0), d(0);
    int e = from;
    for (; e + 3 < to; e += 4) {
      a += values[e] * x[columns[e]];
      b += values[e + 1] * x[columns[e + 1]];
      c += values[e + 2] * x[columns[e + 2]];
      d += values[e + 3] * x[columns[e + 3]];
    }
    for (; e < to; ++e) a += values[e] * x[columns[e]];
    return (a + b) + (c + d);
  }
  template <class V, class Held>
  void relax(index i, V const& b, V& x, Held held) const {
    if (held(i)) return;
    x[i] += (b[i] - row(begin(i), end(i), x)) * inverse_[i];
  }

  matrix_type k_;
  Eigen::Matrix<S, Eigen::Dynamic, 1> inverse_;
  std::vector<int> diagonal_;  // where the entry K_ii is stored
};

}  // namespace slant::detail

namespace slant {

// --- multigrid -----------------------------------------------------------------------------------

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
