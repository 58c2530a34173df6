// SPDX-License-Identifier: MIT
#include <slant/contact/solve_obstacle.hpp>

static_assert(SLANT_USES_COMPILED, "SLANT_COMPILED is not the alignment of Eigen with these flags");

namespace slant::contact {

using matrix = Eigen::SparseMatrix<double>;
using vector = Eigen::VectorXd;

template obstacle_solution<double> solve_obstacle<double>(matrix const&, vector const&,
                                                          matrix const&, vector const&,
                                                          obstacle_options<double> const&);

}  // namespace slant::contact
