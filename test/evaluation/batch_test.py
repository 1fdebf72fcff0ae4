# SPDX-License-Identifier: BSD-3-Clause
"""scripts/evaluate_all: which jobs there are, what is done again, what counts as worse; and all of it once, on two seconds of flight."""

import json
import os
import shutil
import subprocess
import tempfile
import unittest

from paths import SOURCE

from ardrone_vslam_evaluation import baseline, batch, batch_jobs
from ardrone_vslam_evaluation.batch_results import harm, of_seeds
from ardrone_vslam_evaluation.batch_run import Programs, Task, fingerprint_of_folder, run_tasks
from ardrone_vslam_evaluation.faults import InputFault

PROGRAMS = os.path.dirname(os.environ.get("ARDRONE_VSLAM_REPLAY", ""))  # ctest sets it
TINY = [{"name": "tiny", "make_world": ["laps", "--rate", "20", "--seconds", "1.5"], "profiles": ["drone", "drone,hover@1"]}]


def row(sequence="laps", **numbers):
    return {"sequence": sequence, "profile": "drone", "estimator": "msckf", "seeds": "1:3", "frames": 600, "fused_rmse_m": 0.2,
            "ratio": 0.3, "ratio_scale_removed": 0.25, "nees": 1.0, "outside_3_sigma": 0.01, **numbers}


def compare(now, before, margin=baseline.MARGIN):
    return baseline.compare(now, {baseline.key_of(old): old for old in before}, margin)


