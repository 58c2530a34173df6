// SPDX-License-Identifier: MIT
//
// Owners of what CHOLMOD allocates: its state and the factors.
#pragma once

#if defined(SLANT_HAS_CHOLMOD) && SLANT_HAS_CHOLMOD

#include <slant/concepts/scalar.hpp>
#include <slant/factorizations/detail/large_pages.hpp>

#include <Eigen/SparseCore>

#if __has_include(<cholmod.h>)
#include <cholmod.h>
#else
#include <suitesparse/cholmod.h>
#endif

#include <algorithm>
#include <new>
#include <type_traits>
#include <vector>

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
  template <class F>
  void for_each_supernode(F f) const {
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
  template <class F>
  void for_each_pivot(F f) const {
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

}  // namespace slant::detail

#endif
