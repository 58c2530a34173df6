#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Makes the page of results from what precision.sh has measured.

    results.py FOLDER

reads precision.csv, growth.csv, peers_*.txt and machine.md in FOLDER, those that are there, and
writes RESULTS.md and, with matplotlib, precision.png. Every number on the page comes from there;
where another library is faster, the page says so.
"""

import csv
import math
import os
import sys

OURS_ERROR = 1e-8
PEER_ERROR = 1e-6
LINEAR = "K u = f by multigrid"


class Row:
    def __init__(self, cells):
        number = lambda name: float(cells[name]) if cells[name] else math.nan
        self.scene, self.size, self.status = cells["scene"], cells["size"], cells["status"]
        self.library, self.method = cells["library"], cells["method"]
        self.formulation = cells["formulation"]
        self.unknowns = int(cells["unknowns"])
        self.tolerance, self.seconds, self.error = map(number, ("tolerance", "seconds", "error"))
        self.memory, self.linear = number("memory_mib"), number("linear_solve_seconds")

    def case(self):
        return (self.scene, int(self.size))

    def is_linear(self):
        """One linear solve with the same matrix, by multigrid."""
        return self.formulation == LINEAR

    def is_run(self):
        """A method at a tolerance, with a time and an error."""
        return (not math.isnan(self.seconds) and not math.isnan(self.error) and self.error >= 0
                and not self.is_linear())

    def is_without_factors(self):
        return self.formulation == "displacements"

    def is_ours(self):
        return self.library == "slant"

    def label(self):
        if self.is_ours():
            return self.method
        return f"{self.library} {self.method}, {self.formulation}"


def read(path):
    if not os.path.exists(path):
        return []
    with open(path, encoding="utf-8", newline="") as text:
        return [Row(cells) for cells in csv.DictReader(text)]


def cases(rows):
    return list(dict.fromkeys(row.case() for row in rows))


def fastest(rows, case, ours, error, which=lambda row: True):
    """The quickest run within that error, of those which are asked for, or None."""
    good = [row for row in rows if row.case() == case and row.is_run() and which(row)
            and row.is_ours() == ours and row.error <= error]
    return min(good, key=lambda row: row.seconds, default=None)


def fastest_linear(rows, case, ours):
    """The quickest linear solve by multigrid, or None."""
    good = [row for row in rows if row.case() == case and row.is_linear()
            and row.is_ours() == ours and row.status == "converged"]
    return min(good, key=lambda row: row.seconds, default=None)


def one(rows, case, method):
    """The row of a single number, such as the linear solve."""
    return next((r for r in rows if r.case() == case and r.method == method), None)


def table(head, lines):
    text = [head, ["---"] * len(head), *lines]
    return "\n".join(f"| {' | '.join(line)} |" for line in text) + "\n"


def name_of(case):
    return f"{case[0]} {case[1]}"


def seconds(value):
    return f"{value:.3g} s"


def ratio(run, reference, digits):
    """run's time over that of a reference, both of which may be missing."""
    if not run or not reference:
        return ""
    return f"{run.seconds / reference.seconds:.{digits}f}"


def time_of(run):
    return f"{seconds(run.seconds)}, `{run.method}`" if run else ""


def unknowns_of(rows, case):
    return str(next(row.unknowns for row in rows if row.case() == case))


def precision_table(rows):
    lines = []
    for case in cases(rows):
        linear = one(rows, case, "linear_solve")
        best = fastest(rows, case, True, OURS_ERROR)
        ours = fastest(rows, case, True, PEER_ERROR)
        peer = fastest(rows, case, False, PEER_ERROR)
        lines.append([name_of(case), unknowns_of(rows, case), seconds(linear.seconds) if linear else "",
                      time_of(best), ratio(best, linear, 2),
                      f"{seconds(peer.seconds)}, {peer.label()}" if peer else "", ratio(peer, ours, 1)])
    head = ["scene, size", "unknowns", "linear solve", f"ours, error ≤ {OURS_ERROR:g}",
            "over linear solve", f"fastest other, error ≤ {PEER_ERROR:g}",
            f"it over ours, both ≤ {PEER_ERROR:g}"]
    return table(head, lines)


