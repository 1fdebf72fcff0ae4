#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""What is missing is said by name, with the remedy, in `status` and in the diagnostics: first the
features, then the odometry, then the camera's mounting; once all is there, poses come. Odometry that
is not in metres, or in a frame that tf does not have above the base, is said, too."""
import os
import sys
import time
import unittest

import rospy
import rostest
from ardrone_vslam.msg import Status
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus
from geometry_msgs.msg import TransformStamped
from tf2_msgs.msg import TFMessage

sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from drone import TIMEOUT_S, Drone, Recorder  # noqa: E402


class MissingOdometry(unittest.TestCase):
    """The tests are one flight, in the order of their numbers."""

    @classmethod
    def setUpClass(cls):
        rospy.init_node("missing_odometry_test")
        cls.drone = Drone()
        cls.diagnostics = Recorder("/diagnostics", DiagnosticArray)
        cls.drone.connect()

    def keep_sending(self, with_odometry, until):
        """Sends images until a status fulfils the condition. @return it"""
        end_s = time.monotonic() + TIMEOUT_S
        while time.monotonic() < end_s:
            self.drone.next()
            if with_odometry:
                self.drone.send(self.drone.odometry())
            self.drone.send(self.drone.image(), self.drone.info())
            found = self.drone.status.wait(until, 0.1)
            if found:
                return found
        self.fail("no such status came")

    def expect_diagnosis(self, level, told):
        """Waits for one of the mapper's of this level that fulfils the condition."""
        self.assertIsNotNone(self.diagnostics.wait(lambda array: any(
            "mapper" in s.name and s.level == level and told(s) for s in array.status)))

    def expect_log(self, text):
        self.assertIsNotNone(self.drone.log.wait(lambda log: text in log.msg))

    def test_1_features(self):
        status = self.drone.status.wait(lambda s: s.state == Status.WAITING_FOR_FEATURES)
        self.assertIsNotNone(status)
        self.assertIn("/vslam/features", status.reason)
        self.assertIn("tracker", status.reason)

    def test_2_odometry(self):
        status = self.keep_sending(
            False, lambda s: s.state == Status.WAITING_FOR_ODOMETRY and s.dropped_no_odometry > 0)
        self.assertEqual(status.state_name, "waiting_for_odometry")
        self.assertIn("no odometry has come on /odometry", status.reason)
        self.assertIn("remap", status.reason)
        self.assertEqual(status.images, 0)
        self.expect_diagnosis(DiagnosticStatus.ERROR, lambda s: "no odometry" in s.message)

    def test_3_extrinsics(self):
        status = self.keep_sending(
            True, lambda s: s.state == Status.WAITING_FOR_EXTRINSICS and s.dropped_no_extrinsics > 0)
        self.assertIn("base_link to camera_optical", status.reason)
        self.assertIn("static_transform_publisher", status.reason)
        self.assertEqual(status.images, 0)

        self.drone.mount_camera(forward_m=1e300)
        status = self.keep_sending(True, lambda s: "beyond 100 m" in s.reason)
        self.assertEqual(status.state, Status.WAITING_FOR_EXTRINSICS)
        self.assertIn("base_link to camera_optical", status.reason)
        self.assertEqual(status.images, 0)

    def test_4_all_is_there(self):
        self.drone.mount_camera()
        self.keep_sending(True, lambda s: s.images > 0)
        self.assertIsNotNone(self.drone.fly(1)[0])
        self.keep_sending(True, lambda _: any(
            "mapper" in s.name and s.level == DiagnosticStatus.OK
            for array in self.diagnostics.all() for s in array.status))

    def test_5_odometry_in_millimetres(self):
        for _ in range(25):  # 2.5 s by its stamps
            self.drone.next()
            odometry = self.drone.odometry()
            odometry.pose.pose.position.x = 300 * odometry.header.stamp.to_sec()
            self.drone.send(odometry)
        self.expect_diagnosis(DiagnosticStatus.WARN, lambda s: any(
            v.key == "odometry speed" and "metres are expected" in v.value for v in s.values))
        self.expect_log("/odometry moves at 300 m/s")

    def test_6_prefix_of_tf(self):
        """tf has a prefix that the odometry lacks, and the driver sends it in a burst."""
        tf = rospy.Publisher("/tf", TFMessage, queue_size=10, latch=True)
        transform = TransformStamped()
        transform.header.stamp = self.drone.stamp()
        transform.header.frame_id, transform.child_frame_id = "drone1/odom", "base_link"
        transform.transform.rotation.w = 1.0
        tf.publish(TFMessage([transform] * 6))
        self.expect_log("set tf_prefix to drone1")
        self.assertIsNotNone(self.diagnostics.wait(lambda array: any(
            v.key == "tf transforms with a stamp that was there" and v.value == "5"
            for s in array.status for v in s.values)))


if __name__ == "__main__":
    rostest.rosrun("ardrone_vslam", "missing_odometry", MissingOdometry)
