# SPDX-License-Identifier: BSD-3-Clause
"""scripts/reproduce: the numbers of docs/reproduction.md still hold."""

import contextlib
import io
import math
import os
import re
import subprocess
import sys
import tempfile
import types
import unittest
from unittest import mock

from paths import SOURCE

FOLDER = os.path.join(SOURCE, "benchmark", "reproduction")
sys.path.insert(0, FOLDER)
import reproduce  # noqa: E402
from section import Claim, Section, digits  # noqa: E402

# ctest sets them.
MEASUREMENTS, REPLAY = os.environ.get("ARDRONE_VSLAM_THESIS_MEASUREMENTS", ""), os.environ.get("ARDRONE_VSLAM_REPLAY", "")


class ClaimTest(unittest.TestCase):
    def test_bounds_belong_to_it_and_no_number_does_not(self):
        self.assertTrue(Claim("", 1, 1, 2).holds() and Claim("", 2, 1, 2).holds())
        self.assertFalse(Claim("", 0.99, 1, 2).holds() or Claim("", 2.01, 1, 2).holds() or Claim("", math.nan).holds())
        self.assertEqual([Claim("", 0, high=2).bounds(), Claim("", 0, 1).bounds(), Claim("", 0, 1, 2).bounds()], ["at most 2", "at least 1", "1 to 2"])

    def test_digits(self):
        self.assertEqual([digits(0.01234), digits(86358), digits(999.6), digits(0), digits(None), digits(math.inf), digits(1.5, 2)],
                         ["0.0123", "86,400", "1,000", "0", "-", "-", "1.5"])

    def test_a_number_out_of_bounds_is_told_on_the_page_and_by_the_exit_code(self):
        broken = Section("A table")
        broken.claim("this", 3, high=2)
        with tempfile.TemporaryDirectory() as out, mock.patch.dict(reproduce.SECTIONS, {"detectors": lambda tools: broken}):
            arguments = types.SimpleNamespace(programs="", measurements="", out=out, quick=True, kitti=None, sections=["detectors"], page=None)
            fault = io.StringIO()
            with contextlib.redirect_stdout(io.StringIO()), contextlib.redirect_stderr(fault):
                self.assertEqual(reproduce.run(arguments), 3)
            self.assertIn("A table: this is 3 but must be at most 2", fault.getvalue())
            with open(os.path.join(out, "reproduction.md"), encoding="utf-8") as page:
                self.assertIn("out of their bounds", page.read())


def committed_page():
    with open(os.path.join(SOURCE, "docs", "reproduction.md"), encoding="utf-8") as page:
        return page.read()


def run_whole(test, out, *options, **environment):
    """@return the page"""
    done = subprocess.run([sys.executable, "-B", os.path.join(FOLDER, "reproduce.py"), "--programs", os.path.dirname(REPLAY), "--measurements", MEASUREMENTS,
                           "--out", out, *options], capture_output=True, text=True, check=False, env={**os.environ, **environment})
    test.assertEqual(done.returncode, 0, done.stdout + done.stderr)
    with open(os.path.join(out, "reproduction.md"), encoding="utf-8") as page:
        return page.read()


def run_quick(test, out, *options, **environment):
    return run_whole(test, out, "--quick", *options, **environment)


NUMBER = r"-?\d+(?:\.\d+)?(?:e-?\d+)?"


def numbers_of_text(title, section):
    """Those of the sentences by section and wording; without sentences that tell times."""
    found = {}
    for line in section.splitlines()[1:]:
        if line.startswith(("|", "![")):
            continue
        for sentence in re.split(r"(?<=[.:;]) ", re.sub(r"(?<=\d),(?=\d{3})", "", line)):
            values = re.findall(NUMBER, sentence)
            if values and not re.search(r"\b(us|ms|ns)\b|as fast|of the time|a second\b", sentence):
                found.setdefault((title, re.sub(NUMBER, "#", sentence)), []).extend(float(value) for value in values)
    return found


def numbers(page):
    """Those of the tables by section, table, row and column, and those of the text; without times and without what OpenCV of another version may find otherwise."""
    found = {}
    for section in re.split("^## ", page, flags=re.MULTILINE)[1:]:
        title = section.split("\n", 1)[0]
        found.update(numbers_of_text(title, section))
        for index, table in enumerate(re.findall(r"(?:^\|.*\n)+", section, re.MULTILINE)):
            heads, _, *rows = ([cell.strip() for cell in line.strip().strip("|").split("|")] for line in table.splitlines())
            # Of a column "here" the one before says what it is.
            of = [heads[i - 1] if head == "here" and "thesis: " in heads[i - 1] else head for i, head in enumerate(heads)]
            for row in rows:
                for head, column, cell in zip(of, range(len(row)), row):
                    values = re.findall(r"-?\d[\d.]*(?:e-?\d+)?", cell.replace(",", ""))
                    if column > 0 and values and not re.search(r"\b(us|ms|ns)\b|cv::", head) and "cv::" not in row[0]:
                        found[title, index, row[0], column] = [float(value) for value in values]
    return found


