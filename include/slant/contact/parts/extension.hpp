// SPDX-License-Identifier: MIT
//
// Displacements v of a body with B v = d given, of little energy: since
//
//     ‖d‖_{A⁻¹} = min { ‖v‖_K : B v = d },         A = B K⁻¹Bᵀ,
//
// the energy of every one bounds ‖d‖_{A⁻¹} from above, without a solve with K.
//
//     by zero    v = Bᵀ(BBᵀ)⁻¹d, which moves nothing but the unknowns of the contacts
//     relaxed    steps of conjugate gradients for ‖v + p‖_K → min, p ∈ ker B, preconditioned by
//                diag(K)⁻¹. Each lets one more layer of elements follow: what is left of the
//                reduced gradient at the end of a run is rough, and its harmonic extension decays
//                within a few layers.
//
// Cost: a product with the columns of K at the contacts, by zero; one with K for each step.
#pragma once

#include <slant/base/double_word.hpp>
#include <slant/base/scaling.hpp>
#include <slant/contact/contact_data.hpp>

#include <Eigen/SparseCore>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace slant::contact::detail {

// --- scene matrices ------------------------------------------------------------------------------
//
// K, B = [N; T] and what is read off them once: lengths and independence of the rows of B, bounds
// of ‖K‖ and ‖B‖, the stiffness that acts on each multiplier, and energies vᵀK v with what rounding
// may have taken from them.

/// start − Σᵢ M_ij xᵢ in doubled precision, M column by column.
template <class S, class V>
[[nodiscard]] slant::detail::double_word<S> minus_column(Eigen::SparseMatrix<S> const& M, index j,
                                                         V const& x,
                                                         slant::detail::double_word<S> sum) {
  for (typename Eigen::SparseMatrix<S>::InnerIterator e(M, j); e; ++e) {
    sum = sum - slant::detail::exact_product<S>(e.value(), x(e.row()));
  }
  return sum;
}

/// Refers to K.
template <class S>
class scene_matrices {
 public:
  using vector_type = Eigen::VectorX<S>;
  using sparse_type = Eigen::SparseMatrix<S>;

  scene_matrices(sparse_type const& K, data<S> const& c)
      : B(stacked_constraints(c)), rows(B.transpose()), K_(&K) {
    index const n = B.rows(), m = K.rows();
    vector_type v = vector_type::Zero(m);
    inverse_squares.setZero(n);
    stiffness.setConstant(n, std::numeric_limits<S>::infinity());
    vector_type const squares = row_squares(B);
    touched = touched_unknowns(B);
    for (index j = 0; j < m; ++j) {
      all.push_back(j);
      longest = std::max<index>(longest, K.col(j).nonZeros());
      largest = std::max<S>(largest, K.col(j).cwiseAbs().sum());
    }
    for (index i = 0; i < n; ++i) {
      if (squares(i) > S(0)) inverse_squares(i) = S(1) / squares(i);
      longest = std::max<index>(longest, rows.col(i).nonZeros());
      size_of_B = std::max<S>(size_of_B, squares(i));
    }
    using std::sqrt;
    S const eps = std::numeric_limits<S>::epsilon();
    tiny = S(8 * (longest + 4)) * eps * eps;
    largest *= S(1) + S(4 * (longest + 4)) * eps;
    // ‖B‖₂ ≤ ‖B‖_F, and here twice the longest row where rows are orthogonal.
    size_of_B = S(2) * sqrt(size_of_B);
    // BBᵀ: orthogonal rows have nothing but rounding off the diagonal.
    sparse_type const gram = B * rows;
    slant::detail::for_each_entry(gram, [&](index i, index j, S const& value) {
      using std::abs;
      S const cosine = abs(value) * sqrt(inverse_squares(j)) * sqrt(inverse_squares(i));
      if (i != j && cosine > S(8) * eps) is_orthogonal = false;
    });
    // m_i = diag of D B K BᵀD.
    for (index i = 0; i < n; ++i) {
      if (!(inverse_squares(i) > S(0))) continue;
      S sum(0);
      for (typename sparse_type::InnerIterator e(rows, i); e; ++e) v(e.row()) = e.value();
      for (typename sparse_type::InnerIterator e(rows, i); e; ++e) {
        for (typename sparse_type::InnerIterator k(K, e.row()); k; ++k) {
          sum += e.value() * k.value() * v(k.row());
        }
      }
      for (typename sparse_type::InnerIterator e(rows, i); e; ++e) v(e.row()) = S(0);
      stiffness(i) = inverse_squares(i) * (inverse_squares(i) * sum);
    }
  }

  [[nodiscard]] sparse_type const& K() const { return *K_; }

