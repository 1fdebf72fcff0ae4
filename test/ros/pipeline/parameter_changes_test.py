#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Parameters change in flight by dynamic_reconfigure, and the flight goes on; what cannot be is refused as a whole."""
import os
import sys
import unittest

import rospy
import rostest
from dynamic_reconfigure import DynamicReconfigureCallbackException
from dynamic_reconfigure.client import Client

sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from drone import TIMEOUT_S, Drone  # noqa: E402

OF_TRACKER = {"features_per_frame": 1000, "cell_size_px": 80, "threshold_min": 8, "track_search_radius_px": 80.0}
OF_MAPPER = {"max_landmarks": 200000, "max_map_mb": 0, "frame_budget_ms": 0.0, "localise_only": False, "transform_tolerance_s": 0.2,
             "publish_tf": True, "autosave_s": 60.0}


def values_of(client):
    return {name: value for name, value in client.get_configuration(timeout=TIMEOUT_S).items() if name != "groups"}


class ParameterChangesTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        rospy.init_node("parameter_changes_test")
        cls.drone = Drone()
        cls.drone.connect()
        cls.drone.mount_camera()
        cls.tracker = Client("/vslam/tracker", timeout=TIMEOUT_S)
        cls.mapper = Client("/vslam/mapper", timeout=TIMEOUT_S)

    def status_after(self, images):
        poses = self.drone.fly(images)
        self.assertNotIn(None, poses)
        self.assertLess(abs(poses[-1].pose.pose.position.y - self.drone.position_m()), 0.1)
        stamp = self.drone.stamp()
        return self.drone.status.wait(lambda status: status.header.stamp == stamp)

    def assert_refused(self, client, changes, said):
        with self.assertRaises(DynamicReconfigureCallbackException):
            client.update_configuration(changes)
        self.assertIsNotNone(self.drone.log.wait(lambda log: "no parameter is changed" in log.msg and said in log.msg), said)

    def test_1_they_are_described(self):
        for client, expected in ((self.tracker, OF_TRACKER), (self.mapper, OF_MAPPER)):
            self.assertEqual(set(values_of(client)), set(expected))
            for one in client.get_parameter_descriptions(timeout=TIMEOUT_S):
                self.assertEqual(one["default"], expected[one["name"]])
                self.assertLess(one["min"], one["max"])
                self.assertGreater(len(one["description"]), 10)

    def test_2_the_flight_goes_on(self):
        self.assertEqual(values_of(self.tracker)["features_per_frame"], 600)  # of vslam.launch's configuration
        before = self.status_after(60)
        self.assertGreater(before.features, 150)
        self.assertGreater(before.landmarks, 100)
        self.assertEqual(before.changed_parameters, "")
        self.tracker.update_configuration({"features_per_frame": 100})
        self.mapper.update_configuration({"max_landmarks": 50, "publish_tf": False})
        after = self.status_after(30)
        self.assertLessEqual(after.features, 100)
        self.assertLessEqual(after.landmarks, 50)
        self.assertEqual(after.changed_parameters, "features_per_frame=100 max_landmarks=50 publish_tf=false")
        self.assertEqual((after.restarts, after.camera_changes), (0, 0))
        self.assertEqual(rospy.get_param("/vslam/mapper/max_landmarks"), 50)
        self.assertIsNotNone(self.drone.log.wait(lambda log: log.msg.endswith("changed in flight: features_per_frame=100")))
        self.mapper.update_configuration({"max_landmarks": 200000, "publish_tf": True})
        self.assertEqual(self.status_after(1).changed_parameters, "features_per_frame=100")

    def test_3_a_budget_begins_and_ends(self):
        self.mapper.update_configuration({"frame_budget_ms": 0.001})
        during = self.status_after(30)
        self.assertEqual(during.left_out[2], "keyframe")
        self.assertGreater(during.left_out_count[2], 5)
        self.mapper.update_configuration({"frame_budget_ms": 0})
        left_out = self.status_after(1).left_out_count
        self.assertEqual(self.status_after(30).left_out_count, left_out)

    def test_4_what_cannot_be_is_refused(self):
        self.assert_refused(self.tracker, {"features_per_frame": 30, "threshold_min": 40}, "threshold_min is 40 but must be between 1 and 35")
        self.assert_refused(self.mapper, {"max_landmarks": 1}, "max_landmarks is 1 but must be between 10 and 10000000")
        self.assertGreater(self.status_after(5).features, 50)  # not 30


if __name__ == "__main__":
    rostest.rosrun("ardrone_vslam", "parameter_changes", ParameterChangesTest)
