"""The whole way of one recording to verified decisions: source -> nanomap-replay -> check, as one test.

Exit status: 0 no decision is at fault and every planted fault was seen, 1 otherwise, 77 the recording is not on this
machine.
"""

import sys

from check_decisions import check
from planted import PLANTED
from recording import SKIPPED, arguments, record, replay

FAULTS_SHOWN = 10
# A status within rounding of another may rightly go either way.
AMBIGUOUS_SHARE = 0.02


def main() -> int:
    parser = arguments(__doc__)
    parser.add_argument("--goal", help="x,y,z [m] in W, for a recording that holds none")
    parser.add_argument("--least-verified", type=int, required=True, help="fail if fewer decisions could be checked")
    parser.add_argument("--no-place-for", action="append", default=[], choices=list(PLANTED),
                        help="planted fault that this recording cannot carry")
    args = parser.parse_args()

    log = record(args)
    if log is None:
        return SKIPPED
    decisions = args.work / "decisions.log"
    goal = [] if args.goal is None else ["--goal", args.goal]
    replay(args, log, "--decisions", decisions, *goal)

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
