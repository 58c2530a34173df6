// SPDX-License-Identifier: MIT
//
// Optimal values that others have printed for the same discrete problems.
//
// CUTEst: remarks SOLTN in JNLBRNG1.SIF, where PT and PY count the nodes on the edges too. PETSc:
// src/tao/bound/tutorials/output/jbearing2_1.out, _2.out and _3.out. COPS: Dolan, Moré and Munson,
// Benchmarking Optimization Software with COPS 3.0, ANL/MCS-TM-273, 2004. (COPS' own model of the
// bearing has another weight; its values are not comparable. CUTEst's models of the torsion and of
// the obstacles count the triangles at the edges only half; the remarks in JNLBRNG2.SIF, ε = 0.5,
// have the right digits and the decimal point one place too far left.)
#pragma once

#include <Eigen/Core>
#include <array>

namespace fem {

/// A printed value. The last digit counts: solvers stop somewhere, and some lists cut digits off.
struct printed_membrane {
  Eigen::Index nx;
  Eigen::Index ny;
  double parameter;  ///< c of the torsion, ε of the bearing
  double value;
  double last_digit;  ///< one unit of it
  char const* source;
};

inline constexpr std::array printed_torsions{
    printed_membrane{50, 50, 5, -4.18087e-1, 1e-6, "COPS"}};

inline constexpr std::array printed_bearings{
    printed_membrane{8, 12, 0.1, -0.183437, 1e-6, "PETSc"},
    printed_membrane{10, 16, 0.9, -15.607, 1e-3, "PETSc"},
    printed_membrane{50, 50, 0.99, -60.1509, 1e-4, "PETSc"},
    printed_membrane{2, 2, 0.1, -0.22474, 1e-5, "CUTEst"},
    printed_membrane{8, 8, 0.1, -0.17896, 1e-5, "CUTEst"},
    printed_membrane{21, 21, 0.1, -0.18005, 1e-5, "CUTEst"},
    printed_membrane{30, 30, 0.1, -0.18030, 1e-5, "CUTEst"},
    printed_membrane{73, 73, 0.1, -0.18055, 1e-5, "CUTEst"},
    printed_membrane{98, 98, 0.1, -0.18057, 1e-5, "CUTEst"},
    printed_membrane{123, 123, 0.1, -0.18058, 1e-5, "CUTEst"}};

}  // namespace fem
