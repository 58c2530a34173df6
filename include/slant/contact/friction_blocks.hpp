// SPDX-License-Identifier: MIT
//
// A friction problem contact by contact, in units of its own: what the solvers work on.
//
//     W = ω W′,   q = υ q′,   r = (υ/ω) r′,   u = υ u′,     ω, υ powers of two
//
// with max |W′| and max |q′| in [1, 2), so that no solver meets the units of the data. W′ is kept
// in rows of N × N blocks, those without an entry left out, the diagonal ones apart.
//
// How good r is, is measured twice. The natural map F_ρ = r − P_K(r − ρ (u + μ‖u_t‖ n)), ‖F_ρ‖/ρ
// relative to ‖q‖, is independent of units where every contact has a ρ of its own, 1/ρ the largest
// of |W| in its columns: contacts may be stiffer than others by any factor. For ρ = 1 it is what
// the literature compares (Acary, Brémond and Huber, 2018), but below the rounding of r itself it
// says nothing more. Where μ is large the natural map hardly sees the gaps, −u_n counts as
// −u_n/√(1 + μ²) only: penetration is measured besides.
#pragma once

#include <slant/concepts/checks.hpp>
#include <slant/contact/friction_problem.hpp>
#include <slant/sets/detail/entries.hpp>
#include <slant/sets/detail/scaled_norm.hpp>
#include <slant/sets/detail/scaling.hpp>
#include <slant/sets/second_order_cone.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace slant::contact {

/// The measures of the top of this file, relative to ‖q‖. NaN in one is NaN in `worst`.
template <class S>
struct friction_error {
  /// (‖F_ρ/ρ‖ + ε ‖r/ρ‖) / ‖q‖, with the rounding that hides û where forces are too large; or the
  /// same with 1/ρ = ω for all, should that be larger than what rounding of r makes of it.
  S scaled{};
  S plain{};        ///< ‖F₁‖ / ‖q‖ in the units of the data
  S floor{};        ///< what rounding of r makes of `plain`
  S penetration{};  ///< ‖max(0, −u_n)‖ / ‖q‖

  /// The largest of them, `plain` only as far as it is more than rounding.
  [[nodiscard]] S worst() const {
    S most = scaled;
    for (S const& e : {plain <= floor ? S(0) : plain, penetration}) {
      if (most == most && !(e <= most)) most = e;
    }
    return most;
  }
  /// All at most `tolerance`, `plain` as far as rounding allows.
  [[nodiscard]] bool at_most(S const& tolerance) const {
    return scaled <= tolerance && plain <= std::max(tolerance, floor) && penetration <= tolerance;
  }
};

/// A friction_problem in blocks; see the top of this file. N is its dimension, 2 or 3.
template <int N, scalar S = double>
class friction_blocks {
 public:
  static constexpr int dimension = N;
  using scalar = S;
  using vector_type = Eigen::Matrix<S, Eigen::Dynamic, 1>;
  using block_type = Eigen::Matrix<S, N, N>;
  using part_type = Eigen::Matrix<S, N, 1>;
  using cone_type = second_order_cone<N, S>;

  /// The problem must be valid and of dimension N.
  explicit friction_blocks(friction_problem<S> const& p) : mu_(p.mu) {
    velocity_ = exponent_of(slant::detail::largest_of(p.q));
    q_ = scaled_by(p.q, -velocity_);
    q_norm_ = q_.norm();
    S largest(0);
    for (index j = 0; j < p.W.outerSize(); ++j) {
      for (typename Eigen::SparseMatrix<S>::InnerIterator e(p.W, j); e; ++e) {
        largest = std::max(largest, S(e.value() < S(0) ? -e.value() : e.value()));
      }
    }
    compliance_ = exponent_of(largest);
    collect(p.W);
    measure_units();
    cones_.reserve(std::size_t(contacts()));
    for (index i = 0; i < contacts(); ++i) cones_.emplace_back(mu_[i]);
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
    using std::ldexp;
    using std::sqrt;
    S own(0), common(0), plain(0), penetration(0);
    int const far = 2 * std::numeric_limits<S>::max_exponent / 5;  // squares must not overflow
    S const ρ = ldexp(S(1), std::clamp(compliance_, -far, far));
    S const ε = std::numeric_limits<S>::epsilon();
    S squares(0), largest(0);  // of r/ρ, velocities
    for (index i = 0; i < contacts(); ++i) {
      part_type const x = multiple_of(unit_[i], part_of(r, i));
      squares += slant::detail::dot_of(x, x);
      largest = std::max(largest, slant::detail::largest_of(x));
    }
    S const still = S(4) * ε * (S(2) + largest);
    for (index i = 0; i < contacts(); ++i) {
      part_type const ri = part_of(r, i);
      part_type v = part_of(u, i);
      if (!(v(0) >= S(0))) penetration += v(0) * v(0);
      S const sliding = sqrt(slant::detail::pairwise_squares<N - 1>(v.data() + 1));
      if (!(sliding <= still)) v(0) += mu_[i] * sliding;
      S const square = natural_map(i, multiple_of(unit_[i], ri), v);
      own += square;
      common += unit_[i] == S(1) ? square : natural_map(i, ri, v);
      plain += natural_map(i, ri, multiple_of(ρ, v)) / ρ / ρ;
    }
    S const scaled = (sqrt(own) + ε * sqrt(squares)) / q_norm_;
    S const rounding = S(16) * ε * r.norm() / q_norm_, other = sqrt(common) / q_norm_;
    return {.scaled = other <= rounding || other <= scaled ? scaled : other,
            .plain = sqrt(plain) / q_norm_,
            .floor = rounding / ρ,
            .penetration = sqrt(penetration) / q_norm_};
  }

  /// r and u in the units of the data.
  [[nodiscard]] vector_type force(vector_type const& r) const {
    return scaled_by(r, velocity_ - compliance_);
  }
  [[nodiscard]] vector_type speed(vector_type const& u) const { return scaled_by(u, velocity_); }
  /// r′ of an r in the units of the data.
  [[nodiscard]] vector_type from_force(vector_type const& r) const {
    return scaled_by(r, compliance_ - velocity_);
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
  static vector_type scaled_by(vector_type const& x, int exponent) {
    vector_type y = x;
    for (S& entry : y) entry = slant::detail::times_power_of_two<S>(entry, exponent);
    return y;
  }

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
          S const value = ldexp(e.value(), -compliance_);
          if (value == S(0)) continue;
          index const j = e.col() / N, b = e.col() % N;
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

  /// 1/ρ of the contacts: powers of two, 1 where W has no entry.
  void measure_units() {
    using std::ldexp;
    unit_ = vector_type::Zero(contacts());
    auto const include = [&](index j, block_type const& b) {
      unit_[j] = std::max(unit_[j], slant::detail::largest_of(b));
    };
    for (index i = 0; i < contacts(); ++i) {
      include(i, diagonal(i));
      for_row(i, include);
    }
    for (S& unit : unit_) unit = ldexp(S(1), exponent_of(unit));
  }

  vector_type mu_, q_, unit_;
  S q_norm_{};
  int velocity_ = 0, compliance_ = 0;
  std::vector<index> first_, column_;
  std::vector<block_type> blocks_, diagonal_;
  std::vector<cone_type> cones_;
};

}  // namespace slant::contact
