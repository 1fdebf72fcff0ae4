# SPDX-License-Identifier: BSD-3-Clause
"""The pages that a newcomer reads first are short, and every link of every page leads somewhere."""

import collections
import re
import subprocess
import unittest

from sources import ROOT

PAGES = [ROOT / "README.md", *sorted((ROOT / "docs").glob("*.md")), *sorted((ROOT / "benchmark").glob("*.md")), ROOT / "bags/README.md"]
DATA_PATH = ROOT / "docs/data_path.md"
MOST_LINES = 120
README_WIDTH = 140  # of a line, so that a terminal shows it
STORY = "## The story"


def links_of(page):
    text = re.sub(r"^ *```.*?^ *```", "", page.read_text(encoding="utf-8"), flags=re.MULTILINE | re.DOTALL)
    return [target for target in re.findall(r"\]\(([^)\s]+)\)", text) if "://" not in target]


def anchors_of(page):
    """As GitHub makes them of headings."""
    headings = re.findall(r"^#+ (.*)$", page.read_text(encoding="utf-8"), re.MULTILINE)
    return {re.sub(r"[^a-z0-9 _-]", "", heading.lower()).replace(" ", "-") for heading in headings}


def sources_named_in(text, folders):
    """The files that are linked, each once, in their order."""
    return list(dict.fromkeys(path for path in re.findall(rf"\]\(\.\./((?:{folders})/[\w/]+\.[ch]pp)\)", text)))


def with_other_half(path):
    """The header of a .cpp, the .cpp of a header, wherever it lies."""
    stem = path.rpartition("/")[2].partition(".")[0]
    found = [*(ROOT / "src").rglob(f"{stem}.?pp"), *(ROOT / "include").rglob(f"{stem}.hpp"), *(ROOT / "nodes").rglob(f"{stem}.?pp")]
    return [str(other.relative_to(ROOT)) for other in found]


def rooms_used_by_rooms():
    """{room of src/: the other rooms whose headers it includes}."""
    used = {room.name: set() for room in (ROOT / "src").iterdir() if room.is_dir()}
    for room, others in used.items():
        for path in (ROOT / "src" / room).rglob("*.?pp"):
            others.update(re.findall(r'^#include "(\w+)/', path.read_text(encoding="utf-8"), re.MULTILINE))
        others &= used.keys() - {room}
    return used


def lines_of(path):
    return len(path.read_text(encoding="utf-8").splitlines())


class PagesTest(unittest.TestCase):
    def test_first_pages_are_short(self):
        for page in (ROOT / "README.md", DATA_PATH):
            self.assertLessEqual(lines_of(page), MOST_LINES, page.relative_to(ROOT))

    def test_readme_fits_a_terminal(self):
        for number, line in enumerate((ROOT / "README.md").read_text(encoding="utf-8").splitlines(), 1):
            self.assertLessEqual(len(line), README_WIDTH, f"README.md:{number}")

    def test_readme_says_on_its_first_screen_what_was_not_tried(self):
        first_screen = "".join((ROOT / "README.md").read_text(encoding="utf-8").splitlines(keepends=True)[:30])
        self.assertIn("Not yet flown on a real drone", first_screen)
        self.assertIn("| fused [m] |", first_screen)

    def test_links_lead_somewhere(self):
        wrong = []
        for page in PAGES:
            links = links_of(page)
            for link in links:
                path, _, anchor = link.partition("#")
                target = page.parent / path if path else page
                if not target.exists() or anchor and anchor not in anchors_of(target):
                    wrong.append(f"{page.relative_to(ROOT)}: {link}")
        self.assertEqual(wrong, [])

    def test_every_page_is_reached_from_the_readme(self):
        reached, todo = set(), [ROOT / "README.md"]
        while todo:
            page = todo.pop()
            if page in reached:
                continue
            reached.add(page)
            todo += [(page.parent / link.partition("#")[0]).resolve() for link in links_of(page) if link.partition("#")[0].endswith(".md")]
        self.assertEqual([str(page.relative_to(ROOT)) for page in PAGES if page not in reached], [])


class DoxygenFilterTest(unittest.TestCase):
    def test_reads_every_file_and_documents_each_parameter(self):
        """Doxygen takes a filter that fails for an empty file, and says nothing."""
        for path in [*(ROOT / "include").rglob("*.hpp"), *(ROOT / "msg").iterdir(), *(ROOT / "srv").iterdir()]:
            done = subprocess.run([ROOT / "docs/doxygen_filter", path], capture_output=True, text=True, check=False)
            with self.subTest(path.name):
                self.assertEqual(done.stderr, "")
                parameters = re.findall(r"ParameterInfo\{", path.read_text(encoding="utf-8"))
                self.assertEqual(done.stdout.count("; parameter `"), len(parameters))


