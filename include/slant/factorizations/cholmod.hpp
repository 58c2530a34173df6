// SPDX-License-Identifier: MIT
//
// Sparse Cholesky by CHOLMOD of SuiteSparse, for symmetric positive definite matrices of doubles:
// supernodal LLᵀ where that pays, else LDLᵀ. On large meshes in 3D it is many times faster than
// ldlt. Exists only where SLANT_HAS_CHOLMOD is defined to 1 (the CMake target slant::cholmod does
// it).
//
// As in ldlt.hpp, K / 2^e is factored: exact, and necessary, because the square roots of LLᵀ would
// make the last bits depend on the units.
#pragma once

#if defined(SLANT_HAS_CHOLMOD) && SLANT_HAS_CHOLMOD

#include <slant/base/long_arrays.hpp>
#include <slant/base/matrix_entries.hpp>
#include <slant/concepts/factorization.hpp>
#include <slant/concepts/scalar.hpp>
#include <slant/factorizations/parts/panel_kernels.hpp>

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include <algorithm>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <memory>
#include <new>
#include <string_view>
#include <vector>

#if __has_include(<cholmod.h>)
#include <cholmod.h>
#else
#include <suitesparse/cholmod.h>
#endif

namespace slant::detail {

/// CHOLMOD's settings, statistics and scratch memory. Silent: failures are reported by us.
class cholmod_state {
 public:
  cholmod_state() {
    cholmod_start(&common_);
    common_.print = 0;
    common_.error_handler = nullptr;
  }
  cholmod_state(cholmod_state const&) = delete;
  cholmod_state& operator=(cholmod_state const&) = delete;
  ~cholmod_state() { cholmod_finish(&common_); }

  [[nodiscard]] cholmod_common* get() noexcept { return &common_; }
  [[nodiscard]] int status() const noexcept { return common_.status; }

 private:
  cholmod_common common_;
};

/// A compressed symmetric Eigen matrix as CHOLMOD sees it (lower triangle); nothing is copied.
[[nodiscard]] inline cholmod_sparse cholmod_view(Eigen::SparseMatrix<double> const& m) {
  cholmod_sparse view{};
  view.nrow = static_cast<std::size_t>(m.rows());
  view.ncol = static_cast<std::size_t>(m.cols());
  view.nzmax = static_cast<std::size_t>(m.nonZeros());
  view.p = const_cast<int*>(m.outerIndexPtr());  // CHOLMOD does not write to its input
  view.i = const_cast<int*>(m.innerIndexPtr());
  view.x = const_cast<double*>(m.valuePtr());
  if (view.nzmax == 0) view.i = view.x = view.p;  // null is an error, even where nothing is read
  view.stype = -1;
  view.itype = CHOLMOD_INT;
  view.xtype = CHOLMOD_REAL;
  view.dtype = CHOLMOD_DOUBLE;
  view.sorted = 1;
  view.packed = 1;
  return view;
}

/// The factors of a symmetric matrix, LLᵀ or LDLᵀ; failed_column() says whether they are complete.
class cholmod_factors {
 public:
  explicit cholmod_factors(cholmod_sparse& matrix) {
    factor_ = cholmod_analyze(&matrix, state_.get());
    factorize(matrix);
  }
  /// The same for a given ordering (position → unknown); always supernodal if `supernodal`.
  cholmod_factors(cholmod_sparse& matrix, std::vector<int> order, bool supernodal) {
    cholmod_common& settings = *state_.get();
    settings.nmethods = 1;
    settings.method[0].ordering = CHOLMOD_GIVEN;
    if (supernodal) {
      settings.supernodal = CHOLMOD_SUPERNODAL;
      // CHOLMOD merges large supernodes if that adds few zeros; it does not count the upper halves
      // of what it stores as squares, a fifth of all memory when contact unknowns come late.
      settings.zrelax[2] = 0;
    }
    factor_ = cholmod_analyze_p(&matrix, order.data(), nullptr, 0, state_.get());
    factorize(matrix);
  }
  cholmod_factors(cholmod_factors const&) = delete;
  cholmod_factors& operator=(cholmod_factors const&) = delete;
  ~cholmod_factors() { cholmod_free_factor(&factor_, state_.get()); }

