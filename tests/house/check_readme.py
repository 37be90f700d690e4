#!/usr/bin/env python3
"""Holds the READMEs against what is there: links name files, and the options that the top README shows are those that
`herr COMMAND --help` lists. Prints one line for each finding; exit 1 if there is any."""

import argparse
import pathlib
import re
import subprocess
import sys

SKIPPED_FOLDERS = {"build", "out", ".git", "generated"}
LINK = re.compile(r"\]\(([^)\s]+)\)")
OPTION = re.compile(r"(?<![\w-])--[a-z][a-z0-9-]*")
COMMAND = re.compile(r"^herr ([a-z]+)", re.MULTILINE)
EVERYWHERE = {"--help", "--version"}  # not worth a row in the README


def markdown_files(root):
    return sorted(f for f in root.rglob("*.md") if not SKIPPED_FOLDERS.intersection(f.relative_to(root).parts))


def link_findings(root):
    """Relative links that name nothing. Links to the web are not followed: a test must pass without a network."""
    for file in markdown_files(root):
        for number, line in enumerate(file.read_text(encoding="utf-8").splitlines(), 1):
            for target in LINK.findall(line):
                path = target.split("#")[0]
                if path and "://" not in path and not (file.parent / path).exists():
                    yield f"{file.relative_to(root)}:{number}: links to {path}, which does not exist"


def shown_options(readme):
    """What the README's section "Use" shows: {command: options}, one part (###) for each command."""
    use = readme.split("\n## Use\n", 1)[-1].split("\n## ", 1)[0]
    shown = {}
    for part in use.split("\n### "):
        command = COMMAND.search(part)
        if command:
            shown.setdefault(command[1], set()).update(OPTION.findall(part))
    return shown


def option_findings(readme, help_of):
    shown = shown_options(readme)
    if "replay" not in shown:
        yield "README.md: its section Use does not show `herr replay`"
    for command, options in shown.items():
        listed = set(OPTION.findall(help_of(command)))
        for option in sorted(options - listed):
            yield f"README.md: shows {option}, which `herr {command} --help` does not list"
        if command == "replay":
            for option in sorted(listed - options - EVERYWHERE):
                yield f"README.md: leaves out {option} of `herr {command}`"


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("root", type=pathlib.Path, help="top folder of the project")
    parser.add_argument("--herr", type=pathlib.Path, help="the program; without it only links are checked")
    options = parser.parse_args()
    if options.herr and not options.herr.is_file():
        sys.exit(f"{options.herr} is not built yet")

    def help_of(command):
        return subprocess.run([options.herr, command, "--help"], text=True, capture_output=True, check=True).stdout

    found = list(link_findings(options.root))
    if options.herr:
        found += option_findings((options.root / "README.md").read_text(encoding="utf-8"), help_of)
    print(*found, f"{len(found)} findings", sep="\n")
    sys.exit(1 if found else 0)


if __name__ == "__main__":
    main()
