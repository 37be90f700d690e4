#!/usr/bin/env python3
"""Holds the credits of the top README against what the project is made of: every library that the program and its modules
link, every foreign header that a source includes, and every packaged file that a build file names stands there, and
nothing stands there for no reason. Prints one line for each finding; exit 1 if there is any."""

import argparse
import collections
import fnmatch
import pathlib
import re
import subprocess
import sys

from source_tree import includes, read, source_files

# A library by the name that the credits give it: shared objects, headers, packaged files, as patterns.
Library = collections.namedtuple("Library", "name objects headers files", defaults=((), (), ()))
LIBRARIES = (
    Library("Embree", ("libembree*.so*",), ("embree3/*", "embree4/*")),
    Library("Highway", ("libhwy*.so*",), ("hwy/*",)),
    Library("oneTBB", ("libtbb*.so*",), ("tbb/*", "oneapi/*")),
    Library("OpenImageIO", ("libOpenImageIO*.so*",), ("OpenImageIO/*",)),
    Library("OpenEXR", ("libOpenEXR*.so*",), ("OpenEXR/*", "Imf*.h")),
    Library("Imath", ("libImath*.so*",), ("Imath/*", "half.h")),
    Library("tinygltf", ("libtinygltf*.so*",), ("tiny_gltf.h",)),
    Library("GLM", ("libglm*.so*",), ("glm/*",)),
    Library("JSON for Modern C++", (), ("nlohmann/*",)),
    Library("CLI11", (), ("CLI/*",)),
    Library("Boost.Math", (), ("boost/math/*",)),
    Library("meshoptimizer", ("libmeshoptimizer.so*",), ("meshoptimizer.h",)),
    Library("cpp-httplib", ("libcpp-httplib.so*",), ("httplib.h",)),
    Library("zlib", ("libz.so*",), ("zlib.h",)),
    Library("libjpeg", ("libjpeg.so*",), ("jpeglib.h", "jerror.h")),
    Library("libpng", ("libpng*.so*",), ("png.h",)),
    Library("Expat", ("libexpat.so*",), ("expat.h",)),
    Library("yaml-cpp", ("libyaml-cpp.so*",), ("yaml-cpp/*",)),
    Library("Chart.js", (), (), ("javascript/chart.js*",)),
    Library("DejaVu", (), (), ("fonts-dejavu-core",)),
    Library("GoogleTest", ("libgtest*.so*", "libgmock*.so*"), ("gtest/*", "gmock/*")),
    Library("Google Benchmark", ("libbenchmark*.so*",), ("benchmark/*",)),
)
# What a C++ program has anyway: the compiler's runtime, the C library and the system's headers.
SYSTEM_OBJECTS = ("libc.so*", "libm.so*", "libgcc_s.so*", "libstdc++.so*", "libdl.so*", "libpthread.so*", "ld-linux*.so*",
                  "libatomic.so*", "lib[altu]*san.so*")
SYSTEM_FOLDERS = ("sys/*", "linux/*", "netinet/*", "arpa/*", "gnu/*")
# Of the C library, of POSIX and of the compiler, each with ".h".
SYSTEM_HEADERS = {name + ".h" for name in (
    "assert ctype errno fenv float inttypes limits locale math setjmp signal stdarg stdbool stddef stdint stdio stdlib string "
    "time wchar wctype alloca dirent dlfcn elf endian execinfo fcntl fnmatch ftw getopt glob grp iconv ifaddrs langinfo libgen "
    "link malloc netdb poll pthread pwd regex sched semaphore spawn strings sysexits syslog termios ucontext unistd utime wait "
    "cpuid emmintrin immintrin x86intrin xmmintrin").split()}
PACKAGED = re.compile(r"/usr/share/([\w./-]+)")
FONT_PACKAGE = re.compile(r"\bfonts-[\w-]+")


def matches(name, patterns):
    return any(fnmatch.fnmatchcase(name, pattern) for pattern in patterns)


def of_system(kind, name):
    if kind == "objects":
        return matches(name, SYSTEM_OBJECTS)
    # Headers of C++ itself have neither folder nor ending.
    return kind == "headers" and (name in SYSTEM_HEADERS or matches(name, SYSTEM_FOLDERS) or not set("/.") & set(name))


def credits_text(root):
    """The part of the top README under its heading of credits; None without one."""
    text = (root / "README.md").read_text(encoding="utf-8")
    found = re.search(r"^## [^\n]*[Cc]redits[^\n]*\n(.*?)(?=^## |\Z)", text, re.MULTILINE | re.DOTALL)
    return found[1] if found else None


def linked_objects(file):
    """The shared objects that a program or module names itself, not those that these load in turn."""
    listing = subprocess.run(["readelf", "--dynamic", "--wide", file], text=True, capture_output=True, check=True).stdout
    return re.findall(r"\(NEEDED\).*\[(.+?)\]", listing)


def foreign_headers(root):
    """{header: the first file that includes it}"""
    found = {}
    for file in source_files(root):
        for include in includes(root, file):
            if include.target is None and not include.quoted:
                found.setdefault(include.path, f"{file}:{include.line}")
    return found


def packaged_files(root):
    """{file below /usr/share or package of fonts: who names it}, of build files and of scripts/install-packages."""
    found = {}
    names = [file.relative_to(root) for file in root.rglob("CMakeLists.txt") if "build" not in file.relative_to(root).parts]
    for name in sorted(names):
        for path in PACKAGED.findall(read(root, name)):
            found.setdefault(path, name)
    packages = pathlib.Path("scripts/install-packages")
    if (root / packages).is_file():
        for package in FONT_PACKAGE.findall(read(root, packages)):
            found.setdefault(package, packages)
    return found


def findings(root, objects):
    """`objects`: {shared object: who links it}."""
    text = credits_text(root)
    if text is None:
        yield "README.md: has no section of credits"
        return
    used = set()
    for kind, things, verb in (("objects", objects, "links"), ("headers", foreign_headers(root), "includes"),
                               ("files", packaged_files(root), "names")):
        for thing, where in sorted(things.items()):
            owners = [library.name for library in LIBRARIES if matches(thing, getattr(library, kind))]
            used.update(owners)
            if not owners and not of_system(kind, thing):
                yield (f"{where}: {verb} {thing}, which no row of tests/house/check_credits.py knows; name its library there "
                       "and in the credits of README.md")
    for library in LIBRARIES:
        named = library.name in text
        if library.name in used and not named:
            yield f"README.md: the credits leave out {library.name}, which the project uses"
        # Without a program to ask, only what headers and files show is known.
        if named and library.name not in used and (objects or not library.objects):
            yield f"README.md: the credits name {library.name}, which nothing links, includes or names"


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("root", type=pathlib.Path, help="top folder of the project")
    parser.add_argument("--linked", type=pathlib.Path, action="append", default=[], help="a program or module that was built")
    options = parser.parse_args()
    objects = {}
    for file in options.linked:
        if not file.is_file():
            sys.exit(f"{file} is not built yet")
        for name in linked_objects(file):
            objects.setdefault(name, file.name)
    found = list(findings(options.root, objects))
    print(*found, f"{len(found)} findings", sep="\n")
    sys.exit(1 if found else 0)


if __name__ == "__main__":
    main()
