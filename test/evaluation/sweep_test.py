# SPDX-License-Identifier: BSD-3-Clause
"""scripts/evaluate_all --sweep and --tuning: what is run, what is shown of it, and that no parameter lacks in docs/tuning.md."""

import json
import os
import re
import subprocess
import tempfile
import unittest

from paths import SOURCE

from ardrone_vslam_evaluation import sweep, sweep_page
from ardrone_vslam_evaluation.batch_jobs import Job, Sequence
from ardrone_vslam_evaluation.faults import InputFault
from ardrone_vslam_evaluation.parameters import configured, in_order, is_same, of_replay, read_page

PROGRAMS = os.path.dirname(os.environ.get("ARDRONE_VSLAM_REPLAY", ""))  # ctest sets it
CONFIG = f"{SOURCE}/config"
PLAN = f"{SOURCE}/docs/tuning_sweep.json"
SEQUENCE = Sequence("room", ("drone",), flight=("laps",))


def text_of(path):
    with open(f"{SOURCE}/docs/{path}", encoding="utf-8") as file:
        return file.read()


def parameters():
    return read_page(text_of("parameters.md"))


def case(name="room", **changes):
    return sweep.Case(name, Job(SEQUENCE, "drone", "msckf", "1:2", changes.pop("settings", ())), **changes)


class ParametersTest(unittest.TestCase):
    def test_are_read_from_the_page(self):
        known = of_replay(parameters())
        self.assertEqual((known["cell_size_px"].default, known["cell_size_px"].unit), ("80", "px"))
        self.assertEqual(known["odometry_mode"].sections, ("mapper", "odometry_fusion"))
        self.assertNotIn("autopilot", known)

    def test_of_a_configuration(self):
        values = configured(f"{CONFIG}/kitti.yaml")
        self.assertEqual((values["track_common_px"], values["fix_min_age_s"], values["odom_frame"]), ("3.5", "10", '""'))
        with self.assertRaisesRegex(InputFault, "none.yaml"):
            configured(f"{CONFIG}/none.yaml")

    def test_values_are_ordered_as_numbers(self):
        self.assertEqual(in_order(["10", "9", "0.5", "10.0"]), ["0.5", "9", "10"])
        self.assertEqual(in_order(["true", "false", "true"]), ["true", "false"])
        self.assertTrue(is_same("1e3", "1000"))
        self.assertFalse(is_same("true", "1"))


class PanelTest(unittest.TestCase):
    def setUp(self):
        self.known = of_replay(parameters())

    def test_base_is_what_the_case_has(self):
        panel = sweep.panel_of("track_common_px", ["0", "3.5"], [case(), case("street", config=f"{CONFIG}/kitti.yaml"),
                                                                case("own", settings=("track_common_px=9",))], self.known)
        points = {line[0].name: [(p.value, p.is_base, p.job.settings) for p in line[1]] for line in panel.lines}
        self.assertEqual(points["room"], [("0", False, ("track_common_px=0",)), ("0.7", True, ()), ("3.5", False, ("track_common_px=3.5",))])
        self.assertEqual([p[:2] for p in points["street"]], [("0", False), ("0.7", False), ("3.5", True)])
        self.assertEqual(points["own"][-1], ("9", True, ("track_common_px=9",)))
        self.assertEqual((panel.default, panel.values()), ("0.7", ["0", "0.7", "3.5", "9"]))

    def test_the_estimator_is_no_setting(self):
        panel = sweep.panel_of("estimator", ["thesis"], [case()], self.known)
        self.assertEqual([(p.job.estimator, p.job.settings) for p in panel.lines[0][1]], [("msckf", ()), ("thesis", ())])

    def test_jobs_that_panels_share_run_once(self):
        group = sweep.group_of_options(["threshold_min=20,50", "use_attitude=true"], [case().job], self.known)
        self.assertEqual([job.settings for job in sweep.jobs_of([group])], [(), ("threshold_min=20",), ("threshold_min=50",), ("use_attitude=true",)])

    def test_what_is_wrong_is_named(self):
        for option, part in (("threshold_min", "NAME=VALUE"), ("treshold_min=3", "treshold_min: is no parameter")):
            with self.assertRaisesRegex(InputFault, part):
                sweep.group_of_options([option], [case().job], self.known)


