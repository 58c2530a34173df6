#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""What README.md says of cost and accuracy is what the tables say that benchmarks have written.

    figures.py FOLDER       every sentence below stands in FOLDER/README.md; status 1 if one does not

The tables are those of benchmarks/RESULTS.md (./run bench --only precision --only growth), of
docs/accuracy.md (--only condensation, composition, multilevel_large, multilevel_linear, load_steps) and of
docs/stability.md (--only stability).
"""
import pathlib
import re
import sys


def table(text, heading):
    """Rows, as lists of cells, of the first table of text whose first line holds heading."""
    lines = text[text.index(heading):].split("\n")
    rows = []
    for line in lines:
        if not line.startswith("|"):
            if rows:
                break
            continue
        rows.append([cell.strip() for cell in line.strip("|\n").split("|")])
    return [row for row in rows[1:] if not re.fullmatch(r"[-:]+", row[0] or "-")]


def number(cell):
    return float(re.match(r"[\d.]+", cell)[0])


def span(values, digits):
    """The least and the greatest, rounded; one number where they are the same."""
    least, most = f"{min(values):.{digits}f}", f"{max(values):.{digits}f}"
    return least if least == most else f"{least} to {most}"


def sentences(root):
    results = (root / "benchmarks/RESULTS.md").read_text()
    accuracy = (root / "docs/accuracy.md").read_text()
    stability = (root / "docs/stability.md").read_text()

    every = table(results, "| scene, size | unknowns | linear solve | ours")
    growth = table(results, "| scene, size | unknowns | linear solve | its MiB")
    friction = ("lift", "press", "pull", "plates")
    every = [row for row in every if row[0].startswith(friction) and row[6]]
    factored = [row for row in growth if row[5]]
    solves = [number(row[5]) for row in factored]
    composed = table(accuracy, "| k | unknowns | load | linear solve | everything")
    solves += [number(row[5]) for row in composed]
    solves += [number(row[4]) for row in every if "condensed" in row[3]]
    unknowns = [int(row[1]) for row in factored + composed]
    yield (f"| contact with friction, {min(unknowns)} to {max(unknowns)} unknowns, with factors | "
           f"{span(solves, 1)} sparse direct solves with K |")
    yield (f"| contact to 1e-6, the fastest of PETSc/TAO, IPOPT, CVXOPT, Siconos | "
           f"{span([number(row[6]) for row in every], 0)} times our time |")

    beside = table(results, "| scene, size | unknowns | one linear")
    nested = re.search(r"k = 24, ([\d.]+) to ([\d.]+) at k = 32\. Where", accuracy)
    for name, heading in (("contact with friction, {} unknowns, multigrid", "press: steps/cycles"),
                          ("the same with Coulomb's law", "press: problems/cycles")):
        large = table(accuracy, f"| k | unknowns | {heading}, seconds")[-1]
        ratios = [number(cell.split(",")[1].strip()) / number(large[6]) for cell in large[2:5]]
        more = ""
        if "steps" in heading:
            solve = next(row for row in growth if row[1] == large[1])
            ratios.append(number(next(row for row in beside if row[1] == large[1])[4]) / number(solve[2]))
            more = f"; {span([float(nested[1]), float(nested[2]), number(solve[8])], 2)} with nested meshes"
        yield f"| {name.format(large[1])} | {span(ratios, 2)} of one direct solve{more} |"
    largest = beside[-1]
    huge = next(row for row in table(accuracy, "| k | unknowns | Tresca | nested") if row[1] == largest[1])
    one, other = ([number(part) for part in cell.split(", ")[1:]] for cell in huge[2:4])
    yield (f"| contact with Tresca friction, {largest[1]} unknowns, multigrid | "
           f"{span([one[0], number(largest[4])], 1)} s; {span([other[0], number(growth[-1][7])], 1)} s and "
           f"{span([other[1], number(growth[-1][9])], 0)} MiB with nested meshes |")

    linear = table(accuracy, "| k | unknowns | one linear solve, ours")
    seconds = [[number(cell.split(",")[1].strip()) for cell in row[2:]] for row in linear]
    least = int(linear[0][1])
    more = [row for row in beside if int(row[1]) >= least]
    ours = [s / row[0] for row in seconds for s in row[3:]] + [number(row[5]) for row in more]
    theirs = [s / row[1] for row in seconds for s in row[3:]] + [number(row[6]) for row in more]
    yield (f"| contact with friction by multigrid, {least} unknowns and more | {span(ours, 1)} linear solves by "
           f"the same multigrid, {span(theirs, 2)} of one by PETSc's GAMG |")

    steps = re.search(r"Twenty load steps take ([\d.]+ to [\d.]+) times", accuracy)[1]
    yield f"| twenty load steps | {steps} times the first one |"

    ratios = [number(row[-1]) for row in table(accuracy, "| one application | by hand")]
    yield f"| composing operators, beside hand-written loops | {span(ratios, 2)} times the instructions |"

    runs, right, unclaimed, missed, refused = (
        int(re.search(pattern, stability)[1])
        for pattern in (r"of (\d+) above 30", r"right (\d+)", r"unclaimed (\d+)", r"missed (\d+)",
                        r"refused (\d+)"))
    wrong = int(re.search(r"stability: (\d+) of", stability)[1])
    part = [f"{100 * n / runs:.0f} %" for n in (right, unclaimed, missed, refused)]
    yield (f"of {runs} runs {wrong} claim `converged` with an error above 30 times the larger of tolerance and "
           f"floor; {part[0]} are right, {part[1]} reach the accuracy without claiming it, {part[2]} end before it "
           f"and say so, {part[3]} are refused")


def main():
    root = pathlib.Path(sys.argv[1])
    readme = " ".join((root / "README.md").read_text().split())
    missing = [s for s in sentences(root) if " ".join(s.split()) not in readme]
    for sentence in missing:
        print(f"README.md does not say: {sentence}")
    print("no faults" if not missing else f"{len(missing)} faults")
    return 1 if missing else 0


if __name__ == "__main__":
    sys.exit(main())
