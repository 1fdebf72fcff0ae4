#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Draws what a frame costs the mapper, of mapping_cost's file, and writes the page's part."""

import argparse
import csv
import os

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

STAGES = ("associate", "localise", "map")


def rows_of(path):
    with open(path) as file:
        return [{key: value if key == "series" else float(value) for key, value in row.items()}
                for row in csv.DictReader(file)]


def total(row):
    return sum(row[f"{stage}_ms"] for stage in STAGES)


def draw(rows, path):
    figure, (left, right) = plt.subplots(1, 2, figsize=(10, 4))
    for series, colour in (("thesis", "#1f77b4"), ("msckf", "#d62728")):
        chosen = [row for row in rows if row["series"] == series]
        left.plot([row["features"] for row in chosen], [total(row) for row in chosen], "o-", color=colour,
                  label=f"estimator: {series}")
    left.set_xlabel("features a frame")
    left.set_ylabel("mapper, ms a frame")
    left.set_ylim(bottom=0)
    left.legend()
    chosen = [row for row in rows if row["series"] == "map"]
    right.loglog([row["landmarks"] for row in chosen], [row["associate_ms"] for row in chosen], "o-", color="#2ca02c")
    right.set_xlabel("landmarks in the map")
    right.set_ylabel("association, ms a frame")
    for axes in (left, right):
        axes.grid(alpha=0.3)
    figure.tight_layout()
    figure.savefig(path, dpi=100)
    print(f"wrote {path}")


def table(rows):
    lines = ["| features | landmarks in view | thesis: associate / localise / map [ms] | msckf | tracks used |",
             "|---|---|---|---|---|"]
    thesis = [row for row in rows if row["series"] == "thesis"]
    msckf = [row for row in rows if row["series"] == "msckf"]
    for a, b in zip(thesis, msckf):
        cells = [" / ".join(f"{row[f'{stage}_ms']:.2f}" for stage in STAGES) for row in (a, b)]
        lines.append(f"| {a['features']:.0f} | {a['in_view']:.0f}, {b['in_view']:.0f} | {cells[0]} | {cells[1]} | "
                     f"{b['tracks']:.0f} |")
    lines += ["", "| landmarks in the map | in view | association [ms] | the image in which it is full [ms] |", "|---|---|---|---|"]
    for row in rows:
        if row["series"] == "map":
            lines.append(f"| {row['landmarks']:,.0f} | {row['in_view']:.0f} | {row['associate_ms']:.2f} | {row['map_ms']:.1f} |")
    return "\n".join(lines)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("measured", help="mapping_cost's csv")
    parser.add_argument("--plot", required=True, help="png")
    parser.add_argument("--page-part", required=True, help="markdown")
    options = parser.parse_args()
    rows = rows_of(options.measured)
    draw(rows, options.plot)
    with open(options.page_part, "w") as file:
        file.write(f"""
## What a frame costs the mapper

`mapping_cost`: a simulated street, KITTI's camera, 0.8 px noise, 3 % wrong corners, true odometry. Medians over 120 frames, of
the MSCKF over its keyframes. Times are the thread's own, on a machine with a load of {os.getloadavg()[1]:.0f} on {os.cpu_count()} cores. They are about linear
in the features, and in the landmarks, all of which are projected. The MSCKF has a constant part besides, the covariance of its
window and anchors.

{table(rows)}

![cost against features and landmarks](plots/mapping_cost.png)
""")


if __name__ == "__main__":
    main()
