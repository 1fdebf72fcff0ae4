# SPDX-License-Identifier: BSD-3-Clause
"""scripts/evaluate_all --honesty: flights whose set-up is wrong, and similar flights that are as right: what becomes of the pose."""

import os

import numpy as np

from . import batch_jobs
from .batch_run import run_jobs
from .command import write
from .run_folder import read_summary
from .table import Column, shown

# replay's --setup-fault -> what the summary is to call it.
FAULTS = {"": "none", "yaw=180": "mounting", "yaw=90": "mounting", "yaw=-90": "mounting", "pitch=90": "mounting", "pitch=-90": "mounting",
          "roll=90": "mounting", "roll=-90": "mounting", "roll=180": "mounting", "mirrored": "mirrored", "late=0.3": "time_offset",
          "late=-0.3": "time_offset", "focal=0.7": "focal_length", "focal=1.5": "focal_length"}
# A name -> replay's options.
SIMILAR = {"as it is": (), "0.3 times as large": ("--world-scale", "0.3"), "3 times as large": ("--world-scale", "3"),
           "10 times as large": ("--world-scale", "10"), "30 times as large": ("--world-scale", "30"), "mirrored": ("--mirror-world",),
           "every 2nd image": ("--frames", "::2"), "every 4th image": ("--frames", "::4"), "every 8th image": ("--frames", "::8"),
           "images 0.1 s late": ("--setup-fault", "late=0.1"), "images 0.1 s early": ("--setup-fault", "late=-0.1"),
           "images 0.2 s late": ("--setup-fault", "late=0.2")}
PROFILES = ("drone", "hover", "harsh")
FLIGHTS = (batch_jobs.rendered("laps", *PROFILES, seconds=30), batch_jobs.rendered("corridor", *PROFILES, seconds=20))
HOVER = batch_jobs.rendered("hover", *PROFILES, seconds=15)
KITCHEN_IMAGES = 500

NOTE = """# What becomes of the pose where an assumption fails

Written by `scripts/evaluate_all --honesty --update --seeds {seeds}`, not by hand ([how](evaluate.md#where-an-assumption-fails)). Position errors are without alignment.

## Wrong set-ups
`replay --setup-fault` makes the set-up wrong. How that is found is told in [msckf.md](msckf.md#faults-of-the-set-up). With no fault nothing is to be found. `found` and
`named` count seeds; `found after` is the time since the first image.

"""
SIMILAR_NOTE = """
## Similar flights
Each is as right as the flight it is made of. `--world-scale` makes scene and flight so many times as large at the same speed: it lasts as many times as long.
`--mirror-world` mirrors images, camera and truth. How late images are is found in flight ([how](odometry.md#when-an-image-was-exposed)); until then they are taken as they are stamped.

"""
FAULT_COLUMNS = (Column("found after [s]", "after", 1), Column("latest [s]", "latest", 1), Column("fused / odometry", "ratio", 2),
                 Column("worst", "ratio_worst", 2), Column("outside 3 sigma [%]", "outside", 1, 100))
SIMILAR_COLUMNS = (Column("fused RMSE [m], median", "error_m", 3), Column("fused / odometry", "ratio", 2), Column("worst", "ratio_worst", 2),
                   Column("NEES / 3", "nees", 2), Column("worst", "nees_worst", 2), Column("outside 3 sigma [%]", "outside", 1, 100))


def real_sequences():
    data = os.environ.get("ARDRONE_VSLAM_DATA")
    real = {s.name: s for s in batch_jobs.real_sequences(data)} if data else {}
    kitchen = [batch_jobs.Sequence(name, PROFILES, folder=real[name].folder, replay=("--frames", f"0:{KITCHEN_IMAGES}"))
               for name in ("seven_scenes_kitchen",) if name in real]
    return kitchen, [real[name] for name in ("kitti_00_clip",) if name in real]


