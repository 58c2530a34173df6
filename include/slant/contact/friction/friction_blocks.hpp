// SPDX-License-Identifier: MIT
//
// A friction problem contact by contact, in units of its own: what the solvers work on.
//
//     W = D W′ D,   q = υ D q′,   r = υ D⁻¹ r′,   u = υ D u′,
//
// υ and D powers of two, D with one entry for each contact: max |q′| in [1, 2) and the largest
// |entry| of each W′_ii in [1, 4), so that no solver meets the units of the data, nor those of a
// contact. W′ is kept in rows of N × N blocks, those without an entry left out, the diagonal ones
// apart.
//
// How good r is, is measured by the unit-free natural map of verify.hpp, and by that of the
// literature, ρ = 1 in the units of the data, which below the rounding of r itself says nothing
// more. Where μ is large the natural map hardly sees the gaps, −u_n counts as −u_n/√(1 + μ²) only:
// penetration is measured besides.
#pragma once

#include <slant/base/entries.hpp>
#include <slant/base/scaling.hpp>
#include <slant/concepts/iterative_method.hpp>
#include <slant/contact/friction/friction_problem.hpp>
#include <slant/sets/second_order_cone.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace slant::contact {

/// The measures of the top of this file. NaN in one is NaN in `worst`.
template <class S>
struct friction_error {
  /// ‖√w (r − P_K(r − û/w))‖ / ‖q/√w‖; of the solvers, with the rounding that hides û where forces
  /// are too large, ε ‖√w r‖ / ‖q/√w‖.
  S scaled{};
  S plain{};        ///< ‖r − P_K(r − û)‖ / ‖q‖ in the units of the data
  S floor{};        ///< what rounding of r makes of `plain`
  S penetration{};  ///< ‖max(0, −u_n)/√w‖ / ‖q/√w‖

  /// The larger of those without units; a NaN in `plain` is one here too.
  [[nodiscard]] S worst() const {
    S const most = !(penetration <= scaled) && scaled == scaled ? penetration : scaled;
    return plain == plain ? most : plain;
  }
  /// Those without units at most `tolerance`, and `plain` a number.
  [[nodiscard]] bool at_most(S const& tolerance) const { return worst() <= tolerance; }
};

/// What the states of friction_gauss_seidel and friction_interior_point have in common.
template <class S>
struct friction_iterate {
  using vector_type = Eigen::VectorX<S>;
  vector_type x{};            ///< forces, in the units of the blocks
  vector_type u{};            ///< W x + q
  friction_error<S> error{};  ///< of x
  vector_type best{};         ///< the x with the smallest error so far
  friction_error<S> best_error{};
  index iteration = 0;    ///< steps
  index evaluations = 0;  ///< of the error: a product by W each
  index since_best = 0;   ///< steps
  slant::status status = slant::status::running;
};

/// A friction_problem in blocks; see the top of this file. N is its dimension, 2 or 3.
template <int N, scalar S = double>
class friction_blocks {
 public:
  static constexpr int dimension = N;
  using scalar = S;
  using vector_type = Eigen::VectorX<S>;
  using block_type = Eigen::Matrix<S, N, N>;
  using part_type = Eigen::Matrix<S, N, 1>;
  using cone_type = second_order_cone<N, S>;

  /// The problem must be valid and of dimension N.
  explicit friction_blocks(friction_problem<S> const& p) : mu_(p.mu) {
    measure_units(p.W);
    int highest = -std::numeric_limits<int>::max();
    for (index k = 0; k < p.q.size(); ++k) {
      S const size = p.q[k] < S(0) ? -p.q[k] : p.q[k];
      if (size > S(0)) highest = std::max(highest, exponent_of(size) - half(k / N));
    }
    velocity_ = highest == -std::numeric_limits<int>::max() ? 0 : highest;
    q_ = scaled_by(p.q, -velocity_, -1);
    collect(p.W);
    cones_.reserve(std::size_t(contacts()));
    for (index i = 0; i < contacts(); ++i) cones_.emplace_back(mu_[i]);
    S own(0), plain(0);
    for (index i = 0; i < contacts(); ++i) {
      part_type const x = part_of(q_, i);
      S const square = slant::detail::dot_of(x, x);
      own += square / unit_[i];
      plain += plain_weight(i) * plain_weight(i) * square;
    }
    using std::sqrt;
    q_norm_ = sqrt(own);
    plain_norm_ = sqrt(plain);
  }

