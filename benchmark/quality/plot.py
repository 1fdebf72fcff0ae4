#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Draws the curves of a folder's quality.json (made by front_end_quality)."""

import argparse
import json
import os

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

MEASURES = (("matching_score", "matching score"), ("repeatability", "repeatability"), ("precision", "precision"))
FEW_FEATURES = 50  # as on the page
LOOKS = {  # ours in strong colours and solid, the peers' thinner
    "FAST-12 + FREAK": dict(color="#d62728", marker="o", linewidth=2),
    "FAST-12 + FREAK, roll known": dict(color="#e377c2", marker="o", linewidth=2),
    "FAST-9 + FREAK": dict(color="#1f77b4", marker="o", linewidth=2),
    "cv::ORB": dict(color="#2ca02c", marker="^", linewidth=1.2, linestyle="--"),
    "cv::BRISK": dict(color="#9467bd", marker="s", linewidth=1.2, linestyle="--"),
    "cv::AKAZE": dict(color="#7f7f7f", marker="D", linewidth=1.2, linestyle="--"),
}


def percent(values):
    return [100 * value for value in values]


def finish(axes, title=None):
    axes.set_ylim(0, 104)
    axes.grid(alpha=0.3)
    if title:
        axes.set_title(title)


def draw_chart(axes, chart, measure):
    """Without the points where a method finds hardly any features: a handful's shares say nothing."""
    for curve in chart["curves"]:
        values = [100 * value if count >= FEW_FEATURES else float("nan")
                  for value, count in zip(curve[measure], curve["features"])]
        axes.plot(chart["x"], values, markersize=3.5, label=curve["method"], **LOOKS[curve["method"]])


def with_legend(figure, lines_from):
    """One for the whole figure."""
    handles, labels = lines_from.get_legend_handles_labels()
    rows = (len(labels) + 5) // 6
    height = figure.get_size_inches()[1]
    figure.legend(handles, labels, loc="lower center", ncol=min(6, len(labels)), frameon=False)
    figure.tight_layout(rect=(0, 0.3 * rows / height, 1, 1))
    return figure


def save(figure, path):
    figure.savefig(path, dpi=100)
    print(f"wrote {path}")


def sweeps_figure(charts):
    figure, grid = plt.subplots(3, len(charts), figsize=(12, 9), sharey=True, squeeze=False)
    for column, chart in enumerate(charts):
        for row, (measure, name) in enumerate(MEASURES):
            axes = grid[row][column]
            draw_chart(axes, chart, measure)
            finish(axes, chart["name"] if row == 0 else None)
            if chart["name"] == "rotation":
                axes.set_xticks(range(0, 361, 90))
            if column == 0:
                axes.set_ylabel(f"{name} [%]")
        grid[-1][column].set_xlabel(chart["axis"])
    return with_legend(figure, grid[0][0])


def graf_figure(chart):
    figure, row = plt.subplots(1, 3, figsize=(12, 4), sharey=True)
    for axes, (measure, name) in zip(row, MEASURES):
        draw_chart(axes, chart, measure)
        finish(axes, f"graf: {name}")
        axes.set_xticks(chart["x"])
        axes.set_xticklabels([f"1-{number:.0f}" for number in chart["x"]])
        axes.set_xlabel("images")
    row[0].set_ylabel("%")
    return with_legend(figure, row[0])


def draw_shares(axes, chart):
    """Corners and correct matches as shares of those with all passes: the thesis's figure 4.9."""
    for curve in chart["curves"]:
        look = LOOKS[curve["method"]]
        for measure, what, style in (("features", "corners", ":"), ("correct", "correct matches", "-")):
            axes.plot(chart["x"], percent(value / max(1, curve[measure][-1]) for value in curve[measure]),
                      color=look["color"], marker="o", markersize=3.5, linestyle=style,
                      label=f"{curve['method']}: {what}")


def passes_figure(passes, motions):
    figure, grid = plt.subplots(2, len(passes), figsize=(14, 7), sharey=True, squeeze=False)
    for column, (chart, peers) in enumerate(zip(passes, motions)):
        upper, lower = grid[0][column], grid[1][column]
        draw_shares(upper, chart)
        finish(upper, chart["name"])
        draw_chart(lower, chart, "precision")
        for curve in peers["curves"]:
            if curve["method"].startswith("cv::"):
                look = {key: value for key, value in LOOKS[curve["method"]].items() if key != "marker"}
                lower.axhline(100 * curve["precision"][0], label=curve["method"], **look)
        finish(lower)
        for axes in (upper, lower):
            axes.set_xscale("log", base=2)
            axes.set_xticks(chart["x"])
            axes.set_xticklabels([f"{number:.0f}" for number in chart["x"]])
        lower.set_xlabel(chart["axis"])
    grid[0][0].set_ylabel("share of 16 passes' [%]")
    grid[1][0].set_ylabel("precision [%]")
    grid[0][-1].legend(fontsize=7, loc="lower right")
    return with_legend(figure, grid[1][0])


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("folder", help="where quality.json is")
    parser.add_argument("--plots", help="where to write the plots; else to the folder's plots/")
    options = parser.parse_args()
    with open(os.path.join(options.folder, "quality.json")) as file:
        results = json.load(file)
    plots = options.plots or os.path.join(options.folder, "plots")
    os.makedirs(plots, exist_ok=True)
    save(sweeps_figure(results["sweeps"]), os.path.join(plots, "quality_sweeps.png"))
    for chart in results["graf"]:
        save(graf_figure(chart), os.path.join(plots, "quality_graf.png"))
    save(passes_figure(results["passes"], results["motions"]), os.path.join(plots, "quality_passes.png"))


if __name__ == "__main__":
    main()