class WithFolder(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = temporary.name

    def path(self, name):
        return os.path.join(self.folder, name)

    def write(self, name, text):
        os.makedirs(os.path.dirname(self.path(name)), exist_ok=True)
        with open(self.path(name), "w") as file:
            file.write(text)
        return self.path(name)

    def read(self, name):
        with open(self.path(name)) as file:
            return file.read()


class JobsTest(WithFolder):
    def test_are_sequences_times_profiles_times_estimators(self):
        sequences = [batch_jobs.Sequence("a", ("drone", "hover"), flight=("laps",)), batch_jobs.Sequence("b", ("wheel",), folder="/b")]
        names = [job.name() for job in batch_jobs.jobs_of(sequences)]
        self.assertEqual(names, ["a drone msckf", "a drone thesis", "a hover msckf", "a hover thesis", "b wheel msckf",
                                 "b wheel thesis"])
        jobs = batch_jobs.jobs_of(sequences, "2:4", ["a"], ["hover"], ["thesis"])
        self.assertEqual([(job.name(), job.seeds) for job in jobs], [("a hover thesis", "2:4")])

    def test_changes_are_run_with_the_first_profile_and_estimator(self):
        sequences = [batch_jobs.Sequence("a", ("drone", "hover"), flight=("laps",), changes=(("--mirror-world",), ("--world-scale", "10")))]
        names = [job.name() for job in batch_jobs.jobs_of(sequences) if job.options]
        self.assertEqual(names, ["a drone msckf --mirror-world", "a drone msckf --world-scale 10"])
        self.assertEqual([job.options for job in batch_jobs.jobs_of(sequences, only_profiles=["hover"])], [(), ()])
        self.assertEqual([job.options for job in batch_jobs.jobs_of(sequences, only_estimators=["thesis"])], [(), ()])

    def test_what_is_not_there_is_named(self):
        sequences = [batch_jobs.Sequence("a", ("drone",), flight=("laps",))]
        for arguments, part in (((["x"], None, None), "--sequences: there is no x; here are a"), ((None, ["x"], None), "here are drone"),
                                ((None, None, ["x"]), "here are msckf, thesis")):
            with self.assertRaisesRegex(InputFault, part):
                batch_jobs.jobs_of(sequences, "1:3", *arguments)
        with self.assertRaisesRegex(InputFault, "two sequences of that name"):
            batch_jobs.jobs_of(sequences * 2)

    def test_quick_ones_are_among_the_others(self):
        names = [sequence.name for sequence in batch_jobs.QUICK + batch_jobs.WHOLE_FLIGHTS]
        self.assertEqual(len(set(names)), len(names))
        self.assertEqual(len(batch_jobs.WHOLE_FLIGHTS), 12)

    def test_kitti_folders_with_a_truth_are_found(self):
        for name in ("00/image_0/0.png", "00/poses.txt", "11/image_0/0.png", "poses/00.txt"):
            self.write(f"kitti/{name}", "")
        self.assertEqual([s.folder for s in batch_jobs.kitti_sequences(self.path("kitti"))], [self.path("kitti/00")])
        self.assertEqual([s.folder for s in batch_jobs.kitti_sequences(self.path("kitti/00"))], [self.path("kitti/00")])
        with self.assertRaisesRegex(InputFault, "image_0"):
            batch_jobs.kitti_sequences(self.path("kitti/poses"))

    def test_a_selection_file_is_read_and_its_faults_named(self):
        good = self.write("good.json", json.dumps(TINY + [{"name": "mine", "folder": "data", "profiles": ["wheel"], "replay": ["--ping-pong"]}]))
        tiny, mine = batch_jobs.read_selection(good)
        self.assertEqual((tiny.flight[0], mine.folder, mine.replay), ("laps", self.path("data"), ("--ping-pong",)))
        below, = batch_jobs.read_selection(self.write("bag.json", json.dumps([dict(TINY[0], bag=True)])))
        self.assertEqual((tiny.output_in("/runs"), below.output_in("/runs")), ("/runs", "/runs/flight.bag"))
        for text in ("[", "{}", '[{"name": "a"}]', '[{"name": "a", "profiles": ["drone"]}]', "[1]"):
            with self.assertRaisesRegex(InputFault, "bad.json", msg=text):
                batch_jobs.read_selection(self.write("bad.json", text))


class ResumeTest(WithFolder):
    def task(self, name, key="1", code=0):
        command = ["sh", "-c", f'mkdir -p "$0"; echo x >> "$1"; exit {code}', self.path(f"work/{name}"), self.path(name)]
        return Task(name, self.path(f"work/{name}"), key, command)

    def run_all(self, *tasks, logins=()):
        os.makedirs(self.path("work"), exist_ok=True)
        return [task.name for task in run_tasks(list(tasks), "runs", self.path("work"), "2", list(logins))]

    def test_what_is_done_is_not_done_again(self):
        self.assertEqual(self.run_all(self.task("a"), self.task("b", code=1)), ["b"])
        self.assertEqual(self.run_all(self.task("a"), self.task("b")), [])
        self.assertEqual((self.read("a"), self.read("b")), ("x\n", "x\nx\n"))

    def test_another_key_does_it_again(self):
        self.run_all(self.task("a", key="1"))
        self.assertEqual(self.run_all(self.task("a", key="2", code=1)), ["a"])
        self.assertEqual(self.run_all(self.task("a", key="1")), [], "what failed counts as not done")
        self.assertEqual(self.read("a"), "x\nx\nx\n")

    def test_names_and_folders_may_hold_blanks_and_commas(self):
        self.assertEqual(self.run_all(self.task("a, b@1 'c' {} $d")), [])

    def test_other_machines_are_handed_on(self):
        self.assertEqual(self.run_all(self.task("a"), logins=["1/:"]), [])
        self.assertEqual(self.read("a"), "x\n")

    def test_a_number_before_a_machine_is_how_many_it_does_at_a_time(self):
        """mkdir fails where another is at work."""
        alone = ["sh", "-c", 'mkdir -p "$1" && mkdir "$0" && sleep 0.2 && rmdir "$0"', self.path("busy")]
        tasks = [Task(name, self.path(f"work/{name}"), "1", [*alone, self.path(f"work/{name}")]) for name in "abc"]
        os.makedirs(self.path("work"))
        jobs = batch.parser_of(SOURCE).get_default("jobs")
        self.assertEqual(run_tasks(tasks, "runs", self.path("work"), jobs, ["1/:"]), [])

    def test_a_folder_that_changed_has_another_fingerprint(self):
        self.write("data/times.txt", "0\n")
        before = fingerprint_of_folder(self.path("data"))
        self.assertEqual(before, fingerprint_of_folder(self.path("data")))
        self.write("data/times.txt", "0\n1\n")
        self.assertNotEqual(before, fingerprint_of_folder(self.path("data")))


class BaselineTest(WithFolder):
    def test_worse_and_better_by_more_than_the_margin_are_named(self):
        self.assertEqual(compare([row()], [row()]), ([], [], 1))
        self.assertEqual(compare([row(fused_rmse_m=0.224)], [row()]), ([], [], 1), "10 % and 5 mm are allowed")
        worse, better, _ = compare([row(fused_rmse_m=0.226, ratio=0.2)], [row()])
        self.assertEqual(worse, ["laps drone msckf: fused RMSE [m] 0.200 -> 0.226"])
        self.assertEqual(better, ["laps drone msckf: fused / odometry 0.300 -> 0.200"])
        self.assertEqual(len(compare([row(ratio=0.36)], [row()], margin=0.2)[0]), 0)
        self.assertEqual(len(compare([row(ratio=0.38)], [row()], margin=0.2)[0]), 1)
        self.assertEqual(compare([row(nees=1.5, outside_3_sigma=0.04)], [row()])[0],
                         ["laps drone msckf: NEES / 3 1.000 -> 1.500", "laps drone msckf: outside 3 sigma 0.010 -> 0.040"])

    def test_lost_frames_and_numbers_are_worse(self):
        self.assertEqual(compare([row(frames=599)], [row()])[0], ["laps drone msckf: frames 600 -> 599"])
        self.assertEqual(compare([row(ratio=None)], [row()])[0], ["laps drone msckf: fused / odometry 0.300 -> none"])
        self.assertEqual(compare([row(ratio=0.5)], [row(ratio=None)])[0], [])

    def test_rows_that_nothing_holds_are_a_failure_where_all_must_be_held(self):
        before = {baseline.key_of(row()): row()}
        self.assertTrue(batch.judge([row()], before, baseline.MARGIN, must_have=True))
        self.assertFalse(batch.judge([row(), row("hover")], before, baseline.MARGIN, must_have=True))
        self.assertTrue(batch.judge([row(), row("hover")], before, baseline.MARGIN, must_have=False))

    def test_rows_of_other_seeds_or_sequences_are_not_compared(self):
        self.assertEqual(compare([row(seeds="1:5", ratio=9), row("hover", ratio=9)], [row()]), ([], [], 0))

    def test_what_is_written_is_read(self):
        path = self.write("baseline.json", baseline.as_json([row(ratio=1 / 3), row("hover", ratio=None)]))
        rows = baseline.read(path)
        self.assertEqual([r["ratio"] for r in rows.values()], [0.333333, None])
        self.assertEqual(self.read("baseline.json").count("\n"), 4, "one row a line")
        for text in ("", "{}", '{"rows": [{"sequence": "laps"}]}'):
            with self.assertRaisesRegex(InputFault, "is no baseline"):
                baseline.read(self.write("bad.json", text))

    def test_harm_to_the_odometry_is_named(self):
        rows = [row(ratio_scale_removed_worst=1.049), row("hover", ratio_scale_removed_worst=None)]
        self.assertIn("No seed of any row", harm(rows))
        self.assertIn("which is a defect:\n- street drone msckf (1.117)\n", harm(rows + [row("street", ratio_scale_removed_worst=1.117)]))

    def test_a_number_that_one_seed_lacks_is_not_shown(self):
        self.assertEqual(of_seeds([{"ratio": 1.0}, {"ratio": 3.0}], "ratio", max), 3)
        self.assertIsNone(of_seeds([{"ratio": 1.0}, {"ratio": None}], "ratio", max))
        self.assertIsNone(of_seeds([], "ratio", max))


class WholeTest(WithFolder):
    def evaluate_all(self, *arguments):
        done = subprocess.run([os.path.join(SOURCE, "scripts", "evaluate_all"), "--programs", PROGRAMS, "--work", self.path("work"), "--selection",
                               self.write("selection.json", json.dumps(TINY)), "--seeds", "1:2", "--jobs", "2", *arguments],
                              capture_output=True, text=True, check=False)
        return done.returncode, done.stdout, done.stderr

    def test_table_is_the_same_again_and_a_regression_is_told(self):
        code, _, fault = self.evaluate_all("--baseline", self.write("empty.json", '{"rows": []}'))
        self.assertEqual(code, 0, fault)
        first = self.read("work/results.md")
        self.assertIn("| tiny | 30 | drone,hover@1 | thesis | 1:2 | 0.", first)
        self.assertNotRegex(first, r"\bms\b")
        self.assertIn("ms an image", self.read("work/times.md"))

        shutil.rmtree(self.path("work/runs/tiny/drone"))
        with open(self.path("work/sequences/tiny/key")) as file:
            key = file.read()
        code, _, fault = self.evaluate_all("--baseline", self.path("empty.json"))
        self.assertIn("0 sequences to render to do, 1 done before", fault)
        self.assertIn("2 runs to do, 2 done before", fault)
        self.assertEqual(self.read("work/results.md"), first, "byte for byte")
        self.assertEqual(self.read("work/sequences/tiny/key"), key)

        better = row("tiny", seeds="1:2", frames=30, fused_rmse_m=1e-4, ratio=1e-4, ratio_scale_removed=1e-4)
        code, out, fault = self.evaluate_all("--baseline", self.write("better.json", baseline.as_json([better])))
        self.assertEqual(code, 1)
        self.assertIn("1 of 4 rows; 3 numbers worse", out)
        self.assertIn("worse: tiny drone msckf: fused / odometry 0.000 -> 0.", fault)

    def test_a_run_that_fails_is_named_and_the_others_are_in_the_table(self):
        os.makedirs(self.path("programs"))
        os.symlink(f"{PROGRAMS}/make_world", self.path("programs/make_world"))
        self.write("programs/replay", f'#!/bin/sh\ncase "$*" in *thesis*) echo broken; exit 1;; esac\nexec {PROGRAMS}/replay "$@"\n')
        os.chmod(self.path("programs/replay"), 0o755)
        code, out, fault = self.evaluate_all("--baseline", self.write("empty.json", '{"rows": []}'), "--programs", self.path("programs"))
        self.assertEqual(code, 1)
        self.assertIn("evaluate_all: tiny drone thesis: failed, see", fault)
        self.assertEqual(self.read("work/runs/tiny/drone/thesis.log"), "broken\n")
        self.assertIn("| tiny | 30 | drone | msckf |", out)
        self.assertNotIn("| thesis |", out)

    def test_wrong_usage_is_told_before_any_work(self):
        empty = self.write("empty.json", '{"rows": []}')
        for arguments, part in ((("--seeds", "3:1"), "must be A:B"), (("--sequences", "x"), "there is no x; here are tiny"),
                                (("--baseline", self.path("none.json")), "cannot be read"), (("--margin", "-1"), "at least 0"),
                                (("--baseline", empty, "--programs", self.folder), "there is no such program"),
                                (("--update", "--sequences", "tiny"), "no part of a selection"),
                                (("--update", "--quick"), "no part of a selection")):
            code, _, fault = self.evaluate_all(*arguments)
            self.assertEqual(code, 2, fault)
            self.assertIn(part, fault)
            self.assertNotIn("Traceback", fault)
        self.assertFalse(os.path.exists(self.path("work/runs")))

    def test_programs_whose_code_changed_have_another_fingerprint(self):
        one = Programs(PROGRAMS, f"{SOURCE}/config")
        shutil.copytree(f"{SOURCE}/config", self.path("config"))
        self.assertEqual(one.of_replay, Programs(PROGRAMS, self.path("config")).of_replay)
        self.write("config/kitti.yaml", "mapper: {}\n")
        self.assertNotEqual(one.of_replay, Programs(PROGRAMS, self.path("config")).of_replay)
        self.assertEqual(one.fingerprint_of_flight(("laps", "--seconds", "9")), one.fingerprint_of_flight(("laps", "--seconds", "9")))
        self.assertNotEqual(one.fingerprint_of_flight(("laps", "--seconds", "9")), one.fingerprint_of_flight(("laps", "--seconds", "8")))


if __name__ == "__main__":
    unittest.main()
