#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""odometry_mode navdata: the package's own observer of navdata and IMU, of the driver's own message type, too."""
import math
import os
import sys
import time
import unittest

import numpy as np
import rospy
import rostest
from ardrone_vslam.msg import Navdata, Status
from geometry_msgs.msg import TransformStamped
from nav_msgs.msg import Odometry
from rosgraph_msgs.msg import Log
from sensor_msgs.msg import Imu
from tf2_msgs.msg import TFMessage

sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from drone import Recorder, TIMEOUT_S  # noqa: E402

RATE_HZ = 200.0
SPEED_M_S = 1.0
DRAG_PER_S = 0.3  # the parameter's default
GRAVITY_M_S2 = 9.81
HEIGHT_M = 1.5
LEAN_RAD = math.atan(DRAG_PER_S * SPEED_M_S / GRAVITY_M_S2)  # forward, against the drag
BEGIN_S = 1000.0


class DriverNavdata(Navdata):
    """As ardrone_autonomy's: another name, the same fields and so the same MD5 sum."""
    _type = "ardrone_autonomy/Navdata"


class NavdataTest(unittest.TestCase):
    def setUp(self):
        rospy.init_node("navdata_test")
        self.navdata = rospy.Publisher("/navdata", DriverNavdata, queue_size=1000)
        self.imu = rospy.Publisher("/imu", Imu, queue_size=1000)
        self.odometry = Recorder("/observer_odometry", Odometry)
        self.status = Recorder("/status", Status)
        self.log = Recorder("/rosout", Log)
        self.tf = rospy.Publisher("/tf", TFMessage, queue_size=100)
        end_s = time.monotonic() + TIMEOUT_S
        while not (self.navdata.get_num_connections() and self.imu.get_num_connections()
                   and self.odometry.connected() and self.status.connected()):
            self.assertLess(time.monotonic(), end_s, "the mapper does not subscribe")
            time.sleep(0.05)

    def packet(self, i, floor_m=0.0):
        """Forward at a constant speed."""
        message = DriverNavdata()
        message.header.stamp = rospy.Time.from_sec(BEGIN_S + i / RATE_HZ)
        message.header.frame_id = "ardrone_base_link"
        message.state = 3
        message.rotY = math.degrees(LEAN_RAD)
        message.vx = 1000 * SPEED_M_S * math.cos(LEAN_RAD)
        message.altd = round(1000 * (HEIGHT_M - floor_m))
        imu = Imu()
        imu.header = message.header
        imu.linear_acceleration.x = -GRAVITY_M_S2 * math.sin(LEAN_RAD)
        imu.linear_acceleration.z = GRAVITY_M_S2 * math.cos(LEAN_RAD)
        imu.angular_velocity.z = 0.01
        return message, imu

    def send(self, numbers, floor_m=0.0):
        for i in numbers:
            navdata, imu = self.packet(i, floor_m)
            self.navdata.publish(navdata)
            self.imu.publish(imu)
            time.sleep(0.001)

    def send_drivers_tf(self, i):
        """The driver has an odom of its own."""
        transform = TransformStamped()
        transform.header.stamp = rospy.Time.from_sec(BEGIN_S + i / RATE_HZ)
        transform.header.frame_id, transform.child_frame_id = "odom", "ardrone_base_link"
        transform.transform.rotation.w = 1
        self.tf.publish(TFMessage([transform]))

    def at(self, i):
        odometry = self.odometry.wait(lambda o: o.header.stamp == self.packet(i)[0].header.stamp)
        self.assertIsNotNone(odometry, "no observer_odometry of packet %d" % i)
        return odometry

    def test_navdata(self):
        self.send_drivers_tf(0)
        self.send(range(400))
        bad, imu = self.packet(400)
        bad.vx = float("nan")
        self.navdata.publish(bad)
        imu.angular_velocity.x = float("inf")
        self.imu.publish(imu)
        self.send(range(400, 1000), floor_m=0.7)  # a table
        odometry = self.at(998)
        self.assertEqual((odometry.header.frame_id, odometry.child_frame_id), ("observer_odom", "ardrone_base_link"))
        position = odometry.pose.pose.position
        np.testing.assert_allclose([position.x, position.y, position.z],
                                   [SPEED_M_S * 998 / RATE_HZ, 0, HEIGHT_M], atol=0.05)
        self.assertAlmostEqual(odometry.twist.twist.linear.x, SPEED_M_S * math.cos(LEAN_RAD), delta=0.02)
        self.assertAlmostEqual(odometry.twist.twist.angular.z, 0.01)
        covariance = np.array(odometry.pose.covariance).reshape(6, 6)
        np.testing.assert_array_equal(covariance, covariance.T)
        self.assertGreater(np.linalg.eigvalsh(covariance).min(), 0)
        # One state a packet but for the refused one, and the last one, which waits for the next stamp.
        self.assertEqual([o.header.stamp for o in self.odometry.all()],
                         [self.packet(i)[0].header.stamp for i in range(999)])
        status = self.status.wait(lambda s: "table_step" in s.odometry_fault
                                  and s.odometry_fault_count[s.odometry_fault.index("table_step")] == 1
                                  and s.odometry_refused == 2)
        self.assertIsNotNone(status, "the status counts neither the table nor what was refused")
        # That the driver's tf has another odom is meant so. The mapper looks at it each second, before its status.
        seen = len(self.status.all())
        self.assertIsNotNone(self.status.wait(lambda s: len(self.status.all()) > seen + 1))
        self.assertFalse([m.msg for m in self.log.all() if "beside tf's tree" in m.msg])


if __name__ == "__main__":
    rostest.rosrun("ardrone_vslam", "navdata", NavdataTest)
