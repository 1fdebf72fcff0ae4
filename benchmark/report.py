#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Turns what front_end_benchmark measured into rows (ours beside a peer), a page and plots."""

import argparse
import json
import os
import statistics

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

OURS = "ours"
PASSES = (1, 2, 4, 8, 16)
ABOUT = {
    "fast9_kitti": "FAST-9, t = 35, 3x3 suppression: the same corners in the same order as cv::FAST",
    "fast9_320x240": "the same, 320x240",
    "fast12_kitti": "FAST-12, t = 35",
    "fast12_320x240": "the same, 320x240",
    "fast9_agast_kitti": "FAST-9 beside AGAST",
    "fast9_agast_320x240": "the same, 320x240",
    "detector_orb_kitti": "the tracker's detector beside ORB's, which also works on smaller images",
    "detector_orb_320x240": "the same, 320x240",
    "detector_brisk_kitti": "beside BRISK's, which does so, too",
    "detector_brisk_320x240": "the same, 320x240",
    "detector_kitti": "FAST-12 as the tracker runs it: 1000 corners spread over cells, adapting thresholds",
    "detector_320x240": "the same, 320x240",
    "freak_kitti": "FREAK with its integral image, 600 keypoints",
    "freak_brisk_kitti": "FREAK beside BRISK's descriptor, the same keypoints",
    "freak_orb_kitti": "FREAK beside ORB's descriptor (256 bits), the same keypoints",
    "freak_upright_kitti": "FREAK without the 45 orientation pairs",
    "exact_1k": "best and second best of 1000 queries among 1,000",
    "exact_10k": "among 10,000",
    "exact_100k": "among 100,000",
    "index_1k": "the same among 1,000 by the index (32 probes); the peer is FLANN's hierarchical clustering (Debian's)",
    "index_10k": "among 10,000",
    "index_100k": "among 100,000",
    "index_lsh_100k": "the same beside FLANN's LSH (20 tables, 22 bits, 1 level of probes: its fastest of those tried "
                      "with a recall of about 95 %)",
    "project_100k": "100,000 landmarks projected and culled",
    "guided_100k": "100,000 landmarks projected, culled, about 12,000 of them looked for in windows of 30 px and more "
                   "among 600 features, mismatches removed; the peer is given the windows as a mask and only compares",
    "align_kitti": "600 patches of the image before, aligned from the corners that they were matched with: 8x8 pixels, at most 8 steps, "
                   "down to 0.03 px, and what is left of differences; patches (ours) or gradients (peer) are ready",
    "align_with_patches_kitti": "the same with making the patches; the peer begins with both images",
    "tracker_kitti": "image to features with tracks, 600 features",
    "tracker_whole_pixels_kitti": "the same without alignment (align_tracks: false): tracks stay on whole pixels",
    "tracker_320x240": "the same, 320x240, 200 features",
    **{f"passes{p}_kitti": f"{p} of 16 passes" for p in PASSES},
}
# What each row must reach, peer / ours; by instruction set where that matters.
WANTED = {"fast9_kitti": 2.2, "fast9_320x240": 2.2, "fast12_kitti": 2.7, "fast12_320x240": 3.3, "freak_kitti": 5,
          "exact_100k": {"avx512": 14, "avx2": 5}, "exact_100k_avx2": 5, "index_100k": 15, "index_100k_avx2": 15,
          "project_100k": 8, "project_100k_avx2": 8, "align_kitti": 10, "freak_kitti_avx2": 5, "tracker_kitti": 8, "tracker_320x240": 8}


def read_sides(path):
    """{row: {who: {time_ns, items, share}}} of medians over the repetitions, and the context."""
    with open(path) as file:
        data = json.load(file)
    runs = {}
    for run in data["benchmarks"]:
        if run.get("run_type") != "aggregate":
            row, who = run["run_name"].split("/iterations:")[0].split("/", 1)
            runs.setdefault((row, who), []).append(run)
    sides = {}
    for (row, who), repetitions in runs.items():
        time_ns = statistics.median(r["cpu_time"] for r in repetitions)
        items = statistics.median(r.get("items_per_second", 0) * r["cpu_time"] * 1e-9 for r in repetitions)
        sides.setdefault(row, {})[who] = {"time_ns": time_ns, "items": items, "share": repetitions[0].get("share")}
    return sides, data["context"]


