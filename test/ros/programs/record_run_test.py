#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""record_run writes as it goes: killed or interrupted, it leaves what it had, and says so."""
import json
import os
import signal
import subprocess
import tempfile
import time
import unittest

import rosbag
import rospkg
import rospy
import rostest
from geometry_msgs.msg import PoseStamped
from sensor_msgs.msg import Image

from ardrone_vslam.msg import PoseCorrection

TIMEOUT_S = 40.0
IMAGES = 50  # of which POSES are answered
POSES = 20


def stamp(number):
    return rospy.Time(100, number * 50_000_000)


def write_bag(path):
    with rosbag.Bag(path, "w") as bag:
        for number in range(IMAGES):
            image, truth = Image(), PoseStamped()
            image.header.stamp = truth.header.stamp = stamp(number)
            truth.pose.position.x, truth.pose.orientation.w = 0.1 * number, 1
            bag.write("/camera/image_raw", image, stamp(number))
            bag.write("/truth/pose", truth, stamp(number))


def correction(number):
    message = PoseCorrection()
    message.header.stamp, message.header.frame_id, message.child_frame_id = stamp(number), "map", "base"
    for pose, error_m in ((message.observer_pose, 0.5), (message.fused_pose.pose, 0.1)):
        pose.position.x, pose.position.y, pose.orientation.w = 0.1 * number, error_m, 1
    message.fused_pose.covariance = [0.01 * (row == column) for row in range(6) for column in range(6)]
    return message


class RecordRun(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        rospy.init_node("record_run_test")
        cls.publisher = rospy.Publisher("/vslam/correction", PoseCorrection, queue_size=100)
        cls.script = os.path.join(rospkg.RosPack().get_path("ardrone_vslam"), "scripts", "record_run")

    def setUp(self):
        self.temporary = tempfile.TemporaryDirectory()
        self.addCleanup(self.temporary.cleanup)
        self.run_folder = os.path.join(self.temporary.name, "run")
        bag = os.path.join(self.temporary.name, "flight.bag")
        write_bag(bag)
        self.recorder = subprocess.Popen([self.script, "--bag", bag, "--out", self.run_folder, "--patience", "60"],
                                         stderr=subprocess.PIPE, text=True)
        self.addCleanup(self.recorder.stderr.close)
        self.addCleanup(self.recorder.kill)
        self.wait_for(lambda: self.publisher.get_num_connections() > 0)
        for number in range(POSES):
            self.publisher.publish(correction(number))

    def wait_for(self, is_there):
        end_s = time.monotonic() + TIMEOUT_S
        while not is_there():
            self.assertIsNone(self.recorder.poll(), "record_run has ended")
            self.assertLess(time.monotonic(), end_s)
            time.sleep(0.05)

    def summary(self):
        try:
            with open(os.path.join(self.run_folder, "summary.json"), encoding="utf-8") as file:
                return json.load(file)
        except FileNotFoundError:
            return {}

    def test_killed_it_leaves_what_it_had(self):
        self.wait_for(lambda: self.summary().get("frames") == POSES)
        self.recorder.kill()
        self.recorder.wait(TIMEOUT_S)
        summary = self.summary()
        self.assertIs(summary["is_finished"], False)
        self.assertEqual(summary["images_without_pose"], 0)  # those to come are none
        self.assertAlmostEqual(summary["fused_ate_rmse_m"], 0.1, places=6)
        with open(os.path.join(self.run_folder, "fused.tum"), encoding="utf-8") as file:
            self.assertEqual(len(file.readlines()), POSES)

    def test_interrupted_it_writes_all_and_says_so(self):
        self.wait_for(lambda: self.summary().get("frames") == POSES)
        os.remove(os.path.join(self.run_folder, "summary.json"))
        self.recorder.send_signal(signal.SIGINT)
        self.assertEqual(self.recorder.wait(TIMEOUT_S), 1)
        told = self.recorder.stderr.read()
        self.assertIn(f"interrupted; {self.run_folder} has what was recorded", told)
        self.assertNotIn("Traceback", told)
        self.assertEqual((self.summary()["frames"], self.summary()["is_finished"]), (POSES, False))


if __name__ == "__main__":
    rostest.rosrun("ardrone_vslam", "recording", RecordRun)
