// SPDX-License-Identifier: MIT
//
// What may precondition a method for a quadratic program.
#pragma once

#include <slant/concepts/linear_operator.hpp>

namespace slant {

/// A self-adjoint semidefinite M ≈ A⁻¹ for the vectors of the problem.
template <class M, class QP> concept preconditioner_for = psd_operator<M, typename QP::vector_type>;

}  // namespace slant
