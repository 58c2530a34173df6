// SPDX-License-Identifier: MIT
//
// A power of other blocks, each made of a block of a given power.
#pragma once

#include <slant/sets/power.hpp>

#include <type_traits>
#include <utility>
#include <vector>

namespace slant::detail {

/// The power of the blocks f(block, number) in the layout of `set`; allocates.
template <class Block, class Layout, class Blocks, class F>
[[nodiscard]] auto mapped_power(power_product<Block, Layout, Blocks> const& set, F const& f) {
  using image = std::remove_cvref_t<std::invoke_result_t<F const&, Block const&, index>>;
  index const m = set.size() / Block::dimension;
  std::vector<image> blocks;
  blocks.reserve(static_cast<std::size_t>(m));
  for (index i = 0; i < m; ++i) blocks.push_back(f(set.block(i), i));
  return power_product<image, Layout, listed_blocks<image>>(
      listed_blocks<image>(std::move(blocks)));
}

}  // namespace slant::detail
