"""Calculators for ASE, and ASE's calculators as landscapes. ASE's unit of length is that of the models; k_B = 1 in the library."""

import copy

import numpy
from ase import Atoms
from ase.calculators.calculator import Calculator as AseCalculator
from ase.calculators.calculator import CalculatorSetupError, PropertyNotImplementedError, all_changes

from lanescape import _core

__all__ = ["AtomsLandscape", "Calculator", "KobAndersen", "LennardJones"]


class Calculator(AseCalculator):
    """Energies of a model with a pair potential, or with sites in states, whose species are named by chemical symbols.

    model: a Model. threads, precision, instruction_set: as for Potential. Cells are orthorhombic, to 1e-12 of the largest edge, and
    periodic along all axes; any number of images of a particle is right. ASE's filters that relax a cell keep it so with
    mask=[1, 1, 1, 0, 0, 0]. Changes of positions and cell keep the neighbour list; other atoms make a new one.

    Raises CalculatorSetupError for other cells and for symbols that are no species of the model; ValueError (lanescape.InputError) for
    positions that are not finite.
    """

    name = "lanescape"
    implemented_properties = ["energy", "free_energy", "forces", "stress", "energies"]
    nolabel = True

    def __init__(self, model, *, threads=1, precision="double", instruction_set="auto", **keywords):
        self._state = self._shape = self._numbers = None
        if not isinstance(model, _core.Model):
            raise TypeError(f"model: a lanescape.Model is needed, not {type(model).__name__}")
        self._options = {"threads": threads, "instruction_set": instruction_set}
        if not model.has_states:
            self._options["precision"] = precision
        self._model = model
        self._system = None
        super().__init__(**keywords)

    @property
    def model(self):
        return self._model

    @property
    def atoms(self):
        """Those of the last results, as a new object; None without results."""
        if self._state is None:
            return None
        positions, numbers, cell, pbc = (numpy.frombuffer(part, kind) for part, kind in zip(self._state, (float, int, float, bool)))
        return Atoms(numbers, positions.reshape(-1, 3), cell=cell.reshape(3, 3), pbc=pbc)

    @atoms.setter
    def atoms(self, atoms):
        self._state = None if atoms is None else _state(atoms)

    def set(self, **changes):
        """Refuses changes: a model does not change. Make another calculator."""
        if changes:
            raise TypeError(f"{type(self).__name__} cannot set {', '.join(changes)}: what its docstring names is given when it is made")
        return {}

    def todict(self, skip_default=True):
        """What ASE's files and databases keep of a calculator: the model's text, from which Model.from_toml makes it again, and options."""
        return {"model": self._model.to_toml(), **self._options}

    def system(self, atoms):
        """The Potential, or StateSystem, of these atoms in their cell: kept, and the calculator's own."""
        shape = _state(atoms)[1:]
        if shape != self._shape:
            edges = _edges(atoms)
            if self._system is None or not numpy.array_equal(self._numbers, atoms.numbers):
                kind = _core.StateSystem if self._model.has_states else _core.Potential
                self._system = kind(self._model, _species(atoms, self._model), edges, **self._options)
                self._numbers = atoms.numbers.copy()
            else:
                self._system.box = edges
            self._shape = shape
        return self._system

    # ASE's own ways from a question to a result and to compare atoms take 40 times as long as the kernels at N = 108.

    def check_state(self, atoms, tol=0.0):
        """What has changed since the last results, to the bit: a list of names."""
        now = _state(atoms)
        if now == self._state:
            return []
        before = self._state or (None,) * 4
        return [name for name, old, new in zip(("positions", "numbers", "cell", "pbc"), before, now) if old != new]

    def get_property(self, name, atoms=None, allow_calculation=True):
        if name not in self.implemented_properties:
            raise PropertyNotImplementedError(f"{name} is no property of this calculator")
        if atoms is not None and _state(atoms) != self._state:
            if not allow_calculation:
                return None
            self.reset()
        if name not in self.results:
            if not allow_calculation:
                return None
            self.calculate(atoms, [name])
        result = self.results[name]
        return result.copy() if isinstance(result, numpy.ndarray) else result

    def calculate(self, atoms=None, properties=("energy",), system_changes=all_changes):
        atoms = self.atoms if atoms is None else atoms
        if atoms is None:
            raise CalculatorSetupError("the calculator has seen no atoms: they are needed")
        state = _state(atoms)
        if state != self._state:
            self.results = {}
        system = self.system(atoms)
        if "stress" in properties or "energies" in properties:
            found = system.evaluate(atoms.positions, stress="stress" in properties, energies="energies" in properties)
            self.results.update((name, value) for name, value in found._asdict().items() if value is not None and name != "virial")
        else:
            self.results["energy"], self.results["forces"] = system.energy_and_forces(atoms.positions)
        self.results["free_energy"] = self.results["energy"]
        self._state = state


