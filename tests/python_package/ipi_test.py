"""The i-PI protocol: models as clients of ASE's and of our own server, ASE's client as a landscape, and all that goes wrong."""

import os
import shutil
import signal
import socket
import subprocess
import sys
import tempfile
import textwrap
import unittest
from pathlib import Path

import ase.units
import numpy as np
from ase import Atoms
from ase.build import bulk
from ase.calculators.emt import EMT
from ase.calculators.socketio import SocketIOCalculator

import lanescape
from lanescape.ase import AtomsLandscape, Calculator
from lanescape.ipi import Client, SocketLandscape
from lanescape.ipi.protocol import units_named
from support import fluid

NAME = f"lanescape-test-{os.getpid()}"
ASE_CLIENT = """
    import sys
    from ase.build import bulk
    from ase.calculators.emt import EMT
    from ase.calculators.socketio import SocketClient
    atoms = bulk("Cu", cubic=True).repeat(2)
    atoms.calc = EMT()
    SocketClient(unixsocket=sys.argv[1]).run(atoms, use_stress=False)
"""


class Processes(unittest.TestCase):
    def setUp(self):
        self.folder = Path(tempfile.mkdtemp(prefix="lanescape-ipi-"))
        self.addCleanup(shutil.rmtree, self.folder, ignore_errors=True)

    def start(self, *arguments):
        process = subprocess.Popen([sys.executable, *map(str, arguments)], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        self.addCleanup(lambda: (process.poll() is None and process.kill(), process.communicate()))
        return process

    def serve(self, *options, name=NAME):
        return self.start("-m", "lanescape.ipi", "--unixsocket", name, "--timeout", "30", *options)

    def ended(self, process, status, says=""):
        """The process ends with this status, and one line."""
        stdout, stderr = process.communicate(timeout=60)
        self.assertEqual((process.returncode, stdout), (status, ""), stderr)
        self.assertRegex(stderr, r"\Alanescape\.ipi: [^\n]+\n\Z")
        self.assertIn(says, stderr)

    def landscape(self, cell, **options):
        landscape = SocketLandscape(cell, **{"unixsocket": NAME, "timeout": 30.0, **options})
        self.addCleanup(landscape.close)
        return landscape


def mixture():
    model, species, positions, box = fluid()
    return model, Atoms([model.species[s] for s in species], positions=positions, cell=box, pbc=True)


class ClientTest(Processes):
    def test_the_constants_are_those_of_ase(self):
        self.assertEqual(tuple(units_named("ase")), (ase.units.Bohr, ase.units.Ha))

    def test_a_driver_of_ase_gets_the_energies_of_the_calculator(self):
        model, atoms = mixture()
        file = self.folder / "model.toml"
        file.write_text(model.to_toml())
        names = self.folder / "atoms.xyz"
        names.write_text(f"{len(atoms)}\n\n" + "".join(f"{symbol} 0 0 0\n" for symbol in atoms.get_chemical_symbols()))
        expected = Calculator(model)
        with SocketIOCalculator(unixsocket=NAME, timeout=60) as driver:
            client = self.serve("--model-file", file, "--atoms", names)
            for scale in ((1, 1, 1), (1.01, 0.99, 1.02), (0.98, 1, 1)):  # cells that change
                atoms.set_cell(atoms.cell.array * scale, scale_atoms=True)
                atoms.calc = driver
                found = atoms.get_potential_energy(), atoms.get_forces(), atoms.get_stress()
                atoms.calc = expected
                np.testing.assert_allclose(found[0], atoms.get_potential_energy(), rtol=1e-12)
                np.testing.assert_allclose(found[1], atoms.get_forces(), rtol=1e-11, atol=1e-10)
                np.testing.assert_allclose(found[2], atoms.get_stress(), rtol=1e-11, atol=1e-10)
        self.ended(client, 0, "3 configurations")

    def test_species_are_given_by_symbol_or_index_or_not_at_all(self):
        model, species, positions, box = fluid()
        order = np.argsort(species, kind="stable")
        expected = lanescape.Potential(model, species[order], box).energy(positions[order])
        for words in (f"Ni*{(species == 0).sum()},P*{(species == 1).sum()}", f"0*{(species == 0).sum()}, 1 * {(species == 1).sum()}"):
            client = self.serve("--units", "atomic", "--species", words)
            with self.landscape(box, units="atomic") as landscape:
                np.testing.assert_allclose(landscape.energy(positions[order]), expected, rtol=1e-14)
            self.ended(client, 0)
        argon = lanescape.Model.named("lennard-jones")
        client = self.serve("--units", "atomic", "--model", "lennard-jones")
        with self.landscape(box, units="atomic") as landscape:
            expected = lanescape.Potential(argon, None, box, particles=len(positions)).energy(positions)
            np.testing.assert_allclose(landscape.energy(positions), expected, rtol=1e-14)
        self.ended(client, 0)

    def test_sites_in_states_are_served(self):
        model, species, positions, box = fluid("ucg", density=0.5)
        system = lanescape.StateSystem(model, species, box)
        client = self.serve("--units", "atomic", "--model", "ucg")
        with self.landscape(box, units="atomic") as landscape:
            energy, gradient = landscape.energy_and_gradient(positions)
        expected = system.energy_and_gradient(positions)
        np.testing.assert_allclose(energy, expected[0], rtol=1e-13)
        np.testing.assert_allclose(gradient, expected[1], rtol=1e-12, atol=1e-12)
        self.ended(client, 0)

    def test_cells_that_are_not_orthorhombic_are_refused_in_one_line(self):
        client = self.serve("--model", "lennard-jones")
        landscape = self.landscape([[5.0, 0.1, 0.0], [0.0, 5.0, 0.0], [0.0, 0.0, 5.0]])
        with self.assertRaisesRegex(lanescape.RunError, "has closed the connection"):
            landscape.energy(np.eye(3))
        self.ended(client, 2, "edges along x, y and z")

    def test_another_number_of_atoms_is_refused(self):
        client = self.serve("--species", "Ni*4,P*4")
        with self.assertRaisesRegex(lanescape.RunError, "has closed the connection"):
            self.landscape([5.0, 5.0, 5.0]).energy(np.eye(3))
        self.ended(client, 2, "sends 3 atoms: species are given for 8")

    def test_bad_options_are_refused_in_one_line(self):
        for options, says in ((("--species", "Xx*3"), "Xx"), (("--species", "2"), "2"), (("--species", "Ni**2"), "Ni**2"), ((), "species: one for each"),
                              (("--model", "water"), "water"), (("--units", "metal"), "'metal' is not allowed: ase, atomic"),
                              (("--atoms", self.folder / "none.xyz"), "none.xyz"), (("--nonsense",), "--nonsense"), (("--port", "x"), "--port"),
                              (("--host", "here"), "unixsocket: neither"), (("--precision", "half", "--model", "lennard-jones", "--species", "Ar*8"), "half"),
                              (("--model", "hard-sphere", "--species", "Ar"), "hard-sphere")):
            with self.subTest(options):
                self.ended(self.serve(*options), 2, says)

    def test_a_driver_that_is_not_there_or_goes_is_a_line_and_status_1(self):
        self.ended(self.start("-m", "lanescape.ipi", "--unixsocket", NAME, "--timeout", "0.2", "--model", "lennard-jones"), 1, "no i-PI server listens")
        listening = socket.create_server(("localhost", 0))
        with listening:
            client = self.start("-m", "lanescape.ipi", "--port", listening.getsockname()[1], "--model", "lennard-jones")
            connection, _ = listening.accept()
            connection.close()
        self.ended(client, 1, "has closed the connection")

    def test_a_driver_may_go_between_configurations_without_exit(self):
        def talk(*ends):
            """With one configuration, up to where the driver goes."""
            with socket.create_server(("localhost", 0)) as listening:
                client = self.start("-m", "lanescape.ipi", "--port", listening.getsockname()[1], "--model", "lennard-jones")
                connection, _ = listening.accept()
                with connection:
                    cell = 5.0 * np.eye(3)
                    connection.sendall(b"POSDATA".ljust(12) + cell.tobytes() + cell.tobytes() + np.array([1], np.int32).tobytes() + np.zeros(3).tobytes())
                    for word, answer in ends:
                        connection.sendall(word.ljust(12))
                        self.assertEqual(connection.recv(12, socket.MSG_WAITALL).strip(), answer)
                    if ends[-1][0] == b"GETFORCE":
                        connection.recv(8 + 4 + 24 + 72 + 4 + 1, socket.MSG_WAITALL)
            return client
        self.ended(talk((b"STATUS", b"HAVEDATA"), (b"GETFORCE", b"FORCEREADY")), 0, "1 configurations, and the driver went without EXIT")
        self.ended(talk((b"STATUS", b"HAVEDATA")), 1, "has closed the connection")

    def test_a_peer_that_speaks_something_else_is_a_line(self):
        for said in (b"GET / HTTP/1.1\r\n\r\n", b"POSDATA     " + 144 * b"\0" + b"\xff" * 4):
            with socket.create_server(("localhost", 0)) as listening:
                client = self.start("-m", "lanescape.ipi", "--port", listening.getsockname()[1], "--model", "lennard-jones")
                connection, _ = listening.accept()
                with connection:
                    connection.sendall(said)
                    self.ended(client, 1, "the i-PI server at localhost")

    def test_a_signal_is_status_4(self):
        for which in (signal.SIGTERM, signal.SIGINT):
            with socket.create_server(("localhost", 0)) as listening:
                client = self.start("-m", "lanescape.ipi", "--port", listening.getsockname()[1], "--model", "lennard-jones")
                connection, _ = listening.accept()
                with connection:
                    client.send_signal(which)
                    self.ended(client, 4, "interrupted")


INPUT = """<simulation verbosity='quiet'>
 <output prefix='run'><properties stride='1' filename='out'> [step, conserved, potential] </properties></output>
 <total_steps>20</total_steps>
 <prng><seed>1</seed></prng>
 <ffsocket name='model' mode='unix' pbc='false'><address>{name}</address><latency>1e-4</latency></ffsocket>
 <system>
  <initialize nbeads='1'><file mode='xyz'> start.xyz </file><velocities mode='thermal' units='kelvin'>40</velocities></initialize>
  <forces><force forcefield='model'/></forces>
  <ensemble><temperature units='kelvin'>40</temperature></ensemble>
  <motion mode='dynamics'><dynamics mode='nve'><timestep units='femtosecond'>1</timestep></dynamics></motion>
 </system>
</simulation>
"""
I_PI = shutil.which("i-pi") or shutil.which("i-pi", path=str(Path(sys.executable).parent))


@unittest.skipUnless(I_PI, "i-pi is not here (PyPI: ipi)")
class DriverTest(Processes):
    def test_ipi_moves_argon_with_our_energies(self):
        model = lanescape.Model.mixture(["Ar"], 0.0104 / ase.units.Ha, 3.4 / ase.units.Bohr, truncation="shifted-force")
        (self.folder / "model.toml").write_text(model.to_toml())
        argon = bulk("Ar", "fcc", a=5.3, cubic=True).repeat(3)
        positions, box = argon.positions / ase.units.Bohr, argon.cell.lengths() / ase.units.Bohr
        lines = [str(len(argon)), f"# CELL(abcABC): {' '.join(map(str, box))} 90.0 90.0 90.0 positions{{atomic_unit}} cell{{atomic_unit}}"]
        (self.folder / "start.xyz").write_text("\n".join(lines + [f"Ar {x} {y} {z}" for x, y, z in positions.tolist()]) + "\n")
        (self.folder / "input.xml").write_text(INPUT.format(name=NAME))
        driver = subprocess.Popen([I_PI, "input.xml"], cwd=self.folder, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        self.addCleanup(lambda: (driver.poll() is None and driver.kill(), driver.wait()))
        self.ended(self.serve("--units", "atomic", "--model-file", self.folder / "model.toml"), 0, "21 configurations")
        self.assertEqual(driver.wait(timeout=60), 0)
        steps = np.loadtxt(self.folder / "run.out")
        expected = lanescape.Potential(model, None, box, particles=len(argon)).energy(positions)
        np.testing.assert_allclose(steps[0, 2], expected, rtol=1e-8)  # the digits that it writes
        np.testing.assert_allclose(steps[:, 1], steps[0, 1], rtol=0, atol=1e-6)


class LandscapeTest(Processes):
    def ase_client(self, name=NAME):
        return self.start("-c", textwrap.dedent(ASE_CLIENT), name)

    def wait_for(self, landscape, positions):
        """The first evaluation, with a client that may start before or after it."""
        return landscape.energy_and_gradient(positions)

    def test_a_path_over_a_client_of_ase_is_that_over_its_calculator(self):
        copper = bulk("Cu", cubic=True).repeat(2)
        copper.calc = EMT()
        rng = np.random.default_rng(1)
        ends = [copper.positions + 0.1 * rng.normal(size=copper.positions.shape) for _ in range(2)]
        options = {"step": 0.05, "max_steps": 100}
        expected = lanescape.find_path(AtomsLandscape(copper), *ends, **options)
        landscape = self.landscape(copper.cell.array)
        client = self.ase_client()
        found = lanescape.find_path(landscape, *ends, **options)
        self.assertEqual((found.outcome, found.direct_steps, found.detour_steps), (expected.outcome, expected.direct_steps, expected.detour_steps))
        np.testing.assert_allclose(found.length, expected.length, rtol=1e-10)
        np.testing.assert_allclose(found.frames, expected.frames, rtol=0, atol=1e-9)
        landscape.close()
        self.assertEqual(client.wait(timeout=30), 0, "the client gets EXIT")
        self.assertFalse(os.path.exists(f"/tmp/ipi_{NAME}"))

    def test_energy_and_gradient_of_one_configuration_are_asked_for_once(self):
        _, species, positions, box = fluid("lennard-jones")
        landscape = self.landscape(box, units="atomic")
        client = self.serve("--units", "atomic", "--model", "lennard-jones")
        landscape.energy_and_gradient(positions)[1][:] = 0.0  # the caller's own
        self.assertTrue(landscape.energy_and_gradient(positions)[1].any())
        landscape.energy(positions)
        self.assertEqual(landscape.evaluations, 1)
        landscape.energy(positions + 0.01)
        landscape.close()
        self.ended(client, 0, "2 configurations")

    def test_clients_come_over_tcp_too(self):
        _, species, positions, box = fluid("lennard-jones")
        landscape = self.landscape(box, unixsocket=None, port=0)
        client = self.start("-m", "lanescape.ipi", "--port", landscape.address.split(":")[1], "--model", "lennard-jones")
        expected = lanescape.Potential(lanescape.Model.named("lennard-jones"), None, box, particles=len(positions)).energy(positions)
        np.testing.assert_allclose(landscape.energy(positions), expected, rtol=1e-13)
        landscape.close()
        self.ended(client, 0)

    def test_a_client_that_dies_is_a_run_error_and_another_may_come(self):
        copper = bulk("Cu", cubic=True).repeat(2)
        copper.calc = EMT()
        landscape = self.landscape(copper.cell.array)
        first = self.ase_client()
        landscape.energy(copper.positions)
        first.kill()
        first.wait()
        with self.assertRaisesRegex(lanescape.RunError, "^the i-PI client at /tmp/ipi_[^\n]+$"):
            lanescape.find_path(landscape, copper.positions, copper.positions + 0.1)
        self.ase_client()
        np.testing.assert_allclose(landscape.energy(copper.positions), copper.get_potential_energy(), rtol=1e-12)

    def test_a_host_with_the_default_action_of_sigpipe_lives_on(self):
        script = """
            import signal, socket, sys, threading, numpy, lanescape
            from lanescape.ipi import SocketLandscape
            signal.signal(signal.SIGPIPE, signal.SIG_DFL)
            landscape = SocketLandscape([5.0, 5.0, 5.0], host="localhost", port=0)
            for _ in range(3):
                client = socket.create_connection(("localhost", int(landscape.address.split(":")[1])))
                landscape._connection()
                client.close()
                try:
                    landscape.energy(numpy.eye(3))
                except lanescape.RunError as error:
                    print(error)
        """
        run = subprocess.run([sys.executable, "-c", textwrap.dedent(script)], capture_output=True, text=True, timeout=60)
        self.assertEqual((run.returncode, run.stderr, len(run.stdout.splitlines())), (0, "", 3))

    def test_silence_and_absence_end_after_the_timeout(self):
        landscape = self.landscape([5.0, 5.0, 5.0], timeout=0.2)
        with self.assertRaisesRegex(lanescape.RunError, "no i-PI client has connected .* within 0.2 s"):
            landscape.energy(np.eye(3))
        with socket.socket(socket.AF_UNIX) as silent:
            silent.connect(landscape.address)
            with self.assertRaisesRegex(lanescape.RunError, "was silent for 0.2 s"):
                landscape.energy(np.eye(3))

    def test_a_client_with_other_atoms_or_words_is_refused(self):
        def answers(*parts):
            landscape = self.landscape([5.0, 5.0, 5.0], timeout=5.0)
            with socket.socket(socket.AF_UNIX) as client:
                client.connect(landscape.address)
                client.sendall(b"".join(parts))
                try:
                    landscape.energy(np.eye(3))
                finally:
                    landscape.close()
        ready, data = b"READY".ljust(12), b"HAVEDATA".ljust(12) + b"FORCEREADY".ljust(12) + np.zeros(1).tobytes()
        with self.assertRaisesRegex(lanescape.InputError, "has 4 atoms: the landscape has 3"):
            answers(ready, data, np.array([4], np.int32).tobytes())
        with self.assertRaisesRegex(lanescape.RunError, "sent -1 for a count"):
            answers(ready, data, np.array([-1], np.int32).tobytes())
        with self.assertRaisesRegex(lanescape.RunError, "answered 'HTTP/1.1 404'"):
            answers(b"HTTP/1.1 404 Not Found")

    def test_sockets_of_killed_servers_are_replaced_and_others_are_not(self):
        path = self.folder / "socket"
        with socket.socket(socket.AF_UNIX) as dead:
            dead.bind(str(path))
        self.assertTrue(path.exists())
        landscape = self.landscape([5.0, 5.0, 5.0], unixsocket=str(path))
        with self.assertRaisesRegex(lanescape.InputError, "another server listens there"):
            self.landscape([5.0, 5.0, 5.0], unixsocket=str(path))
        landscape.close()
        landscape.close()
        self.assertFalse(path.exists())
        with self.assertRaisesRegex(lanescape.InputError, "was closed"):
            landscape.energy(np.eye(3))
        path.write_text("mine")
        with self.assertRaisesRegex(lanescape.InputError, "it is no socket"):
            self.landscape([5.0, 5.0, 5.0], unixsocket=str(path))
        self.assertEqual(path.read_text(), "mine")

    def test_bad_arguments_are_refused(self):
        for bad in ({"cell": [1.0, 2.0]}, {"cell": [1.0, 0.0, 1.0]}, {"cell": [1.0, np.nan, 1.0]}, {"units": "metal"}, {"unixsocket": ""},
                    {"unixsocket": 200 * "x"}, {"unixsocket": "/nowhere/socket"}, {"port": 1}, {"unixsocket": None, "port": 70000}):
            with self.assertRaises(lanescape.InputError, msg=bad):
                self.landscape(**{"cell": [5.0, 5.0, 5.0], **bad})
        with self.assertRaises(TypeError):
            Client("kob-andersen", unixsocket=NAME)


if __name__ == "__main__":
    unittest.main()
