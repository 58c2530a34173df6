// SPDX-License-Identifier: MIT
//
// The Fischer–Burmeister function of the friction cone, contact by contact: for r = F(y), û = G(y),
//
//     Φ(r, û) = D⁻¹ φ(D r, D⁻¹ û),   φ(x, y) = x + y − (x² + y²)^½,   D = diag(1, 1/μ, 1/μ),
//
// squares and root in the Jordan algebra of the second-order cone. D maps the friction cone K_μ to
// {‖x_t‖ <= x_n}, D⁻¹ its dual K_μ* to the same, and rᵀû stays, so
//
//     Φ(r, û) = 0     ⟺     r ∈ K_μ,  û ∈ K_μ*,  rᵀû = 0.
//
// Coulomb friction is F(r) = r, û = ρ times the velocities after de Saxcé's change of variables, in
// units of forces:
//
//     auto F = fischer_burmeister_cone<3>(mu, identity_map(n),
//                                         positive(ρ) * (de_saxce<3>(mu) * affine(W, q)));
//
// Orthotropic friction has D = diag(1, 1/μ₁, 1/μ₂). A direction without friction, μ_i = 0, takes no
// part, Φ_i = r_i: for μ = 0 it is (r_n + û_n − √(r_n² + û_n²), r_t). The sign is that of the
// paper, opposite to slant::fischer_burmeister.
//
// Accuracy and kinks (x² + y² on the boundary of the cone): see
// section jordan fischer burmeister. As for the scalar function the slope at a kink is the limit
// along (x + τ, y + τ), τ ↓ 0.
//
// Source: M. Fukushima, Z.-Q. Luo, P. Tseng, "Smoothing functions for second-order-cone
// complementarity problems", SIAM J. Optim. 12 (2002); strong semismoothness: D. Sun, J. Sun,
// Math. Program. 103 (2005).
#pragma once

#include <slant/base/double_word.hpp>
#include <slant/base/entries.hpp>
#include <slant/base/scaled_norm.hpp>
#include <slant/concepts/bad_input.hpp>
#include <slant/concepts/scalar.hpp>
#include <slant/operators/product.hpp>
#include <slant/operators/sum.hpp>
#include <slant/sets/blocks.hpp>
#include <slant/sets/slants.hpp>
#include <slant/slanting/assembled_operator.hpp>
#include <slant/slanting/parts/pairs.hpp>

#include <Eigen/Core>

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <type_traits>
#include <utility>

namespace slant::detail {

// --- jordan fischer burmeister -------------------------------------------------------------------
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

// --- blockwise pair ------------------------------------------------------------------------------
//
// Functions of two slanting functions, block by block: y ↦ κ_i(F(y)_i, G(y)_i), and their chain
// rule P F° + Q G° with block diagonal P and Q.

/// P A + Q B.
struct block_weighted_rule {
  template <class P, class Q, class A, class B>
  [[nodiscard]] auto operator()(P const& p, Q const& q, A const& a, B const& b) const {
    using left = product_operator<P const&, A const&>;
    using right = product_operator<Q const&, B const&>;
    return sum_operator<left, right>(held<left>(left(p, a)), held<right>(right(q, b)));
  }
};

/// κ has `dimension` N, `scalar`, value(a, b) → N numbers, slants(a, b) → {∂κ/∂a, ∂κ/∂b} and
/// with(parameters…).
template <class Kernel, class F, class G>
class blockwise_pair : public evaluated_pair<F, G> {
  using pair = evaluated_pair<F, G>;
  static constexpr int n = Kernel::dimension;
  using scalar = typename Kernel::scalar;
  using blocks_type = block_diagonal_slant<scalar, n, consecutive, false, law_set{}>;

 public:
  using pair::left;
  using pair::right;
  using pair::rows;

  /// @throws bad_input unless F and G have the sizes of the list.
  blockwise_pair(listed_blocks<Kernel> kernels, held<F> f, held<G> g)
      : pair(std::move(f), std::move(g)), kernels_(std::move(kernels)) {
    require_equal_sizes("f.rows()", rows(), n * kernels_.size(), "the components of all blocks");
  }

