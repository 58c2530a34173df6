// SPDX-License-Identifier: MIT
//
// The identity on n unknowns, for every vector type and scalar.
#pragma once

#include <slant/concepts/capabilities.hpp>
#include <slant/concepts/vector_algebra.hpp>
#include <slant/operators/detail/checks.hpp>

#include <string>

namespace slant {

/// y = x.
class identity_operator {
 public:
  static constexpr law_set laws =
      slant::laws<slant::self_adjoint, slant::positive_definite, slant::projector>;

  explicit identity_operator(index n) : n_(n) {
    if (n < 0) throw bad_input("n", std::to_string(n), "a size >= 0");
  }

  [[nodiscard]] index rows() const noexcept { return n_; }
  [[nodiscard]] index cols() const noexcept { return n_; }

  template <has_local X, class Y>
  void apply(X const& x, Y& y) const {
    vectors::copy(x, y);
  }
  template <has_local X, class Y>
  void apply_add(scalar_t<X> α, X const& x, Y& y) const {
    vectors::axpy(α, x, y);
  }
  template <has_local D>
  void diagonal(D& d) const {
    vectors::fill(scalar_t<D>(1), d);
  }
  template <has_local Y>
  void columns(index first, Y& y) const {
    vectors::set_zero(y);
    for (index j = 0; j < slant::local(y).cols(); ++j) {
      slant::local(y)(first + j, j) = scalar_t<Y>(1);
    }
  }
  [[nodiscard]] identity_operator inverse() const noexcept { return *this; }

 private:
  index n_;
};

/// The identity on vectors with n components.
[[nodiscard]] inline identity_operator identity(index n) {
  return identity_operator(n);
}

}  // namespace slant
