# SPDX-License-Identifier: BSD-3-Clause
"""Repeats the thesis's tables and figures and writes docs/reproduction.md; scripts/reproduce builds what it needs and calls it."""

import argparse
import io
import os
import sys
import time

import description
import flights
import front_end
import geometry
from ardrone_vslam_evaluation.faults import InputFault, MachineFault
from PIL import Image
from tools import Tools

# In the order of the page.
SECTIONS = {"detectors": front_end.detectors, "repeatability": front_end.repeatability, "corner_speed": front_end.corner_speed, "sampling": front_end.sampling,
            "descriptors": description.descriptors, "quality": description.quality, "matches": description.matches, "lens": geometry.lens,
            "mean_deviation": geometry.mean_deviation, "landmark_sigma": geometry.landmark_sigma, "hover": flights.hover, "kitti": flights.kitti,
            "ardrone_2d": flights.ardrone_2d, "thresholds": flights.thresholds}

HEAD = """# The thesis, repeated

Written by `scripts/reproduce`, not by hand. This package implements a master thesis, "Visual SLAM on-board an AR.drone 2.0". Each section repeats one of its tables or
figures with this package's code: what is printed there, what comes out here, and why they differ. Times are of {machine} and are a rough scale. All other
numbers are the same each time. "Must lie within" is tested (`ctest -R reproduction`, with fewer pictures and frames). What the thesis calls the observer is called
the odometry on all other pages. "Landmarks alone" is [not free of it](thesis_estimator.md#what-position-by-landmarks-alone-is).
Tracks keep to whole pixels here, as in the thesis (`replay --whole-pixels`), so rows of the default estimator are not those of [results.md](results.md).

Not repeated are the times on the drone itself, and the figures that explain or show and do not measure:
- 1.1, 1.2a, those of chapter 2, 3.1, 3.2, 3.4, 3.5, 3.9, 3.10, 4.1 to 4.4;
- those of chapter 5 but for the lens, those of chapter 6, 7.1, 7.2.
"""


def arguments_of():
    parser = argparse.ArgumentParser(prog="reproduce", description=__doc__)
    parser.add_argument("--programs", required=True, metavar="DIR", help="where replay, make_world and simulate_landmarks are")
    parser.add_argument("--measurements", required=True, metavar="FILE", help="the program thesis_measurements")
    parser.add_argument("--out", required=True, metavar="DIR", help="for runs and measurements")
    parser.add_argument("--page", metavar="FILE", help="docs/reproduction.md; its pictures go to images/reproduction beside it. Default: in --out")
    parser.add_argument("--kitti", metavar="DIR", help="a sequence of KITTI's odometry set in place of the data folder's")
    parser.add_argument("--sections", nargs="+", choices=SECTIONS, default=list(SECTIONS), metavar="NAME", help="only these, to the page in --out: " + ", ".join(SECTIONS))
    parser.add_argument("--quick", action="store_true", help="fewer pictures, frames and seeds")
    parser.add_argument("--check-arguments", action="store_true", help="do no more than that")
    arguments = parser.parse_args()
    if arguments.page and len(arguments.sections) < len(SECTIONS):
        parser.error("--page needs all sections; without it the page goes to --out")
    if arguments.kitti and not os.path.isdir(os.path.join(arguments.kitti, "image_0")):
        parser.error(f"--kitti {arguments.kitti}: there is no folder image_0 in it; name a folder of KITTI's odometry sequences")
    return arguments


def machine():
    try:
        with open("/proc/cpuinfo", encoding="utf-8") as file:
            return next(line.split(":", 1)[1].strip() for line in file if line.startswith("model name"))
    except (OSError, StopIteration):
        return "one machine"


def save(figure, path):
    """As a palette: a third of the size."""
    buffer = io.BytesIO()
    figure.savefig(buffer, format="png", dpi=80)
    Image.open(buffer).convert("RGB").quantize(128, dither=Image.Dither.NONE).save(path, optimize=True)


def write(sections, page, claims_hold):
    pictures = os.path.join(os.path.dirname(page), "images", "reproduction")
    os.makedirs(pictures, exist_ok=True)
    lines = [HEAD.format(machine=machine())]
    for section in sections:
        lines += [f"## {section.title}\n", "\n\n".join(section.parts) + "\n"]
        lines += ["| what must hold | here | must lie within |", "| --- | ---: | ---: |"]
        lines += [f"| {claim.what} | {claim.value:.3g} | {claim.bounds()} |" for claim in section.claims] + [""]
        for name, figure in section.pictures.items():
            save(figure, os.path.join(pictures, name + ".png"))
    if not claims_hold:
        lines.insert(1, "**Some numbers are out of their bounds.**\n")
    with open(page, "w", encoding="utf-8") as file:
        file.write("\n".join(lines))
    print(f"written: {page}")


def run(arguments):
    tools = Tools(arguments.programs, arguments.measurements, arguments.out, arguments.quick, arguments.kitti)
    sections = []
    for i, name in enumerate(arguments.sections):
        begin = time.monotonic()
        print(f"{i + 1} of {len(arguments.sections)}: {name} ...", end=" ", flush=True)
        result = SECTIONS[name](tools)
        sections += result if isinstance(result, tuple) else (result,)
        print(f"{time.monotonic() - begin:.0f} s", flush=True)
    broken = [(section, claim) for section in sections for claim in section.claims if not claim.holds()]
    write(sections, os.path.abspath(arguments.page or os.path.join(arguments.out, "reproduction.md")), not broken)
    for section, claim in broken:
        print(f"reproduce: {section.title}: {claim.what} is {claim.value:.4g} but must be {claim.bounds()}", file=sys.stderr)
    return 3 if broken else 0


def main():
    arguments = arguments_of()
    if arguments.check_arguments:
        return 0
    try:
        return run(arguments)
    except InputFault as fault:
        print(f"reproduce: {fault}", file=sys.stderr)
        return 2
    except (MachineFault, OSError) as fault:
        print(f"reproduce: {fault}", file=sys.stderr)
        return 1


if __name__ == "__main__":
    sys.exit(main())
