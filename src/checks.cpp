// SPDX-License-Identifier: MIT
//
// What looks at data and at solutions from outside of all methods.
#include <slant/contact/friction/verify.hpp>
#include <slant/contact/optimality.hpp>
#include <slant/contact/plausibility.hpp>

static_assert(SLANT_USES_COMPILED, "SLANT_COMPILED is not the alignment of Eigen with these flags");

namespace slant::contact {

using sparse_matrix = Eigen::SparseMatrix<double>;
using vector = Eigen::VectorXd;

template optimality<double> check_optimality<double>(sparse_matrix const&, data<double> const&,
                                                     vector const&, vector const&);
template friction_check<double> verify<double>(friction_problem<double> const&, vector const&,
                                               double);
template std::vector<plausibility_warning> check_plausibility<double>(sparse_matrix const&,
                                                                      data<double> const&,
                                                                      node_layout<double> const&);
template std::vector<plausibility_warning> check_plausibility<double, vector>(
    sparse_matrix const&, data<double> const&, vector const&, vector const&,
    node_layout<double> const&);

}  // namespace slant::contact
