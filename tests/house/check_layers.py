#!/usr/bin/env python3
"""Rejects includes that go the wrong way through the house: sessions <- scenes <- renderer <- server, and within
each from floor to floor (rooms.py); includes of another module that are not of its face; include cycles; foreign
headers outside the files that may know them; folders that no table knows or that hold too many files.
Prints one line for each finding, FILE:LINE: what is wrong; exit 1 if there is any."""

import argparse
import collections
import fnmatch
import pathlib
import sys

import rooms
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
    Foreign("meshoptimizer", ("meshoptimizer.h",),
            ("scenes/detail/*.cpp", "scenes/gltf/format/*.cpp", "tests/scenes/gltf/file/*.cpp"), one_file=True),
    Foreign("cpp-httplib", ("httplib.h",), ("server/*.cpp",), one_file=True),
    Foreign("OpenImageIO", ("OpenImageIO/*",),
            ("sessions/pictures/openimageio/*.cpp", "scenes/samples/generator/*picture*.cpp", "tests/*.cpp")),
    Foreign("libjpeg", ("jpeglib.h", "jerror.h"), ("sessions/pictures/jpeg_*.cpp", "sessions/pictures/jpeg_failure.h", "tests/*.cpp")),
    Foreign("libpng", ("png.h",), ("sessions/pictures/png_*.cpp",)),
    Foreign("libexpat", ("expat.h",), ("sessions/import/tables/xml_*.cpp",), one_file=True),
    Foreign("yaml-cpp", ("yaml-cpp/*",), ("sessions/import/cameras/yaml_document.cpp",)),
    Foreign("OpenEXR", ("OpenEXR/*", "Imf*.h"),
            ("server/output/*", "sessions/pictures/exr_*.cpp", "scenes/environment/exr_scanlines.cpp",
             "tests/*.cpp")),
    Foreign("Embree", ("embree3/*", "embree4/*"),
            ("renderer/embree/*", "tests/renderer/*.cpp")),
    Foreign("Boost.Math", ("boost/*",),
            ("server/check/statistics/*.cpp", "server/study/statistics/*.cpp", "tests/server/*.cpp")),
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


def floor_of(module, room):
    """Height of a room; None for the sample generator, which stands outside."""
    if room == "samples":
        return None
    if room == "":
        return -1 if module in rooms.GROUND else len(rooms.ROOMS[module])
    return rooms.ROOMS[module].index(room)


def room_findings(graph):
    """Files in folders that no table knows, includes of a room above, and of another module's inner headers."""
    for file, lines in graph.items():
        here = file.parts[0]
        if here not in LAYERS:
            yield from test_room_findings(file)
            continue
        room = rooms.room_of(file, rooms.ROOMS)[1]
        if room is None:
            yield f"{file}:1: {file.parent}/ is no room of {here}/; give it a floor in tests/house/rooms.py"
            continue
        for include in lines:
            target = include.target
            if target is None or target.parts[0] not in LAYERS:
                continue
            where = f"{file}:{include.line}"
            if target.parts[0] != here:
                if str(target) not in rooms.FACE[target.parts[0]]:
                    yield f"{where}: {target} is not of the face of {target.parts[0]}/ (tests/house/rooms.py)"
                continue
            there = rooms.room_of(target, rooms.ROOMS)[1]
            floors = [floor_of(here, r) for r in (room, there) if r is not None]
            if there != room and None not in floors and len(floors) == 2 and floors[1] > floors[0]:
                yield (f"{where}: includes {target}, which lies above; rooms of {here}/, lowest first: "
                       f"{', '.join(rooms.ROOMS[here])}")


def test_room_findings(file):
    """Tests stand in the rooms of their source."""
    module, folder = (*file.parts[1:2], "/".join(file.parts[2:-1]))
    if module in LAYERS and folder not in ("", *rooms.ROOMS[module], *rooms.TEST_ROOMS.get(module, ())):
        yield f"{file}:1: {file.parent}/ is no room of {module}/; tests stand in the rooms of their source"


def face_findings(graph):
    """Headers of a face that are not there, or that no other module includes."""
    seen = {include.target for file, lines in graph.items() for include in lines
            if include.target is not None and file.parts[0] in LAYERS and include.target.parts[0] != file.parts[0]}
    for module in {file.parts[0] for file in graph} & set(LAYERS):
        for header in rooms.FACE[module]:
            path = pathlib.Path(header)
            if path not in graph:
                yield f"tests/house/rooms.py:1: the face of {module}/ names {header}, which does not exist"
            elif path not in seen:
                yield f"tests/house/rooms.py:1: no other module includes {header}; take it off the face of {module}/"


def crowd_findings(graph):
    for folder, count in sorted(collections.Counter(file.parent for file in graph).items()):
        if count > rooms.MOST_FILES:
            yield f"{folder}/:1: {count} C++ files, more than {rooms.MOST_FILES}: two rooms in one"


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


def circle_findings(graph):
    """Folders of one module that include each other, whatever the table of rooms says."""
    edges = {(file.parent, include.target.parent): f"{file}:{include.line}"
             for file, lines in graph.items() for include in lines
             if include.target is not None and file.parts[0] in LAYERS and file.parts[0] == include.target.parts[0]}
    for (here, there), where in sorted(edges.items()):
        if here < there and (there, here) in edges:
            yield f"{where}: {here}/ and {there}/ include each other (back at {edges[there, here]})"


def include_graph(root):
    return {file: includes(root, file) for file in source_files(root)}


def findings(graph):
    return [*layer_findings(graph), *room_findings(graph), *cycle_findings(graph), *foreign_findings(graph),
            *crowd_findings(graph)]


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("root", type=pathlib.Path, help="top folder of the project")
    root = parser.parse_args().root
    graph = include_graph(root)
    if not graph:
        sys.exit(f"{root}: no C++ file below {', '.join(ROOTS)}; pass the top folder of the project")
    circles = [*circle_findings(graph)]
    found = [*findings(graph), *face_findings(graph), *circles]
    faces = ", ".join(f"{module} {len(rooms.FACE[module])}" for module in LAYERS)
    print(*found, f"headers that other modules may include: {faces}", f"folder circles: {len(circles)}",
          f"{len(graph)} files, {len(found)} findings", sep="\n")
    sys.exit(1 if found else 0)


if __name__ == "__main__":
    main()
