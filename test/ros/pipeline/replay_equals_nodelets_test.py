#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""The offline program and the nodelets give the same poses for the same bag."""
import os
import subprocess
import sys
import tempfile
import unittest

import numpy as np
import rospy
import rostest
from geometry_msgs.msg import PoseWithCovarianceStamped
from nav_msgs.msg import Odometry

sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from drone import Recorder, play  # noqa: E402

TOLERANCE_M = 1e-6
PLAY_TIMEOUT_S = 150


class ReplayEqualsNodelets(unittest.TestCase):
    def test_poses(self):
        rospy.init_node("replay_equals_nodelets_test")
        poses = Recorder("/vslam/pose", PoseWithCovarianceStamped)
        with tempfile.TemporaryDirectory() as out:
            subprocess.run([rospy.get_param("~replay"), rospy.get_param("~bag"), "--out", out,
                            "--config", rospy.get_param("~config")]
                           + rospy.get_param("~arguments", "").split(), check=True)
            offline = np.loadtxt(os.path.join(out, "fused.tum"))
        # replay writes when the image was exposed, the mapper its stamp.
        image_time_offset_s = rospy.get_param("~image_time_offset_s", 0)
        offline[:, 0] -= image_time_offset_s
        self.assertGreater(len(offline), 30)
        live = Recorder("/vslam/odometry_live", Odometry) if rospy.get_param("~odometry_fusion", False) else None
        play([poses, live] if live else [poses])
        last_s = offline[-1, 0]
        poses.wait(lambda p: p.header.stamp.to_sec() > last_s - 1e-4, PLAY_TIMEOUT_S)
        online = np.array([[p.header.stamp.to_sec(), p.pose.pose.position.x,
                            p.pose.pose.position.y, p.pose.pose.position.z,
                            p.pose.pose.orientation.x, p.pose.pose.orientation.y,
                            p.pose.pose.orientation.z, p.pose.pose.orientation.w]
                           for p in poses.all()])
        self.assertEqual(online.shape, offline.shape)
        np.testing.assert_allclose(online[:, 0], offline[:, 0], rtol=0, atol=1e-6)
        np.testing.assert_allclose(online[:, 1:4], offline[:, 1:4], rtol=0, atol=TOLERANCE_M)
        # q and -q are the same orientation.
        same = np.abs((online[:, 4:] * offline[:, 4:]).sum(axis=1))
        np.testing.assert_allclose(same, 1, rtol=0, atol=1e-6)
        if live:
            online[:, 0] += image_time_offset_s
            self.check(live, online)

    def check(self, live, fused):
        """Corrections are of the odometry as odometry_fusion has it: it goes on from the fused poses."""
        last = live.wait(lambda o: o.header.stamp.to_sec() >= fused[-1, 0])
        self.assertIsNotNone(last, "odometry_fusion does not follow")
        messages = live.all()  # once: more are on their way
        stamps_s = np.array([o.header.stamp.to_sec() for o in messages])
        self.assertTrue((np.diff(stamps_s) > 0).all())
        self.assertGreater(len(stamps_s), 3 * len(fused))
        at = np.array([o.pose.pose.position.x for o in messages])
        among = (fused[:, 0] >= stamps_s[0]) & (fused[:, 0] <= stamps_s[-1])
        np.testing.assert_allclose(np.interp(fused[among, 0], stamps_s, at), fused[among, 1], atol=0.1)


if __name__ == "__main__":
    rostest.rosrun("ardrone_vslam", "replay_equals_nodelets", ReplayEqualsNodelets)
