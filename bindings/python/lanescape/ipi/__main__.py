"""Serves a model to i-PI, to ASE's SocketIOCalculator or to another driver of the i-PI protocol.

    python -m lanescape.ipi --unixsocket NAME --model kob-andersen --units atomic --atoms start.xyz

Exit status: 0 done, 1 if the driver is not there or goes before it has its forces, 2 for bad input, 4 after SIGINT or SIGTERM.
"""

import argparse
import re
import signal
import sys

import lanescape
from lanescape.ipi.client import Client

STATUSES = {lanescape.InputError: 2, lanescape.RunError: 1, KeyboardInterrupt: 4}


class Parser(argparse.ArgumentParser):
    def error(self, message):
        raise lanescape.InputError(f"{message} (see --help)")


def parser():
    made = Parser("lanescape.ipi", description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter, allow_abbrev=False)
    where = made.add_argument_group("the driver")
    where.add_argument("--unixsocket", metavar="NAME", help="its socket of Unix, /tmp/ipi_NAME, or a path")
    where.add_argument("--host", help="or its host, for TCP [localhost]")
    where.add_argument("--port", type=int, help="and port [31415]")
    where.add_argument("--timeout", type=float, default=60.0, metavar="S", help="seconds to wait until it listens [60]")
    what = made.add_argument_group("the model")
    what.add_argument("--model", default="kob-andersen", help=", ".join(lanescape.model_names()))
    what.add_argument("--model-file", metavar="FILE", help="model file (TOML) instead")
    what.add_argument("--units", default="ase", help="of the model: ase for Angstrom and eV, atomic for Bohr and Hartree [ase]")
    what.add_argument("--species", help="of the atoms, symbols or indices between commas: Ni*86,P*22")
    what.add_argument("--atoms", metavar="FILE", help="or an XYZ file whose first column has them")
    how = made.add_argument_group("the evaluation")
    how.add_argument("--threads", type=int, default=1, help="[1]")
    how.add_argument("--precision", default="double", help="double or mixed [double]")
    how.add_argument("--isa", default="auto", help="instruction set [auto]")
    how.add_argument("--quiet", action="store_true", help="no message at the end")
    return made


def species_in(words, model):
    """Ni*86,P*22 or 0*86,1*22 as indices."""
    indices = []
    for word in words.split(","):
        parts = re.fullmatch(r"\s*([^*\s]+)\s*(?:\*\s*(\d{1,9}))?\s*", word)
        if parts is None:
            raise lanescape.InputError(f"--species: '{word}' is not allowed: a symbol or an index, and *COUNT, are needed")
        name, count = parts.groups()
        known = name.isdigit() and int(name) < len(model.species)
        indices += [int(name) if known else model.find_species(name)] * int(count or 1)
    return indices


def species_of_file(name, model):
    """The first column of the first frame."""
    try:
        with open(name, encoding="utf-8") as file:
            count = int(file.readline())
            file.readline()
            words = [file.readline().split() for _ in range(count)]
        return [model.find_species(word[0]) for word in words]
    except (OSError, ValueError, IndexError) as error:
        if isinstance(error, lanescape.InputError):
            raise lanescape.InputError(f"--atoms: {name}: {error}") from None
        raise lanescape.InputError(f"--atoms: {name}: an XYZ file with a symbol in the first column is needed") from None


def client_of(given):
    model = lanescape.Model.from_file(given.model_file) if given.model_file else lanescape.Model.named(given.model)
    if given.species is not None and given.atoms is not None:
        raise lanescape.InputError("--species and --atoms are not allowed together")
    species = None
    if given.species is not None:
        species = species_in(given.species, model)
    elif given.atoms is not None:
        species = species_of_file(given.atoms, model)
    return Client(model, species, unixsocket=given.unixsocket, host=given.host, port=given.port, units=given.units, timeout=given.timeout,
                  threads=given.threads, precision=given.precision, instruction_set=given.isa)


def interrupt(*_):
    raise KeyboardInterrupt


def main(arguments=None):
    signal.signal(signal.SIGTERM, interrupt)
    try:
        given = parser().parse_args(arguments)
        client = client_of(given)
        served = client.run()
    except tuple(STATUSES) as error:
        print(f"lanescape.ipi: {str(error) or 'interrupted'}", file=sys.stderr)
        return next(status for kind, status in STATUSES.items() if isinstance(error, kind))
    if not given.quiet:
        print(f"lanescape.ipi: {served} configurations{'' if client.said_exit else ', and the driver went without EXIT'}", file=sys.stderr)
    return 0


if __name__ == "__main__":
    sys.exit(main())
