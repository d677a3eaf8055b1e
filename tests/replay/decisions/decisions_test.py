"""The whole way of one recording to verified decisions: source -> nanomap-replay -> check, as one test.

Exit status: 0 no decision is at fault and every planted fault was seen, 1 otherwise, 77 the recording is not on this
machine.
"""

import argparse
import os
import subprocess
import sys
from pathlib import Path

from check_decisions import check
from planted import PLANTED

SKIPPED = 77
FAULTS_SHOWN = 10
DATA_FOLDER = "NANOMAP_DATA_DIR"
# A status within rounding of another may rightly go either way.
AMBIGUOUS_SHARE = 0.02


def run(*command) -> None:
    """Raises subprocess.CalledProcessError; the program's own words go to the test's output."""
    print("$", *command, flush=True)
    subprocess.run([str(part) for part in command], check=True)


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--source", choices=("import", "generate"), required=True)
    parser.add_argument("--program", type=Path, required=True, help="nanomap-import or nanomap-generate")
    parser.add_argument("--replay", type=Path, required=True, help="nanomap-replay")
    parser.add_argument("--config", type=Path, required=True)
    parser.add_argument("--set", action="append", default=[], help="section.key=value, over the configuration file")
    parser.add_argument("--work", type=Path, required=True, help="folder for the logs")
    parser.add_argument("--goal", help="x,y,z [m] in W, for a recording that holds none")
    parser.add_argument("--least-verified", type=int, required=True, help="fail if fewer decisions could be checked")
    parser.add_argument("--no-place-for", action="append", default=[], choices=list(PLANTED),
                        help="planted fault that this recording cannot carry")
    parser.add_argument("arguments", nargs="*", help="of the source's program, behind --")
    args = parser.parse_args()

    source = list(args.arguments)
    if args.source == "import":
        root = os.environ.get(DATA_FOLDER)
        folder = Path(root) / "kinect_office" if root else None
        if folder is None or not folder.is_dir():
            print(f"Skipped: {DATA_FOLDER} names no folder with kinect_office in it.")
            return SKIPPED
        source.insert(0, folder)

    args.work.mkdir(parents=True, exist_ok=True)
    log, decisions = args.work / "input.log", args.work / "decisions.log"
    goal = [] if args.goal is None else ["--goal", args.goal]
    run(args.program, *source, "--out", log)
    overrides = [f"--set={override}" for override in args.set]
    run(args.replay, log, "--config", args.config, *overrides, "--decisions", decisions, *goal)

    outcome = check(log, decisions, args.config, args.set)
    print(outcome.summary())
    faults = list(outcome.faults)
    if outcome.verified < args.least_verified:
        faults.append(f"only {outcome.verified} decisions have a verified brake")
    if outcome.ambiguous > AMBIGUOUS_SHARE * outcome.verified:
        faults.append(f"{outcome.ambiguous} of {outcome.verified} decisions hang on rounding: too many for chance")
    faults += [f"the check is blind to: {name}" for name, seen in outcome.planted.items() if not seen]
    untried = set(PLANTED) - set(outcome.planted) - set(args.no_place_for)
    faults += [f"no decision could carry: {name}" for name in sorted(untried)]
    for fault in faults[:FAULTS_SHOWN]:
        print("FAULT", fault)
    if faults:
        print(f"{len(faults)} faults")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
