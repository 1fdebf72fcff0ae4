# SPDX-License-Identifier: BSD-3-Clause
"""Rendered flights that are carried elsewhere in their room with the camera covered, and go on there."""
import csv
import os
import shutil

import matplotlib.image
import numpy as np

BEFORE_S, COVERED_S, AFTER_S = 22, 2, 10
DRIFT_M = 0.05  # of the odometry, while it is covered, along x and y
FOUND_M = 0.3  # from the truth


def yaw_of(quaternion):
    x, y, z, w = quaternion
    return np.arctan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z))


def turned(quaternions, yaw_rad):
    """Each about the vertical, before all else. n x 4, x y z w."""
    x, y, z, w = quaternions.T
    s, c = np.sin(yaw_rad / 2), np.cos(yaw_rad / 2)
    return np.stack([c * x - s * y, c * y + s * x, c * z + s * w, c * w - s * z], axis=1)


def carried_odometry(first, second, first_truth, covered_stamps_s):
    """The position drifts while it is carried, as rotors and camera tell nothing; gyroscopes tell the heading, with the error so far.
    Tables of stamp, position, quaternion."""
    yaw_error_rad = yaw_of(first[-1, 4:]) - yaw_of(first_truth[-1, 4:])
    after = second.copy()
    after[:, 4:] = turned(second[:, 4:], yaw_error_rad)
    s, c = np.sin(yaw_error_rad), np.cos(yaw_error_rad)
    way = (second[:, 1:4] - second[0, 1:4]) @ np.array([[c, s, 0], [-s, c, 0], [0, 0, 1]])
    drift_m = DRIFT_M * np.linspace(0, 1, len(covered_stamps_s) + 1)[1:, None] * np.array([1, 1, 0])
    after[:, 1:4] = first[-1, 1:4] + drift_m[-1] + way
    turn_rad = (yaw_of(after[0, 4:]) - yaw_of(first[-1, 4:]) + np.pi) % (2 * np.pi) - np.pi
    covered = np.repeat(first[-1:], len(covered_stamps_s), axis=0)
    for i, row in enumerate(covered):
        row[4:] = turned(row[None, 4:], turn_rad * (i + 1) / (len(covered) + 1))[0]
    covered[:, 0] = covered_stamps_s
    covered[:, 1:4] += drift_m
    return np.vstack([first, covered, after])


class Carried:
    def __init__(self, campaign, world, room, rate_hz):
        self.campaign, self.world, self.room, self.rate_hz = campaign, world, room, rate_hz

    def try_carry(self, name, starts, seed):
        """From the first flight's end to the second one's start. found_s: after it is uncovered; None: it is not found."""
        folder, run = self.campaign.path(name), self.campaign.path(name + "_run")
        parts = [self.fly(f"{name}_{part}", seconds, seed + 1000 * part, start)
                 for part, (seconds, start) in enumerate(zip((BEFORE_S, AFTER_S), starts))]
        self.join(folder, *parts)
        self.campaign.must("replay", folder, "--out", run)
        with open(os.path.join(run, "frames.csv"), encoding="utf-8") as file:
            errors_m = [float(row["fused_error_m"] or "nan") for row in csv.DictReader(file)][(BEFORE_S + COVERED_S) * self.rate_hz:]
        for path in (folder, run):
            shutil.rmtree(path)
        far = [i for i, error_m in enumerate(errors_m) if not error_m < FOUND_M]
        is_found = errors_m[-1] < FOUND_M
        return {"found_s": (far[-1] + 1 if far else 0) / self.rate_hz if is_found else None, "error_m": errors_m[-1]}

    def fly(self, name, seconds, seed, start):
        """@return the folder, and tables of the truth's and the odometry's poses"""
        self.campaign.render(name, self.world, self.room, seconds, seed, start)
        folder, run = self.campaign.path(name), self.campaign.path(name + "_run")
        self.campaign.must("replay", folder, "--odometry-profile", "drone", "--seed", seed, "--out", run)
        odometry = np.loadtxt(os.path.join(run, "odometry.tum"))
        shutil.rmtree(run)
        return folder, np.loadtxt(os.path.join(folder, "poses_tum.txt")), odometry

    def join(self, folder, first, second):
        shutil.rmtree(folder, ignore_errors=True)
        os.makedirs(os.path.join(folder, "image"))
        shutil.copy(os.path.join(first[0], "camera.yaml"), folder)
        period_s = 1 / self.rate_hz
        covered_s = first[1][-1, 0] + period_s * np.arange(1, COVERED_S * self.rate_hz + 1)
        later_s = covered_s[-1] + period_s - second[1][0, 0]
        for table in second[1:]:
            table[:, 0] += later_s
        covered_truth = np.repeat(first[1][-1:], len(covered_s), axis=0)
        covered_truth[:, 0] = covered_s
        truth = np.vstack([first[1], covered_truth, second[1]])
        odometry = carried_odometry(first[2], second[2], self.base(first[1]), covered_s)
        for name, table in (("poses_tum", truth), ("odometry_tum", odometry)):
            np.savetxt(os.path.join(folder, name + ".txt"), table, fmt="%.9f")
        np.savetxt(os.path.join(folder, "times.txt"), truth[:, :1], fmt="%.9f")
        images = [sorted(os.scandir(os.path.join(part[0], "image")), key=lambda entry: entry.name) for part in (first, second)]
        dark = os.path.join(folder, "dark.png")
        height, width = matplotlib.image.imread(images[0][0].path).shape[:2]
        matplotlib.image.imsave(dark, np.zeros((height, width, 3)))
        for number, path in enumerate([*images[0], *[dark] * len(covered_s), *images[1]]):
            os.link(path, os.path.join(folder, "image", "%06d.png" % number))
        os.remove(dark)
        for part in (first, second):
            shutil.rmtree(part[0])

    @staticmethod
    def base(camera_poses):
        """Of an optical frame that looks along x of base: base's attitude."""
        x, y, z, w = camera_poses[:, 4:].T
        # q_world_cam * q_cam_base, the latter turns z to x and -y to z: (0.5, -0.5, 0.5, 0.5)
        a, b, c, d = 0.5, -0.5, 0.5, 0.5
        table = camera_poses.copy()
        table[:, 4:] = np.stack([w * a + x * d + y * c - z * b, w * b - x * c + y * d + z * a, w * c + x * b - y * a + z * d,
                                 w * d - x * a - y * b - z * c], axis=1)
        return table
