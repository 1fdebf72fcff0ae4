# SPDX-License-Identifier: BSD-3-Clause
"""What evaluate_all runs: sequences x profiles x estimators, each with all its seeds."""

import json
import os
from dataclasses import dataclass

from .faults import InputFault, reason

ESTIMATORS = ("msckf", "thesis")
SEEDS = "1:3"
RATE_HZ = "20"  # of the AR.Drone's driver


@dataclass(frozen=True)
class Sequence:
    """Rendered by make_world with `flight`, or else a folder that is there."""

    name: str
    profiles: tuple
    flight: tuple = ()
    folder: str = ""
    replay: tuple = ()  # further options
    bag: bool = False  # the flight is rendered into one: a folder holds no heights of the bottom camera
    changes: tuple = ()  # replay's options for similar flights and wrong set-ups, each with the first profile and estimator

    def output_in(self, folder):
        """What make_world writes and replay reads."""
        return os.path.join(folder, "flight.bag") if self.bag else folder


@dataclass(frozen=True)
class Job:
    """One call of replay: the seeds of one job share the tracking of the images."""

    sequence: Sequence
    profile: str
    estimator: str
    seeds: str
    settings: tuple = ()  # name=value over the configuration
    options: tuple = ()  # of replay, beside the sequence's

    def name(self):
        return " ".join((self.sequence.name, self.profile, self.estimator, *self.extras()))

    def parts(self):
        """Of its folder."""
        return self.sequence.name, self.profile, ",".join((self.estimator, *self.extras()))

    def extras(self):
        return (*self.settings, " ".join(self.options)) if self.options else self.settings


def rendered(flight, *profiles, seconds=None, changes=()):
    name = f"{flight}_{seconds}s" if seconds else flight
    length = ("--seconds", str(seconds)) if seconds else ()
    return Sequence(name, profiles, flight=(flight, "--rate", RATE_HZ, *length), changes=changes)


LARGER = ("--world-scale", "10")
QUICK = (rendered("laps", "drone", seconds=30, changes=(LARGER, ("--setup-fault", "mirrored"), ("--setup-fault", "late=0.3"))),
         rendered("hover", "drone", "hover", seconds=15, changes=(LARGER,)),
         rendered("corridor", "drone", seconds=20, changes=(LARGER, ("--setup-fault", "yaw=90"))))
# What config/kitti.yaml, which is for good yaw, lacks for wheels alone.
NO_GYROSCOPE = ("--set", "yaw_walk_deg_per_sqrt_m=0.6")
# laps_then_hover: one lap, then the odometry of a drone that has no help from its motion.
WHOLE_FLIGHTS = (rendered("laps", "drone", "harsh"), rendered("laps", "drone", seconds=120), rendered("laps_then_hover", "drone,hover@21.5"), rendered("mapping_turn", "drone"),
                 rendered("hover", "drone", "hover"), rendered("corridor", "drone"), rendered("corridor_turn", "drone"),
                 rendered("pure_yaw", "drone"), rendered("fast_blur", "drone"), rendered("dark", "drone"), rendered("table", "drone"),
                 rendered("moving_objects", "drone"))


def real_sequences(data):
    """Of ARDRONE_VSLAM_DATA, those that are there."""
    known = (Sequence("kitti_00_clip", ("wheel",), folder="kitti_00_clip"), Sequence("kitti_02_turn", ("wheel",), folder="kitti_02_turn"),
             Sequence("kitti_03", ("wheel",), folder="kitti_03"),
             Sequence("kitti_03_and_back", ("wheel",), folder="kitti_03", replay=("--ping-pong",)),
             Sequence("kitti_05_clip", ("wheel",), folder="kitti_05_clip"),
             *(Sequence(f"{name}_wheels", ("wheels",), folder=name, replay=NO_GYROSCOPE)
               for name in ("kitti_00_clip", "kitti_02_turn", "kitti_03", "kitti_05_clip")),
             Sequence("seven_scenes_kitchen", ("drone",), folder="seven_scenes_kitchen"))
    found = [(sequence, os.path.join(os.path.abspath(data), sequence.folder)) for sequence in known]
    return [Sequence(s.name, s.profiles, folder=path, replay=s.replay) for s, path in found if os.path.isdir(path)]


def kitti_sequences(folder):
    """The sequences below it that have a truth, or itself."""
    folder = os.path.abspath(folder)
    candidates = [folder] + ([os.path.join(folder, name) for name in sorted(os.listdir(folder))] if os.path.isdir(folder) else [])
    found = [path for path in candidates if os.path.isdir(f"{path}/image_0") and os.path.exists(f"{path}/poses.txt")]
    if not found:
        raise InputFault(f"{folder}: neither it nor a folder in it holds image_0/ and poses.txt; README.md tells how KITTI is laid out")
    return [Sequence(f"kitti_{os.path.basename(path)}_of_user", ("wheel",), folder=path) for path in found]


def read_selection(path):
    """A list of {"name", "profiles", and "make_world": [flight, options], "bag": true or not, or "folder": PATH, "replay": [options]}."""
    try:
        with open(path, encoding="utf-8") as file:
            entries = json.load(file)
        if not isinstance(entries, list) or not entries:
            raise ValueError("no list with entries")
        base = os.path.dirname(os.path.abspath(path))
        sequences = [Sequence(e["name"], tuple(e["profiles"]), tuple(e.get("make_world", ())),
                              os.path.join(base, e["folder"]) if "folder" in e else "", tuple(e.get("replay", ())), bool(e.get("bag")))
                     for e in entries]
    except OSError as error:
        raise InputFault(f"{path}: cannot be read ({reason(error)}); check the path") from None
    except (ValueError, KeyError, TypeError) as error:
        raise InputFault(f'{path}: must be a JSON list of {{"name": ..., "profiles": [...], "make_world": [FLIGHT, ...] or "folder": PATH}} '
                         f"({error!r})") from None
    for sequence in sequences:
        if bool(sequence.flight) == bool(sequence.folder):
            raise InputFault(f"{path}: {sequence.name}: give either make_world or folder")
    return sequences


def check_names(sequences):
    names = [sequence.name for sequence in sequences]
    for name in names:
        if not name or "/" in name or "|" in name or name in (".", ".."):
            raise InputFault(f"'{name}': is no name for a sequence, as it becomes a folder and a cell of a table; name it otherwise")
        if names.count(name) > 1:
            raise InputFault(f"{name}: there are two sequences of that name; name one otherwise")


def chosen(values, wanted, what):
    """Those that were asked for; all when none were."""
    unknown = [name for name in wanted or () if name not in values]
    if unknown:
        raise InputFault(f"{what}: there is no {unknown[0]}; here are {', '.join(dict.fromkeys(values))}")
    return [value for value in dict.fromkeys(values) if not wanted or value in wanted]


def jobs_of(sequences, seeds=SEEDS, only_sequences=None, only_profiles=None, only_estimators=None):
    check_names(sequences)
    names = chosen([s.name for s in sequences], only_sequences, "--sequences")
    sequences = [s for s in sequences if s.name in names]
    profiles = chosen([profile for s in sequences for profile in s.profiles], only_profiles, "--profiles")
    estimators = chosen(ESTIMATORS, only_estimators, "--estimators")
    plain = [Job(s, profile, estimator, seeds) for s in sequences for profile in s.profiles if profile in profiles
             for estimator in estimators]
    return plain + [Job(s, s.profiles[0], ESTIMATORS[0], seeds, options=change) for s in sequences for change in s.changes
                    if s.profiles[0] in profiles and ESTIMATORS[0] in estimators]
