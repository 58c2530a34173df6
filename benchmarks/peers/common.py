# SPDX-License-Identifier: MIT
"""Reads what bench_*_precision --export has written and prints the rows of its table.

A row is measured in a child process: its peak memory is its own, and it is ended after a limit of
processor seconds. (A limit set by the child itself would make its clock coarse, see
../support/child_process.hpp.) Needs numpy.
"""

import argparse
import json
import math
import os
import select
import signal
import statistics
import time

import numpy as np


class Late(Exception):
    """The time of a run is over."""


def read_matrix(path):
    """Rows, columns, values (all entries) and shape of a Matrix Market file."""
    with open(path, encoding="ascii") as text:
        symmetric = "symmetric" in text.readline()
        line = text.readline()
        while line.startswith("%"):
            line = text.readline()
        rows, columns, count = (int(word) for word in line.split())
        entries = np.loadtxt(text, ndmin=2) if count else np.zeros((0, 3))
    i, j, v = entries[:, 0].astype(int) - 1, entries[:, 1].astype(int) - 1, entries[:, 2]
    if symmetric:
        off = i != j
        i, j, v = np.r_[i, j[off]], np.r_[j, i[off]], np.r_[v, v[off]]
    return i, j, v, (rows, columns)


def multiply(matrix, x):
    """A x for a dense matrix or for read_matrix."""
    if isinstance(matrix, np.ndarray):
        return matrix @ x
    i, j, v, shape = matrix
    return np.bincount(i, v * x[j], minlength=shape[0])


class Case:
    """min ½ xᵀA x − bᵀx over bounds and discs; for contact scenes also the primal problem."""

    def __init__(self, folder):
        self.folder = folder
        with open(os.path.join(folder, "problem.txt"), encoding="ascii") as text:
            self.info = dict(line.split() for line in text)
        self.b, self.lower, self.upper = (self.vector(n) for n in ("b", "lower", "upper"))
        self.disc_first = self.vector("disc_first").astype(int)
        self.disc_radius = self.vector("disc_radius")
        self.reference = self.vector("reference_x")
        self.is_dense = self.info["operator"] == "dense"
        n = len(self.b)
        if self.is_dense:
            self.A = np.fromfile(os.path.join(folder, "A.f64")).reshape(n, n)
        else:
            self.A = read_matrix(os.path.join(folder, "A.mtx"))
        self.formulation = "dense dual" if self.is_dense else "separable"

    def vector(self, name):
        path = os.path.join(self.folder, name + ".txt")
        return np.loadtxt(path, ndmin=1) if os.path.getsize(path) else np.zeros(0)

    def has_primal(self):
        return os.path.exists(os.path.join(self.folder, "K.mtx"))

    def number(self, name):
        return float(self.info[name])

    def seconds_elsewhere(self):
        """To form A and b, and to get back from x to displacements."""
        return self.number("formation_seconds") + self.number("recovery_seconds")

    def error(self, x):
        """‖x − x*‖_A relative to the energy of the reference."""
        d = x - self.reference
        return math.sqrt(max(0.0, d @ multiply(self.A, d))) / self.number("energy_norm")


def arguments():
    parser = argparse.ArgumentParser()
    parser.add_argument("folder")
    parser.add_argument("--tolerances", default="1e-2,1e-4,1e-6,1e-8,1e-10,1e-12")
    parser.add_argument("--repeats", type=int, default=5)
    parser.add_argument("--limit", type=float, default=60)
    given = parser.parse_args()
    given.tolerances = [float(word) for word in given.tolerances.split(",")]
    return given


def peak_memory_mib():
    with open("/proc/self/status", encoding="ascii") as text:
        return next(int(line.split()[1]) for line in text if line.startswith("VmHWM")) / 1024


def child_seconds(process):
    """Processor seconds of a child, in ticks of the clock."""
    try:
        with open(f"/proc/{process}/stat", encoding="ascii") as text:
            words = text.read().rsplit(")", 1)[1].split()
        return (int(words[11]) + int(words[12])) / os.sysconf("SC_CLK_TCK")
    except (OSError, IndexError):
        return 0.0


def require_fine_clock():
    """The same check as in ../support/cpu_clock.hpp."""
    start = now = time.process_time()
    steps = 0
    while now < start + 0.02:
        before, now = now, time.process_time()
        steps += now > before
    if steps < 200:
        raise RuntimeError("the processor clock is too coarse; is a limit (ulimit -t) set?")


def in_child(limit, body):
    """What body() returns, "time_limit", or "failed"."""
    source, sink = os.pipe()
    child = os.fork()
    if child == 0:
        code = 2
        try:
            os.close(source)
            with os.fdopen(sink, "w") as pipe:
                json.dump(body(), pipe)
            code = 0
        except Late:
            code = 3
        except Exception as failure:  # a row that says so, not the end of the table
            os.write(2, f"{type(failure).__name__}: {failure}\n".encode())
        os._exit(code)
    os.close(sink)
    late = False
    text = b""
    while True:
        if not select.select([source], [], [], 0.1)[0]:
            if not late and child_seconds(child) > limit:
                late = True
                os.kill(child, signal.SIGKILL)
            continue
        part = os.read(source, 65536)
        if not part:
            break
        text += part
    os.close(source)
    code = os.waitstatus_to_exitcode(os.waitpid(child, 0)[1])
    if code == 0:
        return json.loads(text)
    return "time_limit" if late or code == 3 else "failed"


def measure(case, labels, given, before, run, error):
    """Rows of run(tolerance, deadline) → (x, iterations, status), from loose to tight."""
    library, method, formulation = labels
    for tolerance in given.tolerances:

        def body(tolerance=tolerance):
            require_fine_clock()
            seconds, memory = [], None
            while len(seconds) < given.repeats and (not seconds or seconds[0] <= 1):
                start = time.process_time()
                x, iterations, status = run(tolerance, start + given.limit)
                seconds.append(time.process_time() - start)
                memory = memory or peak_memory_mib()
            return [statistics.median_low(seconds), error(x), iterations, memory, status]

        row = in_child(2 * given.limit + 10, body)
        cells = ["", "", "", "", row]
        if isinstance(row, list):
            cells = [f"{row[0] + before:.5g}", f"{row[1]:.3e}", str(row[2]), f"{row[3]:.1f}", row[4]]
        info = case.info
        print(
            ",".join(
                [info["scene"], info["size"], info["unknowns"], library, method, formulation]
                + [f"{tolerance:g}"]
                + cells[:4]
                + [f"{case.number('linear_solve_seconds'):.5g}", cells[4]]
            ),
            flush=True,
        )
        if cells[4] != "converged":
            break
