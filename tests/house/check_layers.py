#!/usr/bin/env python3
"""Rejects includes that go the wrong way through the house: sessions <- scenes <- renderer <- server.
Also include cycles, and foreign headers outside the files that may know them.
Prints one line for each finding, FILE:LINE: what is wrong; exit 1 if there is any."""

import argparse
import fnmatch
import pathlib
import sys

from source_tree import LAYERS, ROOTS, includes, source_files


class Foreign:
    """Headers that match `headers` may be included only by files that match one of `allowed`.
    `one_file`: and within each pattern by a single file."""

    def __init__(self, name, headers, allowed, one_file=False):
        self.name, self.headers, self.allowed, self.one_file = name, headers, allowed, one_file


# A library that stands behind few files can be updated, replaced and mistrusted in one place.
# In a pattern, * also matches /.
FOREIGN = (
    Foreign("tinygltf", ("tiny_gltf.h",), ("scenes/gltf/*.cpp", "scenes/samples/generator/*.cpp"), one_file=True),
    Foreign("meshoptimizer", ("meshoptimizer.h",), ("scenes/detail/*.cpp",), one_file=True),
    Foreign("cpp-httplib", ("httplib.h",), ("server/*.cpp",), one_file=True),
    Foreign("OpenImageIO", ("OpenImageIO/*",),
            ("sessions/*image*.cpp", "scenes/*image*.cpp", "scenes/*texture*.cpp",
             "scenes/samples/generator/*picture*.cpp", "server/output/png_*.cpp", "tests/*.cpp")),
    Foreign("OpenEXR", ("OpenEXR/*", "Imf*.h"), ("server/output/*", "tests/*.cpp")),
    Foreign("Embree", ("embree3/*", "embree4/*"),
            ("renderer/embree/*", "tests/renderer/*.cpp")),
    Foreign("Boost.Math", ("boost/*",), ("server/check/statistics/*.cpp", "tests/server/*.cpp")),
    Foreign("CLI11", ("CLI/*",), ("server/cli/*.cpp",)),
    Foreign("Highway", ("hwy/*",), ("renderer/*", "tests/renderer/*", "tests/benchmarks/*")),
    Foreign("TBB", ("tbb/*", "oneapi/*"), ("renderer/*", "tests/*")),
    Foreign("GoogleTest", ("gtest/*", "gmock/*"), ("tests/*",)),
    Foreign("Google Benchmark", ("benchmark/*",), ("tests/benchmarks/*",)),
)


def matches(path, patterns):
    return any(fnmatch.fnmatchcase(path, pattern) for pattern in patterns)


def layer_findings(graph):
    """Includes of a folder further right, and quoted includes that name no file."""
    for file, lines in graph.items():
        here = file.parts[0]
        for include in lines:
            where = f"{file}:{include.line}"
            if include.target is None:
                if include.path.split("/")[0] in ROOTS:
                    yield f"{where}: includes {include.path}, which does not exist"
                elif include.quoted and not matches(include.path, [h for f in FOREIGN for h in f.headers]):
                    yield f"{where}: \"{include.path}\" is no file of the project; foreign headers stand in <>"
                continue
            there = include.target.parts[0]
            if here not in LAYERS:
                continue
            if there not in LAYERS:
                yield f"{where}: {here}/ includes {include.path}; nothing but tests includes tests"
            elif LAYERS.index(there) > LAYERS.index(here):
                yield f"{where}: {here}/ includes {include.path}; includes go {' <- '.join(LAYERS)}"


def cycle_findings(graph):
    """One finding for each include that closes a cycle, found by an iterative depth-first walk."""
    visiting, done = 1, 2
    state = {}
    for start in graph:
        if start in state:
            continue
        path, stack = [start], [iter(graph[start])]
        state[start] = visiting
        while stack:
            include = next(stack[-1], None)
            if include is None:
                state[path.pop()] = done
                stack.pop()
                continue
            target = include.target
            if target not in graph:
                continue
            if state.get(target) == visiting:
                ring = path[path.index(target):] + [target]
                yield f"{path[-1]}:{include.line}: include cycle {' -> '.join(map(str, ring))}"
            elif target not in state:
                state[target] = visiting
                path.append(target)
                stack.append(iter(graph[target]))


def foreign_findings(graph):
    """Foreign headers outside their files."""
    for library in FOREIGN:
        users = {}  # pattern -> files that use the library by its leave
        for file, lines in graph.items():
            for include in lines:
                if include.target is not None or not matches(include.path, library.headers):
                    continue
                where = f"{file}:{include.line}: <{include.path}>"
                pattern = next((p for p in library.allowed if matches(str(file), (p,))), None)
                if pattern is None:
                    yield f"{where} of {library.name} belongs only in {', '.join(library.allowed)}"
                    continue
                known = users.setdefault(pattern, {file})
                if library.one_file and file not in known:
                    yield f"{where} of {library.name} is already in {next(iter(known))}; one file is enough"


def findings(root):
    graph = {file: includes(root, file) for file in source_files(root)}
    return [*layer_findings(graph), *cycle_findings(graph), *foreign_findings(graph)]


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("root", type=pathlib.Path, help="top folder of the project")
    root = parser.parse_args().root
    files = source_files(root)
    if not files:
        sys.exit(f"{root}: no C++ file below {', '.join(ROOTS)}; pass the top folder of the project")
    found = findings(root)
    print(*found, f"{len(files)} files, {len(found)} findings", sep="\n")
    sys.exit(1 if found else 0)


if __name__ == "__main__":
    main()
