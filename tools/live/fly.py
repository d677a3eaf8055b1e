"""Flies the real flight process through a simulated scene, over LCM and MAVLink, and says what happens.

What it does not know goes to nanomap-sim: --seed 3, --speed 5, --correction-hz 2, --fault camera-late:5:1 and more.
Exit code 0: it stands at the goal; 2: it does not; 1: it could not be flown.
"""

import argparse
import signal
import sys
from pathlib import Path

from live_flight import MISSION_ALTITUDE_M, LiveFlightOptions, OwnAutopilot, live_flight

INTERRUPTED = 130
PILOTS_TIME_S = 600.0  # to take off and to switch, with an autopilot of the user's


def parse_arguments() -> tuple[argparse.Namespace, list[str]]:
    parser = argparse.ArgumentParser(prog="tools/demo", description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter, allow_abbrev=False)
    parser.add_argument("--programs", type=Path, required=True, help=argparse.SUPPRESS)
    parser.add_argument("--out", type=Path, required=True, help=argparse.SUPPRESS)
    parser.add_argument("--scene", choices=MISSION_ALTITUDE_M, default="forest")
    parser.add_argument("--duration", type=float, metavar="S", help="give up after")
    parser.add_argument("--autopilot", metavar="URL", help="fly the vehicle of this PX4 or ArduPilot, which you run: "
                        "where it talks to a companion computer, udpin://0.0.0.0:14540 for PX4's own simulator")
    parser.add_argument("--truth", metavar="URL", default="udpin://0.0.0.0:14550",
                        help="where the same autopilot talks to a ground station: the simulated camera goes where it "
                        "says that the vehicle is (default: %(default)s, so that no ground station can listen there)")
    return parser.parse_known_args()


def say(text: str) -> None:
    print(text, flush=True)


def fly(arguments: argparse.Namespace, sim_arguments: list[str]) -> int:
    own = OwnAutopilot(arguments.autopilot, arguments.truth) if arguments.autopilot else None
    options = LiveFlightOptions(
        programs=arguments.programs, folder=arguments.out, scene=arguments.scene, autopilot=own,
        duration_s=arguments.duration or (PILOTS_TIME_S if own else LiveFlightOptions.duration_s),
        sim_arguments=tuple(sim_arguments), tell=say)
    with live_flight(options) as flight:
        if own:
            say(f"you are the pilot: arm, take off to {MISSION_ALTITUDE_M[options.scene]:g} m, and switch to OFFBOARD "
                "(PX4) or GUIDED (ArduPilot) once the ground station shows 'NanoMap ready'. In PX4's console: "
                "'commander takeoff', then 'commander mode offboard'. Parameters: MIS_TAKEOFF_ALT, COM_RCL_EXCEPT 4 "
                "without a remote control.")
        else:
            flight.hand_over()
        return flight.wait()


def main() -> int:
    arguments, sim_arguments = parse_arguments()
    signal.signal(signal.SIGTERM, signal.default_int_handler)
    try:
        return fly(arguments, sim_arguments)
    except KeyboardInterrupt:
        return INTERRUPTED
    except (RuntimeError, TimeoutError, OSError) as error:
        print(f"tools/demo: {error}", file=sys.stderr)
        return 1


if __name__ == "__main__":
    sys.exit(main())
