// SPDX-License-Identifier: MIT
//
// What a factory returns after a static_assert has refused its arguments: an operator, or a
// function, that can do everything and promises everything, so that one mistake is one complaint.
// Nothing of it is defined.
#pragma once

#include <slant/concepts/linear_operator.hpp>

namespace slant::detail {

struct refused_operator {
  static constexpr law_set laws{~0U};
  index rows() const;
  index cols() const;
  void apply(auto const& x, auto& y) const;
  void apply_adjoint(auto const& x, auto& y) const;
};

struct refused_function {
  index rows() const;
  index cols() const;
  void value(auto const& y, auto& f) const;
  refused_operator slant(auto const& y) const;
};

}  // namespace slant::detail
