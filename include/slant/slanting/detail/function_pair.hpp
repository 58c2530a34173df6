// SPDX-License-Identifier: MIT
//
// Two slanting functions of the same argument with equally many values.
#pragma once

#include <slant/slanting/detail/checks.hpp>
#include <slant/slanting/slanting_base.hpp>

#include <type_traits>
#include <utility>

namespace slant::detail {

/// F and G are `Function const&` (referenced) or function types (owned).
template <class F, class G>
class function_pair : public slanting_base {
 public:
  using left_type = std::remove_cvref_t<F>;
  using right_type = std::remove_cvref_t<G>;

  /// Throws bad_input if the numbers of values or of arguments differ.
  function_pair(held<F> f, held<G> g) : f_(std::move(f)), g_(std::move(g)) {
    require_equal_sizes("g.rows()", right().rows(), left().rows(), "f.rows()");
    require_equal_sizes("g.cols()", right().cols(), left().cols(), "f.cols()");
  }

  [[nodiscard]] index rows() const { return left().rows(); }
  [[nodiscard]] index cols() const { return left().cols(); }
  [[nodiscard]] left_type const& left() const noexcept { return f_.get(); }
  [[nodiscard]] right_type const& right() const noexcept { return g_.get(); }

 protected:
  template <class V>
  static constexpr bool usable =
      slanting_function<left_type, V> && slanting_function<right_type, V>;

 private:
  held<F> f_;
  held<G> g_;
};

}  // namespace slant::detail
