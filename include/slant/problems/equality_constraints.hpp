// SPDX-License-Identifier: MIT
//
// The affine space { x : G x = e } with its projectors:
//
//     Q = Gᵀ(GGᵀ)⁻¹G  onto range Gᵀ,     P = I − Q  onto ker G,
//     x̄ = Gᵀ(GGᵀ)⁻¹e  the point next to 0.
//
// ‖Q x − x̄‖ is the distance of x from the space: ‖G x − e‖ if the rows of G are orthonormal, and
// what takes its place if they are not. GGᵀ is dense and factored once; for the rows of Total-FETI,
// six for a subdomain, it is the coarse problem.
//
// Rows that depend on others are left out (redundant() names them; which of them it is depends on
// pivoting), and what they say must agree with the others up to rounding. GGᵀ sees the square of a
// row's distance from the span of others, so the distance of rows left out is computed once more,
// by Gram–Schmidt done twice; a row that is independent, but by less than √ε of its length, cannot
// be treated by way of GGᵀ and is refused.
#pragma once

#include <slant/factorizations/dense_ldlt.hpp>
#include <slant/operators/declare.hpp>
#include <slant/operators/identity.hpp>
#include <slant/operators/inverse.hpp>
#include <slant/operators/letter.hpp>
#include <slant/operators/matrix.hpp>
#include <slant/operators/product.hpp>
#include <slant/operators/sum.hpp>

#include <Eigen/SparseCore>

#include <algorithm>
#include <vector>

namespace slant::detail {

/// Q = Gᵀ(GGᵀ)⁻¹G from the factors of GGᵀ. Refers to both.
template <class S>
[[nodiscard]] auto onto_range_of(Eigen::SparseMatrix<S> const& G, dense_ldlt<S> const& factors) {
  return declare<self_adjoint, slant::projector>(
      congruence(adjoint(matrix(G)), slant::inverse(factors)));
}
/// I − Q. Refers to Q.
template <class Q>
[[nodiscard]] auto complement_of(Q const& q) {
  return declare<self_adjoint, slant::projector>(difference(identity(q.rows()), q));
}

/// Rows of G that are independent, in increasing order, from GGᵀ, whose diagonal is at most 1: its
/// Cholesky factorisation with diagonal pivoting (that of Eigen::LDLT looks at the diagonal before
/// the elimination), up to the first pivot that may be zero.
template <class S>
[[nodiscard]] std::vector<index> independent_rows(
    Eigen::Matrix<S, Eigen::Dynamic, Eigen::Dynamic> rest) {
  using std::sqrt;
  index const p = rest.rows();
  Eigen::Matrix<S, Eigen::Dynamic, 1> column(p);
  std::vector<index> kept;
  while (index(kept.size()) < p) {
    index i = 0;
    S const pivot = rest.diagonal().maxCoeff(&i);
    if (!(pivot > smallest_pivot(p, S(1)))) break;
    column = rest.col(i) / sqrt(pivot);
    rest.noalias() -= column * column.transpose();
    rest.col(i).setZero();
    rest.row(i).setZero();
    kept.push_back(i);
  }
  std::sort(kept.begin(), kept.end());
  return kept;
}

}  // namespace slant::detail

namespace slant {

/// G x = e with p rows and n columns. Not movable: its operators refer to it.
///
///     slant::equality_constraints constraints(G, e);
///     auto P = constraints.kernel_projector();
template <class S>
class equality_constraints {
 public:
  using scalar = S;
  using vector_type = Eigen::Matrix<S, Eigen::Dynamic, 1>;
  using sparse_type = Eigen::SparseMatrix<S>;
  using dense_type = Eigen::Matrix<S, Eigen::Dynamic, Eigen::Dynamic>;

