#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""A bag played through tracker and mapper: a pose for every image, at the image's stamp, in the
right frames, with a covariance; tf map -> odom; path, cloud and markers; what `correction` says
fits together."""
import os
import sys
import unittest

import numpy as np
import rosbag
import rospy
import rostest
from ardrone_vslam.msg import Features, PoseCorrection, Status
from diagnostic_msgs.msg import DiagnosticArray
from geometry_msgs.msg import PoseWithCovarianceStamped
from nav_msgs.msg import Odometry, Path
from sensor_msgs.msg import Image, PointCloud2
from tf2_msgs.msg import TFMessage
from visualization_msgs.msg import MarkerArray

sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from drone import Recorder, matrix, play, points_shown, pose_of  # noqa: E402

PLAY_TIMEOUT_S = 150


class Pipeline(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        rospy.init_node("pipeline_test")
        recorders = {
            "features": Features, "pose": PoseWithCovarianceStamped,
            "odometry_fused": Odometry, "correction": PoseCorrection, "status": Status,
            "path": Path, "observer_path": Path, "landmarks": PointCloud2,
            "landmark_markers": MarkerArray, "state_markers": MarkerArray, "debug_image": Image}
        cls.topics = {name: Recorder("/vslam/" + name, kind) for name, kind in recorders.items()}
        cls.tf = Recorder("/tf", TFMessage)
        cls.diagnostics = Recorder("/diagnostics", DiagnosticArray)
        with rosbag.Bag(rospy.get_param("~bag")) as bag:
            cls.odometry = [m for _, m, _ in bag.read_messages("/odometry")]
            cls.images = [m.header.stamp for _, m, _ in bag.read_messages("/camera/camera_info")]
        # The images outside of the odometry's time cannot be answered, nor replayed offline.
        times = [m.header.stamp for m in cls.odometry]
        cls.answerable = [s for s in cls.images if times[0] <= s <= times[-1]]
        play(cls.topics.values())
        last = cls.answerable[-1]
        cls.topics["pose"].wait(lambda p: p.header.stamp == last, PLAY_TIMEOUT_S)
        cls.topics["path"].wait(lambda p: p.header.stamp == last)
        cls.topics["landmarks"].wait(lambda c: c.header.stamp == last)

    def all(self, name):
        return self.topics[name].all()

    def test_every_image_has_its_pose(self):
        self.assertGreater(len(self.answerable), 30)
        self.assertGreaterEqual(len(self.answerable), len(self.images) - 1)
        self.assertEqual([p.header.stamp for p in self.all("pose")], self.answerable)
        for name in ["odometry_fused", "correction"]:
            self.assertEqual([m.header.stamp for m in self.all(name)], self.answerable)
        self.assertEqual([m.header.stamp for m in self.all("features")], self.images)

    def test_it_localises(self):
        """Not the odometry passed on: most images after the first are corrected by the camera, by
        tracks and, once they are a second old, by landmarks."""
        states = [s.state for s in self.all("status") if s.images > 0]
        self.assertGreater(states.count(Status.LOCALISED) + states.count(Status.TRACKING),
                           len(self.answerable) // 2)
        self.assertGreater(states.count(Status.LOCALISED), 10)
        self.assertGreater(max(s.landmarks for s in self.all("status")), 50)
        self.assertGreater(sum(c.corrected for c in self.all("correction")),
                           len(self.answerable) // 2)

    def test_frames(self):
        self.assertEqual({p.header.frame_id for p in self.all("pose")}, {"map"})
        for odometry in self.all("odometry_fused"):
            self.assertEqual((odometry.header.frame_id, odometry.child_frame_id),
                             ("map", "base_link"))
        for correction in self.all("correction"):
            self.assertEqual((correction.header.frame_id, correction.child_frame_id),
                             ("map", "base_link"))
        self.assertEqual({f.header.frame_id for f in self.all("features")}, {"camera_optical"})

    def test_covariance(self):
        for pose in self.all("pose"):
            covariance = np.array(pose.pose.covariance).reshape(6, 6)
            self.assertTrue(np.isfinite(covariance).all())
            np.testing.assert_allclose(covariance, covariance.T, atol=1e-12)
            self.assertGreater(np.linalg.eigvalsh(covariance).min(), 0)

    def test_correction_is_consistent(self):
        """fused = map_to_odom * odometry, and pose, odometry_fused and correction agree."""
        poses = {p.header.stamp: p.pose for p in self.all("pose")}
        fused = {o.header.stamp: o.pose for o in self.all("odometry_fused")}
        for c in self.all("correction"):
            odometry = pose_of(c.observer_pose)
            pose = pose_of(c.fused_pose.pose)
            map_odom = matrix(c.map_to_odom.translation, c.map_to_odom.rotation)
            np.testing.assert_allclose(map_odom @ odometry, pose, atol=1e-9)
            self.assertEqual(c.fused_pose, poses[c.header.stamp])
            self.assertEqual(c.fused_pose, fused[c.header.stamp])

    def test_map_equals_odom_at_first(self):
        first = self.all("correction")[0].map_to_odom
        np.testing.assert_allclose(matrix(first.translation, first.rotation), np.eye(4),
                                   atol=1e-9)

    def test_tf(self):
        """map -> odom only: odom -> base is the odometry's (REP-105)."""
        ours = [t for m in self.tf.all() for t in m.transforms if t.header.frame_id == "map"]
        self.assertEqual({t.child_frame_id for t in ours}, {"odom"})
        self.assertEqual(len(ours), len(self.answerable))
        parents = {t.header.frame_id for m in self.tf.all() for t in m.transforms
                   if t.child_frame_id == "base_link"}
        self.assertLessEqual(parents, {"odom"})
        by_stamp = {c.header.stamp: c.map_to_odom for c in self.all("correction")}
        tolerance = rospy.Duration(0.2)
        for transform in ours:
            self.assertEqual(transform.transform, by_stamp[transform.header.stamp - tolerance])

    def test_status(self):
        answers = [s for s in self.all("status") if s.header.stamp in set(self.answerable)]
        last = answers[-1]
        self.assertEqual(last.images, len(self.answerable))
        self.assertEqual(last.images_dropped + last.images_dropped_queue +
                         last.images_without_camera_info + last.dropped_bad_message +
                         last.dropped_stamp + last.dropped_queue, 0)
        self.assertEqual(last.dropped_no_odometry, len(self.images) - len(self.answerable))
        self.assertEqual(list(last.stage),
                         ["detect", "describe", "track", "associate", "localise", "map"])
        self.assertEqual(len(last.stage_time), len(last.stage))
        self.assertGreater(last.stage_time[0], 0)
        self.assertTrue(all(time >= 0 for s in answers for time in s.stage_time))

    def test_twist_is_the_observers_at_the_images_stamp(self):
        times_s = [o.header.stamp.to_sec() for o in self.odometry]
        speeds = [o.twist.twist.linear.x for o in self.odometry]
        turns = [o.twist.twist.angular.z for o in self.odometry]
        self.assertGreater(max(speeds) - min(speeds), 0.1)
        fused = self.all("odometry_fused")
        stamps_s = [o.header.stamp.to_sec() for o in fused]
        np.testing.assert_allclose([o.twist.twist.linear.x for o in fused],
                                   np.interp(stamps_s, times_s, speeds), atol=1e-6)
        np.testing.assert_allclose([o.twist.twist.angular.z for o in fused],
                                   np.interp(stamps_s, times_s, turns), atol=1e-6)

    def test_features(self):
        for features in self.all("features"):
            n = len(features.x)
            self.assertEqual(len(features.descriptor), 64 * n)
            self.assertEqual(len(set(features.track_id)), n)
        self.assertGreater(max(max(f.age, default=0) for f in self.all("features")), 3)

    def test_paths_cloud_and_markers(self):
        path = self.all("path")[-1]
        self.assertEqual(path.header.frame_id, "map")
        self.assertEqual([p.header.stamp for p in path.poses], self.answerable)
        self.assertEqual(len(self.all("observer_path")[-1].poses), len(self.answerable))
        cloud = self.all("landmarks")[-1]
        self.assertEqual([f.name for f in cloud.fields],
                         ["x", "y", "z", "deviation", "times_seen", "id"])
        landmarks = [s.landmarks for s in self.all("status") if s.header.stamp == cloud.header.stamp]
        self.assertEqual([cloud.width], landmarks)
        points = np.frombuffer(cloud.data, np.float32).reshape(cloud.width, cloud.point_step // 4)
        self.assertTrue(np.isfinite(points[:, :4]).all())
        self.assertGreater(points[:, 3].min(), 0)

    def test_markers_show_map_and_state(self):
        self.assertEqual(points_shown(self.all("landmark_markers")), self.all("landmarks")[-1].width)
        self.assertTrue(any(message.markers[1].points for message in self.all("state_markers")))
        for text, in_use, lines in (message.markers for message in self.all("state_markers")):
            status = [s for s in self.all("status") if s.header.stamp == text.header.stamp][-1]
            self.assertTrue(text.text.startswith(status.state_name.replace("_", " ")), text.text)
            self.assertEqual(len(lines.points), 2 * len(in_use.points))
            # Beside the matches, landmarks that tracks have made anew; some are removed later.
            self.assertGreaterEqual(len(in_use.points), 0.9 * status.landmark_matches)

    def test_debug_image(self):
        image = self.all("debug_image")[-1]
        self.assertEqual(image.encoding, "bgr8")
        self.assertIn(image.header.stamp, self.images)
        pixels = np.frombuffer(image.data, np.uint8).reshape(-1, 3)
        self.assertGreater((pixels[:, 0] != pixels[:, 2]).sum(), 100)  # coloured circles

    def test_diagnostics(self):
        names = {s.name for a in self.diagnostics.all() for s in a.status}
        self.assertTrue(any("tracker" in name for name in names), names)
        self.assertTrue(any("mapper" in name for name in names), names)


if __name__ == "__main__":
    rostest.rosrun("ardrone_vslam", "pipeline", Pipeline)
