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
// δ: v by zero outside of the contact unknowns, v = Bᵀ(BBᵀ)⁻¹d: no work. Where that is not enough,
// the remainder that a few conjugate gradient steps y for A y = d leave is extended by zero, and
// ‖d‖_{A⁻¹} ≤ ‖y‖_A + ‖d − A y‖_{A⁻¹}: the harmonic extension, up to a tenth.
//
// `proven` is said if λ is a proven lower bound (smallest_eigenvalue_bound), the rows of B are
// orthogonal or empty, the gaps of the set are exact and the extension was by zero. Then no sum is
// taken for what it should be (without underflow; ε = 2u, γ_k = k ε):
//
//     ρ, c − B u   in doubled precision, rounded once: off by ε|ρ| + 8 (k + 4) ε² (|f| + |Bᵀ||λ| +
//                  |K||u|) for rows of k entries; |K||u| has at most the length ‖K‖_∞ ‖u‖. ρ in
//                  extended precision (long double) while that shows the goal: 2 (k + 4) ε' for ε²
//     ρ − K w      in plain precision: off by γ_{k+4} (|ρ| + |K||w|)
//     ‖v‖²_K       the computed sum of p products in rows of k entries is off by γ_{p+k+8}
//     |v|ᵀ|K||v|,
//                  which is summed as well: added where ‖v‖_K is a part of the bound, subtracted
//                  where it is the size that the bound is divided by
//     λ ∈ Λ        a computed projection is off by some ε of the radius; what leads to the point λ̂
//     of
//                  the sphere is computed from R² − ‖λ_t‖² in doubled precision and enters ρ
//     s            exactly normal up to γ as in certificates/normal_part.hpp; d = g − s is off by
//                  at most 24 ε|g|, a vector r; ‖r‖_{A⁻¹} ≤ 2 √‖K‖ ‖D r‖, D⁻¹ the lengths of rows
//     γ, ‖·‖₂      positive sums of n terms: all is enlarged by 1 + 8 (n + 64) ε
//
// Without a proof, λ is an estimate from solves at hand, and a sharper norm has A y as the method
// applies it; the same terms are added, so that nothing is said of digits that rounding has taken.
//
// Cost: one solve with K, one product with K in doubled precision and one in plain one; as much
// again for each refinement of u.
#pragma once

#include <slant/certificates/energy_error.hpp>
#include <slant/concepts/checks.hpp>
#include <slant/concepts/factorization.hpp>
#include <slant/contact/contact_data.hpp>
#include <slant/contact/detail/stacked_constraints.hpp>
#include <slant/krylov/unit.hpp>
#include <slant/operators/inverse.hpp>
#include <slant/sets/detail/double_word.hpp>

#include <Eigen/SparseCore>

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>
#include <utility>
#include <vector>