  sparse_type B, rows;            ///< B and Bᵀ
  vector_type inverse_squares{};  ///< 1/‖row‖² of B; 0 for empty rows
  vector_type
      stiffness{};  ///< diag of (BBᵀ)⁻¹B K Bᵀ(BBᵀ)⁻¹ if rows are orthogonal; ∞ for empty rows
  std::vector<index> touched{};  ///< unknowns that B acts on
  std::vector<index> all{};      ///< all unknowns
  index longest = 0;             ///< entries in a row of K or of B
  S size_of_B{0};  ///< twice the length of the longest row: ≥ ‖B‖₂ if they are orthogonal
  S largest{0};    ///< ≥ λ_max(K): the largest sum of moduli in a row
  S tiny{0};       ///< rounding of a sum of so many terms in doubled precision
  bool is_orthogonal = true;  ///< rows of B, up to rounding

  /// vᵀK v in units of its own, and what rounding may have taken from it.
  struct square {
    S sum{0}, lost{0}, unit{1}, unit_of_K{1};
  };
  /// v is zero but at these unknowns; note(j, (K v)_j) is called for them. `scaled` is a temporary.
  template <class Note>
  [[nodiscard]] square energy(vector_type const& v, std::vector<index> const& unknowns,
                              vector_type& scaled, Note const& note) const {
    using std::abs;
    square q;
    q.unit = unit_near(S(v.stableNorm()));
    q.unit_of_K = unit_near(largest);
    S const scale_of_K = S(1) / q.unit_of_K;
    scaled = v / q.unit;
    S part(0), moduli(0);
    constexpr index length_of_part = 256;
    index count = 0;
    for (index j : unknowns) {
      S column(0), size(0);
      for (typename sparse_type::InnerIterator e(K(), j); e; ++e) {
        S const term = (e.value() * scale_of_K) * scaled(e.row());
        column += term;
        size += abs(term);
      }
      note(j, S(column * q.unit * q.unit_of_K));
      part += column * scaled(j);
      moduli += size * abs(scaled(j));
      if (++count % length_of_part != 0) continue;
      q.sum += part;
      part = S(0);
    }
    q.sum += part;
    index const terms = length_of_part + count / length_of_part + longest + 8;
    q.lost = S(2 * terms) * std::numeric_limits<S>::epsilon() * moduli;
    return q;
  }
  [[nodiscard]] static S root(S const& sum, square const& q) {
    using std::sqrt;
    if (!(sum > S(0))) return sum == sum ? S(0) : sum;
    return sqrt(sum) * q.unit * sqrt(q.unit_of_K);
  }
  /// ‖v‖_K from above.
  [[nodiscard]] S most_energy(vector_type const& v, std::vector<index> const& unknowns,
                              vector_type& scaled) const {
    auto const q = energy(v, unknowns, scaled, [](index, S const&) {});
    return root(S(q.sum + q.lost), q);
  }

 private:
  sparse_type const* K_;
};

// --- extension -----------------------------------------------------------------------------------

/// v and its energy, for the matrices m that each call is given.
template <class S>
class extension {
 public:
  using vector_type = typename scene_matrices<S>::vector_type;
  using sparse_type = typename scene_matrices<S>::sparse_type;
  using matrices = scene_matrices<S>;

  /// ‖v‖_K of the shortest v with B v = d; ∞ where d acts on an empty row. What is left of d where
  /// rows depend on each other is counted as moved by its nodes alone: an estimate.
  [[nodiscard]] S by_zero(matrices const& m, vector_type const& d) {
    energy_ = std::numeric_limits<S>::infinity();
    for (index i = 0; i < d.size(); ++i) {
      if (m.inverse_squares(i) == S(0) && d(i) != S(0)) return energy_;
    }
    if (m.is_orthogonal) {
      v_ = m.rows * m.inverse_squares.cwiseProduct(d);
    } else {
      least_squares(m, d);
    }
    measure_tail(m, d);
    energy_ = m.most_energy(v_, m.touched, scaled_) + tail(m);
    return energy_;
  }

