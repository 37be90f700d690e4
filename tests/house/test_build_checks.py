#!/usr/bin/env python3
"""The checks of what a build makes fire on small wicked builds, and not on good ones: its graph, its symbols."""

import shutil
import subprocess
import unittest

import check_build_graph
import check_symbols
from wicked_tree import Tree


class BuildGraphRule(Tree):
    OBJECT = "server/CMakeFiles/herr_server.dir/a.cpp.o"
    LIBRARY = "renderer/libherr_renderer.a"

    def findings(self, text):
        self.write("build.ninja", text)
        return check_build_graph.findings(self.root)[1]

    def test_an_object_that_waits_for_a_generated_file_alone_is_good(self):
        self.assertEqual(self.findings(
            f"build {self.OBJECT}: CXX_COMPILER__herr_server_ a.cpp || order\n"
            "build order: phony || page.cpp\n"
            "build page.cpp | ${cmake_ninja_workdir}page.cpp: CUSTOM_COMMAND page.html\n"
            f"build {self.LIBRARY}: CXX_STATIC_LIBRARY_LINKER__r_ b.cpp.o || {self.OBJECT}\n"), [])

    def test_a_library_behind_a_generated_file_or_behind_a_phony_is_found(self):
        library = f"build {self.LIBRARY}: CXX_STATIC_LIBRARY_LINKER__r_ b.cpp.o\n"
        for between in (f"build order: phony || page.cpp\nbuild page.cpp: CUSTOM_COMMAND html || {self.LIBRARY}\n",
                        f"build order: phony || $\n    {self.LIBRARY}\n"):
            with self.subTest(between=between):
                self.expect_one(self.findings(
                    f"build {self.OBJECT}: CXX_COMPILER__herr_server_ a.cpp || order\n" + between + library),
                    "1 objects of server/CMakeFiles/herr_server.dir/", self.LIBRARY, self.OBJECT)


@unittest.skipUnless(shutil.which("c++") and shutil.which("objdump"), "c++ or objdump is missing")
class SymbolRules(Tree):
    """Units like those of kernels: a function for AVX2, and an inline one that may or may not be compiled for it."""
    UNIT = """
inline __attribute__((noinline)) float before(const float* x) {{ return x[0] * x[1]; }}
#pragma GCC push_options
#pragma GCC target("{target}")
namespace herr::{space} {{ float kernel(const float* x) {{ return before(x) + x[2]; }} }}
{inside}
#pragma GCC pop_options
{after}
"""

    def findings(self, target="avx2", space="N_AVX2", inside="", after=""):
        self.write("unit.cpp", self.UNIT.format(target=target, space=space, inside=inside, after=after))
        unit, built = self.root / "unit.cpp", self.root / "unit.o"
        subprocess.run(["c++", "-O2", "-msse4.2", "-c", unit, "-o", built], check=True)
        return list(check_symbols.findings("unit.o", check_symbols.functions_of(built)))

    def test_functions_in_the_namespace_of_their_instruction_set_are_no_finding(self):
        self.assertEqual(self.findings(), [])
        self.assertEqual(self.findings(target="avx512f", space="N_AVX3"), [])

    def test_an_inline_function_that_a_wide_unit_compiled_is_found(self):
        leak = "struct Box { float side; __attribute__((noinline)) float volume() const { return side * side * side; } };"
        self.expect_one(self.findings(inside=leak, after="float f(Box b) { return b.volume(); }"), "Box", "needs AVX")

    def test_wider_instructions_than_the_namespace_says_are_found(self):
        wide = "typedef float V __attribute__((vector_size(64)));\nnamespace herr::N_AVX2 { V g(V x) { return x + x; } }"
        self.expect_one(self.findings(target="avx512f", space="N_AVX3", inside=wide), "N_AVX2", "needs AVX-512")


if __name__ == "__main__":
    unittest.main()
