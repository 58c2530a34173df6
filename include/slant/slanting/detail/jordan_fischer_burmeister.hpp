// SPDX-License-Identifier: MIT
//
// φ(x, y) = x + y − (x² + y²)^½ in the Jordan algebra of the second-order cone ‖x_t‖ <= x₀,
//
//     x∘y = (xᵀy, x₀y_t + y₀x_t) = L_x y,      x² = x∘x.
//
// With w = x² + y², e = w_t/‖w_t‖, c± = (1, ±e)/√2 and λ± = w₀ ± ‖w_t‖ >= 0 the root is
// z = (√λ₊ + √λ₋, (√λ₊ − √λ₋) e)/2, and L_z dz = L_x dx + L_y dy gives
//
//     φ° = (I − L_z⁻¹L_x,  I − L_z⁻¹L_y),
//     L_z⁻¹ = c₊c₊ᵀ/√λ₊ + c₋c₋ᵀ/√λ₋ + 2/(√λ₊ + √λ₋) (0 ⊕ (I − eeᵀ)).
//
// All is bounded, as ‖L_x c₋‖² + ‖L_y c₋‖² <= λ₋. λ₋ and the difference x + y − z cancel where it
// matters, at complementary x and y: both are had in double words.
#pragma once

#include <slant/sets/detail/double_word.hpp>
#include <slant/sets/detail/entries.hpp>
#include <slant/sets/detail/scaled_norm.hpp>

#include <Eigen/Core>

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

namespace slant::detail {

template <class S, int N>
class jordan_fischer_burmeister {
 public:
  using vector_type = Eigen::Matrix<S, N, 1>;
  using matrix_type = Eigen::Matrix<S, N, N>;

  /// Everything of φ that x and y determine.
  jordan_fischer_burmeister(vector_type const& x, vector_type const& y)
      : exponent_(unit(x, y)),
        x_(times_power_of_two<S, N>(x, -exponent_)),
        y_(times_power_of_two<S, N>(y, -exponent_)) {
    word const w0 = precise_dot<S>(x_, x_) + precise_dot<S>(y_, y_);
    word squares;
    for (int i = 1; i < N; ++i) {
      word const half = exact_product<S>(x_(0), x_(i)) + exact_product<S>(y_(0), y_(i));
      e_at(i) = half + half;
      squares = squares + e_at(i) * e_at(i);
    }
    word const length = square_root(squares);
    larger_ = square_root(w0 + length);
    word const λ = w0 - length;
    smaller_ = λ.hi > S(0) ? square_root(λ) : word(S(0));
    if (length.hi > S(0)) {
      for (auto& entry : e_) entry = entry / length;
    } else {  // z is a multiple of the unit: any e will do
      e_.fill(word(S(0)));
      e_[0] = word(S(1));
    }
  }

  [[nodiscard]] vector_type value() const {
    word const half(S(0.5));
    vector_type φ;
    φ(0) = (exact_sum<S>(x_(0), y_(0)) - half * (larger_ + smaller_)).hi;
    for (int i = 1; i < N; ++i) {
      φ(i) = (exact_sum<S>(x_(i), y_(i)) - half * (larger_ - smaller_) * e_at(i)).hi;
    }
    return times_power_of_two<S, N>(φ, exponent_);
  }

  /// {∂φ/∂x, ∂φ/∂y}. Where λ₋ = 0 (x and y on one line of the mantle, or 0) or cannot be told from
  /// it, the limit along (x + τ, y + τ), τ ↓ 0: of the products by c₋ remain c₋ᵀ/√2 each.
  [[nodiscard]] std::pair<matrix_type, matrix_type> slants() const {
    using std::sqrt;
    S const root = sqrt(S(0.5)), a = larger_.hi, b = smaller_.hi;
    std::pair<matrix_type, matrix_type> result{matrix_type::Identity(), matrix_type::Identity()};
    if (a == S(0)) {
      result.first *= S(1) - root;
      result.second *= S(1) - root;
      return result;
    }
    vector_type e, plus, minus;
    e(0) = S(0);
    for (int i = 1; i < N; ++i) e(i) = e_at(i).hi;
    plus = root * e;
    minus = -plus;
    plus(0) = minus(0) = root;
    vector_type u = root * minus, v = u;
    if (b > S(4) * std::numeric_limits<S>::epsilon() * a) {
      u = across(x_) / b;
      v = across(y_) / b;
      S const size = u.squaredNorm() + v.squaredNorm();
      if (size > S(1)) {
        u /= S(sqrt(size));
        v /= S(sqrt(size));
      }
    }
    S const mean = S(2) / (a + b);
    auto const subtract = [&](matrix_type& m, vector_type const& p, vector_type const& q) {
      vector_type along = p(0) * plus;  // L_p c₊
      along(0) = root * (p(0) + e.dot(p));
      for (int i = 1; i < N; ++i) along(i) = root * p(i) + p(0) * plus(i);
      m.noalias() -= plus * (along / a).transpose() + minus * q.transpose();
      // 2/(√λ₊ + √λ₋) (0 ⊕ (I − eeᵀ)) L_p
      S const slip = e.dot(p);
      for (int i = 1; i < N; ++i) {
        m(i, 0) -= mean * (p(i) - slip * e(i));
        for (int j = 1; j < N; ++j) {
          m(i, j) -= mean * (p(0) * (S(i == j ? 1 : 0) - e(i) * e(j)));
        }
      }
    };
    subtract(result.first, x_, u);
    subtract(result.second, y_, v);
    return result;
  }

 private:
  using word = double_word<S>;

  /// Component i >= 1 of (0, e).
  [[nodiscard]] word& e_at(int i) { return e_[static_cast<std::size_t>(i - 1)]; }
  [[nodiscard]] word const& e_at(int i) const { return e_[static_cast<std::size_t>(i - 1)]; }

  [[nodiscard]] static int unit(vector_type const& x, vector_type const& y) {
    int const a = binary_exponent(x), b = binary_exponent(y);
    bool const has_x = !all_zero(x), has_y = !all_zero(y);
    return has_x && (!has_y || a > b) ? a : b;
  }

  /// L_p c₋, of which the digits count.
  [[nodiscard]] vector_type across(vector_type const& p) const {
    using std::sqrt;
    S const root = sqrt(S(0.5));
    vector_type q;
    word sum(p(0));
    for (int i = 1; i < N; ++i) {
      sum = sum - e_at(i) * word(p(i));
      q(i) = root * (word(p(i)) - e_at(i) * word(p(0))).hi;
    }
    q(0) = root * sum.hi;
    return q;
  }

  int exponent_;
  vector_type x_, y_;
  std::array<word, N - 1> e_;
  word larger_, smaller_;  // √λ₊, √λ₋
};

}  // namespace slant::detail
