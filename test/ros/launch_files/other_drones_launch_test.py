# SPDX-License-Identifier: BSD-3-Clause
"""The launch files for other drones, resolved by roslaunch's own loader: drivers' topics arrive at the nodelets, what is set are parameters that
there are, and driver:=true hands the driver's launch file arguments that it has."""

import functools
import os
import pathlib
import re
import subprocess
import tempfile
import unittest

import roslaunch.config

ROOT = pathlib.Path(__file__).resolve().parents[3]
# Of each: the tracker's image and camera_info, the mapper's odometry, the mapper's map_frame.
DRONES = {
    "bebop": ("/bebop/image_raw", "/bebop/camera_info", "/bebop/odom", "map"),
    "tello": ("/tello/camera/image_raw", "/tello/camera/camera_info", "/tello/odom", "map"),
    "mavros": ("/camera/image_raw", "/camera/camera_info", "/mavros/local_position/odom", "vslam_map"),
}
# All launch files that start a mapper, and the arguments that each must have.
STARTS_A_MAPPER = {
    "vslam": ("camera:=/front", "odometry:=/odom"), "camera": ("odometry:=/odom",), "replay": ("bag:=flight.bag",), "ardrone": (),
    **{drone: () for drone in DRONES},
}
SET_BY_LAUNCH = {"arguments", "driver_arguments", "tf_prefix"}
# Arguments that the drivers' own launch files have, of those that ours hand on.
DRIVERS = {
    "bebop_driver": {"bebop_node": ["ip", "drone_type"]},
    "mavros": {"px4": ["fcu_url"], "apm": ["fcu_url"]},
}


def launch_file(drone):
    return str(ROOT / "launch" / (drone + ".launch"))


@functools.lru_cache(maxsize=None)
def load(drone, *arguments):
    return roslaunch.config.load_config_default([(launch_file(drone), list(arguments))], None)


def load_all(drone):
    """With all that can be switched on."""
    return load(drone, "map:=house.vmap", "localise_only:=true", "odometry_fusion:=true", *(["use_range:=true", "fcu:=apm"] if drone == "mavros" else []))


def nodes_of(config):
    return {node.name: node for node in config.nodes}


def remaps_of(config, name):
    return dict(nodes_of(config)[name].remap_args)


def params_of(config, ns="/vslam/"):
    """Of the nodelets, by their name below ns."""
    return {name[len(ns):]: param.value for name, param in config.params.items() if name.startswith(ns)}


def known_parameters():
    """{(section, name)} of docs/parameters.md."""
    rows = re.findall(r"^\| `(\w+)` \| ([\w, ]+) \|", (ROOT / "docs/parameters.md").read_text(encoding="utf-8"), re.MULTILINE)
    return {(section, name) for name, sections in rows for section in sections.split(", ")}


def install_drivers(folder):
    """Packages with the names, launch files and arguments of the drivers."""
    for package, files in DRIVERS.items():
        launch = pathlib.Path(folder, package, "launch")
        launch.mkdir(parents=True)
        (launch.parent / "package.xml").write_text(
            f'<package format="2"><name>{package}</name><version>1.0.0</version><description>a stand-in</description>'
            '<maintainer email="a@b.cc">a</maintainer><license>BSD</license></package>')
        for name, arguments in files.items():
            declared = "".join(f'<arg name="{argument}" default=""/>' for argument in arguments)
            used = "".join(f'<param name="{argument}" value="$(arg {argument})"/>' for argument in arguments)
            (launch / (name + ".launch")).write_text(f"<launch>{declared}<group ns='{package}/{name}'>{used}</group></launch>")


