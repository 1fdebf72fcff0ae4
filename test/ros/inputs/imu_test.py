#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""odometry_mode imu: the odometry's displacements along the attitude of an IMU that is mounted upside down."""
import math
import os
import sys
import time
import unittest

import numpy as np
import rospy
import rostest
from ardrone_vslam.msg import Status
from geometry_msgs.msg import TransformStamped
from nav_msgs.msg import Odometry
from rosgraph_msgs.msg import Log
from sensor_msgs.msg import Imu
from tf2_msgs.msg import TFMessage

sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from drone import Recorder, TIMEOUT_S  # noqa: E402

RATE_HZ = 50.0
SPEED_M_S = 1.0
TURN_RAD_S = 0.5  # which the odometry does not see
HEADING_RAD = 2.0  # in the IMU's world, at the start
BEGIN_S = 1000.0
LAST = 200


class ImuTest(unittest.TestCase):
    def setUp(self):
        rospy.init_node("imu_test")
        self.log = Recorder("/rosout", Log)
        self.odometry = Recorder("/observer_odometry", Odometry)
        self.status = Recorder("/status", Status)
        self.odometry_pub = rospy.Publisher("/odometry", Odometry, queue_size=1000)
        self.imu_pub = rospy.Publisher("/imu", Imu, queue_size=1000)
        self.tf_pub = rospy.Publisher("/tf_static", TFMessage, queue_size=10, latch=True)
        end_s = time.monotonic() + TIMEOUT_S
        while not (self.odometry_pub.get_num_connections() and self.imu_pub.get_num_connections()
                   and self.odometry.connected() and self.status.connected()):
            self.assertLess(time.monotonic(), end_s, "the mapper does not subscribe")
            time.sleep(0.05)

    def send(self, i, has_orientation=True):
        odometry = Odometry()
        odometry.header.stamp = rospy.Time.from_sec(BEGIN_S + i / RATE_HZ)
        odometry.header.frame_id, odometry.child_frame_id = "odom", "base_footprint"
        odometry.pose.pose.position.x = SPEED_M_S * i / RATE_HZ
        odometry.pose.pose.orientation.w = 1
        imu = Imu()
        imu.header.stamp = odometry.header.stamp
        imu.header.frame_id = "imu_link"
        half_rad = (HEADING_RAD + TURN_RAD_S * i / RATE_HZ) / 2
        # About z by the heading, then about x by 180 degrees.
        imu.orientation.x, imu.orientation.y = math.cos(half_rad), math.sin(half_rad)
        if not has_orientation:
            imu.orientation_covariance[0] = -1
        self.odometry_pub.publish(odometry)
        self.imu_pub.publish(imu)
        time.sleep(0.002)

    def mount(self):
        transform = TransformStamped()
        transform.header.frame_id, transform.child_frame_id = "base_footprint", "imu_link"
        transform.transform.rotation.x = 1  # upside down
        self.tf_pub.publish(TFMessage([transform]))

    def warned(self, words):
        self.assertIsNotNone(self.log.wait(lambda m: words in m.msg), "no warning of '%s'" % words)

    def test_imu(self):
        self.send(-3)
        self.send(-2)  # the base's name is known
        self.warned("no transform from base_footprint to imu_link")
        self.mount()
        time.sleep(0.5)
        self.send(-1, has_orientation=False)
        self.warned("it has no orientation")
        for i in range(LAST + 1):
            self.send(i)
        odometry = self.odometry.wait(lambda o: o.header.stamp == rospy.Time.from_sec(BEGIN_S + LAST / RATE_HZ))
        self.assertIsNotNone(odometry, "no observer_odometry of the last message")
        self.assertEqual((odometry.header.frame_id, odometry.child_frame_id), ("odom", "base_footprint"))
        turn_rad = TURN_RAD_S * LAST / RATE_HZ
        radius_m = SPEED_M_S / TURN_RAD_S
        position = odometry.pose.pose.position
        # A circle to the left, where the odometry drove straight on.
        np.testing.assert_allclose([position.x, position.y, position.z],
                                   [radius_m * math.sin(turn_rad), radius_m * (1 - math.cos(turn_rad)), 0], atol=1e-3)
        yaw_rad = 2 * math.atan2(odometry.pose.pose.orientation.z, odometry.pose.pose.orientation.w)
        self.assertAlmostEqual(yaw_rad, turn_rad, delta=1e-6)
        self.assertEqual(len(self.odometry.all()), LAST + 1)
        self.assertIsNotNone(self.status.wait(lambda s: s.odometry_refused >= 3), "what was refused is not counted")


if __name__ == "__main__":
    rostest.rosrun("ardrone_vslam", "imu", ImuTest)
