#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""vslam_onboard itself, with a rendered flight, by UDP into onboard_bridge: the topics of tracker and mapper have what the program
computed; then a damaged link, a program that is started again without a camera or a controller, and silence."""
import os
import socket
import struct
import subprocess
import sys
import tempfile
import time
import unittest
import zlib
from pathlib import Path

import numpy as np
import rospy
import rostest
from ardrone_vslam.msg import Features, PoseCorrection, Status
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus
from geometry_msgs.msg import PoseWithCovarianceStamped
from nav_msgs.msg import Odometry, Path as PathMessage
from sensor_msgs.msg import Image, PointCloud2
from tf2_msgs.msg import TFMessage
from visualization_msgs.msg import MarkerArray

HERE = Path(os.path.abspath(__file__)).parent.parent  # test/ros
sys.path[:0] = [str(HERE), str(HERE.parent / "onboard")]
sys.dont_write_bytecode = True
from drone import TIMEOUT_S, Recorder, matrix, points_shown  # noqa: E402
from pose_records import read_poses  # noqa: E402

SOURCE = HERE.parent.parent
RATE_HZ = 15
TOLERANCE = rospy.Duration(0.2)  # transform_tolerance_s
# Of the answers, as pose_records reads them.
FLAGS, STATE, STAMP_NS, FUSED, OBSERVER, COUNTS, DEVIATION = range(7)
# The program's states in the order of its protocol, and those of Status.
STATES = [Status.BUILDING_MAP, Status.LOCALISED, Status.TOO_FEW_LANDMARKS, Status.FIX_REJECTED, Status.OBSERVER_ONLY,
          Status.NOT_FINITE, Status.TRACKING, Status.RESTING, Status.ROTATING, Status.RELOCATED, Status.DISTRUSTED,
          Status.SEARCHING_MAP, Status.BLIND]


def numbers(pose):
    p, q = pose.position, pose.orientation
    return [p.x, p.y, p.z, q.x, q.y, q.z, q.w]


class OnboardBridge(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        rospy.init_node("onboard_bridge_test")
        kinds = {"pose": PoseWithCovarianceStamped, "odometry_fused": Odometry, "correction": PoseCorrection, "status": Status,
                 "features": Features, "debug_image": Image, "path": PathMessage, "observer_path": PathMessage,
                 "landmarks": PointCloud2, "landmark_markers": MarkerArray, "state_markers": MarkerArray}
        cls.topics = {name: Recorder("/vslam/" + name, kind) for name, kind in kinds.items()}
        cls.other = {name: Recorder("/estimated/" + name, kinds[name]) for name in ("pose", "status")}
        cls.tf = Recorder("/tf", TFMessage)
        cls.diagnostics = Recorder("/diagnostics", DiagnosticArray)
        recorders = [*cls.topics.values(), *cls.other.values(), cls.tf, cls.diagnostics]
        end_s = time.monotonic() + TIMEOUT_S
        while time.monotonic() < end_s and not all(recorder.connected() for recorder in recorders):
            time.sleep(0.02)
        cls.silent_at_first = cls.topics["status"].wait(lambda s: s.state == Status.DRONE_SILENT)
        cls.port = cls.port_of("vslam")
        cls.folder = tempfile.TemporaryDirectory()
        cls.out = Path(cls.folder.name)
        cls.fly()
        last = rospy.Time(0, cls.valid[-1][STAMP_NS])
        cls.topics["pose"].wait(lambda p: p.header.stamp == last)
        cls.topics["path"].wait(lambda p: p.header.stamp == last)
        cls.topics["landmarks"].wait(lambda c: c.header.stamp == last)
        for topics in (cls.topics, cls.other):
            topics["status"].wait(lambda s: s.state == Status.ENDED)
        cls.flown = cls.topics["status"].all()

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    @classmethod
    def diagnostic(cls, namespace, condition):
        """The newest status of a bridge that fulfils the condition, as soon as there is one."""
        def of(message):
            return [s for s in message.status if s.name.startswith(f"{namespace}/onboard_bridge") and condition(s)]
        message = cls.diagnostics.wait(of)
        return of(message)[-1] if message else None

    @classmethod
    def port_of(cls, namespace):
        status = cls.diagnostic(namespace, lambda s: True)
        values = {value.key: value.value for value in status.values}
        return int(values["receiving at"].rpartition(":")[2])

    @classmethod
    def command(cls, **sets):
        """The controller is the second bridge."""
        sets = {"camera_position_m": "[0, 0, 0]", "camera_rotation_deg": "[-90, 0, -90]", "cpu_share": 1, "lock_memory": "false",
                "observer": "127.0.0.1:0", "pose_address": f"127.0.0.1:{cls.port_of('estimated')}",
                "telemetry_address": f"127.0.0.1:{cls.port}", "telemetry_hz": 100, **sets}
        sets = [f"onboard/{name}={value}" for name, value in sets.items()]
        sets += ["tracker/features_per_frame=200", "tracker/cell_size_px=80", "tracker/track_search_radius_px=80"]
        return [rospy.get_param("~onboard"), "--config", str(SOURCE / "config" / "ardrone_onboard.yaml"),
                "--camera", str(cls.out / "packed" / "camera.yaml"), "--save-map", "", *[x for text in sets for x in ("--set", text)]]

    @classmethod
    def fly(cls):
        flight, packed = cls.out / "flight", cls.out / "packed"
        subprocess.run([rospy.get_param("~make_world"), "laps", "--seconds", "8", "--rate", str(RATE_HZ), "--camera", "front",
                        "--odometry-profile", "drone", "--seed", "1", "--out", flight], check=True, stdout=subprocess.DEVNULL)
        subprocess.run([SOURCE / "scripts" / "onboard_flight", flight, packed], check=True, stdout=subprocess.DEVNULL)
        cls.images = len((flight / "times.txt").read_text().split())
        stream = (packed / "frames.pgm").read_bytes()
        size = len(stream) // cls.images
        cls.frames = [stream[at:at + size] for at in range(0, len(stream), size)]
        cls.began_s = time.time()
        program = subprocess.Popen(
            cls.command(observer=packed / "observer.bin") +
            ["--save-map", packed / "flight.vmap", "--poses", packed / "poses.bin", "--every-frame", "--frames", "-"], stdin=subprocess.PIPE)
        for frame in cls.frames:  # about as fast as the drone
            program.stdin.write(frame)
            program.stdin.flush()
            time.sleep(1 / RATE_HZ)
        program.stdin.close()
        assert program.wait() == 0
        cls.ended_s = time.time()
        cls.answers = read_poses(packed / "poses.bin")
        cls.valid = [answer for answer in cls.answers if answer[FLAGS] == 1]
        cls.of_stamp = {answer[STAMP_NS]: answer for answer in cls.valid}

    def all(self, name):
        return self.topics[name].all()

    def test_a_poses(self):
        self.assertEqual(len(self.valid), self.images)
        poses = self.all("pose")
        self.assertEqual([p.header.stamp.to_nsec() for p in poses], [answer[STAMP_NS] for answer in self.valid])
        self.assertEqual({p.header.frame_id for p in poses}, {"map"})
        for pose, answer in zip(poses, self.valid):
            np.testing.assert_allclose(numbers(pose.pose.pose), answer[FUSED] * self.sign(pose, answer), atol=1e-12)
            np.testing.assert_allclose(np.array(pose.pose.covariance).reshape(6, 6), np.diag(answer[DEVIATION] ** 2), rtol=1e-12)
        for odometry, answer in zip(self.all("odometry_fused"), self.valid):
            self.assertEqual(odometry.header.stamp.to_nsec(), answer[STAMP_NS])
            self.assertEqual(odometry.child_frame_id, "base_link")
            self.assertGreater(odometry.twist.covariance[0], 1e9)  # not known
        self.assertEqual(len(self.all("path")[-1].poses), self.images)
        self.assertEqual(len(self.all("observer_path")[-1].poses), self.images)

    @staticmethod
    def sign(pose, answer):
        """q and -q are the same rotation."""
        return np.r_[np.ones(3), np.full(4, np.sign(np.dot(numbers(pose.pose.pose)[3:], answer[FUSED][3:])))]

    def test_b_tf(self):
        transforms = [t for m in self.tf.all() for t in m.transforms]
        self.assertEqual({(t.header.frame_id, t.child_frame_id) for t in transforms},
                         {("map", "odom"), ("odom", "base_link"), ("other/map", "other/odom"), ("other/odom", "other/base_link")})
        map_odom = {(t.header.stamp - TOLERANCE).to_nsec(): t.transform for t in transforms if t.child_frame_id == "odom"}
        odom_base = {t.header.stamp.to_nsec(): t.transform for t in transforms if t.child_frame_id == "base_link"}
        self.assertEqual(sorted(map_odom), sorted(self.of_stamp))
        self.assertEqual(sorted(odom_base), sorted(self.of_stamp))
        for pose in self.all("pose"):
            stamp = pose.header.stamp.to_nsec()
            product = [matrix(t[stamp].translation, t[stamp].rotation) for t in (map_odom, odom_base)]
            fused = matrix(pose.pose.pose.position, pose.pose.pose.orientation)
            np.testing.assert_allclose(product[0] @ product[1], fused, atol=1e-9)
            np.testing.assert_allclose(product[1][:3, 3], self.of_stamp[stamp][OBSERVER][:3], atol=1e-12)

    def test_c_landmarks_are_those_of_the_map(self):
        cloud = self.all("landmarks")[-1]
        self.assertEqual([f.name for f in cloud.fields], ["x", "y", "z", "deviation", "times_seen", "id"])
        floats = np.frombuffer(cloud.data, np.float32).reshape(cloud.width, cloud.point_step // 4)
        ids = np.frombuffer(cloud.data, np.uint32).reshape(floats.shape)[:, 5]
        self.assertEqual(len(set(ids)), len(ids))
        table = self.out / "packed" / "landmarks.csv"
        subprocess.run([rospy.get_param("~map_tool"), "export", self.out / "packed" / "flight.vmap", "--out", table], check=True)
        rows = np.loadtxt(table, delimiter=",", skiprows=1)
        # A file numbers its landmarks anew. The map goes on changing after a landmark was sent.
        apart_m = [np.linalg.norm(rows[:, 1:4] - point[:3], axis=1).min() for point in floats]
        print(f"{len(ids)} landmarks in the cloud, {len(rows)} in the map; apart: median {np.median(apart_m):.1e} m, "
              f"95 % {np.percentile(apart_m, 95):.1e} m")
        self.assertLess(abs(len(ids) - len(rows)), 0.2 * len(rows))
        self.assertLess(np.median(apart_m), 0.01)
        self.assertEqual(points_shown(self.all("landmark_markers")), cloud.width)
        texts = {message.markers[0].text.split(",")[0].split("\n")[0] for message in self.all("state_markers")}
        self.assertTrue(texts & {status.state_name.replace("_", " ") for status in self.all("status")}, texts)

    def test_d_features(self):
        features = self.all("features")
        self.assertGreater(len(features), self.images / 2)
        for message in features:
            self.assertIn(message.header.stamp.to_nsec(), self.of_stamp)
            self.assertEqual((message.width, message.height, message.header.frame_id), (640, 360, "camera"))
            bearings = np.array(message.bearing).reshape(-1, 3)
            self.assertTrue(0 < len(message.x) == len(message.y) == len(message.age) == len(bearings) <= 100)
            np.testing.assert_allclose(np.linalg.norm(bearings, axis=1), 1, atol=1e-5)
            self.assertEqual(len(message.descriptor) + len(message.track_id) + len(message.score), 0)
            self.assertLess(max(message.x), 640)
            self.assertLess(max(message.y), 360)
        self.assertGreater(max(max(m.age) for m in features), 3)
        image = self.all("debug_image")[-1]
        self.assertEqual((image.width, image.height, image.encoding), (640, 360, "bgr8"))
        self.assertGreater(np.count_nonzero(np.frombuffer(image.data, np.uint8)), 1000)

    def test_e_status(self):
        self.assertIsNotNone(self.silent_at_first)
        self.assertIn("telemetry_address", self.silent_at_first.reason)
        by_stamp = {s.header.stamp.to_nsec(): s for s in self.flown}
        for answer in self.valid:
            status = by_stamp[answer[STAMP_NS]]
            self.assertEqual((status.state, status.landmarks), (STATES[answer[STATE]], answer[COUNTS][2]))
            self.assertAlmostEqual(status.deviation, np.sqrt(np.mean(answer[DEVIATION][:3] ** 2)))
        last = self.flown[-1]
        self.assertEqual((last.state, last.images, last.landmarks), (Status.ENDED, self.images, self.answers[-1][COUNTS][2]))
        self.assertEqual(last.dropped_bad_message + last.dropped_stamp + last.dropped_queue + last.restarts, 0)
        # The flight's stamps are not of today, though the parameter says so.
        self.assertIsNotNone(self.diagnostic("vslam", lambda s: any(v.key == "clocks" and "same_clock" in v.value for v in s.values)))

    def test_f_an_unknown_clock_is_found(self):
        """Each answer is there, too, where the controller listens; its stamps by the workstation's time."""
        poses = self.other["pose"].all()
        self.assertEqual(len(poses), len(self.valid))
        stamps = [p.header.stamp.to_nsec() for p in poses]
        offsets = [ours - answer[STAMP_NS] for ours, answer in zip(stamps, self.valid)]
        self.assertTrue(all(a < b for a, b in zip(stamps, stamps[1:])))
        self.assertTrue(all(a >= b for a, b in zip(offsets, offsets[1:])))  # the fastest arrival counts
        self.assertTrue(self.began_s < stamps[0] * 1e-9 and stamps[-1] * 1e-9 < self.ended_s)
        for pose, answer in zip(poses, self.valid):
            np.testing.assert_allclose(numbers(pose.pose.pose)[:3], answer[FUSED][:3], atol=1e-12)
        self.assertEqual({p.header.frame_id for p in poses}, {"other/map"})

    def test_g_damage_is_counted_and_told(self):
        sender = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        good = (self.out / "packed" / "poses.bin").read_bytes()[-204:]
        damaged = good[:50] + bytes([good[50] ^ 1]) + good[51:]
        for datagram in (b"", b"noise", good[:100], damaged, os.urandom(3000)):
            sender.sendto(datagram, ("127.0.0.1", self.port))
        status = self.topics["status"].wait(lambda s: s.dropped_bad_message == 5)
        self.assertIsNotNone(status)
        told = self.diagnostic("vslam", lambda s: any(v.key == "datagrams corrupted" and v.value == "1" for v in s.values))
        self.assertIsNotNone(told)
        self.assertEqual(self.all("status")[-1].images, self.images)

    def test_h_states_without_a_pose_then_silence(self):
        program = subprocess.Popen(self.command() + ["--frames", "/dev/none_of_this_name"], stderr=subprocess.DEVNULL)
        status = self.topics["status"].wait(lambda s: s.state == Status.CAMERA_LOST)
        self.assertIsNotNone(status)
        self.assertEqual(status.restarts, 1)
        self.assertIsNotNone(self.diagnostic("vslam", lambda s: "camera_lost" in s.message))
        program.terminate()
        program.wait()
        program = subprocess.Popen(self.command() + ["--frames", "-"], stdin=subprocess.PIPE)
        status = None
        for frame in self.frames:  # until its numbers are no longer taken for late ones of the program before
            program.stdin.write(frame)
            program.stdin.flush()
            status = self.topics["status"].wait(lambda s: s.state == Status.CONTROLLER_SILENT, 0.2)
            if status:
                break
        self.assertIsNotNone(status)
        self.assertEqual(status.header.frame_id, "map")
        before = len(self.all("status"))
        program.kill()
        program.wait()
        end_s = time.monotonic() + TIMEOUT_S
        while time.monotonic() < end_s and self.all("status")[-1].state != Status.DRONE_SILENT:
            time.sleep(0.02)
        self.assertGreater(len(self.all("status")), before)
        self.assertEqual(self.all("status")[-1].state, Status.DRONE_SILENT)
        silent = self.diagnostic("vslam", lambda s: "drone_silent" in s.message and "answers" in str(s.values) and
                                 s.level == DiagnosticStatus.ERROR)
        self.assertIsNotNone(silent)
        self.assertEqual(len(self.all("pose")), self.images)

    def test_i_only_answers_tell_the_time(self):
        """Telemetry of a far time, of another program perhaps, does not mute the answers that follow."""
        sender = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)

        def send(body):
            sender.sendto(body + struct.pack("<I", zlib.crc32(body)), ("127.0.0.1", self.port))

        send(struct.pack("<4sBBHIqIIHH", b"VSLM", 1, 3, 36, 10**6, 39 * 10**17, 0, 0, 0, 0))
        self.assertIsNotNone(self.diagnostic("vslam", lambda s: any(
            v.key == "telemetry without the answer of its image" and int(v.value) > 0 for v in s.values)))
        answer = bytearray((self.out / "packed" / "poses.bin").read_bytes()[-2 * 204:-204][:-4])  # before ENDING
        stamp_ns = self.valid[-1][STAMP_NS] + 10**9
        struct.pack_into("<I", answer, 8, 10**6)
        struct.pack_into("<q", answer, 20, stamp_ns)
        send(bytes(answer))
        self.assertIsNotNone(self.topics["pose"].wait(lambda p: p.header.stamp.to_nsec() == stamp_ns))


if __name__ == "__main__":
    rostest.rosrun("ardrone_vslam", "onboard_bridge", OnboardBridge)
