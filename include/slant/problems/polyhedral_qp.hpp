// SPDX-License-Identifier: MIT
//
// The problem of the Schur complement contact algorithm [D (1)]:
//
//     minimise   j(u) = ½ uᵀK u − fᵀu   over   B u ≤ c,
//
// K symmetric positive semidefinite, with the conjugate projector of a U such that B U = 0 (what
// the paper writes Bᵀ is B here).
#pragma once

#include <slant/base/diagnosis.hpp>
#include <slant/base/held.hpp>
#include <slant/base/matrix_entries.hpp>
#include <slant/base/partitions.hpp>
#include <slant/base/scaling.hpp>
#include <slant/concepts/bad_input.hpp>
#include <slant/krylov/conjugate_directions.hpp>

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace slant {

// --- constraint rows -----------------------------------------------------------------------------
//
// Linear inequalities B u ≤ c with a sparse B, in clusters: rows that share unknowns, directly or
// by way of others, belong to one cluster, and clusters have nothing to do with each other. Contact
// between matching grids has clusters of one row; where bodies meet at an edge, or a constraint was
// written twice, there are a few rows. Each cluster is kept as a small dense block, so that
// projections onto { B u ≤ c } and onto its faces split into small ones.
//
// Units. Each row and its bound are kept as multiples of a power of two, so that the largest entry
// of a row lies in [1, 2): b_i = units_i b̃_i, c_i = units_i c̃_i. That is exact and changes no
// point of the set; rows of any size can then stand beside each other. Multipliers of the rows as
// they were given are those of the kept ones divided by units_i.
//
// Limitation. Rows that chain through shared unknowns over a whole surface, as those of mortar
// methods do, are one cluster of m rows and n unknowns: a dense block of m n numbers, and work of
// that order in each product.

/// B and c, see the top of this file. B has m rows and n columns, c has m entries; +infinity stands
/// for a row that never acts.
template <class S = double>
class constraint_rows {
 public:
  using scalar = S;
  using vector_type = Eigen::Matrix<S, Eigen::Dynamic, 1>;
  using matrix_type = Eigen::Matrix<S, Eigen::Dynamic, Eigen::Dynamic>;

  /// Rows that share unknowns, with these unknowns.
  struct cluster {
    std::vector<index> unknowns;
    std::vector<index> rows;
    matrix_type e;  ///< column j: the entries of rows[j] at the unknowns
  };

  /// Throws bad_input if sizes do not match, an entry of B is not finite, an entry of c is NaN or
  /// −infinity, or a row of zeros has c < 0.
  template <class M>
  constraint_rows(Eigen::SparseMatrixBase<M> const& b, vector_type c)
      : unknowns_(b.cols()), c_(std::move(c)) {
    detail::check_size("c", c_.size(), b.rows(), "one entry per row of B,");
    Eigen::SparseMatrix<S, Eigen::RowMajor> rows = b.derived();
    detail::require_finite_entries("B", rows);
    rows.prune([](auto, auto, S const& value) { return value != S(0); });
    for (index i = 0; i < c_.size(); ++i) check_bound(i, rows.outerIndexPtr());
    take_units(rows);
    collect(rows);
  }

  /// m.
  [[nodiscard]] index count() const noexcept { return c_.size(); }
  /// n.
  [[nodiscard]] index unknowns() const noexcept { return unknowns_; }
  /// c̃, in the units of the rows.
  [[nodiscard]] vector_type const& c() const noexcept { return c_; }
  /// b_i = units_i b̃_i: powers of two, 1 for rows of zeros.
  [[nodiscard]] vector_type const& units() const noexcept { return units_; }
  [[nodiscard]] std::vector<cluster> const& clusters() const noexcept { return clusters_; }
  /// Does row i act at all? It has entries and a finite bound.
  [[nodiscard]] bool acts(index i) const { return lengths_[i] > S(0); }
  /// ‖b̃_i‖ of a row that acts.
  [[nodiscard]] S const& length(index i) const { return lengths_[i]; }

  /// f(i, b̃_iᵀv, |b̃_i|ᵀ|v|) for each row that acts: the product and the size of its terms, of which
  /// its rounding error is a small multiple of ε.
  template <class V, class F>
  void for_each_product(V const& v, F f) const {
    using std::abs;
    auto const& entries = slant::local(v);
    for (cluster const& part : clusters_) {
      for (std::size_t j = 0; j < part.rows.size(); ++j) {
        S sum(0), size(0);
        for (std::size_t k = 0; k < part.unknowns.size(); ++k) {
          S const term = part.e(index(k), index(j)) * entries.coeff(part.unknowns[k]);
          sum += term;
          size += abs(term);
        }
        f(part.rows[j], sum, size);
      }
    }
  }

 private:
  void check_bound(index i, int const* begin) const {
    if (!(c_[i] > -detail::infinity<S>())) {
      throw bad_input("c", detail::show(c_[i]), "a number or +inf").at(i);
    }
    if (begin[i] == begin[i + 1] && c_[i] < S(0)) {
      throw bad_input("c", detail::show(c_[i]),
                      "a number >= 0, since row " + detail::show(i) + " of B is zero")
          .at(i);
    }
  }

  void take_units(Eigen::SparseMatrix<S, Eigen::RowMajor>& b) {
    using std::abs;
    units_ = vector_type::Ones(b.rows());
    for (index i = 0; i < b.rows(); ++i) {
      using entry = typename Eigen::SparseMatrix<S, Eigen::RowMajor>::InnerIterator;
      S largest(0);
      for (entry e(b, i); e; ++e) largest = std::max<S>(largest, abs(e.value()));
      if (largest == S(0)) continue;
      units_[i] = unit_near(largest) / S(2);
      S const reciprocal = S(1) / units_[i];
      for (entry e(b, i); e; ++e) e.valueRef() *= reciprocal;
      c_[i] *= reciprocal;
      if (c_[i] > -detail::infinity<S>()) continue;
      throw bad_input("c", "a bound " + detail::show(units_[i]) + " times a number out of range",
                      "one that a u of numbers within the range can satisfy")
          .at(i);
    }
  }

  void collect(Eigen::SparseMatrix<S, Eigen::RowMajor> const& b) {
    using entry = typename Eigen::SparseMatrix<S, Eigen::RowMajor>::InnerIterator;
    detail::union_find sets(unknowns_);
    for (index i = 0; i < b.rows(); ++i) {
      if (!(c_[i] < detail::infinity<S>())) continue;
      for (entry e(b, i); e; ++e) sets.join(entry(b, i).col(), e.col());
    }
    lengths_ = vector_type::Zero(b.rows());
    std::vector<index> cluster_of(std::size_t(unknowns_), -1);
    std::vector<index> place(std::size_t(unknowns_), -1);
    for (index i = 0; i < b.rows(); ++i) {
      entry const first(b, i);
      if (!first || !(c_[i] < detail::infinity<S>())) continue;
      auto& number = cluster_of[std::size_t(sets.find(first.col()))];
      if (number < 0) {
        number = index(clusters_.size());
        clusters_.emplace_back();
      }
      cluster& part = clusters_[std::size_t(number)];
      part.rows.push_back(i);
      for (entry e(b, i); e; ++e) {
        index& at = place[std::size_t(e.col())];
        if (at >= 0) continue;
        at = index(part.unknowns.size());
        part.unknowns.push_back(e.col());
      }
    }
    for (cluster& part : clusters_) {
      part.e.setZero(index(part.unknowns.size()), index(part.rows.size()));
      for (std::size_t j = 0; j < part.rows.size(); ++j) {
        for (entry e(b, part.rows[j]); e; ++e) {
          part.e(place[std::size_t(e.col())], index(j)) = e.value();
        }
        vector_type const row = part.e.col(index(j));
        lengths_[part.rows[j]] = slant::norm(row);
      }
    }
  }

  index unknowns_;
  vector_type c_;
  vector_type units_;
  vector_type lengths_;  // 0 for rows that do not act
  std::vector<cluster> clusters_;
};

template <class M, class V>
constraint_rows(Eigen::SparseMatrixBase<M> const&, V const&) -> constraint_rows<typename M::Scalar>;

/// What polyhedral_qp asks of K, f and Q.
template <class K, class V, class Q>
concept polyhedral_qp_parts = vector<V> && psd_operator<K, V> && conjugate_projector_for<Q, V>;

/// Arguments that lack something end here and are told so; see base/diagnosis.hpp.
template <class K, class V, class R, class Q>
class polyhedral_qp : public detail::refused, public detail::scalar_of<std::remove_cvref_t<V>> {
  using asked = detail::questions_about<std::remove_cvref_t<K>, std::remove_cvref_t<V>>;
  static constexpr bool good_vector = vector<std::remove_cvref_t<V>>;

  static_assert(good_vector,
                "polyhedral_qp: f must be a slant::vector; an expression or a view is none");
  static_assert(linear_operator<typename asked::whole, typename asked::vector_type>,
                "polyhedral_qp: K must be a linear operator on vectors like f");
  static_assert(detail::usable_part<typename asked::part, typename asked::vector_type>,
                "polyhedral_qp: a part of K cannot be used on vectors like f");
  static_assert(psd_operator<typename asked::promise, typename asked::vector_type>,
                "polyhedral_qp: K must declare self_adjoint and positive_semidefinite");
  static_assert(
      !good_vector || conjugate_projector_for<std::remove_cvref_t<Q>, typename asked::vector_type>,
      "polyhedral_qp: Q must have add_minimiser(a, b, y, w), as a conjugate_projector has");

 public:
  polyhedral_qp(held<K>, held<V>, held<R>, held<Q>);
};

/// polyhedral_qp{K, f, rows, Q}: rows a constraint_rows, Q a conjugate projector. Lvalues are
/// referenced, rvalues owned. Throws bad_input if sizes do not match or f is not finite.
template <class K, class V, class R, class Q>
  requires polyhedral_qp_parts<std::remove_cvref_t<K>, std::remove_cvref_t<V>,
                               std::remove_cvref_t<Q>>
class polyhedral_qp<K, V, R, Q> {
 public:
  using operator_type = std::remove_cvref_t<K>;
  using vector_type = std::remove_cvref_t<V>;
  using rows_type = std::remove_cvref_t<R>;
  using projector_type = std::remove_cvref_t<Q>;
  using scalar = scalar_t<vector_type>;

  polyhedral_qp(held<K> k, held<V> f, held<R> rows, held<Q> q)
      : k_(std::move(k)), f_(std::move(f)), rows_(std::move(rows)), q_(std::move(q)) {
    detail::check_size("K.rows()", index(this->k().rows()), size(), "the size of f,");
    detail::check_size("K.cols()", index(this->k().cols()), size(), "the size of f,");
    detail::check_size("columns of B", this->rows().unknowns(), size(), "the size of f,");
    detail::check_size("rows of the projector", index(projection().rows()), size(),
                       "the size of f,");
    detail::check_finite("f", this->f());
  }

  [[nodiscard]] operator_type const& k() const { return k_.get(); }
  [[nodiscard]] vector_type const& f() const { return f_.get(); }
  /// B and c.
  [[nodiscard]] rows_type const& rows() const { return rows_.get(); }
  /// Q.
  [[nodiscard]] projector_type const& projection() const { return q_.get(); }
  /// Number of unknowns n.
  [[nodiscard]] index size() const { return slant::local(f()).size(); }

 private:
  held<K> k_;
  held<V> f_;
  held<R> rows_;
  held<Q> q_;
};

template <class K, class V, class R, class Q>
polyhedral_qp(K&&, V&&, R&&, Q&&) -> polyhedral_qp<kept_t<K>, kept_t<V>, kept_t<R>, kept_t<Q>>;

/// What schur_contact works on.
template <class P>
concept polyhedral_program = requires(P const& p) {
  { p.k() } -> std::same_as<typename P::operator_type const&>;
  { p.f() } -> std::same_as<typename P::vector_type const&>;
  { p.rows() } -> std::same_as<constraint_rows<typename P::scalar> const&>;
  { p.projection() } -> std::same_as<typename P::projector_type const&>;
};

/// No problem at all.
template <class P>
class schur_contact : public detail::refused_method<Eigen::VectorXd> {
  static_assert(detail::was_refused<std::remove_cvref_t<P>> ||
                    polyhedral_program<std::remove_cvref_t<P>>,
                "schur_contact: the problem must be a polyhedral_qp{K, f, rows, Q}");

 public:
  using schur_contact::refused_method::refused_method;
};

}  // namespace slant
