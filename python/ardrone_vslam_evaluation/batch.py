# SPDX-License-Identifier: BSD-3-Clause
"""scripts/evaluate_all: arguments in; runs, table and comparison out."""

import argparse
import os
import re
import sys

from . import baseline, batch_jobs, batch_results, honesty, sweep_command
from .batch_run import Programs, run_jobs
from .command import write
from .faults import InputFault, MachineFault

EPILOG = """In WORK: results.md, the same bytes from the same programs; times.md; sequences/, runs/SEQUENCE/PROFILE/ESTIMATOR/ and their
logs. A later call does only what is not there yet or follows from a program, configuration or option that changed. Exit codes: 0 done,
1 something is worse than the baseline, failed or is not installed, 2 wrong usage or input."""


def names(text):
    """Separated by blanks, as profiles may hold commas."""
    return text.split()


def share(text):
    value = float(text)
    if not 0 <= value < 100:
        raise argparse.ArgumentTypeError(f"{text}: must be at least 0; 0.1 is 10 %")
    return value


def seeds(text):
    match = re.fullmatch(r"(\d+):(\d+)", text)
    if not match or int(match[1]) > int(match[2]):
        raise argparse.ArgumentTypeError(f"'{text}': must be A:B with A not above B, for example 1:3")
    return text


def parser_of(source):
    parser = argparse.ArgumentParser(prog="evaluate_all", epilog=EPILOG, description=(
        "Builds the package, runs all sequences with all profiles, estimators and seeds, writes one table and tells what became worse."))
    parser.add_argument("--quick", action="store_true", help="only three short synthetic flights, with some changes of "
                        "--honesty; they are among the others, too")
    parser.add_argument("--selection", metavar="FILE", help="sequences of your own instead (docs/evaluate.md)")
    parser.add_argument("--kitti", metavar="DIR", help="also KITTI's sequences in it")
    for name, what in (("sequences", "names"), ("profiles", "names"), ("estimators", " or ".join(batch_jobs.ESTIMATORS))):
        parser.add_argument(f"--{name}", type=names, metavar="'A B'", help=f"only these ({what})")
    parser.add_argument("--seeds", type=seeds, default=batch_jobs.SEEDS, metavar="A:B", help="of the odometry's noise; default %(default)s")
    parser.add_argument("--sweep", action="append", metavar="NAME=V1,V2", help="instead: runs with this parameter at these values, and at what it is "
                        "else, into WORK/sweep.md and sweep.png; may be repeated, one at a time is varied")
    parser.add_argument("--tuning", action="store_true", help="instead: all parameters of docs/tuning_sweep.json; with --update into docs/tuning.md")
    parser.add_argument("--honesty", action="store_true", help="instead: flights whose set-up is wrong, and larger, mirrored or thinned ones, and what "
                        "becomes of the pose; with --update into docs/honesty.md")
    parser.add_argument("--list", action="store_true", help="only say what would run")
    parser.add_argument("--jobs", default="100%", metavar="N", help="at a time on each machine; default: its cores, or the N of --sshlogin")
    parser.add_argument("--sshlogin", action="append", default=[], metavar="HOST",
                        help="GNU parallel's: there, not here (N/HOST: N at a time; `:` is this machine); the same paths must be there")
    parser.add_argument("--work", metavar="DIR", default=os.path.join(source, "build", "evaluate_all"), help="default: %(default)s")
    parser.add_argument("--programs", metavar="DIR", help="replay and make_world are there: nothing is built")
    parser.add_argument("--baseline", metavar="FILE", help="what the results are compared with; default: docs/results_baseline.json")
    parser.add_argument("--margin", type=share, default=baseline.MARGIN, metavar="X",
                        help="by which a median may be worse; default %(default)s of it (and 5 mm, or 0.01 of a ratio)")
    parser.add_argument("--update", action="store_true", help="write docs/results.md and the baseline from this run, compare nothing")
    return parser


def sequences_of(arguments):
    if arguments.selection:
        sequences = batch_jobs.read_selection(arguments.selection)
    else:
        sequences = list(batch_jobs.QUICK)
        if not arguments.quick:
            sequences += batch_jobs.WHOLE_FLIGHTS
            data = os.environ.get("ARDRONE_VSLAM_DATA")
            sequences += batch_jobs.real_sequences(data) if data else []
    return sequences + (batch_jobs.kitti_sequences(arguments.kitti) if arguments.kitti else [])


