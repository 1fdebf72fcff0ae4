# SPDX-License-Identifier: BSD-3-Clause
"""The table of all runs. It holds no times, so the same programs give the same bytes; times have a file of their own."""

import os

import numpy as np

from .run_folder import read_summary
from .table import Column, shown

COLUMNS = (Column("fused RMSE [m], median", "fused_rmse_m", 3), Column("worst", "fused_rmse_worst_m", 3),
           Column("odometry RMSE [m]", "odometry_rmse_m", 3), Column("fused / odometry", "ratio", 3),
           Column("the same, scale removed", "ratio_scale_removed", 3), Column("worst", "ratio_scale_removed_worst", 3),
           Column("NEES / 3", "nees", 2),
           Column("outside 3 sigma [%]", "outside_3_sigma", 1, 100), Column("t_rel [%]", "t_rel_percent", 3))
# Row's key -> (summary.json's, what of the seeds).
OF_SUMMARY = {"fused_rmse_m": ("fused_ate_rmse_m", np.median), "fused_rmse_worst_m": ("fused_ate_rmse_m", np.max),
              "odometry_rmse_m": ("odometry_ate_rmse_m", np.median), "ratio": ("ratio", np.median),
              "ratio_scale_removed": ("ratio_scale_removed", np.median),
              "ratio_scale_removed_worst": ("ratio_scale_removed", np.max), "nees": ("nees_mean", np.median),
              "outside_3_sigma": ("outside_3_sigma", np.median), "t_rel_percent": ("t_rel_percent", np.median)}
HARM = 1.05  # an estimator that does no harm stays below, the odometry's scale error removed, in each seed
TIMES = (Column("ms an image, median", "ms_per_frame_median", 2), Column("95 %", "ms_per_frame_p95", 2))
NOTE = """Written by `scripts/evaluate_all` ([how](evaluate.md#all-sequences-at-once)), not by hand; what it is compared with is
[results_baseline.json](results_baseline.json). Position errors without alignment, medians over the seeds but for `worst`; [what each
number is](evaluate.md#what-it-computes). t_rel needs 100 m of way."""


def of_seeds(runs, key, of_all):
    """None unless all seeds have it."""
    values = [run.get(key) for run in runs]
    return None if not values or None in values else float(of_all(values))


def row_of(job, folder):
    summary = read_summary(os.path.join(folder, "summary.json"))
    runs = summary.get("runs", [summary])
    row = {"sequence": " ".join((job.sequence.name, *job.options)), "frames": summary["frames"], "profile": job.profile, "estimator": job.estimator, "seeds": job.seeds}
    row.update({name: of_seeds(runs, key, of_all) for name, (key, of_all) in OF_SUMMARY.items()})
    row["nees"] = None if row["nees"] is None else row["nees"] / 3
    row.update({column.key: of_seeds(runs, column.key, np.median) for column in TIMES})
    return row


def markdown(rows, columns, names=("sequence", "frames", "profile", "estimator", "seeds")):
    lines = [[*names, *(column.heading for column in columns)], ["---"] * len(names) + ["---:"] * len(columns)]
    lines += [[str(row[name]) for name in names] + [shown(row[column.key], column) for column in columns] for row in rows]
    return "".join(f"| {' | '.join(line)} |\n" for line in lines)


def harm(rows):
    """In words."""
    harmed = [row for row in rows if row["ratio_scale_removed_worst"] is not None and row["ratio_scale_removed_worst"] > HARM]
    names = "".join(f"- {row['sequence']} {row['profile']} {row['estimator']} ({row['ratio_scale_removed_worst']:.3f})\n" for row in harmed)
    return (f"Worse than the odometry by more than {HARM - 1:.0%} in a seed, scale removed, which is a defect:\n{names}" if harmed else
            f"No seed of any row is worse than the odometry by more than {HARM - 1:.0%}, scale removed.\n")


def page(rows, selection):
    return f"# Results\n\n{NOTE}\n\nSelection: {selection}.\n\n{markdown(rows, COLUMNS)}\n{harm(rows)}"


def times_page(rows):
    return "# Times\n\nOf this machine, with all that ran beside.\n\n" + markdown(rows, TIMES, ("sequence", "profile", "estimator"))
