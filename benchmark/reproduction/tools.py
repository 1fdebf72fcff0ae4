# SPDX-License-Identifier: BSD-3-Clause
"""The programs that measure, and what they left."""

import json
import os
import subprocess

from ardrone_vslam_evaluation.faults import MachineFault
from ardrone_vslam_evaluation.run_folder import read_run

# The thesis's localisation alone: the corrections of the package's own that docs/thesis_estimator.md names are off.
AS_PRINTED = ("mapper/as_printed=true", "mapper/min_landmarks=1")


class Tools:
    def __init__(self, programs, measurements, out, quick, kitti):
        self.programs, self.measurements, self.out, self.quick = programs, measurements, out, quick
        self.data = os.environ.get("ARDRONE_VSLAM_DATA") or None
        self.kitti = kitti or (os.path.join(self.data, "kitti_03") if self.data else None)
        self.log = os.path.join(out, "reproduce.log")
        os.makedirs(out, exist_ok=True)

    def _run(self, *command):
        with open(self.log, "a", encoding="utf-8") as log:
            log.write("$ " + " ".join(command) + "\n")
            log.flush()
            if subprocess.run(command, stdout=log, stderr=subprocess.STDOUT).returncode != 0:
                raise MachineFault(f"{os.path.basename(command[0])} failed; the end of {self.log} says why")

    def measure(self, section):
        """What thesis_measurements measures, as its JSON file says it."""
        self._run(self.measurements, section, "--out", self.out, *(["--quick"] if self.quick else []))
        with open(os.path.join(self.out, section + ".json"), encoding="utf-8") as file:
            return json.load(file)

    def make_world(self, name, flight, *options):
        """A rendered flight, made once. @return its folder"""
        folder = os.path.join(self.out, "worlds", name)
        self._run(os.path.join(self.programs, "make_world"), flight, "--odometry-profile", "truth", "--force", "--out", folder, *options)
        return folder

    def replay(self, name, sequence, *options, settings=()):
        """On whole pixels, as the thesis's tracker. @return the run's folder"""
        folder = os.path.join(self.out, "runs", name)
        self._run(os.path.join(self.programs, "replay"), sequence, "--whole-pixels", "--out", folder, *options, *self._settings(settings))
        return folder

    def replay_seeds(self, name, seeds, sequence, *options):
        """With the odometry's noise of seeds 1 to `seeds`, for which the images are tracked once. @return the runs' folders"""
        folder = self.replay(name, sequence, "--seeds", f"1:{seeds}", *options)
        return [os.path.join(folder, f"seed_{seed}") for seed in range(1, seeds + 1)]

    def simulate_landmarks(self, name, path, *options, settings=()):
        folder = os.path.join(self.out, "runs", name)
        self._run(os.path.join(self.programs, "simulate_landmarks"), path, "--out", folder, *options, *self._settings(settings))
        return folder

    @staticmethod
    def _settings(settings):
        return [word for setting in settings for word in ("--set", setting)]

    @staticmethod
    def read(folder):
        return read_run(folder)
