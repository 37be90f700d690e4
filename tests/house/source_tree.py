"""The project's C++ files as the house checks see them: which there are, and what each one includes."""

import os
import pathlib
import re

# Includes follow this order: a folder includes only itself and what is to its left.
LAYERS = ("sessions", "scenes", "renderer", "server")
# Tests stand outside the house and may look into every room.
ROOTS = LAYERS + ("tests",)
SUFFIXES = {".h", ".cpp"}

_INCLUDE = re.compile(r'^[ \t]*#[ \t]*include[ \t]*(?P<open>["<])(?P<path>[^">\n]+)[">]', re.MULTILINE)
_NOT_CODE = re.compile(
    r'//[^\n]*'                                  # line comment
    r'|/\*.*?\*/'                                # block comment
    r'|R"(?P<delim>[^()\\\s]{0,16})\(.*?\)(?P=delim)"'  # raw string
    r'|"(?:\\.|[^"\\\n])*"'                      # string
    r"|(?<![0-9A-Fa-f])'(?:\\.|[^'\\\n])+'",     # character, but not the separator of 1'000
    re.DOTALL,
)


class Include:
    """One #include line: `path` as written; `target` is the project file it names, or None if it is foreign."""

    def __init__(self, line, path, quoted, target):
        self.line, self.path, self.quoted, self.target = line, path, quoted, target


def source_files(root):
    """Every .h and .cpp below the folders of the project, relative to `root`, sorted. Generated files are not
    among them: builds write outside these folders."""
    root = pathlib.Path(root)
    found = []
    for folder in ROOTS:
        found += [p.relative_to(root) for p in (root / folder).rglob("*") if p.suffix in SUFFIXES and p.is_file()]
    return sorted(found)


def read(root, file):
    return (pathlib.Path(root) / file).read_text(encoding="utf-8")


def code_only(text, keep_strings=False):
    """`text` with comments and strings blanked; every newline stays, so line numbers hold. `keep_strings` keeps
    ordinary ones, among them the paths of #include lines, and blanks raw strings all the same."""

    def blank(match):
        token = match.group(0)
        if keep_strings and not token.startswith(("//", "/*", "R")):
            return token
        return re.sub(r"[^\n]", " ", token)

    return _NOT_CODE.sub(blank, text)


def includes(root, file):
    """The includes of `file` in their order. A path is looked up from the root first, then beside the file."""
    root = pathlib.Path(root)
    text = code_only(read(root, file), keep_strings=True)
    result = []
    for match in _INCLUDE.finditer(text):
        path, quoted = match["path"], match["open"] == '"'
        candidates = [pathlib.Path(path)] if path.split("/")[0] in ROOTS else []
        if quoted:
            candidates.append(pathlib.Path(os.path.normpath(file.parent / path)))  # no ".." left to hide behind
        target = next((c for c in candidates if (root / c).is_file()), None)
        result.append(Include(text.count("\n", 0, match.start()) + 1, path, quoted, target))
    return result