def pair(sides):
    """{row: {ours_ns, peer, peer_ns, ratio, ...}} of the rows that have both sides."""
    rows = {}
    for row, both in sides.items():
        peer = next((who for who in both if who != OURS), None)
        if peer is None or OURS not in both:
            continue
        ours, other = both[OURS], both[peer]
        rows[row] = {"ours_ns": ours["time_ns"], "peer": peer, "peer_ns": other["time_ns"],
                     "ratio": other["time_ns"] / ours["time_ns"],
                     "ours_items": ours["items"], "peer_items": other["items"]}
        for name, side in (("ours", ours), ("peer", other)):
            if side["share"] is not None:
                rows[row][f"{name}_share"] = side["share"]
    order = {name: i for i, name in enumerate(ABOUT)}
    return dict(sorted(rows.items(), key=lambda item: (order.get(item[0], len(order)), item[0])))


def wanted(name, context):
    """The least ratio of a row, or None."""
    ratio = WANTED.get(name)
    return ratio.get(context["instruction_set"]) if isinstance(ratio, dict) else ratio


def machine(context, revision):
    with open("/proc/cpuinfo") as file:
        told = dict(line.split(":", 1) for line in file.read().replace("\t", "").splitlines() if ":" in line)
    model, family, number = (told.get(key, "unknown").strip() for key in ("model name", "cpu family", "model"))
    return (f"{model} (family {family}, model {number}), {context['num_cpus']} cores, one thread; kernels: {context['instruction_set']}; "
            f"compiler {context['compiler']}; OpenCV {context['opencv']}; libbenchmark {context['libbenchmark']}; "
            f"frames: {context['frames']}; source: {revision}.")


def time_text(ns):
    if ns < 1e3:
        return f"{ns:.0f} ns"
    return f"{ns / 1e6:.3g} ms" if ns >= 1e6 else f"{ns / 1e3:.3g} us"


def table(rows):
    lines = ["| row | what | ours | peer | its time | peer / ours | corners, features or queries: ours, peer | "
             "time of each: ours, peer | recall: ours, peer |",
             "|---|---|---|---|---|---|---|---|---|"]
    for name, r in rows.items():
        counts = ", ".join(f"{r[side + '_items']:.0f}" for side in ("ours", "peer"))
        each = ", ".join(time_text(r[side + "_ns"] / r[side + "_items"]) if r[side + "_items"] else "-"
                         for side in ("ours", "peer"))
        shares = ", ".join(f"{r[side]:.3f}" if side in r else "-" for side in ("ours_share", "peer_share"))
        lines.append(f"| {name} | {ABOUT.get(name, '')} | {time_text(r['ours_ns'])} | {r['peer']} | "
                     f"{time_text(r['peer_ns'])} | **{r['ratio']:.1f}** | {counts} | {each} | "
                     f"{shares if shares != '-, -' else ''} |")
    return "\n".join(lines)


def wanted_table(rows, context):
    """What was to be reached and what was."""
    lines = ["| row | wanted: peer / ours at least | reached |", "|---|---|---|"]
    for name, r in rows.items():
        least = wanted(name, context)
        if least is None:
            continue
        lines.append(f"| {name} | {least} | {r['ratio']:.1f}{', **missed**' if r['ratio'] < least else ''} |")
    return "\n".join(lines)


def draw_passes(rows, path):
    found = [p for p in PASSES if f"passes{p}_kitti" in rows]
    if not found:
        return False
    figure, (time, speed, share) = plt.subplots(1, 3, figsize=(14, 4))
    for side, label in (("ours", "vector"), ("peer", "scalar")):
        time.plot(found, [rows[f"passes{p}_kitti"][f"{side}_ns"] / 1e6 for p in found], "o-", label=label)
        speed.plot(found, [rows[f"passes{p}_kitti"][f"{side}_items"] / rows[f"passes{p}_kitti"][f"{side}_ns"] * 1e3
                           for p in found], "o-", label=label)
    speed.set(xlabel="sampling passes", ylabel="corners / us", xscale="log", yscale="log",
              title="corners per microsecond")
    time.set(xlabel="sampling passes", ylabel="ms", xscale="log", ylim=(0, None), title="time of a frame")
    time.legend()
    speed.legend()
    all_corners = rows[f"passes{found[-1]}_kitti"]["ours_items"]
    share.plot(found, [100 * rows[f"passes{p}_kitti"]["ours_items"] / all_corners for p in found], "o-")
    share.set(xlabel="sampling passes", ylabel="%", xscale="log", ylim=(0, 105), title="share of the corners found")
    for axes in (time, speed, share):
        axes.set_xticks(found)
        axes.set_xticklabels([str(p) for p in found])
        axes.grid(alpha=0.3)
    figure.tight_layout()
    figure.savefig(path, dpi=110)
    return True


