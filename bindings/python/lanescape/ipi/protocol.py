"""Messages of the i-PI protocol: words of 12 characters, and arrays in the machine's byte order. Lengths in Bohr, energies in Hartree."""

import socket
from typing import NamedTuple

import numpy

from lanescape.errors import InputError, RunError

__all__ = ["Closed", "Units", "Wire", "units_named"]


class Units(NamedTuple):
    """A unit of length and one of energy."""

    bohr: float  # one Bohr in them
    hartree: float  # one Hartree


# Those of ASE, Angstrom and eV, by its constants (CODATA 2014), and those of the protocol. i-PI's own conversions of input files have 8
# digits.
_UNITS = {"ase": Units(0.5291772105638411, 27.211386024367243), "atomic": Units(1.0, 1.0)}


def units_named(word: str) -> Units:
    """Raises InputError."""
    if word not in _UNITS:
        raise InputError(f"units: '{word}' is not allowed: {', '.join(_UNITS)} are")
    return _UNITS[word]


class Closed(RunError):
    """The other end has closed the connection."""


class Wire:
    """One end of a connection. `peer` is what the messages of errors call the other end. Raises RunError where that is gone or silent."""

    def __init__(self, connection, peer):
        self._connection = connection
        self._peer = peer

    def send(self, word, *values):
        """A word and what follows it, arrays or bytes, in one piece."""
        self.send_all((word, *values))

    def send_all(self, *messages):
        parts = []
        for word, *values in messages:
            parts.append(word.encode("ascii").ljust(12))
            parts += [value if isinstance(value, bytes) else value.tobytes() for value in values]
        try:
            self._connection.sendall(b"".join(parts), socket.MSG_NOSIGNAL)  # SIGPIPE would end a host that has its default action
        except OSError as error:
            raise self._failure(error) from None

    def word(self):
        return self._bytes(12).rstrip(b" \0").decode("ascii", "replace")

    def expect(self, *words):
        word = self.word()
        if word not in words:
            raise RunError(f"{self._peer} answered '{word}': {' or '.join(words)} was expected")
        return word

    def numbers(self, count, kind=numpy.float64):
        return numpy.frombuffer(self._bytes(count * numpy.dtype(kind).itemsize), kind)

    def count(self):
        """A count of at most 10^9; what is not one comes from no program that speaks the protocol."""
        number = int(self.numbers(1, numpy.int32)[0])
        if not 0 <= number <= 10**9:
            raise RunError(f"{self._peer} sent {number} for a count: it does not speak the i-PI protocol")
        return number

    def text(self):
        return self._bytes(self.count())

    def close(self):
        self._connection.close()

    def _bytes(self, count):
        data = bytearray(count)
        view = memoryview(data)
        while view:
            try:
                got = self._connection.recv_into(view)
            except OSError as error:
                raise self._failure(error) from None
            if got == 0:
                raise Closed(f"{self._peer} has closed the connection")
            view = view[got:]
        return bytes(data)

    def _failure(self, error):
        if isinstance(error, ConnectionError):
            return Closed(f"{self._peer} has closed the connection")
        if isinstance(error, TimeoutError):
            return RunError(f"{self._peer} was silent for {self._connection.gettimeout():g} s")
        return RunError(f"{self._peer} is gone: {error.strerror or error}")
