// SPDX-License-Identifier: MIT
//
// K, B = [N; T] and what is read off them once: lengths and independence of the rows of B, bounds
// of ‖K‖ and ‖B‖, the stiffness that acts on each multiplier, and energies vᵀK v with what rounding
// may have taken from them.
#pragma once

#include <slant/contact/contact_data.hpp>
#include <slant/contact/detail/stacked_constraints.hpp>
#include <slant/krylov/unit.hpp>
#include <slant/sets/detail/double_word.hpp>

#include <Eigen/SparseCore>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace slant::contact::detail {

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

/// ½‖K − Kᵀ‖_∞ at most: what a vector of length 1 may miss of the symmetric part of K.
template <class S>
[[nodiscard]] S skew_part(Eigen::SparseMatrix<S> const& K) {
  using std::abs;
  Eigen::SparseMatrix<S> const other = K.transpose();
  S largest(0);
  for (index j = 0; j < K.outerSize(); ++j) {
    S sum(0);
    typename Eigen::SparseMatrix<S>::InnerIterator a(K, j), b(other, j);
    while (a || b) {
      bool const has_a = a && (!b || a.row() <= b.row()), has_b = b && (!a || b.row() <= a.row());
      sum += abs(S((has_a ? a.value() : S(0)) - (has_b ? b.value() : S(0))));
      if (has_a) ++a;
      if (has_b) ++b;
    }
    largest = std::max<S>(largest, sum);
  }
  return largest;
}

/// Refers to K.
template <class S>
class scene_matrices {
 public:
  using vector_type = Eigen::Matrix<S, Eigen::Dynamic, 1>;
  using sparse_type = Eigen::SparseMatrix<S>;

  scene_matrices(sparse_type const& K, data<S> const& c)
      : B(stacked_constraints(c)), rows(B.transpose()), K_(&K) {
    prepare();
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

  /// v ← v + Bᵀf.
  void add_forces(vector_type const& f, vector_type& v) const {
    for (index i = 0; i < f.size(); ++i) {
      for (typename sparse_type::InnerIterator e(rows, i); e; ++e) v(e.row()) += f(i) * e.value();
    }
  }

 private:
  void prepare() {
    index const n = B.rows(), m = K().rows();
    vector_type v = vector_type::Zero(m);
    inverse_squares.setZero(n);
    stiffness.setConstant(n, std::numeric_limits<S>::infinity());
    vector_type squares = vector_type::Zero(n);
    for (index j = 0; j < m; ++j) {
      S sum(0);
      index entries = 0;
      for (typename sparse_type::InnerIterator e(K(), j); e; ++e, ++entries) {
        using std::abs;
        sum += abs(e.value());
      }
      all.push_back(j);
      longest = std::max<index>(longest, entries);
      largest = std::max<S>(largest, sum);
      bool is_touched = false;
      for (typename sparse_type::InnerIterator e(B, j); e; ++e) {
        squares(e.row()) += e.value() * e.value();
        is_touched = is_touched || e.value() != S(0);
      }
      if (is_touched) touched.push_back(j);
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
    for (index j = 0; j < gram.outerSize(); ++j) {
      for (typename sparse_type::InnerIterator e(gram, j); e; ++e) {
        using std::abs;
        S const cosine = abs(e.value()) * sqrt(inverse_squares(j)) * sqrt(inverse_squares(e.row()));
        if (e.row() != j && cosine > S(8) * std::numeric_limits<S>::epsilon()) {
          is_orthogonal = false;
        }
      }
    }
    // m_i = diag of D B K BᵀD.
    for (index i = 0; i < n; ++i) {
      if (!(inverse_squares(i) > S(0))) continue;
      S sum(0);
      for (typename sparse_type::InnerIterator e(rows, i); e; ++e) v(e.row()) = e.value();
      for (typename sparse_type::InnerIterator e(rows, i); e; ++e) {
        for (typename sparse_type::InnerIterator k(K(), e.row()); k; ++k) {
          sum += e.value() * k.value() * v(k.row());
        }
      }
      for (typename sparse_type::InnerIterator e(rows, i); e; ++e) v(e.row()) = S(0);
      stiffness(i) = inverse_squares(i) * (inverse_squares(i) * sum);
    }
  }

  sparse_type const* K_;
};

}  // namespace slant::contact::detail