class FiguresTest(unittest.TestCase):
    def test_the_readme_says_what_the_benchmark_measured(self):
        page = (ROOT / "benchmark/RESULTS.md").read_text(encoding="utf-8")
        results = {cells[1]: cells for cells in (line.split("|") for line in page.splitlines()) if len(cells) > 7}
        readme = (ROOT / "README.md").read_text(encoding="utf-8")
        self.assertIn(" ".join(re.search(r"^(\S.*) \(family \d+, model \d+\)", page, re.M)[0].split()), " ".join(readme.split()))
        for row, what in (("tracker_kitti", "image to 600 tracked features, KITTI"), ("fast9_kitti", "FAST-9, the same corners"),
                          ("exact_100k", "1000 descriptors among 100,000, exactly")):
            time, unit = results[f" {row} "][3].split()
            ms = float(time) / {"us": 1000, "ms": 1}[unit]
            ratio = float(results[f" {row} "][6].strip(" *"))
            times = f"{ratio:.0f}" if ratio >= 10 else f"{ratio:.1f}"
            with self.subTest(row):
                self.assertRegex(readme, rf"\| {what} \| {ms:.2g} ms \| [^|]* \| {times} times as long \|")
                if row == "tracker_kitti":
                    self.assertIn(f"600 tracked features it takes {ms:.2g} ms", readme)

    def test_the_readme_says_what_evaluate_all_measured(self):
        results = {}
        for line in (ROOT / "docs/results.md").read_text(encoding="utf-8").splitlines():
            cells = [cell.strip() for cell in line.split("|")]
            if len(cells) > 9:
                results[tuple(cells[i] for i in (1, 3, 4))] = cells
        rows = re.findall(r"^\| `(\w+)`: [^|]* \| `([^`]*)` \| (.*) \| (.*) \| (.*) \| (.*) \|$", (ROOT / "README.md").read_text(encoding="utf-8"), re.M)
        self.assertGreater(len(rows), 4)
        for sequence, profile, odometry_m, fused_m, ratio, ratio_thesis in rows:
            with self.subTest(sequence):
                cells = results[sequence, profile, "msckf"]
                self.assertEqual([odometry_m, fused_m, ratio], [cells[i] for i in (8, 6, 9)])
                self.assertEqual(ratio_thesis, results[sequence, profile, "thesis"][9])


class RoomsTest(unittest.TestCase):
    def test_the_readme_says_what_the_drivers_faults_may_cost(self):
        test = (ROOT / "test/offline_ros/driver_fault_error_test.cpp").read_text(encoding="utf-8")
        factor = re.search(r"([\d.]+) \* clean_m", test)[1]
        self.assertIn(f"below {factor} times that without faults", (ROOT / "README.md").read_text(encoding="utf-8"))

    def test_what_is_said_to_be_in_status_is_there(self):
        fields = set(re.findall(r"^[\w/]+(?:\[\])? (\w+) ", (ROOT / "msg/Status.msg").read_text(encoding="utf-8"), re.MULTILINE))
        for page in PAGES:
            named = re.findall(r"`(\w+)` in `(?i:status)`", page.read_text(encoding="utf-8"))
            self.assertLessEqual(set(named), fields, page)

    def test_every_room_of_the_core_is_named_and_none_that_is_not_there(self):
        named = set(re.findall(r"`src/(\w+)`", (ROOT / "docs/rooms.md").read_text(encoding="utf-8")))
        self.assertEqual(named, {path.name for path in (ROOT / "src").iterdir() if path.is_dir()})

    def test_no_room_has_too_many_files(self):
        for top in ("src", "tools", "nodes", "onboard", "common"):
            files = collections.Counter(path.parent for path in (ROOT / top).rglob("*.?pp"))
            self.assertGreater(len(files), 1, top)
            self.assertEqual({str(room): count for room, count in files.items() if count > 20}, {})

    def test_rooms_of_the_core_do_not_include_each_other_in_a_circle(self):
        used = rooms_used_by_rooms()
        self.assertGreater(sum(map(len, used.values())), 20)
        while lowest := {room for room in used if not used[room]}:
            used = {room: others - lowest for room, others in used.items() if room not in lowest}
        self.assertEqual(used, {}, "each of these uses another one of them")


class DataPathTest(unittest.TestCase):
    def test_it_names_files_that_exist_and_not_too_many(self):
        text = DATA_PATH.read_text(encoding="utf-8")
        story = text[text.index(STORY):]
        story = story[:story.index("\n## ", len(STORY))]
        core, all_folders = "src|include", "src|include|nodes"
        # The goal for all was 25 files: a page that names what an image reaches, as readers asked for, needs more.
        for name, part, folders, most_files, most_lines, most_with_halves in (
                ("the story, core", story, core, 15, 1500, (30, 3500)), ("the story, with its nodelets", story, all_folders, 17, 1850, (34, 4000)),
                ("all, core", text, core, 32, 3000, (60, 6100)), ("all, with nodes", text, all_folders, 38, 3500, (72, 7500))):
            files = sources_named_in(part, folders)
            self.assertEqual([path for path in files if not (ROOT / path).is_file()], [])
            lines = sum(lines_of(ROOT / path) for path in files)
            pairs = {other for path in files for other in (path, *with_other_half(path))}
            lines_of_pairs = sum(lines_of(ROOT / path) for path in pairs)
            print(f"docs/data_path.md, {name}: {len(files)} files, {lines} lines; with their headers and .cpp: {len(pairs)} files, {lines_of_pairs} lines")
            self.assertLessEqual(len(pairs), most_with_halves[0], name)
            self.assertLessEqual(lines_of_pairs, most_with_halves[1], name)
            self.assertGreater(len(files), 8)
            self.assertLessEqual(len(files), most_files, name)
            self.assertLessEqual(lines, most_lines, name)


if __name__ == "__main__":
    unittest.main()
