# SPDX-License-Identifier: BSD-3-Clause
"""Looks for rendered flights in the maps of others, of the same room and of rooms like it, and in their own; scripts/map_campaign runs it."""
import argparse
import concurrent.futures
import json
import math
import os
import random
import shutil
import subprocess
import sys

import numpy as np
from ardrone_vslam_evaluation.align import best_alignment
from ardrone_vslam_evaluation.associate import associate
from ardrone_vslam_evaluation.read_text import read_tum
from carried import Carried

RATE_HZ = 10
FLIGHT_S, LAP_S, MAP_S = 10, 22, 40
WRONG_M = 0.5  # off by more (RMSE) is another place
LEAST_FOUND = 0.95
WRONG_EXIT = 3  # 1: a program failed
ROOM, HOTEL = "furnished", "hotel"
SAME_STAMP_S = 0.001


class Campaign:
    def __init__(self, programs, work):
        self.programs, self.work = programs, work

    def run(self, program, *arguments):
        done = subprocess.run([os.path.join(self.programs, program), *map(str, arguments)], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE,
                              universal_newlines=True, check=False)
        return done.returncode, done.stderr

    def must(self, program, *arguments):
        code, said = self.run(program, *arguments)
        if code:
            raise SystemExit(f"map_campaign: {program} {' '.join(map(str, arguments))}: exit code {code}: {said.strip()}")

    def path(self, *parts):
        return os.path.join(self.work, *parts)

    def render(self, name, world, room, seconds, seed, start=None):
        options = [] if start is None else ["--start", "%.2f,%.2f,%.2f" % start]
        self.must("make_world", "laps", "--world", world, "--world-seed", room, "--seconds", seconds, "--rate", RATE_HZ, "--seed", seed,
                  "--out", self.path(name), "--force", *options)

    def make_map(self, name, world, room, seconds, refines):
        """NAME.vmap as flown, NAME_refined.vmap, and the runs' folders beside them."""
        self.render(name, world, room, seconds, room)
        for kind, options in (("", []), ("_refined", ["--refine"]))[:1 + refines]:
            self.must("replay", self.path(name), "--odometry-profile", "drone", "--seed", room, *options,
                      "--save-map", self.path(name + kind + ".vmap"), "--out", self.path(name + kind + "_run"))
        shutil.rmtree(self.path(name))

    def look(self, flight, name, seed):
        """A flight in a map, its odometry beginning at the origin. (found after s, RMSE in m, run folder); None: not found."""
        out = self.path(f"{flight}_in_{name}")
        shutil.rmtree(out, ignore_errors=True)  # of a campaign before
        code, said = self.run("replay", self.path(flight), "--odometry-profile", "drone", "--seed", seed, "--odometry-at-zero",
                              "--map", self.path(name + ".vmap"), "--localise-only", "--out", out)
        try:
            with open(os.path.join(out, "summary.json"), encoding="utf-8") as file:
                summary = json.load(file)
        except OSError:
            raise SystemExit(f"map_campaign: replay {flight} in {name}: exit code {code}: {said.strip()}") from None
        found_s = summary["map_found_s"]
        if code != (1 if found_s is None else 0):
            raise SystemExit(f"map_campaign: replay {flight} in {name}: exit code {code}: {said.strip()}")
        return None if found_s is None else (found_s, summary["fused_ate_rmse_m"], out)


def read_pairs(run):
    """Poses and truth. The truth begins where the place was found."""
    return associate(read_tum(os.path.join(run, "fused.tum")), read_tum(os.path.join(run, "truth.tum")), SAME_STAMP_S)


def add_errors_in_map(tries, flights):
    """RMSE in the map's own frame: by the one rotation and translation that lay all flights in this map on the truth."""
    if not flights:
        return
    way = best_alignment(*(np.concatenate([getattr(flights[i], kind).positions_m for i in sorted(flights)]) for kind in ("estimate", "truth")),
                         with_scale=False)
    for i, pairs in flights.items():
        off_m = way.apply(pairs.estimate).positions_m - pairs.truth.positions_m
        tries[i]["error_in_map_m"] = math.sqrt((off_m**2).sum(axis=1).mean())