class ResultsTest(unittest.TestCase):
    def setUp(self):
        self.group = sweep.group_of_options(["threshold_min=20,50", "use_attitude=true"], [case().job], of_replay(parameters()))
        self.folders = tempfile.TemporaryDirectory()
        self.addCleanup(self.folders.cleanup)

    def measured(self, ratios, outside=0.0):
        folders = {}
        for job in sweep.jobs_of([self.group]):
            values = ratios.get(job.settings)
            if values is None:
                continue
            folders[job] = f"{self.folders.name}/{len(folders)}"
            os.makedirs(folders[job], exist_ok=True)
            with open(f"{folders[job]}/summary.json", "w") as file:
                share = outside if job.settings == ("threshold_min=20",) else 0
                json.dump({"runs": [{"ratio_scale_removed": value, "outside_3_sigma": share} for value in values]}, file)
        return sweep.measure([self.group], folders)

    def test_change_is_that_of_each_seed(self):
        results = self.measured({(): [0.1, 0.4], ("threshold_min=20",): [0.2, 0.4], ("threshold_min=50",): [0.1, None], ("use_attitude=true",): [0.1, 0.4]}, 0.1)
        by_value = {(panel.name, point.value): results.get((line[0], point)) for panel in self.group.panels for line in panel.lines
                    for point in line[1]}
        self.assertEqual((by_value["threshold_min", "20"].relative, by_value["threshold_min", "20"].change()), ((2, 1), 1.5))
        self.assertIsNone(by_value["threshold_min", "50"], "a seed lacks")
        self.assertTrue(by_value["threshold_min", "20"].is_overconfident())
        threshold, attitude = self.group.panels
        limits = sweep_page.scatter(results)
        self.assertEqual(limits, {"room drone msckf": 1.1}, "too few to tell")
        self.assertEqual(sweep_page.effects(threshold, results, limits), [(1.5, "20", "room drone msckf")])
        self.assertEqual(sweep_page.overconfident(threshold, results), "20 (room drone msckf)")
        self.assertTrue(sweep_page.changes_nothing(attitude, results))
        table = sweep_page.table_of_group(self.group, results, limits)
        self.assertIn("| `threshold_min` | 8 | 20, 50 | - | 1.50: 20 (room drone msckf) | 20 (room drone msckf) |", table)
        self.assertNotIn("use_attitude", table)
        self.assertIn("| `threshold_min` | room drone msckf | 50 | - |", sweep_page.full_table([self.group], results))

    def test_scatter_is_that_of_most_runs(self):
        many = {(case(), sweep.Point(str(i), case().job, False)): sweep.Measured((1,), (1.02 ** (-1) ** i,), 0) for i in range(60)}
        self.assertAlmostEqual(sweep_page.scatter(many)["room"], 1.02 ** (2.5 * 1.4826))
        few_strong = {(case(), sweep.Point(str(i), case().job, False)): sweep.Measured((1,), (3.0,), 0) for i in range(100, 120)}
        self.assertAlmostEqual(sweep_page.scatter({**many, **few_strong})["room"], 1.02 ** (2.5 * 1.4826))

    def test_clear_effects_are_beyond_the_scatter_and_no_seed_contradicts(self):
        results = self.measured({(): [0.1, 0.4], ("threshold_min=20",): [0.2, 0.5], ("threshold_min=50",): [0.09, 0.2], ("use_attitude=true",): [0.101, 0.4]})
        limits = {"room drone msckf": 1.3}
        threshold, attitude = self.group.panels
        clear = [(round(change, 3), value) for change, value, _ in sweep_page.effects(threshold, results, limits)]
        self.assertEqual(clear, [(1.625, "20"), (0.7, "50")])
        self.assertAlmostEqual(sweep_page.strength(threshold, results, limits), 1.625)
        self.assertEqual(sweep_page.strength(attitude, results, limits), 1)
        self.assertIn("| `threshold_min` | 8 | 20, 50 | 0.70: 50 (room drone msckf) | 1.62: 20 (room drone msckf) | - |",
                      sweep_page.table_of_group(self.group, results, limits))
        self.assertEqual(sweep_page.effects(threshold, results, {"room drone msckf": 1.7}), [])
        contradicting = self.measured({(): [0.1, 0.4], ("threshold_min=20",): [0.3, 0.3]})
        self.assertEqual(sweep_page.effects(threshold, contradicting, {"room drone msckf": 1.3}), [])
        self.assertEqual(len(sweep_page.effects(threshold, contradicting, {"room drone msckf": 1.4})), 1)

    def test_only_the_measured_part_of_the_page_changes(self):
        page = f"before\n{sweep_page.BEGIN}\nold\n{sweep_page.END}\nafter\n"
        self.assertEqual(sweep_page.with_measured_part(page, "new\\1", "x.md"), "before\nnew\\1\nafter\n")
        with self.assertRaisesRegex(InputFault, "x.md: has no place"):
            sweep_page.with_measured_part("nothing", "new", "x.md")


