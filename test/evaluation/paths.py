# SPDX-License-Identifier: BSD-3-Clause
"""Trajectories that are known exactly, the command as users call it, and a folder for what tests make."""

import dataclasses
import os
import subprocess
import tempfile
import unittest

import numpy as np

from ardrone_vslam_evaluation.trajectory import NS_PER_S, Trajectory, rotations_of_vectors

SOURCE = os.path.normpath(os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", ".."))


class TestWithFolder(unittest.TestCase):
    """All tests of a class share a folder that goes with them."""

    @classmethod
    def setUpClass(cls):
        cls.temporary = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.temporary.cleanup)

    @classmethod
    def path(cls, name):
        return os.path.join(cls.temporary.name, name)


def stamps_ns(count, rate_hz=10, start_s=0):
    return np.arange(count, dtype=np.int64) * (NS_PER_S // rate_hz) + start_s * NS_PER_S


def straight(length_m, count, heading=(1.0, 0.0, 0.0)):
    """Evenly along a line, without turning."""
    positions = np.linspace(0, length_m, count)[:, None] * np.array(heading)
    return Trajectory("straight", stamps_ns(count), positions, np.tile(np.eye(3), (count, 1, 1)))


def winding(count, seed=1):
    """A smooth path that turns in all directions; no length of it is a round number."""
    random = np.random.default_rng(seed)
    turns = np.cumsum(random.normal(0, 0.03, (count, 3)), axis=0)
    rotations = rotations_of_vectors(turns)
    positions = np.cumsum(rotations @ np.array([0.4973, 0.0, 0.0]), axis=0)
    return Trajectory("winding", stamps_ns(count), positions, rotations)


def there_and_back(count):
    """The same path forward and then backward."""
    path = winding(count // 2)
    both = path.at(np.concatenate([np.arange(len(path)), np.arange(len(path))[::-1]]))
    return dataclasses.replace(both, stamps_ns=stamps_ns(len(both)))


def quaternion(rotation):
    """x y z w; not for turns by 180 degrees."""
    w = 0.5 * np.sqrt(max(0.0, 1 + np.trace(rotation)))
    return np.array([rotation[2, 1] - rotation[1, 2], rotation[0, 2] - rotation[2, 0], rotation[1, 0] - rotation[0, 1], 4 * w * w]) / (4 * w)


def write_tum(path, trajectory):
    with open(path, "w") as file:
        file.write("# timestamp[s] tx ty tz[m] qx qy qz qw\n")
        for stamp, position, rotation in zip(trajectory.stamps_ns, trajectory.positions_m, trajectory.rotations):
            values = " ".join(f"{value:.9f}" for value in (*position, *quaternion(rotation)))
            file.write(f"{stamp // NS_PER_S}.{stamp % NS_PER_S:09d} {values}\n")
    return str(path)


def write_kitti(path, trajectory):
    with open(path, "w") as file:
        for position, rotation in zip(trajectory.positions_m, trajectory.rotations):
            file.write(" ".join(f"{value:.9e}" for value in np.column_stack([rotation, position]).ravel()) + "\n")
    return str(path)


def evaluate(*arguments):
    """scripts/evaluate: exit code, standard output, standard error."""
    command = ["/usr/bin/python3", os.path.join(SOURCE, "scripts", "evaluate"), *map(str, arguments)]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    return done.returncode, done.stdout, done.stderr
