// SPDX-License-Identifier: MIT
//
// The one way in which the finite element headers refuse an argument. They depend on Eigen alone,
// so this is std::invalid_argument with the wording of the library's own exception.
#pragma once

#include <sstream>
#include <stdexcept>

namespace fem {

/// Throws std::invalid_argument "argument: got value, expected expectation" unless `holds`.
/// A comparison with NaN is false, so state conditions positively: require(x > 0, …) refuses NaN.
template <class Value>
void require(bool holds, char const* argument, Value const& value, char const* expectation) {
  if (holds) return;
  std::ostringstream text;
  text.precision(17);
  text << argument << ": got " << value << ", expected " << expectation;
  throw std::invalid_argument(text.str());
}

}  // namespace fem
