"""A client of the i-PI protocol as a landscape."""

import os

import numpy

from lanescape.errors import InputError, RunError
from lanescape.ipi.protocol import Wire, units_named
from lanescape.ipi.sockets import Address

__all__ = ["SocketLandscape"]


class SocketLandscape:
    """A landscape whose energies and gradients come from a client of the i-PI protocol: an electronic-structure code, LAMMPS, ASE's
    SocketClient. For find_path, shorten_path, check_path and MolecularDynamics.

    cell: edges, (3,), or vectors, (3, 3), in the units of the positions, which the client gets with them. unixsocket: a name
    (/tmp/ipi_NAME) or a path; else host and port of TCP (31415; 0 for a free one, see `address`). It listens at once; the first evaluation
    waits for a client. units: of positions and energies; "ase" for Angstrom and eV by ASE's constants, "atomic" for Bohr and Hartree, or a
    Units. timeout: [s] to wait for a client, and for each of its answers; None waits for ever. An energy that follows the gradient at the
    same positions, or the reverse, is kept and not asked for again.

    Raises InputError for addresses that cannot be used, and for a client with another number of atoms; RunError where no client comes, or
    where it goes or is silent: the next evaluation then waits for another. Close it, or use it in a `with` statement: the client then gets
    EXIT, and the socket's file is removed. One that a killed process has left is replaced.
    """

    def __init__(self, cell, *, unixsocket=None, host=None, port=None, units="ase", timeout=60.0):
        self._units = units_named(units) if isinstance(units, str) else units
        cell = numpy.array(cell, dtype=numpy.float64)
        if cell.shape not in ((3,), (3, 3)) or not numpy.isfinite(cell).all() or not numpy.all(cell if cell.ndim == 1 else numpy.linalg.det(cell)):
            raise InputError("cell: three edges, (3,), or vectors, (3, 3), that span a volume are needed")
        vectors = (numpy.diag(cell) if cell.ndim == 1 else cell) / self._units.bohr
        self._cell = numpy.concatenate([vectors.T.ravel(), numpy.linalg.inv(vectors).T.ravel()])
        self._timeout = timeout
        self._wire = self._key = self._last = None
        self._listening, self._address = Address.of(unixsocket, host, port).listen(timeout)
        self.evaluations = 0  # that the client has made

    @property
    def address(self) -> str:
        """The path of the socket, or HOST:PORT."""
        return str(self._address)

    def energy(self, positions):
        """V of positions, (N, 3)."""
        return self._evaluate(positions)[0]

    def energy_and_gradient(self, positions):
        """(V, dV/dR). positions, gradient: (N, 3)."""
        energy, gradient = self._evaluate(positions)
        return energy, gradient.copy()

    def close(self):
        """Sends EXIT to the client, if there is one, and removes the socket."""
        if self._listening is None:
            return
        if self._wire is not None:
            try:
                self._wire.send("EXIT")
            except RunError:
                pass  # it is gone already
            self._disconnect()
        self._listening.close()
        self._listening = None
        if self._address.path is not None:
            try:
                os.unlink(self._address.path)
            except OSError:
                pass

    def __enter__(self):
        return self

    def __exit__(self, *exception):
        self.close()

    def __del__(self):
        if getattr(self, "_listening", None) is not None:
            self.close()

    def _evaluate(self, positions):
        positions = numpy.ascontiguousarray(positions, dtype=numpy.float64)
        key = positions.tobytes()
        if key != self._key:
            self._key = None
            try:
                self._last = self._ask(positions)
            except BaseException:  # an answer that is left in the socket would be taken for the next one
                self._disconnect()
                raise
            self._key = key
            self.evaluations += 1
        return self._last

    def _ask(self, positions):
        wire = self._connection()
        wire.send("STATUS")
        if wire.expect("READY", "NEEDINIT") == "NEEDINIT":
            wire.send_all(("INIT", numpy.array([0, 1], numpy.int32), b"\0"), ("STATUS",))
            wire.expect("READY")
        wire.send_all(("POSDATA", self._cell, numpy.array([len(positions)], numpy.int32), positions / self._units.bohr), ("STATUS",))
        while wire.expect("HAVEDATA", "READY") != "HAVEDATA":  # a client that computes meanwhile
            wire.send("STATUS")
        wire.send("GETFORCE")
        wire.expect("FORCEREADY")
        energy = float(wire.numbers(1)[0]) * self._units.hartree
        atoms = wire.count()
        if atoms != len(positions):
            raise InputError(f"the i-PI client at {self._address} has {atoms} atoms: the landscape has {len(positions)}")
        gradient = wire.numbers(3 * atoms).reshape(atoms, 3) * (-self._units.hartree / self._units.bohr)
        wire.numbers(9)  # the virial
        wire.text()
        return energy, gradient

    def _connection(self):
        if self._listening is None:
            raise InputError("the landscape was closed: make another one")
        if self._wire is None:
            try:
                connection, _ = self._listening.accept()
            except TimeoutError:
                raise RunError(f"no i-PI client has connected to {self._address} within {self._timeout:g} s") from None
            connection.settimeout(self._timeout)
            self._wire = Wire(connection, f"the i-PI client at {self._address}")
        return self._wire

    def _disconnect(self):
        if self._wire is not None:
            self._wire.close()
            self._wire = None
