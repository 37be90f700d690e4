#!/usr/bin/env python3
"""Holds the READMEs against what is there: each room has one, and the top one is a page; links and names of source files
lead somewhere; options are those that `herr COMMAND --help` lists, and the top README names every command.
Prints one line for each finding; exit 1 if there is any."""

import argparse
import pathlib
import re
import subprocess
import sys

import rooms

SKIPPED_FOLDERS = {"build", "out", ".git", "generated"}
MOST_LINES = 150  # of the top README
LINK = re.compile(r"\]\(([^)\s]+)\)")
SOURCE_NAME = re.compile(r"`(\w[\w./-]*\.(?:h|cpp|py|cmake|in))`")
OPTION = re.compile(r"(?<![\w-])--[a-z][a-z0-9_-]*")
HERR_LINE = re.compile(r"^\s*herr ([a-z]+) [^#\n]*", re.MULTILINE)
SUBCOMMAND = re.compile(r"^  ([a-z]+) {2,}", re.MULTILINE)
# Options of `herr` that no help lists, and those of other tools.
HIDDEN = {"--measure"}
FOREIGN = {"--build", "--preset", "--install", "--prefix", "--target", "--fix", "--gtest_filter", "--resize", "--quick",
           "--only", "--list", "--scanline", "--compression", "--info", "--mulc", "--subimage", "--fullpixels", "--ch",
           "--colorconvert", "--unpremult", "--over", "--echo", "--attrib", "--diff", "--fail"}


def markdown_files(root):
    return sorted(f for f in root.rglob("*.md") if not SKIPPED_FOLDERS.intersection(f.relative_to(root).parts))


def lines_of(file):
    return enumerate(file.read_text(encoding="utf-8").splitlines(), 1)


def room_findings(root):
    """Modules and rooms that are there without a README."""
    for module, names in rooms.ROOMS.items():
        for folder in (module, *(f"{module}/{room}" for room in names)):
            if (root / folder).is_dir() and not (root / folder / "README.md").is_file():
                yield f"{folder}: has no README.md; say what it knows, what to read first, where to change what"


def length_findings(root):
    lines = len((root / "README.md").read_text(encoding="utf-8").splitlines())
    if lines > MOST_LINES:
        yield f"README.md: has {lines} lines; {MOST_LINES} at most, reference belongs to --help and the rooms"


def link_findings(root):
    """Relative links that name nothing. Links to the web are not followed: a test must pass without a network."""
    for file in markdown_files(root):
        for number, line in lines_of(file):
            for target in LINK.findall(line):
                path = target.split("#")[0]
                if path and "://" not in path and not (file.parent / path).exists():
                    yield f"{file.relative_to(root)}:{number}: links to {path}, which does not exist"


def name_findings(root):
    """Source files that a README names by a path that starts neither at the README nor at a folder above it."""
    for file in markdown_files(root):
        if file.name == "CHANGELOG.md":  # tells of files that have gone
            continue
        folders = [folder for folder in (file.parent, *file.parents) if folder == root or root in folder.parents]
        for number, line in lines_of(file):
            for name in SOURCE_NAME.findall(line):
                if not any((folder / name).exists() for folder in folders):
                    yield f"{file.relative_to(root)}:{number}: names {name}, which does not exist"


def commands_of(text):
    """The commands that `herr --help` lists."""
    return SUBCOMMAND.findall(text.split("Subcommands:", 1)[-1])


def command_of(file, commands):
    """The command whose room a README is: server/check/report/README.md is of `herr check`."""
    parts = file.parts
    return parts[1] if len(parts) > 2 and parts[0] == "server" and parts[1] in commands else None


def option_findings(root, help_of):
    """Options that no help lists: of a command's room and of a line `herr COMMAND ...` those of that command, else of
    any. `help_of(None)` is the help of the program itself."""
    commands = commands_of(help_of(None))
    listed = {command: set(OPTION.findall(help_of(command))) | HIDDEN for command in commands}
    anywhere = set().union(FOREIGN, *listed.values(), OPTION.findall(help_of(None)))
    if not commands:
        yield "herr --help: lists no commands"
    for file in markdown_files(root):
        name = file.relative_to(root)
        if file.name == "CHANGELOG.md":
            continue
        text = file.read_text(encoding="utf-8").replace("\\\n", " ")
        for line in HERR_LINE.finditer(text):
            for option in sorted(set(OPTION.findall(line[0])) - listed.get(line[1], anywhere)):
                yield f"{name}: shows {option}, which `herr {line[1]} --help` does not list"
        command = command_of(name, commands)
        for option in sorted(set(OPTION.findall(text)) - (listed[command] | FOREIGN if command else anywhere)):
            yield f"{name}: shows {option}, which `herr {command or 'COMMAND'} --help` does not list"
    top = (root / "README.md").read_text(encoding="utf-8")
    for command in commands:
        if f"herr {command}" not in top:
            yield f"README.md: leaves out `herr {command}`"


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("root", type=pathlib.Path, help="top folder of the project")
    parser.add_argument("--herr", type=pathlib.Path, help="the program; without it options are not checked")
    options = parser.parse_args()
    if options.herr and not options.herr.is_file():
        sys.exit(f"{options.herr} is not built yet")

    def help_of(command):
        words = [command] if command else []
        return subprocess.run([options.herr, *words, "--help"], text=True, capture_output=True, check=True).stdout

    found = [*room_findings(options.root), *length_findings(options.root), *link_findings(options.root),
             *name_findings(options.root)]
    if options.herr:
        found += dict.fromkeys(option_findings(options.root, help_of))
    print(*found, f"{len(found)} findings", sep="\n")
    sys.exit(1 if found else 0)


if __name__ == "__main__":
    main()
