#!/usr/bin/env python3
"""scripts/bench keeps what it does not measure, and fails loudly when the program does."""

import importlib.machinery
import importlib.util
import os
import pathlib
import tempfile
import unittest
import unittest.mock

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent


def load_bench():
    loader = importlib.machinery.SourceFileLoader("bench", str(ROOT / "scripts/bench"))
    module = importlib.util.module_from_spec(importlib.util.spec_from_loader("bench", loader))
    loader.exec_module(module)
    return module


bench = load_bench()


class Page(unittest.TestCase):
    def test_sections_come_back_as_they_were_written(self):
        sections = {"Rays by kind": "*line*\n\n| a |\n|---|\n| 1 |", "By hand": "Kept."}
        self.assertEqual(bench.sections_of(bench.page_text(sections)), sections)

    def test_tables_stand_in_their_order_and_other_sections_behind_them(self):
        titles = [one.title for one in bench.TABLES]
        page = bench.page_text({"By hand": "x", titles[1]: "y", titles[0]: "z"})
        self.assertEqual(list(bench.sections_of(page)), [titles[0], titles[1], "By hand"])

    def test_the_page_in_the_tree_is_one_that_the_script_writes(self):
        text = (ROOT / bench.PAGE).read_text(encoding="utf-8")
        self.assertEqual(bench.page_text(bench.sections_of(text)), text)

    def test_names_of_tables_are_different(self):
        names = [one.name for one in bench.TABLES]
        self.assertEqual(len(names), len(set(names)))

    def test_a_table_without_rows_is_no_table(self):
        with self.assertRaises(bench.Failed):
            bench.markdown(["a"], [])


class Program(unittest.TestCase):
    def program(self, script):
        folder = pathlib.Path(tempfile.mkdtemp(prefix="herr-bench-test-"))
        self.addCleanup(lambda: [(folder / "herr").unlink(), folder.rmdir()])
        (folder / "herr").write_text(f"#!/bin/sh\n{script}\n")
        os.chmod(folder / "herr", 0o755)
        return bench.Bench(folder / "herr", 1, True)

    def test_a_program_that_fails_ends_the_run_with_its_message(self):
        with self.assertRaisesRegex(bench.Failed, "exit code 3: herr: no such session"):
            self.program("echo herr: no such session >&2; exit 3").herr("inspect", "x")

    def test_what_is_no_json_ends_the_run(self):
        with self.assertRaisesRegex(bench.Failed, "--json"):
            self.program("echo no json").herr_json("bench")

    def test_cpu_time_is_that_of_the_program(self):
        _, busy = self.program("i=0; while [ $i -lt 20000 ]; do i=$((i+1)); done").run()
        _, asleep = self.program("sleep 0.2").run()
        self.assertGreater(busy, asleep)


if __name__ == "__main__":
    unittest.main()
