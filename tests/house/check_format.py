#!/usr/bin/env python3
"""Checks that every C++ file is laid out as .clang-format says; --fix rewrites those that are not.
Exit 1 if a file differs, 2 if clang-format is missing."""

import argparse
import pathlib
import re
import shutil
import subprocess
import sys

from source_tree import ROOTS, source_files

DIFFERS = re.compile(r"^(.+?):(\d+):\d+: error: code should be clang-formatted", re.MULTILINE)


def findings(root, clang_format):
    """One line for the first difference of each file."""
    files = [str(file) for file in source_files(root)]
    done = subprocess.run([clang_format, "--dry-run", "-Werror", *files], cwd=root, text=True, capture_output=True)
    first = {}
    for file, line in DIFFERS.findall(done.stderr):
        first.setdefault(file, line)
    if done.returncode != 0 and not first:  # e.g. .clang-format itself is wrong
        return [done.stderr.strip() or f"clang-format ended with {done.returncode}"]
    return [f"{file}:{line}: not laid out as .clang-format says" for file, line in first.items()]


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("root", type=pathlib.Path, help="top folder of the project")
    parser.add_argument("--fix", action="store_true", help="rewrite the files")
    options = parser.parse_args()
    clang_format = shutil.which("clang-format")
    if clang_format is None:
        print("clang-format is missing; run scripts/install-packages", file=sys.stderr)
        sys.exit(2)
    files = source_files(options.root)
    if not files:
        sys.exit(f"{options.root}: no C++ file below {', '.join(ROOTS)}; pass the top folder of the project")
    if options.fix:
        subprocess.run([clang_format, "-i", *map(str, files)], cwd=options.root, check=True)
    found = findings(options.root, clang_format)
    print(*found, f"{len(files)} files, {len(found)} findings", sep="\n")
    if found:
        print("to rewrite them: python3 tests/house/check_format.py . --fix")
    sys.exit(1 if found else 0)


if __name__ == "__main__":
    main()
