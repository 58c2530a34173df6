// SPDX-License-Identifier: MIT
//
// The error of a solution of contact with Tresca friction, in the energy norm, from K, the contact
// data, (λ, u) and solves with K: a bound that knows neither the method nor its stopping rule.
//
//     λ ∈ Λ,   u(λ) = K⁻¹(f − Bᵀλ),   A = B K⁻¹Bᵀ,   ‖λ − λ*‖_A = ‖u(λ) − u*‖_K
//
// The bound of certificates/energy_error.hpp needs the gradient g = A λ − b = c − B u(λ) and norms
// ‖·‖_{A⁻¹}. Both are had from displacements:
//
//     ‖d‖_{A⁻¹} = min { ‖v‖_K : B v = d },     so every v with B v = d gives a bound,
//     u computed, ρ = f − Bᵀλ − K u:           ‖u − u(λ)‖_K = ‖ρ‖_{K⁻¹} ≤ ε
//     g = (c − B u) + B(u − u(λ)):             ‖g − (c − B u)‖_{A⁻¹} ≤ ε
//
//     ‖u − u*‖_K ≤ ½ (δ + ε + √((δ + ε)² + 4γ)) + ε,      δ = ‖(c − B u) − s‖_{A⁻¹}
//
// ε: with w ≈ K⁻¹ρ, ‖ρ‖_{K⁻¹} ≤ ‖w‖_K + ‖ρ − K w‖₂/√λ, λ ≤ λ_min(K); the second term is of second
// order, so that a crude λ does. w is also the correction that refines u where ε is not small.
// δ: v is the shortest with B v = d, which moves nothing but the contacts, and where that does not
// show the goal, relaxed by some products with K towards the harmonic extension
// (parts/extension.hpp). Where that is not enough either, the caller may estimate what is left to
// go by a Newton step (certificates/newton_estimate.hpp), whose rest has such a bound again.
//
// `proven` is said if λ is a proven lower bound (smallest_eigenvalue_bound), the rows of B are
// orthogonal or empty, the gaps of the set are exact and nothing is estimated. Then no sum is
// taken for what it should be (without underflow; ε = 2u, γ_k = k ε):
//
//     ρ, c − B u   in doubled precision, rounded once: off by ε|ρ| + 8 (k + 4) ε² (|f| + |Bᵀ||λ| +
//                  |K||u|) for rows of k entries; |K||u| has at most the length ‖K‖_∞ ‖u‖. ρ in
//                  extended precision (long double) while that shows the goal: 2 (k + 4) ε' for ε²
//     ρ − K w      in plain precision: off by γ_{k+4} (|ρ| + |K||w|)
//     ‖v‖²_K       the computed sum of p products in rows of k entries is off by γ_{p+k+8}
//                  |v|ᵀ|K||v|, which is summed as well: added where ‖v‖_K is a part of the bound,
//                  subtracted where it is the size that the bound is divided by
//     λ ∈ Λ        a computed projection is off by some ε of the radius; what leads to the point λ̂
//                  of the sphere is computed from R² − ‖λ_t‖² in doubled precision and enters ρ
//     s            exactly normal up to γ as in certificates/energy_error.hpp; d = g − s is off by
//                  at most 24 ε|g|, a vector r; ‖r‖_{A⁻¹} ≤ 2 √‖K‖ ‖D r‖, D⁻¹ the lengths of rows
//     γ, ‖·‖₂      positive sums of n terms: all is enlarged by 1 + 8 (n + 64) ε
//
// Without a proof, λ is an estimate from solves at hand; the same terms are added, so that nothing
// is said of digits that rounding has taken.
//
// Cost: one solve with K, one product with K in doubled precision and two in plain one; as much
// again for each refinement of u, and twelve products with K at most to relax v.
#pragma once