  [[nodiscard]] index contacts() const { return mu_.size(); }
  [[nodiscard]] index size() const { return q_.size(); }
  /// Blocks of W that hold an entry.
  [[nodiscard]] index block_count() const { return index(blocks_.size()) + contacts(); }
  [[nodiscard]] vector_type const& q() const { return q_; }
  [[nodiscard]] S q_norm() const { return q_norm_; }
  [[nodiscard]] S mu(index i) const { return mu_[i]; }
  [[nodiscard]] cone_type const& cone(index i) const { return cones_[std::size_t(i)]; }
  [[nodiscard]] block_type const& diagonal(index i) const { return diagonal_[std::size_t(i)]; }
  /// f(j, W_ij) for the blocks of row i beside the diagonal.
  template <class F>
  void for_row(index i, F&& f) const {
    for (index k = first_[std::size_t(i)]; k < first_[std::size_t(i) + 1]; ++k) {
      f(column_[std::size_t(k)], blocks_[std::size_t(k)]);
    }
  }

  /// u = W r + q.
  void velocity(vector_type const& r, vector_type& u) const {
    multiply(r, u);
    for (index k = 0; k < size(); ++k) u[k] += q_[k];
  }
  /// y = W x.
  void multiply(vector_type const& x, vector_type& y) const {
    for (index i = 0; i < contacts(); ++i) {
      part_type sum = slant::detail::product_of(diagonal(i), part_of(x, i));
      for_row(i, [&](index j, block_type const& b) {
        slant::detail::add_product(b, x.data() + N * j, sum);
      });
      put(sum, i, y);
    }
  }

  /// Of contact i in a vector of all of them.
  [[nodiscard]] static part_type part_of(vector_type const& x, index i) {
    return slant::detail::entries_at<N>(x.data() + N * i);
  }
  static void put(part_type const& part, index i, vector_type& x) {
    slant::detail::put_entries(part, x.data() + N * i);
  }
  /// How good r is, u = velocity(r). Sliding slower than the rounding of u is none: times a large
  /// μ it would hide every sticking contact.
  [[nodiscard]] friction_error<S> error(vector_type const& r, vector_type const& u) const {
    using slant::detail::multiple_of;
    using std::sqrt;
    S own(0), plain(0), penetration(0), rounding(0);
    S const ε = std::numeric_limits<S>::epsilon();
    S squares(0), largest(0);  // of √w r; of w r, velocities
    for (index i = 0; i < contacts(); ++i) {
      part_type const ri = part_of(r, i), x = multiple_of(unit_[i], ri);
      S const square = slant::detail::dot_of(ri, ri);
      squares += unit_[i] * square;
      largest = std::max(largest, slant::detail::largest_of(x));
      rounding += square / plain_weight(i) / plain_weight(i);
    }
    S const still = S(4) * ε * (S(2) + largest);
    for (index i = 0; i < contacts(); ++i) {
      part_type const ri = part_of(r, i);
      part_type v = part_of(u, i);
      if (!(v(0) >= S(0))) penetration += v(0) * v(0) / unit_[i];
      S const sliding = sqrt(slant::detail::pairwise_squares<N - 1>(v.data() + 1));
      if (!(sliding <= still)) v(0) += mu_[i] * sliding;
      own += natural_map(i, multiple_of(unit_[i], ri), v) / unit_[i];
      // r = D⁻¹ r′ and u = D u′ have F = D⁻¹ (r′ − P_K(r′ − D² û′)); a part of D is in ‖q‖.
      plain += natural_map(i, ri, multiple_of(ldexp_within(2 * half(i)), v)) / plain_weight(i) /
               plain_weight(i);
    }
    S const data = ldexp_within(-2 * highest_);
    return {.scaled = (sqrt(own) + ε * sqrt(squares)) / q_norm_,
            .plain = sqrt(plain) / plain_norm_ * data,
            .floor = S(16) * ε * sqrt(rounding) / plain_norm_ * data,
            .penetration = sqrt(penetration) / q_norm_};
  }

