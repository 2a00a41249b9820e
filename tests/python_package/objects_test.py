"""Threads, forks, memory and signals."""

import gc
import os
import pickle
import signal
import threading
import unittest

import numpy as np
from support import end_points, fluid, potential

import lanescape


def resident_memory():
    """Pages that the process holds."""
    with open("/proc/self/statm") as numbers:
        return int(numbers.read().split()[1])


class ThreadsTest(unittest.TestCase):
    def test_threads_that_share_an_object_get_right_numbers(self):
        own, positions = potential()
        configurations = [positions + 0.01 * k for k in range(4)] + [positions * (1.0 + 0.001 * k) for k in range(4)]
        expected = [own.energy_and_gradient(r) for r in configurations]
        wrong = []

        def work(offset):
            for k in range(2000):
                n = (k + offset) % len(configurations)
                energy, gradient = own.energy_and_gradient(configurations[n])
                if energy != expected[n][0] or not np.array_equal(gradient, expected[n][1]):
                    wrong.append(n)

        threads = [threading.Thread(target=work, args=(k,)) for k in range(3)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(wrong, [])

    def test_other_threads_run_during_work(self):
        model, start, pair = end_points()
        own, counted = lanescape.Potential(model, start.species, start.box), []
        dynamics = lanescape.MolecularDynamics(own, start.positions, 0.001)
        worker = threading.Thread(target=lambda: dynamics.run(3000))
        worker.start()
        while worker.is_alive() and len(counted) < 100:
            counted.append(1)
        worker.join()
        self.assertEqual(len(counted), 100)


class ForkTest(unittest.TestCase):
    def test_a_child_goes_on_with_its_parent_s_objects(self):
        own, positions = potential(threads=2)
        energy = own.energy(positions)
        child = os.fork()
        if child == 0:
            os._exit(0 if own.energy(positions) == energy and potential(threads=2)[0].energy(positions) == energy else 1)
        signal.alarm(60)
        try:
            self.assertEqual(os.waitpid(child, 0)[1], 0)
        finally:
            signal.alarm(0)
        self.assertEqual(own.energy(positions), energy)


class MemoryTest(unittest.TestCase):
    def assert_no_growth(self, call, times, pages=512):
        for _ in range(times // 20):
            call()
        gc.collect()
        before = resident_memory()
        for _ in range(times):
            call()
        gc.collect()
        self.assertLess(resident_memory() - before, pages)

    def test_a_million_small_calls_do_not_grow(self):
        pair = lanescape.Potential(lanescape.Model.named("lennard-jones"), None, [9.0, 9.0, 9.0], particles=2)
        positions, gradient = np.array([[0.0, 0.0, 0.0], [1.2, 0.0, 0.0]]), np.empty((2, 3))
        self.assert_no_growth(lambda: pair.energy_and_gradient(positions, gradient), 700_000)
        self.assert_no_growth(lambda: pair.energy_and_gradient(positions), 200_000)
        self.assert_no_growth(lambda: pair.evaluate(positions, stress=True, energies=True), 100_000)

    def test_objects_refusals_and_callbacks_do_not_grow(self):
        model, species, positions, box = fluid()
        own = lanescape.Potential(model, species, box)

        def refused():
            try:
                own.energy(positions[1:])
            except ValueError:
                pass

        def failing():
            try:
                lanescape.find_path(lambda r: 1 / 0, positions, positions + 0.1)
            except ZeroDivisionError:
                pass

        pairs = lanescape.NeighbourList(1.5)
        self.assert_no_growth(lambda: lanescape.Potential(model, species, box), 500)
        self.assert_no_growth(lambda: pickle.loads(pickle.dumps(own)), 500)
        self.assert_no_growth(refused, 20_000)
        self.assert_no_growth(failing, 2_000)
        self.assert_no_growth(lambda: pairs.compute(positions, box), 500)
        self.assert_no_growth(lambda: lanescape.MolecularDynamics(own.energy_and_gradient, positions, 0.001).run(1), 500)

    def test_dynamics_and_its_landscape_that_hold_each_other_are_collected(self):
        class Holder:
            def __init__(self):
                self.own, positions = potential()
                self.dynamics = lanescape.MolecularDynamics(self, positions, 0.001)

            def energy_and_gradient(self, positions):
                return self.own.energy_and_gradient(positions)

            def __del__(self):
                gone.append(1)

        gone = []
        Holder()
        gc.collect()
        self.assertEqual(gone, [1])


class SignalTest(unittest.TestCase):
    def test_interruptions_end_long_work(self):
        own, positions = potential()
        dynamics = lanescape.MolecularDynamics(own, positions, 1e-5)
        timer = threading.Timer(0.3, os.kill, (os.getpid(), signal.SIGINT))
        timer.start()
        with self.assertRaises(KeyboardInterrupt):
            dynamics.run(10**9)
        self.assertGreater(dynamics.steps, 0)


if __name__ == "__main__":
    unittest.main()