#include <slant/base/double_word.hpp>
#include <slant/base/matrix_entries.hpp>
#include <slant/base/scaling.hpp>
#include <slant/certificates/energy_error.hpp>
#include <slant/certificates/newton_estimate.hpp>
#include <slant/concepts/bad_input.hpp>
#include <slant/concepts/linear_operator.hpp>
#include <slant/concepts/vector.hpp>
#include <slant/contact/contact_data.hpp>
#include <slant/contact/parts/extension.hpp>
#include <slant/operators/inverse.hpp>

#include <Eigen/SparseCore>

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>
#include <utility>
#include <vector>

namespace slant::contact {

/// solve(b, x) of a factorisation, as the certificate takes it. Refers to it.
template <class Factorization>
[[nodiscard]] auto solver(Factorization const& factor) {
  return [&factor]<class V>(V const& b, V& x) { slant::detail::solve_once(factor, b, x); };
}
template <class Factorization>
auto solver(Factorization const&&) = delete;

/// A bound λ ≤ λ_min(K), proven by a factorisation: where K − c I has a Cholesky factor in floating
/// point, λ_min(K) ≥ c − γ tr(K), γ = (n + 2)ε/(1 − (n + 2)ε) [Rump, BIT 46 (2006) 433–452,
/// Cor. 2.4]. `factor(matrix)` factors or throws bad_input; guess is an estimate of λ_min(K). 0 if
/// no proof was found, that is if K is too ill-conditioned or the guess too far off.
template <class S, class Factor>
[[nodiscard]] S smallest_eigenvalue_bound(Eigen::SparseMatrix<S> const& K, S const& guess,
                                          Factor const& factor) {
  S const ε = std::numeric_limits<S>::epsilon(), n = S(static_cast<double>(K.rows() + 2));
  S const lost = S(1.1) * n * ε * K.diagonal().sum();
  bool const is_usable = guess > S(0) && slant::detail::is_finite(guess) && lost > S(0);
  if (!is_usable || !(n * ε < S(0.1))) return S(0);
  Eigen::SparseMatrix<S> identity(K.rows(), K.cols());
  identity.setIdentity();
  for (S c = guess / S(4); c > S(2) * lost; c /= S(16)) {
    try {
      factor(Eigen::SparseMatrix<S>(K - c * identity));
      return (c - lost) * (S(1) - S(8) * ε);
    } catch (bad_input const&) {  // not definite: c is too large
    }
  }
  return S(0);
}

/// The certificate of a contact scene; refers to K and the data. λ and u may be anything finite: λ
/// is projected onto Λ, and 0 where a row of T is empty.
template <class S = double>
class certificate {
 public:
  using vector_type = Eigen::VectorX<S>;
  using sparse_type = Eigen::SparseMatrix<S>;

  /// Throws bad_input if the data are not valid (see contact::data::validate) or K does not fit.
  certificate(sparse_type const& K, data<S> const& c)
      : m_((detail::check_scene(K, c), K), c), data_(&c) {}

