#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Where the compiler spends its time on a source file, by clang++ -ftime-trace.

    benchmarks/compile_trace.py FILE.cpp [--top 25] [--compiler clang++-16] [-- FLAG...]

prints headers by their own text, templates by what instantiating them takes without what they
instantiate in turn, and functions by what optimising them takes; milliseconds and how often. The
include folders are those of the release build (build/release/compile_flags.rsp), -O2 unless FLAGs
say otherwise. g++ has no such trace; it shares the order, not the numbers.
"""
import argparse
import collections
import json
import pathlib
import re
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent


def events_of(source, compiler, flags):
    """The complete events of the trace."""
    response = ROOT / "build/release/compile_flags.rsp"
    if not response.exists():
        subprocess.run(["cmake", "-S", ROOT, "--preset", "release"], check=True,
                       stdout=subprocess.DEVNULL)
    with tempfile.TemporaryDirectory() as folder:
        out = pathlib.Path(folder) / "trace.o"
        subprocess.run([compiler, f"@{response}", f"-I{ROOT}/examples", "-O2", *flags, "-ftime-trace",
                        "-ftime-trace-granularity=100", "-c", source, "-o", out], check=True)
        trace = json.loads(out.with_suffix(".json").read_text())
    return [e for e in trace["traceEvents"] if e.get("ph") == "X"]


def own_times(events, kinds, name_of):
    """Microseconds of each name without those of the events within, and how many events."""
    chosen = sorted((e for e in events if e["name"] in kinds), key=lambda e: (e["ts"], -e["dur"]))
    own, count, open_events = collections.Counter(), collections.Counter(), []
    for event in chosen:
        while open_events and open_events[-1]["ts"] + open_events[-1]["dur"] <= event["ts"]:
            open_events.pop()
        name = name_of(event["args"].get("detail", ""))
        own[name] += event["dur"]
        count[name] += 1
        if open_events:
            own[name_of(open_events[-1]["args"].get("detail", ""))] -= event["dur"]
        open_events.append(event)
    return own, count


def shortened(path):
    """A header as it is included."""
    return re.sub(r".*/(include|concepts|c\+\+/\d+|eigen3)/", "", path)


def template(name):
    """Without its arguments."""
    return name.split("<")[0] + ("<>" if "<" in name else "")


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("source")
    parser.add_argument("--top", type=int, default=25)
    parser.add_argument("--compiler", default="clang++-16")
    parser.add_argument("flags", nargs="*", help="after --")
    options = parser.parse_args()
    try:
        events = events_of(options.source, options.compiler, options.flags)
    except (OSError, subprocess.CalledProcessError) as error:
        sys.exit(f"compile_trace.py: {error}")

    for name in ("Frontend", "Source", "InstantiateClass", "InstantiateFunction", "Backend"):
        total = sum(e["dur"] for e in events if e["name"] == f"Total {name}")
        print(f"{name:20} {total / 1e6:8.2f} s")
    tables = (("headers", {"Source"}, shortened),
              ("templates", {"InstantiateClass", "InstantiateFunction"}, template),
              ("optimised functions", {"OptFunction"}, lambda name: name))
    for title, kinds, name_of in tables:
        own, count = own_times(events, kinds, name_of)
        print(f"\n{title}: milliseconds, how often")
        for name, time in own.most_common(options.top):
            print(f"{time / 1e3:10.1f} {count[name]:6d}  {name[:120]}")


if __name__ == "__main__":
    main()
