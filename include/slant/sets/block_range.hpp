// SPDX-License-Identifier: MIT
//
// The blocks of a point as a range:
//
//     auto const sliding = [](auto const& b) { return b.state() == slant::block_state::sliding; };
//     std::ranges::count_if(slant::blocks(Λ, x), sliding)
//
// for std::ranges and for range-v3. All blocks of Λ stand in one range, in the order of visit, as
// elements of one type, which find their block in Λ by its number, a comparison for each part of a
// product. Nothing is allocated. (Rejected: a range for each part, which any_set could not have; the
// blocks of one part are blocks(Λ, x) | drop(first) | take(count).)
#pragma once

#include <slant/concepts/bad_input.hpp>
#include <slant/concepts/convex_set.hpp>
#include <slant/sets/block_queries.hpp>
#include <slant/sets/blocks.hpp>
#include <slant/sets/face.hpp>

#include <Eigen/Core>

#include <ranges>
#include <type_traits>

namespace slant {

/// One block of a point x of a set C; refers to both.
template <class C, class X>
class block_of_point {
  using entries_type = local_t<X>;
  using segment_type = Eigen::Matrix<typename entries_type::Scalar, Eigen::Dynamic, 1>;

 public:
  block_of_point(C const& set, X const& x, slant::index k) : set_(&set), x_(&x), number_(k) {
    slant::visit_block(set, k, [this](auto const&, auto const& p) {
      size_ = p.size();
      if (size_ > 0) first_ = p.component(0);
      if (size_ > 1) stride_ = p.component(1) - first_;
    });
  }

  /// Number of the block in Λ, that of face::state(i).
  [[nodiscard]] slant::index index() const { return number_; }
  /// Number of its components.
  [[nodiscard]] slant::index size() const { return size_; }
  /// Position of component j in the vector.
  [[nodiscard]] slant::index component(slant::index j) const { return first_ + j * stride_; }
  /// Its components, as a small vector that shows those of x.
  [[nodiscard]] auto value() const {
    using view = Eigen::Map<segment_type const, Eigen::Unaligned, Eigen::InnerStride<>>;
    auto const& entries = slant::local(*x_);
    auto const inner = entries.innerStride();
    return view(entries.data() + first_ * inner, size_, Eigen::InnerStride<>(stride_ * inner));
  }
  /// Whether it is free, sliding or fixed.
  [[nodiscard]] block_state state() const
    requires has_block_states<C, entries_type>
  {
    auto s = block_state::free;
    slant::visit_block(*set_, number_, [&](auto const& block, auto const& p) {
      s = detail::state_of_block<C>(block, p, *x_);
    });
    return s;
  }

 private:
  C const* set_;
  X const* x_;
  slant::index number_;
  slant::index first_ = 0, size_ = 0, stride_ = 1;
};

namespace detail {

/// k ↦ block k of a point.
template <class C, class X>
struct block_at {
  C const* set = nullptr;
  X const* x = nullptr;
  [[nodiscard]] block_of_point<C, X> operator()(int k) const { return {*set, *x, k}; }
};
/// Numbered by int: distances of an iota of wider numbers have 128 bits, with which clients get
/// warnings.
template <class C, class X>
using blocks_view = std::ranges::transform_view<std::ranges::iota_view<int, int>, block_at<C, X>>;

}  // namespace detail

/// The blocks of a point, a random access view. Made by `blocks`.
template <class C, class X>
class block_range : public detail::blocks_view<C, X> {
 public:
  block_range() = default;
  block_range(C const& set, X const& x)
      : detail::blocks_view<C, X>(std::views::iota(0, static_cast<int>(slant::block_count(set))),
                                  detail::block_at<C, X>{&set, &x}) {}
};

/// The blocks of the point x of a set, see the top of this file; x has entries in memory. Refers to
/// both, which must outlive it, as it must its iterators. @throws bad_input unless x has the size of the set.
template <class C, class X>
  requires(has_visit_block<C> || !has_visit<C>) && detail::has_memory<local_t<X>>
[[nodiscard]] block_range<C, X> blocks(C const& set, X const& x) {
  detail::check_size("x", index(slant::local(x).size()), slant::dimension_of(set),
                     "the dimension of the set,");
  return {set, x};
}
template <class C, class X>
void blocks(C const&& set, X const& x) = delete;
template <class C, class X>
void blocks(C const& set, X const&& x) = delete;
template <class C, class X>
void blocks(C const&& set, X const&& x) = delete;

}  // namespace slant

// range-v3 is told that this is a view without being included: it does not know those of std.
namespace ranges::ext {
template <class T>
struct enable_view;
template <class C, class X>
struct enable_view<slant::block_range<C, X>> : std::true_type {};
}  // namespace ranges::ext
