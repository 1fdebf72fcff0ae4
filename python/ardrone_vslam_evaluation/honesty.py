# SPDX-License-Identifier: BSD-3-Clause
"""scripts/evaluate_all --honesty: wrong set-ups, flown: whether they are found and named, and what becomes of the pose."""

import os

import numpy as np

from . import batch_jobs
from .batch_run import run_jobs
from .command import write
from .run_folder import read_summary

# replay's --setup-fault -> what the summary is to call it.
FAULTS = {"": "none", "yaw=180": "mounting", "yaw=90": "mounting", "yaw=-90": "mounting", "pitch=90": "mounting", "pitch=-90": "mounting",
          "roll=90": "mounting", "roll=-90": "mounting", "roll=180": "mounting", "mirrored": "mirrored", "late=0.3": "time_offset",
          "late=-0.3": "time_offset", "focal=0.7": "focal_length", "focal=1.5": "focal_length"}
FLIGHTS = (batch_jobs.rendered("laps", "drone", "hover", "harsh", seconds=30), batch_jobs.rendered("corridor", "drone", "hover", "harsh", seconds=20))
NOTE = """# Wrong set-ups

Written by `scripts/evaluate_all --honesty --update`, not by hand. Each row is a flight whose set-up was made wrong by `replay --setup-fault`
([what it does](evaluate.md#wrong-set-ups)); with no fault the camera is to be used. How faults are found is told in
[msckf.md](msckf.md#faults-of-the-set-up). `found` and `named` count seeds; `found after` is the time since the first image, in the median
and at the latest. Position errors without alignment.

| sequence | profile | fault | found | named | found after [s] | latest [s] | fused / odometry | worst | outside 3 sigma [%] |
| --- | --- | --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: |
"""


def sequences():
    data = os.environ.get("ARDRONE_VSLAM_DATA")
    real = [s for s in batch_jobs.real_sequences(data) if s.name == "seven_scenes_kitchen"] if data else []
    return [*FLIGHTS, *(batch_jobs.Sequence(s.name, ("drone", "hover", "harsh"), folder=s.folder, replay=("--frames", "0:500")) for s in real)]


def jobs_of(seeds):
    """All faults with `drone`; with the others only what is right, which must not be found wrong."""
    return [batch_jobs.Job(sequence, profile, "msckf", seeds, fault=fault) for sequence in sequences() for profile in sequence.profiles
            for fault in (FAULTS if profile == "drone" else ("",))]


def row_of(job, folder):
    runs = read_summary(os.path.join(folder, "summary.json"))["runs"]
    after = [run["setup_fault_found_s"] for run in runs if run["setup_fault_found_s"] is not None]
    named = sum(run["setup_fault"] == FAULTS[job.fault] for run in runs)
    ratios = [run["ratio"] for run in runs]
    outside = np.median([run["outside_3_sigma"] for run in runs])
    times = [f"{np.median(after):.1f}", f"{max(after):.1f}"] if after else ["-", "-"]
    return [job.sequence.name, job.profile, job.fault or "none", f"{len(after)} of {len(runs)}", f"{named} of {len(runs)}", *times,
            f"{np.median(ratios):.2f}", f"{max(ratios):.2f}", f"{100 * outside:.1f}"]


def run(arguments, programs, source, work):
    """@return whether all runs ended well"""
    folders, faults = run_jobs(jobs_of(arguments.seeds), programs, work, arguments.jobs, arguments.sshlogin, runs="honesty")
    page = NOTE + "".join(f"| {' | '.join(row_of(job, folder))} |\n" for job, folder in folders.items())
    write(os.path.join(work, "honesty.md"), page)
    print(page)
    if arguments.update and not faults:
        write(os.path.join(source, "docs", "honesty.md"), page)
    return faults