class OtherDronesLaunchTest(unittest.TestCase):
    def test_the_drivers_topics_reach_the_nodelets(self):
        for drone, (image, camera_info, odometry, map_frame) in DRONES.items():
            with self.subTest(drone):
                config = load(drone)
                tracker = remaps_of(config, "tracker")
                self.assertEqual((tracker["image"], tracker["camera_info"]), (image, camera_info))
                self.assertEqual(remaps_of(config, "mapper")["odometry"], odometry)
                self.assertEqual(params_of(config)["mapper/map_frame"], map_frame)
                self.assertNotIn("odometry_fusion", nodes_of(config))
                self.assertEqual(remaps_of(load_all(drone), "odometry_fusion")["odometry"], odometry)

    def test_what_is_set_are_parameters_that_there_are(self):
        known = known_parameters()
        self.assertGreater(len(known), 60)
        for drone in DRONES:
            params = params_of(load_all(drone))
            self.assertIn("mapper/estimator", params, "the configuration is loaded")
            self.assertEqual((params["mapper/map_file"], params["mapper/localise_only"]), ("house.vmap", True))
            unknown = [name for name in params if name not in SET_BY_LAUNCH and tuple(name.split("/")) not in known]
            self.assertEqual(unknown, [], drone)

    def test_localise_only_overrides_the_configuration_both_ways(self):
        with tempfile.TemporaryDirectory() as folder:
            config = pathlib.Path(folder, "drone.yaml")
            config.write_text("mapper:\n  localise_only: true\n")
            for name, arguments in STARTS_A_MAPPER.items():
                for given, expected in [("", True), ("false", False)] + [("true", True), ("1", True)] * (name == "vslam"):
                    with self.subTest(name, given=given):
                        params = params_of(load(name, *arguments, f"config:={config}", f"localise_only:={given}", "map:=house.vmap", "autosave_s:=5"))
                        self.assertIs(params["mapper/localise_only"], expected)
                        self.assertEqual((params["mapper/map_file"], params["mapper/autosave_s"]), ("house.vmap", 5))

    def test_cameras_mounting_is_sent_where_the_driver_sends_none(self):
        def sent(config):
            return [node.args.split()[-2:] for node in config.nodes if node.type == "static_transform_publisher"]
        self.assertEqual(sent(load("bebop")), [])
        self.assertEqual(sent(load("tello")), [["tello/base_link", "tello/camera_front"]])
        self.assertEqual(sent(load("tello", "mounting:=none")), [])
        self.assertEqual(sent(load("mavros")), [])
        self.assertEqual(sent(load("mavros", "mounting:=0 0 0 -1.5708 0 -1.5708", "camera_frame:=eye")), [["base_link", "eye"]])

    def test_heights_come_from_the_autopilots_sensor(self):
        for config, topic, used in [(load("mavros"), "hrlv_ez4_pub", None), (load_all("mavros"), "rangefinder_pub", True)]:
            self.assertEqual(remaps_of(config, "mapper")["range"], "/mavros/distance_sensor/" + topic)
            self.assertEqual(params_of(config).get("mapper/use_range"), used)

    def roslaunch(self, show, drone, *arguments, packages=None):
        # rospack remembers in ROS_HOME what it found.
        with tempfile.TemporaryDirectory() as home:
            path = ":".join(filter(None, [packages, os.environ.get("ROS_PACKAGE_PATH")]))
            return subprocess.run(["roslaunch", show, launch_file(drone), *arguments], stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                                  text=True, timeout=60, env={**os.environ, "ROS_PACKAGE_PATH": path, "ROS_HOME": home})

    def test_the_driver_is_started_with_arguments_that_it_has(self):
        with tempfile.TemporaryDirectory() as packages:
            install_drivers(packages)
            for drone, arguments, params in [
                    ("bebop", ["ip:=10.0.0.1"], ["/bebop_driver/bebop_node/ip: 10.0.0.1", "/bebop_driver/bebop_node/drone_type: bebop2"]),
                    ("mavros", ["fcu_url:=udp://:1@"], ["/mavros/px4/fcu_url: udp://:1@"]),
                    ("mavros", ["fcu:=apm"], ["/mavros/apm/fcu_url: /dev/ttyACM0:57600"])]:
                done = self.roslaunch("--dump-params", drone, "driver:=true", *arguments, packages=packages)
                self.assertEqual(done.returncode, 0, done.stdout)
                for param in params:
                    self.assertIn(param, done.stdout)

    def test_what_cannot_be_is_named(self):
        for drone, arguments, said in [
                ("bebop", ["driver:=yes"], "driver:=yes: it is a switch: give true or false"),
                ("bebop", ["driver:=true"], "driver:=true: the package bebop_driver is not installed"),
                ("mavros", ["driver:=1"], "driver:=true: the package mavros is not installed"),
                ("mavros", ["use_range:=2"], "use_range:=2: it is a switch"),
                ("mavros", ["fcu:=betaflight"], "fcu:=betaflight: there is no autopilot of this name: give px4 or apm")]:
            done = self.roslaunch("--nodes", drone, *arguments)
            self.assertEqual(done.returncode, 1, arguments)
            self.assertIn(said, done.stdout)

    def test_each_says_that_it_is_untried(self):
        for drone in DRONES:
            text = " ".join(pathlib.Path(launch_file(drone)).read_text(encoding="utf-8").split())
            self.assertIn("Not tried with a real drone", text)
            self.assertIn("docs/other_drones.md", text)


if __name__ == "__main__":
    unittest.main()
