// SPDX-License-Identifier: MIT
//
// Workspace of two operators applied one after the other.
#pragma once

namespace slant::detail {

template <class Inner, class Between, class Outer>
struct chain_workspace {
  Inner inner;      ///< of the operator applied first
  Between between;  ///< its result
  Outer outer;      ///< of the operator applied second
};
template <class Inner, class Between, class Outer>
chain_workspace(Inner, Between, Outer) -> chain_workspace<Inner, Between, Outer>;

}  // namespace slant::detail
