#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""A bag played through tracker, mapper and odometry_fusion: odometry in map for each odometry message, which
is the raw one seen through a correction that came late, and as near to the truth as the fused pose."""
import os
import sys
import unittest

import numpy as np
import rosbag
import rospy
import rostest
from ardrone_vslam.msg import PoseCorrection
from diagnostic_msgs.msg import DiagnosticArray
from nav_msgs.msg import Odometry, Path
from tf2_msgs.msg import TFMessage

sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from drone import Recorder, matrix, play, pose_of  # noqa: E402

PLAY_TIMEOUT_S = 110


def position(pose):
    return [pose.position.x, pose.position.y, pose.position.z]


class OdometryFusion(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        rospy.init_node("odometry_fusion_test")
        live = Recorder("/vslam/odometry_live", Odometry)
        corrections = Recorder("/vslam/correction", PoseCorrection)
        paths = Recorder("/vslam/repropagated", Path)
        tf = Recorder("/tf", TFMessage)
        diagnostics = Recorder("/diagnostics", DiagnosticArray)
        with rosbag.Bag(rospy.get_param("~bag")) as bag:
            cls.raw = [m for _, m, _ in bag.read_messages("/odometry")]
            cls.truth = [m for _, m, _ in bag.read_messages("/truth/pose")]
        play([live, corrections, paths])
        last = cls.raw[-1].header.stamp
        live.wait(lambda o: o.header.stamp == last, PLAY_TIMEOUT_S)
        cls.live, cls.corrections, cls.paths = live.all(), corrections.all(), paths.all()
        cls.tf, cls.diagnostics = tf.all(), diagnostics.all()
        cls.raw_at = {o.header.stamp: pose_of(o.pose.pose) for o in cls.raw}

    def errors_m(self, stamps, positions):
        """Distances to the truth, which is interpolated at the stamps."""
        times_s = [t.header.stamp.to_sec() for t in self.truth]
        truth = np.array([position(t.pose) for t in self.truth])
        stamps_s = [s.to_sec() for s in stamps]
        at = np.column_stack([np.interp(stamps_s, times_s, truth[:, axis]) for axis in range(3)])
        covered = (np.array(stamps_s) >= times_s[0]) & (np.array(stamps_s) <= times_s[-1])
        return np.linalg.norm(np.array(positions) - at, axis=1)[covered]

    def test_one_for_each_odometry_message_since_the_first_correction(self):
        stamps = [o.header.stamp for o in self.raw]
        first = self.live[0].header.stamp
        self.assertEqual([o.header.stamp for o in self.live], [s for s in stamps if s >= first])
        self.assertGreaterEqual(first, self.corrections[0].header.stamp)
        self.assertGreater(len(self.live), len(stamps) // 2)

    def test_frames_and_twist(self):
        twists = {o.header.stamp: o.twist for o in self.raw}
        for odometry in self.live:
            self.assertEqual((odometry.header.frame_id, odometry.child_frame_id), ("map", "base_link"))
            # As text: a bag's messages are of classes of their own.
            self.assertEqual(str(odometry.twist), str(twists[odometry.header.stamp]))

    def test_covariance(self):
        for odometry in self.live:
            covariance = np.array(odometry.pose.covariance).reshape(6, 6)
            self.assertTrue(np.isfinite(covariance).all())
            np.testing.assert_array_equal(covariance, covariance.T)
            self.assertGreater(np.linalg.eigvalsh(covariance).min(), 0)

    def test_each_is_the_raw_one_seen_through_the_newest_correction(self):
        """The corrections in use only ever follow each other, and each is older than what it corrects."""
        map_odom = [matrix(c.map_to_odom.translation, c.map_to_odom.rotation) for c in self.corrections]
        in_use = 0
        for odometry in self.live:
            raw = self.raw_at[odometry.header.stamp]
            live = pose_of(odometry.pose.pose)
            while not np.allclose(map_odom[in_use] @ raw, live, rtol=0, atol=1e-9):
                in_use += 1
                self.assertLess(in_use, len(map_odom), "it is seen through none of the corrections")
            self.assertLessEqual(self.corrections[in_use].header.stamp, odometry.header.stamp)
        self.assertGreater(in_use, len(self.corrections) // 2)

    def test_repropagated_begins_at_the_corrections_stamp(self):
        corrections = {c.header.stamp: c for c in self.corrections}
        self.assertGreater(len(self.paths), len(self.corrections) // 2)
        for path in self.paths:
            self.assertEqual(path.header.frame_id, "map")
            stamps = [p.header.stamp for p in path.poses]
            self.assertEqual(stamps, [o.header.stamp for o in self.raw
                                      if path.header.stamp <= o.header.stamp <= stamps[-1]])
            c = corrections[path.header.stamp].map_to_odom
            map_odom = matrix(c.translation, c.rotation)
            for pose in path.poses:
                np.testing.assert_allclose(pose_of(pose.pose),
                                           map_odom @ self.raw_at[pose.header.stamp], atol=1e-9)

    def test_it_is_as_good_as_the_fused_pose(self):
        """At the odometry's stamps, where the raw odometry is worse."""
        def rms_m(stamps, poses):
            errors_m = self.errors_m(stamps, [position(p) for p in poses])
            self.assertTrue(np.isfinite(errors_m).all())
            return np.sqrt((errors_m ** 2).mean())
        stamps = [o.header.stamp for o in self.live]
        raw = {o.header.stamp: o.pose.pose for o in self.raw}
        live_m = rms_m(stamps, [o.pose.pose for o in self.live])
        raw_m = rms_m(stamps, [raw[s] for s in stamps])
        fused_m = rms_m([c.header.stamp for c in self.corrections],
                        [c.fused_pose.pose for c in self.corrections])
        print("rms error: odometry %.3f m, pose %.3f m, odometry_live %.3f m" % (raw_m, fused_m, live_m))
        self.assertLess(live_m, 0.95 * raw_m)
        self.assertLess(live_m, 1.2 * fused_m)

    def test_tf_is_sent_once(self):
        """By the mapper alone: odometry_fusion neither repeats map -> odom nor gives base a second parent."""
        transforms = [t for m in self.tf for t in m.transforms]
        ours = [t for t in transforms if t.header.frame_id == "map"]
        self.assertEqual({t.child_frame_id for t in ours}, {"odom"})
        stamps = [t.header.stamp for t in ours]
        self.assertEqual(len(stamps), len(set(stamps)))
        self.assertLessEqual({t.header.frame_id for t in transforms if t.child_frame_id == "base_link"},
                             {"odom"})

    def test_diagnostics(self):
        ours = [s for a in self.diagnostics for s in a.status if "odometry_fusion" in s.name]
        values = {v.key: v.value for v in ours[-1].values}
        self.assertGreater(int(values["corrections used"]), len(self.corrections) // 2)
        self.assertEqual(values["corrections refused"], "0")
        self.assertEqual(values["odometry messages refused"], "0")


if __name__ == "__main__":
    rostest.rosrun("ardrone_vslam", "odometry_fusion", OdometryFusion)
