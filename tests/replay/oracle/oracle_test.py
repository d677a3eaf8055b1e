"""The whole way of one recording: source -> nanomap-replay -> oracle, as one test.

Exit status: 0 all answers agree, 1 they do not, 77 the recording is not on this machine.
"""

import argparse
import os
import subprocess
import sys
from pathlib import Path

from check_answers import Sample, check

SKIPPED = 77
MISMATCHES_SHOWN = 5
DATA_FOLDER = "NANOMAP_DATA_DIR"


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
    parser.add_argument("--message-stride", type=int, default=1)
    parser.add_argument("--answer-stride", type=int, default=1)
    parser.add_argument("--expect-corrections", action="store_true", help="fail if the log held none")
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
    log, answers = args.work / "input.log", args.work / "answers.log"
    run(args.program, *source, "--out", log)
    run(args.replay, log, "--config", args.config, *(f"--set={override}" for override in args.set), "--out", answers)

    outcome = check(log, answers, args.config, args.set, Sample(args.message_stride, args.answer_stride))
    tally = outcome.tally
    print(f"compared {tally.answers} answers of {tally.messages} frames; by status: {tally.statuses}; deepest view "
          f"{tally.deepest_view}; {tally.ambiguous} hang on rounding; {outcome.corrections} corrections")
    faults = outcome.faults()
    if args.expect_corrections and outcome.corrections == 0:
        faults.append("the log held no correction that was accepted")
    for fault in faults[:MISMATCHES_SHOWN]:
        print("MISMATCH", fault)
    if faults:
        print(f"{len(faults)} faults")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