def growth_table(rows):
    lines = []
    for case in cases(rows):
        linear = one(rows, case, "linear_solve")
        line = [name_of(case), unknowns_of(rows, case), seconds(linear.seconds) if linear else "",
                f"{linear.memory:.0f}" if linear else ""]
        for without in (False, True):
            best = fastest(rows, case, True, OURS_ERROR, lambda r: r.is_without_factors() == without)
            line += [time_of(best), ratio(best, linear, 2), f"{best.memory:.0f}" if best else ""]
        peer = fastest(rows, case, False, PEER_ERROR)
        line.append(f"{seconds(peer.seconds)}, {peer.label()}" if peer else "")
        lines.append(line)
    head = ["scene, size", "unknowns", "linear solve", "its MiB",
            f"with factors, error ≤ {OURS_ERROR:g}", "over linear solve", "its MiB",
            f"without, error ≤ {OURS_ERROR:g}", "over linear solve", "its MiB",
            f"fastest other, error ≤ {PEER_ERROR:g}"]
    return table(head, lines)


def multigrid_table(rows):
    """Friction beside one linear solve of the same matrix by multigrid, coordinates given alone."""
    lines = []
    for case in cases(rows):
        ours, other = (fastest_linear(rows, case, mine) for mine in (True, False))
        run = fastest(rows, case, True, OURS_ERROR, lambda r: r.method == "multigrid")
        if ours:
            lines.append([name_of(case), unknowns_of(rows, case), seconds(ours.seconds),
                          f"{seconds(other.seconds)}, PETSc {other.method}" if other else "",
                          seconds(run.seconds) if run else "", ratio(run, ours, 1), ratio(run, other, 2)])
    head = ["scene, size", "unknowns", "one linear solve by our multigrid", "fastest other",
            f"friction by `multigrid`, error ≤ {OURS_ERROR:g}", "over ours", "over the other"]
    return table(head, lines) if lines else ""


def limitations(rows):
    lines = [
        "- Times are processor seconds of one thread from the matrices to the solution, medians of "
        "up to five runs, from a table of tolerances: between two rows nothing is interpolated.",
        "- Other libraries run with the settings named below. The dense dual that some of them need "
        "is formed by us, with CHOLMOD and many right-hand sides, and counted in their times; "
        "reading files is not. Those in Python pay for it at small sizes.",
        "- Memory of other libraries is that of their process, without what formed the dense dual.",
        "- The tables show the fastest run of all methods and tolerances, chosen after measuring, "
        "for us and for the others alike; we list more methods, they get more tolerances.",
    ]
    for case in cases(rows):
        for error in (PEER_ERROR, OURS_ERROR):
            ours, peer = fastest(rows, case, True, error), fastest(rows, case, False, error)
            if ours and peer and peer.seconds < ours.seconds:
                times = f"{seconds(peer.seconds)} against {seconds(ours.seconds)}"
                lines.append(f"- On {name_of(case)} {peer.label()} is faster than we are at an "
                             f"error of {error:g}: {times}.")
            if not ours:
                lines.append(f"- On {name_of(case)} none of our methods reaches {error:g}.")
    reached = {(r.case(), r.label()) for r in rows if r.is_run() and r.error <= PEER_ERROR}
    short = {}
    for row in rows:
        if row.method not in ("linear_solve", "reference", "formation") and not row.is_linear():
            if (row.case(), row.label()) not in reached:
                short.setdefault(row.label(), {})[name_of(row.case())] = row.status
    for label, where in sorted(short.items()):
        ends = ", ".join(f"{name} ({status})" for name, status in where.items())
        lines.append(f"- Not within {PEER_ERROR:g}, and how it ended: {label}, {ends}.")
    return "\n".join(lines) + "\n"