class PlanTest(unittest.TestCase):
    def setUp(self):
        with open(PLAN, encoding="utf-8") as file:
            self.raw = json.load(file)
        self.swept = [name for group in self.raw["groups"] for name in group["parameters"]]
        self.without = [name for names in self.raw["without"].values() for name in names]

    def test_every_parameter_has_a_panel_or_a_reason(self):
        named = self.swept + self.without
        self.assertEqual(len(named), len(set(named)), "none twice")
        for parameter in parameters():
            if not set(parameter.sections) <= set(self.raw["sections_without"]):
                self.assertIn(parameter.name, named, f"{parameter.sections}: give it values or a reason in docs/tuning_sweep.json")
        self.assertEqual(set(named) - {parameter.name for parameter in parameters()}, set(), "docs/parameters.md has no such")

    def test_values_are_within_the_ranges(self):
        ranges = dict(re.findall(r"\| `(\w+)` \| .*? \| .*? \| .*? \| (?:auto, )?(\S+ to \S+) \|", text_of("parameters.md")))
        for group in self.raw["groups"]:
            for name, entry in group["parameters"].items():
                if name in ranges:
                    low, high = map(float, ranges[name].split(" to "))
                    for value in entry["values"] if isinstance(entry, dict) else entry:
                        self.assertTrue(low <= value <= high, f"{name} {value}")

    def test_page_shows_them_all(self):
        page = text_of("tuning.md")
        for name in self.swept + self.without:
            self.assertIn(f"`{name}`", page)
        for picture in re.findall(r"\]\((images/\w+\.png)\)", page):
            size = os.path.getsize(f"{SOURCE}/docs/{picture}")
            self.assertLess(size, 150_000, picture)
        self.assertEqual(len(re.findall(r"\]\(images/tuning_\w+\.png\)", page)), len(self.raw["groups"]) + 1)

    def test_without_data_the_synthetic_cases_are_left(self):
        plan = sweep.read_plan(PLAN, of_replay(parameters()), None, "1:3", CONFIG)
        self.assertEqual(plan.left_out, ("kitchen", "street", "thesis_street"))
        self.assertEqual({job.sequence.name for job in sweep.jobs_of(plan.groups)}, {"room", "dim", "floor"}, "what is alike is rendered once")


class WholeTest(unittest.TestCase):
    def evaluate_all(self, work, *arguments):
        done = subprocess.run([f"{SOURCE}/scripts/evaluate_all", "--programs", PROGRAMS, "--work", work, "--seeds", "1:2", "--jobs", "2", *arguments],
                              capture_output=True, text=True, check=False)
        return done.returncode, done.stdout, done.stderr

    def test_two_seconds_of_flight(self):
        with tempfile.TemporaryDirectory() as folder:
            selection = f"{folder}/selection.json"
            with open(selection, "w") as file:
                json.dump([{"name": "tiny", "make_world": ["laps", "--rate", "10", "--seconds", "2"], "profiles": ["drone"]}], file)
            sweep_of_two = ("--selection", selection, "--estimators", "msckf", "--sweep", "features_per_frame=100", "--sweep", "use_attitude=true")
            code, out, fault = self.evaluate_all(folder, *sweep_of_two)
            self.assertEqual(code, 0, fault)
            self.assertIn("| `features_per_frame` | tiny drone msckf | 1000 (base) | 0.", out)
            self.assertEqual(out.count("\n| `"), 4)
            first = [self.bytes_of(f"{folder}/{name}") for name in ("sweep.md", "sweep.png")]
            self.assertEqual(sorted(os.listdir(f"{folder}/runs/tiny/drone/msckf,use_attitude=true")), ["key", "summary.json"])
            os.remove(f"{folder}/runs/tiny/drone/msckf,use_attitude=true/key")
            code, _, fault = self.evaluate_all(folder, *sweep_of_two)
            self.assertIn("1 runs to do, 2 done before", fault)
            self.assertEqual([self.bytes_of(f"{folder}/{name}") for name in ("sweep.md", "sweep.png")], first)

    def bytes_of(self, path):
        with open(path, "rb") as file:
            return file.read()

    def test_wrong_usage_is_told(self):
        with tempfile.TemporaryDirectory() as folder:
            for arguments, part in ((("--tuning", "--sequences", "laps"), "of its own"), (("--sweep", "threshold_min=1", "--update"), "updates no page"),
                                    (("--quick", "--sweep", "treshold_min=3"), "is no parameter")):
                code, _, fault = self.evaluate_all(folder, *arguments)
                self.assertEqual(code, 2, fault)
                self.assertIn(part, fault)


if __name__ == "__main__":
    unittest.main()
