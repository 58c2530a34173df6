// SPDX-License-Identifier: MIT
//
// Eigen's dense decompositions and the kernels of its products are compiled once, in
// eigen_instances.cpp, and not in every room whose tests compare with them: that would be a fifth
// of what a room takes to compile. Included first in every room, by CMakeLists.txt.
#pragma once

#include <Eigen/Dense>
#include <Eigen/OrderingMethods>
#include <Eigen/SparseCore>
#include <Eigen/SparseLU>

#include <ostream>

#if !defined(SLANT_EIGEN_INSTANCE)
#define SLANT_EIGEN_INSTANCE extern template
#endif

namespace Eigen {

SLANT_EIGEN_INSTANCE class PartialPivLU<MatrixXd>;
SLANT_EIGEN_INSTANCE class FullPivLU<MatrixXd>;
SLANT_EIGEN_INSTANCE class HouseholderQR<MatrixXd>;
SLANT_EIGEN_INSTANCE class ColPivHouseholderQR<MatrixXd>;
SLANT_EIGEN_INSTANCE class CompleteOrthogonalDecomposition<MatrixXd>;
SLANT_EIGEN_INSTANCE class LLT<MatrixXd>;
SLANT_EIGEN_INSTANCE class LDLT<MatrixXd>;
SLANT_EIGEN_INSTANCE class JacobiSVD<MatrixXd>;
SLANT_EIGEN_INSTANCE class SelfAdjointEigenSolver<MatrixXd>;

// Templates inside of a class are instances of their own.
SLANT_EIGEN_INSTANCE LLT<MatrixXd>& LLT<MatrixXd>::compute(EigenBase<MatrixXd> const&);
SLANT_EIGEN_INSTANCE LDLT<MatrixXd>& LDLT<MatrixXd>::compute(EigenBase<MatrixXd> const&);
SLANT_EIGEN_INSTANCE SelfAdjointEigenSolver<MatrixXd>& SelfAdjointEigenSolver<MatrixXd>::compute(
    EigenBase<MatrixXd> const&, int);
SLANT_EIGEN_INSTANCE void LLT<MatrixXd>::_solve_impl(VectorXd const&, VectorXd&) const;
SLANT_EIGEN_INSTANCE void LDLT<MatrixXd>::_solve_impl(VectorXd const&, VectorXd&) const;
SLANT_EIGEN_INSTANCE void LDLT<MatrixXd>::_solve_impl_transposed<true>(VectorXd const&,
                                                                       VectorXd&) const;
SLANT_EIGEN_INSTANCE void FullPivLU<MatrixXd>::_solve_impl(VectorXd const&, VectorXd&) const;
SLANT_EIGEN_INSTANCE void ColPivHouseholderQR<MatrixXd>::_solve_impl(VectorXd const&,
                                                                     VectorXd&) const;
SLANT_EIGEN_INSTANCE void CompleteOrthogonalDecomposition<MatrixXd>::_solve_impl(VectorXd const&,
                                                                                 VectorXd&) const;

SLANT_EIGEN_INSTANCE class SparseLU<SparseMatrix<double>, COLAMDOrdering<int>>;
SLANT_EIGEN_INSTANCE bool SparseLU<SparseMatrix<double>, COLAMDOrdering<int>>::_solve_impl(
    MatrixBase<VectorXd> const&, MatrixBase<VectorXd>&) const;

SLANT_EIGEN_INSTANCE class SparseMatrix<double>;

namespace internal {

// A = B, A = B C, A = B ± C, A = dense, of sparse matrices; an ordering for factors.
using sparse = SparseMatrix<double>;
SLANT_EIGEN_INSTANCE void assign_sparse_to_sparse(sparse&, sparse const&);
SLANT_EIGEN_INSTANCE void assign_sparse_to_sparse(sparse&,
                                                  Product<sparse, sparse, AliasFreeProduct> const&);
SLANT_EIGEN_INSTANCE void assign_sparse_to_sparse(
    sparse&, CwiseBinaryOp<scalar_sum_op<double>, sparse const, sparse const> const&);
SLANT_EIGEN_INSTANCE void assign_sparse_to_sparse(
    sparse&, CwiseBinaryOp<scalar_difference_op<double>, sparse const, sparse const> const&);
SLANT_EIGEN_INSTANCE void assign_sparse_to_sparse(sparse&, SparseView<MatrixXd> const&);
SLANT_EIGEN_INSTANCE void minimum_degree_ordering(sparse&,
                                                  PermutationMatrix<Dynamic, Dynamic, int>&);

// What a failing assertion prints.
SLANT_EIGEN_INSTANCE std::ostream& print_matrix(std::ostream&, VectorXd const&, IOFormat const&);
SLANT_EIGEN_INSTANCE std::ostream& print_matrix(std::ostream&, MatrixXd const&, IOFormat const&);

// C += A B, C by columns.
SLANT_EIGEN_INSTANCE struct general_matrix_matrix_product<Index, double, ColMajor, false, double,
                                                          ColMajor, false, ColMajor, 1>;
SLANT_EIGEN_INSTANCE struct general_matrix_matrix_product<Index, double, RowMajor, false, double,
                                                          ColMajor, false, ColMajor, 1>;
SLANT_EIGEN_INSTANCE struct general_matrix_matrix_product<Index, double, ColMajor, false, double,
                                                          RowMajor, false, ColMajor, 1>;
SLANT_EIGEN_INSTANCE struct gebp_kernel<
    double, double, Index, blas_data_mapper<double, Index, ColMajor, 0, 1>,
    gebp_traits<double, double>::mr, gebp_traits<double, double>::nr, false, false>;

// y += α A x.
#define SLANT_EIGEN_GEMV(A, X)                                                   \
  SLANT_EIGEN_INSTANCE struct general_matrix_vector_product<                     \
      Index, double, const_blas_data_mapper<double, Index, A>, A, false, double, \
      const_blas_data_mapper<double, Index, X>, false, 0>
SLANT_EIGEN_GEMV(ColMajor, ColMajor);
SLANT_EIGEN_GEMV(ColMajor, RowMajor);
SLANT_EIGEN_GEMV(RowMajor, ColMajor);
SLANT_EIGEN_GEMV(RowMajor, RowMajor);
#undef SLANT_EIGEN_GEMV

}  // namespace internal
}  // namespace Eigen
