// SPDX-License-Identifier: MIT
//
// A diagonal matrix in which some small groups of components are coupled: symmetric blocks of a few
// rows each, anywhere in the vector. What a product of small convex sets contributes to a Hessian
// looks like this, and so does the inverse of its sum with a diagonal matrix.
#pragma once

#include <slant/concepts/laws.hpp>
#include <slant/concepts/vector.hpp>

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

namespace slant {

/// Self-adjoint; L are the further laws that whoever assigns the entries promises.
template <scalar S, law_set L = law_set{}>
class small_blocks {
 public:
  using scalar = S;
  static constexpr law_set laws = L | slant::laws<slant::self_adjoint>;

  /// n components, no blocks, zero.
  explicit small_blocks(index n) : diagonal_(Eigen::Matrix<S, Eigen::Dynamic, 1>::Zero(n)) {}

  [[nodiscard]] index rows() const noexcept { return diagonal_.size(); }
  [[nodiscard]] index cols() const noexcept { return diagonal_.size(); }
  [[nodiscard]] index block_count() const noexcept { return static_cast<index>(blocks_.size()); }

  /// A further block, of the components first, first + stride, …, which no other block has. Zero.
  void append(index size, index first, index stride) {
    blocks_.push_back({entries_.size(), size, first, stride});
    entries_.resize(entries_.size() + static_cast<std::size_t>(size * size), S(0));
  }
  /// The entries of block i, in the order of append, symmetric; to be written. N: its size, where
  /// it is known.
  template <int N = Eigen::Dynamic>
  [[nodiscard]] auto block(index i) {
    auto const& b = blocks_[static_cast<std::size_t>(i)];
    return Eigen::Map<Eigen::Matrix<S, N, N>>(entries_.data() + b.entry, b.size, b.size);
  }
  /// The entries of the diagonal outside the blocks become those of d.
  void assign_outside(auto const& d) {
    diagonal_ = slant::local(d);
    for (auto const& b : blocks_) {
      for (index i = 0; i < b.size; ++i) diagonal_.coeffRef(b.first + i * b.stride) = S(0);
    }
  }

  /// y = B x; several columns at once are fine.
  void apply(auto const& x, auto& y) const {
    auto const& from = slant::local(x);
    auto& to = slant::local(y);
    for (index c = 0; c < index(from.cols()); ++c) {
      to.col(c) = diagonal_.cwiseProduct(from.col(c));
      for_each(from.col(c), [&](index j, S const& sum) { to.coeffRef(j, c) = sum; });
    }
  }
  /// y ← y + α B x.
  void apply_add(S const& α, auto const& x, auto& y) const {
    auto const& from = slant::local(x);
    auto& to = slant::local(y);
    for (index c = 0; c < index(from.cols()); ++c) {
      to.col(c) += α * diagonal_.cwiseProduct(from.col(c));
      for_each(from.col(c), [&](index j, S const& sum) { to.coeffRef(j, c) += α * sum; });
    }
  }
  /// d = diag(B).
  void diagonal(auto& d) const {
    auto& to = slant::local(d);
    to = diagonal_;
    for (auto const& b : blocks_) {
      for (index i = 0; i < b.size; ++i) {
        to.coeffRef(b.first + i * b.stride) =
            entries_[b.entry + static_cast<std::size_t>(i * (b.size + 1))];
      }
    }
  }

 private:
  struct block_place {
    std::size_t entry;
    index size;
    index first;
    index stride;
  };

  /// f(component, (B x) there) for every component of a block.
  void for_each(auto const& x, auto const& f) const {
    for (auto const& b : blocks_) {
      S const* const m = entries_.data() + b.entry;
      if (b.size == 1) {
        f(b.first, m[0] * x.coeff(b.first));
      } else if (b.size == 2) {
        S const u = x.coeff(b.first), v = x.coeff(b.first + b.stride);
        f(b.first, m[0] * u + m[2] * v);
        f(b.first + b.stride, m[1] * u + m[3] * v);
      } else {
        for (index i = 0; i < b.size; ++i) {
          S sum(0);
          for (index j = 0; j < b.size; ++j) {
            sum += m[j * b.size + i] * x.coeff(b.first + j * b.stride);
          }
          f(b.first + i * b.stride, sum);
        }
      }
    }
  }

  Eigen::Matrix<S, Eigen::Dynamic, 1> diagonal_;
  std::vector<block_place> blocks_;
  std::vector<S> entries_;
};

}  // namespace slant

namespace slant::detail {

// --- definite inverse ----------------------------------------------------------------------------
//
// The inverse of a small positive definite matrix by P A Pᵀ = L D Lᵀ, the largest entry left on the
// diagonal first: the steps of Eigen's LDLT, which has all its types anew for every size.

/// A⁻¹ of a symmetric A, of which the lower triangle is read. A direction in which A is zero has a
/// zero in the inverse. Does not allocate.
template <class S, int N>
[[nodiscard]] Eigen::Matrix<S, N, N> definite_inverse(Eigen::Matrix<S, N, N> const& A) {
  std::array<std::array<S, N>, N> a;  // the lower triangle; L below the diagonal of D in the end
  std::array<std::size_t, N> order;
  for (std::size_t i = 0; i < N; ++i) {
    order[i] = i;
    for (std::size_t j = 0; j <= i; ++j) a[i][j] = a[j][i] = A.data()[i + N * j];
  }
  auto const size = [](S const& x) { return x < S(0) ? S(-x) : x; };
  for (std::size_t k = 0; k < N; ++k) {
    std::size_t first = k;
    for (std::size_t i = k + 1; i < N; ++i) {
      if (size(a[i][i]) > size(a[first][first])) first = i;
    }
    std::swap(order[k], order[first]);
    std::swap(a[k], a[first]);
    for (auto& row : a) std::swap(row[k], row[first]);
    if (!(size(a[k][k]) > (std::numeric_limits<S>::min)())) {
      for (std::size_t i = k + 1; i < N; ++i) a[i][k] = S(0);
    }
    for (std::size_t i = k + 1; i < N; ++i) {
      S const l = a[i][k] == S(0) ? S(0) : S(a[i][k] / a[k][k]);
      for (std::size_t j = k + 1; j <= i; ++j) a[i][j] = a[j][i] = S(a[i][j] - l * a[k][j]);
      a[i][k] = l;
    }
  }
  Eigen::Matrix<S, N, N> inverse;
  for (std::size_t column = 0; column < N; ++column) {
    std::array<S, N> x;
    for (std::size_t i = 0; i < N; ++i) {
      x[i] = S(i == column ? 1 : 0);
      for (std::size_t j = 0; j < i; ++j) x[i] -= a[i][j] * x[j];
    }
    for (std::size_t i = 0; i < N; ++i) {
      x[i] = size(a[i][i]) > (std::numeric_limits<S>::min)() ? S(x[i] / a[i][i]) : S(0);
    }
    for (std::size_t i = N; i-- > 0;) {
      for (std::size_t j = i + 1; j < N; ++j) x[i] -= a[j][i] * x[j];
      inverse.data()[order[i] + N * order[column]] = x[i];
    }
  }
  return inverse;
}

}  // namespace slant::detail
