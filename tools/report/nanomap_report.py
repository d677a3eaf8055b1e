"""A picture of a replay: of the answers at one moment, with statistics of all of it, or of a whole flight with its
decisions. Or, in words, how well a vehicle kept to its motions."""

import argparse
import sys
from pathlib import Path

import matplotlib

matplotlib.use("Agg")

import flight_picture
import moment_picture
import tracking
from flight import gather_flight
from limits import read_limits, read_tracking_allowance
from moment import gather
from nanomap_log import choose_configuration, read_channels


def parse_arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser(prog="nanomap-report", description=__doc__)
    parser.add_argument("log", type=Path, help="LCM log that was replayed, or that a flight with decisions left; a "
                        "folder of recordings is its latest flight")
    of = parser.add_mutually_exclusive_group(required=True)
    of.add_argument("answers", type=Path, nargs="?", help="draw one moment's answers: nanomap-replay LOG --out ANSWERS")
    of.add_argument("--decisions", type=Path, help="draw the whole flight with these decisions: nanomap-replay LOG "
                    "--decisions DECISIONS, or LOG once more, if it holds the decisions that it was flown by")
    of.add_argument("--tracking", action="store_true", help="say how far the vehicle was off the motions that it was "
                    "told, and what [risk] allows for; draws nothing")
    parser.add_argument("--out", type=Path, help="PNG to write")
    parser.add_argument("--at", type=float, metavar="S", help="moment of the answers, in seconds after the log's first "
                        "event; by default one where many points are answered by views that are not the newest")
    parser.add_argument("--config", type=Path, help="configuration of the replay, for its channel names, the chance "
                        "constraint, the vehicle's radius and how far it may stray; by default what a flight was "
                        "recorded with")
    arguments = parser.parse_args()
    if arguments.at is not None and not arguments.answers:
        parser.error("--at tells a moment of ANSWERS; --decisions and --tracking are of the whole flight")
    if arguments.tracking == (arguments.out is not None):
        parser.error("--tracking draws no picture" if arguments.tracking else "--out is missing: the PNG to write")
    return arguments


def report(arguments: argparse.Namespace) -> None:
    configuration = choose_configuration(arguments.log, arguments.config)
    channels = read_channels(configuration.told)
    if arguments.tracking:
        print(tracking.words(tracking.gather_followed(arguments.log, channels),
                             read_tracking_allowance(configuration.told), configuration.origin))
    elif arguments.decisions:
        flight = gather_flight(arguments.log, arguments.decisions, channels, read_limits(configuration.told))
        flight_picture.draw(flight, arguments.out)
    else:
        moment_picture.draw(gather(arguments.log, arguments.answers, channels, arguments.at), arguments.out)


def main() -> int:
    arguments = parse_arguments()
    try:
        report(arguments)
    except (ValueError, OSError) as error:
        print(f"nanomap-report: {error}", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