  /// Looks for a proven lower bound of λ_min(K), by three solves with K and one factorisation of a
  /// matrix with its pattern, more if the first is not definite; see smallest_eigenvalue_bound.
  /// Without it λ_min(K) is estimated. Whether a bound was found.
  template <class Solve, class Factor>
  bool prove(Solve const& solve, Factor const& factor) {
    index const n = m_.K().rows();
    vector_type x(n), y(n);
    for (index i = 0; i < n; ++i) x(i) = S(1) + S((i * 7919) % 101) / S(202);
    S quotient(0);
    for (int k = 0; k < 3; ++k) {
      x /= x.stableNorm();
      solve(x, y);
      ++solves_;
      quotient = S(1) / y.stableNorm();
      note_quotient(quotient, S(1));
      x.swap(y);
    }
    // K may be symmetric up to rounding only; the problem is that of its symmetric part, of which a
    // vector of length 1 misses ½‖K − Kᵀ‖_∞ at most.
    skew_ = slant::detail::largest_row_sum(sparse_type(m_.K() - sparse_type(m_.K().transpose())));
    smallest_ = smallest_eigenvalue_bound(m_.K(), quotient, factor);
    smallest_ = smallest_ > skew_ ? S(smallest_ - skew_) : S(0);
    is_proven_ = smallest_ > S(0);
    return is_proven_;
  }
  /// The lower bound of λ_min(K) in use.
  [[nodiscard]] S smallest_eigenvalue() const { return smallest_; }
  /// Estimate of the condition number of K; 0 before the first certificate.
  [[nodiscard]] S condition() const { return quotient_ > S(0) ? S(m_.largest / quotient_) : S(0); }
  /// m: the stiffness that acts on each multiplier, diag of the lumped preconditioner; ∞ for empty
  /// rows.
  [[nodiscard]] vector_type const& stiffness() const { return m_.stiffness; }
  /// K.
  [[nodiscard]] sparse_type const& matrix() const { return m_.K(); }
  /// Solves with K so far.
  [[nodiscard]] index solves() const { return solves_; }
  /// c − B u of the last certificate: the gradient of the dual problem at λ, up to what the last
  /// correction of u says.
  [[nodiscard]] vector_type const& gradient() const { return g_; }

  /// Tangential positions w from now on, as in load_step: friction opposes T u − w. Empty: 0.
  void set_positions(vector_type w) {
    if (w.size() > 0) slant::detail::check_size("w", w.size(), data_->T.rows());
    positions_ = std::move(w);
  }

  /// Bounds ‖u − u*‖_K. λ ← P_Λ(λ); u ← K⁻¹(f − Bᵀλ), refined as far as `goal`, a relative error,
  /// needs it. solve(b, x) solves K x = b.
  template <class Set, class Solve>
  [[nodiscard]] energy_error<S> operator()(Set const& set, vector_type& λ, vector_type& u,
                                           S const& goal, Solve const& solve) {
    slant::detail::check_size("lambda", λ.size(), m_.B.rows());
    slant::detail::check_size("u", u.size(), m_.K().rows());
    // An empty row of T moves nothing: its force may as well be 0, where none is missing.
    for (index i = data_->nodes(); i < λ.size(); ++i) {
      typename sparse_type::InnerIterator e(m_.rows, i);
      while (e && e.value() == S(0)) ++e;
      if (!e) λ(i) = S(0);
    }
    slant::project(set, λ, λ);
    outward_.setZero(λ.size());
    slant::visit_blocks(set, [&](auto const& block, auto const& p) {
      if constexpr (requires { block.radius(); }) {
        p.put(outward_, to_sphere<S>(p.value(λ), block.radius()));
      }
    });
    error_ = {};
    off_ = recover(λ, u, goal, solve);
    error_.size = size_;
    g_.setConstant(m_.B.rows(), std::numeric_limits<S>::quiet_NaN());
    rest_.setZero(m_.B.rows());
    root_of_gap_ = off_of_rest_ = std::numeric_limits<S>::infinity();
    grown_ = S(1);
    if (!slant::detail::is_finite(off_) || !slant::detail::is_finite(error_.size)) {
      error_.size = S(0);
      return error_;
    }
    lost_.resize(m_.B.rows());
    S const eps = std::numeric_limits<S>::epsilon();
    S const length = u.stableNorm();
    using std::sqrt;
    for (index i = 0; i < g_.size(); ++i) {
      S const start = position(i);
      g_(i) = detail::minus_column<S>(m_.rows, i, u, start).hi;
      using std::abs;
      // |c| + |B||u| ≤ |c| + ‖row‖ ‖u‖; in units in which every row has the length 1.
      S const unit = sqrt(m_.inverse_squares(i));
      lost_(i) = unit * (S(24) * eps * abs(g_(i)) + m_.tiny * abs(start)) +
                 (unit > S(0) ? S(m_.tiny * length) : S(0));
    }
    rest_ = g_;
    auto const balanced = balance(set, λ, g_, m_.stiffness, rest_);
    // Where λ_ν = 0 and the gap is open for certain, s is the exact gradient: however wide the gap
    // is, its rounding is no part of g − s.
    for (index i = 0; i < data_->nodes(); ++i) {
      bool const is_open =
          λ(i) == S(0) && rest_(i) == S(0) && g_(i) * sqrt(m_.inverse_squares(i)) > lost_(i);
      if (is_open) lost_(i) = S(0);
    }
    root_of_gap_ = balanced.root_of_gap;
    grown_ = S(1) + S(8 * (m_.K().rows() + 64)) * eps;
    off_of_rest_ = S(2) * sqrt(m_.largest) * lost_.stableNorm() + off_;
    error_.proven = is_proven_ && balanced.exact && m_.is_orthogonal;
    error_.bound = bound_from(extension_.by_zero(m_, rest_));
    if (!(error_.relative() > goal)) return error_;
    S const δ = extension_.relaxed(m_, rest_, relaxations_, norm_for(goal));
    error_.bound = std::min<S>(error_.bound, bound_from(δ));
    return error_;
  }