  /// Throws bad_input if sizes do not match, an entry is not finite, a redundant row contradicts
  /// the others (argument "e"), a row is too close to the span of others (argument "G"), or the
  /// length of a row, or e over it, leaves the range of the scalar.
  equality_constraints(sparse_type const& G, vector_type const& e)
      : equality_constraints(G, e, vector_type::Zero(G.rows())) {}
  /// The same for e with errors of the given size, one for each row: redundant rows agree with
  /// others up to these.
  equality_constraints(sparse_type const& G, vector_type const& e, vector_type const& error_of_e)
      : rows_(G.rows()),
        lengths_(row_lengths(G, e)),
        unit_rows_(lengths_.cwiseInverse().asDiagonal() * G),
        kept_(
            detail::independent_rows(dense_type(unit_rows_ * sparse_type(unit_rows_.transpose())))),
        G_(rows_of(unit_rows_, kept_)),
        factors_(dense_type(G_ * sparse_type(G_.transpose()))),
        range_projector_(detail::onto_range_of(G_, factors_)),
        kernel_projector_(detail::complement_of(range_projector_)),
        nearest_(G.cols()) {
    vector_type const unit_e = e.cwiseQuotient(lengths_);
    detail::check_finite("e over the length of its row of G", unit_e);
    unit_values_ = unit_e(kept_);
    vector_type weights(G_.rows());
    slant::apply(slant::inverse(factors_), unit_values_, weights);
    nearest_.noalias() = G_.transpose() * weights;
    detail::check_size("error_of_e", error_of_e.size(), G.rows(), "the rows of G,");
    require_agreement(unit_e, e, vector_type(error_of_e.cwiseQuotient(lengths_)));
  }
  equality_constraints(equality_constraints const&) = delete;
  equality_constraints& operator=(equality_constraints const&) = delete;

  /// Number of unknowns n.
  [[nodiscard]] index size() const { return G_.cols(); }
  /// Number of rows of G, p.
  [[nodiscard]] index rows() const { return rows_; }
  /// The rows of G that depend on others, in increasing order.
  [[nodiscard]] std::vector<index> redundant() const {
    std::vector<index> rest;
    for (index i = 0; i < rows_; ++i) {
      if (!std::binary_search(kept_.begin(), kept_.end(), i)) rest.push_back(i);
    }
    return rest;
  }

  /// Q, the projector onto range Gᵀ.
  [[nodiscard]] auto const& range_projector() const& { return range_projector_; }
  auto range_projector() const&& = delete;
  /// P = I − Q, the projector onto ker G.
  [[nodiscard]] auto const& kernel_projector() const& { return kernel_projector_; }
  auto kernel_projector() const&& = delete;
  /// The rows of G that are independent, each divided by its length.
  [[nodiscard]] sparse_type const& unit_rows() const& { return G_; }
  sparse_type const& unit_rows() const&& = delete;
  /// What they are equal to.
  [[nodiscard]] vector_type const& unit_values() const& { return unit_values_; }
  vector_type const& unit_values() const&& = delete;
  /// x̄.
  [[nodiscard]] vector_type const& nearest() const& { return nearest_; }
  vector_type const& nearest() const&& = delete;

  /// |G x − e| ≤ tolerance (|G| |x| + |e|) in each row, up to the rounding of rows that have unknowns
  /// in common with it and, where e is 0 and has no size, of all of x.
  [[nodiscard]] bool meets(vector_type const& x, S const& tolerance) const {
    S const rounding = S(64) * detail::epsilon<S>();
    sparse_type const sizes = G_.cwiseAbs();
    vector_type const terms = sizes * x.cwiseAbs() + unit_values_.cwiseAbs();
    vector_type shared = sizes * vector_type(sizes.transpose() * terms);
    S const size = slant::norm(x);
    for (index i = 0; i < shared.size(); ++i) {
      if (unit_values_[i] == S(0)) shared[i] += size;
    }
    vector_type const rest = (G_ * x - unit_values_).cwiseAbs();
    return (rest.array() <= tolerance * terms.array() + rounding * shared.array()).all();
  }

  /// μ with Gᵀμ = Q v, as many as G has rows; 0 for redundant ones.
  [[nodiscard]] vector_type multipliers(vector_type const& v) const {
    detail::check_size("v", v.size(), size(), "the columns of G,");
    vector_type weights(G_.rows());
    slant::apply(slant::inverse(factors_), vector_type(G_ * v), weights);
    return of_unit_rows(weights);
  }
  /// μ of multipliers of the unit rows, as many as G has rows; 0 for redundant ones.
  [[nodiscard]] vector_type of_unit_rows(vector_type const& weights) const {
    vector_type μ = vector_type::Zero(rows_);
    μ(kept_) = weights.cwiseQuotient(vector_type(lengths_(kept_)));
    return μ;
  }

