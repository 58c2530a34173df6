// SPDX-License-Identifier: MIT
//
// The identity y ↦ y as a slanting function.
#pragma once

#include <slant/concepts/vector_algebra.hpp>
#include <slant/operators/identity.hpp>
#include <slant/slanting/slanting_base.hpp>

namespace slant {

/// F(y) = y on n unknowns, F° = I.
class identity_map : public slanting_base {
 public:
  /// @throws bad_input if n < 0.
  explicit identity_map(index n) : identity_(n) {}

  [[nodiscard]] index rows() const noexcept { return identity_.rows(); }
  [[nodiscard]] index cols() const noexcept { return identity_.cols(); }

  template <has_local Y, class V>
  void value(Y const& y, V& v) const {
    vectors::copy(y, v);
  }
  template <has_local Y>
  [[nodiscard]] identity_operator slant(Y const&) const {
    return identity_;
  }
  template <has_local Y>
  void slant(Y const&, identity_operator&) const {}

 private:
  identity_operator identity_;
};

}  // namespace slant
