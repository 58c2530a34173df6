// SPDX-License-Identifier: MIT
//
// Where the block of a product lives inside the vector: component j of the block is entry
// first + j · stride. Such places are closed under nesting, so a product of products of blocks
// still tells each block in three numbers where its part is.
#pragma once

#include <slant/concepts/vector.hpp>

#include <Eigen/Core>

#include <type_traits>

namespace slant {

/// Layout of a power of blocks with n components each: block i owns entries n·i … n·i + n − 1.
struct consecutive {};

/// Layout of a power of m blocks: component j of block i is entry i + j·m. This is the numbering
/// λ = (all first components, all second components, …) of [T] and [K].
struct planar {};

/// The place of one block. N is its dimension (Eigen::Dynamic: known at run time only).
template <int N = Eigen::Dynamic, class Layout = consecutive>
class place {
  static constexpr bool strided = std::is_same_v<Layout, planar>;
  static_assert(!strided || N != Eigen::Dynamic, "only blocks of static dimension can be planar");

 public:
  static constexpr int dimension = N;

  constexpr place(slant::index number, slant::index first, slant::index size,
                  slant::index stride = 1)
      : number_(number), first_(first), size_(size), stride_(stride) {}

  /// Number of the block, counted over all blocks of the outermost product.
  [[nodiscard]] constexpr slant::index index() const { return number_; }
  /// Number of components of the block.
  [[nodiscard]] constexpr slant::index size() const { return N == Eigen::Dynamic ? size_ : N; }
  /// Position of component j of the block in the whole vector.
  [[nodiscard]] constexpr slant::index component(slant::index j) const {
    return strided ? first_ + j * stride_ : first_ + j;
  }

  /// The block's part of x as an Eigen view, writable if x is; a copy if x is an expression without
  /// memory of its own and the layout is planar.
  template <class X>
  [[nodiscard]] auto in(X& x) const {
    auto& entries = slant::local(x);
    using L = std::remove_reference_t<decltype(entries)>;
    if constexpr (!strided && N == Eigen::Dynamic) {
      return entries.segment(first_, size_);
    } else if constexpr (!strided) {
      return entries.template segment<N>(first_);
    } else if constexpr (bool(L::Flags & Eigen::DirectAccessBit)) {
      using block = Eigen::Matrix<typename L::Scalar, N, 1>;
      constexpr bool is_const = std::is_const_v<std::remove_pointer_t<decltype(entries.data())>>;
      using target = std::conditional_t<is_const, block const, block>;
      auto const inner = entries.innerStride();
      return Eigen::Map<target, Eigen::Unaligned, Eigen::InnerStride<>>(
          entries.data() + first_ * inner, Eigen::InnerStride<>(stride_ * inner));
    } else {
      return value(x);
    }
  }

  /// A copy of the block's part of x, in registers for small static N.
  template <class X>
  [[nodiscard]] auto value(X const& x) const {
    auto const& entries = slant::local(x);
    using S = scalar_t<X>;
    Eigen::Matrix<S, N, 1> v;
    if constexpr (N == Eigen::Dynamic) v.resize(size_);
    for (slant::index j = 0; j < size(); ++j) v.coeffRef(j) = entries.coeff(component(j));
    return v;
  }

  /// The block's part of y = v.
  template <class Y, class V>
  void put(Y& y, V const& v) const {
    auto& entries = slant::local(y);
    for (slant::index j = 0; j < size(); ++j) entries.coeffRef(component(j)) = v.coeff(j);
  }

  /// The place in the whole vector of something at `inner` within this block.
  template <int M, class L>
  [[nodiscard]] constexpr auto then(place<M, L> const& inner) const {
    constexpr bool both = !strided && std::is_same_v<L, consecutive>;
    return place<M, std::conditional_t<both, consecutive, planar>>(
        number_ + inner.index(), component(inner.component(0)), inner.size(),
        component(inner.component(1)) - component(inner.component(0)));
  }

 private:
  slant::index number_;
  slant::index first_;
  slant::index size_;
  slant::index stride_;
};

/// The place of factor i of a power of m factors with N components and `inner` blocks each.
template <int N, class Layout>
[[nodiscard]] constexpr auto block_place(index i, index m, index inner = 1) {
  if constexpr (std::is_same_v<Layout, planar>) {
    return place<N, planar>(i * inner, i, N, m);
  } else {
    return place<N, consecutive>(i * inner, i * N, N);
  }
}

}  // namespace slant
