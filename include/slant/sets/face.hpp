// SPDX-License-Identifier: MIT
//
// The face of a point: which blocks of it are free, sliding or fixed, and which components that
// leaves to move.
#pragma once

#include <slant/base/vector_algebra.hpp>
#include <slant/concepts/convex_set.hpp>
#include <slant/concepts/face.hpp>
#include <slant/sets/blocks.hpp>

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <utility>
#include <vector>

namespace slant {

namespace detail {

/// The state of a block at p of a set C in its part of the point x.
template <class C, class Block, class P, class X>
[[nodiscard]] block_state state_of_block(Block const& block, P const& p, X const& x) {
  if constexpr (whole_space<Block>) {
    return block_state::free;
  } else if constexpr (has_state<Block, point_t<Block>> &&
                       (has_visit<C> || has_static_dimension<C>)) {
    return block.state(argument_of(block, p, slant::local(x)));
  } else if constexpr (has_state<C, X> && !has_visit<C>) {
    return block.state(x);  // a set with one block and vectors of its own kind
  } else {
    static_assert(has_state<Block, point_t<Block>>,
                  "a block of this set has no state(x), so its points have no face");
    return block_state::free;
  }
}

}  // namespace detail

/// The partition of the blocks of a set at a point. Free components are those of the free blocks.
/// S is the scalar of the vectors that keep() works on. Reassigning for the same set does not
/// allocate.
template <scalar S = double>
class face {
 public:
  /// The face of nothing.
  face() = default;

  /// The face of the point x of a set (a block or any product of blocks).
  template <class C, class X>
  face(C const& set, X const& x) {
    assign(set, x);
  }

  /// Becomes the face of x ∈ set; true if anything changed.
  template <class C, class X>
  bool assign(C const& set, X const& x) {
    detail::check_rows("x", x, slant::dimension_of(set), "the dimension of the set");
    bool changed = reshape(slant::block_count(set), slant::dimension_of(set));
    counts_ = {};
    slant::visit_blocks(set, [&](auto const& block, auto const& p) {
      block_state const s = detail::state_of_block<C>(block, p, x);
      auto& old = states_[static_cast<std::size_t>(p.index())];
      changed = changed || old != s;
      old = s;
      ++counts_[static_cast<std::size_t>(s)];
      S const flag = s == block_state::free ? S(1) : S(0);
      for (index j = 0; j < p.size(); ++j) {
        S& entry = mask_.coeffRef(p.component(j));
        changed = changed || !(entry == flag);
        entry = flag;
      }
    });
    if (changed) list_components();
    return changed;
  }

  /// Number of blocks.
  [[nodiscard]] index size() const { return static_cast<index>(states_.size()); }
  /// Number of components of the vectors.
  [[nodiscard]] index dimension() const { return mask_.size(); }
  /// Number of blocks in a state.
  [[nodiscard]] index count(block_state s) const { return counts_[static_cast<std::size_t>(s)]; }

  /// State of block i in the order of visit.
  [[nodiscard]] block_state state(index i) const { return states_[static_cast<std::size_t>(i)]; }
  [[nodiscard]] std::vector<block_state> const& states() const { return states_; }
  /// Free components, ascending.
  [[nodiscard]] std::vector<index> const& components() const { return components_; }

  /// y = x on the free components and 0 elsewhere; y may be x.
  template <class X, class Y>
  void keep(X const& x, Y& y) const {
    check(x, y);
    vectors::keep(mask_, x, y);
  }

  /// y = x except on the free components and 0 there; y may be x.
  template <class X, class Y>
  void keep_complement(X const& x, Y& y) const {
    check(x, y);
    vectors::keep_complement(mask_, x, y);
  }

  /// The same partition of the same components.
  friend bool operator==(face const& a, face const& b) {
    return a.states_ == b.states_ && a.components_ == b.components_;
  }

 private:
  /// Room for so many blocks and components; true if that is new.
  bool reshape(index blocks, index components) {
    if (blocks == size() && components == dimension()) return false;
    states_.assign(static_cast<std::size_t>(blocks), block_state::free);
    mask_.setOnes(components);
    components_.reserve(static_cast<std::size_t>(components));
    return true;
  }

  void list_components() {
    components_.clear();
    for (index i = 0; i < mask_.size(); ++i) {
      if (!(mask_.coeff(i) == S(0))) components_.push_back(i);
    }
  }

  template <class X, class Y>
  void check([[maybe_unused]] X const& x, [[maybe_unused]] Y const& y) const {
    eigen_assert(slant::local(x).size() == dimension() && slant::local(y).size() == dimension());
  }

  std::vector<block_state> states_;
  std::array<index, 3> counts_{};
  Eigen::Matrix<S, Eigen::Dynamic, 1> mask_;
  std::vector<index> components_;
};

template <class C, class X>
concept has_own_face = requires(C const& set, X const& x) { set.face_of(x); };

namespace detail {

template <class C, class X>
struct face_type {
  using type = face<scalar_t<X>>;
};
template <class C, class X>
  requires has_own_face<C, X>
struct face_type<C, X> {
  using type = decltype(std::declval<C const&>().face_of(std::declval<X const&>()));
};

}  // namespace detail

/// The type of the faces of a set for points of type X: the set's own if it has face_of(x), else
/// slant::face.
template <class C, class X>
using face_t = typename detail::face_type<C, X>::type;

/// The face of the point x of a set.
template <class C, class X>
[[nodiscard]] face_t<C, X> face_of(C const& set, X const& x) {
  if constexpr (has_own_face<C, X>) {
    return set.face_of(x);
  } else {
    return face_t<C, X>(set, x);
  }
}

}  // namespace slant