  [[nodiscard]] cholmod_factor* get() const noexcept { return factor_; }
  [[nodiscard]] index size() const noexcept { return static_cast<index>(factor_->n); }
  /// The first column without a positive (supernodal) or nonzero (simplicial) pivot, else size().
  [[nodiscard]] index failed_column() const noexcept { return static_cast<index>(factor_->minor); }
  [[nodiscard]] index original_row(index i) const noexcept { return numbers(factor_->Perm)[i]; }
  /// Entries of L that are stored.
  [[nodiscard]] double entries() const noexcept {
    return static_cast<double>(factor_->is_super != 0 ? factor_->xsize : factor_->nzmax);
  }
  /// The ordering, position → unknown.
  [[nodiscard]] std::vector<int> order() const {
    return {numbers(factor_->Perm), numbers(factor_->Perm) + size()};
  }

  /// Neighbouring columns that share their rows, stored as one dense matrix.
  struct supernode {
    index first;    ///< number of its first column
    index columns;  ///< number of columns
    index height;   ///< number of rows
    int const* rows;
    double const* entries;  ///< height × columns
  };
  /// f(supernode) for all of them in order of elimination; only for supernodal factors.
  void for_each_supernode(auto f) const {
    int const* begin = numbers(factor_->super);
    int const* rows = numbers(factor_->pi);
    int const* entries = numbers(factor_->px);
    for (index s = 0; s < static_cast<index>(factor_->nsuper); ++s) {
      f(supernode{begin[s], begin[s + 1] - begin[s], rows[s + 1] - rows[s],
                  numbers(factor_->s) + rows[s],
                  static_cast<double const*>(factor_->x) + entries[s]});
    }
  }

  /// f(column, pivot) for all columns before the failed one.
  void for_each_pivot(auto f) const {
    auto const visit = [&](index i, double stored) {
      if (i < failed_column()) f(i, factor_->is_ll != 0 ? stored * stored : stored);
    };
    auto const* x = static_cast<double const*>(factor_->x);
    if (factor_->is_super == 0) {
      for (index i = 0; i < size(); ++i) visit(i, x[numbers(factor_->p)[i]]);
    } else {
      for_each_supernode([&](supernode const& s) {
        for (index j = 0; j < s.columns; ++j) visit(s.first + j, s.entries[j * s.height + j]);
      });
    }
  }

  /// The pivot of the failed column, K_ii − Σ ℓ_ij². Supernodal factors do not store it.
  [[nodiscard]] double failed_pivot(double diagonal_entry) const {
    index const i = failed_column();
    if (factor_->is_super == 0) {
      return static_cast<double const*>(factor_->x)[numbers(factor_->p)[i]];
    }
    double pivot = diagonal_entry;
    for_each_supernode([&](supernode const& s) {
      auto const* place = std::lower_bound(s.rows, s.rows + s.height, i);
      if (place == s.rows + s.height || *place != i) return;
      for (index j = 0; j < s.columns && s.first + j < i; ++j) {
        double const entry = s.entries[j * s.height + (place - s.rows)];
        pivot -= entry * entry;
      }
    });
    return pivot;
  }

 private:
  static int const* numbers(void const* p) noexcept { return static_cast<int const*>(p); }

  void factorize(cholmod_sparse& matrix) {
    if (factor_ != nullptr) {
      make_room();
      cholmod_factorize(&matrix, factor_, state_.get());
    }
    // Being indefinite is a warning of CHOLMOD; what is negative is an error.
    if (factor_ == nullptr || state_.status() < CHOLMOD_OK) {
      cholmod_free_factor(&factor_, state_.get());
      throw std::bad_alloc();
    }
  }

  /// Memory for the entries before CHOLMOD writes to it: in large pages, if there are many.
  void make_room() {
    if (factor_->is_super == 0) return;
    if (cholmod_change_factor(CHOLMOD_REAL, 1, 1, 1, 1, factor_, state_.get()) == 0) return;
    prefer_large_pages(static_cast<double*>(factor_->x), static_cast<index>(factor_->xsize));
  }

