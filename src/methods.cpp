// SPDX-License-Identifier: MIT
//
// The usual methods, for every program on Eigen::VectorXd with blocks of the usual kinds.
#include <slant/methods/interior_point.hpp>
#include <slant/methods/kprgp.hpp>
#include <slant/methods/symmetric_newton.hpp>

static_assert(SLANT_USES_COMPILED, "SLANT_COMPILED is not the alignment of Eigen with these flags");

namespace slant {

template struct gradient_point<any_qp<double, definite_laws>>;
template struct gradient_point<any_qp<double, semidefinite_laws>>;
template struct symmetric_newton_state<any_qp<double, definite_laws>, identity_operator>;
template struct symmetric_newton_state<any_qp<double, semidefinite_laws>, identity_operator>;
template class detail::proportioning_steps<any_qp<double, definite_laws>, reduced_gradient_release>;
template class detail::proportioning_steps<any_qp<double, semidefinite_laws>,
                                           reduced_gradient_release>;
template class detail::symmetric_newton_steps<any_qp<double, definite_laws>, identity_operator>;
template class detail::symmetric_newton_steps<any_qp<double, semidefinite_laws>, identity_operator>;
template class detail::interior_point_steps<any_qp<double, definite_laws>, identity_operator>;
template class detail::interior_point_steps<any_qp<double, semidefinite_laws>, identity_operator>;

// With preconditioners.
using preconditioner = any_operator<Eigen::VectorXd, semidefinite_laws>;
template class detail::symmetric_newton_steps<any_qp<double, definite_laws>, preconditioner>;
template class detail::symmetric_newton_steps<any_qp<double, semidefinite_laws>, preconditioner>;
template class detail::interior_point_steps<any_qp<double, definite_laws>, preconditioner>;
template class detail::interior_point_steps<any_qp<double, semidefinite_laws>, preconditioner>;

}  // namespace slant
