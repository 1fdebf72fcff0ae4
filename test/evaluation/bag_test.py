# SPDX-License-Identifier: BSD-3-Clause
"""Trajectories in bags."""

import json
import os
import tempfile
import unittest

import numpy as np
import rosbag
import rospy
from geometry_msgs.msg import PoseStamped, PoseWithCovarianceStamped
from nav_msgs.msg import Odometry
from std_msgs.msg import String

from paths import evaluate, quaternion, winding


def message_of(kind, trajectory, i, position, variance):
    message = kind()
    message.header.stamp = rospy.Time(nsecs=int(trajectory.stamps_ns[i])) + rospy.Duration(1700000000)
    pose = message.pose if kind is PoseStamped else message.pose.pose
    pose.position.x, pose.position.y, pose.position.z = position
    q = quaternion(trajectory.rotations[i])
    pose.orientation.x, pose.orientation.y, pose.orientation.z, pose.orientation.w = q
    if kind is not PoseStamped:
        message.pose.covariance = (np.diag([variance] * 3 + [0.0] * 3)).ravel().tolist()
    return message


class BagTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder, self.truth = folder.name, winding(300)

    def bag(self, name, topics, noise_m=0.0, variance=0.0):
        """topics: {name: type}. Returns the path."""
        path, random = os.path.join(self.folder, name), np.random.default_rng(3)
        positions = self.truth.positions_m + random.normal(0, 1, self.truth.positions_m.shape) * noise_m
        with rosbag.Bag(path, "w") as bag:
            bag.write("/chatter", String("no pose"), rospy.Time(1))
            for topic, kind in topics.items():
                for i in range(len(self.truth)):
                    message = message_of(kind, self.truth, i, positions[i], variance)
                    bag.write(topic, message, message.header.stamp)
        return path

    def numbers(self, *arguments):
        target = os.path.join(self.folder, "numbers.json")
        code, out, fault = evaluate(*arguments, "--json", target)
        self.assertEqual(code, 0, out + fault)
        with open(target) as file:
            return json.load(file)["trajectories"][-1]

    def test_each_type_is_read(self):
        truth = self.bag("truth.bag", {"/truth": PoseStamped})
        for kind in (Odometry, PoseStamped, PoseWithCovarianceStamped):
            estimate = self.bag("estimate.bag", {"/estimate": kind}, 0.1, 0.01)
            row = self.numbers("--truth", truth, "--estimate", estimate, "--align", "none")
            self.assertEqual(row["matched"], 300)
            self.assertAlmostEqual(row["ate"]["none"]["rmse_m"], 0.1 * np.sqrt(3), delta=0.02)
            if kind is PoseStamped:
                self.assertIsNone(row["nees"])
            else:
                self.assertAlmostEqual(row["nees"]["mean"], 3, delta=0.5)

    def test_unknown_covariances_give_no_nees(self):
        truth = self.bag("truth.bag", {"/truth": PoseStamped})
        for variance in (0.0, -1.0):
            estimate = self.bag("estimate.bag", {"/estimate": Odometry}, 0.1, variance)
            self.assertIsNone(self.numbers("--truth", truth, "--estimate", estimate)["nees"])

    def test_one_bag_for_both_and_the_choice_of_topics(self):
        bag = self.bag("both.bag", {"/truth/pose": PoseStamped, "/vslam/pose": PoseWithCovarianceStamped, "/odometry": Odometry})
        row = self.numbers("--truth", bag, "--estimate", bag)
        self.assertIn("/vslam/pose", row["file"])
        self.assertIn("/odometry", self.numbers("--truth", bag, "--estimate", bag, "--estimate-topic", "/odometry")["file"])
        row = self.numbers("--truth", bag, "--estimate", bag, "--odometry", bag, "--odometry-topic", "/odometry")
        self.assertIsNone(row["ratio"])  # the odometry has no error

    def test_topics_are_asked_for_by_name(self):
        bag = self.bag("two.bag", {"/a": Odometry, "/b": PoseStamped})
        for arguments, parts in ((("--truth", bag, "--estimate", bag), ("which topic", "--truth-topic", "/a, /b")),
                                 (("--truth", bag, "--estimate", bag, "--truth-topic", "/c"), ("--truth-topic /c", "/a, /b"))):
            code, _, fault = evaluate(*arguments)
            self.assertEqual(code, 2, fault)
            for part in parts:
                self.assertIn(part, fault)

    def test_damaged_bags_are_named(self):
        truth = self.bag("truth.bag", {"/truth": PoseStamped})
        with open(truth, "rb") as file:
            data = file.read()
        bad = os.path.join(self.folder, "bad.bag")
        for part in (data[:len(data) // 2], b"no bag\n", b""):
            with open(bad, "wb") as file:
                file.write(part)
            code, _, fault = evaluate("--truth", truth, "--estimate", bad)
            self.assertEqual(code, 2, fault)
            self.assertIn(bad, fault)
            self.assertNotIn("Traceback", fault)


if __name__ == "__main__":
    unittest.main()
