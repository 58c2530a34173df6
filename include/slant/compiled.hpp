// SPDX-License-Identifier: MIT
//
// What the component slant::compiled has compiled once, for double. A program that links it says
// what it said before; headers of these functions then promise the compiler that their instances
// exist elsewhere,
//
//     kprgp, symmetric_newton, interior_point, as_s
//                                   for erased programs (problems/any_qp.hpp)
//     dense_ldlt                    also for float
//     contact::solve                Tresca friction, each law and the choice by the data
//     contact::certified_coulomb    Coulomb friction
//     multigrid                     and what contact without factors has in common
//     contact::solve_friction       Coulomb friction from W, q, μ
//     contact::find_free_motions    and name_motion; computed_kernel, fixing_rows
//     contact::check_optimality     and verify, check_plausibility
//
// and it takes seconds instead of a minute. Other scalars, calls with observers, and everything
// else is instantiated where it is used, as without the component.
//
// The target defines SLANT_COMPILED as the alignment, in bytes, that Eigen had when the library was
// built. Flags such as -march=native change it, and with it how Eigen allocates: what is linked
// together must agree, so with another alignment, or with the checking containers of libstdc++, all
// is instantiated anew.
#pragma once

#include <Eigen/Core>

#if defined(SLANT_COMPILED) && !defined(_GLIBCXX_DEBUG)
#if SLANT_COMPILED == EIGEN_MAX_ALIGN_BYTES
#define SLANT_USES_COMPILED 1
#endif
#endif
#if !defined(SLANT_USES_COMPILED)
#define SLANT_USES_COMPILED 0
#endif
