#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Makes the page of Coulomb friction problems from what bench_friction has measured.

    friction.py FOLDER

reads friction.csv, machine.md and, if it is there, friction_interior.csv (of
bench_friction_interior_point) in FOLDER and writes friction.md. Every number on the page comes from
there; the first method of a table is the default.
"""

import csv
import os
import statistics
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
            "status", "error", "its rounding", "penetration", "seconds", "sweeps", "products",
            "Newton steps", "proximal steps", "factorisations", "solved by"]
    names = ["problem", "dimension", "contacts", "unknowns", "rank", "asymmetry", "zero_error",
             "status", "error", "rounding", "penetration", "seconds", "sweeps", "products",
             "newton_steps", "proximal_steps", "factorizations", "solved_by"]
    return table(head, [[row[name] for name in names] for row in rows])


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


def interior_sentence(default, interior):
    """Whether the interior-point method pays; both: problem -> row."""
    solved = [{p for p in of if is_solved(of[p])} for of in (default, interior)]
    both = [p for p in default if p in solved[0] & solved[1]]
    if not both:
        return "No problem is solved by both, so there is nothing to compare."
    seconds = [{p: float(of[p]["seconds"]) for p in both} for of in (default, interior)]
    total = [sum(of.values()) for of in seconds]
    saved = {p: seconds[0][p] - seconds[1][p] for p in both}
    won = [p for p in both if saved[p] > 0]
    only, lost = [sorted(a - b) for a, b in (solved[::-1], solved)]
    verdict = ("pays nowhere" if not won and not only else
               "pays everywhere" if len(won) == len(both) and not lost else
               "pays where the default is slow" if total[1] < total[0] and not lost else
               "pays on some problems only")
    # What is worth a word: one per cent of all that there was to save.
    worth = sorted((p for p in won if saved[p] > 0.01 * total[0]), key=lambda p: -saved[p])
    most = [f"{p} {seconds[1][p]:.3g} s for {seconds[0][p]:.3g} s" for p in worth]
    slower = statistics.median(seconds[1][p] / max(seconds[0][p], 1e-9) for p in both)
    parts = [f"It {verdict}: {total[1]:.3g} s for {total[0]:.3g} s on the {len(both)} problems that "
             f"both solve, faster on {len(won)} of them" + (f" ({', '.join(most)})" if most else ""),
             f"in the median {slower:.2g} times the seconds of the default"]
    parts += [f"it alone solves {', '.join(only)}"] if only else []
    parts += [f"it does not solve {', '.join(lost)}"] if lost else []
    return "; ".join(parts) + "."


def variants_text(rows, methods):
    """How many of the problems with other μ and q, with which nothing has been tuned, are solved."""
    names = list(dict.fromkeys(row["variant"] for row in rows))
    if not names:
        return []

    def told(method):
        mine = [row for row in rows if row["method"] == method]
        missed = [f"{row['problem']} ({row['variant']})" for row in mine if not is_solved(row)]
        seconds = sum(float(row["seconds"]) for row in mine if is_solved(row))
        return (f"`{method}` solves {len(mine) - len(missed)} of {len(mine)}, in {seconds:.3g} s"
                + (f", not {', '.join(missed)}" if missed else ""))

    return [f"The same with other data ({', '.join(names)}), with which no setting was chosen: "
            + "; ".join(told(method) for method in methods) + ".\n"]


def interior_section(every_row):
    """The interior-point method beside the default of the library, in one run."""
    methods = list(dict.fromkeys(row["method"] for row in every_row))
    rows = [row for row in every_row if row["variant"] == "given"]
    problems = list(dict.fromkeys(row["problem"] for row in rows))
    of = {m: {row["problem"]: row for row in rows if row["method"] == m} for m in methods}

    def cells(row):
        return [row["status"] if is_solved(row) else f"*{row['status']}*", row["error"],
                row["penetration"], row["steps"], row["seconds"]] if row else [""] * 5

    def total(method, name, form):
        return form.format(sum(float(row[name]) for row in of[method].values() if row[name]))

    head = ["problem", "contacts", "unknowns"]
    for method in methods:
        head += [f"`{method}`", "error", "penetration", "steps", "seconds"]
    lines = [[p, *([row[n] for n in ("contacts", "unknowns")] if row else ["", ""]),
              *(c for m in methods for c in cells(of[m].get(p)))]
             for p in problems for row in [of[methods[0]].get(p)]]
    last = ["all", "", ""]
    for m in methods:
        last += [f"{sum(map(is_solved, of[m].values()))} of {len(of[m])}", "", "",
                 total(m, "steps", "{:.0f}"), total(m, "seconds", "{:.3g}")]
    page = ["## An interior-point method\n",
            "Primal-dual, scaling of Nesterov and Todd, predictor and corrector; the "
            "term μ‖u_t‖ is linearised in the same steps (`benchmarks/support/friction_interior.hpp`"
            "). It stops by the same rule as the default. `crossover`: until 1e-4 only, then the "
            "default from its forces. Steps are factorisations; the default makes sweeps besides.\n"]
    if len(methods) > 1:
        page += [interior_sentence(of[methods[0]], of[methods[1]]) + "\n"]
    page += variants_text([row for row in every_row if row["variant"] != "given"], methods)
    return [*page, table(head, [*lines, last]),
            "`SLANT_FRICTION=FOLDER ./run bench --only friction_interior` measures this section.\n"]


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
    interior = f"{folder}/friction_interior.csv"
    if os.path.exists(interior) and os.path.getsize(interior) > 0:
        page += interior_section(read(interior))
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
