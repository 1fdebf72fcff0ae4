#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Every kind of bad message: it is refused with a sentence that names topic, fault and remedy, it is
counted, and the next good image is answered as if nothing had been."""
import math
import os
import sys
import time
import unittest

import rospy
import rostest
from ardrone_vslam.msg import Features, Status
from nav_msgs.msg import Odometry

sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from drone import Drone, HEIGHT, Recorder, WIDTH  # noqa: E402

NAN = float("nan")


class BadMessages(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        rospy.init_node("bad_messages_test")
        cls.drone = Drone()
        cls.features = rospy.Publisher("/vslam/features", Features, queue_size=10)
        cls.fused = Recorder("/vslam/odometry_fused", Odometry)
        cls.drone.connect()
        cls.drone.mount_camera()

    def fly_well(self):
        """One good image, answered with a finite pose. @return the status of its answer"""
        time.sleep(0.25)  # sentences that come closer upon each other are not all logged
        pose = self.drone.fly(1)[0]
        self.assertIsNotNone(pose, "a good image is not answered any more")
        numbers = [pose.pose.pose.position.x, pose.pose.pose.position.y, pose.pose.pose.position.z]
        numbers += list(pose.pose.covariance)
        self.assertTrue(all(math.isfinite(n) for n in numbers))
        self.assertAlmostEqual(pose.pose.pose.position.y, self.drone.position_m(), delta=0.1)
        status = self.drone.status.wait(lambda s: s.header.stamp == pose.header.stamp)
        self.assertIsNotNone(status)
        return status

    def begin_again(self):
        """Time goes back, and messages come until one is answered: some must agree before that."""
        self.drone.time_s -= 100
        self.fly_until_answered()

    def fly_until_answered(self):
        for _ in range(20):
            stamp = self.drone.next()
            self.drone.send(self.drone.odometry(), self.drone.image(), self.drone.info())
            if self.drone.answered(stamp, 1.0):
                return
        self.fail("images are not answered any more")

    def publish_away(self, away_s):
        """An image, an odometry message and features of another time, one of each."""
        self.drone.next()
        self.drone.time_s += away_s
        features = Features()
        features.header = self.drone.image().header
        features.width, features.height, features.focal_length = WIDTH, HEIGHT, 300
        self.drone.send(self.drone.odometry(), self.drone.image(), self.drone.info())
        self.features.publish(features)
        self.drone.time_s -= away_s

    def assert_said(self, *parts):
        said = self.drone.log.wait(lambda log: all(part in log.msg for part in parts))
        self.assertIsNotNone(said, "nothing in the log with %s" % (parts,))

    def refuse_image(self, change, *said):
        """The image or camera_info that `change` spoils is not answered, but counted."""
        before = self.fly_well()
        stamp = self.drone.next()
        image, info = self.drone.image(), self.drone.info()
        change(image, info)
        self.drone.send(self.drone.odometry(), image, info)
        self.assert_said(*said)
        after = self.fly_well()
        self.assertEqual(after.images_dropped, before.images_dropped + 1)
        self.assertFalse([p for p in self.drone.pose.all() if p.header.stamp == stamp])

    def refuse_odometry(self, change, *said):
        before = self.fly_well()
        odometry = self.drone.odometry()
        odometry.header.stamp += rospy.Duration(0.01)
        change(odometry)
        self.drone.send(odometry)
        self.assert_said(*said)
        after = self.fly_well()
        self.assertEqual(after.odometry_refused, before.odometry_refused + 1)

    def refuse_features(self, change, *said):
        before = self.fly_well()
        self.drone.next()
        message = Features()
        message.header = self.drone.image().header
        message.width, message.height, message.focal_length = WIDTH, HEIGHT, 300
        message.x, message.y, message.score, message.track_id, message.age = [1], [1], [9], [7], [0]
        message.bearing, message.descriptor = [0, 0, 1], bytes(64)
        message.stage_time = [0, 0, 0]
        change(message)
        self.features.publish(message)
        self.assert_said(*said)
        after = self.fly_well()
        self.assertEqual(after.dropped_bad_message, before.dropped_bad_message + 1)

    # Calibration

    def test_camera_info_not_finite(self):
        def change(_, info):
            info.K = [NAN] * 9
        self.refuse_image(change, "/camera/camera_info", "K is not finite", "calibrate")

    def test_camera_info_uncalibrated(self):
        def change(_, info):
            info.K = [0] * 9
        self.refuse_image(change, "/camera/camera_info", "uncalibrated", "camera_calibration")

    def test_focal_length_of_no_camera(self):
        def change(_, info):
            info.K = [1e300, 0, 160, 0, 1e300, 120, 0, 0, 1]
        self.refuse_image(change, "/camera/camera_info", "focal length 1e+300 px", "calibrate")

    def test_lens_that_folds_back(self):
        def change(_, info):
            info.D = [-900, 5000, 3, 3, 1e5]
        self.refuse_image(change, "/camera/camera_info", "k1 -900", "folds back", "calibrate")

    def test_fisheye_lens(self):
        def change(_, info):
            info.distortion_model = "equidistant"
        self.refuse_image(change, "/camera/camera_info", "equidistant", "plumb_bob")

    def test_calibration_of_another_size(self):
        def change(_, info):
            info.width, info.height = 640, 480
        self.refuse_image(change, "/camera/image_raw", "320x240", "640x480", "calibrate")

    # Images

    def test_unknown_encoding(self):
        def change(image, _):
            image.encoding = "foo8"
        self.refuse_image(change, "/camera/image_raw", "foo8", "publish mono8")

    def test_truncated_image(self):
        def change(image, _):
            image.data = image.data[:1000]
        self.refuse_image(change, "/camera/image_raw", "cannot be read", "step and data")

    def test_empty_image(self):
        def change(image, _):
            image.width, image.height, image.step, image.data = 0, 0, 0, b""
        self.refuse_image(change, "/camera/image_raw", "empty", "driver")

    def test_late_image(self):
        def change(image, info):
            image.header.stamp -= rospy.Duration(0.5)
            info.header.stamp = image.header.stamp
        self.refuse_image(change, "/camera/image_raw", "stamps must ascend")

    def test_black_images_are_answered(self):
        self.fly_well()
        for _ in range(2):  # the tracks that end with the first one may correct the pose
            stamp = self.drone.next()
            image = self.drone.image()
            image.data = bytes(WIDTH * HEIGHT)
            self.drone.send(self.drone.odometry(), image, self.drone.info())
            self.assertIsNotNone(self.drone.answered(stamp))
        status = self.drone.status.wait(lambda s: s.header.stamp == stamp)
        self.assertEqual(status.features, 0)
        self.assertEqual(status.state, Status.BLIND)
        self.assertIn("hardly a corner", status.reason)
        self.assert_said("hardly a corner")
        self.fly_well()

    # Odometry

    def test_odometry_not_finite(self):
        def change(odometry):
            odometry.pose.pose.position.x = NAN
        self.refuse_odometry(change, "/odometry", "position is not finite")

    def test_odometry_all_zero(self):
        def change(odometry):
            odometry.pose.pose.orientation.w = 0
        self.refuse_odometry(change, "/odometry", "norm 0", "fill the orientation")

    def test_odometry_covariance_not_finite(self):
        def change(odometry):
            odometry.pose.covariance = [NAN] * 36
        self.refuse_odometry(change, "/odometry", "covariance is not finite")

    def test_odometry_far_beyond_the_earth(self):
        def change(odometry):
            odometry.pose.pose.position.x = 1e300
        self.refuse_odometry(change, "/odometry", "1e+300 m, beyond 1e+07 m", "check its unit")

    def test_odometry_faster_than_any_drone(self):
        def change(odometry):
            odometry.twist.twist.linear.x = 1e300
        self.refuse_odometry(change, "/odometry", "1e+300, beyond 1000 m/s", "check its unit")

    def test_covariance_that_means_unknown(self):
        """Largest doubles, as some drivers write: the pose is used, the covariance is not."""
        before = self.fly_well()
        for variance in (sys.float_info.max, 1e6, -1.0, 1e12, sys.float_info.max):
            stamp = self.drone.next()
            odometry = self.drone.odometry()
            odometry.pose.covariance = [variance if i % 7 == 0 else 0 for i in range(36)]
            odometry.twist.covariance = [sys.float_info.max] * 36
            self.drone.send(odometry, self.drone.image(), self.drone.info())
            pose = self.drone.answered(stamp)
            self.assertIsNotNone(pose)
            self.assertTrue(all(math.isfinite(n) for n in pose.pose.covariance))
            self.assertLess(pose.pose.covariance[0], 1)
            fused = self.fused.wait(lambda f: f.header.stamp == stamp)
            self.assertTrue(all(math.isfinite(n) for n in fused.twist.covariance))
        self.assert_said("/odometry", "counts as not given", "odometry_noise_m_per_sqrt_m")
        after = self.fly_well()
        self.assertEqual(after.odometry_refused, before.odometry_refused)
        self.assertEqual(after.results_not_finite, 0)

    def test_odometry_late(self):
        def change(odometry):
            odometry.header.stamp -= rospy.Duration(0.5)
        self.refuse_odometry(change, "/odometry", "stamps must ascend")

    def test_zero_odometry(self):
        """All zeros but well formed: the reason names the topic, until the odometry moves."""
        self.begin_again()  # a new map
        for _ in range(45):  # 4.5 s
            stamp = self.drone.next()
            odometry = self.drone.odometry()
            odometry.pose.pose.position.y = 0
            self.drone.send(odometry, self.drone.image(), self.drone.info())
            self.assertIsNotNone(self.drone.answered(stamp))
        status = self.drone.status.wait(lambda s: s.header.stamp == stamp)
        self.assertEqual(status.state, Status.BUILDING_MAP)
        self.assertIn("/odometry does not move", status.reason)
        self.assert_said("/odometry does not move", "rostopic echo", "remap")
        self.begin_again()
        self.assertNotIn("does not move", self.fly_well().reason)

    # features

    def test_features_of_wrong_size(self):
        def change(features):
            features.descriptor = bytes(63)
        self.refuse_features(change, "/vslam/features", "descriptor", "63")

    def test_features_not_finite(self):
        def change(features):
            features.bearing = [NAN, 0, 1]
        self.refuse_features(change, "/vslam/features", "bearing 0", "unit vectors")

    def test_features_without_frame(self):
        def change(features):
            features.header.frame_id = ""
        self.refuse_features(change, "/vslam/features", "frame_id", "optical frame")

    # Time

    def test_one_message_of_another_time_deletes_no_map(self):
        """One image, one odometry, one Features message, each from long before or long after."""
        before = self.fly_well()
        for away_s in (-100, 5, 1000):
            self.publish_away(away_s)
            after = self.fly_well()
            self.assertEqual(after.restarts, before.restarts)
            self.assertIn(after.state, (Status.TRACKING, Status.LOCALISED, Status.RESTING, Status.ROTATING))

    def test_time_begins_again(self):
        """A bag that loops: the map begins anew, and images are answered again."""
        before = self.fly_well()
        self.begin_again()
        after = self.fly_well()
        self.assertEqual(after.restarts, before.restarts + 1)
        self.assertEqual(after.state, Status.BUILDING_MAP)


if __name__ == "__main__":
    rostest.rosrun("ardrone_vslam", "bad_messages", BadMessages)
