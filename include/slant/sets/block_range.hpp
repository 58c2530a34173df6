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

#include <compare>
#include <cstddef>
#include <iterator>
#include <ranges>
#include <type_traits>
#include <utility>

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

/// The blocks of a point, a random access view. Made by `blocks`.
template <class C, class X>
class block_range : public std::ranges::view_interface<block_range<C, X>> {
 public:
  class iterator {
   public:
    using iterator_concept = std::random_access_iterator_tag;
    using iterator_category = std::input_iterator_tag;  // * returns no reference
    using value_type = block_of_point<C, X>;
    using difference_type = std::ptrdiff_t;
    using reference = value_type;
    using pointer = void;

    iterator() = default;
    iterator(C const* set, X const* x, difference_type k) : set_(set), x_(x), k_(k) {}

    value_type operator*() const { return {*set_, *x_, k_}; }
    value_type operator[](difference_type n) const { return *(*this + n); }
    iterator& operator+=(difference_type n) {
      k_ += n;
      return *this;
    }
    iterator& operator-=(difference_type n) { return *this += -n; }
    iterator& operator++() { return *this += 1; }
    iterator& operator--() { return *this += -1; }
    iterator operator++(int) { return std::exchange(*this, *this + 1); }
    iterator operator--(int) { return std::exchange(*this, *this - 1); }
    friend iterator operator+(iterator i, difference_type n) { return i += n; }
    friend iterator operator+(difference_type n, iterator i) { return i += n; }
    friend iterator operator-(iterator i, difference_type n) { return i -= n; }
    friend difference_type operator-(iterator const& a, iterator const& b) { return a.k_ - b.k_; }
    friend bool operator==(iterator const& a, iterator const& b) { return a.k_ == b.k_; }
    friend auto operator<=>(iterator const& a, iterator const& b) { return a.k_ <=> b.k_; }

   private:
    C const* set_ = nullptr;
    X const* x_ = nullptr;
    difference_type k_ = 0;
  };

  block_range() = default;
  block_range(C const& set, X const& x) : set_(&set), x_(&x), count_(slant::block_count(set)) {}

  [[nodiscard]] iterator begin() const { return {set_, x_, 0}; }
  [[nodiscard]] iterator end() const { return {set_, x_, count_}; }

 private:
  C const* set_ = nullptr;
  X const* x_ = nullptr;
  index count_ = 0;
};

/// The blocks of the point x of a set, see the top of this file; x has entries in memory. Refers to
/// both, which must outlive what is made of it. @throws bad_input unless x has the size of the set.
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
