// SPDX-License-Identifier: MIT
//
// Sweeps of block Gauss–Seidel for Coulomb friction: one contact after the other is solved exactly,
// the forces of the others held (nonlinear Gauss–Seidel: Jourdan, Alart and Jean, 1998).
//
// Contacts that are open cost nothing as neighbours, and after some sweeps in which they stayed
// open are looked at only every now and then.
#pragma once

#include <slant/contact/detail/one_contact.hpp>
#include <slant/contact/friction_blocks.hpp>

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace slant::contact {

/// What sweeps know of the contacts from the sweeps before.
template <class S>
struct friction_sweep_memory {
  std::vector<S> slip{};    ///< λ of the last slip, where the next begins to look
  std::vector<int> idle{};  ///< sweeps since the contact was closed, up to a few
};

/// The sweeps. Refers to the blocks; what changes is in the memory.
template <int N, scalar S = double>
class friction_sweeps {
 public:
  using blocks_type = friction_blocks<N, S>;
  using vector_type = typename blocks_type::vector_type;
  using block_type = typename blocks_type::block_type;
  using part_type = typename blocks_type::part_type;
  using memory_type = friction_sweep_memory<S>;

  explicit friction_sweeps(blocks_type const& blocks)
      : blocks_(&blocks), shift_(blocks.contacts()) {
    for (index i = 0; i < blocks.contacts(); ++i) shift_[i] = needed_shift(blocks.diagonal(i));
  }

  /// Of someone who has seen no sweep yet.
  [[nodiscard]] memory_type memory() const {
    auto const m = std::size_t(blocks_->contacts());
    return {.slip = std::vector<S>(m, S(0)), .idle = std::vector<int>(m, 0)};
  }
  /// One sweep over the contacts of u = W r + q + α Λ (r − c), Λ diagonal with one entry for each
  /// contact; α = 0 and any c of the size of r for u = W r + q. Contacts long open are passed over
  /// unless `all`. Returns the blocks of W that were multiplied.
  index sweep(vector_type& r, memory_type& memory, bool all, S const& α, vector_type const& weight,
              vector_type const& center) const {
    auto const& p = *blocks_;
    index products = 0;
    for (index i = 0; i < p.contacts(); ++i) {
      auto const k = std::size_t(i);
      if (!all && memory.idle[k] >= patience) continue;
      part_type q = p.q().template segment<N>(N * i);
      p.for_row(i, [&](index j, block_type const& b) {
        auto const rj = r.template segment<N>(N * j);
        if (rj(0) == S(0)) return;  // the apex: open
        q.noalias() += b * rj;
        ++products;
      });
      block_type W = p.diagonal(i);
      W.diagonal().array() += shift_[i] + α * weight[i];
      q -= shift_[i] * r.template segment<N>(N * i) +
           α * weight[i] * center.template segment<N>(N * i);
      auto const c = detail::solve_one_contact<N, S>(W, q, p.mu(i), memory.slip[k]);
      ++products;
      r.template segment<N>(N * i) = c.r;
      if (c.slip > S(0)) memory.slip[k] = c.slip;
      memory.idle[k] = c.r(0) > S(0) ? 0 : std::min(memory.idle[k] + 1, patience);
    }
    return products;
  }
  /// What is added to the diagonal of W_ii so that it is definite; 0 where it is.
  [[nodiscard]] S shift(index i) const { return shift_[i]; }
  /// One sweep for u = W r + q.
  index sweep(vector_type& r, memory_type& memory, bool all = true) const {
    return sweep(r, memory, all, S(0), shift_, r);
  }

 private:
  static constexpr int patience = 3;

  /// What is added to a diagonal block, and taken away by r of the last sweep, so that its smallest
  /// eigenvalue is more than a millionth of its size: a step of the proximal point method for this
  /// contact. 0 where it is as it is.
  static S needed_shift(block_type const& d) {
    S const size = d.cwiseAbs().maxCoeff();
    if (size == S(0)) return S(1);
    block_type const symmetric = (d + d.transpose()) / (S(2) * size);
    S const least = Eigen::SelfAdjointEigenSolver<block_type>(symmetric, Eigen::EigenvaluesOnly)
                        .eigenvalues()
                        .minCoeff();
    return least > S(1e-6) ? S(0) : S(size * (S(1e-2) + std::max(S(0), S(-least))));
  }

  blocks_type const* blocks_;
  vector_type shift_;
};

}  // namespace slant::contact
