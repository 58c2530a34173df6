// SPDX-License-Identifier: MIT
//
// What solves by CHOLMOD need: its state and the vectors that it allocates.
#pragma once

#if defined(SLANT_HAS_CHOLMOD) && SLANT_HAS_CHOLMOD

#include <slant/factorizations/detail/cholmod_handles.hpp>

#include <Eigen/Core>

#include <cstddef>
#include <memory>
#include <new>
#include <utility>

namespace slant::detail {

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
    solution_ = room_like(other.solution_);
    y_ = room_like(other.y_);
    e_ = room_like(other.e_);
  }
  cholmod_workspace(cholmod_workspace&& other) noexcept
      : state_(std::move(other.state_)),
        right_(std::move(other.right_)),
        solution_(std::exchange(other.solution_, nullptr)),
        y_(std::exchange(other.y_, nullptr)),
        e_(std::exchange(other.e_, nullptr)) {}
  cholmod_workspace& operator=(cholmod_workspace other) noexcept {
    std::swap(state_, other.state_);
    right_.swap(other.right_);
    std::swap(solution_, other.solution_);
    std::swap(y_, other.y_);
    std::swap(e_, other.e_);
    return *this;
  }
  ~cholmod_workspace() {
    if (state_ == nullptr) return;
    for (cholmod_dense** vectors : {&solution_, &y_, &e_}) {
      cholmod_free_dense(vectors, state_->get());
    }
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
    // A simplicial solve works on up to four right-hand sides at a time and leaves y_ with the size
    // of the last few; the next one would allocate it anew.
    if (y_ != nullptr && factors.get()->is_super == 0) {
      y_->nrow = y_->d = y_->nzmax / b.nrow;
      y_->ncol = b.nrow;
    }
    if (cholmod_solve2(CHOLMOD_A, factors.get(), &b, nullptr, &solution_, nullptr, &y_, &e_,
                       state_->get()) == 0) {
      throw std::bad_alloc();
    }
    return {static_cast<double const*>(solution_->x), right_.rows(), right_.cols()};
  }

 private:
  cholmod_workspace() : state_(std::make_unique<cholmod_state>()) {}

  /// A matrix of the same width that can hold as many numbers; null for null.
  [[nodiscard]] cholmod_dense* room_like(cholmod_dense const* vectors) {
    if (vectors == nullptr) return nullptr;
    std::size_t const width = vectors->ncol;
    std::size_t const height = width > 0 ? vectors->nzmax / width : 0;
    cholmod_dense* room =
        cholmod_allocate_dense(height, width, height, CHOLMOD_REAL, state_->get());
    if (room == nullptr) throw std::bad_alloc();
    return room;
  }

  std::unique_ptr<cholmod_state> state_;
  Eigen::MatrixXd right_;
  cholmod_dense* solution_ = nullptr;
  cholmod_dense* y_ = nullptr;
  cholmod_dense* e_ = nullptr;
};

}  // namespace slant::detail

#endif
