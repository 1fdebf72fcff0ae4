#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Runs one program of benchmark/ in its shortest form. Usage: shortest_run.py PROGRAM"""
import csv
import json
import math
import re
import subprocess
import sys
import tempfile
from pathlib import Path


def run(program, *arguments):
    return subprocess.run([program, *map(str, arguments)], stdout=subprocess.PIPE, text=True, check=True).stdout


def check_front_end_benchmark(program, folder):
    rows = json.loads(run(program, "--benchmark_min_time=0.0001", "--benchmark_format=json",
                          "--benchmark_filter=-^(exact|index|index_lsh)_100?k"))["benchmarks"]
    assert len({row["name"].split("/")[0] for row in rows}) > 10, "only %d rows" % len(rows)
    for row in rows:
        assert not row.get("error_occurred"), row
        assert row["iterations"] > 0 and 0 < row["cpu_time"] < math.inf, row


def check_front_end_quality(program, folder):
    run(program, "--quick", "--out", folder)
    results = json.loads((folder / "quality.json").read_text())
    curves = [curve for kind in ("sweeps", "motions", "passes") for chart in results[kind] for curve in chart["curves"]]
    assert len({curve["method"] for curve in curves}) > 3, curves
    for curve in curves:
        for name in ("repeatability", "matching_score", "precision"):
            assert curve[name] and all(0 <= value <= 1 for value in curve[name]), curve
    assert "|" in (folder / "quality.md").read_text()


def check_mapping_cost(program, folder):
    run(program, "--quick", "--out", folder / "cost.csv")
    with open(folder / "cost.csv", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    assert [row.pop("series") for row in rows] == ["thesis", "msckf", "map"], rows
    for row in rows:
        assert all(0 <= float(value) < math.inf for value in row.values()), row
        assert float(row["features"]) > 0 and float(row["landmarks"]) > 0 and float(row["associate_ms"]) > 0, row


def check_map_saving(program, folder):
    page = run(program, "--quick", "--folder", folder)
    rows = re.findall(r"^\| (\d.*) \|$", page, re.M)
    assert len(rows) == 1, page
    landmarks, _, _, frames, *times, file_mb = rows[0].split(" | ")
    assert int(landmarks) == 3000 and int(frames) > 0 and all(float(time) >= 0 for time in times), page
    assert 0.1 < float(file_mb) < 3, page
    assert not any(folder.iterdir()), "the map is left there"


def check_lens_correction(program, folder):
    rows = re.findall(r"^\| (\S[^|]*) \| (\S+) \| (\S+) \| (\S+) \| (\S+) \|$", run(program), re.M)
    rows = [row for row in rows if row[0] != "way"]
    assert len(rows) > 2, rows
    for _, *numbers in rows:
        mean_px, largest_px, time_ns, ratio = map(float, numbers)
        assert 0 <= mean_px <= largest_px < math.inf and time_ns > 0 and ratio > 0, rows


def check_track_deviation(program, folder):
    page = run(program, "--quick")
    assert "# Tracks against truth\n" in page, page
    rows = re.findall(r"^\| rendered: (.*) \|$", page, re.M)
    deviations = [[float(cell) for cell in row.split(" | ")[3:9]] for row in rows[:3]]
    assert len(rows) == 5, page
    for row in deviations:
        for whole_px, aligned_px, _ in (row[:3], row[3:]):
            assert 0 < aligned_px < whole_px / 2, page
    for claims in rows[3:]:
        assert 0.8 < float(claims.split(" | ")[2]) < 1, page
        for ratio in re.findall(r"\*\*(.*?)\*\*", claims):
            assert 0.5 < float(ratio) < 1.4, page


def main():
    program = sys.argv[1]
    with tempfile.TemporaryDirectory() as folder:
        globals()["check_" + Path(program).name](program, Path(folder))


if __name__ == "__main__":
    main()