  /// The same after by_zero(m, d), in at most `most` relaxations: fewer if one of them takes less
  /// than a fiftieth of the energy, or brings the norm below `enough`, or shows that all will not.
  /// Where rows of B depend on each other nothing is relaxed.
  [[nodiscard]] S relaxed(matrices const& m, vector_type const& d, index most, S const& enough) {
    using std::sqrt;
    if (!m.is_orthogonal || !(energy_ > enough) || !slant::detail::is_finite(energy_)) {
      return energy_;
    }
    S const unit = unit_near(S(v_.stableNorm())), scale = S(1) / unit_near(m.largest);
    v_ /= unit;
    S const limit = enough / unit * sqrt(scale), goal = limit > S(0) ? S(limit * limit) : S(0);
    auto const& K = m.K();
    // r = −P K v, z = P diag(K)⁻¹r, P the projector onto ker B.
    auto const multiply = [&](vector_type const& x, vector_type& y) {  // y = scale K x
      y.resize(x.size());
      for (index j = 0; j < x.size(); ++j) {
        S sum(0);
        for (typename sparse_type::InnerIterator e(K, j); e; ++e) {
          sum += (e.value() * scale) * x(e.row());
        }
        y(j) = sum;
      }
    };
    multiply(v_, r_);
    r_ = -r_;
    weight_ = K.diagonal();
    for (S& own : weight_) own = own > S(0) ? S(S(1) / (own * scale)) : S(1);
    S energy = -v_.dot(r_), rz(0);
    keep_in_kernel(m, r_);
    for (index k = 0; k < most; ++k) {
      z_ = r_.cwiseProduct(weight_);
      keep_in_kernel(m, z_);
      S const next = r_.dot(z_);
      if (!(next > S(0))) break;
      p_ = k == 0 ? z_ : vector_type(z_ + (next / rz) * p_);
      rz = next;
      multiply(p_, z_);
      S const bend = p_.dot(z_);
      if (!(bend > S(0))) break;
      S const α = rz / bend, gain = α * rz;
      v_ += α * p_;
      energy -= gain;
      if (!(gain > S(0.02) * energy) || energy <= goal) break;
      // Not even if all that follow take as much as this one.
      if (goal > S(0) && energy - S(static_cast<double>(most - 1 - k)) * gain > goal) break;
      r_ -= α * z_;
      keep_in_kernel(m, r_);
    }
    v_ *= unit;
    measure_tail(m, d);
    S const value = m.most_energy(v_, m.all, scaled_) + tail(m);
    if (value < energy_) energy_ = value;
    return energy_;
  }

  /// ‖·‖_K of what v has left of d, at most: part of what by_zero and relaxed return.
  [[nodiscard]] S tail(matrices const& m) const {
    using std::sqrt;
    return rest_ == S(0) ? S(0) : S(S(2) * rest_ * sqrt(m.largest));
  }

 private:
  /// d − B v in units in which every row has the length 1; with the rounding of B v.
  void measure_tail(matrices const& m, vector_type const& d) {
    using std::sqrt;
    S const eps = std::numeric_limits<S>::epsilon();
    left_.resize(d.size());
    for (index i = 0; i < d.size(); ++i) {
      left_(i) = minus_column<S>(m.rows, i, v_, d(i)).hi * sqrt(m.inverse_squares(i));
    }
    rest_ = left_.stableNorm() * (S(1) + S(4) * eps);
    rest_ += m.tiny * sqrt(S(static_cast<double>(d.size()))) * v_.stableNorm();
  }

  /// x ← x − Bᵀ(BBᵀ)⁻¹B x, for orthogonal rows.
  static void keep_in_kernel(matrices const& m, vector_type& x) {
    for (index i = 0; i < m.rows.cols(); ++i) {
      S sum(0);
      for (typename sparse_type::InnerIterator e(m.rows, i); e; ++e) sum += e.value() * x(e.row());
      sum *= m.inverse_squares(i);
      for (typename sparse_type::InnerIterator e(m.rows, i); e; ++e) x(e.row()) -= sum * e.value();
    }
  }

  /// v_ of least length among those with the least ‖D(B v − d)‖, D B with rows of length 1:
  /// conjugate gradients for the normal equations, which need no independent rows.
  void least_squares(matrices const& m, vector_type const& d) {
    vector_type const scale = m.inverse_squares.cwiseSqrt();
    S const unit = unit_near(S(d.stableNorm()));
    vector_type r = (d / unit).cwiseProduct(scale), q;
    vector_type s = m.rows * r.cwiseProduct(scale), p = s;
    v_.setZero(s.size());
    S size = s.squaredNorm();
    S const enough = S(1e-16) * size;
    for (index k = 0; k < 200 && size > enough; ++k) {
      q = scale.cwiseProduct(m.B * p);
      S const bend = q.squaredNorm();
      if (!(bend > S(0))) break;
      S const α = size / bend;
      v_ += α * p;
      r -= α * q;
      s = m.rows * r.cwiseProduct(scale);
      S const next = s.squaredNorm();
      p = s + (next / size) * p;
      size = next;
    }
    v_ *= unit;
  }

  vector_type v_{}, left_{}, r_{}, z_{}, p_{}, weight_{}, scaled_{};
  S rest_{0}, energy_{0};
};

}  // namespace slant::contact::detail
