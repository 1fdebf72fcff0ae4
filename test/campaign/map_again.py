# SPDX-License-Identifier: BSD-3-Clause
"""Flies a sequence, then again in the map of each flight, as flown and refined; scripts/map_again runs it."""
import argparse
import concurrent.futures
import json
import os
import shutil
import sys

import numpy as np
from ardrone_vslam_evaluation.associate import associate
from ardrone_vslam_evaluation.read_text import read_tum
from map_campaign import SAME_STAMP_S, Campaign, add_usual_options, show

KINDS = ("flown", "refined")
NOT_FOUND_EXIT = 3  # 1: a program failed
FLIGHT = {"in flight": ("fused_ate_rmse_scale_removed_m", "fused_ate_rmse_aligned_m"),
          "refined": ("refined_ate_rmse_scale_removed_m", "refined_ate_rmse_aligned_m")}
AGAIN = ("fused_ate_rmse_m", "map_scale_removed_m", "fused_ate_rmse_aligned_m", "nees_mean", "outside_3_sigma", "map_found_s")


class Again:
    def __init__(self, campaign, options):
        self.campaign, self.options = campaign, options

    def fly(self, frames, seed, out, *more):
        """A flight's summary. Exit code 1 is a flight that was not found."""
        chosen = ["--frames", frames] if frames else []
        code, said = self.campaign.run("replay", self.options.sequence, "--odometry-profile", self.options.profile, "--seed", seed, "--out", out,
                                       *chosen, *more, *self.options.replay)
        try:
            with open(os.path.join(out, "summary.json"), encoding="utf-8") as file:
                summary = json.load(file)
        except OSError:
            raise SystemExit(f"map_again: replay {self.options.sequence}, seed {seed}: exit code {code}: {said.strip()}") from None
        if code != int("--map" in more and summary["map_found_s"] is None):
            raise SystemExit(f"map_again: replay {self.options.sequence}, seed {seed}: exit code {code}: {said.strip()}")
        return summary

    def make_map(self, seed, kind):
        """Its file and its flight's summary, with where its truth begins."""
        out, file = self.campaign.path(f"{kind}_{seed}"), self.campaign.path(f"{kind}_{seed}.vmap")
        shutil.rmtree(out, ignore_errors=True)  # of a run before
        summary = self.fly(self.options.frames, seed, out, "--save-map", file, *(["--refine"] if kind == "refined" else []))
        summary["start_m"] = read_tum(os.path.join(out, "truth.tum")).positions_m[0]
        return file, summary

    def fly_in(self, map_file, flown, seed, kind):
        out = self.campaign.path(f"in_{kind}_{seed}")
        shutil.rmtree(out, ignore_errors=True)
        summary = self.fly(self.options.flight_frames or self.options.frames, seed, out, "--map", map_file, "--localise-only")
        if summary["map_found_s"] is not None:
            summary["map_scale_removed_m"] = error_in_scale_m(out, flown["start_m"], flown["odometry_scale_error"])
        shutil.rmtree(out)
        return {key: summary.get(key) for key in AGAIN}

    def try_seed(self, seed):
        tries = {}
        for kind in KINDS:
            map_file, flown = self.make_map(seed, kind)
            if kind == "refined":
                tries.update({key: flown[key] for keys in FLIGHT.values() for key in keys})
                tries.update({key: flown[key] for key in ("refined_keyframes", "refined_views", "refine_seconds")})
            tries[kind] = [self.fly_in(map_file, flown, later, kind) for later in self.later(seed)]
            shutil.rmtree(self.campaign.path(f"{kind}_{seed}"))
        return tries

    def later(self, seed):
        first = max(self.options.seeds)
        return [1 + first + seed] if len(self.options.seeds) > 1 else range(1 + first, 1 + first + self.options.flights)


def error_in_scale_m(run, start_m, scale_error):
    """RMSE beside the truth as long as the map's odometry took it to be: stretched about the first pose of the map's flight."""
    pairs = associate(read_tum(os.path.join(run, "fused.tum")), read_tum(os.path.join(run, "truth.tum")), SAME_STAMP_S)
    off_m = pairs.estimate.positions_m - (start_m + (1 + scale_error) * (pairs.truth.positions_m - start_m))
    return float(np.sqrt((off_m**2).sum(axis=1).mean()))


def median(rows, key):
    return float(np.median([row[key] for row in rows if row[key] is not None] or [np.nan]))


def report(tries):
    """@return whether all flights were found"""
    print("Errors are RMSE in metres, medians.\n\n| flight | scale removed | after the best rotation and translation |\n| --- | ---: | ---: |")
    for name, keys in FLIGHT.items():
        print(f"| {name} | " + " | ".join(f"{median(tries, key):.3f}" for key in keys) + " |")
    print("\n%.0f keyframes, %.0f views, refined in %.0f s.\n" % tuple(median(tries, key) for key in ("refined_keyframes", "refined_views", "refine_seconds")))
    print("| again in the map | as it is | the map's scale error removed | after the best rotation and translation | NEES | outside 3 sigma | "
          "found after [s] | found |\n| --- " + "| ---: " * 7 + "|")
    all_found = True
    for kind in KINDS:
        rows = [row for one in tries for row in one[kind]]
        found = sum(row["map_found_s"] is not None for row in rows)
        all_found &= found == len(rows)
        print(f"| {kind} | " + " | ".join(f"{median(rows, key):.3f}" for key in AGAIN) + f" | {found} of {len(rows)} |")
    return all_found


def seeds_of(text):
    first, _, last = text.partition(":")
    return range(int(first), int(last or first) + 1)


def main():
    parser = argparse.ArgumentParser(prog="map_again", description=__doc__.split(";")[0] + ".", epilog="What follows -- is for replay. Exit code 3: a flight was not found.")
    parser.add_argument("sequence", help="a folder or bag with truth")
    parser.add_argument("--frames", metavar="A:B", help="those of the map's flight")
    parser.add_argument("--flight-frames", metavar="A:B", help="those of the flight in it; default: the same")
    parser.add_argument("--profile", default="drone", help="of the odometry; default: %(default)s")
    parser.add_argument("--seeds", type=seeds_of, default="0:19", metavar="A:B", help="a map each, and the next seeds a flight in each; default: %(default)s")
    parser.add_argument("--flights", type=int, default=20, metavar="N", help="in the one map of a single seed; default: %(default)s")
    add_usual_options(parser)
    end = sys.argv.index("--") if "--" in sys.argv else len(sys.argv)
    arguments = parser.parse_args(sys.argv[1:end])
    arguments.replay = sys.argv[end + 1:]

    os.makedirs(arguments.work, exist_ok=True)
    again = Again(Campaign(arguments.programs, os.path.abspath(arguments.work)), arguments)
    with concurrent.futures.ThreadPoolExecutor(arguments.jobs) as pool:
        tries = show("seed", pool.map(again.try_seed, arguments.seeds), len(arguments.seeds))
    if arguments.json:
        with open(arguments.json, "w", encoding="utf-8") as file:
            json.dump(tries, file, indent=1)
    return 0 if report(tries) else NOT_FOUND_EXIT


if __name__ == "__main__":
    sys.exit(main())