  /// d = g − s of the last certificate, whose ‖d‖_{A⁻¹} decides.
  [[nodiscard]] vector_type const& rest() const { return rest_; }
  /// The ‖d‖_{A⁻¹} with which it would show that relative error; may be negative: none.
  [[nodiscard]] S norm_for(S const& goal) const {
    // relative() is a bound over size − 2 bound, or less.
    S const wanted = goal / (S(1) + S(2) * goal) * error_.size / grown_ - off_;
    return wanted - (root_of_gap_ / wanted) * root_of_gap_ - off_of_rest_;
  }
  /// The last certificate, sharper if δ, an estimate of ‖d‖_{A⁻¹}, is smaller than the bound of
  /// it. A δ that is negative or NaN says nothing.
  [[nodiscard]] energy_error<S> const& sharpened(S const& δ) {
    // What no force of the contacts can move is in no range of A.
    return δ >= S(0) ? use_estimate(bound_from(δ + extension_.tail(m_))) : error_;
  }
  /// The same from an estimate of ‖λ − λ*‖_A that takes gradient() for A λ − b.
  [[nodiscard]] energy_error<S> const& estimated(S const& distance) {
    return distance >= S(0) ? use_estimate((distance + off_of_rest_ + off_) * grown_) : error_;
  }
  /// ‖d‖_{A⁻¹} at most, for any d, without a solve; ∞ where d acts on an empty row.
  [[nodiscard]] S extended_norm(vector_type const& d) {
    slant::detail::check_size("d", d.size(), m_.B.rows());
    static_cast<void>(extension_.by_zero(m_, d));
    return extension_.relaxed(m_, d, relaxations_, S(0));
  }

  /// √(vᵀK v).
  [[nodiscard]] S energy_norm(vector_type const& v) {
    auto const q = m_.energy(v, m_.all, scaled_, [](index, S const&) {});
    return m_.root(q.sum, q);
  }

 private:
  /// c_i: the gap, or the tangential position; 0 where the gap is infinite.
  [[nodiscard]] S position(index i) const {
    index const m = data_->nodes();
    if (i >= m) return positions_.size() > 0 ? S(positions_(i - m)) : S(0);
    return slant::detail::is_finite(data_->d(i)) ? S(data_->d(i)) : S(0);
  }

  [[nodiscard]] S bound_from(S const& δ) const {
    return (error_bound_of_root<S>(δ + off_of_rest_, root_of_gap_) + off_) * grown_;
  }
  [[nodiscard]] energy_error<S> const& use_estimate(S const& bound) {
    if (bound < error_.bound) {
      error_.bound = bound;
      error_.proven = false;
    }
    return error_;
  }