def selection_name(arguments):
    if arguments.selection:
        return os.path.basename(arguments.selection)
    if arguments.quick:
        return "`--quick`"
    return "all" if os.environ.get("ARDRONE_VSLAM_DATA") else "all but the real sequences, as ARDRONE_VSLAM_DATA was not set"


def judge(rows, before, margin, must_have):
    """Prints. @param must_have  all rows are to be in the baseline. @return whether all is as good as before"""
    worse, better, compared = baseline.compare(rows, before, margin)
    print(f"Compared with the baseline: {compared} of {len(rows)} rows; {len(worse)} numbers worse, {len(better)} better by more than "
          f"{margin:.0%}.")
    for text in better:
        print(f"better: {text}")
    for text in worse:
        print(f"worse: {text}", file=sys.stderr)
    if must_have and compared < len(rows):
        print(f"evaluate_all: {len(rows) - compared} rows are not in the baseline (other options or defaults?), so nothing holds them; "
              "write it anew by --update", file=sys.stderr)
        return False
    return not worse


def run(arguments, source):
    jobs = (honesty.jobs_of(arguments.seeds) if arguments.honesty else
            batch_jobs.jobs_of(sequences_of(arguments), arguments.seeds, arguments.sequences, arguments.profiles, arguments.estimators))
    if arguments.list:
        print("\n".join(f"{job.name()} seeds {job.seeds}" for job in jobs))
        return True
    path = arguments.baseline or os.path.join(source, "docs", "results_baseline.json")
    is_compared = not (arguments.update or arguments.sweep or arguments.tuning or arguments.honesty)
    before = baseline.read(path) if is_compared else {}
    work = os.path.abspath(arguments.work)
    try:
        os.makedirs(work, exist_ok=True)
    except OSError as error:
        raise MachineFault(f"{work}: cannot be made ({error.strerror}); choose another --work") from None
    if arguments.tuning:
        return sweep_command.run_tuning(arguments, source, work)
    if arguments.sweep:
        return sweep_command.run_sweep(arguments, [job for job in jobs if not job.options], source, work)
    programs = Programs(os.path.abspath(arguments.programs), os.path.join(source, "config"))
    if arguments.honesty:
        faults = honesty.run(arguments, programs, source, work)
        for text in faults:
            print(f"evaluate_all: {text}", file=sys.stderr)
        return not faults
    folders, faults = run_jobs(jobs, programs, work, arguments.jobs, arguments.sshlogin)
    rows = [batch_results.row_of(job, folder) for job, folder in folders.items()]
    table = batch_results.page(rows, selection_name(arguments))
    write(os.path.join(work, "results.md"), table)
    write(os.path.join(work, "times.md"), batch_results.times_page(rows))
    print(batch_results.markdown(rows, batch_results.COLUMNS))
    for text in faults:
        print(f"evaluate_all: {text}", file=sys.stderr)
    if not arguments.update:
        must_have = not (arguments.selection or arguments.kitti or arguments.baseline) and arguments.seeds == batch_jobs.SEEDS
        return judge(rows, before, arguments.margin, must_have) and not faults
    if not faults:
        write(os.path.join(source, "docs", "results.md"), table)
        write(path, baseline.as_json(rows))
    return not faults


def main():
    source = os.path.normpath(os.path.join(os.path.dirname(os.path.realpath(__file__)), "..", ".."))
    parser = parser_of(source)
    arguments = parser.parse_args()
    if arguments.update and (arguments.quick or arguments.sequences or arguments.profiles or arguments.estimators or arguments.baseline):
        parser.error("--update makes the committed table and baseline, so it goes with no part of a selection and no other --baseline")
    if arguments.tuning and (arguments.sweep or arguments.sequences or arguments.profiles or arguments.estimators or arguments.selection):
        parser.error("--tuning has sequences and values of its own (docs/tuning_sweep.json); for others use --sweep")
    if arguments.sweep and arguments.update:
        parser.error("--sweep updates no page; --tuning does")
    if arguments.honesty and (arguments.quick or arguments.sequences or arguments.profiles or arguments.estimators or arguments.selection):
        parser.error("--honesty has sequences, profiles and faults of its own")
    if not arguments.programs and not arguments.list:
        parser.error("--programs DIR is needed; scripts/evaluate_all builds them and fills it in")
    try:
        return 0 if run(arguments, source) else 1
    except InputFault as fault:
        print(f"evaluate_all: {fault}", file=sys.stderr)
        return 2
    except MachineFault as fault:
        print(f"evaluate_all: {fault}", file=sys.stderr)
        return 1


if __name__ == "__main__":
    sys.exit(main())
