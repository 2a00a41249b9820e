"""Addresses of the i-PI protocol and their sockets: of Unix under /tmp/ipi_NAME, or of TCP."""

import os
import socket
import stat
import time
from typing import NamedTuple

from lanescape.errors import InputError, RunError

__all__ = ["Address"]


class Address(NamedTuple):
    """Where a server listens. path: of a socket of Unix, else None; host, port: of TCP."""

    path: "str | None"
    host: str = "localhost"
    port: int = 31415

    @classmethod
    def of(cls, unixsocket: "str | None", host: "str | None", port: "int | None") -> "Address":
        """unixsocket: a name, as i-PI and ASE know it, or a path with a slash. Raises InputError."""
        if unixsocket is None:
            port = 31415 if port is None else port
            if not isinstance(port, int) or not 0 <= port <= 65535:
                raise InputError(f"port: {port!r} is not allowed: a whole number to 65535 is needed")
            return cls(None, host or "localhost", port)
        if host is not None or port is not None:
            raise InputError("unixsocket: neither host nor port is allowed with it")
        path = unixsocket if "/" in unixsocket else f"/tmp/ipi_{unixsocket}"
        if not unixsocket or len(os.fsencode(path)) > 107:
            raise InputError(f"unixsocket: '{unixsocket}' is not allowed: a name, or a path of at most 107 bytes")
        return cls(path)

    def __str__(self):
        return self.path or f"{self.host}:{self.port}"

    def connect(self, timeout):
        """Connects, and waits for a server that is not there yet. Raises RunError."""
        end = time.monotonic() + timeout
        while True:
            connection = self._socket()
            connection.settimeout(max(0.1, end - time.monotonic()))
            try:
                connection.connect(self.path or (self.host, self.port))
                connection.settimeout(None)
                return connection
            except OSError as error:
                connection.close()
                if time.monotonic() >= end:
                    raise RunError(f"no i-PI server listens at {self} after {timeout:g} s: {error.strerror or error}") from None
            time.sleep(0.05)

    def listen(self, timeout):
        """A listening socket, and the address that it has. The file of a server that has died is replaced. Raises InputError."""
        if self.path is not None:
            self._remove_stale_file()
        listening = self._socket()
        try:
            if self.path is None:
                listening.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
            listening.bind(self.path or (self.host, self.port))
            listening.listen(1)
        except OSError as error:
            listening.close()
            raise InputError(f"{self}: no i-PI server can listen there: {error.strerror or error}") from None
        listening.settimeout(timeout)
        return listening, self if self.path else self._replace(port=listening.getsockname()[1])

    def _socket(self):
        if self.path is not None:
            return socket.socket(socket.AF_UNIX)
        made = socket.socket(socket.AF_INET)
        made.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        return made

    def _remove_stale_file(self):
        try:
            kind = os.stat(self.path).st_mode
        except OSError:
            return
        if not stat.S_ISSOCK(kind):
            raise InputError(f"{self}: it is no socket: another name is needed")
        with self._socket() as probe:
            try:
                probe.settimeout(1.0)
                probe.connect(self.path)
            except ConnectionRefusedError:
                os.unlink(self.path)
                return
            except OSError:
                pass
        raise InputError(f"{self}: another server listens there: another name is needed")
