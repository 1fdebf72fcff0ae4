# SPDX-License-Identifier: BSD-3-Clause
"""debian/ says the same as package.xml, CMake and scripts/install_dependencies."""

import pathlib
import re
import shutil
import subprocess
import tempfile
import unittest
import xml.etree.ElementTree as ElementTree

from sources import ROOT

PACKAGE = ElementTree.parse(ROOT / "package.xml").getroot()
SOURCE, RUNTIME, DEVELOPMENT = "Source: ardrone-vslam", "Package: ardrone-vslam", "Package: ardrone-vslam-dev"
PACKAGING = {"debhelper-compat", "dh-python", "ninja-build"}  # what builds the packages, not the programs
ESSENTIAL = {"g++", "make"}  # build-essential, which no package names
# Names of package.xml that Debian has otherwise than most.
DEBIAN_NAMES = {"eigen": "libeigen3-dev", "nlohmann-json-dev": "nlohmann-json3-dev", "tf2": "libtf2-ros-dev",
                "nodelet": "libnodelet-dev", "message_runtime": "ros-message-runtime", "rosbag": "librosbag-dev",
                "zlib": "zlib1g-dev", "dynamic_reconfigure": "libdynamic-reconfigure-config-init-mutex-dev"}


def text_of(path):
    return (ROOT / path).read_text(encoding="utf-8")


def listed(field, paragraph):
    """The names in a field of debian/control, without versions and without what debhelper puts in."""
    text = next(text for text in text_of("debian/control").split("\n\n") if text.startswith(paragraph + "\n"))
    names = re.search(rf"^{field}:((?:\n .*)+)", text, re.MULTILINE)[1]
    return set(re.findall(r"^ ([\w.+-]+)", names, re.MULTILINE))


def array(name):
    """An array of scripts/install_dependencies."""
    text = re.search(rf"^{name}=\(([^)]*)\)", text_of("scripts/install_dependencies"), re.MULTILINE)[1]
    return set(re.sub("#.*", "", text).split())


def named(*tags):
    return {element.text for tag in tags for element in PACKAGE.findall(tag)}


def missing(names, packages):
    """Those names of package.xml that none of Debian's packages stands for."""
    def is_there(name):
        debian = name.replace("_", "-")
        known = {DEBIAN_NAMES.get(name), name, f"lib{debian}-dev", f"{debian}-dev", f"ros-{debian}", f"python3-{debian}"}
        return not known.isdisjoint(packages)
    return sorted(name for name in names if not is_there(name))


class PackagingTest(unittest.TestCase):
    def test_built_with_what_install_dependencies_installs(self):
        self.assertEqual(listed("Build-Depends", SOURCE) - PACKAGING, array("build_packages") - ESSENTIAL)
        self.assertLessEqual(PACKAGING - {"debhelper-compat"} | {"debhelper"}, array("packaging_packages"))

    def test_runs_with_what_install_dependencies_installs(self):
        self.assertEqual(listed("Depends", RUNTIME), array("runtime_packages"))
        self.assertIn("rviz", listed("Suggests", RUNTIME))

    def test_package_xml_is_covered(self):
        self.assertEqual(missing(named("buildtool_depend", "build_depend", "depend"), listed("Build-Depends", SOURCE)), [])
        # message_runtime: of C++, which is compiled in; of Python, which the messages' packages bring.
        self.assertEqual(missing(named("exec_depend") - {"message_runtime"}, listed("Depends", RUNTIME)), [])

    def test_dev_part_brings_what_its_cmake_configuration_asks_for(self):
        exported = re.search(r"CATKIN_DEPENDS (.*?)\n  DEPENDS EIGEN3\)", text_of("cmake/ros.cmake"), re.DOTALL)[1].split()
        self.assertIn("roscpp", exported)
        self.assertEqual(missing([*exported, "eigen", "catkin"], listed("Depends", DEVELOPMENT)), [])

    def test_plugin_is_found_without_an_environment(self):
        # Debian's pluginlib puts /usr/lib/x86_64-linux-gnu/ before it.
        self.assertEqual(re.findall(r'<library path="([^"]*)"', text_of("nodelet_plugins.xml")), ["libardrone_vslam_nodelets", "libardrone_vslam_camera_nodelet"])

    def test_maintainer_is_package_xmls(self):
        maintainer = PACKAGE.find("maintainer")
        self.assertIn(f"\nMaintainer: {maintainer.text} <{maintainer.get('email')}>\n", text_of("debian/control"))

    def test_license_is_the_same(self):
        of_debian = re.sub(r"^ \.$", "", text_of("debian/copyright").rsplit("\nLicense: BSD-3-Clause\n", 1)[1].split("\nLicense:")[0], flags=re.MULTILINE)
        self.assertIn(of_debian.split(), [text_of("LICENSE").split("All rights reserved.")[1].split()])

    def test_one_version(self):
        version = PACKAGE.findtext("version")
        self.assertEqual(re.search(r"^project\(\S+ VERSION (\S+)", text_of("CMakeLists.txt"), re.MULTILINE)[1], version)
        self.assertEqual(re.search(r"^(\d\S+) \(.*\)$", text_of("CHANGELOG.rst"), re.MULTILINE)[1], version)
        changelog = subprocess.run([ROOT / "scripts/make_deb", "--changelog"], capture_output=True, text=True, check=True).stdout
        self.assertTrue(changelog.startswith(f"ardrone-vslam ({version}) "), changelog)
        if shutil.which("dpkg-parsechangelog"):
            parsed = subprocess.run(["dpkg-parsechangelog", "-l-", "-S", "Version"], input=changelog, capture_output=True, text=True, check=True)
            self.assertEqual((parsed.stdout.strip(), parsed.stderr), (version, ""))

    def test_a_version_without_its_day_is_refused(self):
        version = PACKAGE.findtext("version")
        for heading, fault in (("0.0.1 (2026-11-23)", "has no heading"), (f"{version} (soon)", "soon is no date")):
            with tempfile.TemporaryDirectory() as folder:
                for path in ("scripts/make_deb", "scripts/build_lib.sh", "debian/control", "package.xml"):
                    (pathlib.Path(folder) / path).parent.mkdir(exist_ok=True)
                    shutil.copy(ROOT / path, f"{folder}/{path}")
                (pathlib.Path(folder) / "CHANGELOG.rst").write_text(heading + "\n")
                done = subprocess.run([f"{folder}/scripts/make_deb", "--changelog"], capture_output=True, text=True, check=False)
                self.assertEqual((done.returncode, done.stdout), (1, ""))
                self.assertIn(fault, done.stderr)


if __name__ == "__main__":
    unittest.main()
