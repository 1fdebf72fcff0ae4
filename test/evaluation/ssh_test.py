# SPDX-License-Identifier: BSD-3-Clause
"""scripts/evaluate_all --sshlogin by real ssh: two sshd of the test's own on the loopback."""

import csv
import io
import json
import os
import subprocess
import unittest

from batch_test import PROGRAMS, TINY, WithFolder
from own_sshd import SSHD, Logins, free_port
from paths import SOURCE

# What is measured by a clock, and memory. Logs hold the progress in images a second, joblogs and times.md nothing but times.
MEASURED = {"ms_per_frame_median", "ms_per_frame_p95", "ms_per_frame_max", "frames_per_second", "stage_share", "peak_rss_mb"}
TIMES = (".log", ".joblog", "times.md")


def without_measured(value):
    if isinstance(value, dict):
        return {key: without_measured(inner) for key, inner in value.items() if key not in MEASURED}
    return [without_measured(inner) for inner in value] if isinstance(value, list) else value


def comparable(path):
    with open(path, "rb") as file:
        data = file.read()
    if path.endswith("summary.json"):
        return json.dumps(without_measured(json.loads(data)))
    if path.endswith("frames.csv"):
        rows = list(csv.DictReader(io.StringIO(data.decode())))
        return [{name: value for name, value in row.items() if not name.startswith("ms_")} for row in rows]
    return data


def results_in(folder):
    """Path to content."""
    paths = [os.path.join(parent, name) for parent, _, names in os.walk(folder) for name in names if not name.endswith(TIMES)]
    return {os.path.relpath(path, folder): comparable(path) for path in paths}


@unittest.skipUnless(SSHD, "there is no sshd here; scripts/install_dependencies --with-ssh installs it")
class SshTest(WithFolder):
    def setUp(self):
        super().setUp()
        os.mkdir(self.path("ssh"))
        self.logins = Logins(self, self.path("ssh"), "one", "two")

    def evaluate_all(self, *arguments, folder="/"):
        """From another folder than where ssh arrives."""
        command = [f"{SOURCE}/scripts/evaluate_all", "--programs", PROGRAMS, "--work", self.path("work"), "--selection",
                   self.write("selection.json", json.dumps(TINY)), "--seeds", "1:2", "--baseline", self.write("empty.json", '{"rows": []}')]
        done = subprocess.run([*command, *arguments], capture_output=True, text=True, check=False, cwd=folder,
                              env=dict(os.environ, PARALLEL_SSH=self.logins.command, PARALLEL_HOME=self.path("parallel")))
        return done.returncode, done.stderr

    def machines(self, joblog):
        return {line.split("\t")[1] for line in self.read(f"work/{joblog}.joblog").splitlines()[1:]}

    def test_results_are_those_of_this_machine_byte_for_byte(self):
        self.assertEqual(self.evaluate_all("--jobs", "2")[0], 0)
        os.rename(self.path("work"), self.path("here"))
        # Relative to where it is called, which is not where ssh arrives.
        code, fault = self.evaluate_all("--work", "work", "--sshlogin", "1/one", "--sshlogin", "1/two", folder=self.folder)
        self.assertEqual(code, 0, fault)
        self.assertEqual(self.machines("runs"), {"one", "two"})
        here, there = results_in(self.path("here")), results_in(self.path("work"))
        self.assertEqual(sorted(here), sorted(there))
        self.assertEqual([path for path in here if here[path] != there[path]], [])
        print(f"{len(here)} files are equal")  # -v tells
        # What both did is done for this machine too.
        self.assertIn("0 runs to do, 4 done before", self.evaluate_all()[1])

    def test_a_machine_that_does_not_answer_leaves_its_jobs_to_the_other(self):
        self.logins.add_host("gone", free_port())
        code, fault = self.evaluate_all("--sshlogin", "1/one", "--sshlogin", "1/gone")
        self.assertEqual(code, 0, fault)
        self.assertEqual(self.machines("runs"), {"one"})

    def test_where_none_answers_ssh_tells_why_and_no_log_is_named(self):
        self.logins.add_host("gone", free_port())
        code, fault = self.evaluate_all("--sshlogin", "1/gone")
        self.assertEqual(code, 1)
        self.assertIn("Connection refused", fault)
        self.assertIn("rendered tiny: left no ", fault)
        self.assertNotIn("failed, see", fault)


if __name__ == "__main__":
    unittest.main()
