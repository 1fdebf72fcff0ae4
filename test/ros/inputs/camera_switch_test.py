#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Two cameras that take turns on one topic, as the AR.Drone's togglecam has it: one map, one pose;
a camera without calibration or mounting is named and the other one goes on."""
import os
import sys
import time
import unittest

import rospy
import rostest

sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from drone import STEP_M, TIMEOUT_S, Drone  # noqa: E402

LEFT_PX = 60  # of the second camera from the first one, on the wall


class CameraSwitchTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        rospy.init_node("camera_switch_test")
        cls.drone = Drone()
        cls.drone.connect()
        cls.drone.mount_camera()
        cls.drone.mount_camera(camera="left_optical", left_px=LEFT_PX)

    def use(self, camera, left_px):
        self.drone.camera, self.drone.camera_left_px = camera, left_px

    def fly(self, images):
        """@return the last status"""
        steps = self.drone.steps
        for i, pose in enumerate(self.drone.fly(images)):
            self.assertIsNotNone(pose)
            self.assertLess(abs(pose.pose.pose.position.y - (steps + i + 1) * STEP_M), 0.06)
        stamp = self.drone.stamp()
        return self.drone.status.wait(lambda status: status.header.stamp == stamp)

    def refused(self, topic, *parts):
        """The log must name it."""
        def names(entry):
            return topic in entry.msg and all(part in entry.msg for part in parts)
        self.assertIsNotNone(self.drone.log.wait(names), "nothing in the log says " + ", ".join(parts))

    def test_1_the_map_goes_on(self):
        before = self.fly(25)
        self.assertGreater(before.landmarks, 20)
        self.use("left_optical", LEFT_PX)
        there = self.fly(25)
        self.assertEqual(there.camera_changes, 1)
        self.assertGreaterEqual(there.landmarks, before.landmarks)
        # Back at once, so that what the left camera sees is what the right one saw.
        self.use("camera_optical", 0)
        back = self.fly(25)
        self.assertEqual((back.camera_changes, back.restarts), (2, 0))
        self.assertGreaterEqual(back.landmarks, there.landmarks)
        self.assertEqual(back.images, 75)

    def test_2_a_camera_without_calibration_is_named_and_the_other_goes_on(self):
        self.use("left_optical", LEFT_PX)
        before = len(self.drone.pose.all())
        self.drone.next()
        info = self.drone.info()
        info.K = [0] * 9
        self.drone.send(self.drone.odometry(), self.drone.image(), info)
        self.refused("/camera/camera_info", "camera left_optical", "uncalibrated", "camera_calibration")
        self.assertEqual(len(self.drone.pose.all()), before)
        self.use("camera_optical", 0)
        self.assertEqual(self.fly(3).restarts, 0)

    def test_3_a_camera_without_mounting_is_named_and_the_other_goes_on(self):
        self.use("nowhere_optical", 0)
        waiting, end_s = None, time.monotonic() + TIMEOUT_S
        while waiting is None and time.monotonic() < end_s:
            self.drone.next()
            self.drone.send(self.drone.odometry(), self.drone.image(), self.drone.info())
            waiting = self.drone.status.wait(lambda s: s.state_name == "waiting_for_extrinsics", 0.2)
        self.assertIsNotNone(waiting)
        self.assertIn("nowhere_optical", waiting.reason)
        self.use("camera_optical", 0)
        status = self.fly(3)
        self.assertGreater(status.dropped_no_extrinsics, 0)
        self.assertEqual(status.restarts, 0)


if __name__ == "__main__":
    rostest.rosrun("ardrone_vslam", "camera_switch", CameraSwitchTest)