  /// ‖u‖_K from K u = t − ρ, both in doubled precision; from below where a proof was asked for.
  [[nodiscard]] S size_of(vector_type const& u) const {
    using std::abs;
    typename detail::scene_matrices<S>::square q;
    q.unit = unit_near(S(u.stableNorm()));
    q.unit_of_K = unit_near(S((load_ - residual_).stableNorm() / q.unit));
    S moduli(0);
    for (index j = 0; j < u.size(); ++j) {
      S const term = (u(j) / q.unit) * ((load_(j) - residual_(j)) / q.unit / q.unit_of_K);
      q.sum += term;
      moduli += abs(term) + abs(u(j) / q.unit) * abs(load_(j) / q.unit / q.unit_of_K);
    }
    if (is_proven_) q.sum -= S(2 * (u.size() + 8)) * std::numeric_limits<S>::epsilon() * moduli;
    return m_.root(q.sum, q);
  }
  /// ε of u, which is refined where that pays; ρ in doubled precision. Sets size_.
  template <class Solve>
  [[nodiscard]] S recover(vector_type const& λ, vector_type& u, S const& goal, Solve const& solve) {
    using std::sqrt;
    S const eps = std::numeric_limits<S>::epsilon();
    S last = std::numeric_limits<S>::infinity();
    auto const finer = static_cast<S>(std::numeric_limits<extended>::epsilon());
    for (vector_type* v : {&residual_, &load_, &image_}) v->resize(u.size());
    // Where the goal is not far, extended precision may do, which is ten times as fast.
    bool is_doubled = !(S(1024) * finer < eps) || goal < S(0x1p22) * eps;
    for (index pass = 0;; ++pass) {
      is_doubled ? residual(λ, u) : extended_residual(λ, u);
      w_.setZero(u.size());
      solve(residual_, w_);
      ++solves_;
      S const load = residual_.stableNorm();
      note_quotient(load, w_.stableNorm());
      size_ = size_of(u);
      auto const energy_of_w =
          m_.energy(w_, m_.all, scaled_, [&](index j, S const& value) { image_(j) = value; });
      S const correction = m_.root(S(energy_of_w.sum + energy_of_w.lost), energy_of_w);
      // ρ − K w, of second order, with what rounding has taken from ρ and from itself.
      S const root_of_smallest = sqrt(smallest());
      S const skew_of_w = skew_ * w_.stableNorm();
      S plain = S(2 * (m_.longest + 8)) * eps * (load + m_.largest * w_.stableNorm()) + skew_of_w;
      second_ = residual_ - image_;
      if (plain > S(0.1) * correction * root_of_smallest) {
        for (index j = 0; j < u.size(); ++j) {
          second_(j) = detail::minus_column<S>(m_.K(), j, w_, residual_(j)).hi;
        }
        plain = m_.tiny * (load + m_.largest * w_.stableNorm()) + skew_of_w;
      }
      S const unit_of_sums = is_doubled ? m_.tiny : S(S(2 * (m_.longest + 4)) * finer);
      S const sums = unit_of_sums * (data_->f.stableNorm() + S(2) * m_.size_of_B * λ.stableNorm() +
                                     m_.largest * u.stableNorm()) +
                     skew_ * u.stableNorm();
      // √(a² − b) ≥ a − b/a
      if (size_ > S(0)) size_ = std::max<S>(S(0), S(size_ - (sums / size_) * u.stableNorm()));
      S const second = (second_.stableNorm() + plain + sums + eps * load) / root_of_smallest;
      if (!is_doubled && correction + second > S(0.02) * goal * size_) {
        is_doubled = true;
        continue;
      }
      bool const enough = correction + second <= S(0.02) * goal * size_;
      if (enough || pass >= 4 || !(correction < last / S(2)) ||
          !slant::detail::is_finite(correction)) {
        return correction + second;
      }
      last = correction;
      // u ← u + w; the corrected u is off by ρ − K w and by the rounding of the sum, which is
      // known.
      for (index j = 0; j < u.size(); ++j) {
        auto const sum = slant::detail::exact_sum<S>(u(j), w_(j));
        u(j) = sum.hi;
        w_(j) = sum.lo;
      }
      S const rounded = m_.most_energy(w_, m_.all, scaled_);
      if (second + rounded <= S(0.02) * goal * size_ || pass == 3) {
        size_ = std::max<S>(S(0), S(size_ - correction - rounded));
        return second + rounded;
      }
    }
  }

