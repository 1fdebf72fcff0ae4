# SPDX-License-Identifier: BSD-3-Clause
"""Trajectories in TUM's and KITTI's text formats."""

import math
import re

import numpy as np

from .faults import InputFault, reason
from .input_files import open_input
from .trajectory import NS_PER_S, Trajectory, nearest_rotations, rotations_of_quaternions

TUM_VALUES, KITTI_VALUES = 8, 12


def stamp_ns(text):
    """Seconds to nanoseconds, digit by digit. Raises ValueError."""
    match = re.fullmatch(r"([+-]?)(\d+)(?:\.(\d*))?", text)
    if not match:
        seconds = float(text)  # with an exponent: no more digits than a double has
        if not abs(seconds) < 9e9:
            raise ValueError(text)
        return round(seconds * NS_PER_S)
    sign, seconds, fraction = match.groups()
    if len(seconds) > 10:
        raise ValueError(text)
    value = int(seconds) * NS_PER_S + int(((fraction or "") + "000000000")[:9])
    return -value if sign == "-" else value


def lines_of(path):
    """(number, words) of each line that is more than a comment."""
    try:
        with open_input(path) as file:
            for number, line in enumerate(file, start=1):
                words = line.split("#", 1)[0].split()
                if words:
                    yield number, words
    except UnicodeDecodeError:
        raise InputFault(f"{path}: is no text; name a TUM or KITTI trajectory, or a bag (*.bag)") from None
    except OSError as error:
        raise InputFault(f"{path}: cannot be read ({reason(error)}); check the path") from None


def fault(path, number, what):
    return InputFault(f"{path}:{number}: {what}; correct or remove the line")


def numbers(path, number, words):
    try:
        values = [float(word) for word in words]
    except ValueError:
        values = [math.nan]
    if not all(math.isfinite(value) for value in values):
        raise fault(path, number, f"'{' '.join(words)[:60]}' are not finite numbers")
    return values


def append_stamp(stamps, path, number, word):
    """Stamps must ascend."""
    try:
        stamps.append(stamp_ns(word))
    except ValueError:
        raise fault(path, number, f"the stamp '{word}' is no number") from None
    if len(stamps) > 1 and stamps[-1] <= stamps[-2]:
        raise fault(path, number, f"the stamp {word} s does not come after the one before")


def read_times(path):
    """A stamp [s] a line, ascending; nanoseconds."""
    stamps = []
    for number, words in lines_of(path):
        append_stamp(stamps, path, number, words[0])
    return np.array(stamps, dtype=np.int64)


def is_kitti(path):
    """By the first line. Raises InputFault when it is neither's."""
    for number, words in lines_of(path):
        if len(words) in (TUM_VALUES, KITTI_VALUES):
            return len(words) == KITTI_VALUES
        raise InputFault(f"{path}:{number}: {len(words)} values; a TUM trajectory has 8 in each line (stamp tx ty tz qx qy qz qw), "
                         "KITTI's 12 (the rows of a 3 x 4 matrix); convert the file")
    raise InputFault(f"{path}: holds no pose; name another file")


def read_tum(path):
    stamps, values = [], []
    for number, words in lines_of(path):
        if len(words) != TUM_VALUES:
            raise fault(path, number, f"{len(words)} values where 8 are expected: stamp tx ty tz qx qy qz qw")
        append_stamp(stamps, path, number, words[0])
        row = numbers(path, number, words[1:])
        norm = math.hypot(*row[3:])
        if abs(norm - 1) > 0.01:
            raise fault(path, number, f"the quaternion's norm is {norm:.3g}, not 1")
        values.append(row[:3] + [part / norm for part in row[3:]])
    if not values:
        raise InputFault(f"{path}: holds no pose; name another file, or make the run again")
    values = np.array(values)
    return Trajectory(path, np.array(stamps, dtype=np.int64), values[:, :3], rotations_of_quaternions(values[:, 3:]))


def read_kitti(path, times=None):
    """With the stamps of a times.txt, or the poses' indices."""
    rows = []
    for number, words in lines_of(path):
        if len(words) != KITTI_VALUES:
            raise fault(path, number, f"{len(words)} values where 12 are expected: the rows of a 3 x 4 matrix")
        row = numbers(path, number, words)
        rotation = np.array(row).reshape(3, 4)[:, :3]
        if np.abs(rotation @ rotation.T - np.eye(3)).max() > 0.01 or np.linalg.det(rotation) < 0:
            raise fault(path, number, "the first three columns are no rotation")
        rows.append(row)
    matrices = np.array(rows).reshape(-1, 3, 4)
    stamps = np.arange(len(rows), dtype=np.int64) * NS_PER_S
    if times is not None:
        stamps = read_times(times)
        if len(stamps) != len(rows):
            raise InputFault(f"{path}: {len(rows)} poses for the {len(stamps)} stamps of {times}; a KITTI file has a line for each "
                             "image: name the times.txt that belongs to it by --times, or convert a part to TUM format")
    # Seven digits leave matrices that seem to turn by 0.03 degrees by themselves, which shows in r_rel.
    rotations = nearest_rotations(matrices[:, :, :3])
    return Trajectory(path, stamps, matrices[:, :, 3], rotations, has_time=times is not None, is_camera=True)
