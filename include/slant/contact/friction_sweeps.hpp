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
#include <slant/sets/detail/entries.hpp>
#include <slant/sets/detail/symmetric_eigen.hpp>

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
      S* const ri = r.data() + N * i;
      S const* const ci = center.data() + N * i;
      part_type q = slant::detail::entries_at<N>(p.q().data() + N * i);
      p.for_row(i, [&](index j, block_type const& b) {
        S const* const rj = r.data() + N * j;
        if (*rj == S(0)) return;  // the apex: open
        slant::detail::add_product(b, rj, q);
        ++products;
      });
      block_type W = p.diagonal(i);
      S const shift = shift_[i], proximal = α * weight[i];
      for (int a = 0; a < N; ++a) {
        W(a, a) += shift + proximal;
        q(a) -= shift * ri[a] + proximal * ci[a];
      }
      auto const c = detail::solve_one_contact<N, S>(W, q, p.mu(i), memory.slip[k]);
      ++products;
      slant::detail::put_entries(c.r, ri);
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
    S const size = slant::detail::largest_of(d);
    if (size == S(0)) return S(1);
    slant::detail::symmetric_eigen<S, N> const eigen(slant::detail::from_entries<block_type>(
        [&](int i, int j) -> S { return (d(i, j) + d(j, i)) / (S(2) * size); }));
    S least = eigen.values(0);
    for (int i = 1; i < N; ++i) least = std::min(least, S(eigen.values(i)));
    return least > S(1e-6) ? S(0) : S(size * (S(1e-2) + std::max(S(0), S(-least))));
  }

  blocks_type const* blocks_;
  vector_type shift_;
};

}  // namespace slant::contact
