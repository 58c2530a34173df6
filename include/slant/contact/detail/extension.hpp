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

#include <slant/contact/detail/scene_matrices.hpp>
#include <slant/krylov/unit.hpp>

#include <cmath>
#include <limits>

namespace slant::contact::detail {

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
    v_.setZero(m.K().rows());
    if (m.is_orthogonal) {
      m.add_forces(vector_type(m.inverse_squares.cwiseProduct(d)), v_);
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
    r_.resize(v_.size());
    weight_.resize(v_.size());
    for (index j = 0; j < v_.size(); ++j) {
      S sum(0);
      weight_(j) = S(1);
      for (typename sparse_type::InnerIterator e(K, j); e; ++e) {
        sum -= (e.value() * scale) * v_(e.row());
        if (e.row() == j && e.value() > S(0)) weight_(j) = S(1) / (e.value() * scale);
      }
      r_(j) = sum;
    }
    S energy = -v_.dot(r_), rz(0);
    keep_in_kernel(m, r_);
    for (index k = 0; k < most; ++k) {
      z_ = r_.cwiseProduct(weight_);
      keep_in_kernel(m, z_);
      S const next = r_.dot(z_);
      if (!(next > S(0))) break;
      p_ = k == 0 ? z_ : vector_type(z_ + (next / rz) * p_);
      rz = next;
      for (index j = 0; j < v_.size(); ++j) {
        S sum(0);
        for (typename sparse_type::InnerIterator e(K, j); e; ++e) {
          sum += (e.value() * scale) * p_(e.row());
        }
        z_(j) = sum;
      }
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
    vector_type r = (d / unit).cwiseProduct(scale), q(d.size());
    vector_type s = vector_type::Zero(v_.size()), p;
    m.add_forces(vector_type(r.cwiseProduct(scale)), s);
    p = s;
    S size = s.squaredNorm();
    S const enough = S(1e-16) * size;
    for (index k = 0; k < 200 && size > enough; ++k) {
      for (index i = 0; i < q.size(); ++i) {
        S sum(0);
        for (typename sparse_type::InnerIterator e(m.rows, i); e; ++e) {
          sum += e.value() * p(e.row());
        }
        q(i) = scale(i) * sum;
      }
      S const bend = q.squaredNorm();
      if (!(bend > S(0))) break;
      S const α = size / bend;
      v_ += α * p;
      r -= α * q;
      s.setZero();
      m.add_forces(vector_type(r.cwiseProduct(scale)), s);
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
