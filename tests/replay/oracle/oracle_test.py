"""The whole way of one recording: source -> nanomap-replay -> oracle, as one test.

Exit status: 0 all answers agree, 1 they do not, 77 the recording is not on this machine.
"""

import sys

from check_answers import Sample, check
from recording import SKIPPED, arguments, record, replay

MISMATCHES_SHOWN = 5


def main() -> int:
    parser = arguments(__doc__)
    parser.add_argument("--message-stride", type=int, default=1)
    parser.add_argument("--answer-stride", type=int, default=1)
    parser.add_argument("--expect-corrections", action="store_true", help="fail if the log held none")
    args = parser.parse_args()

    log = record(args)
    if log is None:
        return SKIPPED
    answers = args.work / "answers.log"
    replay(args, log, "--out", answers)

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
