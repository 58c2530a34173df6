// SPDX-License-Identifier: MIT
//
// Functions that are given block by block, as many laws of contact are: the components of a contact
// depend on those of the same contact only,
//
//     F(y) = (F₁(y₁), …, F_m(y_m)),     F°(y) = diag(F₁°(y₁), …, F_m°(y_m)).
//
// A block is what such a function is made of: fixed `dimension` N, `scalar`, value(y) → N numbers,
// slant(y) → N × N matrix, and with(parameters…), which makes others of its kind. Its slanting
// operator is bounded and tells F from the far end, as slanting_function.hpp says; nothing else is
// known about it.
#pragma once

#include <slant/sets/blocks.hpp>
#include <slant/sets/slants.hpp>
#include <slant/slanting/slanting_part.hpp>

#include <Eigen/Core>

#include <utility>

namespace slant {

/// What a function can be given by, block by block.
template <class B>
concept function_block =
    has_static_dimension<B> &&
    requires(B const& b, Eigen::Matrix<typename B::scalar, B::dimension, 1> const& y) {
      { b.value(y) } -> numbers_like<point_t<B>, B::dimension, 1>;
      { b.slant(y) } -> numbers_like<point_t<B>, B::dimension, B::dimension>;
    };

/// F_i of type Block on the entries N i … N i + N − 1. Made by `blockwise`. Only slant(y)
/// allocates.
template <function_block Block>
class blockwise_map : public slanting_base {
  static constexpr int n = Block::dimension;

 public:
  using scalar = typename Block::scalar;
  using block_type = Block;
  using slant_type = block_diagonal_slant<scalar, n, consecutive, false, law_set{}>;

  explicit blockwise_map(detail::listed_blocks<Block> blocks) : blocks_(std::move(blocks)) {}

  [[nodiscard]] index rows() const { return n * blocks_.size(); }
  [[nodiscard]] index cols() const { return rows(); }
  [[nodiscard]] index block_count() const { return blocks_.size(); }
  /// F_i.
  [[nodiscard]] Block const& block(index i) const { return blocks_[i]; }

  /// New parameters for all blocks (lists of their number, or one value for all); does not
  /// allocate.
  /// @throws bad_input naming parameter and block; the function is then unchanged.
  template <class... Params>
    requires detail::takes_parameters<Block, Params...>
  void update(Params const&... params) {
    blocks_.update(params...);
  }

  template <class Y, class V>
    requires std::same_as<scalar_t<Y>, scalar>
  void value(Y const& y, V& v) const {
    auto const& from = slant::local(y);
    auto& to = slant::local(v);
    for (index i = 0; i < block_count(); ++i) {
      auto const p = place_of(i);
      p.put(to, block(i).value(p.value(from)));
    }
  }
  template <class Y>
    requires std::same_as<scalar_t<Y>, scalar>
  [[nodiscard]] slant_type slant(Y const& y) const {
    slant_type g(block_count());
    slant(y, g);
    return g;
  }
  template <class Y>
    requires std::same_as<scalar_t<Y>, scalar>
  void slant(Y const& y, slant_type& g) const {
    for (index i = 0; i < block_count(); ++i) {
      g.assign(i, block(i).slant(place_of(i).value(slant::local(y))));
    }
  }

 private:
  [[nodiscard]] auto place_of(index i) const {
    return block_place<n, consecutive>(i, block_count());
  }

  detail::listed_blocks<Block> blocks_;
};

/// One block shape.with(parameters[i]…) per entry of the lists, as for slant::power.
/// @throws bad_input naming parameter and block, "mu[3]: got -1, expected …".
template <function_block Block, class... Params>
  requires(detail::takes_parameters<Block, Params...> && (detail::parameter_list<Params> || ...))
[[nodiscard]] auto blockwise(Block const& shape, Params const&... params) {
  return blockwise_map<Block>(detail::listed_blocks<Block>(shape, params...));
}

}  // namespace slant
