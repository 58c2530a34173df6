// SPDX-License-Identifier: MIT
#include <slant/contact/certified_coulomb.hpp>

static_assert(SLANT_USES_COMPILED, "SLANT_COMPILED is not the alignment of Eigen with these flags");

namespace slant::contact {

using matrix = Eigen::SparseMatrix<double>;
using vector = Eigen::VectorXd;

template certified_coulomb_result<vector> certified_coulomb<friction_line, double>(
    friction_line, matrix const&, data<double>, vector const&,
    certified_coulomb_options<double> const&);
template certified_coulomb_result<vector> certified_coulomb<friction_disc, double>(
    friction_disc, matrix const&, data<double>, vector const&,
    certified_coulomb_options<double> const&);

}  // namespace slant::contact
