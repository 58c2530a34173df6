// SPDX-License-Identifier: MIT
//
// Blocks turned by an orthogonal matrix: rotated(ellipse{a, b}, Q) has its axes along the columns
// of Q.
#pragma once

#include <slant/base/scaling.hpp>
#include <slant/concepts/bad_input.hpp>
#include <slant/sets/parts/image.hpp>

#include <string>
#include <utility>

namespace slant {

namespace detail {

/// x = Q z.
template <class S, int N>
class rotation {
 public:
  using matrix_type = Eigen::Matrix<S, N, N>;
  static constexpr bool separable = false;

  explicit rotation(matrix_type const& q) : q_(q) {}

  [[nodiscard]] matrix_type const& matrix() const { return q_; }

  [[nodiscard]] auto pull(auto const& x) const { return (q_.transpose() * x).eval(); }
  [[nodiscard]] auto push(auto const& z) const { return (q_ * z).eval(); }
  [[nodiscard]] auto pull_direction(auto const& d) const { return pull(d); }
  [[nodiscard]] auto push_adjoint(auto const& y) const { return pull(y); }
  [[nodiscard]] S offset(auto const&) const { return S(0); }
  [[nodiscard]] auto push_gradient(auto const& g) const { return (q_ * g).eval(); }
  [[nodiscard]] matrix_type push_hessian(matrix_type const& h) const { return push_slant(h); }
  /// Q G Qᵀ, symmetric to the last bit.
  [[nodiscard]] matrix_type push_slant(matrix_type const& g) const {
    matrix_type const r = q_ * g * q_.transpose();
    return (r + r.transpose()) / S(2);
  }

  template <class X, class Z>
  [[nodiscard]] S slop(X const& x, Z const&) const {
    return rounding_band<S>() * S(N * N) * x.template lpNorm<1>();
  }

 private:
  matrix_type q_;
};

}  // namespace detail

/// QΛ for a block of dimension N and an orthogonal N × N matrix Q.
/// @throws bad_input if QᵀQ differs from I by more than 8 N ε in some entry, ε the machine epsilon.
template <set_block C, class Q>
[[nodiscard]] auto rotated(C const& set, Q const& matrix) {
  using S = set_scalar_t<C>;
  constexpr int n = C::dimension;
  using matrix_type = Eigen::Matrix<S, n, n>;
  matrix_type const q = matrix;
  matrix_type const defect = q.transpose() * q - matrix_type::Identity();
  S const largest = defect.cwiseAbs().maxCoeff();
  if (!(largest <= detail::rounding_band<S>() * S(n)) || defect.hasNaN()) {
    throw bad_input("Q", std::string("max |QᵀQ − I| = ").append(detail::show(largest)),
                    "an orthogonal matrix");
  }
  return detail::image_of(set, detail::rotation<S, n>(q));
}

}  // namespace slant
