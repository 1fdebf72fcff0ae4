# SPDX-License-Identifier: BSD-3-Clause
"""The faults of the campaign and what is expected of the nodelets in each."""
import os
import signal
from dataclasses import dataclass
from typing import Callable, Optional

import changes
from changes import each, stream

HARMLESS_M = 0.45  # largest error of a flight that goes on as if nothing had been; without a fault 0.23 to 0.34

UNTIL_FOUND = "until the fault is found the pose claims too much"


@dataclass
class Fault:
    name: str
    of: str  # images, odometry, ...
    what: str
    change: Callable = lambda items, _context: items
    largest_m: float = HARMLESS_M  # most that the pose is off
    of_odometry: float = 0  # or so many times what the odometry is off, where that is more
    state: str = ""  # is seen
    features: Optional[Callable] = None  # what becomes of a Features message in the window: (message, random)
    answered: float = 0.95  # share of the last fifth's images that have a pose
    log_lines: int = 60  # at most, of the nodelets
    quick: bool = False
    is_counted_anew: bool = False  # the mapper that counted is gone
    missed: str = ""  # why it is known not to be as expected
    is_loose: bool = False  # the nodelets are not required by their launch
    uses_clock: bool = False  # the nodelets' time is what /clock says


def set_up(name, what, change, **options):
    return Fault(name, "set-up", what, change, **{"state": "distrusted", "of_odometry": 1.1, **options})


# What happens to the nodelets and to the master

def reloaded(nodelet, class_name, topics):
    """Unloads a nodelet and loads it again while messages come."""
    def call(nodelets):
        nodelets.end_node(f"/vslam/{nodelet}")  # its loader, which unloads it
        nodelets.start("load", "rosrun", "nodelet", "nodelet", "load", f"ardrone_vslam/{class_name}", "/vslam/manager", "--no-bond",
                       f"__name:={nodelet}", "__ns:=/vslam", *(f"{name}:={topic}" for name, topic in topics.items()))
    return call


def master_restarted(nodelets):
    nodelets.kill("master")
    nodelets.start_master()


def manager_killed(nodelets):
    os.kill(nodelets.pid_of("/vslam/manager"), signal.SIGKILL)
    nodelets.wait_for_end("launch")  # its nodes are required
    nodelets.launch()


