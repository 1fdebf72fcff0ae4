#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""use_attitude: without attitude the tracker says so and goes on; with it no image is without."""
import os
import sys
import unittest

import rospy
import rostest
from ardrone_vslam.msg import Features
from diagnostic_msgs.msg import DiagnosticArray
from nav_msgs.msg import Odometry

sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from drone import Drone, Recorder  # noqa: E402

WITHOUT, WITH = 3, 20
MOST_LATE = 10


def images_without(array):
    values = [int(v.value) for s in array.status for v in s.values if v.key == "images without attitude"]
    return values[0] if values else None


def share_old(features):
    return sum(age > 0 for age in features.age) / len(features.age)


class Attitude(unittest.TestCase):
    def test_attitude(self):
        rospy.init_node("attitude_test")
        drone = Drone()
        diagnostics = Recorder("/diagnostics", DiagnosticArray)
        features = Recorder("/vslam/features", Features)
        attitude = rospy.Publisher("/attitude", Odometry, queue_size=100)
        drone.connect()
        drone.mount_camera()
        self.assertEqual(len(drone.fly(WITHOUT)), WITHOUT)
        warning = drone.log.wait(lambda m: "no attitude" in m.msg and "/attitude" in m.msg)
        self.assertIsNotNone(warning)
        self.assertIsNotNone(diagnostics.wait(lambda a: images_without(a) == WITHOUT))

        # When the image was exposed, half a period before its stamp, the drone was rolled by a quarter of a turn, the image
        # is as before: the pattern turns.
        flight = []
        for _ in range(MOST_LATE + WITH):
            stamp = drone.next()
            message = drone.odometry()
            message.header.stamp -= rospy.Duration(0, 50000000)
            message.pose.pose.orientation.x = message.pose.pose.orientation.w = 0.5 ** 0.5
            attitude.publish(message)
            attitude.publish(drone.odometry())
            flight.append((stamp, drone.odometry(), drone.image(), drone.info()))
        # The tracker does not wait for the attitude: on a slow machine the first images come before it.
        late = 0
        for i, (stamp, *messages) in enumerate(flight):
            drone.send(*messages)
            self.assertIsNotNone(drone.answered(stamp))
            if share_old(features.wait(lambda m, stamp=stamp: m.header.stamp == stamp)) > 0.2 and i == late < MOST_LATE:
                late += 1
            if i == late + WITH - 1:
                break
        seen = len(diagnostics.all())
        self.assertIsNotNone(diagnostics.wait(
            lambda a: a in diagnostics.all()[seen:] and images_without(a) is not None))
        self.assertEqual(images_without([a for a in diagnostics.all() if images_without(a) is not None][-1]), WITHOUT + late)
        # The first image described the other way finds hardly a track again; the later ones do.
        old = [share_old(m) for m in features.all()]
        self.assertEqual(len(old), WITHOUT + late + WITH)
        self.assertGreater(old[WITHOUT + late - 1], 0.5)
        self.assertLess(old[WITHOUT + late], 0.2)
        self.assertGreater(old[-1], 0.5)


if __name__ == "__main__":
    rostest.rosrun("ardrone_vslam", "attitude", Attitude)