 private:
  /// ‖G_i‖, 1 for a row of zeros.
  static vector_type row_lengths(sparse_type const& G, vector_type const& e) {
    using std::abs;
    using std::sqrt;
    detail::check_size("e", e.size(), G.rows(), "the rows of G,");
    detail::check_finite("e", e);
    detail::require_finite_entries("G", G);
    vector_type largest = vector_type::Zero(G.rows()), squares = vector_type::Zero(G.rows());
    detail::for_each_entry(G, [&](index i, index, S const& value) {
      largest[i] = std::max<S>(largest[i], abs(value));
    });
    for (S& l : largest) l = l > S(0) ? l : S(1);
    detail::for_each_entry(G, [&](index i, index, S const& value) {
      S const part = value / largest[i];
      squares[i] += part * part;
    });
    for (index i = 0; i < G.rows(); ++i) {
      if (squares[i] > S(0)) largest[i] *= sqrt(squares[i]);
      if (!detail::is_finite(largest[i]) || !detail::is_finite(S(1) / largest[i])) {
        throw bad_input("length of row " + detail::show(i) + " of G", detail::show(largest[i]),
                        "a finite number with a finite reciprocal");
      }
    }
    return largest;
  }

  static sparse_type rows_of(sparse_type const& G, std::vector<index> const& rows) {
    std::vector<int> place(std::size_t(G.rows()), -1);
    int count = 0;
    for (index const row : rows) place[std::size_t(row)] = count++;
    std::vector<Eigen::Triplet<S>> entries;
    detail::for_each_entry(G, [&](index i, index j, S const& value) {
      int const row = place[std::size_t(i)];
      if (row >= 0) entries.emplace_back(row, static_cast<int>(j), value);
    });
    sparse_type selected(count, G.cols());
    selected.setFromTriplets(entries.begin(), entries.end());
    return selected;
  }

  /// Each row that was left out is a combination of the others up to rounding, and says the same.
  void require_agreement(vector_type const& unit_e, vector_type const& e,
                         vector_type const& error) const {
    using std::abs;
    auto const left_out = redundant();
    if (left_out.empty()) return;
    S const rounding = S(4096) * detail::epsilon<S>();
    vector_type const kept_error = error(kept_);
    sparse_type const columns = unit_rows_.transpose();
    for (index const i : left_out) {
      vector_type rest = columns.col(i);
      vector_type combination = vector_type::Zero(G_.rows()), h(G_.rows());
      for (int pass = 0; pass < 2; ++pass) {
        slant::apply(slant::inverse(factors_), vector_type(G_ * rest), h);
        rest.noalias() -= G_.transpose() * h;
        combination += h;
      }
      if (rest.norm() > rounding) {
        throw bad_input("G",
                        "row " + detail::show(i) + " at the distance " +
                            detail::brief(S(rest.norm())) +
                            " times its length from the span of others",
                        "rows that are independent, or dependent up to rounding");
      }
      S const implied = combination.dot(unit_values_);
      S const terms = abs(unit_e[i]) + combination.cwiseAbs().dot(unit_values_.cwiseAbs());
      // Rows with unknowns in common may have a part of rounding; of the others it is exactly 0.
      S const others = (combination.array() == S(0)).select(S(0), unit_values_.cwiseAbs()).sum();
      S const of_others = S(64) * detail::epsilon<S>() * combination.norm() * others;
      S const allowed =
          rounding * terms + of_others + error[i] + combination.cwiseAbs().dot(kept_error);
      if (abs(implied - unit_e[i]) <= allowed) continue;
      throw bad_input(
          "e", detail::show(S(e[i])),
          detail::show(S(implied * lengths_[i])) + ", which other rows of G imply for this one")
          .at(i);
    }
  }

  index rows_;
  vector_type lengths_;      // ‖G_i‖
  sparse_type unit_rows_;    // G_i / ‖G_i‖
  std::vector<index> kept_;  // rows that are independent
  sparse_type G_;            // these, of length 1
  vector_type unit_values_;  // what they are equal to
  dense_ldlt<S> factors_;    // of GGᵀ
  decltype(detail::onto_range_of(G_, factors_)) range_projector_;
  decltype(detail::complement_of(range_projector_)) kernel_projector_;
  vector_type nearest_;  // x̄
};

template <class S>
equality_constraints(Eigen::SparseMatrix<S> const&, Eigen::Matrix<S, Eigen::Dynamic, 1> const&)
    -> equality_constraints<S>;

}  // namespace slant
