"""A model as a client of the i-PI protocol."""

import numpy

from lanescape import _core
from lanescape.errors import InputError
from lanescape.ipi.protocol import Closed, Wire, units_named
from lanescape.ipi.sockets import Address

__all__ = ["Client"]

_ROUNDING = 1e-12  # of a cell, relative to its largest edge
_VOIGT = numpy.array([[0, 5, 4], [5, 1, 3], [4, 3, 2]])


class Client:
    """Serves energies, forces and virials of a model to a driver: i-PI, ASE's SocketIOCalculator, or a SocketLandscape.

    model: one with a pair potential or with sites in states. species: names or indices of the atoms, in the order of the driver's, (N,);
    None for a model of one species. units: the model's; "ase" for Angstrom and eV by ASE's constants, "atomic" for Bohr and Hartree, or a
    Units. unixsocket: a name (/tmp/ipi_NAME) or a path; else host and port of TCP. timeout: [s] to wait for the driver to listen. What
    else there is goes to Potential. Cells are orthorhombic, to 1e-12 of the largest edge, and may change.

    Raises InputError, for cells and atoms that the driver sends too, and RunError where it is not there, or goes before it has had a
    configuration or while it waits for one. Elsewhere a driver may go without EXIT, as ASE's does: `said_exit` tells.
    """

    def __init__(self, model, species=None, *, unixsocket=None, host=None, port=None, units="ase", timeout=60.0, threads=1,
                 precision="double", instruction_set="auto"):
        if not isinstance(model, _core.Model):
            raise TypeError(f"model: a lanescape.Model is needed, not {type(model).__name__}")
        self._model = model
        self._units = units_named(units) if isinstance(units, str) else units
        self._address = Address.of(unixsocket, host, port)
        self._species = None if species is None else list(species)
        if self._species is None and len(model.species) != 1:
            raise InputError(f"species: one for each atom is needed: model {model.name} has {', '.join(model.species)}")
        self._options = {"threads": threads, "instruction_set": instruction_set}
        if not model.has_states:
            self._options["precision"] = precision
        self._timeout = timeout
        self.said_exit = False
        self._system = None
        self._box = None
        if species is not None:  # refused before the driver waits
            self._make_system(len(self._species), numpy.full(3, 1e3 * max(model.largest_cutoff, model.length_unit)))

    def run(self) -> int:
        """Serves until the driver says EXIT or goes. The number of configurations."""
        wire = Wire(self._address.connect(self._timeout), f"the i-PI server at {self._address}")
        answer, served = None, 0
        try:
            while (word := wire.expect("STATUS", "INIT", "POSDATA", "GETFORCE", "EXIT")) != "EXIT":
                if word == "STATUS":
                    wire.send("READY" if answer is None else "HAVEDATA")
                elif word == "INIT":
                    wire.count()  # of the replica, all of which have one potential
                    wire.text()
                elif word == "POSDATA":
                    answer = self._answer(wire)
                    served += 1
                elif answer is None:
                    raise InputError("the i-PI server asks for forces before it has sent positions")
                else:
                    wire.send("FORCEREADY", *answer)
                    answer = None
            self.said_exit = True
        except Closed:
            if answer is not None or served == 0:
                raise
        finally:
            wire.close()
        return served

    def _answer(self, wire):
        """The parts of the message that answers the positions which come now."""
        cell = wire.numbers(9).reshape(3, 3) * self._units.bohr  # the protocol's is transposed, which no allowed cell shows
        wire.numbers(9)  # its inverse
        atoms = wire.count()
        positions = wire.numbers(3 * atoms).reshape(atoms, 3) * self._units.bohr
        system = self._system_in(_edges(cell), atoms)
        found = system.evaluate(positions, forces=True, stress=True)
        force = self._units.hartree / self._units.bohr
        virial = -float(numpy.prod(self._box)) / self._units.hartree * found.stress[_VOIGT]
        extra = b"\0"  # some drivers wait for at least one byte
        return (numpy.array([found.energy / self._units.hartree]), numpy.array([atoms], numpy.int32), found.forces / force, virial,
                numpy.array([len(extra)], numpy.int32), extra)

    def _system_in(self, edges, atoms):
        if self._species is not None and len(self._species) != atoms:
            raise InputError(f"the i-PI server sends {atoms} atoms: species are given for {len(self._species)}")
        if self._system is None or self._system.particles != atoms:
            self._make_system(atoms, edges)
        elif not numpy.array_equal(edges, self._box):
            self._system.box = edges
        self._box = edges
        return self._system

    def _make_system(self, atoms, edges):
        kind = _core.StateSystem if self._model.has_states else _core.Potential
        species = [0] * atoms if self._species is None else self._species
        self._system = kind(self._model, species, edges, **self._options)
        self._box = edges


def _edges(cell):
    edges = numpy.diag(cell).copy()
    if not numpy.all(numpy.abs(cell - numpy.diag(edges)) <= _ROUNDING * edges.max()) or not numpy.all(edges > 0.0):
        raise InputError(f"the i-PI server sends the cell {cell.tolist()}: edges along x, y and z above 0 are needed")
    return edges
