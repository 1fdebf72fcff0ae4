# SPDX-License-Identifier: BSD-3-Clause
"""Arguments in, table, JSON file and report out."""

import argparse
import json
import os
import sys

import numpy as np

from .align import ALIGNMENTS
from .evaluation import Settings
from .faults import InputFault, MachineFault, reason
from .gather import rows_of_files, rows_of_folders
from .table import as_text
from .verdict import told_of

EPILOG = """Trajectories: TUM (stamp tx ty tz qx qy qz qw), KITTI (12 numbers a line), bags with nav_msgs/Odometry, PoseStamped or
PoseWithCovarianceStamped; the kind is told by the content. Folders: what replay, simulate_landmarks and record_run write, of several
seeds or estimators all in it; of one folder, report and numbers go to FOLDER/report.html and FOLDER/evaluation.json unless --html and
--json name others, or --table is given. Exit codes: 0 done, 1 something is not installed or cannot be written, 2 wrong usage or input."""


def positive(text):
    value = float(text)
    if not 0 < value < 1e9:
        raise argparse.ArgumentTypeError(f"{text}: must be above 0")
    return value


def parser_of(version):
    parser = argparse.ArgumentParser(prog="evaluate", epilog=EPILOG, description=(
        "How accurate, consistent and cheap trajectories and runs are: a table, a JSON file and a page with plots."))
    parser.add_argument("folder", nargs="*", help="a run's folder; several are shown side by side")
    parser.add_argument("--truth", metavar="FILE", help="true trajectory")
    parser.add_argument("--estimate", metavar="FILE", nargs="+", action="extend", help="trajectories to compare with it")
    parser.add_argument("--odometry", metavar="FILE", help="what the estimates were made from: tells whether they do no harm")
    parser.add_argument("--odometry-scale-error", type=float, metavar="X", help="drawn for a simulated odometry; 0.01 is 1 %%")
    parser.add_argument("--name", nargs="+", action="extend", help="of the estimates or runs, in their order; default: their paths")
    parser.add_argument("--align", choices=ALIGNMENTS, help="before positions are compared; default: se3 for files, none for folders")
    parser.add_argument("--times", metavar="FILE", help="stamps of KITTI files; default: times.txt beside the truth")
    parser.add_argument("--max-difference", type=positive, default=0.02, metavar="S",
                        help="between the stamps of estimate and truth [s]; default 0.02")
    parser.add_argument("--interpolate", action="store_true",
                        help="the truth between its two neighbours, both within --max-difference, instead of the nearest")
    for name in ("truth", "estimate", "odometry"):
        parser.add_argument(f"--{name}-topic", metavar="TOPIC", help=f"of the {name}'s bag; default: the only one with poses, or the usual")
    parser.add_argument("--json", metavar="FILE", help="all numbers")
    parser.add_argument("--html", metavar="FILE", help="the report: one page with its plots in it")
    parser.add_argument("--table", action="store_true", help="of one folder, too, no files but those that --json and --html name")
    parser.add_argument("--figures", metavar="DIR", help="the report's plots as PNG files, too")
    parser.add_argument("--version", action="version", version=f"%(prog)s {version}")
    return parser


def check(parser, arguments):
    if arguments.folder and (arguments.truth or arguments.estimate or arguments.odometry):
        parser.error("folders hold truth and odometry themselves: give either folders, or --truth and --estimate")
    if not arguments.folder and not (arguments.truth and arguments.estimate):
        parser.error("what shall be evaluated? Give --truth FILE --estimate FILE, or a folder that replay wrote")
    if arguments.odometry_scale_error is not None and not arguments.odometry:
        parser.error("--odometry-scale-error needs --odometry FILE")
    if len(arguments.folder) == 1 and not arguments.table:
        arguments.html = arguments.html or os.path.join(arguments.folder[0], "report.html")
        arguments.json = arguments.json or os.path.join(arguments.folder[0], "evaluation.json")
    arguments.align = arguments.align or ("none" if arguments.folder else "se3")


def plain(value):
    """What JSON knows: None for what is not finite."""
    if isinstance(value, dict):
        return {key: plain(part) for key, part in value.items()}
    if isinstance(value, (list, tuple, np.ndarray)):
        return [plain(part) for part in value]
    if isinstance(value, (np.integer, np.bool_)):
        return value.item()
    if isinstance(value, (float, np.floating)):
        return float(value) if np.isfinite(value) else None
    return value


def write(path, text):
    write_bytes(path, text.encode("utf-8"))


def write_bytes(path, data):
    try:
        with open(path, "wb") as file:
            file.write(data)
    except OSError as error:
        raise MachineFault(f"{path}: cannot be written ({reason(error)}); choose another place") from None
    print(f"written: {path}")


def run(arguments, version):
    settings = Settings(arguments.align, arguments.max_difference, arguments.interpolate or bool(arguments.folder))
    rows, notes = (rows_of_folders if arguments.folder else rows_of_files)(arguments, settings)
    notes += [note for row in rows for note in row.notes]
    print(as_text(rows, arguments.align))
    for row, verdict in told_of(rows):
        print(f"{row.name}: {verdict}")
    for note in notes:
        print(f"evaluate: {note}", file=sys.stderr)
    if arguments.json:
        everything = {"version": version, "align": arguments.align, "max_difference_s": arguments.max_difference,
                      "trajectories": [row.numbers for row in rows], "notes": notes}
        write(arguments.json, json.dumps(plain(everything), indent=2) + "\n")
    if arguments.html or arguments.figures:
        try:
            from . import report
        except ImportError as error:
            raise MachineFault(f"the plots need Debian's python3-matplotlib ({error}); run scripts/install_dependencies") from None
        figures = report.draw(rows)
        if arguments.figures:
            report.write_pictures(figures, arguments.figures)
        if arguments.html:
            write(arguments.html, report.page(rows, figures, notes, arguments.align, version))


def main(version):
    parser = parser_of(version)
    for argument in sys.argv[1:]:
        for rest in ("", "-topic", "-scale-error"):
            if argument.partition("=")[0] == "--observer" + rest:
                parser.error(f"--observer{rest} is called --odometry{rest} now")
    arguments = parser.parse_args()
    check(parser, arguments)
    try:
        run(arguments, version)
    except InputFault as fault:
        print(f"evaluate: {fault}", file=sys.stderr)
        return 2
    except MachineFault as fault:
        print(f"evaluate: {fault}", file=sys.stderr)
        return 1
    except BrokenPipeError:
        return 1
    return 0