  /// New parameters for all blocks; does not allocate.
  template <class... Params>
    requires takes_parameters<Kernel, Params...>
  void update(Params const&... params) {
    kernels_.update(params...);
  }

  template <class Y, class V, class W>
    requires pair::template
  usable<plain_t<Y>> void value(Y const& y, V& v, W& w) const {
    this->evaluate_parts(y, w);
    for_each(w, [&](auto const& kernel, index i, auto const& a, auto const& b) {
      place_of(i).put(slant::local(v), kernel.value(a, b));
    });
  }
  template <class Y>
    requires pair::template
  usable<plain_t<Y>> [[nodiscard]] auto slant(Y const& y) const {
    auto w = this->workspace(y);
    this->evaluate_parts(y, w);
    assembled_operator s(block_weighted_rule{}, blocks_type(kernels_.size()),
                         blocks_type(kernels_.size()), left().slant(y), right().slant(y));
    set_slants(s, w);
    return s;
  }
  template <class Y, class S, class W>
  void slant(Y const& y, S& s, W& w) const {
    this->evaluate_parts(y, w);
    slant_after_value(y, s, w);
  }
  template <class Y, class S, class W>
  void slant_after_value(Y const& y, S& s, W& w) const {
    set_slants(s, w);
    this->update_parts(y, s, w);
  }

 private:
  [[nodiscard]] auto place_of(index i) const {
    return block_place<n, consecutive>(i, kernels_.size());
  }
  /// f(kernel, number, its part of F(y), its part of G(y)).
  template <class W, class Function>
  void for_each(W const& w, Function const& f) const {
    for (index i = 0; i < kernels_.size(); ++i) {
      f(kernels_[i], i, place_of(i).value(w.f), place_of(i).value(w.g));
    }
  }
  template <class S, class W>
  void set_slants(S& s, W const& w) const {
    for_each(w, [&](auto const& kernel, index i, auto const& a, auto const& b) {
      auto const [at_f, at_g] = kernel.slants(a, b);
      s.template part<0>().assign(i, at_f);
      s.template part<1>().assign(i, at_g);
    });
  }

  listed_blocks<Kernel> kernels_;
};

}  // namespace slant::detail

namespace slant {

// --- fischer burmeister cone ---------------------------------------------------------------------

namespace detail {

/// Φ of one contact with N components, normal first.
template <int N, class S>
class friction_fischer_burmeister {
 public:
  using scalar = S;
  static constexpr int dimension = N;
  using vector_type = Eigen::Matrix<S, N, 1>;
  using matrix_type = Eigen::Matrix<S, N, N>;

  friction_fischer_burmeister() : mu_(vector_type::Ones()) {}

  [[nodiscard]] friction_fischer_burmeister with(S const& mu) const {
    friction_fischer_burmeister other;
    other.mu_.template tail<N - 1>().setConstant(checked("mu", mu));
    return other;
  }
  [[nodiscard]] friction_fischer_burmeister with(S const& mu1, S const& mu2) const
    requires(N == 3)
  {
    friction_fischer_burmeister other;
    other.mu_(1) = checked("mu1", mu1);
    other.mu_(2) = checked("mu2", mu2);
    return other;
  }

  [[nodiscard]] vector_type value(vector_type const& r, vector_type const& u) const {
    if (!all_finite(r) || !all_finite(u)) return vector_type::Constant(not_a_number<S>());
    int e = 0;
    vector_type φ = in_algebra(r, u, e).value();
    φ(0) = times_power_of_two<S>(φ(0), e);
    for (int i = 1; i < N; ++i) {
      int const k = binary_exponent<S>(mu_(i));
      S const m = times_power_of_two<S>(mu_(i), -k);
      φ(i) = mu_(i) == S(0) ? r(i) : times_power_of_two<S>(m * φ(i), k + e);
    }
    return φ;
  }