  void residual(vector_type const& λ, vector_type const& u) {
    for (index j = 0; j < u.size(); ++j) {
      auto sum = detail::minus_column<S>(m_.B, j, λ, data_->f(j));
      sum = detail::minus_column<S>(m_.B, j, outward_, sum);
      load_(j) = sum.hi;
      residual_(j) = detail::minus_column<S>(m_.K(), j, u, sum).hi;
    }
  }
  /// The same in extended precision.
  void extended_residual(vector_type const& λ, vector_type const& u) {
    for (index j = 0; j < u.size(); ++j) {
      auto sum = static_cast<extended>(data_->f(j));
      for (typename sparse_type::InnerIterator e(m_.B, j); e; ++e) {
        auto const force =
            static_cast<extended>(λ(e.row())) + static_cast<extended>(outward_(e.row()));
        sum -= static_cast<extended>(e.value()) * force;
      }
      load_(j) = static_cast<S>(sum);
      for (typename sparse_type::InnerIterator e(m_.K(), j); e; ++e) {
        sum -= static_cast<extended>(e.value()) * static_cast<extended>(u(e.row()));
      }
      residual_(j) = static_cast<S>(sum);
    }
  }

  /// λ_min(K) ≤ ‖K x‖/‖x‖ for every x.
  void note_quotient(S const& load, S const& response) {
    if (!(load > S(0)) || !(response > S(0))) return;
    S const quotient = load / response;
    if (quotient_ == S(0) || quotient < quotient_) quotient_ = quotient;
  }
  /// A lower bound if there is one, else well below what has been seen: it divides nothing but a
  /// term of second order.
  [[nodiscard]] S smallest() const {
    return smallest_ > S(0) ? smallest_ : quotient_ > S(0) ? S(quotient_ / S(1024)) : m_.largest;
  }

  static constexpr index relaxations_ = 12;  // a few layers of elements

  /// The next larger type, if there is one.
  using extended = std::conditional_t<(sizeof(S) < sizeof(double)), double, long double>;

