// SPDX-License-Identifier: MIT
//
// Orderings by CHOLMOD and what they would cost, without any number being computed.
#pragma once

#if defined(SLANT_HAS_CHOLMOD) && SLANT_HAS_CHOLMOD

#include <slant/factorizations/condensation_options.hpp>
#include <slant/factorizations/detail/cholmod_handles.hpp>
#include <slant/factorizations/detail/contact_ordering.hpp>

#include <cstddef>
#include <new>
#include <utility>
#include <vector>

namespace slant::detail {

/// Ordering of a symmetric matrix, its elimination tree and the lengths of the columns of its
/// factor.
class cholmod_ordering {
 public:
  /// Nested dissection (METIS) where CHOLMOD has it, else minimum degree; postordered.
  explicit cholmod_ordering(cholmod_sparse& matrix) : cholmod_ordering(matrix.nrow) {
    cholmod_state state;
    state.get()->supernodal = CHOLMOD_SIMPLICIAL;  // enough for an ordering
    state.get()->nmethods = 1;
    state.get()->method[0].ordering = CHOLMOD_METIS;
    cholmod_factor* found = cholmod_analyze(&matrix, state.get());
    if (found == nullptr) {
      state.get()->method[0].ordering = CHOLMOD_AMD;
      found = cholmod_analyze(&matrix, state.get());
    }
    if (found == nullptr) throw std::bad_alloc();
    auto const* permutation = static_cast<int const*>(found->Perm);
    order_.assign(permutation, permutation + found->n);
    cholmod_free_factor(&found, state.get());
    analyze(matrix, state);
  }
  /// This ordering (position → unknown).
  cholmod_ordering(cholmod_sparse& matrix, std::vector<int> order) : cholmod_ordering(matrix.nrow) {
    order_ = std::move(order);
    cholmod_state state;
    analyze(matrix, state);
  }

  [[nodiscard]] std::vector<int> const& order() const noexcept { return order_; }
  [[nodiscard]] std::vector<int> const& parent() const noexcept { return parent_; }

  /// What factoring costs, and applications from marked unknowns to marked ones, if each vertex of
  /// the graph stands for so many unknowns. contact: the unknowns of the marked vertices that are
  /// meant.
  [[nodiscard]] condensation_plan plan(index levels, std::vector<char> const& marked, double weight,
                                       double contact) const {
    condensation_plan p;
    p.levels = levels;
    p.contact = contact;
    double vertices = 0, skipped = 0;  // marked ones; entries before them
    p.stored = upper_halves(weight);
    std::vector<char> reached(order_.size(), 0);
    for (std::size_t j = 0; j < order_.size(); ++j) {
      double const rows = weight * length_[j];  // of the first of its columns
      double const entries = weight * (rows - (weight - 1) / 2);
      p.flops += weight * (rows - (weight - 1) / 2) * (rows - (weight - 1) / 2);
      p.entries += entries;
      p.stored += entries;
      if (marked[static_cast<std::size_t>(order_[j])] != 0) {
        reached[j] = 1;
        vertices += 1;
        skipped += p.tail_entries;
      }
      if (reached[j] == 0) continue;
      p.tail += weight;
      p.tail_entries += entries;
      if (parent_[j] >= 0) reached[static_cast<std::size_t>(parent_[j])] = 1;
    }
    if (vertices > 0) p.forming = 4 * contact * (p.tail_entries - skipped / vertices);
    return p;
  }

 private:
  explicit cholmod_ordering(std::size_t n) : order_(n), parent_(n), length_(n) {}

  /// Entries above the diagonals of supernodes, which are stored as full matrices: chains of
  /// columns each of which has the rows of the one before.
  [[nodiscard]] double upper_halves(double weight) const {
    std::vector<int> children(order_.size(), 0), chain(order_.size(), 1);
    for (int const p : parent_) {
      if (p >= 0) ++children[static_cast<std::size_t>(p)];
    }
    double sum = 0;
    for (std::size_t j = 0; j < order_.size(); ++j) {
      auto const p = static_cast<std::size_t>(parent_[j]);
      if (parent_[j] >= 0 && children[p] == 1 && length_[p] + 1 == length_[j]) {
        chain[p] = chain[j] + 1;
      } else {
        double const columns = weight * chain[j];
        sum += columns * (columns - 1) / 2;
      }
    }
    return sum;
  }

  void analyze(cholmod_sparse& matrix, cholmod_state& state) {
    std::size_t const n = order_.size();
    std::vector<int> post(n), first(n), level(n);
    if (cholmod_analyze_ordering(&matrix, CHOLMOD_GIVEN, order_.data(), nullptr, 0, parent_.data(),
                                 post.data(), length_.data(), first.data(), level.data(),
                                 state.get()) == 0) {
      throw std::bad_alloc();
    }
  }

  std::vector<int> order_;   // position → unknown
  std::vector<int> parent_;  // of each column, −1 for roots
  std::vector<int> length_;  // entries of each column of L, its diagonal included
};

}  // namespace slant::detail

#endif