namespace slant::contact {

namespace detail {

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

}  // namespace detail

/// solve(b, x) of a factorisation, as the certificate takes it. Refers to it.
template <class Factorization>
[[nodiscard]] auto solver(Factorization const& factor) {
  return [&factor]<class V>(V const& b, V& x) {
    if constexpr (has_plain_solve<Factorization, V>) {
      factor.solve(b, x);
    } else {
      slant::apply(inverse(factor), b, x);
    }
  };
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
  S const ε = std::numeric_limits<S>::epsilon(), n(static_cast<double>(K.rows() + 2));
  if (!(guess > S(0)) || !(n * ε < S(0.1))) return S(0);
  S const lost = S(1.1) * n * ε * K.diagonal().sum();
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
/// is projected onto Λ.
template <class S = double>
class certificate {
 public:
  using vector_type = Eigen::Matrix<S, Eigen::Dynamic, 1>;
  using sparse_type = Eigen::SparseMatrix<S>;

  /// Throws bad_input if sizes do not match.
  certificate(sparse_type const& K, data<S> const& c)
      : K_(&K), data_(&c), B_(detail::stacked_constraints(c)), rows_(B_.transpose()) {
    slant::detail::check_size("rows of K", K.rows(), c.f.size(), "the size of f,");
    slant::detail::check_size("columns of K", K.cols(), c.f.size(), "the size of f,");
    prepare();
  }

  /// Looks for a proven lower bound of λ_min(K), by three solves with K and one factorisation of a
  /// matrix with its pattern, more if the first is not definite; see smallest_eigenvalue_bound.
  /// Without it λ_min(K) is estimated. Whether a bound was found.
  template <class Solve, class Factor>
  bool prove(Solve const& solve, Factor const& factor) {
    index const n = K_->rows();
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
    smallest_ = smallest_eigenvalue_bound(*K_, quotient, factor);
    is_proven_ = smallest_ > S(0);
    return is_proven_;
  }
  /// The lower bound of λ_min(K) in use.
  [[nodiscard]] S smallest_eigenvalue() const { return smallest_; }
  /// An upper bound of λ_max(K): the largest sum of moduli in a row.
  [[nodiscard]] S largest_eigenvalue() const { return largest_; }
  /// Estimate of the condition number of K; 0 before the first certificate.
  [[nodiscard]] S condition() const { return quotient_ > S(0) ? S(largest_ / quotient_) : S(0); }
  /// m: the stiffness that acts on each multiplier, diag of the lumped preconditioner; ∞ for empty
  /// rows.
  [[nodiscard]] vector_type const& stiffness() const { return stiffness_; }
  /// K.
  [[nodiscard]] sparse_type const& matrix() const { return *K_; }
  /// Solves with K so far.
  [[nodiscard]] index solves() const { return solves_; }
  /// c − B u of the last certificate: the gradient of the dual problem at λ, up to what the last
  /// correction of u says.
  [[nodiscard]] vector_type const& gradient() const { return g_; }

  /// Tangential positions w from now on, as in load_step: friction opposes T u − w. Empty: 0.
  void set_positions(vector_type w) { positions_ = std::move(w); }

  /// Bounds ‖u − u*‖_K. λ ← P_Λ(λ); u ← K⁻¹(f − Bᵀλ), refined as far as `goal`, a relative error,
  /// needs it. solve(b, x) solves K x = b.
  template <class Set, class Solve>
  [[nodiscard]] energy_error<S> operator()(Set const& set, vector_type& λ, vector_type& u,
                                           S const& goal, Solve const& solve) {
    return (*this)(set, λ, u, goal, solve,
                   [](vector_type const&, S const&, S const&) { return S(-1); });
  }
  /// The same where sharper(d, δ, enough) → a bound or estimate of ‖d‖_{A⁻¹}, negative: none, is
  /// asked if δ, from the extension by zero, does not show the goal; `enough` would, if positive.
  template <class Set, class Solve, class Sharper>
  [[nodiscard]] energy_error<S> operator()(Set const& set, vector_type& λ, vector_type& u,
                                           S const& goal, Solve const& solve,
                                           Sharper const& sharper) {
    slant::detail::check_size("lambda", λ.size(), B_.rows());
    slant::detail::check_size("u", u.size(), K_->rows());
    slant::project(set, λ, λ);
    outward_.setZero(λ.size());
    slant::visit_blocks(set, [&](auto const& block, auto const& p) {
      if constexpr (requires { block.radius(); }) {
        p.put(outward_, to_sphere<S>(p.value(λ), block.radius()));
      }
    });
    energy_error<S> e;
    S const ε = recover(λ, u, goal, solve);
    e.size = size_;
    if (!slant::detail::is_finite(ε) || !slant::detail::is_finite(e.size)) return e;
    g_.resize(B_.rows());
    lost_.resize(B_.rows());
    S const eps = std::numeric_limits<S>::epsilon();
    S const length = u.stableNorm();
    for (index i = 0; i < g_.size(); ++i) {
      S const start = position(i);
      g_(i) = detail::minus_column<S>(rows_, i, u, start).hi;
      using std::abs;
      using std::sqrt;
      // |c| + |B||u| ≤ |c| + ‖row‖ ‖u‖; in units in which every row has the length 1.
      S const unit = sqrt(inverse_squares_(i));
      lost_(i) = unit * (S(24) * eps * abs(g_(i)) + tiny_ * abs(start)) +
                 (unit > S(0) ? S(tiny_ * length) : S(0));
    }
    rest_ = g_;
    using std::sqrt;
    auto const balanced = balance(set, λ, g_, stiffness_, rest_);
    // Where λ_ν = 0 and the gap is open for certain, s is the exact gradient: however wide the gap
    // is, its rounding is no part of g − s.
    for (index i = 0; i < data_->nodes(); ++i) {
      bool const is_open =
          λ(i) == S(0) && rest_(i) == S(0) && g_(i) * sqrt(inverse_squares_(i)) > lost_(i);
      if (is_open) lost_(i) = S(0);
    }
    e.proven = is_proven_ && balanced.exact && is_orthogonal_;
    S const grown = S(1) + S(8 * (K_->rows() + 64)) * eps;
    S const lost = S(2) * sqrt(largest_) * lost_.stableNorm();
    auto const bound = [&](S const& δ) {
      return (error_bound<S>(δ + lost + ε, balanced.gap) + ε) * grown;
    };
    S const δ_zero = extension_by_zero(rest_);
    e.bound = bound(δ_zero);
    if (e.relative() > goal) {
      S const wanted = goal / (S(1) + goal) * e.size / grown - ε;
      S const enough = wanted - balanced.gap / wanted - lost - ε - tail_norm();
      S const δ = sharper(std::as_const(rest_), δ_zero, enough);
      // What no force of the contacts can move is in no range of A.
      S const sharp = δ >= S(0) ? bound(δ + tail_norm()) : e.bound;
      if (sharp < e.bound) {
        e.bound = sharp;
        e.proven = false;
      }
    }
    return e;
  }

  /// ‖v‖_K of the shortest v with B v = d, an upper bound of ‖d‖_{A⁻¹}; ∞ where d acts on an empty
  /// row. What is left of d where rows depend on each other is counted as moved by its nodes alone:
  /// an estimate.
  [[nodiscard]] S extension_by_zero(vector_type const& d) {
    for (index i = 0; i < d.size(); ++i) {
      if (inverse_squares_(i) == S(0) && d(i) != S(0)) return std::numeric_limits<S>::infinity();
    }
    v_.setZero(K_->rows());
    if (is_orthogonal_) {
      add_forces(vector_type(inverse_squares_.cwiseProduct(d)), v_);
    } else {
      least_squares(d);
    }
    vector_type left(d.size());
    for (index i = 0; i < d.size(); ++i) left(i) = detail::minus_column<S>(rows_, i, v_, d(i)).hi;
    // In units in which every row has the length 1; with the rounding of B v.
    S const eps = std::numeric_limits<S>::epsilon();
    rest_size_ = left.cwiseProduct(inverse_squares_.cwiseSqrt()).stableNorm() * (S(1) + S(4) * eps);
    using std::sqrt;
    rest_size_ += tiny_ * sqrt(S(static_cast<double>(d.size()))) * v_.stableNorm();
    return most_energy(v_, touched_) + tail_norm();
  }

  /// √(vᵀK v).
  [[nodiscard]] S energy_norm(vector_type const& v) {
    auto const q = energy(v, all_, [](index, S const&) {});
    return root(q.sum, q);
  }

 private:
  /// c_i: the gap, or the tangential position; 0 where the gap is infinite.
  [[nodiscard]] S position(index i) const {
    index const m = data_->nodes();
    if (i >= m) return positions_.size() > 0 ? S(positions_(i - m)) : S(0);
    return slant::detail::is_finite(data_->d(i)) ? S(data_->d(i)) : S(0);
  }

  void prepare() {
    index const n = B_.rows(), m = K_->rows();
    inverse_squares_.setZero(n);
    stiffness_.setConstant(n, std::numeric_limits<S>::infinity());
    vector_type squares = vector_type::Zero(n);
    for (index j = 0; j < m; ++j) {
      S sum(0);
      index entries = 0;
      for (typename sparse_type::InnerIterator e(*K_, j); e; ++e, ++entries) {
        using std::abs;
        sum += abs(e.value());
      }
      all_.push_back(j);
      longest_ = std::max<index>(longest_, entries);
      largest_ = std::max<S>(largest_, sum);
      bool is_touched = false;
      for (typename sparse_type::InnerIterator e(B_, j); e; ++e) {
        squares(e.row()) += e.value() * e.value();
        is_touched = is_touched || e.value() != S(0);
      }
      if (is_touched) touched_.push_back(j);
    }
    for (index i = 0; i < n; ++i) {
      if (squares(i) > S(0)) inverse_squares_(i) = S(1) / squares(i);
      longest_ = std::max<index>(longest_, rows_.col(i).nonZeros());
      size_of_B_ = std::max<S>(size_of_B_, squares(i));
    }
    using std::sqrt;
    S const eps = std::numeric_limits<S>::epsilon();
    tiny_ = S(8 * (longest_ + 4)) * eps * eps;
    largest_ *= S(1) + S(4 * (longest_ + 4)) * eps;
    // ‖B‖₂ ≤ ‖B‖_F, and here twice the longest row where rows are orthogonal.
    size_of_B_ = S(2) * sqrt(size_of_B_);
    // BBᵀ: orthogonal rows have nothing but rounding off the diagonal.
    sparse_type const gram = B_ * rows_;
    for (index j = 0; j < gram.outerSize(); ++j) {
      for (typename sparse_type::InnerIterator e(gram, j); e; ++e) {
        using std::abs;
        S const cosine =
            abs(e.value()) * sqrt(inverse_squares_(j)) * sqrt(inverse_squares_(e.row()));
        if (e.row() != j && cosine > S(8) * std::numeric_limits<S>::epsilon()) {
          is_orthogonal_ = false;
        }
      }
    }
    // m_i = diag of D B K BᵀD.
    v_.setZero(m);
    for (index i = 0; i < n; ++i) {
      if (!(inverse_squares_(i) > S(0))) continue;
      S sum(0);
      for (typename sparse_type::InnerIterator e(rows_, i); e; ++e) v_(e.row()) = e.value();
      for (typename sparse_type::InnerIterator e(rows_, i); e; ++e) {
        for (typename sparse_type::InnerIterator k(*K_, e.row()); k; ++k) {
          sum += e.value() * k.value() * v_(k.row());
        }
      }
      for (typename sparse_type::InnerIterator e(rows_, i); e; ++e) v_(e.row()) = S(0);
      stiffness_(i) = inverse_squares_(i) * inverse_squares_(i) * sum;
    }
  }

  /// vᵀK v in units of its own, and what rounding may have taken from it.
  struct square {
    S sum{0}, lost{0}, unit{1}, unit_of_K{1};
  };
  /// v is zero but at these unknowns; note(j, (K v)_j) is called for them.
  template <class Note>
  [[nodiscard]] square energy(vector_type const& v, std::vector<index> const& unknowns,
                              Note const& note) {
    using std::abs;
    square q;
    q.unit = unit_near(S(v.stableNorm()));
    q.unit_of_K = unit_near(largest_);
    S const scale_of_K = S(1) / q.unit_of_K;
    scaled_ = v / q.unit;
    S part(0), moduli(0);
    constexpr index length_of_part = 256;
    index count = 0;
    for (index j : unknowns) {
      S column(0), size(0);
      for (typename sparse_type::InnerIterator e(*K_, j); e; ++e) {
        S const term = (e.value() * scale_of_K) * scaled_(e.row());
        column += term;
        size += abs(term);
      }
      note(j, S(column * q.unit * q.unit_of_K));
      part += column * scaled_(j);
      moduli += size * abs(scaled_(j));
      if (++count % length_of_part != 0) continue;
      q.sum += part;
      part = S(0);
    }
    q.sum += part;
    index const terms = length_of_part + count / length_of_part + longest_ + 8;
    q.lost = S(2 * terms) * std::numeric_limits<S>::epsilon() * moduli;
    return q;
  }
  [[nodiscard]] static S root(S const& sum, square const& q) {
    using std::sqrt;
    if (!(sum > S(0))) return sum == sum ? S(0) : sum;
    return sqrt(sum) * q.unit * sqrt(q.unit_of_K);
  }
  /// ‖v‖_K from above.
  [[nodiscard]] S most_energy(vector_type const& v, std::vector<index> const& unknowns) {
    auto const q = energy(v, unknowns, [](index, S const&) {});
    return root(S(q.sum + q.lost), q);
  }
  /// ‖u‖_K from K u = t − ρ, both in doubled precision; from below where a proof was asked for.
  [[nodiscard]] S size_of(vector_type const& u) const {
    using std::abs;
    square q;
    q.unit = unit_near(S(u.stableNorm()));
    q.unit_of_K = unit_near(S((load_ - residual_).stableNorm() / q.unit));
    S moduli(0);
    for (index j = 0; j < u.size(); ++j) {
      S const term = (u(j) / q.unit) * ((load_(j) - residual_(j)) / q.unit / q.unit_of_K);
      q.sum += term;
      moduli += abs(term) + abs(u(j) / q.unit) * abs(load_(j) / q.unit / q.unit_of_K);
    }
    if (is_proven_) q.sum -= S(2 * (u.size() + 8)) * std::numeric_limits<S>::epsilon() * moduli;
    return root(q.sum, q);
  }
  /// ‖v‖_K for what extension_by_zero has left.
  [[nodiscard]] S tail_norm() const {
    using std::sqrt;
    return rest_size_ > S(0) ? S(S(2) * rest_size_ * sqrt(largest_)) : S(0);
  }

  /// v ← v + Bᵀf.
  void add_forces(vector_type const& f, vector_type& v) const {
    for (index i = 0; i < f.size(); ++i) {
      for (typename sparse_type::InnerIterator e(rows_, i); e; ++e) v(e.row()) += f(i) * e.value();
    }
  }

  /// v_ of least length among those with the least ‖D(B v − d)‖, D B with rows of length 1:
  /// conjugate gradients for the normal equations, which need no independent rows.
  void least_squares(vector_type const& d) {
    vector_type const scale = inverse_squares_.cwiseSqrt();
    S const unit = unit_near(S(d.stableNorm()));
    vector_type r = (d / unit).cwiseProduct(scale), q(d.size());
    vector_type s = vector_type::Zero(v_.size()), p;
    add_forces(vector_type(r.cwiseProduct(scale)), s);
    p = s;
    S size = s.squaredNorm();
    S const enough = S(1e-16) * size;
    for (index k = 0; k < 200 && size > enough; ++k) {
      for (index i = 0; i < q.size(); ++i) {
        S sum(0);
        for (typename sparse_type::InnerIterator e(rows_, i); e; ++e) sum += e.value() * p(e.row());
        q(i) = scale(i) * sum;
      }
      S const bend = q.squaredNorm();
      if (!(bend > S(0))) break;
      S const α = size / bend;
      v_ += α * p;
      r -= α * q;
      s.setZero();
      add_forces(vector_type(r.cwiseProduct(scale)), s);
      S const next = s.squaredNorm();
      p = s + (next / size) * p;
      size = next;
    }
    v_ *= unit;
  }

  /// ε of u, which is refined where that pays; ρ in doubled precision. Sets size_.
  template <class Solve>
  [[nodiscard]] S recover(vector_type const& λ, vector_type& u, S const& goal, Solve const& solve) {
    using std::sqrt;
    S const eps = std::numeric_limits<S>::epsilon();
    S last = std::numeric_limits<S>::infinity();
    auto const finer = static_cast<S>(std::numeric_limits<extended>::epsilon());
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
      image_.resize(u.size());
      auto const energy_of_w =
          energy(w_, all_, [&](index j, S const& value) { image_(j) = value; });
      S const correction = root(S(energy_of_w.sum + energy_of_w.lost), energy_of_w);
      // ρ − K w, of second order, with what rounding has taken from ρ and from itself.
      S const root_of_smallest = sqrt(smallest());
      S plain = S(2 * (longest_ + 8)) * eps * (load + largest_ * w_.stableNorm());
      second_ = residual_ - image_;
      if (plain > S(0.1) * correction * root_of_smallest) {
        for (index j = 0; j < u.size(); ++j) {
          second_(j) = detail::minus_column<S>(*K_, j, w_, residual_(j)).hi;
        }
        plain = tiny_ * (load + largest_ * w_.stableNorm());
      }
      S const unit_of_sums = is_doubled ? tiny_ : S(S(2 * (longest_ + 4)) * finer);
      S const sums = unit_of_sums * (data_->f.stableNorm() + S(2) * size_of_B_ * λ.stableNorm() +
                                     largest_ * u.stableNorm());
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
      S const rounded = most_energy(w_, all_);
      if (second + rounded <= S(0.02) * goal * size_ || pass == 3) {
        size_ = size_ > correction ? S(size_ - correction) : S(0);
        return second + rounded;
      }
    }
  }

  void residual(vector_type const& λ, vector_type const& u) {
    residual_.resize(u.size());
    load_.resize(u.size());
    for (index j = 0; j < u.size(); ++j) {
      auto sum = detail::minus_column<S>(B_, j, λ, data_->f(j));
      sum = detail::minus_column<S>(B_, j, outward_, sum);
      load_(j) = sum.hi;
      residual_(j) = detail::minus_column<S>(*K_, j, u, sum).hi;
    }
  }
  /// The same in extended precision.
  void extended_residual(vector_type const& λ, vector_type const& u) {
    residual_.resize(u.size());
    load_.resize(u.size());
    for (index j = 0; j < u.size(); ++j) {
      auto sum = static_cast<extended>(data_->f(j));
      for (typename sparse_type::InnerIterator e(B_, j); e; ++e) {
        auto const force =
            static_cast<extended>(λ(e.row())) + static_cast<extended>(outward_(e.row()));
        sum -= static_cast<extended>(e.value()) * force;
      }
      load_(j) = static_cast<S>(sum);
      for (typename sparse_type::InnerIterator e(*K_, j); e; ++e) {
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
    return smallest_ > S(0) ? smallest_ : quotient_ > S(0) ? S(quotient_ / S(1024)) : largest_;
  }

  /// The next larger type, if there is one.
  using extended = std::conditional_t<(sizeof(S) < sizeof(double)), double, long double>;

  sparse_type const* K_;
  data<S> const* data_;
  sparse_type B_, rows_;  // B and Bᵀ
  vector_type inverse_squares_, stiffness_, positions_;
  std::vector<index> touched_{}, all_{};  // unknowns of B; all
  index longest_ = 0;                     // entries in a row of K or of B
  S size_of_B_{0}, size_{0}, tiny_{0};
  S largest_{0}, smallest_{0}, quotient_{0}, rest_size_{0};
  bool is_orthogonal_ = true, is_proven_ = false;
  index solves_ = 0;
  vector_type residual_, load_, second_, w_, v_, g_, rest_, image_, lost_, outward_, scaled_;
};

}  // namespace slant::contact
