#!/usr/bin/env python3
"""Habits of the house that a line of text can break: headers guarded and introduced, files and lines of a size that
one can read, no folder for leftovers, no printing or exiting below server/, no file work past the one seam, no flags
that change arithmetic.
Prints one line for each finding, FILE:LINE: what is wrong; exit 1 if there is any."""

import argparse
import pathlib
import re
import sys

from source_tree import LAYERS, ROOTS, code_only, read, source_files

MAX_LINES = 400  # past that there are two concepts in one file
LEFTOVER_FOLDERS = {"common", "util", "utils", "misc", "helpers"}

# Code of the library never prints or exits: its callers are told by exceptions. The sample generator is a program.
LIBRARY = ("sessions", "scenes", "renderer")
PROGRAMS_IN_LIBRARY = ("scenes/samples/",)
PRINT_OR_EXIT = re.compile(
    r"\bstd::(?:cout|cerr|clog)\b|(?<![\w.:>])(?:std::)?(?:printf|fprintf|puts|fputs|exit|_exit|quick_exit|abort)\s*\(")

# All file work passes through sessions/files/system/file_system.h, where tests let it fail: elsewhere neither headers nor calls
# of another way are used. What only resolves names (absolute, weakly_canonical, read_symlink ...) is not file work.
FILE_HEADERS = re.compile(
    r"^[ \t]*#[ \t]*include[ \t]*<(?:fstream|fcntl\.h|dirent\.h|ftw\.h|glob\.h|sys/(?:file|mman|sendfile|stat|uio)\.h)>",
    re.MULTILINE)
FILE_CALLS = re.compile(
    r"(?<!<)\b(?:std::)?(?:basic_)?[io]?fstream\b|\b(?:basic_)?filebuf\b|\bdirectory_(?:entry|iterator)\b|\bstd::remove\s*\([^,()]*\)|(?<![\w.:>])(?:std::|::)?(?:fopen|freopen|fdopen|tmpfile|rename)\s*\("
    r"|(?<![\w>])::(?:access|creat|fdatasync|flock|fstat|fsync|ftruncate|link|lockf|lstat|mkdir|mkdirat|mkdtemp|mkstemp|mmap"
    r"|open|openat|openat2|opendir|pread|pwrite|readdir|realpath|remove|rename|renameat|rmdir|sendfile|stat|symlink|syscall|truncate|unlink"
    r"|unlinkat)\s*\("
    r"|\b(?:filesystem|fs)::(?:copy\w*|create_\w+|directory_\w+|equivalent|exists|file_size|hard_link_count|is_\w+"
    r"|last_write_time|permissions|recursive_directory_iterator|remove\w*|rename|resize_file|space|status|symlink_status)\b")
# Calls on descriptors, which sockets and pipes need as well.
DESCRIPTOR_CALLS = re.compile(r"(?<![\w>])::(?:close|read|readv|write|writev)\s*\(")
FILE_ROOMS = ("sessions/files/", "scenes/samples/")  # the latter: a program of its own that makes the samples
SOCKETS_AND_PIPES = ("server/http/", "server/check/measure/child_process.cpp")
MEMORY = ("renderer/geometry/texel_memory.h",)  # that asks for huge pages, of no file

# -ffast-math assumes away the NaNs that the stages count; -march=native makes a build that fits one machine; flags for
# newer processors would let inline functions of one file leak to older ones (check_symbols.py).
BUILD_FLAGS = re.compile(r"-ffast-math|-Ofast|-march=native|-m(?:avx|fma|bmi|f16c)\w*")


def header_findings(file, text):
    if "#pragma once" not in code_only(text):
        yield f"{file}:1: no #pragma once"
    if not text.startswith("//"):
        yield f"{file}:1: a header opens with 2-6 comment lines: what it is, what comes before and after, source"


def library_findings(file, text):
    path = file.as_posix()
    if file.parts[0] not in LIBRARY or path.startswith(PROGRAMS_IN_LIBRARY):
        return
    code = code_only(text)
    for match in PRINT_OR_EXIT.finditer(code):
        line = code.count("\n", 0, match.start()) + 1
        yield f"{file}:{line}: {match.group(0).rstrip('( ')}: only server/ prints or exits; throw instead"


def file_work_findings(file, text):
    path = file.as_posix()
    if file.parts[0] not in LAYERS or path.startswith(FILE_ROOMS):
        return
    patterns = [FILE_CALLS]
    if not path.startswith(SOCKETS_AND_PIPES + MEMORY):
        patterns += [FILE_HEADERS, DESCRIPTOR_CALLS]
    code = code_only(text)
    for pattern in patterns:
        for match in pattern.finditer(code):
            line = code.count("\n", 0, match.start()) + 1
            yield f"{file}:{line}: {match.group(0).strip().rstrip('( ')}: files are touched only by sessions/files/"


def build_file_findings(root):
    files = [root / "CMakeLists.txt", root / "CMakePresets.json"]
    for folder in ROOTS:
        files += sorted((root / folder).rglob("CMakeLists.txt"))
    for file in filter(pathlib.Path.is_file, files):
        for number, line in enumerate(file.read_text(encoding="utf-8").splitlines(), 1):
            match = BUILD_FLAGS.search(line.split("#")[0])
            if match:
                yield f"{file.relative_to(root)}:{number}: {match.group(0)} is not used"


def findings(root):
    root = pathlib.Path(root)
    found = []
    for file in source_files(root):
        text = read(root, file)
        count = text.count("\n")
        if count > MAX_LINES:
            found.append(f"{file}:{MAX_LINES + 1}: {count} lines; split it, {MAX_LINES} is the limit")
        if LEFTOVER_FOLDERS.intersection(file.parts[:-1]):
            found.append(f"{file}:1: name the folder by its concept, not by what is left over")
        if file.suffix == ".h":
            found += header_findings(file, text)
        found += library_findings(file, text)
        found += file_work_findings(file, text)
    return found + list(build_file_findings(root))


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
