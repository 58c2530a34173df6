// SPDX-License-Identifier: MIT
//
// The tentative prolongation of smoothed aggregation [Vaněk, Mandel, Brezina 1996, Algorithm 1]:
// on each aggregate the candidates B of the near kernel are made orthonormal, B = Q R. Q is what
// the coarse unknowns of the aggregate stand for, R are the candidates of the coarse level: P₀ R =
// B, so that the range of P₀ holds the near kernel exactly.
//
// Candidates that depend on the others there (the rotation of a single node) get no coarse unknown.
#pragma once

#include <slant/multilevel/aggregation.hpp>

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include <cmath>
#include <limits>
#include <vector>

namespace slant::detail {

template <class S>
using row_major_sparse = Eigen::SparseMatrix<S, Eigen::RowMajor>;

/// P₀, and nodes and candidates of the coarse level.
template <class S>
struct tentative_prolongation {
  using matrix_type = Eigen::Matrix<S, Eigen::Dynamic, Eigen::Dynamic>;

  row_major_sparse<S> P;
  node_blocks nodes;
  matrix_type candidates;

  tentative_prolongation(aggregation const& a, node_blocks const& fine, matrix_type const& B) {
    std::vector<std::vector<int>> members(static_cast<std::size_t>(a.count));
    for (index i = 0; i < fine.count(); ++i) {
      auto& list = members[static_cast<std::size_t>(a.of[static_cast<std::size_t>(i)])];
      for (int j = fine.begin(i); j < fine.end(i); ++j) list.push_back(j);
    }
    std::vector<Eigen::Triplet<S>> entries;
    entries.reserve(static_cast<std::size_t>(B.size()));
    matrix_type coarse(a.count * B.cols(), B.cols());
    int next = 0;
    matrix_type Q, R;
    for (auto const& list : members) {
      orthonormalise(B, list, Q, R);
      for (index c = 0; c < Q.cols(); ++c) {
        for (std::size_t j = 0; j < list.size(); ++j) {
          S const value = Q(static_cast<index>(j), c);
          if (value != S(0)) entries.emplace_back(list[j], next + static_cast<int>(c), value);
        }
      }
      coarse.middleRows(next, R.rows()) = R;
      next += static_cast<int>(R.rows());
      nodes.first.push_back(next);
    }
    candidates = coarse.topRows(next);
    P.resize(B.rows(), next);
    P.setFromTriplets(entries.begin(), entries.end());
  }

 private:
  /// Q with orthonormal columns that span the rows `list` of B, R = QᵀB. Gram and Schmidt, twice.
  static void orthonormalise(matrix_type const& B, std::vector<int> const& list, matrix_type& Q,
                             matrix_type& R) {
    using std::sqrt;
    auto const rows = static_cast<index>(list.size());
    Q.resize(rows, B.cols());
    matrix_type const part = B(list, Eigen::all);
    index rank = 0;
    for (index c = 0; c < B.cols(); ++c) {
      auto q = Q.col(rank);
      q = part.col(c);
      S const size = q.norm();
      for (int twice = 0; twice < 2; ++twice) {
        for (index l = 0; l < rank; ++l) q -= Q.col(l).dot(q) * Q.col(l);
      }
      S const left = q.norm();
      if (!(left > sqrt(std::numeric_limits<S>::epsilon()) * size)) continue;
      q /= left;
      if (++rank == rows) break;
    }
    Q.conservativeResize(rows, rank);
    R = Q.transpose() * part;
  }
};

}  // namespace slant::detail