def compare_numbers(test, page):
    """@param page  with some of the committed one's sections"""
    here, committed = numbers(page), numbers(committed_page())
    titles = {key[0] for key in here}
    test.assertEqual(set(here), {key for key in committed if key[0] in titles}, "the committed page has other tables or sentences: run scripts/reproduce")
    for key, values in here.items():
        for value, other in zip(values, committed[key]):
            # Measured: equal to the last digit; another compiler may add doubles in another order.
            test.assertTrue(math.isclose(value, other, rel_tol=0.02, abs_tol=1e-6), f"{key}: {value}, on the committed page {other}: run scripts/reproduce")


# They need no pictures and take seconds, so that they run whole.
WHOLE = ["lens", "mean_deviation", "landmark_sigma", "ardrone_2d"]


def parts_of(page):
    """{title of a section: the section}"""
    return {part.split("\n", 1)[0]: "## " + part for part in re.split("^## ", page, flags=re.MULTILINE)[1:]}


def skeleton(page):
    """What does not depend on the pictures: sections, pictures' files, what must hold and its bounds."""
    parts = re.findall(r"^(## .*)|^!\[.*\]\((?!.*path_error)(.*)\)$", page, re.MULTILINE)
    for table in re.findall(r"^\| what must hold .*\n.*\n((?:\|.*\n)*)", page, re.MULTILINE):
        for line in table.splitlines():
            what, _, bounds = line.strip("| ").split(" | ")
            if not what.startswith("KITTI 00"):
                parts.append((re.sub("^(wheel|drone): ", "", what), bounds))
    return parts


class ReproductionTest(unittest.TestCase):
    def test_every_number_is_within_its_bounds_on_rendered_pictures(self):
        with tempfile.TemporaryDirectory() as out:
            page = run_quick(self, out, "--sections", *(name for name in reproduce.SECTIONS if name not in WHOLE), ARDRONE_VSLAM_DATA="")
            self.assertIn("a rendered corridor", page)
            committed = parts_of(committed_page())
            self.assertEqual(skeleton(page), skeleton("".join(committed[title] for title in parts_of(page))), "the committed page is not of this code: run scripts/reproduce")
            for line in page.splitlines():
                if line.startswith("!["):
                    picture = os.path.join(out, line.split("](")[1].rstrip(")"))
                    self.assertGreater(os.path.getsize(picture), 1000, picture)

    def test_the_committed_numbers_are_those_of_the_code(self):
        """Of the sections that run whole; the real test has those with pictures. The others are held by their bounds alone: `quality`,
        `hover`, `kitti` and `thresholds` take minutes, and nearly all that `corner_speed` and `descriptors` show are times."""
        with tempfile.TemporaryDirectory() as out:
            compare_numbers(self, run_whole(self, out, "--sections", *WHOLE))

    def test_another_number_is_found(self):
        page = committed_page()
        compare_numbers(self, page)
        for good, bad in (("| 0.00977 | at most", "| 0.0100 | at most"), ("| 149 | 110 |", "| 149 | 106 |"), ("| 0.235 | 0.2 to", "| 0.235 | 0.1 to"),
                          ("repeat to 70 % with", "repeat to 72 % with"), ("50 random inputs", "40 random inputs")):
            with self.subTest(bad=bad):
                self.assertIn(good, page)
                self.assertRaises(AssertionError, compare_numbers, self, page.replace(good, bad))

    def test_wrong_usage_is_told(self):
        for options, message in ((["--kitti", "/nowhere"], "there is no folder image_0"), (["--sections", "none"], "invalid choice"),
                                 (["--sections", "lens", "--page", "x.md"], "needs all sections")):
            done = subprocess.run([sys.executable, "-B", os.path.join(FOLDER, "reproduce.py"), "--programs", "x", "--measurements", "y", "--out", "z", *options],
                                  capture_output=True, text=True, check=False)
            self.assertEqual(done.returncode, 2)
            self.assertIn(message, done.stderr)


if __name__ == "__main__":
    unittest.main()
