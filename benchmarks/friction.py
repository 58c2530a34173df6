#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Makes the page of Coulomb friction problems from what bench_friction has measured.

    friction.py FOLDER

reads friction.csv, machine.md and, if it is there, friction_variants.csv (of bench_friction with
--variants yes) in FOLDER and writes friction.md. Every number on the page comes from there; the
first method of a table is the default.
"""

import csv
import os
import sys


def is_solved(row):
    measured = [row["error"], row["rounding"], row["penetration"]]
    limit = float(row["tolerance"])
    return row["status"] == "converged" and all(x and float(x) <= limit for x in measured)


def table(head, lines):
    text = [head, ["---"] * len(head), *lines]
    return "\n".join(f"| {' | '.join(line)} |" for line in text) + "\n"


def seconds(row):
    return f"{row['seconds']} s" if row["seconds"] else ""


def default_table(rows):
    head = ["problem", "dim", "contacts", "unknowns", "rank of W", "asymmetry", "error of r = 0",
            "status", "error", "its rounding", "penetration", "unit-free error", "seconds", "sweeps",
            "products", "Newton steps", "interior-point steps", "factorisations", "solved by"]
    names = ["problem", "dimension", "contacts", "unknowns", "rank", "asymmetry", "zero_error",
             "status", "error", "rounding", "penetration", "unit_free_error", "seconds", "sweeps",
             "products", "newton_steps", "interior_steps", "factorizations", "solved_by"]
    return table(head, [[row.get(name, "") for name in names] for row in rows])


def methods_table(problems, methods, of):
    """Error and seconds where a method solves a problem; what it says where not."""
    lines = []
    for problem in problems:
        line = [problem]
        for method in methods:
            row = of.get((problem, method))
            if row is None:
                line.append("")
            elif is_solved(row):
                line.append(f"{row['error']}, {seconds(row)}")
            else:
                line.append(f"*{row['status']}*" + (f" {row['error']}" if row["error"] else ""))
        lines.append(line)
    return table(["problem", *(f"`{method}`" for method in methods)], lines)


def read(path):
    with open(path, encoding="utf-8", newline="") as text:
        return list(csv.DictReader(text))


def variants_section(rows):
    """How many of the problems with other μ and q are solved."""
    rows = [row for row in rows if row["variant"] != "given"]
    names = list(dict.fromkeys(row["variant"] for row in rows))

    def told(method):
        mine = [row for row in rows if row["method"] == method]
        missed = [f"{row['problem']} ({row['variant']})" for row in mine if not is_solved(row)]
        seconds = sum(float(row["seconds"]) for row in mine if is_solved(row))
        return (f"`{method}` solves {len(mine) - len(missed)} of {len(mine)}, in {seconds:.3g} s"
                + (f", not {', '.join(missed)}" if missed else ""))

    methods = dict.fromkeys(row["method"] for row in rows)
    return ["## Other data\n",
            f"The same problems with other μ and q ({', '.join(names)}), with which no setting was "
            "chosen and which need not have a solution: "
            + "; ".join(told(method) for method in methods) + ".\n",
            "`SLANT_FRICTION=FOLDER ./run bench --only friction_variants` measures this again.\n"]


def main(folder):
    rows = read(f"{folder}/friction.csv")
    tolerance = float(rows[0]["tolerance"])
    problems = list(dict.fromkeys(row["problem"] for row in rows))
    methods = list(dict.fromkeys(row["method"] for row in rows))
    of = {(row["problem"], row["method"]): row for row in rows}
    first = [of[p, methods[0]] for p in problems if (p, methods[0]) in of]
    counts = [f"`{m}` solves {sum(is_solved(of[p, m]) for p in problems if (p, m) in of)}"
              for m in methods]
    slowest = max((float(row["seconds"]) for row in first if row["seconds"]), default=0)
    missed = [row["problem"] for row in first if not is_solved(row)]
    page = ["# Coulomb friction: problems of other people's simulations\n",
            f"Of {len(problems)} problems u = W r + q {', '.join(counts)} to {tolerance:g}, without "
            f"settings for a problem; the default, `{methods[0]}`, takes at most {slowest:.3g} s.\n",
            "Error: ‖r − P_K(r − (u + μ‖u_t‖ n))‖ / ‖q‖, computed from W, q, μ and r by "
            "`slant::contact::verify`, which shares no code with the solvers. A method has solved a "
            "problem if it says so and three figures are at most "
            f"{tolerance:g}: this error, what rounding makes of it, and the largest penetration, "
            "max(−u_n) / ‖q‖.\n"]
    if missed:
        page += [f"Not solved by the default: {', '.join(missed)}.\n"]
    page += [f"## `{methods[0]}`\n", default_table(first)]
    if len(methods) > 1:
        page += ["## All methods\n",
                 "Error and processor seconds; in italics how a run ended that did not solve its "
                 "problem.\n", methods_table(problems, methods, of)]
    variants = f"{folder}/friction_variants.csv"
    if os.path.exists(variants) and os.path.getsize(variants) > 0:
        page += variants_section(read(variants))
    machine = f"{folder}/machine.md"
    page += ["## Machine and versions\n",
             open(machine, encoding="utf-8").read() if os.path.exists(machine) else "",
             "One thread, processor seconds of one run. Rank: pivots of a dense QR factorisation "
             "above n ε times the largest; asymmetry: max |W − Wᵀ| over max |W|.\n",
             "`SLANT_FRICTION=FOLDER ./run bench --only friction` measures this again, for the "
             "folders with W.mtx, q.txt and mu.txt in FOLDER.\n"]
    with open(f"{folder}/friction.md", "w", encoding="utf-8") as text:
        text.write("\n".join(page))


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit("usage: friction.py FOLDER")
    main(sys.argv[1])