FAULTS = (
    Fault("none", "-", "no fault", quick=True),

    Fault("images_dropped", "images", "half of them are lost", stream(("image", "info"), changes.dropped(0.5))),
    Fault("images_stop", "images", "none in the window", stream(("image", "info"), changes.nothing)),
    Fault("images_twice", "images", "each comes twice", stream(("image", "info"), changes.twice)),
    Fault("images_swapped", "images", "the later of two comes first", stream(("image", "info"), changes.swapped)),
    Fault("images_delayed", "images", "come 0.3 s late, stamps right", stream(("image", "info"), changes.later(300_000_000))),
    Fault("images_in_bursts", "images", "ten at once", stream(("image", "info"), changes.bursts(20))),
    Fault("images_stuck", "images", "the same picture under new stamps", stream(("image",), changes.stuck), state="distrusted",
          largest_m=1.0, quick=True),
    Fault("black", "images", "black", changes.grey(0), state="blind"),
    Fault("white", "images", "white", changes.grey(255), state="blind"),
    Fault("saturated", "images", "contrast times 8, cut off", changes.pixels(changes.saturated)),
    Fault("half_covered", "images", "half of the picture moves with the camera", changes.pixels(changes.half_covered), quick=True),
    Fault("noise", "images", "random pixels", changes.pixels(changes.noise), state="blind"),
    Fault("in_colour", "images", "rgb8 in mid-stream", each(("image",), changes.in_colour)),
    Fault("unknown_encoding", "images", "encoding foo8", each(("image",), changes.unknown_encoding)),
    Fault("cut_off", "images", "half of the bytes are missing", each(("image",), changes.cut_off)),
    Fault("cropped", "images", "another size, camera_info as well", each(("image", "info"), changes.cropped)),
    Fault("cropped_alone", "images", "another size than camera_info's", each(("image",), changes.cropped)),
    Fault("camera_info_zero", "images", "K and P zero", each(("info",), changes.calibration(0.0))),
    Fault("camera_info_nan", "images", "one number of each is none, all in turn", each(("info",), changes.calibration_field(changes.NAN))),
    Fault("camera_info_infinite", "images", "one number of each is infinite, all in turn", each(("info",), changes.calibration_field(changes.INFINITE))),
    Fault("other_images", "images", "pictures of another flight", stream(("image",), changes.of_other_flight("image")),
          largest_m=1.6, quick=True),

    Fault("odometry_nan", "odometry", "one number of each message is none, all in turn", each(("odometry",), changes.one_field(changes.NAN)), quick=True),
    Fault("odometry_infinite", "odometry", "one number of each message is infinite, all in turn", each(("odometry",), changes.one_field(changes.INFINITE))),
    Fault("odometry_dropped", "odometry", "nine of ten are lost", stream(("odometry",), changes.dropped(0.9))),
    Fault("odometry_stops", "odometry", "none in the window", stream(("odometry",), changes.nothing)),
    Fault("odometry_restarts", "odometry", "none in the window, then from the origin", changes.restarted_elsewhere, state="searching_map"),
    Fault("odometry_twice", "odometry", "each comes twice", stream(("odometry",), changes.twice)),
    Fault("odometry_swapped", "odometry", "the later of two comes first", stream(("odometry",), changes.swapped)),
    Fault("odometry_late", "odometry", "comes 0.2 s late, stamps right", stream(("odometry",), changes.later(200_000_000))),
    Fault("odometry_jumps", "odometry", "by 2 m at once", changes.odometry_jump(2)),
    Fault("odometry_frozen", "odometry", "the same pose under new stamps", stream(("odometry",), changes.frozen), largest_m=3.5),
    Fault("other_odometry", "odometry", "that of another flight", stream(("odometry",), changes.of_other_flight("odometry")), state="searching_map",
          largest_m=1.5),

    Fault("clock_ahead", "clock", "all stamps 1000 s on", changes.stamps_moved(1000), largest_m=150),
    Fault("clock_back", "clock", "all stamps 5 s back", changes.stamps_moved(-5)),
    Fault("one_image_ahead", "clock", "one image stamped 1000 s ahead", changes.stamps_moved(1000, "image")),
    Fault("one_odometry_ahead", "clock", "one odometry message stamped 1000 s ahead", changes.stamps_moved(1000, "odometry")),
    Fault("played_again", "clock", "a bag in a loop", changes.played_again),
    Fault("clock_loops", "clock", "a bag in a loop with /clock", changes.with_clock(changes.played_again), uses_clock=True),

    Fault("tf_late", "tf", "the camera's mounting comes late", stream(("tf_static",), changes.later(8_000_000_000), whole_flight=True)),
    Fault("tf_never", "tf", "there is none", stream(("tf_static",), changes.nothing, whole_flight=True), answered=0, state="waiting_for_extrinsics"),
    Fault("tf_nan", "tf", "a quaternion that is not a number", each(("tf_static",), changes.mounting((changes.NAN, 0, 0, 0)), True), answered=0,
          state="waiting_for_extrinsics"),
    Fault("tf_infinite", "tf", "a position that is infinite", each(("tf_static",), changes.mounting_position(changes.INFINITE), True), answered=0,
          state="waiting_for_extrinsics"),

    Fault("features_nan", "features", "every other message holds a number that is none", features=changes.feature_field(changes.NAN)),
    Fault("wrong_matches_20", "features", "a fifth of the tracks and descriptors exchanged", features=changes.wrong_matches(0.2)),
    Fault("wrong_matches_40", "features", "two fifths exchanged", features=changes.wrong_matches(0.4)),
    Fault("wrong_matches_60", "features", "three fifths exchanged", features=changes.wrong_matches(0.6), quick=True),

    set_up("yaw_180", "the camera looks back", each(("tf_static",), changes.mounting((0, 0, 0, 1)), True), quick=True),
    set_up("roll_90", "the camera is turned about its axis", each(("tf_static",), changes.mounting((0.7071068, 0.7071068, 0, 0)), True)),
    set_up("mirrored", "mirrored images", changes.pixels(changes.mirrored, True)),
    set_up("focal_0.7", "focal length times 0.7", each(("info",), changes.focal_length(0.7), True), missed=UNTIL_FOUND),
    set_up("images_late", "stamps of images 0.3 s late", changes.images_stamped(0.3)),
    set_up("yaw_mirrored", "the odometry's yaw is mirrored", each(("odometry",), changes.mirrored_yaw, True), largest_m=10),

    Fault("tracker_reloaded", "nodelets", "unloaded and loaded in flight", changes.done_at(0.4, reloaded("tracker", "TrackerNodelet", {
        "image": "/camera/image_raw", "camera_info": "/camera/camera_info"})), is_loose=True, is_counted_anew=True),
    Fault("mapper_reloaded", "nodelets", "unloaded and loaded in flight", changes.done_at(0.4, reloaded("mapper", "MapperNodelet", {
        "odometry": "/odometry"})), is_loose=True, is_counted_anew=True, largest_m=0.7, quick=True),
    Fault("manager_killed", "nodelets", "kill -9; the launch ends and is started again", changes.done_at(0.4, manager_killed),
          is_counted_anew=True, largest_m=0.7),
    Fault("master_restarted", "nodelets", "kill -9 of the master, another one at its address", changes.done_at(0.4, master_restarted)),
)
