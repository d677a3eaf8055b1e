"""A program that runs beside this one, and ends with it."""

import contextlib
import os
import subprocess
import threading
import time
from collections.abc import Callable
from pathlib import Path

PATIENCE_S = 10.0  # for a program that was asked to end
LOWEST_REALTIME_PRIORITY = 1  # the stages of the flight process go first


class Child:
    """Its lines are kept, and written to a file; one that is still there at the end is asked to end, then killed."""

    def __init__(self, command: list, lines_file: Path, told: Callable[[str], None] = lambda line: None,
                 realtime: bool = False):
        """`told` is called with each line, on a thread of its own. `realtime`: goes before whatever else the machine
        does, if we may; for a world that has to keep up with the clock."""
        self.name = Path(command[0]).name
        self.lines_file = lines_file
        self._told = told
        self._lines: list[str] = []
        self._news = threading.Condition()
        self._process = subprocess.Popen([str(word) for word in command], stdin=subprocess.PIPE,
                                         stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        if realtime:
            with contextlib.suppress(PermissionError):
                os.sched_setscheduler(self.pid, os.SCHED_FIFO, os.sched_param(LOWEST_REALTIME_PRIORITY))
        self._reader = threading.Thread(target=self._read, daemon=True)
        self._reader.start()

    def __enter__(self) -> "Child":
        return self

    def __exit__(self, *_) -> None:
        self.end()

    @property
    def pid(self) -> int:
        return self._process.pid

    def order(self, line: str) -> None:
        self._process.stdin.write(line + "\n")
        self._process.stdin.flush()

    def lines(self) -> list[str]:
        with self._news:
            return list(self._lines)

    def poll(self) -> int | None:
        """The exit code, once it has ended."""
        return self._process.poll()

    def wait(self, timeout_s: float) -> int:
        """The exit code. Raises TimeoutError naming the program."""
        try:
            code = self._process.wait(timeout_s)
        except subprocess.TimeoutExpired as expired:
            raise TimeoutError(f"{self.name} has not ended after {timeout_s:g} s; its output: {self.lines_file}") \
                from expired
        self._reader.join(PATIENCE_S)
        return code

    def until(self, condition: Callable[[], bool], timeout_s: float, what: str) -> None:
        """Waits for what its lines make true.

        Raises RuntimeError if it ends before, TimeoutError if it takes longer.
        """
        deadline = time.monotonic() + timeout_s
        with self._news:
            while not condition():
                left_s = deadline - time.monotonic()
                if not self._reader.is_alive():
                    raise RuntimeError(f"{self.name} has ended before {what}: {self.last_words()}")
                if left_s <= 0.0:
                    raise TimeoutError(f"{self.name}: {what} did not come within {timeout_s:g} s; its output: "
                                       f"{self.lines_file}")
                self._news.wait(min(left_s, 0.5))

    def last_words(self) -> str:
        return self._lines[-1] if self._lines else "it said nothing"

    def kill(self) -> None:
        """As a crash would."""
        self._process.kill()
        self._process.wait()

    def end(self) -> int:
        """Asks it to end, and waits until it has. The exit code."""
        if self._process.poll() is None:
            self._process.terminate()
        try:
            code = self._process.wait(PATIENCE_S)
        except subprocess.TimeoutExpired:
            self._process.kill()
            code = self._process.wait()
        self._reader.join(PATIENCE_S)
        self._process.stdin.close()
        self._process.stdout.close()
        return code

    def _read(self) -> None:
        with self.lines_file.open("w") as file:
            for line in self._process.stdout:
                file.write(line)
                with self._news:
                    self._lines.append(line.rstrip("\n"))
                    self._told(self._lines[-1])
                    self._news.notify_all()
