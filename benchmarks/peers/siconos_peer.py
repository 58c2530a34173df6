#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Siconos' solvers for Tresca friction ("cylinder") on a problem of bench_contact_precision.

    siconos_peer.py FOLDER [--tolerances LIST] [--repeats N] [--limit S]

    min ½ rᵀW r + qᵀr,  r_n ≥ 0,  ‖r_t‖ ≤ g,   W = A and q = −b in the order n, t, t of a node

Block Gauss–Seidel (NSGS) with the projection on cylinders, with and without local iteration, and
the fixed point method for variational inequalities. A solver that crashes is a row `failed`: in
python3-siconos 4.4.0+dfsg-2 of Debian 12 all three do (the first by an assertion, the others by
segmentation faults), while its NSGS and fixed point method for Coulomb's law run with the same set-up.
"""

import importlib.metadata
import sys

import numpy as np

try:
    import siconos.numerics as sn
except ImportError:
    print("Siconos: not found", file=sys.stderr)
    sys.exit(0)

import common

given = common.arguments()
case = common.Case(given.folder)
m = len(case.disc_radius)
if not case.is_dense or len(case.b) != 3 * m:
    print(f"Siconos: {case.info['scene']} is no contact in space, left out", file=sys.stderr)
    sys.exit(0)
try:
    version = importlib.metadata.version("siconos")
except importlib.metadata.PackageNotFoundError:
    version = "?"
print(f"Siconos {version} by its metadata, default settings, at most 100000 iterations", file=sys.stderr)

order = np.array([[i, m + 2 * i, m + 2 * i + 1] for i in range(m)]).ravel()
W = np.ascontiguousarray(case.A[np.ix_(order, order)])
q = -case.b[order]
radius = np.ascontiguousarray(case.disc_radius)


def solver(function, number, local=None):
    def run(tolerance, _):
        options = sn.SolverOptions(number)
        if local is not None:
            sn.solver_options_update_internal(options, 0, local)
        options.iparam[sn.SICONOS_IPARAM_MAX_ITER] = 100000
        options.dparam[sn.SICONOS_DPARAM_TOL] = tolerance
        r, v, x = np.zeros(3 * m), np.zeros(3 * m), np.zeros(3 * m)
        failed = function(sn.FrictionContactProblem(3, m, W, q, radius), r, v, options)
        x[order] = r
        steps = int(options.iparam[sn.SICONOS_IPARAM_ITER_DONE])
        return x, steps, "stalled" if failed else "converged"

    return run


local = "SICONOS_FRICTION_3D_ONECONTACT_ProjectionOnCylinder"
solvers = {
    "nsgs": (sn.fc3d_nsgs, sn.SICONOS_FRICTION_3D_NSGS, getattr(sn, local)),
    "nsgs_local": (
        sn.fc3d_nsgs,
        sn.SICONOS_FRICTION_3D_NSGS,
        getattr(sn, local + "WithLocalIteration"),
    ),
    "vi_fixed_point": (
        sn.fc3d_VI_FixedPointProjection_Cylinder,
        sn.SICONOS_FRICTION_3D_VI_FPP_Cylinder,
    ),
}
for name, parts in solvers.items():
    common.measure(
        case,
        ("Siconos", name, "dense dual"),
        given,
        case.seconds_elsewhere(),
        solver(*parts),
        case.error,
    )
