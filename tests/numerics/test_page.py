#!/usr/bin/env python3
"""scripts/numerics and test_broken_builds.py see what fails: a relation beyond its bound, no number, a fault that nothing
catches."""

import importlib.machinery
import importlib.util
import pathlib
import sys
import unittest

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
sys.dont_write_bytecode = True


def load(file):
    loader = importlib.machinery.SourceFileLoader(pathlib.Path(file).stem, str(ROOT / file))
    module = importlib.util.module_from_spec(importlib.util.spec_from_loader(loader.name, loader))
    loader.exec_module(module)
    return module


numerics = load("scripts/numerics")
broken = load("tests/numerics/test_broken_builds.py")


def result(error, bound=1.0, **others):
    return {"group": "place", "name": "moved", "error": error, "bound": bound, "unit": "steps", "option": "",
            "not_applicable": "", "where": "", **others}


def answer(error, bound):
    return {"asks": "light", "error": str(error), "bound": str(bound), "unit": "ulp", "bound_from": "two roundings"}


class Page(unittest.TestCase):
    def records(self, *results):
        return {"room": {"results": list(results), "cpu_s": 2.0, "cpu": "CPU", "isa": "avx2"}}

    def test_what_lies_beyond_its_bound_or_is_no_number_fails(self):
        self.assertEqual(numerics.failures([answer(2, 1)], self.records(result(2.0))), ["light", "room: moved"])
        self.assertEqual(numerics.failures([answer("nan", 1)], {}), ["light"])
        for text in ("nan", "inf"):
            self.assertEqual(numerics.failures([], self.records(result(None, error_text=text))), ["room: moved"])

    def test_what_holds_is_off_or_was_not_asked_does_not_fail(self):
        fine = self.records(result(1.0), result(0.0, bound=0.0), result(2.0, option="adaptive light samples"),
                            result(None, error_text="nan", not_applicable="no material reflects"))
        self.assertEqual(numerics.failures([answer(1, 1)], fine), [])

    def test_the_relation_closest_to_its_bound_is_named(self):
        text = numerics.page_text("*line*", [answer(1, 4)], self.records(
            result(0.5), result(0.9, name="turned"), result(5.0, name="scaled"), result(0.0, bound=0.0, name="same")))
        self.assertIn("Closest to its limit of all: place: turned, in `room`, at 90 % of its bound.", text)
        self.assertIn("`room`: place: scaled fails: 5 against 1 steps.", text)
        self.assertIn("| place | scaled | 5 | 1 | steps | **fails** `room`, 500 % |", text)

    def test_the_page_in_the_tree_is_one_that_the_script_writes(self):
        text = (ROOT / numerics.PAGE).read_text(encoding="utf-8")
        self.assertTrue(text.startswith(numerics.HEAD))
        for name in numerics.bench.SCENES:
            self.assertIn(f"| `{name}` |", text)


class BrokenBuilds(unittest.TestCase):
    exact, noisy = broken.Expected("place", "moved"), broken.Expected("samples", "mean", worse=1.5)

    def test_a_fault_is_caught_where_the_relation_fails_with_it_alone(self):
        self.assertEqual(broken.problem_of(self.exact, (0, result(0.5)), (1, result(2.0))), "")
        self.assertIn("not caught", broken.problem_of(self.exact, (0, result(0.5)), (0, result(0.5))))
        self.assertIn("does not hold", broken.problem_of(self.exact, (1, result(2.0)), (1, result(2.0))))
        self.assertIn("ends with 0", broken.problem_of(self.exact, (0, result(0.5)), (0, result(2.0))))

    def test_where_the_relation_fails_anyway_a_fault_makes_it_clearly_worse(self):
        self.assertEqual(broken.problem_of(self.noisy, (0, result(2.0)), (0, result(3.1))), "")
        self.assertIn("1.5 times", broken.problem_of(self.noisy, (0, result(2.0)), (0, result(2.9))))
        self.assertIn("1.5 times", broken.problem_of(self.noisy, (0, result(0.1)), (0, result(0.9))))


if __name__ == "__main__":
    unittest.main()
