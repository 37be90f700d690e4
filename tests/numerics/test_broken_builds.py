#!/usr/bin/env python3
"""A build that is broken on purpose (renderer/broken_on_purpose.h) fails the relation that is there for its fault, by
name, on a sample scene; the program as it is holds it.

test_broken_builds.py HERR BROKEN FAULT"""

import argparse
import json
import math
import pathlib
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
SESSION = "sessions/samples/desk-walk"
SCENE = "scenes/samples/room.scene.json"


class Expected:
    """`worse`: the relation does not hold in the program as it is; broken, its error is this many times as large."""

    def __init__(self, group, relation, worse=None):
        self.group, self.relation, self.worse = group, relation, worse


FAULTS = {
    "singular_falloff": Expected("light", "light near a surface stays below I / r^2"),
    "dropped_anchor": Expected("place", "moved by 1e6 m, hard light"),
    "biased_adaptive_samples": Expected("samples", "mean with adaptive light samples", worse=1.5),
    "euler_hysteresis": Expected("probes", "memory of probes does not depend on the step"),
    "samples_keyed_by_thread": Expected("threads", "the same bytes by any number of threads"),
}


def error_of(result):
    """What was measured; without a finite number infinite, which is as bad as can be."""
    return result["error"] if result["error"] is not None else math.inf


def holds(result):
    return error_of(result) <= (result["bound"] if result["bound"] is not None else math.inf)


def ask(program, expected):
    """(exit code, result of the relation) of a study by `program`."""
    with tempfile.TemporaryDirectory(prefix="herr-broken-") as folder:
        run = subprocess.run([program, "study", "--stability", SESSION, "--scene", SCENE, "--only", expected.group,
                              "--out", str(pathlib.Path(folder) / "study"), "--json"],
                             cwd=ROOT, text=True, capture_output=True, check=False)
    if run.returncode not in (0, 1):
        sys.exit(f"{program}: exit code {run.returncode}: {run.stderr.strip()[-500:]}")
    named = [result for result in json.loads(run.stdout)["results"] if result["name"] == expected.relation]
    if len(named) != 1:
        sys.exit(f"{program}: {len(named)} relations of group {expected.group} are called '{expected.relation}'")
    if named[0]["not_applicable"]:
        sys.exit(f"{program}: '{expected.relation}' was not asked: {named[0]['not_applicable']}")
    return run.returncode, named[0]


def problem_of(expected, whole, broken):
    """What is wrong with how the two programs did; empty: the fault was caught."""
    (whole_exit, as_it_is), (broken_exit, at_fault) = whole, broken
    if expected.worse:
        if not error_of(at_fault) > expected.worse * max(error_of(as_it_is), at_fault["bound"]):
            return f"the fault is not {expected.worse} times as bad as the program as it is"
        return ""
    if not holds(as_it_is):
        return "the program as it is does not hold the relation"
    if holds(at_fault):
        return "the fault is not caught"
    if broken_exit != 1:
        return f"the broken program ends with {broken_exit}, not 1"
    return ""


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("herr", type=pathlib.Path)
    parser.add_argument("broken", type=pathlib.Path)
    parser.add_argument("fault", choices=FAULTS)
    options = parser.parse_args()
    expected = FAULTS[options.fault]
    whole, broken = (ask(program.resolve(), expected) for program in (options.herr, options.broken))
    for name, (code, result) in (("as it is", whole), (f"with {options.fault}", broken)):
        print(f"{name}: '{expected.relation}': error {error_of(result):.3g}, bound {result['bound']:.3g} {result['unit']} "
              f"(exit code {code}) {result['where']}")
    problem = problem_of(expected, whole, broken)
    if problem:
        sys.exit(problem)


if __name__ == "__main__":
    main()
