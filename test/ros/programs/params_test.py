#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Wrong parameters: a node does not start, and says all that is wrong at once; unknown ones are
only warned of, with the name that was meant."""
import os
import signal
import socket
import subprocess
import tempfile
import unittest

import rospy
import rostest


def start(executable, *arguments):
    return subprocess.Popen([rospy.get_param("~" + executable), *arguments],
                            stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                            env={**os.environ, "ROSCONSOLE_STDOUT_LINE_BUFFERED": "1"})


class Params(unittest.TestCase):
    def assert_refused(self, executable, arguments, said):
        process = start(executable, *arguments)
        output, _ = process.communicate(timeout=30)
        self.assertEqual(process.returncode, 1, output)
        for part in said:
            self.assertIn(part, output)

    def test_tracker_lists_all_faults(self):
        self.assert_refused("tracker_node", [
            "__name:=bad_tracker", "_cell_size_px:=high", "_features_per_frame:=10.5",
            "_image_transport:=none", "_threshold_min:=0", "_rectified:=1"], [
                "/bad_tracker/cell_size_px is 'high' but must be a whole number",
                "/bad_tracker/features_per_frame is '10.5' but must be a whole number",
                "/bad_tracker/image_transport is 'none' but must be one of: raw, compressed",
                "threshold_min is 0 but must be between 1 and 35",
                "/bad_tracker/rectified is '1' but must be true or false"])

    def test_mapper_lists_all_faults(self):
        self.assert_refused("mapper_node", [
            "__name:=bad_mapper", "_odometry_wait_s:=-1", "_estimator:=constraint", "_image_time_offset_s:=late"], [
                "odometry_wait_s is -1 but must be between 0 and 60",
                "/bad_mapper/image_time_offset_s is 'late' but must be a number or auto",
                "/bad_mapper/estimator is 'constraint' but must be one of: thesis, msckf, odometry; constraint is called msckf now"])

    def test_odometry_fusion_lists_all_faults(self):
        self.assert_refused("odometry_fusion_node", [
            "__name:=bad_fusion", "_odometry_buffer_s:=0", "_scale_sigma:=much"], [
                "odometry_buffer_s is 0 but must be between 0.1 and 600",
                "/bad_fusion/scale_sigma is 'much' but must be a number"])

    def test_onboard_bridge_names_what_it_cannot_do(self):
        self.assert_refused("onboard_bridge_node", [
            "__name:=bad_bridge", "_transform_tolerance_s:=-1", "_same_clock:=1"], [
                "transform_tolerance_s is -1 but must be between 0 and 10",
                "/bad_bridge/same_clock is '1' but must be true or false"])
        self.assert_refused("onboard_bridge_node", ["__name:=bad_camera", "_camera:=/none/of/this.yaml"], ["camera: ", "/none/of/this.yaml: cannot be read; check the path"])
        self.assert_refused("onboard_bridge_node", ["__name:=bad_address", "_address:=drone"], ["drone:5582: is no address", "set `address` to"])
        with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as other:
            other.bind(("127.0.0.1", 0))
            self.assert_refused("onboard_bridge_node", ["__name:=bad_port", "_address:=127.0.0.1:%d" % other.getsockname()[1]],
                                ["cannot receive there", "a port that no other program receives at"])

    def test_unknown_parameter_is_warned_of(self):
        rospy.set_param("/observer_fusion/odometry_mode", "twist")
        process = start("tracker_node", "__name:=odd_tracker", "_thresold_min:=30", "_arc_length_px:=9",
                        "_queue_size:=7", "_image_time_offset_s:=auto")
        output = ""
        for line in process.stdout:
            output += line
            if "images from" in line:  # said last
                break
        process.send_signal(signal.SIGINT)  # what roslaunch sends
        output += process.communicate(timeout=30)[0]
        self.assertIn("/odd_tracker/thresold_min is not a parameter", output)
        self.assertIn("did you mean threshold_min?", output)
        self.assertIn("/odd_tracker/arc_length_px is not a parameter and has no effect; it is no parameter any more", output)
        self.assertIn("/observer_fusion is not a section and has no effect; observer_fusion is called odometry_fusion now", output)
        self.assertIn("queue_size=7", output)
        self.assertIn("threshold_min=8", output)
        self.assertIn("image_time_offset_s=auto", output)

    def test_launch_file_leaves_the_transport_to_the_configuration(self):
        with tempfile.NamedTemporaryFile("w", suffix=".yaml") as config:
            config.write("tracker: {image_transport: compressed}")
            config.flush()
            for argument, transport in [([], "compressed"), (["image_transport:=raw"], "raw")]:
                dumped = subprocess.run(
                    ["roslaunch", "--dump-params", rospy.get_param("~launch"), "config:=" + config.name, *argument],
                    stdout=subprocess.PIPE, text=True, timeout=30, check=True).stdout
                self.assertIn("/vslam/tracker/image_transport: " + transport, dumped)

    def test_launch_file_gives_odometry_fusion_the_mappers_frames(self):
        dumped = subprocess.run(
            ["roslaunch", "--dump-params", rospy.get_param("~launch"), "map_frame:=world", "base_frame:=body"],
            stdout=subprocess.PIPE, text=True, timeout=30, check=True).stdout
        for node in ["mapper", "odometry_fusion"]:
            self.assertIn("/vslam/%s/map_frame: world" % node, dumped)
            self.assertIn("/vslam/%s/base_frame: body" % node, dumped)

    def roslaunch(self, launch, *arguments):
        """Of a launch that ends by itself."""
        return subprocess.run(["roslaunch", rospy.get_param("~" + launch), *arguments],
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, timeout=30)

    def test_launch_arguments_that_cannot_be_are_named(self):
        for arguments, said in [
                (["fake:=yes"], "fake:=yes: it is a switch: give true or false"),
                (["rviz:=2"], "rviz:=2: it is a switch"),
                (["observer_mode:=twist"], "observer_mode:=twist: observer_mode is called odometry_mode now"),
                (["observer_fusion:=true"], "observer_fusion:=true: observer_fusion is called odometry_fusion now"),
                (["fake:=true", "driver:=1"], "driver:=true fake:=true: the one is a real drone's driver"),
                (["navdata:=/ardrone/navdata", "odometry_mode:=twist"],
                 "odometry_mode:=twist: navdata is used by odometry_mode navdata alone"),
                (["imu:=/imu/data", "odometry_mode:=twist"],
                 "odometry_mode:=twist: imu is used by odometry_mode navdata and imu alone")]:
            ended = self.roslaunch("ardrone_launch", *arguments)
            self.assertEqual(ended.returncode, 1, arguments)
            self.assertIn(said, ended.stdout)
            self.assertNotIn("started with pid", ended.stdout)

    def test_odometry_mode_navdata_listens_to_the_drivers_navdata(self):
        arguments = subprocess.run(
            ["roslaunch", "--args", "/vslam/mapper", rospy.get_param("~ardrone_launch"), "odometry_mode:=navdata"],
            stdout=subprocess.PIPE, text=True, timeout=30, check=True).stdout
        self.assertIn("navdata:=/ardrone/navdata imu:=/ardrone/imu", arguments)

    def test_an_imu_takes_the_odometrys_attitude_in_all_nodelets(self):
        for launch, arguments in [("launch", []), ("replay_launch", ["bag:=/a.bag"])]:
            dumped = self.roslaunch(launch, "--dump-params", "imu:=/imu/data", *arguments).stdout
            for node in ["mapper", "odometry_fusion"]:
                self.assertIn("/vslam/%s/odometry_mode: imu" % node, dumped)
            for node, remap in [("mapper", "imu:=/imu/data"), ("tracker", "attitude:=observer_odometry"),
                                ("odometry_fusion", "odometry:=observer_odometry")]:
                given = self.roslaunch(launch, "--args", "/vslam/" + node, "imu:=/imu/data", "odometry_fusion:=true", *arguments).stdout
                self.assertIn(remap, given)

    def test_the_fake_driver_begins_with_the_camera_that_is_asked_for(self):
        for camera, first in [("/ardrone", "front"), ("/ardrone/front", "front"), ("/ardrone/bottom", "bottom")]:
            self.assertIn("/ardrone_driver/camera: " + first,
                          self.roslaunch("ardrone_launch", "--dump-params", "fake:=true", "camera:=" + camera).stdout)

    def test_a_launch_ends_with_the_name_of_the_bad_parameter(self):
        """Also when only one of its nodelets cannot start."""
        with tempfile.NamedTemporaryFile("w", suffix=".yaml") as config:
            config.write("mapper: {estimator: kalman}")
            config.flush()
            ended = self.roslaunch("launch", "config:=" + config.name)
        self.assertIn("/vslam/mapper/estimator is 'kalman' but must be one of: thesis", ended.stdout)
        self.assertIn("REQUIRED process [vslam/mapper", ended.stdout)
        ended = self.roslaunch("launch", "ns:=other", "queue_size:=abc")
        self.assertIn("/queue_size is 'abc' but must be a whole number", ended.stdout)
        self.assertIn("REQUIRED process [other/", ended.stdout)

    def test_help_and_version(self):
        for executable in ["camera_node", "tracker_node", "mapper_node", "odometry_fusion_node", "onboard_bridge_node"]:
            for argument, code, said in [("--help", 0, "Usage"), ("--version", 0, "ardrone_vslam "),
                                         ("--bogus", 2, "--bogus")]:
                process = start(executable, argument)
                output, _ = process.communicate(timeout=30)
                self.assertEqual(process.returncode, code)
                self.assertIn(said, output)

    def test_a_name_that_cannot_be_is_wrong_usage(self):
        for executable in ["camera_node", "tracker_node", "mapper_node", "odometry_fusion_node", "onboard_bridge_node"]:
            for argument in ["__name:=a b", "image:=a b", "__ns:=/x y"]:
                process = start(executable, argument)
                output, _ = process.communicate(timeout=30)
                self.assertEqual(process.returncode, 2, output)
                self.assertIn("a name among the arguments cannot be", output)


if __name__ == "__main__":
    rospy.init_node("params_test")
    rostest.rosrun("ardrone_vslam", "params", Params)
