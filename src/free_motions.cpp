// SPDX-License-Identifier: MIT
//
// Kernels of stiffness matrices and their names. Apart from the rest, because every route of
// contact needs them, and no law of friction.
#include <slant/contact/free_motions.hpp>

static_assert(SLANT_USES_COMPILED, "SLANT_COMPILED is not the alignment of Eigen with these flags");

namespace slant {

using sparse_matrix = Eigen::SparseMatrix<double>;

template Eigen::MatrixXd detail::orthonormal_basis<double>(Eigen::MatrixXd);
template std::vector<index> fixing_rows<Eigen::MatrixXd>(Eigen::MatrixBase<Eigen::MatrixXd> const&);
template Eigen::MatrixXd computed_kernel<double>(sparse_matrix const&);

namespace contact {

template free_motions<double> find_free_motions<double>(sparse_matrix const&,
                                                        node_layout<double> const&);
template std::string name_motion<double, Eigen::VectorXd>(sparse_matrix const&,
                                                          Eigen::VectorXd const&,
                                                          node_layout<double> const&);

}  // namespace contact
}  // namespace slant
