#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Instructions and cycles a frame by stage, of what scripts/drone_cost has counted."""
import argparse
import json
import sys
from pathlib import Path

# Numbers as in ardrone_vslam/stages.hpp, and flight_poses' own.
STAGES = {"detect": 0, "describe": 1, "track": 2, "set-up": 7, "associate": 3, "localise": 4, "map": 5}
CAMERAS = {"laps": "640x360, 200 features", "bottom": "320x240, 150 features"}
# What costs more than a cycle on a Cortex-A8.
SLOW = {"scalar": "scalar VFP", "divide": "divides and roots", "move": "moves between VFP or NEON and the core"}
# What the model of the processor adds, by its name in the counts.
CYCLES = {
    "cycles": "cycles",
    "cycles_neon": "waiting for NEON or VFP",
    "cycles_caches": "misses of caches",
    "cycles_branches": "branches not foretold",
}


def counts_of(path):
    """Counts by kind of each stage."""
    stages = {}
    for line in path.read_text().splitlines():
        words = line.split()
        stages[int(words[1])] = dict(zip(words[2::2], map(int, words[3::2])))
    return stages


def row_of(folder, name):
    frames = len((folder / f"{name}.poses").read_text().splitlines())
    counts = counts_of(folder / f"{name}.counts")
    by_stage = [{kind: count / frames for kind, count in counts[number].items()} for number in STAGES.values()]
    cycles = {kind: round(sum(stage.pop(kind) for stage in by_stage), 1) for kind in CYCLES if kind != "cycles" and kind in by_stage[0]}
    of_stages = [stage.pop("cycles", None) for stage in by_stage]
    frame = {kind: round(sum(stage[kind] for stage in by_stage), 1) for kind in by_stage[0]}
    frame["instructions"] = round(sum(frame.values()), 1)
    row = {
        "frames": frames,
        "stages": {stage: round(sum(kinds.values()), 1) for stage, kinds in zip(STAGES, by_stage)},
        "frame": frame,
    }
    if cycles:
        row["cycles"] = {"frame": round(sum(of_stages), 1), **cycles}
        row["cycles"].update({stage: round(cycles, 1) for stage, cycles in zip(STAGES, of_stages)})
    return row


def run_of(name):
    flight, estimator, kernels = name.split("_")
    return f"{CAMERAS[flight]}, {estimator}, {kernels}"


def cycles_table(rows):
    columns = {"frame": "frame", **{stage: stage for stage in STAGES}, **{kind: CYCLES[kind] for kind in CYCLES if kind != "cycles"}}
    lines = ["| run | " + " | ".join(columns.values()) + " |", "|" + "---|" * (len(columns) + 1)]
    for name, row in rows.items():
        lines.append(f"| {run_of(name)} | " + " | ".join(f"{row['cycles'][kind] / 1e6:.2f}" for kind in columns) + " |")
    return "\n".join(lines)


def table(rows):
    lines = ["| run | frame | " + " | ".join(STAGES) + " | of the frame: " + " | ".join(SLOW.values()) + " | memory |"]
    lines.append("|" + "---|" * (len(STAGES) + 3 + len(SLOW)))
    millions = lambda count: f"{count / 1e6:.2f}"
    for name, row in rows.items():
        cells = [millions(row["frame"]["instructions"])]
        cells += [millions(row["stages"][stage]) for stage in STAGES]
        cells += [millions(row["frame"][kind]) for kind in SLOW]
        cells.append(millions(row["frame"]["memory"] + row["frame"]["neon_memory"] + row["frame"]["scalar_memory"]))
        lines.append(f"| {run_of(name)} | " + " | ".join(cells) + " |")
    return "\n".join(lines)


def rises(rows, baseline):
    """What takes 5 % more than in the baseline; a row that is not there counts as well."""
    for name, row in rows.items():
        if name not in baseline:
            yield f"{name}: not in the baseline"
            continue
        for kind in ("instructions", *SLOW):
            now, then = row["frame"][kind], baseline[name]["frame"][kind]
            # A kind that hardly occurs is judged by its share of the frame.
            if now > then + 0.05 * max(then, 0.02 * baseline[name]["frame"]["instructions"]):
                yield f"{name}: {kind} rose from {then:.0f} to {now:.0f} a frame"


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("folder", type=Path)
    parser.add_argument("--json", type=Path)
    parser.add_argument("--page", type=Path)
    parser.add_argument("--baseline", type=Path)
    arguments = parser.parse_args()
    rows = {path.stem: row_of(arguments.folder, path.stem) for path in sorted(arguments.folder.glob("*.counts"))}
    text = table(rows)
    print(text)
    with_cycles = all("cycles" in row for row in rows.values())
    if with_cycles:
        print("\n" + cycles_table(rows))
    faults = list(rises(rows, json.loads(arguments.baseline.read_text()))) if arguments.baseline else []
    if arguments.json:
        arguments.json.write_text(json.dumps(rows, indent=1) + "\n")
    if arguments.page:
        frames = next(iter(rows.values()))["frames"]
        arguments.page.write_text(
            "# Instructions and cycles a frame on the drone\n\n"
            "Made by `scripts/drone_cost --page`; do not edit. Millions of executed instructions a frame, mean of "
            f"the first {frames} frames of `laps`, counted by an emulated Cortex-A8: equal from run to run. A frame of a long flight "
            "costs more ([why](../docs/onboard.md#what-a-frame-costs-and-what-makes-it-cheaper)). "
            "Reading the image from its file is not counted.\n\n" + text + "\n\n"
            + ("## Cycles, by a model\n\n"
               "Millions of cycles a frame of the same runs, by a [model](../docs/onboard.md#cycles-by-a-model) of the processor; it has "
               "not been held to a real drone. At 1 GHz a million is a millisecond. The last columns are parts of the frame; misses of what "
               "NEON loads may be hidden.\n\n" + cycles_table(rows) + "\n" if with_cycles else ""))
    for fault in faults:
        print("FAULT:", fault)
    sys.exit(1 if faults else 0)


if __name__ == "__main__":
    main()