  cholmod_state state_;
  cholmod_factor* factor_ = nullptr;
};

/// State and vectors of the solves of one thread, for a fixed number of right-hand sides. What it
/// holds between two solves is scratch: a copy is as much room, and as ready for a solve.
class cholmod_workspace {
 public:
  /// For solves with these factors; null for an empty matrix, with which nothing is solved. A warm
  /// one allocates nothing later on.
  cholmod_workspace(cholmod_factors const* factors, index columns, bool warm = true)
      : cholmod_workspace() {
    if (factors == nullptr) return;
    right_.setZero(factors->size(), columns);
    // The first solve lets CHOLMOD allocate all it needs; later ones reuse it.
    if (warm) (void)solve(*factors);
  }
  cholmod_workspace(cholmod_workspace const& other) : cholmod_workspace() {
    right_.setZero(other.right_.rows(), other.right_.cols());
    if (!other.room_) return;  // it has been moved from
    for (auto const vectors : {&room::solution, &room::y, &room::e}) {
      room_.get()->*vectors = room_like(other.room_.get()->*vectors);
    }
  }
  cholmod_workspace(cholmod_workspace&&) noexcept = default;
  cholmod_workspace& operator=(cholmod_workspace other) noexcept {
    room_.swap(other.room_);
    right_.swap(other.right_);
    return *this;
  }

  /// Where the right-hand sides belong.
  [[nodiscard]] Eigen::MatrixXd& right_hand_side() noexcept { return right_; }

  /// The solutions, valid until the next solve. Throws std::bad_alloc if memory runs out.
  [[nodiscard]] Eigen::Map<Eigen::MatrixXd const> solve(cholmod_factors const& factors) {
    cholmod_dense b{};
    b.nrow = b.d = static_cast<std::size_t>(right_.rows());
    b.ncol = static_cast<std::size_t>(right_.cols());
    b.nzmax = b.nrow * b.ncol;
    b.x = right_.data();
    b.xtype = CHOLMOD_REAL;
    b.dtype = CHOLMOD_DOUBLE;
    // A simplicial solve works on up to four right-hand sides at a time and leaves y with the size
    // of the last few; the next one would allocate it anew.
    auto& [solution, y, e, state] = *room_;
    if (y != nullptr && factors.get()->is_super == 0) {
      y->nrow = y->d = y->nzmax / b.nrow;
      y->ncol = b.nrow;
    }
    if (cholmod_solve2(CHOLMOD_A, factors.get(), &b, nullptr, &solution, nullptr, &y, &e,
                       state.get()) == 0) {
      throw std::bad_alloc();
    }
    return {static_cast<double const*>(solution->x), right_.rows(), right_.cols()};
  }

 private:
  struct room {
    cholmod_dense* solution = nullptr;
    cholmod_dense* y = nullptr;
    cholmod_dense* e = nullptr;
    cholmod_state state{};

    ~room() {
      for (cholmod_dense** vectors : {&solution, &y, &e}) cholmod_free_dense(vectors, state.get());
    }
  };

  cholmod_workspace() : room_(std::make_unique<room>()) {}

  /// A matrix of the same width that can hold as many numbers; null for null.
  [[nodiscard]] cholmod_dense* room_like(cholmod_dense const* vectors) {
    if (vectors == nullptr) return nullptr;
    std::size_t const width = vectors->ncol;
    std::size_t const height = width > 0 ? vectors->nzmax / width : 0;
    cholmod_dense* const copy =
        cholmod_allocate_dense(height, width, height, CHOLMOD_REAL, room_->state.get());
    if (copy == nullptr) throw std::bad_alloc();
    return copy;
  }

  std::unique_ptr<room> room_;
  Eigen::MatrixXd right_;
};

}  // namespace slant::detail

namespace slant {

/// P K Pᵀ = 2^e L Lᵀ. Copies share the factors, which never change.
class cholmod {
 public:
  using scalar = double;
  using matrix_type = Eigen::SparseMatrix<double>;
  static constexpr law_set laws = slant::laws<slant::self_adjoint, slant::positive_definite>;

