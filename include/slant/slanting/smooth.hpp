// SPDX-License-Identifier: MIT
//
// A client's differentiable function, given by callables: F° = F′.
//
//     auto F = slant::smooth(2, 2,
//         [](auto const& y, auto& f) { f << y[0] * y[0] - y[1], y[1] * y[1] - y[0]; },
//         [](auto const& y) { return Eigen::Matrix2d{{2 * y[0], -1}, {-1, 2 * y[1]}}; });
#pragma once

#include <slant/concepts/bad_input.hpp>
#include <slant/slanting/slanting_part.hpp>

#include <concepts>
#include <string>
#include <utility>

namespace slant {

namespace detail {

/// The derivative is made anew each time.
struct no_renewal {};

}  // namespace detail

/// F given by value(y, f), derivative(y) and perhaps renew(y, G).
template <law_set L, class Value, class Derivative, class Renew>
class smooth_map : public slanting_base {
 public:
  /// @throws bad_input if a size is negative.
  smooth_map(index rows, index cols, Value value, Derivative derivative, Renew renew)
      : rows_(rows),
        cols_(cols),
        value_(std::move(value)),
        derivative_(std::move(derivative)),
        renew_(std::move(renew)) {
    if (rows < 0 || cols < 0) {
      throw bad_input("rows, cols", std::to_string(rows).append(", ").append(std::to_string(cols)),
                      "sizes >= 0");
    }
  }

  [[nodiscard]] index rows() const noexcept { return rows_; }
  [[nodiscard]] index cols() const noexcept { return cols_; }

  template <class Y, class V>
    requires std::invocable<Value const&, Y const&, V&>
  void value(Y const& y, V& v) const {
    value_(y, v);
  }
  template <class Y>
    requires std::invocable<Derivative const&, Y const&>
  [[nodiscard]] auto slant(Y const& y) const {
    return detail::derivative_operator<L>(derivative_(y));
  }
  template <class Y, class G>
    requires std::invocable<Renew const&, Y const&, G&>
  void slant(Y const& y, G& g) const {
    renew_(y, g);
  }

 private:
  index rows_;
  index cols_;
  [[no_unique_address]] Value value_;
  [[no_unique_address]] Derivative derivative_;
  [[no_unique_address]] Renew renew_;
};

/// F: R^cols → R^rows. value(y, f) overwrites f with F(y); derivative(y) returns F′(y), an operator
/// or an Eigen matrix; L are the laws that the caller asserts for such a matrix (self_adjoint for
/// the Hessian of a function). renew(y, G) does G = F′(y) into an operator that derivative(y₀) made
/// earlier; without it each new derivative may allocate.
/// @throws bad_input if a size is negative.
template <law... L, class Value, class Derivative, class Renew = detail::no_renewal>
[[nodiscard]] auto smooth(index rows, index cols, Value value, Derivative derivative,
                          Renew renew = {}) {
  return smooth_map<slant::laws<L...>, Value, Derivative, Renew>(
      rows, cols, std::move(value), std::move(derivative), std::move(renew));
}

}  // namespace slant
