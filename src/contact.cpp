// SPDX-License-Identifier: MIT
//
// Tresca friction: one instance for all laws.
#include <slant/contact/solve.hpp>

static_assert(SLANT_USES_COMPILED, "SLANT_COMPILED is not the alignment of Eigen with these flags");

namespace slant::contact {

using matrix = Eigen::SparseMatrix<double>;

template solution<double> solve<friction_of_data, double>(friction_of_data, matrix const&,
                                                          data<double> const&,
                                                          solve_options<double> const&);
template solution<double> solve<double>(matrix const&, data<double> const&,
                                        solve_options<double> const&);

}  // namespace slant::contact
