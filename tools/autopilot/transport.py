"""The wires that the autopilot can be reached by.

Each has a `url`, as MAVSDK takes it, under which to reach it, and a `fileno` that is readable if read() has something.
"""

import os
import pty
import socket
import tty

MAX_READ_BYTES = 65536


class Udp:
    """Sends to a port that the companion listens at, as PX4 does to its onboard computer."""

    def __init__(self, peer_port: int):
        self._socket = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self._socket.bind(("127.0.0.1", 0))
        self._socket.setblocking(False)
        self._peer = ("127.0.0.1", peer_port)
        self.url = f"udpin://127.0.0.1:{peer_port}"

    def fileno(self) -> int:
        return self._socket.fileno()

    def read(self) -> bytes:
        try:
            return self._socket.recv(MAX_READ_BYTES)
        except (BlockingIOError, ConnectionRefusedError):  # nothing there, or nobody listens yet
            return b""

    def write(self, data: bytes) -> None:
        try:
            self._socket.sendto(bytes(data), self._peer)
        except (BlockingIOError, ConnectionRefusedError):
            pass


class Tcp:
    """Listens, for one companion at a time, at a port that the system chooses."""

    def __init__(self) -> None:
        self._listener = socket.create_server(("127.0.0.1", 0))
        self._peer: socket.socket | None = None
        self.url = f"tcpout://127.0.0.1:{self._listener.getsockname()[1]}"

    def fileno(self) -> int:
        return (self._peer or self._listener).fileno()

    def read(self) -> bytes:
        if self._peer is None:
            self._peer = self._listener.accept()[0]
            return b""
        try:
            data = self._peer.recv(MAX_READ_BYTES)
        except ConnectionResetError:
            data = b""
        if not data:
            self._hang_up()
        return data

    def write(self, data: bytes) -> None:
        if self._peer is None:
            return
        try:
            self._peer.sendall(data)
        except (BrokenPipeError, ConnectionResetError):
            self._hang_up()

    def _hang_up(self) -> None:
        self._peer.close()
        self._peer = None


class Serial:
    """A serial line: one end of a pseudo-terminal, the other end being the companion's device."""

    BAUD = 921600

    def __init__(self) -> None:
        self._ours, theirs = pty.openpty()
        tty.setraw(theirs)
        os.set_blocking(self._ours, False)
        self._theirs = theirs  # kept open, so that the line lives on when the companion hangs up
        self.url = f"serial://{os.ttyname(theirs)}:{self.BAUD}"

    def fileno(self) -> int:
        return self._ours

    def read(self) -> bytes:
        return os.read(self._ours, MAX_READ_BYTES)

    def write(self, data: bytes) -> None:
        try:
            os.write(self._ours, data)
        except BlockingIOError:  # nobody reads: a serial line loses what does not fit
            pass
