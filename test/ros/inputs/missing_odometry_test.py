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
    def keep_sending(self, drone, with_odometry, until):
        """Sends images until a status fulfils the condition. @return it, or None"""
        end_s = time.monotonic() + TIMEOUT_S
        while time.monotonic() < end_s:
            drone.next()
            if with_odometry:
                drone.send(drone.odometry())
            drone.send(drone.image(), drone.info())
            found = drone.status.wait(until, 0.1)
            if found:
                return found
        return None

    def test_each_is_named(self):
        rospy.init_node("missing_odometry_test")
        drone = Drone()
        diagnostics = Recorder("/diagnostics", DiagnosticArray)
        drone.connect()

        status = drone.status.wait(lambda s: s.state == Status.WAITING_FOR_FEATURES)
        self.assertIsNotNone(status)
        self.assertIn("/vslam/features", status.reason)
        self.assertIn("tracker", status.reason)

        status = self.keep_sending(
            drone, False, lambda s: s.state == Status.WAITING_FOR_ODOMETRY and
            s.dropped_no_odometry > 0)
        self.assertIsNotNone(status)
        self.assertEqual(status.state_name, "waiting_for_odometry")
        self.assertIn("no odometry has come on /odometry", status.reason)
        self.assertIn("remap", status.reason)
        self.assertEqual(status.images, 0)

        def is_error(array):
            return any("mapper" in s.name and s.level == DiagnosticStatus.ERROR and
                       "no odometry" in s.message for s in array.status)
        self.assertIsNotNone(diagnostics.wait(is_error))

        status = self.keep_sending(
            drone, True, lambda s: s.state == Status.WAITING_FOR_EXTRINSICS and
            s.dropped_no_extrinsics > 0)
        self.assertIsNotNone(status)
        self.assertIn("base_link to camera_optical", status.reason)
        self.assertIn("static_transform_publisher", status.reason)
        self.assertEqual(status.images, 0)

        drone.mount_camera(forward_m=1e300)
        status = self.keep_sending(drone, True, lambda s: "beyond 100 m" in s.reason)
        self.assertIsNotNone(status)
        self.assertEqual(status.state, Status.WAITING_FOR_EXTRINSICS)
        self.assertIn("base_link to camera_optical", status.reason)
        self.assertEqual(status.images, 0)

        drone.mount_camera()
        self.assertIsNotNone(self.keep_sending(drone, True, lambda s: s.images > 0))
        self.assertIsNotNone(drone.fly(1)[0])

        def is_well(array):
            return any("mapper" in s.name and s.level == DiagnosticStatus.OK for s in array.status)
        self.assertIsNotNone(self.keep_sending(drone, True, lambda _: any(
            is_well(array) for array in diagnostics.all())))

        for _ in range(25):  # 2.5 s by its stamps, as if in millimetres
            drone.next()
            odometry = drone.odometry()
            odometry.pose.pose.position.x = 300 * odometry.header.stamp.to_sec()
            drone.send(odometry)

        def is_told(array):
            return any("mapper" in s.name and s.level == DiagnosticStatus.WARN and
                       any(v.key == "odometry speed" and "metres are expected" in v.value for v in s.values)
                       for s in array.status)
        self.assertIsNotNone(diagnostics.wait(is_told))
        self.assertIsNotNone(drone.log.wait(lambda log: "/odometry moves at 300 m/s" in log.msg))

        # tf has a prefix that the odometry lacks, and the driver sends it in a burst.
        tf = rospy.Publisher("/tf", TFMessage, queue_size=10, latch=True)
        transform = TransformStamped()
        transform.header.stamp = drone.stamp()
        transform.header.frame_id, transform.child_frame_id = "drone1/odom", "base_link"
        transform.transform.rotation.w = 1.0
        tf.publish(TFMessage([transform] * 6))
        self.assertIsNotNone(drone.log.wait(lambda log: "set tf_prefix to drone1" in log.msg))

        def is_counted(array):
            return any(v.key == "tf transforms with a stamp that was there" and v.value == "5"
                       for s in array.status for v in s.values)
        self.assertIsNotNone(diagnostics.wait(is_counted))


if __name__ == "__main__":
    rostest.rosrun("ardrone_vslam", "missing_odometry", MissingOdometry)
