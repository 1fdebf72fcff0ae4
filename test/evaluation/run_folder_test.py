# SPDX-License-Identifier: BSD-3-Clause
"""Folders that simulate_landmarks writes, as replay does: the same numbers as tools/trajectory/metrics.cpp has."""

import html
import json
import os
import shutil
import subprocess
import tempfile
import unittest

from paths import evaluate, straight, there_and_back, write_tum

PROGRAM = os.environ.get("ARDRONE_VSLAM_SIMULATE_LANDMARKS", "")  # ctest sets it
# Python's key -> summary.json's. TUM files keep nine digits.
SAME = {"ate.none.rmse_m": "fused_ate_rmse_m", "ate.none.mean_m": "fused_error_mean_m", "ate.none.max_m": "fused_error_max_m",
        "ate.none.last_m": "fused_error_last_m", "ate.se3.rmse_m": "fused_ate_rmse_aligned_m", "ratio": "ratio",
        "ratio_scale_removed": "ratio_scale_removed", "t_rel_percent": "t_rel_percent", "nees.mean": "nees_mean",
        "cost.ms_per_frame.median": "ms_per_frame_median", "cost.ms_per_frame.p95": "ms_per_frame_p95",
        "cost.landmark_matches_median": "landmark_matches_median", "cost.landmarks": "landmarks"}
SAME_OF_OBSERVER = {"ate.none.rmse_m": "odometry_ate_rmse_m", "ate.none.last_m": "odometry_error_last_m",
                    "t_rel_percent": "odometry_t_rel_percent"}


def look_up(numbers, path):
    for key in path.split("."):
        numbers = numbers[key]
    return numbers


class RunFolderTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.temporary = tempfile.TemporaryDirectory()
        cls.runs = os.path.join(cls.temporary.name, "runs")
        truth = write_tum(os.path.join(cls.temporary.name, "truth.tum"), there_and_back(440))
        subprocess.run([PROGRAM, truth, "--out", cls.runs, "--seeds", "1:2", "--landmarks", "1500", "--estimator", "thesis,msckf"],
                       check=True, capture_output=True)

    @classmethod
    def tearDownClass(cls):
        cls.temporary.cleanup()

    def test_a_path_that_stands_still_has_no_street(self):
        path = write_tum(os.path.join(self.temporary.name, "still.tum"), straight(0.5, 60))
        done = subprocess.run([PROGRAM, path, "--out", os.path.join(self.temporary.name, "still")], capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 1)
        self.assertIn(f"{path}: its poses do not move by a metre", done.stderr)

    def numbers(self, *arguments):
        """And the table."""
        target = os.path.join(self.temporary.name, "numbers.json")
        code, out, fault = evaluate(*arguments, "--table", "--json", target)
        self.assertEqual(code, 0, fault)
        with open(target) as file:
            return json.load(file), out

    def page(self, folder):
        target = os.path.join(self.temporary.name, "page.html")
        numbers, _ = self.numbers(folder, "--html", target)
        with open(target) as file:
            return numbers, file.read()

    def copied(self, *names):
        folder = tempfile.mkdtemp(dir=self.temporary.name)
        for name in names:
            shutil.copy(f"{self.runs}/msckf/seed_1/{name}", folder)
        return folder

    def test_numbers_are_those_of_the_summary(self):
        for run in ("thesis/seed_1", "msckf/seed_2"):
            with open(f"{self.runs}/{run}/summary.json") as file:
                summary = json.load(file)
            odometry, estimate = self.numbers(f"{self.runs}/{run}")[0]["trajectories"]
            for numbers, same in ((estimate, SAME), (odometry, SAME_OF_OBSERVER)):
                for key, name in same.items():
                    self.assertIsNotNone(summary[name], name)
                    self.assertAlmostEqual(look_up(numbers, key), summary[name], delta=1e-6 * max(1, abs(summary[name])), msg=f"{run} {name}")
            self.assertAlmostEqual(1 - estimate["nees"]["inside_3_sigma"], summary["outside_3_sigma"], places=12)

    def test_the_verdict_comes_first_and_of_several_seeds_the_table_tells(self):
        folder = self.copied("summary.json", "fused.tum", "odometry.tum", "truth.tum", "frames.csv")
        with open(f"{folder}/summary.json") as file:
            summary = json.load(file)
        page = self.page(folder)[1]
        self.assertLess(page.index(html.escape(summary["verdict"])), page.index("<table"))
        self.assertRegex(page, r"The covariance is .* \(NEES / 3\)\. Those of the fixes are .* \(NIS\)\.")
        told = summary.pop("verdict").partition("(RMSE).")[0]
        with open(f"{folder}/summary.json", "w") as file:  # as of the nodelets
            json.dump(summary, file)
        self.assertIn(f": {told}(RMSE).\n", self.numbers(folder)[1])
        self.assertNotIn("It helped", self.numbers(f"{self.runs}/msckf")[1])

    def test_a_flight_in_a_loaded_map_has_the_scale_of_the_map(self):
        folder = self.copied("summary.json", "fused.tum", "odometry.tum", "truth.tum")
        for found_s, is_known in ((None, True), (1.5, False)):
            with open(f"{folder}/summary.json") as file:
                summary = json.load(file)
            summary["map_found_s"] = found_s
            with open(f"{folder}/summary.json", "w") as file:
                json.dump(summary, file)
            estimate = self.numbers(folder)[0]["trajectories"][1]
            self.assertIsNotNone(estimate["ratio"])
            self.assertEqual(estimate["ratio_scale_removed"] is not None, is_known)

    def test_all_plots_are_drawn(self):
        page = self.page(f"{self.runs}/msckf/seed_1")[1]
        self.assertEqual(page.count("<img "), 12)
        self.assertNotIn("Left out", page)

    def test_seeds_and_estimators_stand_side_by_side(self):
        numbers, table = self.numbers(self.runs)
        self.assertEqual([row["name"] for row in numbers["trajectories"]],
                         ["odometry of msckf/seed_1", "msckf/seed_1", "thesis/seed_1",
                          "odometry of msckf/seed_2", "msckf/seed_2", "thesis/seed_2"])
        for line in ("median of 2: msckf", "worst of 2: thesis"):
            self.assertIn(line, table)

    def test_a_refined_path_has_a_row_of_its_own(self):
        folder = self.copied("summary.json", "fused.tum", "odometry.tum", "truth.tum", "frames.csv")
        shutil.copy(f"{folder}/truth.tum", f"{folder}/refined.tum")
        numbers, table = self.numbers(folder)
        refined = numbers["trajectories"][-1]
        self.assertTrue(refined["name"].endswith(", refined"))
        self.assertEqual(refined["estimator"], "refined")
        self.assertLess(refined["ate"]["none"]["rmse_m"], 1e-9)
        self.assertIsNone(refined["nees"])  # frames.csv is of the flight
        self.assertNotIn("median of", table)  # the two are no seeds of one estimator

    def test_what_lacks_is_left_out_and_told(self):
        numbers, page = self.page(self.copied("fused.tum", "odometry.tum", "frames.csv", "landmarks.csv"))
        self.assertIn("no truth, so no errors", numbers["notes"][0])
        self.assertIn("Left out: there is no truth.", page)
        self.assertIsNone(numbers["trajectories"][1]["ratio"])
        numbers, page = self.page(self.copied("fused.tum", "truth.tum"))
        self.assertIn("no odometry.tum", numbers["notes"][0])
        for reason in ("no run has landmarks", "frames.csv lacks landmark_candidates", "no covariance", "lacks fix_nis", "has no track_nis", "lacks stage times"):
            self.assertIn(reason, page)
        self.assertGreater(numbers["trajectories"][0]["ate"]["none"]["rmse_m"], 0)

    def test_the_truth_as_observer_has_no_ratio(self):
        folder = self.copied("fused.tum", "odometry.tum", "truth.tum")
        with open(f"{folder}/summary.json", "w") as file:
            json.dump({"profile": "truth"}, file)
        self.assertIsNone(self.numbers(folder)[0]["trajectories"][1]["ratio"])

    def test_damaged_files_are_named(self):
        for name, text, parts in (("frames.csv", "index,stamp_ns\n0,1\n0\n", ("frames.csv:3", "1 cells for 2 columns")),
                                  ("frames.csv", "index,stamp_ns\n0,x\n", ("frames.csv:2", "column stamp_ns")),
                                  ("frames.csv", "index,features\n0,1\n", ("frames.csv:1", "no column stamp_ns")),
                                  ("fused.tum", "# no pose\n", ("fused.tum", "holds no pose")),
                                  ("summary.json", "{\n  \"a\": ,\n}", ("summary.json:2", "no JSON")),
                                  ("truth.tum", "0 0 0\n", ("truth.tum:1", "8 are expected"))):
            folder = self.copied("fused.tum")
            with open(f"{folder}/{name}", "w") as file:
                file.write(text)
            code, _, fault = evaluate(folder, "--table")
            self.assertEqual(code, 2, fault)
            self.assertNotIn("Traceback", fault)
            for part in parts:
                self.assertIn(part, fault)

    def test_report_and_numbers_go_into_the_folder(self):
        folder = self.copied("fused.tum", "truth.tum", "frames.csv")
        code, out, _ = evaluate(folder)
        self.assertEqual(code, 0)
        for name in ("report.html", "evaluation.json"):
            self.assertTrue(os.path.exists(f"{folder}/{name}"))
            self.assertIn(f"{folder}/{name}", out)


if __name__ == "__main__":
    unittest.main()