def finding(rows):
    ratios = []
    for case in cases(rows):
        ours, peer = fastest(rows, case, True, PEER_ERROR), fastest(rows, case, False, PEER_ERROR)
        if ours and peer:
            ratios.append(peer.seconds / ours.seconds)
    overhead = [best.seconds / linear.seconds for case in cases(rows)
                if (best := fastest(rows, case, True, OURS_ERROR))
                and (linear := one(rows, case, "linear_solve"))]
    text = ""
    if overhead:
        text += (f"An error of {OURS_ERROR:g} costs {min(overhead):.2g} to {max(overhead):.2g} "
                 "linear solves with the same matrix")
    if ratios:
        text += (f"{'; the' if text else 'The'} fastest of the other libraries takes "
                 f"{min(ratios):.1f} to {max(ratios):.1f} times our time to {PEER_ERROR:g}")
    return text + ".\n" if text else "Nothing has been measured.\n"


def draw(rows, path):
    """One panel per scene; ours solid, others dashed. False without matplotlib."""
    wanted = cases(rows)
    try:
        import matplotlib
        matplotlib.use("Agg")
        import matplotlib.pyplot as plt
    except ImportError:
        return False
    if not wanted:
        return False
    across, down = min(4, len(wanted)), -(-len(wanted) // 4)
    figure, axes = plt.subplots(down, across, figsize=(4 * across, 3.4 * down + 2), squeeze=False)
    colours = {}
    for axis, case in zip(axes.flat, wanted):
        mine = [row for row in rows if row.case() == case and row.is_run()]
        for label in dict.fromkeys(row.label() for row in mine):
            runs = [row for row in mine if row.label() == label]
            colour = colours.setdefault(label, plt.get_cmap("tab20")(len(colours) % 20))
            axis.loglog([r.seconds for r in runs], [max(r.error, 1e-16) for r in runs],
                        "o-" if runs[0].is_ours() else "s--", color=colour, ms=3, label=label)
        if linear := one(rows, case, "linear_solve"):
            axis.axvline(linear.seconds, color="0.6", linewidth=1, label="one linear solve")
        axis.set_title(name_of(case))
        axis.grid(alpha=0.3)
    for axis in list(axes.flat)[len(wanted):]:
        axis.axis("off")
    for axis in axes[:, 0]:
        axis.set_ylabel("relative error, energy norm")
    for axis in axes[-1, :]:
        axis.set_xlabel("processor seconds")
    labels = {}
    for axis in axes.flat:
        for handle, label in zip(*axis.get_legend_handles_labels()):
            labels.setdefault(label, handle)
    figure.legend(labels.values(), labels.keys(), loc="lower center", ncol=4, fontsize=7)
    figure.tight_layout(rect=(0, 1.9 / (3.4 * down + 2), 1, 1))
    figure.savefig(path, dpi=110)
    return True


def text_of(folder, name):
    path = f"{folder}/{name}"
    return open(path, encoding="utf-8").read() if os.path.exists(path) else ""


def main(folder):
    rows, grown = read(f"{folder}/precision.csv"), read(f"{folder}/growth.csv")
    peers = dict.fromkeys((text_of(folder, "peers_precision.txt")
                           + text_of(folder, "peers_growth.txt")).splitlines())
    page = ["# Time against error\n", finding(rows), "## Limitations\n", limitations(rows)]
    if draw(rows, f"{folder}/precision.png"):
        page += ["## Every method, every tolerance\n",
                 "![relative energy error against processor seconds](precision.png)\n",
                 "Solid: ours. Dashed: other libraries. Grey line: one sparse factorisation and one "
                 "solve with the same matrix.\n"]
    page += [precision_table(rows)]
    if grown:
        page += ["## Growth with the size\n", growth_table(grown), multigrid_table(grown)]
    page += ["## Machine and versions\n", text_of(folder, "machine.md"),
             "One thread: `OMP_THREAD_LIMIT=1`, `OPENBLAS_NUM_THREADS=1`. Other libraries:\n",
             "\n".join(f"- {line}" for line in peers) + "\n",
             "`./run bench --only precision --only growth` measures this again; "
             "`benchmarks/precision.sh` says what it needs.\n"]
    with open(f"{folder}/RESULTS.md", "w", encoding="utf-8") as text:
        text.write("\n".join(page))


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit("usage: results.py FOLDER")
    main(sys.argv[1])
