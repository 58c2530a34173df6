#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Makes the tables of docs/stability.md from what bench_stability and bench_random_programs measured.

    stability.py FOLDER [PAGE]

reads stability*.csv and random_programs*.csv in FOLDER, those that are there, and prints the tables
and the summary lines. A run that stands in several files counts as the last file has it, so that a
part can be measured again: bench_stability --method kprgp > FOLDER/stability_kprgp.csv. With PAGE,
the tables replace what stands there between <!-- NAME --> and <!-- end of NAME -->.

The column "before" is that of stability_before.csv: wrong runs when methods were stopped by the
norm that each judges itself by. Exit status 1 if a run is wrong or claims less than half its error.
"""

import csv
import glob
import os
import sys

THRESHOLD = 30
VERDICTS = ["right", "wrong", "unclaimed", "stalled", "limit", "unbounded", "breakdown", "refused",
            "crashed"]


class Run:
    def __init__(self, cells):
        number = lambda name: float(cells[name])
        self.adversity, self.method, self.start = cells["adversity"], cells["method"], cells["start"]
        self.verdict = cells["verdict"]
        self.tolerance, self.floor = number("tolerance"), number("floor")
        self.error, self.kkt, self.claimed = map(number, ("error", "kkt", "claimed"))
        self.seconds = number("seconds")

    def is_contradicted(self):
        return (self.verdict == "wrong"
                and not self.kkt <= THRESHOLD * max(self.tolerance, self.floor))

    def is_broken(self):
        """Claims less than half its error; the floor is not seen by an estimate."""
        judged = self.verdict not in ("refused", "crashed", "inexact")
        return judged and 2 * self.claimed + self.floor < self.error


def rows_of(folder, name):
    """Rows of NAME.csv and then of NAME_*.csv."""
    paths = glob.glob(os.path.join(folder, f"{name}.csv"))
    paths += sorted(glob.glob(os.path.join(folder, f"{name}_*.csv")))
    for path in paths:
        with open(path, encoding="utf-8", newline="") as text:
            yield from csv.DictReader(text)


def read_runs(folder):
    """Runs by what was asked, and the programs without a reference."""
    runs, inexact = {}, set()
    for cells in rows_of(folder, "stability"):
        program = (cells["adversity"], cells["parameter"], cells["variant"])
        if cells["verdict"] == "inexact":
            inexact.add(program)
            continue
        runs[(*program, cells["method"], cells["start"], cells["tolerance"])] = Run(cells)
    return list(runs.values()), inexact


def count(runs, verdict):
    return sum(run.verdict == verdict for run in runs)


def summary(runs):
    missed = {v: count(runs, v) for v in ("stalled", "limit", "unbounded", "breakdown", "crashed")}
    claims = [run for run in runs if run.claimed == run.claimed]
    return (f"stability: {count(runs, 'wrong')} of {len(runs)} above {THRESHOLD} "
            f"(right {count(runs, 'right')}, unclaimed {count(runs, 'unclaimed')}, "
            f"missed {sum(missed.values())}: stalled {missed['stalled']}, limit {missed['limit']}, "
            f"false unbounded {missed['unbounded']}, breakdown {missed['breakdown']}, "
            f"exception or NaN {missed['crashed']}; refused {count(runs, 'refused')}; "
            f"wrong with a kkt residual that shows it {sum(r.is_contradicted() for r in runs)}; "
            f"claimed errors {len(claims)}, below half of the true one "
            f"{sum(run.is_broken() for run in runs)})")


def table(head, rows):
    text = [head, ["---"] * len(head), *rows]
    return "\n".join("| " + " | ".join(str(cell) for cell in line) + " |" for line in text) + "\n"


def read_before():
    path = os.path.join(os.path.dirname(os.path.abspath(__file__)), "stability_before.csv")
    with open(path, encoding="utf-8", newline="") as text:
        return {(c["kind"], c["name"]): f"{c['wrong']} of {c['runs']}" for c in csv.DictReader(text)}


def verdicts_by(kind, runs, name_of, before=None):
    """A row for each name in the order of the file; columns without a run are left out."""
    groups = {}
    for run in runs:
        groups.setdefault(name_of(run), []).append(run)
    kept = [v for v in VERDICTS if v in ("right", "wrong") or count(runs, v) > 0]
    head = [kind, "runs"] + (["wrong before"] if before else []) + kept
    rows = []
    for name, group in groups.items():
        was = [before.get((kind, name), "–")] if before else []
        rows.append([name, len(group), *was, *(count(group, v) for v in kept)])
    return table(head, rows)


def stability_tables(runs):
    before = read_before()
    asked = lambda run: (f"tolerance {run.tolerance:g}" if run.start == "zero"
                         else f"start {run.start}, tolerance {run.tolerance:g}")
    return {
        "summary": "    " + summary(runs) + "\n",
        "methods": verdicts_by("method", runs, lambda run: run.method, before),
        "adversities": verdicts_by("adversity", runs, lambda run: run.adversity, before),
        "requests": verdicts_by("request", runs, asked),
    }


def random_table(folder):
    """What ended at the floor is counted of the runs below what is attainable, the rest at 1e-8."""
    rows = {(c["suite"], c["number"], c["method"], c["asked"]): c
            for c in rows_of(folder, "random_programs")}
    groups = {}
    for cells in rows.values():
        groups.setdefault((cells["suite"], cells["method"]), []).append(cells)
    if not groups:
        return None
    suites = list(dict.fromkeys(suite for suite, _ in groups))
    head = ["suite", "method", "programs", "at the floor", "right", "wrong", "unclaimed", "stalled",
            "limit", "unbounded", "breakdown", "NaN", "refused"]
    rows = []
    for suite in suites:
        for (of, method), runs in groups.items():
            if of != suite:
                continue
            usual = [run for run in runs if run["asked"] == "1e-08"]
            sharp = [run for run in runs if run["asked"] != "1e-08"]
            solved = sum(float(run["floors"]) <= 100 for run in sharp)
            tally = lambda v: sum(run["verdict"] == v for run in usual)
            nan = sum(run["verdict"] == "crashed" for run in runs)
            share = f"{solved} ({100 * solved / len(sharp):.1f} %)" if sharp else "–"
            rows.append([suite, method, len(usual), share,
                         *(tally(v) for v in ("right", "wrong", "unclaimed", "stalled", "limit",
                                              "unbounded", "breakdown")), nan, tally("refused")])
    return table(head, rows)


def write(page, parts):
    with open(page, encoding="utf-8") as text:
        content = text.read()
    for name, part in parts.items():
        first, last = f"<!-- {name} -->\n", f"<!-- end of {name} -->"
        if first not in content or last not in content:
            sys.exit(f"stability.py: {page} has no place for {name}")
        head, rest = content.split(first, 1)
        content = head + first + part + last + rest.split(last, 1)[1]
    with open(page, "w", encoding="utf-8") as text:
        text.write(content)


def main():
    if len(sys.argv) not in (2, 3):
        sys.exit(__doc__)
    folder = sys.argv[1]
    runs, inexact = read_runs(folder)
    parts = stability_tables(runs) if runs else {}
    random_programs = random_table(folder)
    if random_programs:
        parts["random programs"] = random_programs
    for name, part in parts.items():
        print(f"{name}\n\n{part}")
    if inexact:
        print(f"{len(inexact)} programs are left out: their reference is not exact enough")
    if len(sys.argv) == 3:
        write(sys.argv[2], parts)
    return int(count(runs, "wrong") > 0 or any(run.is_broken() for run in runs) or bool(inexact))


if __name__ == "__main__":
    sys.exit(main())