  detail::scene_matrices<S> m_;
  detail::extension<S> extension_{};
  data<S> const* data_;
  vector_type positions_{};
  S size_{0}, smallest_{0}, quotient_{0}, skew_{0};
  // Of the last certificate: what is known, √γ, ε, ε with the rounding of d, and 1 +
  // rounding.
  energy_error<S> error_{};
  S root_of_gap_{0}, off_{0}, off_of_rest_{0}, grown_{1};
  bool is_proven_ = false;
  index solves_ = 0;
  vector_type residual_, load_, second_, w_, g_, rest_, image_, lost_, outward_, scaled_;
};

namespace detail {

/// One factor for each row of B, a power of two, so that D A D has a diagonal of the order 1:
/// 2ᵏ ≈ √m, m the mean stiffness of the tangents of a node, or of these and its normal, which keeps
/// its cone. Empty if the stiffnesses are alike.
template <class V>
[[nodiscard]] V row_factors(V const& stiffness, index nodes, index tangents, bool keeps_cones) {
  using S = scalar_t<V>;
  using std::sqrt;
  V d(stiffness.size());
  S least = std::numeric_limits<S>::infinity(), most(0);
  std::vector<index> rows;
  auto const assign = [&] {
    S sum(0);
    index count = 0;
    for (index const row : rows) {
      if (!slant::detail::is_finite(stiffness(row))) continue;  // empty: it goes with the others
      sum += stiffness(row);
      ++count;
    }
    bool const acts = sum > S(0) && slant::detail::is_finite(sum);
    S const mean = acts ? S(sum / S(count)) : S(0);
    for (index const row : rows) d(row) = acts ? unit_near(S(sqrt(mean))) : S(0);
    if (acts) {
      least = std::min<S>(least, mean);
      most = std::max<S>(most, mean);
    }
    rows.clear();
  };
  for (index i = 0; i < nodes; ++i) {
    rows.push_back(i);
    if (!keeps_cones) assign();
    for (index k = 0; k < tangents; ++k) rows.push_back(nodes + tangents * i + k);
    assign();
  }
  if (!(most > S(64) * least)) return V();
  // Contacts that act on nothing are as the softest one: what stands for their gaps stays small.
  for (auto& factor : d) factor = factor > S(0) ? factor : unit_near(S(sqrt(least)));
  return d;
}

}  // namespace detail

// --- newton certificate --------------------------------------------------------------------------
//
// What a Newton step of the dual problem says of the error where the certificate does not
// show the goal: certificates/newton_estimate.hpp, with the displacements' bound for the norm of
// what the step leaves over. The certificate charges a point inside of Λ its gap, of which the
// error is the square; the step goes to the face first, where there is none. So iterates of
// interior-point methods are judged like those on a face. An estimate: nothing is proven by it.

/// Sharpens a certificate of the scene whose dual problem is qp, A ≈ M⁻¹; refers to all three.
/// Costs some 12 products by A a call.
template <class QP, class M>
class newton_certificate {
 public:
  using vector_type = typename QP::vector_type;
  using scalar = typename QP::scalar;

  /// `units`: d where the unknowns x of qp are λ = d ∘ x; empty: λ itself.
  newton_certificate(QP const& qp, M const& m, certificate<scalar>& c, vector_type units = {})
      : qp_(&qp),
        m_(&m),
        certificate_(&c),
        d_(units.size() > 0 ? std::move(units) : vector_type::Ones(qp.size()).eval()),
        newton_(qp, m),
        of_a_(workspace(qp.a(), d_)) {
    // About 1/diag A; an empty row is held by nothing and asked for nothing.
    inverse_diagonal_ = c.stiffness().cwiseQuotient(d_).cwiseQuotient(d_);
    scalar sum(0);
    for (scalar& entry : inverse_diagonal_) {
      if (!slant::detail::is_finite(entry)) entry = scalar(1);
      sum += scalar(1) / entry;
    }
    // A short step to the face: from a long one Newton's step would have to come back.
    if (sum > scalar(0)) ρ_ = scalar(qp.size()) / sum / scalar(1024);
  }
  newton_certificate(QP const&&, M const&, certificate<scalar>&, vector_type = {}) = delete;

  /// The last certificate, which was that of λ ∈ Λ, or what the step says if that is less.
  [[nodiscard]] energy_error<scalar> const& operator()(vector_type const& λ) {
    if (!certificate_->gradient().allFinite()) return certificate_->estimated(scalar(-1));
    x_ = λ.cwiseQuotient(d_);
    gradient_ = certificate_->gradient().cwiseProduct(d_);
    auto const norm = [&](vector_type const& d) {
      return certificate_->extended_norm(d.cwiseQuotient(d_));
    };
    return certificate_->estimated(
        newton_({x_, gradient_, inverse_diagonal_, ρ_, 12,
                 gradient_size<scalar>{slant::norm(x_), slant::norm(qp_->b())}, false},
                *m_, of_a_, norm));
  }
  /// Products by A so far.
  [[nodiscard]] index applications() const { return newton_.applications(); }

 private:
  QP const* qp_;
  M const* m_;
  certificate<scalar>* certificate_;
  vector_type d_, inverse_diagonal_, x_, gradient_;
  newton_estimate<QP, M> newton_;
  workspace_t<typename QP::operator_type, vector_type> of_a_;
  scalar ρ_{1};
};

}  // namespace slant::contact