def starts_of(count, seed):
    """Anywhere in the room, between its table and its furniture, with any heading."""
    numbers = random.Random(seed)
    return [(numbers.uniform(-2.4, 2.4), numbers.uniform(-1.6, 1.6), numbers.uniform(-math.pi, math.pi)) for _ in range(count)]


def in_one_room(campaign, starts, pool):
    """Another flight in the map of the first one, as flown and refined."""
    campaign.make_map("first", ROOM, 1, MAP_S, refines=True)
    flights = {"first": {}, "first_refined": {}}

    def try_start(i):
        flight = f"start_{i}"
        campaign.render(flight, ROOM, 1, FLIGHT_S, 100 + i, starts[i])
        results = {}
        for name, pairs in flights.items():
            found = campaign.look(flight, name, 100 + i)
            results[name] = found and {"found_s": found[0], "error_m": found[1]}
            if found and found[1] <= WRONG_M:
                pairs[i] = read_pairs(found[2])
            shutil.rmtree(campaign.path(f"{flight}_in_{name}"))
        shutil.rmtree(campaign.path(flight))
        return results

    tries = show("start", pool.map(try_start, range(len(starts))), len(starts))
    tries = {name: [one[name] for one in tries] for name in flights}
    for name, pairs in flights.items():
        add_errors_in_map(tries[name], pairs)
    return tries


