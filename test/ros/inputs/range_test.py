#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""use_range, use_navdata_height: without a height that can be used the mapper says so in log and
diagnostics, and counts; with heights in a climb it finds the odometry's scale."""
import os
import sys
import time
import unittest

import rospy
import rostest
from ardrone_vslam.msg import Navdata
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus
from sensor_msgs.msg import Range

sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from drone import TIMEOUT_S, Drone, Recorder  # noqa: E402

SCALE_ERROR = 0.04  # the odometry reports ways so much too long
CLIMB_M = 0.2  # between two images, as reported: fast, or it might be an error of velocity
# Images of the climb are so much further apart: a height counts for 0.1 s around it, and one that
# comes late would leave its image the height before.
LATER_S = 0.02


class RangeTest(unittest.TestCase):
    def setUp(self):
        rospy.init_node("range_test")
        self.drone = Drone()
        self.diagnostics = Recorder("/diagnostics", DiagnosticArray)
        self.of_navdata = rospy.get_param("/vslam/mapper/use_navdata_height", False)
        self.topic = "/ardrone/navdata" if self.of_navdata else "/range"
        self.what = "altitude" if self.of_navdata else "range"
        self.parameter = "use_navdata_height" if self.of_navdata else "use_range"
        self.ranges = rospy.Publisher(self.topic, Navdata if self.of_navdata else Range, queue_size=100)
        self.drone.connect()
        self.drone.mount_camera()

    def send_range(self, range_m):
        message = Navdata() if self.of_navdata else Range()
        message.header.stamp = self.drone.stamp()
        if self.of_navdata:
            message.altd = round(range_m * 1000)
        else:
            message.min_range, message.max_range, message.range = 0.2, 6.0, range_m
        self.ranges.publish(message)

    def slide(self, range_m=None):
        """One more image of the wall. @return its status"""
        stamp = self.drone.next()
        return self.send(stamp, self.drone.odometry(), self.drone.image(), range_m)

    def climb(self, height_m, range_m):
        """One more image, of nothing: only odometry and range tell of the climb. @return its status"""
        self.drone.time_s += LATER_S
        stamp = self.drone.next()
        odometry, image = self.drone.odometry(), self.drone.image()
        odometry.pose.pose.position.y, odometry.pose.pose.position.z = self.left_m, height_m
        image.data = bytes([128]) * len(image.data)
        return self.send(stamp, odometry, image, range_m)

    def send(self, stamp, odometry, image, range_m):
        if range_m:
            self.send_range(range_m)
        self.drone.send(odometry, image, self.drone.info())
        self.assertIsNotNone(self.drone.answered(stamp))
        return self.drone.status.wait(lambda s: s.header.stamp == stamp)

    def climb_measured(self, height_m, range_m):
        """Images until one has its height: the mapper does not wait for it. @return its status"""
        missing = self.drone.status.all()[-1].heights_missing
        for _ in range(20):
            status = self.climb(height_m, range_m)
            if status.heights_missing == missing:
                return status
            missing = status.heights_missing
        self.fail("no height reaches the mapper before its image")

    def mapper_says(self, condition, send_image):
        """Sends images until the mapper's diagnostics fulfil the condition. @return the last image's status"""
        seen = len(self.diagnostics.all())
        end_s = time.monotonic() + TIMEOUT_S
        while time.monotonic() < end_s:
            status = send_image()
            time.sleep(0.1)
            for s in [s for array in self.diagnostics.all()[seen:] for s in array.status if "mapper" in s.name]:
                values = {v.key: v.value for v in s.values}
                if condition(s, values):
                    return status
        self.fail("the mapper does not say so in the diagnostics; its status is\n%s" % status)

    def test_range(self):
        status = self.mapper_says(
            lambda s, values: s.level == DiagnosticStatus.WARN and int(values["images without a height"]) > 0
            and self.topic + ": no " + self.what + " has come" in values.get(self.what, "")
            and self.parameter + " to false" in values[self.what],
            self.slide)
        self.assertEqual(status.heights_missing, status.images)
        self.assertIsNotNone(self.drone.log.wait(lambda m: m.msg.startswith("%s: no %s has come" % (self.topic, self.what))))

        status = self.mapper_says(lambda s, values: "no %s could be used yet" % self.what in values.get(self.what, ""),
                                  lambda: self.slide(9.0))
        self.assertGreater(status.ranges_refused, 0)
        self.assertEqual(status.heights_missing, status.images)

        prior = status.scale_deviation
        self.left_m = self.drone.position_m()
        for i in range(24):
            higher_m = CLIMB_M * i
            status = self.climb_measured(higher_m, 0.5 + higher_m / (1 + SCALE_ERROR))
        self.assertEqual(status.heights_rejected, 0)
        self.assertLess(status.scale_deviation, 0.7 * prior)
        self.assertAlmostEqual(status.scale_error, SCALE_ERROR, delta=3 * status.scale_deviation)
        self.assertGreater(status.scale_error, SCALE_ERROR / 4)

        self.mapper_says(lambda s, values: self.what not in values,
                         lambda: self.climb(higher_m, 0.5 + higher_m / (1 + SCALE_ERROR)))


if __name__ == "__main__":
    rostest.rosrun("ardrone_vslam", "range", RangeTest)
