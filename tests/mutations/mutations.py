#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Do the tests find defects? Each mutation changes one expression of the library; a test must fail.

    tests/mutations/mutations.py [--jobs 2] [--compiler g++] [--check] [NAME...]

mutations.txt lists, for each: its name, the file, what stands there (once), what stands there
instead, and the test files that must notice. Sources are copied, changed, compiled with those tests
alone, and run; a test that fails, does not end or does not compile any more has found the mutation.
First every test must pass with the library as it is. Prints a line for each, and ends with status 1
if one survives. The include folders are those of the release build, -O1. --check only looks whether
the list fits the sources, in a second.
"""
import argparse
import concurrent.futures
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
# What tests link besides their own file: the entry point and what the build calls slant_test_oracles.
PARTNERS = (
    "tests/main.cpp",
    "tests/support/allocation_guard.cpp",
    "tests/support/dense_algebra.cpp",
    "tests/support/eigen_instances.cpp",
    "tests/support/folders.cpp",
    "tests/support/friction_cases.cpp",
    "tests/contact/coulomb_scenes.cpp",
    "tests/contact/friction_scenes.cpp",
    "tests/contact/spring_scenes.cpp",
    "tests/krylov/spd_matrices.cpp",
    "tests/methods/example_one.cpp",
    "tests/oracle/random_programs.cpp",
    "tests/oracle/dense_newton.cpp",
    "tests/oracle/dense_contact_reference.cpp",
    "tests/oracle/naive_friction.cpp",
)


def read_mutations():
    """Blocks of lines `key: value`, empty lines between; a line that begins with # is a remark."""
    mutations, block = [], {}
    for line in (ROOT / "tests/mutations/mutations.txt").read_text().split("\n") + [""]:
        if line.startswith("#"):
            continue
        if not line.strip():
            if block:
                mutations.append(block)
            block = {}
            continue
        key, _, value = line.partition(": ")
        block[key.strip()] = value
    return mutations


class Workshop:
    """Compiles tests against a folder with the library's headers."""

    def __init__(self, compiler, folder):
        self.folder = pathlib.Path(folder)
        response = ROOT / "build/release/compile_flags.rsp"
        if not response.exists():
            subprocess.run(["cmake", "-S", ROOT, "--preset", "release"], check=True,
                           stdout=subprocess.DEVNULL)
        self.libraries = ["-lpthread"]
        flags = response.read_text().split()
        if any("CHOLMOD" in f for f in flags):
            self.libraries.append("-lcholmod")
        self.compiler = ["ccache", compiler] if shutil.which("ccache") else [compiler]
        self.other_flags = [f for f in flags if str(ROOT) not in f.replace('"', "")]
        self.objects = {}

    def flags(self, library):
        own = [f"-I{library}/include", f"-I{library}/concepts", f"-I{ROOT}/examples",
               f"-I{ROOT}/tests", f'-DSLANT_SOURCE="{ROOT}"',
               f'-DSLANT_PROGRAMS="{ROOT}/build/release/examples"']
        return [*own, *self.other_flags, "-O1", "-w"]

    def compiled(self, source, library, where):
        result = where / (str(source).replace("/", "_") + ".o")
        done = subprocess.run([*self.compiler, *self.flags(library), "-c", ROOT / source, "-o", result],
                              capture_output=True, text=True, check=False)
        return result if done.returncode == 0 else None

    def shared(self, source):
        """The object of a source that no mutation touches."""
        if source not in self.objects:
            where = self.folder / "shared"
            where.mkdir(exist_ok=True)
            self.objects[source] = self.compiled(source, ROOT, where)
            if self.objects[source] is None:
                sys.exit(f"mutations.py: {source} does not compile")
        return self.objects[source]

    def passes(self, test, library, where):
        """Whether the test compiles, runs to its end and finds nothing wrong."""
        partners = [self.shared(p) for p in PARTNERS]
        unit = self.compiled(test, library, where)
        if unit is None:
            return False
        program = where / "program"
        subprocess.run([self.compiler[-1], unit, *partners, *self.libraries, "-o", program], check=True)
        try:
            return subprocess.run([program], capture_output=True, timeout=120,
                                  check=False).returncode == 0
        except subprocess.TimeoutExpired:
            return False


def misfit(mutation):
    """What of the mutation the sources do not have, or nothing."""
    missing = [f for f in (mutation["file"], *mutation["tests"].split()) if not (ROOT / f).is_file()]
    if missing:
        return "no file " + ", ".join(missing)
    times = (ROOT / mutation["file"]).read_text().count(mutation["from"])
    return "" if times == 1 else f"\"{mutation['from']}\" stands {times} times in {mutation['file']}"


def survives(workshop, mutation, number):
    """The name of what is wrong, or nothing."""
    if problem := misfit(mutation):
        return problem
    where = workshop.folder / str(number)
    where.mkdir()
    library = where / "library"
    for part in ("include", "concepts"):
        shutil.copytree(ROOT / part, library / part)
    changed = library / mutation["file"]
    changed.write_text(changed.read_text().replace(mutation["from"], mutation["to"]))
    found = any(not workshop.passes(t, library, where) for t in mutation["tests"].split())
    shutil.rmtree(where)
    return "" if found else "survives: no test has noticed"


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("names", nargs="*")
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    parser.add_argument("--compiler", default="g++")
    parser.add_argument("--check", action="store_true")
    options = parser.parse_args()
    mutations = [m for m in read_mutations() if not options.names or m["name"] in options.names]
    if options.check:
        problems = [f"no file {p}" for p in PARTNERS if not (ROOT / p).is_file()]
        problems += [f"{m['name']}: {problem}" for m in mutations if (problem := misfit(m))]
        sys.exit("\n".join(problems) or 0)
    failures = 0
    with tempfile.TemporaryDirectory() as folder, \
            concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        workshop = Workshop(options.compiler, folder)
        for source in PARTNERS:
            workshop.shared(source)
        tests = sorted({t for m in mutations for t in m["tests"].split()})

        def as_it_is(numbered):
            where = workshop.folder / f"as_it_is_{numbered[0]}"
            where.mkdir()
            return workshop.passes(numbered[1], ROOT, where)

        for test, good in zip(tests, pool.map(as_it_is, enumerate(tests))):
            if not good:
                print(f"{test}: fails without any mutation")
                failures += 1
        jobs = [pool.submit(survives, workshop, m, i) for i, m in enumerate(mutations)]
        for mutation, job in zip(mutations, jobs):
            problem = job.result()
            failures += 1 if problem else 0
            print(f"{mutation['name']}: {problem or 'found'}", flush=True)
    print(f"{len(mutations)} mutations, {failures} failures")
    sys.exit(1 if failures else 0)


if __name__ == "__main__":
    main()
