// SPDX-License-Identifier: MIT
#include <slant/contact/solve_obstacle.hpp>

namespace slant::contact {

using matrix = Eigen::SparseMatrix<double>;
using vector = Eigen::VectorXd;

template obstacle_solution<double> solve_obstacle<double>(matrix const&, vector const&,
                                                          matrix const&, vector const&,
                                                          obstacle_options<double> const&);

}  // namespace slant::contact
