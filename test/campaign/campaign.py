# SPDX-License-Identifier: BSD-3-Clause
"""Flies rendered flights with one fault each through the nodelets and prints what became of them; scripts/fault_campaign runs it."""
import argparse
import concurrent.futures
import json
import os
import subprocess
import sys

from faults import FAULTS
from judge import failures_of, figures_of, table_of

SECONDS, RATE_HZ, TRIAL_S = 30, 10, 240
HERE = os.path.dirname(os.path.abspath(__file__))


def render(make_world, work, name, *options):
    path = os.path.join(work, f"{name}.bag")
    if not os.path.exists(path):
        subprocess.run([make_world, "laps", "--seconds", str(SECONDS), "--rate", str(RATE_HZ), "--out", path, *options], check=True,
                       stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    return path


def fly(fault, seed, flight, other, work):
    folder = os.path.join(work, f"{fault.name}_{seed}")
    os.makedirs(folder, exist_ok=True)
    command = [sys.executable, "-B", os.path.join(HERE, "trial.py"), fault.name, "--flight", flight, "--other", other, "--seed", str(seed),
               "--folder", folder]
    try:
        done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, universal_newlines=True, timeout=TRIAL_S, check=False)
    except subprocess.TimeoutExpired:
        return {"fault": fault.name, "seed": seed, "said": f"not done after {TRIAL_S} s"}
    if done.returncode:
        return {"fault": fault.name, "seed": seed, "said": (done.stderr.strip().splitlines() or ["nothing"])[-1]}
    return json.loads(done.stdout)


def main():
    parser = argparse.ArgumentParser(prog="fault_campaign", description=__doc__.split(";")[0] + ".")
    parser.add_argument("--quick", action="store_true", help="a few faults, one seed: a minute or so")
    parser.add_argument("--list", action="store_true", help="the faults, with a line about each")
    parser.add_argument("--fault", action="append", metavar="NAME", help="this one alone; may be given often")
    parser.add_argument("--seeds", type=int, default=0, metavar="N", help="of the odometry's noise; default: 3, with --quick 1")
    parser.add_argument("--jobs", type=int, default=1, metavar="N", help="flights at a time; default: %(default)s")
    parser.add_argument("--json", metavar="FILE", help="all figures")
    parser.add_argument("--no-build", action="store_true", help="fly with what was built before")
    parser.add_argument("--make-world", required=True, help=argparse.SUPPRESS)
    parser.add_argument("--work", metavar="FOLDER", help="for flights and logs; a flight that is there is not rendered again; default: fault_campaign in the build folder")
    parser.add_argument("--version", action="store_true", help="of the package")  # scripts/fault_campaign answers
    arguments = parser.parse_args()
    if arguments.list:
        print("\n".join(f"{fault.name:22} {fault.of:10} {fault.what}" for fault in FAULTS))
        return 0
    unknown = set(arguments.fault or []) - {fault.name for fault in FAULTS}
    if unknown:
        parser.error(f"no such fault: {', '.join(sorted(unknown))}; --list names all")
    faults = [fault for fault in FAULTS if fault.name in arguments.fault] if arguments.fault else \
             [fault for fault in FAULTS if fault.quick or not arguments.quick]
    seeds = range(1, 1 + (arguments.seeds or (1 if arguments.quick else 3)))

    work = os.path.abspath(arguments.work)
    os.makedirs(work, exist_ok=True)
    other = render(arguments.make_world, work, "other", "--world-seed", "1", "--seed", "9")
    flights = {seed: render(arguments.make_world, work, f"flight_{seed}", "--seed", str(seed)) for seed in seeds}
    trials, failed = {fault.name: [] for fault in faults}, 0
    with concurrent.futures.ThreadPoolExecutor(arguments.jobs) as pool:
        running = [(fault, pool.submit(fly, fault, seed, flights[seed], other, work)) for fault in faults for seed in seeds]
        for done, (fault, future) in enumerate(running, 1):
            trial = future.result()
            trials[fault.name].append(trial)
            failures = failures_of(fault, trial)
            failed += bool(failures) and not fault.missed
            verdict = "as expected" if not failures else ("known: " if fault.missed else "FAILED: ") + "; ".join(failures)
            print(f"{done} / {len(running)} {fault.name}, seed {trial['seed']}: {verdict}", file=sys.stderr, flush=True)
    print(table_of(faults, trials))
    missed = [fault for fault in faults if fault.missed and any(failures_of(fault, trial) for trial in trials[fault.name])]
    flown = sum(len(trial) for trial in trials.values())
    print(f"\n{flown} flights, {failed} not as expected" + (f"; known and not mended: {', '.join(fault.name for fault in missed)}" if missed else ""))
    if arguments.json:
        with open(arguments.json, "w", encoding="utf-8") as file:
            json.dump([{**{key: value for key, value in trial.items() if key != "rows"}, **(figures_of(trial) if "rows" in trial else {}),
                        "failures": failures_of(fault, trial)} for fault in faults for trial in trials[fault.name]], file, indent=1)
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
