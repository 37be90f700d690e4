#!/usr/bin/env python3
"""scripts/paper makes its page: `--run PROGRAM` asks the program for small pictures of every section; without it the
drawings and the page alone are held."""

import importlib.machinery
import importlib.util
import json
import math
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
PROGRAM = None


def load_paper():
    loader = importlib.machinery.SourceFileLoader("paper", str(ROOT / "scripts/paper"))
    module = importlib.util.module_from_spec(importlib.util.spec_from_loader("paper", loader))
    loader.exec_module(module)
    return module


sys.dont_write_bytecode = True
paper = load_paper()
drawings = paper.drawings
# A cone of density 100 in the middle that falls by 2 per degree.
CONE = [(float(deg), 100.0 - 2 * deg) for deg in range(0, 50)]
ONE_PIXEL = bytes.fromhex("89504e470d0a1a0a0000000d49484452000000010000000108000000003a7e9b55"
                          "0000000a49444154789c63600000000200015c4f86250000000049454e44ae426082")


class Drawings(unittest.TestCase):
    def test_a_curve_is_mirrored_and_higher_where_it_is_denser(self):
        frame = drawings.Frame(60, 1, 300)
        left, right, middle = frame.at(-20, 10), frame.at(20, 10), frame.at(0, 10)
        self.assertAlmostEqual(left[0] + right[0], 2 * middle[0])
        self.assertLess(frame.at(0, 100)[1], frame.at(0, 10)[1])  # SVG counts downwards
        # Decades are equally high on a logarithmic axis.
        self.assertAlmostEqual(frame.at(0, 1)[1] - frame.at(0, 10)[1], frame.at(0, 10)[1] - frame.at(0, 100)[1])

    def test_the_volume_changes_its_colour_at_60_and_at_45_degrees(self):
        # 100 - 2 deg falls through 60 at 20 degrees.
        self.assertAlmostEqual(drawings.crossing(CONE, 60), 20)
        rings = dict(drawings.rings_of(CONE[::7], 60, 45))
        self.assertAlmostEqual(rings[20.0], 60)
        self.assertAlmostEqual(rings[45.0], 10)

    def test_a_curve_that_stays_below_has_no_crossing(self):
        self.assertIsNone(drawings.crossing([(0.0, 50.0), (10.0, 40.0)], 60))

    def test_drawings_are_sound_xml_that_asks_for_nothing(self):
        curve = drawings.Curve("<a> & b", CONE, drawings.RED, filled=True)
        for text in (drawings.density_diagram([curve], "t < u"), drawings.acuity_volume(CONE, "t < u")):
            xml.etree.ElementTree.fromstring(text)
            self.assertNotIn("href", text)

    def test_the_eye_reads_letters_of_20_20_in_the_middle(self):
        # 20/20: strokes of one arc minute, 60 a degree; the study's observers read a little finer.
        self.assertAlmostEqual(paper.letters_per_degree(0), 63.4, delta=0.1)
        self.assertTrue(all(paper.letters_per_degree(deg) < 200 / (deg + 1) for deg in range(0, 91)))


class Page(unittest.TestCase):
    def section(self):
        return paper.Section("figure-0", "Figure 0: a test", "in the paper", "here", ["herr replay 'a b' && c < d"],
                             [paper.Picture("a <picture>", png=ONE_PIXEL)])

    def test_words_and_commands_are_escaped(self):
        page = paper.page_html("t", "<p>lead</p>", [self.section()])
        self.assertIn("herr replay &#x27;a b&#x27; &amp;&amp; c &lt; d", page)
        self.assertIn("a &lt;picture&gt;", page)
        self.assertIn('href="#figure-0"', page)

    def test_a_cell_has_its_ratio_to_the_paper(self):
        cell = {"polar": "1576x768", "light_samples": 1, "frame_ms": 102.0}
        self.assertIn("(10.0×)", paper.time_cell(cell))  # 102 / 10.2
        self.assertEqual(paper.time_cell({**cell, "polar": "64x32"}), "102")

    def test_sizes_are_those_of_the_files(self):
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder) / "a.png"
            file.write_bytes(ONE_PIXEL)
            self.assertEqual(paper.size_of(file), (1, 1))
            file.write_bytes(b"GIF89a" + bytes(30))
            with self.assertRaises(paper.bench.Failed):
                paper.size_of(file)


class Failing(unittest.TestCase):
    def test_a_program_that_fails_ends_the_script_with_its_words(self):
        with tempfile.TemporaryDirectory(prefix="herr-paper-") as folder:
            done = subprocess.run([sys.executable, "-B", ROOT / "scripts/paper", "--quick", "--herr", "/bin/false", "--only",
                                   "figure-1", "--out", folder], text=True, capture_output=True)
        self.assertEqual(done.returncode, 1)
        self.assertIn("paper: herr inspect", done.stderr)


class Whole(unittest.TestCase):
    """The script itself, as small as it goes."""

    def setUp(self):
        if not PROGRAM:
            self.skipTest("no --run PROGRAM")

    def test_every_section_is_made_and_nothing_is_asked_of_a_network(self):
        with tempfile.TemporaryDirectory(prefix="herr-paper-") as folder:
            done = subprocess.run([sys.executable, "-B", ROOT / "scripts/paper", "--quick", "--herr", PROGRAM, "--out", folder],
                                  text=True, capture_output=True, cwd="/")
            self.assertEqual(done.returncode, 0, done.stderr)
            out = pathlib.Path(folder)
            page = (out / "index.html").read_text(encoding="utf-8")
            for name, title, _ in paper.SECTIONS:
                self.assertIn(f'id="{name}"', page)
                self.assertIn(paper.html.escape(title), page)
            sections = page.split("<h2 ")[1:]
            self.assertEqual(len(sections), len(paper.SECTIONS))
            for section in sections:
                self.assertIn("<pre>herr ", section)
            self.assertEqual(re.findall(r'(?:src|href)="(?!data:|#)[^"]*"|url\(', page), [])
            self.assertIn("--quick", page)
            for number in (3, 6, 7, 8, 9, 10):
                self.assertGreater(paper.size_of(out / f"figure-{number}.png")[0], 100)
            for number in (1, 5):
                xml.etree.ElementTree.parse(out / f"figure-{number}.svg")
            for light in ("paper", "direct"):
                table = json.loads((out / f"table-1-{light}.json").read_text(encoding="utf-8"))
                self.assertTrue(all(math.isfinite(cell["frame_ms"]) for cell in table["table"]))
            self.assertFalse((out / "runs").exists())


if __name__ == "__main__":
    if "--run" in sys.argv:
        place = sys.argv.index("--run")
        PROGRAM = pathlib.Path(sys.argv[place + 1]).resolve()
        del sys.argv[place:place + 2]
    unittest.main()
