#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Draws the errors over the image that lens_correction --map wrote."""

import argparse
import csv
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.colors import LogNorm

TITLES = {"table": "table", "closed_form_3": "closed form, 3 terms", "closed_form_4": "closed form, 4 terms",
          "closed_form_9": "closed form, 9 terms"}
SMALLEST_PX, LARGEST_PX = 1e-10, 100
COLOURS_A_DECADE = 2


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("map", help="lens_correction's --map")
    parser.add_argument("--plot", required=True, help="png")
    options = parser.parse_args()
    csv.field_size_limit(sys.maxsize)
    with open(options.map) as file:
        rows = {row["method"]: row for row in csv.DictReader(file)}
    decades = round(np.log10(LARGEST_PX / SMALLEST_PX))
    colours = plt.get_cmap("viridis", decades * COLOURS_A_DECADE)
    figure, panels = plt.subplots(2, 2, figsize=(10, 6.2), constrained_layout=True, sharex=True, sharey=True)
    for axes, method in zip(panels.flat, ("closed_form_3", "closed_form_4", "closed_form_9", "table")):
        row = rows[method]
        errors = np.array(row["errors_px"].split(), float).reshape(int(row["height_px"]), int(row["width_px"]))
        image = axes.imshow(np.maximum(errors, SMALLEST_PX), norm=LogNorm(SMALLEST_PX, LARGEST_PX), cmap=colours,
                            interpolation="nearest")
        axes.set_title(f"{TITLES[method]}: mean {float(row['mean_px']):.2g} px, largest {float(row['largest_px']):.2g} px",
                       fontsize=10)
        if method != "table":
            lines = axes.contour(errors, levels=[0.01, 0.1, 1, 10], colors="white", linewidths=0.7)
            axes.clabel(lines, fmt="%g", fontsize=7)
    for axes in panels[1]:
        axes.set_xlabel("px")
    for axes in panels[:, 0]:
        axes.set_ylabel("px")
    figure.colorbar(image, ax=panels, label="error [px]", ticks=[10.0**i for i in range(-10, 3)], shrink=0.9)
    figure.savefig(options.plot, dpi=80, pil_kwargs={"optimize": True})
    print(f"wrote {options.plot}")


if __name__ == "__main__":
    main()
