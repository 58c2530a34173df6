// SPDX-License-Identifier: MIT
//
// Tresca friction. In one unit: the laws share most of what they need.
#include <slant/contact/solve.hpp>
#include <slant/contact/solve_floating.hpp>

static_assert(SLANT_USES_COMPILED, "SLANT_COMPILED is not the alignment of Eigen with these flags");

namespace slant::contact {

using matrix = Eigen::SparseMatrix<double>;

template solution<double> solve<frictionless, double>(frictionless, matrix const&,
                                                      data<double> const&,
                                                      solve_options<double> const&);
template solution<double> solve<friction_line, double>(friction_line, matrix const&,
                                                       data<double> const&,
                                                       solve_options<double> const&);
template solution<double> solve<friction_disc, double>(friction_disc, matrix const&,
                                                       data<double> const&,
                                                       solve_options<double> const&);
template solution<double> solve<double>(matrix const&, data<double> const&,
                                        solve_options<double> const&);

template floating_solution<double> solve_floating<double>(matrix const&, data<double> const&,
                                                          floating_options<double> const&);

}  // namespace slant::contact