  /// {∂Φ/∂r, ∂Φ/∂û}.
  [[nodiscard]] std::pair<matrix_type, matrix_type> slants(vector_type const& r,
                                                           vector_type const& u) const {
    if (!all_finite(r) || !all_finite(u)) {
      matrix_type const bad = matrix_type::Constant(not_a_number<S>());
      return {bad, bad};
    }
    int e = 0;
    auto g = in_algebra(r, u, e).slants();
    for (int i = 1; i < N; ++i) {  // D⁻¹ P D and D⁻¹ Q D⁻¹
      g.first.row(i) *= mu_(i);
      g.second.row(i) *= mu_(i);
      g.second.col(i) *= mu_(i);
      if (mu_(i) > S(0)) {
        g.first.col(i) /= mu_(i);
      } else {
        g.first.col(i).setZero();
        g.first(i, i) = S(1);
      }
    }
    return g;
  }

 private:
  using jordan = jordan_fischer_burmeister<S, N>;

  [[nodiscard]] static S const& checked(char const* name, S const& mu) {
    if (!(mu >= S(0) && is_finite(mu))) {
      throw bad_input(name, show(mu), "a finite number >= 0");
    }
    return mu;
  }
  /// φ at x = D r, y = D⁻¹ û in units of 2^e, in which they are numbers for every μ; a direction
  /// without friction takes no part.
  [[nodiscard]] jordan in_algebra(vector_type const& r, vector_type const& u, int& e) const {
    int k[N], l[N];  // exponents of the components of x and y
    bool any = false;
    auto const include = [&](S const& v, int exponent) {
      if (v != S(0) && (!any || exponent > e)) {
        e = exponent;
        any = true;
      }
    };
    for (int i = 0; i < N; ++i) {
      int const of_mu = i == 0 ? 0 : binary_exponent<S>(mu_(i));
      k[i] = binary_exponent<S>(r(i)) - of_mu;
      l[i] = binary_exponent<S>(u(i)) + of_mu;
      if (mu_(i) == S(0)) continue;
      include(r(i), k[i]);
      include(u(i), l[i]);
    }
    vector_type x, y;
    for (int i = 0; i < N; ++i) {
      S const m = i == 0 ? S(1) : times_power_of_two<S>(mu_(i), -binary_exponent<S>(mu_(i)));
      S const a = times_power_of_two<S>(r(i), -binary_exponent<S>(r(i)));
      S const b = times_power_of_two<S>(u(i), -binary_exponent<S>(u(i)));
      x(i) = m > S(0) ? times_power_of_two<S>(a / m, k[i] - e) : S(0);
      y(i) = times_power_of_two<S>(b * m, l[i] - e);
    }
    return jordan(x, y);
  }

  vector_type mu_;  // (1, μ₁, …)
};

}  // namespace detail

/// Φ(F, G) of the contacts with the coefficients mu, N components each. F and G are
/// `Function const&` (referenced) or function types (owned).
template <int N, class S, class F, class G>
using fischer_burmeister_cone_map =
    detail::blockwise_pair<detail::friction_fischer_burmeister<N, S>, F, G>;

/// y ↦ Φ(F(y), G(y)) contact by contact, [n, t₁(, t₂)] with N = 2 or 3 components each. Lvalues are
/// referenced. @throws bad_input "mu[3]: got -1, expected a finite number >= 0", or if sizes
/// differ.
template <int N, detail::parameter_list M, slanting_part F, slanting_part G>
[[nodiscard]] auto fischer_burmeister_cone(M const& mu, F&& f, G&& g) {
  using S = std::remove_cvref_t<decltype(detail::parameter_at(mu, 0))>;
  using kernel = detail::friction_fischer_burmeister<N, S>;
  return fischer_burmeister_cone_map<N, S, kept_t<F>, kept_t<G>>(
      detail::listed_blocks<kernel>(kernel{}, mu), std::forward<F>(f), std::forward<G>(g));
}

/// The same for orthotropic friction in space, with coefficients along the two tangents.
template <detail::parameter_list M1, detail::parameter_list M2, slanting_part F, slanting_part G>
[[nodiscard]] auto fischer_burmeister_cone(M1 const& mu1, M2 const& mu2, F&& f, G&& g) {
  using S = std::remove_cvref_t<decltype(detail::parameter_at(mu1, 0))>;
  using kernel = detail::friction_fischer_burmeister<3, S>;
  return fischer_burmeister_cone_map<3, S, kept_t<F>, kept_t<G>>(
      detail::listed_blocks<kernel>(kernel{}, mu1, mu2), std::forward<F>(f), std::forward<G>(g));
}

}  // namespace slant