class LennardJones(Calculator):
    """A Lennard-Jones fluid or mixture, 4 epsilon [(sigma/r)^12 - (sigma/r)^6].

    species: chemical symbols, S, or one alone. epsilon, sigma: a number for S = 1, else symmetric (S, S) matrices, in the units of the atoms.
    cutoff: in units of sigma_ab. truncation: shifted, plain, tail, shifted-force or smooth. images: all, or minimum for the nearest image
    of a pair only. threads share an evaluation. What else there is goes to Calculator.

    Raises ValueError (lanescape.InputError).
    """

    def __init__(self, species=("Ar",), epsilon=1.0, sigma=1.0, cutoff=2.5, truncation="shifted", images="all", threads=1, **keywords):
        species = [species] if isinstance(species, str) else list(species)
        model = _core.Model.mixture(species, epsilon, sigma, cutoff=cutoff, truncation=truncation, images=images, name="lennard-jones")
        super().__init__(model, threads=threads, **keywords)


class KobAndersen(Calculator):
    """The mixture of Kob and Andersen (doi 10.1103/PhysRevE.51.4626) in reduced units; its A is Ni and its B is P. Arguments: LennardJones."""

    def __init__(self, cutoff=2.5, truncation="shifted", images="all", threads=1, **keywords):
        model = _core.Model.named("kob-andersen", cutoff=cutoff, truncation=truncation, images=images)
        super().__init__(model, threads=threads, **keywords)


class AtomsLandscape:
    """Atoms with any calculator of ASE's as a landscape, for find_path and MolecularDynamics.

    The atoms are copied, the calculator is shared; its energy is the one that is consistent with its forces. Exceptions of the calculator
    pass through.
    """

    def __init__(self, atoms):
        if atoms.calc is None:
            raise CalculatorSetupError("the atoms have no calculator: a landscape needs one")
        self._atoms = atoms.copy()
        self._atoms.calc = atoms.calc
        # One of its own: the calculator's follows the cell of the atoms that it meets.
        self._system = copy.copy(atoms.calc.system(atoms)) if isinstance(atoms.calc, Calculator) else None

    def energy(self, positions):
        """V of positions, (N, 3)."""
        if self._system is not None:
            return self._system.energy(positions)
        self._atoms.positions[:] = positions
        return self._energy()

    def energy_and_gradient(self, positions):
        """(V, dV/dR). positions, gradient: (N, 3)."""
        if self._system is not None:
            return self._system.energy_and_gradient(positions)
        self._atoms.positions[:] = positions
        forces = self._atoms.get_forces(apply_constraint=False)
        return self._energy(), -forces

    def _energy(self):
        try:
            return self._atoms.get_potential_energy(force_consistent=True)
        except PropertyNotImplementedError:
            return self._atoms.get_potential_energy()


_ROUNDING = 1e-12  # of a cell, relative to its largest edge


def _state(atoms):
    """All of the atoms that results depend on, as bytes: positions, numbers, cell, pbc."""
    return atoms.positions.tobytes(), atoms.numbers.tobytes(), atoms.cell.array.tobytes(), atoms.pbc.tobytes()


def _edges(atoms):
    if not atoms.pbc.all():
        raise CalculatorSetupError(f"pbc {atoms.pbc.tolist()} is not allowed: boxes are periodic along all axes")
    cell = atoms.cell.array
    edges = numpy.diag(cell).copy()
    if not numpy.all(numpy.abs(cell - numpy.diag(edges)) <= _ROUNDING * edges.max()) or not numpy.all(edges > 0.0):
        raise CalculatorSetupError(f"cell {cell.tolist()} is not allowed: edges along x, y and z above 0 are needed "
                                   "(filters that relax a cell keep them with mask=[1, 1, 1, 0, 0, 0])")
    return edges


def _species(atoms, model):
    indices = {symbol: index for index, symbol in enumerate(model.species)}
    symbols = atoms.get_chemical_symbols()
    unknown = sorted(set(symbols) - set(indices))
    if unknown:
        raise CalculatorSetupError(f"{', '.join(unknown)}: no species of model {model.name}, which has {', '.join(model.species)}")
    return numpy.array([indices[symbol] for symbol in symbols], dtype=numpy.int64)
