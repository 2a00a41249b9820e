"""Calculators for ASE, and ASE's calculators as landscapes. ASE's unit of length is that of the models; k_B = 1 in the library."""

import copy

import numpy
from ase.calculators.calculator import Calculator as AseCalculator
from ase.calculators.calculator import CalculatorSetupError, PropertyNotImplementedError, all_changes

from lanescape import _core

__all__ = ["AtomsLandscape", "Calculator", "KobAndersen", "LennardJones"]


class Calculator(AseCalculator):
    """Energies of a model with a pair potential, or with sites in states, whose species are named by chemical symbols.

    model: a Model. threads, precision, instruction_set: as for Potential. Cells are orthorhombic and periodic along all axes; any number of
    images of a particle is right. Changes of positions and cell keep the neighbour list; other atoms make a new one.

    Raises CalculatorSetupError for other cells and for symbols that are no species of the model; ValueError (lanescape.InputError) for
    positions that are not finite.
    """

    name = "lanescape"
    implemented_properties = ["energy", "free_energy", "forces", "stress", "energies"]
    nolabel = True

    def __init__(self, model, *, threads=1, precision="double", instruction_set="auto", **keywords):
        super().__init__(**keywords)
        self._options = {"threads": threads, "instruction_set": instruction_set}
        if not model.has_states:
            self._options["precision"] = precision
        self._model = model
        self._numbers = self._system = None

    @property
    def model(self):
        return self._model

    def set(self, **changes):
        """Refuses changes: a model does not change. Make another calculator."""
        if changes:
            raise TypeError(f"parameters {', '.join(changes)} cannot be set: make another calculator")
        return {}

    def system(self, atoms):
        """The Potential, or StateSystem, of these atoms in their cell: kept, and the calculator's own."""
        edges = _edges(atoms)
        if self._system is None or not numpy.array_equal(self._numbers, atoms.numbers):
            kind = _core.StateSystem if self._model.has_states else _core.Potential
            self._system = kind(self._model, _species(atoms, self._model), edges, **self._options)
            self._numbers = atoms.numbers.copy()
        elif not numpy.array_equal(self._system.box, edges):
            self._system.box = edges
        return self._system

    def calculate(self, atoms=None, properties=("energy",), system_changes=all_changes):
        super().calculate(atoms, properties, system_changes)
        system = self.system(self.atoms)
        wants = {"forces": "forces" in properties, "stress": "stress" in properties, "energies": "energies" in properties}
        found = system.evaluate(self.atoms.positions, **wants)
        self.results.update(energy=found.energy, free_energy=found.energy)
        self.results.update({name: getattr(found, name) for name, wanted in wants.items() if wanted})


class LennardJones(Calculator):
    """A Lennard-Jones fluid or mixture, 4 epsilon [(sigma/r)^12 - (sigma/r)^6].

    species: chemical symbols, S. epsilon, sigma: a number for S = 1, else symmetric (S, S) matrices, in the units of the atoms.
    cutoff: in units of sigma_ab. truncation: shifted, plain, tail, shifted-force or smooth. images: all, or minimum for the nearest image
    of a pair only. threads share an evaluation. What else there is goes to Calculator.

    Raises ValueError (lanescape.InputError).
    """

    def __init__(self, species=("Ar",), epsilon=1.0, sigma=1.0, cutoff=2.5, truncation="shifted", images="all", threads=1, **keywords):
        model = _core.Model.mixture(list(species), epsilon, sigma, cutoff=cutoff, truncation=truncation, images=images, name="lennard-jones")
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


def _edges(atoms):
    if not atoms.pbc.all():
        raise CalculatorSetupError(f"pbc {atoms.pbc.tolist()} is not allowed: boxes are periodic along all axes")
    cell = atoms.cell.array
    if numpy.any(cell != numpy.diag(numpy.diag(cell))) or not numpy.all(numpy.diag(cell) > 0.0):
        raise CalculatorSetupError(f"cell {cell.tolist()} is not allowed: edges along x, y and z above 0 are needed")
    return numpy.diag(cell).copy()


def _species(atoms, model):
    indices = {symbol: index for index, symbol in enumerate(model.species)}
    symbols = atoms.get_chemical_symbols()
    unknown = sorted(set(symbols) - set(indices))
    if unknown:
        raise CalculatorSetupError(f"{', '.join(unknown)}: no species of model {model.name}, which has {', '.join(model.species)}")
    return numpy.array([indices[symbol] for symbol in symbols], dtype=numpy.int64)