  /// Throws bad_input if K is not square, has an entry that is NaN or infinite, is not symmetric
  /// (up to 1024 ε, naming the worst pair), or not definite (naming the pivot).
  template <class M>
    requires std::same_as<typename M::Scalar, double>
  explicit cholmod(Eigen::SparseMatrixBase<M> const& k) {
    factor(k, [](cholmod_sparse& view) { return std::make_shared<factors>(view); });
  }
  /// The same with the unknowns eliminated in this order (position → unknown), or one that CHOLMOD
  /// finds better for memory without more fill; always supernodal. Throws bad_input also if order
  /// is not a permutation of 0 … rows − 1.
  template <class M>
    requires std::same_as<typename M::Scalar, double>
  cholmod(Eigen::SparseMatrixBase<M> const& k, std::vector<int> const& order) {
    detail::check_permutation("order", order, k.rows());
    factor(k,
           [&order](cholmod_sparse& view) { return std::make_shared<factors>(view, order, true); });
  }
  /// The factorisation of another matrix of the same size, with the ordering of this one: what
  /// takes longest to find is reused when only values have changed. Throws bad_input as the
  /// constructor.
  template <class M>
    requires std::same_as<typename M::Scalar, double>
  [[nodiscard]] cholmod refactorized(Eigen::SparseMatrixBase<M> const& k) const {
    slant::detail::check_size("rows of K", index(k.rows()), rows_, "as before,");
    cholmod result;
    result.factor(k, [this](cholmod_sparse& view) {
      return std::make_shared<factors>(view, factors_->order(), supernodal());
    });
    return result;
  }

  [[nodiscard]] index rows() const { return rows_; }
  /// What computes: "cholmod".
  [[nodiscard]] std::string_view name() const noexcept { return "cholmod"; }
  /// Whether dense blocks (supernodes) are used.
  [[nodiscard]] bool supernodal() const noexcept {
    return rows_ > 0 && factors_->get()->is_super != 0;
  }
  /// Entries of L.
  [[nodiscard]] double entries() const noexcept { return rows_ > 0 ? factors_->entries() : 0; }
  /// The power of two u with P K Pᵀ = L Lᵀ / u.
  [[nodiscard]] double unit() const noexcept { return unit_; }
  /// L itself, for those who know CHOLMOD; null for the empty matrix.
  [[nodiscard]] std::shared_ptr<detail::cholmod_factors const> const& handle() const noexcept {
    return factors_;
  }

  /// All that a solve needs: CHOLMOD's own state and vectors. One for each thread.
  [[nodiscard]] detail::cholmod_workspace workspace(has_scalar<double> auto const& b) const {
    return detail::cholmod_workspace(factors_.get(), slant::local(b).cols());
  }
  /// x = K⁻¹ b for as many right-hand sides as w was made for. Throws bad_input if b or x has not
  /// rows() rows.
  void solve(has_scalar<double> auto const& b, auto& x, detail::cholmod_workspace& w) const {
    detail::check_solve(rows(), b, x);
    if (rows_ == 0) return;
    w.right_hand_side() = slant::local(b);
    slant::local(x).noalias() = unit_ * w.solve(*factors_);
  }
  /// The same once, for those who will not solve again.
  void solve(has_scalar<double> auto const& b, auto& x) const {
    detail::cholmod_workspace w(factors_.get(), slant::local(b).cols(), false);
    solve(b, x, w);
  }

 private:
  using factors = detail::cholmod_factors;

  cholmod() = default;

  /// make(view) factors the matrix; nothing is kept if it throws.
  template <class M, class Make>
  void factor(Eigen::SparseMatrixBase<M> const& matrix, Make make) {
    matrix_type k = matrix.derived();
    detail::require_symmetric_matrix("K", k);
    int const exponent = detail::scale_exponent(k);
    unit_ = detail::power_of_two<double>(-exponent);
    k *= unit_;
    k.makeCompressed();
    rows_ = k.rows();
    if (rows_ == 0) return;
    cholmod_sparse view = detail::cholmod_view(k);
    std::shared_ptr<factors> const made = make(view);
    Eigen::VectorXd const diagonal = k.diagonal();
    auto const require = [&](index i, double pivot) {
      index const row = made->original_row(i);
      detail::require_positive_pivot("K", rows_, i, row, pivot, diagonal[row], exponent);
    };
    made->for_each_pivot(require);
    if (index const i = made->failed_column(); i < rows_) {
      index const row = made->original_row(i);
      double const pivot = made->failed_pivot(diagonal[row]);
      require(i, pivot);
      detail::refuse_pivot("K", i, row, std::ldexp(pivot, exponent), true);
    }
    factors_ = made;
  }

  double unit_ = 1;
  index rows_ = 0;
  std::shared_ptr<detail::cholmod_factors const> factors_;  // null for the empty matrix
};

}  // namespace slant

#endif
