// SPDX-License-Identifier: MIT
//
// The blocks of a power: either one block and how often it occurs, or one block per set of
// parameters. Parameters are looked at once, here, and never again.
#pragma once

#include <slant/concepts/bad_input.hpp>
#include <slant/concepts/scalar.hpp>
#include <slant/concepts/vector.hpp>
#include <slant/sets/blocks.hpp>

#include <concepts>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace slant::detail {

/// Anything with one entry per block; whatever is not such a list is one value for all blocks.
template <class P>
concept parameter_list = requires(P const& p) {
  { slant::local(p).size() } -> std::convertible_to<index>;
  slant::local(p)[0];
};

template <class P>
[[nodiscard]] decltype(auto) parameter_at(P const& p, index i) {
  if constexpr (requires { typename P::Scalar; }) {
    return p.coeff(i);
  } else if constexpr (parameter_list<P>) {
    auto const& entries = slant::local(p);
    return entries[static_cast<decltype(entries.size())>(i)];
  } else {
    return (p);
  }
}

template <class Shape, class... Params>
concept takes_parameters = requires(Shape const& shape, Params const&... params) {
  { shape.with(parameter_at(params, 0)...) } -> std::convertible_to<Shape>;
};

/// A number of copies instead of parameters.
template <class... Params>
inline constexpr bool is_count = sizeof...(Params) == 1 && (std::integral<Params> && ...);

/// What power(shape, …) accepts after the shape.
template <class Shape, class... Params>
concept power_parameters =
    is_count<Params...> || (takes_parameters<Shape, Params...> && (parameter_list<Params> || ...));

/// The common length of the lists among the parameters.
template <class... Params>
[[nodiscard]] index parameter_count(Params const&... params) {
  index count = -1;
  int position = 0;
  auto const look = [&](auto const& p) {
    ++position;
    if constexpr (parameter_list<std::remove_cvref_t<decltype(p)>>) {
      auto const n = index(slant::local(p).size());
      if (count >= 0 && n != count) {
        throw bad_input("length of parameter list " + show(position), show(n),
                        show(count) + ", the length of the list before it");
      }
      count = n;
    }
  };
  (look(params), ...);
  return count;
}

template <class Shape, class... Params>
[[nodiscard]] Shape block_with(Shape const& shape, index i, Params const&... params) {
  try {
    return shape.with(parameter_at(params, i)...);
  } catch (bad_input const& e) {
    throw e.at(i);
  }
}

/// m equal blocks: no memory per block.
template <class Block>
class identical_blocks {
 public:
  identical_blocks(Block const& block, index count) : block_(block), count_(count) {
    if (count < 0) throw bad_input("number of blocks", show(count), "a number >= 0");
  }
  [[nodiscard]] index size() const { return count_; }
  [[nodiscard]] Block const& operator[](index) const { return block_; }
  /// What a loop should index: nothing that the loop writes can be part of it.
  [[nodiscard]] identical_blocks view() const { return *this; }

 private:
  Block block_;
  index count_;
};

/// One block per entry of the parameter lists.
template <class Block>
class listed_blocks {
 public:
  template <class... Params>
  explicit listed_blocks(Block const& shape, Params const&... params) : shape_(shape) {
    index const n = parameter_count(params...);
    blocks_.reserve(std::size_t(n));
    for (index i = 0; i < n; ++i) blocks_.push_back(block_with(shape_, i, params...));
  }

  /// These blocks; the first one is the shape of those that update() makes.
  explicit listed_blocks(std::vector<Block> blocks)
      : shape_(blocks.empty() ? Block{} : blocks.front()), blocks_(std::move(blocks)) {}

  /// New parameters, no allocation. If one of them is bad nothing changes.
  template <class... Params>
  void update(Params const&... params) {
    index const n = parameter_count(params...);
    if (n >= 0 && n != size()) {
      throw bad_input("number of parameters", show(n), show(size()) + ", the number of blocks");
    }
    for (index i = 0; i < size(); ++i) static_cast<void>(block_with(shape_, i, params...));
    for (index i = 0; i < size(); ++i) {
      blocks_[std::size_t(i)] = shape_.with(parameter_at(params, i)...);
    }
  }
  [[nodiscard]] index size() const { return index(blocks_.size()); }
  [[nodiscard]] Block const& operator[](index i) const { return blocks_[std::size_t(i)]; }
  [[nodiscard]] Block const* view() const { return blocks_.data(); }

 private:
  Block shape_;
  std::vector<Block> blocks_;
};

}  // namespace slant::detail
