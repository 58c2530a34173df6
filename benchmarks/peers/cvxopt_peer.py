#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""CVXOPT's cone quadratic programs on a problem that bench_*_precision --export has written.

    cvxopt_peer.py FOLDER [--tolerances LIST] [--repeats N] [--limit S]

    separable   min ½ xᵀA x − bᵀx over bounds and second-order cones (r, x_j, x_{j+1})
    primal      min ½ uᵀK u − fᵀu + Σ g_i t_i,  N u ≤ d,  (t_i, (T u)_i) in second-order cones

The KKT systems are reduced to P + GᵀW⁻²G and factored by LAPACK for a dense A, by CHOLMOD for a
sparse one, with the symbolic analysis made once: CVXOPT's own solvers would form dense matrices.
The tolerance is that of the relative gap and of the residuals.
"""

import sys
import time

import numpy as np

try:
    import cvxopt
    from cvxopt import cholmod, lapack, matrix, solvers, sparse, spmatrix
except ImportError:
    print("CVXOPT: not found", file=sys.stderr)
    sys.exit(0)

import common


def square(W, dims):
    """W⁻² as a sparse matrix: a diagonal, and 3 × 3 (2 × 2) blocks of the cones."""
    values = [np.array(W["di"]).ravel() ** 2]
    rows = [np.arange(dims["l"])]
    columns = [np.arange(dims["l"])]
    first = dims["l"]
    for size, v, beta in zip(dims["q"], W["v"], W["beta"]):
        w = np.array(v).ravel()
        w[1:] = -w[1:]
        J = np.diag(np.r_[1.0, -np.ones(size - 1)])
        inverse = (2 * np.outer(w, w) - J) / beta
        i, j = np.meshgrid(np.arange(size), np.arange(size), indexing="ij")
        values.append((inverse @ inverse).ravel())
        rows.append(first + i.ravel())
        columns.append(first + j.ravel())
        first += size
    cat = lambda parts, kind: matrix(np.concatenate(parts).astype(kind))
    return spmatrix(cat(values, float), cat(rows, int), cat(columns, int), (first, first))


def kkt_solver(P, G, dims, deadline):
    """CVXOPT's kktsolver: factors P + GᵀW⁻²G. A time that is over ends it."""
    dense = isinstance(P, matrix)
    symbolic = []

    def factor(W):
        if time.process_time() > deadline:
            raise common.Late
        S = square(W, dims)
        GSG = G.T * S * G
        if dense:
            H = +P
            i, j = np.array(GSG.I).ravel(), np.array(GSG.J).ravel()
            np.asarray(H)[i, j] += np.array(GSG.V).ravel()
            lapack.potrf(H)
            solve = lambda x: lapack.potrs(H, x)
        else:
            H = P + GSG
            if not symbolic:
                symbolic.append(cholmod.symbolic(H))
            cholmod.numeric(H, symbolic[0])
            solve = lambda x: cholmod.solve(symbolic[0], x)

        def kkt(x, y, z):
            x += G.T * (S * z)
            solve(x)
            r = G * x - z
            cvxopt.misc.scale(r, W, trans="T", inverse="I")
            z[:] = r

        return kkt

    return factor


def solve(P, q, G, h, dims, tolerance, deadline):
    solvers.options.update(
        show_progress=False, abstol=1e-300, reltol=tolerance, feastol=tolerance, maxiters=200
    )
    result = solvers.coneqp(P, q, G, h, dims, kktsolver=kkt_solver(P, G, dims, deadline))
    status = "converged" if result["status"] == "optimal" else "stalled"
    return np.array(result["x"]).ravel(), result["iterations"], status


def cones(case):
    """G x + s = h with the finite bounds, then the discs."""
    n = len(case.b)
    low, up = np.flatnonzero(np.isfinite(case.lower)), np.flatnonzero(np.isfinite(case.upper))
    l, q = len(low) + len(up), len(case.disc_first)
    discs = l + 3 * np.arange(q)
    rows = np.r_[np.arange(l), discs + 1, discs + 2]
    columns = np.r_[low, up, case.disc_first, case.disc_first + 1]
    values = np.r_[-np.ones(len(low)), np.ones(len(up)), -np.ones(2 * q)]
    h = np.zeros(l + 3 * q)
    h[:l] = np.r_[-case.lower[low], case.upper[up]]
    h[discs] = case.disc_radius
    G = spmatrix(values, rows.tolist(), columns.tolist(), (l + 3 * q, n))
    return G, matrix(h), {"l": l, "q": [3] * q, "s": []}


def separable(case, tolerance, deadline):
    if case.is_dense:
        P = matrix(case.A)
    else:
        i, j, v, shape = case.A
        P = spmatrix(v, i.tolist(), j.tolist(), shape)
    G, h, dims = cones(case)
    return solve(P, matrix(-case.b), G, h, dims, tolerance, deadline)


class Primal:
    def __init__(self, case):
        read = lambda name: common.read_matrix(f"{case.folder}/{name}.mtx")
        self.K, self.N, self.T = read("K"), read("N"), read("T")
        self.f, self.d, self.g = (case.vector(name) for name in "fdg")
        self.reference = case.vector("reference_u")
        self.norm = np.sqrt(self.reference @ common.multiply(self.K, self.reference))

    def error(self, x):
        e = x[: len(self.f)] - self.reference
        return float(np.sqrt(e @ common.multiply(self.K, e)) / self.norm)

    def solve(self, tolerance, deadline):
        n, m = len(self.f), len(self.d)
        k = self.T[3][0] // m
        as_sparse = lambda M, shape: spmatrix(M[2], M[0].tolist(), M[1].tolist(), shape)
        P = as_sparse(self.K, (n + m, n + m))
        first = m + (k + 1) * np.arange(m)
        node, part = self.T[0] // k, self.T[0] % k
        rows = np.r_[self.N[0], first, first[node] + 1 + part]
        columns = np.r_[self.N[1], n + np.arange(m), self.T[1]]
        values = np.r_[self.N[2], -np.ones(m), -self.T[2]]
        G = spmatrix(values, rows.tolist(), columns.tolist(), (m + (k + 1) * m, n + m))
        h = matrix(np.r_[self.d, np.zeros((k + 1) * m)])
        q = matrix(np.r_[-self.f, self.g])
        return solve(P, q, G, h, {"l": m, "q": [k + 1] * m, "s": []}, tolerance, deadline)


given = common.arguments()
case = common.Case(given.folder)
print(f"CVXOPT {cvxopt.__version__}, coneqp, KKT by LAPACK or CHOLMOD", file=sys.stderr)
common.measure(
    case,
    ("CVXOPT", "coneqp", case.formulation),
    given,
    case.seconds_elsewhere(),
    lambda tolerance, deadline: separable(case, tolerance, deadline),
    case.error,
)
if case.has_primal():
    primal = Primal(case)
    common.measure(
        case, ("CVXOPT", "coneqp", "primal"), given, 0, primal.solve, primal.error
    )
