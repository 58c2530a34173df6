// SPDX-License-Identifier: MIT
// case MATRIX: A must.*has_plain_apply
// case MATRIX, clang: A must.*'has_plain_apply['<]
// case EXPRESSION: b must be a slant::vector.*'owns_its_entries['<]
// case EXPRESSION, max-lines-clang: 25
// case ROW: b must be a slant::vector.*'is_no_row['<]
// case ROW, max-lines-clang: 28
// case WITHOUT_PROJECT: the set must.*'has_project['<]
// case WITHOUT_PROJECT, max-lines-clang: 35
// case WITHOUT_STATE: the set must.*has_visit
// case WITHOUT_STATE, clang: the set must.*'has_visit['<]
// max-lines-gcc: 20
// max-lines-clang: 30
//
// A matrix is not an operator: slant::matrix(A) makes one of it. A linear term that is an expression
// or a row: nothing is said of A and the set. A set minus its projection; for KPRGP one that is neither
// a block with states nor a product of such blocks.
#include <slant/slant.hpp>

struct nonnegative {
  slant::index n;
  slant::index size() const { return n; }
#ifndef WITHOUT_PROJECT
  void project(auto const& x, auto& y) const { y = x.cwiseMax(0.0); }
#endif
  bool contains(auto const& x) const { return (x.array() >= 0.0).all(); }
  double step_to_boundary(auto const& x, auto const&) const { return x.minCoeff(); }
#ifndef WITHOUT_STATE
  slant::block_state state(auto const& x) const {
    return x.minCoeff() > 0 ? slant::block_state::free : slant::block_state::fixed;
  }
#endif
};

auto problem(Eigen::MatrixXd const& matrix, Eigen::VectorXd const& f) {
#ifdef MATRIX
  auto const& A = matrix;
#else
  auto const A = slant::matrix<slant::self_adjoint, slant::positive_semidefinite>(matrix);
#endif
#ifdef EXPRESSION
  auto const b = 2 * f;
#elif defined ROW
  Eigen::RowVectorXd const b = 2 * f.transpose();
#else
  Eigen::VectorXd const b = 2 * f;
#endif
  slant::separable_qp const qp{A, b, nonnegative{f.size()}};
  return slant::kprgp{qp};
}
