#!/usr/bin/env python3
"""Rejects a build in which objects wait for libraries: no object of the program may stand behind an archive, a
shared library or a program, or the compilers idle while one module links. (A generated source file in a target does
that: all objects of the target wait for it, and it for every library that the target links.)
Reads build.ninja of a build folder. Prints one line for each finding; exit 1 if there is any."""

import argparse
import pathlib
import re
import sys

LINKED = re.compile(r"^(CXX|C)_(STATIC_LIBRARY|SHARED_LIBRARY|MODULE_LIBRARY|EXECUTABLE)_LINKER__")
COMPILED = re.compile(r"^(CXX|C)_COMPILER__")
# Targets whose objects are checked; tests may wait for what they like.
CHECKED = re.compile(r"^(sessions|scenes|renderer|server)/CMakeFiles/(?!herr-make-scenes)[^/]+\.dir/")


class Edge:
    """One build statement: all that must exist before its rule runs."""

    def __init__(self, rule, before):
        self.rule, self.before = rule, before


def read_edges(text):
    """Output -> Edge, of every build statement."""
    edges = {}
    for line in text.replace("$\n", "").splitlines():
        if not line.startswith("build "):
            continue
        outputs, _, rest = line[6:].replace("$ ", "\0").partition(": ")  # a space in a path is no border
        words = [word for word in rest.split() if word not in ("|", "||")]
        edge = Edge(words[0], words[1:])
        for output in outputs.split():
            if output != "|":
                edges[output] = edge
    return edges


def linked_before(name, edges, known):
    """The linked files that must exist before `name` can be made, itself included."""
    pending, seen, found = [name], set(), set()
    while pending:
        here = pending.pop()
        if here in seen or here not in edges:
            continue
        seen.add(here)
        if here in known:
            found |= known[here]
            continue
        if LINKED.match(edges[here].rule):
            found.add(here)
            continue
        pending += edges[here].before
    known[name] = found
    return found


def findings(build):
    edges = read_edges((build / "build.ninja").read_text(encoding="utf-8"))
    known, waits = {}, {}
    objects = [name for name, edge in edges.items() if COMPILED.match(edge.rule) and CHECKED.match(name)]
    for name in objects:
        for before in edges[name].before:
            for linked in linked_before(before, edges, known):
                waits.setdefault((CHECKED.match(name).group(0), linked), []).append(name)
    return len(objects), [f"{len(names)} objects of {folder} wait for {linked}, e.g. {names[0]}"
                          for (folder, linked), names in sorted(waits.items())]


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("build", type=pathlib.Path, help="a build folder that Ninja builds")
    build = parser.parse_args().build
    objects, found = findings(build)
    if objects == 0:
        sys.exit(f"{build}: no object of the program in build.ninja; pass a build folder of this project")
    print(*found, f"{objects} objects, {len(found)} findings", sep="\n")
    sys.exit(1 if found else 0)


if __name__ == "__main__":
    main()
