// SPDX-License-Identifier: MIT
//
// The linear term of dual contact problems, b = B u⁰ − c with the displacement u⁰ without contact.
#pragma once

#include <slant/contact/contact_data.hpp>

namespace slant::contact::detail {

/// b −= c for the normal multipliers, which are the first entries of b. A node with an infinite
/// gap, whose row of B is empty, gets a negative load instead: it keeps the multiplier at 0 and is
/// small enough not to show in ‖b‖. Its size is that of the other entries, which are lengths too;
/// without any, λ = 0 is the solution and no length is needed.
template <class S, class B>
void subtract_gaps(Eigen::Matrix<S, Eigen::Dynamic, 1> const& d, B&& b) {
  if (d.size() == 0) return;
  auto const closes = [&](index i) { return slant::detail::is_finite(d(i)); };
  for (index i = 0; i < d.size(); ++i) {
    if (closes(i)) b(i) -= d(i);
  }
  auto const m = static_cast<S>(static_cast<double>(d.size()));
  S const size = b.cwiseAbs().maxCoeff() / m;
  for (index i = 0; i < d.size(); ++i) {
    if (!closes(i)) b(i) = size > S(0) ? S(-size) : S(-1);
  }
}
template <class S, class B>
void subtract_gaps(data<S> const& c, B&& b) {
  detail::subtract_gaps(c.d, b);
}

}  // namespace slant::contact::detail
