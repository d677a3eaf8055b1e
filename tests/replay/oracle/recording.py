"""Where a test's recording comes from: imported from data that may not be here, or generated on the spot."""

import argparse
import os
import subprocess
from pathlib import Path

SKIPPED = 77
DATA_FOLDER = "NANOMAP_DATA_DIR"


def run(*command) -> None:
    """Raises subprocess.CalledProcessError; the program's own words go to the test's output."""
    print("$", *command, flush=True)
    subprocess.run([str(part) for part in command], check=True)


def arguments(description: str) -> argparse.ArgumentParser:
    """What every test of a recording is told."""
    parser = argparse.ArgumentParser(description=description)
    parser.add_argument("--source", choices=("import", "generate"), required=True)
    parser.add_argument("--program", type=Path, required=True, help="nanomap-import or nanomap-generate")
    parser.add_argument("--replay", type=Path, required=True, help="nanomap-replay")
    parser.add_argument("--config", type=Path, required=True)
    parser.add_argument("--set", action="append", default=[], help="section.key=value, over the configuration file")
    parser.add_argument("--work", type=Path, required=True, help="folder for the logs")
    parser.add_argument("arguments", nargs="*", help="of the source's program, behind --")
    return parser


def record(args: argparse.Namespace) -> Path | None:
    """Makes the log; None, said aloud, if its data are not on this machine."""
    source = list(args.arguments)
    if args.source == "import":
        root = os.environ.get(DATA_FOLDER)
        folder = Path(root) / "kinect_office" if root else None
        if folder is None or not folder.is_dir():
            print(f"Skipped: {DATA_FOLDER} names no folder with kinect_office in it.")
            return None
        source.insert(0, folder)
    args.work.mkdir(parents=True, exist_ok=True)
    log = args.work / "input.log"
    run(args.program, *source, "--out", log)
    return log


def replay(args: argparse.Namespace, log: Path, *options) -> None:
    """Replays `log` under the test's configuration."""
    run(args.replay, log, "--config", args.config, *(f"--set={override}" for override in args.set), *options)