def in_rooms_alike(campaign, rooms, starts_in_each, pool):
    """Each flight in the maps of all rooms of the hotel."""
    starts = starts_of(rooms * starts_in_each, 2)

    def make_room(room):
        campaign.make_map(f"room_{room}", HOTEL, room, LAP_S, refines=False)
        for i in range(room * starts_in_each, (room + 1) * starts_in_each):
            campaign.render(f"flight_{i}", HOTEL, room, FLIGHT_S, 100 + i, starts[i])

    def try_flight(i):
        results = []
        for other in range(rooms):
            name = f"room_{other}"
            found = campaign.look(f"flight_{i}", name, 100 + i)
            results.append({"room": i // starts_in_each, "map": other, "start": i, "found_s": found and found[0], "error_m": found and found[1]})
            shutil.rmtree(campaign.path(f"flight_{i}_in_{name}"))
        return results

    show("room", pool.map(make_room, range(rooms)), rooms)
    return sum(show("flight in all maps", pool.map(try_flight, range(len(starts))), len(starts)), [])


def in_own_map(campaign, count, pool):
    """Carried from one place of a room to another."""
    starts = starts_of(2 * count, 3)
    drone = Carried(campaign, ROOM, 1, RATE_HZ)
    tries = pool.map(lambda i: drone.try_carry(f"carry_{i}", starts[2 * i:2 * i + 2], 500 + i), range(count))
    return show("carry", tries, count)


def show(what, results, count):
    done = []
    for result in results:
        done.append(result)
        print(f"{what} {len(done)} / {count}", file=sys.stderr, flush=True)
    return done


def report_room(name, tries):
    """@return whether enough is found, and nothing at a wrong place"""
    wrong = [one for one in tries if one and one["error_m"] > WRONG_M]
    right = [one for one in tries if one and one not in wrong]
    of = {key: [one[key] for one in right] or [math.nan] for key in ("found_s", "error_m", "error_in_map_m")}
    figures = " | ".join(f"{np.median(of[key]):.3f} | {np.percentile(of[key], 95):.3f}" for key in ("error_m", "error_in_map_m"))
    print(f"| {name} | {len(right)} of {len(tries)} | {len(wrong)} | {np.median(of['found_s']):.1f} | {figures} |")
    return not wrong and len(right) >= LEAST_FOUND * len(tries)


def report(results):
    """@return whether all is as it should be"""
    print(f"Flights of {FLIGHT_S} s, {RATE_HZ} images a second.\n\n"
          "| map | found | wrong places | after [s], median | error [m], median | 95 % | in the map's own frame [m], median | 95 % |\n"
          "| --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: |")
    is_well = all([report_room(name, tries) for name, tries in results["one room"].items()])
    own = [one for one in results["rooms alike"] if one["room"] == one["map"]]
    others = [one for one in results["rooms alike"] if one["room"] != one["map"]]
    right = [one for one in own if one["found_s"] is not None and one["error_m"] <= WRONG_M]
    wrong = [one for one in own + others if one["found_s"] is not None and one not in right]
    print(f"\nRooms alike: found in the map of their own room {len(right)} of {len(own)}; at a wrong place, or in the map of another room, "
          f"{len(wrong)} of {len(own) + len(others)}")
    for one in wrong:
        print(f"  start {one['start']} in room {one['room']}: in the map of room {one['map']} after {one['found_s']:.1f} s, off by {one['error_m']:.2f} m")
    found_s = [one["found_s"] for one in results["carried"] if one["found_s"] is not None]
    errors_m = [one["error_m"] for one in results["carried"]]
    print(f"\nCarried elsewhere with the camera covered: found {len(found_s)} of {len(errors_m)}; after {np.median(found_s or [math.nan]):.1f} s (median), "
          f"at most {max(found_s, default=math.nan):.1f} s; at the end off by {np.median(errors_m):.2f} m (median), at most {max(errors_m):.2f} m")
    return is_well and not wrong and len(right) >= LEAST_FOUND * len(own) and len(found_s) >= LEAST_FOUND * len(errors_m)


def add_usual_options(parser):
    """Of scripts/map_campaign and scripts/map_again."""
    parser.add_argument("--jobs", type=int, default=1, metavar="N", help="programs at a time; default: %(default)s")
    parser.add_argument("--json", metavar="FILE", help="all flights")
    parser.add_argument("--no-build", action="store_true", help="with what was built before")
    parser.add_argument("--programs", metavar="FOLDER", required=True, help=argparse.SUPPRESS)
    parser.add_argument("--work", metavar="FOLDER", help="for flights and maps, some GB; default: %(prog)s in the build folder")
    parser.add_argument("--version", action="store_true", help="of the package")  # the script answers


def main():
    parser = argparse.ArgumentParser(prog="map_campaign", description=__doc__.split(";")[0] + ".")
    parser.add_argument("--starts", type=int, default=50, metavar="N", help="flights in one room's map; default: %(default)s")
    parser.add_argument("--rooms", type=int, default=20, metavar="N", help="that are alike; default: %(default)s")
    parser.add_argument("--starts-in-each", type=int, default=3, metavar="N", help="flights in each of these; default: %(default)s")
    parser.add_argument("--carries", type=int, default=20, metavar="N", help="flights that are carried elsewhere; default: %(default)s")
    add_usual_options(parser)
    arguments = parser.parse_args()

    os.makedirs(arguments.work, exist_ok=True)
    campaign = Campaign(arguments.programs, os.path.abspath(arguments.work))
    with concurrent.futures.ThreadPoolExecutor(arguments.jobs) as pool:
        results = {"one room": in_one_room(campaign, starts_of(arguments.starts, 1), pool),
                   "rooms alike": in_rooms_alike(campaign, arguments.rooms, arguments.starts_in_each, pool),
                   "carried": in_own_map(campaign, arguments.carries, pool)}
    if arguments.json:
        with open(arguments.json, "w", encoding="utf-8") as file:
            json.dump(results, file, indent=1)
    return 0 if report(results) else WRONG_EXIT


if __name__ == "__main__":
    sys.exit(main())