def size_of(row):
    return int(row.rsplit("_", 1)[1].rstrip("k")) * 1000


def draw_map_sizes(rows, path):
    figure, (time, recall) = plt.subplots(1, 2, figsize=(10, 4))
    drawn = False
    for kind, side, label in (("exact", "ours", "exact, ours"), ("exact", "peer", "cv::BFMatcher"),
                              ("index", "ours", "index, ours"), ("index", "peer", "FLANN hierarchical")):
        names = sorted((r for r in rows if r.startswith(kind + "_") and r.rsplit("_", 1)[1].endswith("k")
                        and r.count("_") == 1), key=size_of)
        if not names:
            continue
        drawn = True
        sizes = [size_of(r) for r in names]
        time.plot(sizes, [rows[r][f"{side}_ns"] / rows[r][f"{side}_items"] / 1e3 for r in names], "o-", label=label)
        if f"{side}_share" in rows[names[0]]:
            recall.plot(sizes, [100 * rows[r][f"{side}_share"] for r in names], "o-", label=label)
    time.set(xlabel="descriptors in the map", ylabel="us / query", xscale="log", yscale="log", title="matching time")
    recall.set(xlabel="descriptors in the map", ylabel="%", xscale="log", title="recall of the exact neighbour")
    for axes in (time, recall):
        axes.grid(alpha=0.3)
        if axes.lines:
            axes.legend()
    figure.tight_layout()
    figure.savefig(path, dpi=110)
    return drawn


def page(rows, others, context, revision, pictures, quality):
    passes = {r: v for r, v in rows.items() if r.startswith("passes")}
    main_rows = {r: v for r, v in rows.items() if r not in passes and r not in others}
    parts = ["# Front end: measured beside its peers", "",
             "Made by `scripts/benchmark`; do not edit. Medians of repetitions that alternate at random between all "
             "rows; frames rotate. Ratios hold for one run; absolute times are a rough scale.", "",
             machine(context, revision), "", table(main_rows), ""]
    if others:
        parts += ["## Other instruction sets of the same machine", "",
                  "Rows ending in `_avx2`: a second run with `ARDRONE_VSLAM_KERNELS=avx2`.", "",
                  table({r: rows[r] for r in others}), ""]
    parts += ["## Wanted and reached", "", wanted_table(rows, context), ""]
    if passes:
        parts += ["## Sampling passes", "", "FAST-12, t = 35, climbing; every pixel of a 4x4 block is a pass. What "
                  "follows from it: [docs/front_end.md](../docs/front_end.md).", "", table(passes), ""]
    for title, file in pictures:
        parts += [f"![{title}]({file})", ""]
    if quality:
        parts += [quality]
    return "\n".join(parts)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("measured", help="front_end_benchmark's --benchmark_out")
    parser.add_argument("--also", action="append", default=[],
                        help="of another instruction set: its rows get their names with that appended")
    parser.add_argument("--revision", default="unknown", help="of the source, for the page")
    parser.add_argument("--json", help="where to write the rows")
    parser.add_argument("--page", help="where to write the page; plots go beside it")
    parser.add_argument("--part", action="append", default=[], help="a page part to append; may be repeated")
    options = parser.parse_args()
    sides, context = read_sides(options.measured)
    rows = pair(sides)
    others = []
    for path in options.also:
        other_sides, other_context = read_sides(path)
        for name, row in pair(other_sides).items():
            others.append(f"{name}_{other_context['instruction_set']}")
            rows[others[-1]] = row
            ABOUT[others[-1]] = ABOUT.get(name, "")
    for name, r in rows.items():
        print(f"{name:24} {time_text(r['ours_ns']):>9}  {r['peer']:26} {time_text(r['peer_ns']):>9}  "
              f"{r['ratio']:6.2f} x")
    if options.json:
        with open(options.json, "w") as file:
            json.dump(rows, file, indent=2)
    if options.page:
        folder = os.path.dirname(os.path.abspath(options.page))
        os.makedirs(os.path.join(folder, "plots"), exist_ok=True)
        pictures = []
        for title, name, draw in (("time, corners and their share against sampling passes", "passes.png", draw_passes),
                                  ("matching time and recall against map size", "map_size.png", draw_map_sizes)):
            if draw(rows, os.path.join(folder, "plots", name)):
                pictures.append((title, f"plots/{name}"))
        parts = "".join(open(part).read() for part in options.part)
        with open(options.page, "w") as file:
            file.write(page(rows, others, context, options.revision, pictures, parts))


if __name__ == "__main__":
    main()
