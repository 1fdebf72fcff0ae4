#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Instructions a frame by stage, of what scripts/drone_cost has counted."""
import argparse
import json
import sys
from pathlib import Path

# Numbers as in ardrone_vslam/stages.hpp, and flight_poses' own.
STAGES = {"detect": 0, "describe": 1, "track": 2, "set-up": 7, "associate": 3, "localise": 4, "map": 5}
CAMERAS = {"laps": "640x360, 200 features", "bottom": "320x240, 150 features"}
# What costs more than a cycle on a Cortex-A8.
SLOW = {"scalar": "scalar VFP", "divide": "divides and roots", "move": "moves between VFP or NEON and the core"}


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
    frame = {kind: round(sum(stage[kind] for stage in by_stage), 1) for kind in by_stage[0]}
    frame["instructions"] = round(sum(frame.values()), 1)
    return {
        "frames": frames,
        "stages": {stage: round(sum(kinds.values()), 1) for stage, kinds in zip(STAGES, by_stage)},
        "frame": frame,
    }


def table(rows):
    lines = ["| run | frame | " + " | ".join(STAGES) + " | of the frame: " + " | ".join(SLOW.values()) + " | memory |"]
    lines.append("|" + "---|" * (len(STAGES) + 3 + len(SLOW)))
    millions = lambda count: f"{count / 1e6:.2f}"
    for name, row in rows.items():
        cells = [millions(row["frame"]["instructions"])]
        cells += [millions(row["stages"][stage]) for stage in STAGES]
        cells += [millions(row["frame"][kind]) for kind in SLOW]
        cells.append(millions(row["frame"]["memory"] + row["frame"]["neon_memory"] + row["frame"]["scalar_memory"]))
        flight, estimator, kernels = name.split("_")
        lines.append(f"| {CAMERAS[flight]}, {estimator}, {kernels} | " + " | ".join(cells) + " |")
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
    faults = list(rises(rows, json.loads(arguments.baseline.read_text()))) if arguments.baseline else []
    if arguments.json:
        arguments.json.write_text(json.dumps(rows, indent=1) + "\n")
    if arguments.page:
        frames = next(iter(rows.values()))["frames"]
        arguments.page.write_text(
            "# Instructions a frame on the drone\n\n"
            "Made by `scripts/drone_cost --page`; do not edit. Millions of executed instructions a frame, mean of "
            f"the first {frames} frames of `laps`, counted by an emulated Cortex-A8: equal from run to run. A frame of a long flight "
            "costs more, within a minute twice as much ([why](../docs/onboard.md#what-a-frame-costs-and-what-makes-it-cheaper)). "
            "Instructions are not cycles: on the Cortex-A8 one of scalar VFP takes about ten, a move from NEON to the core about "
            "twenty. Reading the image from its file is not counted.\n\n" + text + "\n")
    for fault in faults:
        print("FAULT:", fault)
    sys.exit(1 if faults else 0)


if __name__ == "__main__":
    main()
