#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""The standalone odometry_fusion node, given what must not be: it says what is wrong, counts it, and goes on
as if nothing had been.

Odometry and corrections come on two connections, so that the node may take in the one's messages before earlier ones of
the other. Where the order matters, the tests wait until the node has told what it took in."""
import math
import os
import sys
import time
import unittest

import rospy
import rostest
from ardrone_vslam.msg import PoseCorrection
from diagnostic_msgs.msg import DiagnosticArray
from nav_msgs.msg import Odometry, Path
from rosgraph_msgs.msg import Log

sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from drone import Recorder, TIMEOUT_S  # noqa: E402

NAN = float("nan")
PERIOD_S = 0.1
SPEED_M_S = 1.0


class Faults(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        rospy.init_node("odometry_fusion_faults_test")
        cls.odometry_pub = rospy.Publisher("/odometry", Odometry, queue_size=100)
        cls.correction_pub = rospy.Publisher("/correction", PoseCorrection, queue_size=100)
        cls.live = Recorder("/odometry_live", Odometry)
        cls.log = Recorder("/rosout", Log)
        cls.diagnostics = Recorder("/diagnostics", DiagnosticArray)
        cls.used = Recorder("/repropagated", Path)  # one for each correction that is used, with its stamp
        end_s = time.monotonic() + TIMEOUT_S
        while not (cls.odometry_pub.get_num_connections() and cls.correction_pub.get_num_connections()
                   and cls.live.connected() and cls.diagnostics.connected() and cls.used.connected()):
            if time.monotonic() > end_s:
                raise RuntimeError("the node does not subscribe")
            time.sleep(0.05)
        cls.first_s = cls.time_s = 10000.0
        cls.restarts = -1  # the first run is none

    def setUp(self):
        """A new run: time goes back, and only a second of odometry is known."""
        self.begin_anew()
        self.wait_counted("restarts", self.restarts)
        time.sleep(0.25)  # sentences that come closer upon each other are not all logged

    def begin_anew(self):
        """@return the stamps of the first second"""
        cls = type(self)
        cls.restarts += 1
        cls.first_s -= 100.0
        cls.time_s = cls.first_s
        return [self.step() for _ in range(10)]

    def stamp(self, time_s):
        return rospy.Time.from_sec(round(time_s, 3))

    def odometry(self):
        message = Odometry()
        message.header.stamp = self.stamp(self.time_s)
        message.header.frame_id, message.child_frame_id = "odom", "base_link"
        message.pose.pose.position.x = SPEED_M_S * (self.time_s - self.first_s)
        message.pose.pose.orientation.w = 1.0
        return message

    def step(self, change=None):
        """Sends the next odometry. @return its stamp"""
        type(self).time_s += PERIOD_S
        message = self.odometry()
        if change:
            change(message)
        self.odometry_pub.publish(message)
        return message.header.stamp

    def correction(self, age_s, left_m=0.0):
        """Of an image of age_s ago: base was left_m further to the left."""
        message = PoseCorrection()
        message.header.stamp = self.stamp(self.time_s - age_s)
        message.header.frame_id, message.child_frame_id = "map", "base_link"
        for pose in [message.observer_pose, message.fused_pose.pose]:
            pose.position.x = SPEED_M_S * (self.time_s - age_s - self.first_s)
            pose.orientation.w = 1.0
        message.fused_pose.pose.position.y = left_m
        message.fused_pose.covariance = [0.01 * (i % 7 == 0) for i in range(36)]
        return message

    def answer(self, stamp, timeout_s=TIMEOUT_S):
        return self.live.wait(lambda o: o.header.stamp == stamp, timeout_s)

    def counted(self, key):
        """As the next diagnostics tell it."""
        seen = len(self.diagnostics.all())
        end_s = time.monotonic() + TIMEOUT_S
        while time.monotonic() < end_s:
            for array in self.diagnostics.all()[seen:]:
                for status in array.status:
                    values = {v.key: v.value for v in status.values}
                    if key in values:
                        return int(values[key])
            time.sleep(0.02)
        self.fail("no diagnostics")

    def wait_counted(self, key, expected):
        end_s = time.monotonic() + TIMEOUT_S
        while time.monotonic() < end_s:
            if self.counted(key) == expected:
                return
        self.fail("%s is %d, not %d" % (key, self.counted(key), expected))

    def correct(self, message):
        """Sends it, and odometry once it is in use."""
        self.correction_pub.publish(message)
        self.await_used(message)

    def await_used(self, correction):
        self.assertIsNotNone(self.used.wait(lambda path: path.header.stamp == correction.header.stamp), "the correction is not used")
        self.assertTrue(self.is_left(self.answer(self.step()), correction.fused_pose.pose.position.y))

    def is_left(self, answer, left_m):
        """Of the newest odometry's answer."""
        self.assertIsNotNone(answer, "no answer to the odometry")
        self.assertAlmostEqual(answer.pose.pose.position.x, SPEED_M_S * (self.time_s - self.first_s), 6)
        self.assertTrue(all(math.isfinite(n) for n in answer.pose.covariance))
        return abs(answer.pose.pose.position.y - left_m) < 1e-9

    def fly_until(self, left_m):
        """For as long as the node keeps odometry."""
        if not any(self.is_left(self.answer(self.step()), left_m) for _ in range(20)):
            self.fail("no odometry %g m to the left" % left_m)

    def send_ahead(self, *corrections):
        """Of odometry to come; waits until the node has them: it counts a last one that it refuses."""
        before = self.counted("corrections refused")
        last = self.correction(0)
        last.fused_pose.pose.orientation.w = 0
        for message in [*corrections, last]:
            self.correction_pub.publish(message)
        self.wait_counted("corrections refused", before + 1)

    def assert_said(self, *parts):
        said = self.log.wait(lambda log: all(part in log.msg for part in parts))
        self.assertIsNotNone(said, "nothing in the log with %s" % (parts,))

    def refuse(self, message, *said):
        """It is not used, but counted and named; what was in use stays."""
        self.correct(self.correction(0.05, 0.25))
        before = self.counted("corrections refused")
        self.correction_pub.publish(message())
        self.assert_said("/correction: message not used", *said)
        self.wait_counted("corrections refused", before + 1)
        answer = self.answer(self.step())
        self.assertAlmostEqual(answer.pose.pose.position.y, 0.25)
        self.correct(self.correction(0.05, 0.5))

    def test_nothing_before_the_first_correction(self):
        stamps = [self.step() for _ in range(5)]
        first = self.correction(-0.15, 1.0)
        self.correction_pub.publish(first)
        stamps.append(self.step())
        self.step()
        self.await_used(first)
        self.assertFalse({o.header.stamp for o in self.live.all()} & set(stamps))

    def test_it_says_that_no_correction_comes(self):
        end_s = time.monotonic() + TIMEOUT_S
        while time.monotonic() < end_s and not any("no correction on /correction yet" in log.msg for log in self.log.all()):
            self.step()
            time.sleep(0.1)
        self.assert_said("no correction on /correction yet")

    def test_it_says_that_no_odometry_comes(self):
        self.assert_said("no odometry on /odometry")

    def test_a_correction_before_its_odometry_waits(self):
        self.correct(self.correction(0.05, 0.25))
        self.send_ahead(self.correction(-0.15, 0.75))
        self.assertTrue(self.is_left(self.answer(self.step()), 0.25))
        self.fly_until(0.75)

    def test_a_correction_that_was_overtaken_leaves_those_that_wait(self):
        self.correct(self.correction(0.05, 0.25))
        self.send_ahead(self.correction(-0.65, 0.75), self.correction(-0.35, 0.5))
        self.fly_until(0.5)
        self.fly_until(0.75)

    def test_a_correction_of_a_mapper_that_began_anew_voids_those_that_wait(self):
        self.correct(self.correction(0.05, 0.25))
        self.send_ahead(self.correction(-1.65, 0.75), self.correction(-0.35, 0.5))
        self.fly_until(0.5)
        for _ in range(20):
            stamp = self.step()
        self.assertAlmostEqual(self.answer(stamp).pose.pose.position.y, 0.5)

    def test_a_correction_older_than_the_buffer(self):
        self.correct(self.correction(0.05, 0.25))
        for _ in range(39):
            self.step()
        self.assertIsNotNone(self.answer(self.step()))
        before = self.counted("of them older than the buffer")
        self.correction_pub.publish(self.correction(3.0))
        self.assert_said("older than the newest odometry", "odometry_buffer_s")
        self.wait_counted("of them older than the buffer", before + 1)
        self.correct(self.correction(1.5, 0.5))

    def test_a_correction_that_does_not_ascend(self):
        self.refuse(lambda: self.correction(1.0), "not after that of the correction in use")

    def test_a_correction_for_another_base(self):
        def change():
            message = self.correction(0.05)
            message.child_frame_id = "other_base"
            return message
        self.refuse(change, "'other_base'", "base_frame")

    def test_a_correction_for_another_map(self):
        def change():
            message = self.correction(0.05)
            message.header.frame_id = "other_map"
            return message
        self.refuse(change, "'other_map'", "map_frame")

    def test_a_correction_of_another_odometry(self):
        def change():
            message = self.correction(0.05)
            message.observer_pose.position.z = 3
            return message
        self.refuse(change, "observer_pose is not where /odometry was")

    def test_a_correction_that_is_not_finite(self):
        def position():
            message = self.correction(0.05)
            message.fused_pose.pose.position.y = NAN
            return message
        self.refuse(position, "fused_pose: its position is not finite")

        def covariance():
            message = self.correction(0.05)
            message.fused_pose.covariance = [NAN] * 36
            return message
        self.refuse(covariance, "it is not finite")

    def test_a_correction_without_orientation_or_stamp(self):
        def orientation():
            message = self.correction(0.05)
            message.observer_pose.orientation.w = 0
            return message
        self.refuse(orientation, "observer_pose: its orientation has norm 0")

        def stamp():
            message = self.correction(0.05)
            message.header.stamp = rospy.Time()
            return message
        self.refuse(stamp, "its stamp is zero")

    def test_odometry_that_is_not_finite(self):
        self.correct(self.correction(0.05, 0.25))
        before = self.counted("odometry messages refused")

        def change(message):
            message.pose.pose.position.z = NAN
        refused = self.step(change)
        self.assert_said("/odometry: message not used", "position is not finite")
        self.wait_counted("odometry messages refused", before + 1)
        self.assertAlmostEqual(self.answer(self.step()).pose.pose.position.y, 0.25)
        self.assertNotIn(refused, [o.header.stamp for o in self.live.all()])

    def test_odometry_that_goes_back_a_little(self):
        self.correct(self.correction(0.05, 0.25))
        before = self.counted("odometry messages refused")

        def change(message):
            message.header.stamp -= rospy.Duration(0.3)
        self.step(change)
        self.assert_said("/odometry: message not used", "stamps must ascend")
        self.wait_counted("odometry messages refused", before + 1)
        self.assertAlmostEqual(self.answer(self.step()).pose.pose.position.y, 0.25)

    def test_time_that_begins_again(self):
        self.correct(self.correction(0.05, 0.25))
        before = self.counted("restarts")
        said_before = sum("jumped back" in log.msg for log in self.log.all())
        stamps = self.begin_anew()
        self.wait_counted("restarts", before + 1)
        self.assert_said("/odometry jumped back")
        self.assertEqual(sum("jumped back" in log.msg for log in self.log.all()), said_before + 1)
        self.correct(self.correction(0.05, 0.5))
        said = {o.header.stamp for o in self.live.all()}
        self.assertFalse(said & set(stamps), "the correction of the run before is still in use")


if __name__ == "__main__":
    rostest.rosrun("ardrone_vslam", "odometry_fusion_faults", Faults)
