// SPDX-License-Identifier: MIT
#include <slant/contact/solve_friction.hpp>

static_assert(SLANT_USES_COMPILED, "SLANT_COMPILED is not the alignment of Eigen with these flags");

namespace slant::contact {

template friction_result<double> solve_friction<double>(friction_problem<double> const&,
                                                        friction_options<double> const&,
                                                        Eigen::VectorXd const&);

}  // namespace slant::contact
