# SPDX-License-Identifier: BSD-3-Clause
"""What replay, simulate_landmarks and record_run leave in a folder."""

import csv
import os
import re
from dataclasses import dataclass

import numpy as np

from .faults import InputFault
from .input_files import open_input, read_json
from .read_text import read_tum
from .trajectory import Trajectory


@dataclass(frozen=True)
class RunFolder:
    """One run. What the folder lacks is None or empty."""

    folder: str
    fused: Trajectory
    odometry: Trajectory
    truth: Trajectory
    frames: dict  # column of frames.csv -> array; empty cells are NaN
    landmarks: dict  # the same of landmarks.csv
    summary: dict  # summary.json
    refined: Trajectory = None  # replay --refine

    def column(self, name):
        """None when there is none, or it is empty."""
        values = self.frames.get(name)
        return None if values is None or not np.isfinite(values).any() else values

    def stages(self):
        """{stage: milliseconds of each frame}, in the order of the work, without the sum."""
        return {name[3:]: values for name, values in self.frames.items() if name.startswith("ms_") and name != "ms_total"}


def read_columns(path):
    """A csv file of numbers as {column: array}; columns with words are left out."""
    try:
        with open_input(path, newline="") as file:
            rows = list(csv.reader(file))
    except (OSError, UnicodeDecodeError, csv.Error) as error:
        raise InputFault(f"{path}: cannot be read ({error}); make the run again") from None
    if not rows:
        return {}
    names, rows = rows[0], rows[1:]
    columns = {name: np.full(len(rows), np.nan) for name in names}
    with_words = {}  # column -> the first line
    for number, row in enumerate(rows, start=2):
        if len(row) != len(names):
            raise InputFault(f"{path}:{number}: {len(row)} cells for {len(names)} columns; make the run again")
        for name, cell in zip(names, row):
            try:
                columns[name][number - 2] = float(cell) if cell else np.nan
            except ValueError:
                with_words.setdefault(name, number)
    known_words = {"state", "match_method"}
    for name, number in with_words.items():
        if name not in known_words:
            raise InputFault(f"{path}:{number}: column {name} holds what is no number; make the run again")
    return {name: values for name, values in columns.items() if name not in known_words}


def read_summary(path):
    summary = read_json(path)
    if not isinstance(summary, dict):
        raise InputFault(f"{path}:1: is no JSON object; make the run again")
    return summary


def in_order(name):
    """seed_2 before seed_10."""
    return [int(part) if part.isdigit() else part for part in re.split(r"(\d+)", name)]


def runs_below(folder, depth=2):
    """The folder itself when it is a run's, else the runs in it: seed_N/ of replay --seeds, ESTIMATOR/seed_N/."""
    if os.path.exists(os.path.join(folder, "fused.tum")):
        return [folder]
    if depth == 0 or not os.path.isdir(folder):
        return []
    parts = sorted((name for name in os.listdir(folder) if os.path.isdir(os.path.join(folder, name))), key=in_order)
    return [run for name in parts for run in runs_below(os.path.join(folder, name), depth - 1)]


def find_runs(folder):
    if not os.path.isdir(folder):
        what = "is a file; name it by --truth or --estimate" if os.path.exists(folder) else "there is no such folder; check the path"
        raise InputFault(f"{folder}: {what}")
    runs = runs_below(folder)
    if not runs:
        raise InputFault(f"{folder}: holds no fused.tum; name a folder that replay, simulate_landmarks or record_run wrote")
    return runs


def read_frames(path):
    """frames.csv; a header alone counts as nothing."""
    frames = read_columns(path)
    if frames and "stamp_ns" not in frames:
        raise InputFault(f"{path}:1: no column stamp_ns; name a folder that replay or record_run wrote, or make the run again")
    return frames if frames and len(frames["stamp_ns"]) else {}


def read_run(folder):
    def read(name, reader, otherwise):
        path = os.path.join(folder, name)
        return reader(path) if os.path.exists(path) else otherwise

    return RunFolder(folder, read_tum(os.path.join(folder, "fused.tum")), read("odometry.tum", read_tum, None),
                     read("truth.tum", read_tum, None), read("frames.csv", read_frames, {}),
                     read("landmarks.csv", read_columns, {}), read("summary.json", read_summary, {}),
                     read("refined.tum", read_tum, None))