  /// r and u in the units of the data.
  [[nodiscard]] vector_type force(vector_type const& r) const {
    return scaled_by(r, velocity_, -1);
  }
  [[nodiscard]] vector_type speed(vector_type const& u) const { return scaled_by(u, velocity_, 1); }
  /// r′ of an r in the units of the data.
  [[nodiscard]] vector_type from_force(vector_type const& r) const {
    return scaled_by(r, -velocity_, 1);
  }

 private:
  /// ‖r − P_K(r − v)‖²; of v itself, not of what is left of it, where r − v is in K.
  S natural_map(index i, part_type const& r, part_type const& v) const {
    using slant::detail::combination;
    part_type const z = combination(S(1), r, S(-1), v), p = cone(i).project(z);
    bool const inside = slant::detail::all_zero(combination(S(1), z, S(-1), p));
    part_type const rest = inside ? v : combination(S(1), r, S(-1), p);
    return slant::detail::dot_of(rest, rest);
  }
  /// e with x in [2ᵉ, 2ᵉ⁺¹); 0 for 0.
  static int exponent_of(S const& x) {
    return x > S(0) ? slant::detail::binary_exponent(x) - 1 : 0;
  }
  /// 2ᵉ Dˢ x.
  [[nodiscard]] vector_type scaled_by(vector_type const& x, int e, int s) const {
    vector_type y = x;
    for (index k = 0; k < y.size(); ++k) {
      y[k] = slant::detail::times_power_of_two<S>(y[k], e + s * half(k / N));
    }
    return y;
  }
  /// 2ᵉ, as far as its square is a number.
  [[nodiscard]] static S ldexp_within(int e) {
    using std::ldexp;
    constexpr int far = 2 * std::numeric_limits<S>::max_exponent / 5;
    return ldexp(S(1), std::clamp(e, -far, far));
  }
  /// D over its largest entry.
  [[nodiscard]] S plain_weight(index i) const { return ldexp_within(half(i) - highest_); }
  [[nodiscard]] int half(index i) const { return half_[std::size_t(i)]; }

  void collect(Eigen::SparseMatrix<S> const& W) {
    using std::ldexp;
    index const m = contacts();
    Eigen::SparseMatrix<S, Eigen::RowMajor> const rows = W;
    block_type const zero = block_type::Zero();
    diagonal_.assign(std::size_t(m), zero);
    first_.assign(1, 0);
    std::vector<index> place(std::size_t(m), -1);
    for (index i = 0; i < m; ++i) {
      index const begin = index(column_.size());
      for (int a = 0; a < N; ++a) {
        for (typename Eigen::SparseMatrix<S, Eigen::RowMajor>::InnerIterator e(rows, N * i + a); e;
             ++e) {
          index const j = e.col() / N, b = e.col() % N;
          S const value = ldexp(e.value(), -half(i) - half(j));
          if (value == S(0)) continue;
          if (j == i) {
            diagonal_[std::size_t(i)](a, b) += value;
            continue;
          }
          auto& at = place[std::size_t(j)];
          if (at < begin) {
            at = index(column_.size());
            column_.push_back(j);
            blocks_.push_back(zero);
          }
          blocks_[std::size_t(at)](a, b) += value;
        }
      }
      first_.push_back(index(column_.size()));
    }
  }

  /// D = 2^half, and w of the contacts in its units.
  void measure_units(Eigen::SparseMatrix<S> const& W) {
    unit_ = detail::compliances(W, contacts());
    half_.assign(std::size_t(contacts()), 0);
    highest_ = contacts() > 0 ? -std::numeric_limits<S>::max_exponent : 0;
    for (index i = 0; i < contacts(); ++i) {
      S& w = unit_[i];
      int const e = exponent_of(w);
      int& h = half_[std::size_t(i)];
      h = e >= 0 ? e / 2 : -((1 - e) / 2);
      w = slant::detail::times_power_of_two<S>(w, -2 * h);
      highest_ = std::max(highest_, h);
    }
  }

  vector_type mu_, q_, unit_;
  S q_norm_{}, plain_norm_{};  // ‖q/√w‖; ‖q‖ over the largest entry of D
  int velocity_ = 0, highest_ = 0;
  std::vector<int> half_;  // exponents of D
  std::vector<index> first_, column_;
  std::vector<block_type> blocks_, diagonal_;
  std::vector<cone_type> cones_;
};

}  // namespace slant::contact