def fault_jobs(seeds):
    """All faults with `drone`; with the others only what is right, which must not be found wrong."""
    return [batch_jobs.Job(sequence, profile, "msckf", seeds, options=("--setup-fault", fault) if fault else ())
            for sequence in (*FLIGHTS, *real_sequences()[0]) for profile in sequence.profiles
            for fault in (FAULTS if profile == "drone" else ("",))]


def similar_jobs(seeds):
    """All changes with the first profile; with the others only as it is."""
    kitchen, street = real_sequences()
    jobs = []
    for sequence in (*FLIGHTS, HOVER, *kitchen, *street):
        for profile in sequence.profiles:
            for options in (SIMILAR.values() if profile == sequence.profiles[0] else ((),)):
                # One --frames alone holds.
                thins = "--frames" in options and "--frames" in sequence.replay
                base = batch_jobs.Sequence(sequence.name, sequence.profiles, sequence.flight, sequence.folder) if thins else sequence
                of_job = ("--frames", f"0:{KITCHEN_IMAGES}{options[1][1:]}") if thins else options
                jobs.append(batch_jobs.Job(base, profile, "msckf", seeds, options=of_job))
    return jobs


def jobs_of(seeds):
    return list(dict.fromkeys(fault_jobs(seeds) + similar_jobs(seeds)))


def change_of(job):
    """In words."""
    is_thinned = job.options[:1] == ("--frames",)
    options = ("--frames", "::" + job.options[1].rpartition(":")[2]) if is_thinned else job.options
    return next(name for name, of_name in SIMILAR.items() if of_name == options)


def numbers(runs):
    after = [run["setup_fault_found_s"] for run in runs if run["setup_fault_found_s"] is not None]
    of = {key: [run[key] for run in runs] for key in ("ratio", "fused_ate_rmse_m", "nees_mean", "outside_3_sigma")}
    return {"after": np.median(after) if after else None, "latest": max(after, default=None), "found": len(after),
            "error_m": np.median(of["fused_ate_rmse_m"]), "ratio": np.median(of["ratio"]), "ratio_worst": max(of["ratio"]),
            "nees": np.median(of["nees_mean"]) / 3, "nees_worst": max(of["nees_mean"]) / 3, "outside": np.median(of["outside_3_sigma"])}


def line(cells, row, columns):
    return f"| {' | '.join([*cells, *(shown(row[column.key], column) for column in columns)])} |\n"


def heading(names, columns):
    return f"| {' | '.join([*names, *(column.heading for column in columns)])} |\n| {' | '.join(['---'] * len(names) + ['---:'] * len(columns))} |\n"


def page(folders, seeds):
    """@p folders {job: its folder}, of those that ended well"""
    runs = {job: read_summary(os.path.join(folder, "summary.json"))["runs"] for job, folder in folders.items()}
    text = NOTE.format(seeds=seeds) + heading(("sequence", "profile", "fault", "found", "named"), FAULT_COLUMNS)
    for job in fault_jobs(seeds):
        if job in runs:
            fault = job.options[1] if job.options else ""
            row, count = numbers(runs[job]), len(runs[job])
            named = sum(run["setup_fault"] == FAULTS[fault] for run in runs[job])
            text += line([job.sequence.name, job.profile, fault or "none", f"{row['found']} of {count}", f"{named} of {count}"], row, FAULT_COLUMNS)
    text += SIMILAR_NOTE + heading(("sequence", "profile", "change"), SIMILAR_COLUMNS)
    for job in similar_jobs(seeds):
        if job in runs:
            text += line([job.sequence.name, job.profile, change_of(job)], numbers(runs[job]), SIMILAR_COLUMNS)
    return text


def run(arguments, programs, source, work):
    """@return texts about what failed"""
    folders, faults = run_jobs(jobs_of(arguments.seeds), programs, work, arguments.jobs, arguments.sshlogin, runs="honesty")
    text = page(folders, arguments.seeds)
    write(os.path.join(work, "honesty.md"), text)
    print(text)
    if arguments.update and not faults:
        write(os.path.join(source, "docs", "honesty.md"), text)
    return faults
