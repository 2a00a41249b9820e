"""The example scripts and the snippets of docs/HOSTS.md run: LANESCAPE_SOURCE names the tree that holds them."""

import os
import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

SOURCE = Path(os.environ["LANESCAPE_SOURCE"])


class ExamplesTest(unittest.TestCase):
    def assert_runs(self, *command):
        with tempfile.TemporaryDirectory() as folder:
            run = subprocess.run([sys.executable, *command], cwd=folder, capture_output=True, text=True, timeout=120)
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertTrue(run.stdout)

    def test_every_example_runs(self):
        scripts = sorted((SOURCE / "bindings/python/examples").glob("*.py"))
        self.assertGreaterEqual(len(scripts), 11)
        for script in scripts:
            with self.subTest(script.name):
                self.assert_runs(str(script))

    def test_every_snippet_of_the_guide_for_hosts_runs(self):
        guide = (SOURCE / "docs/HOSTS.md").read_text()
        snippets = re.findall(r"^```python\n(.*?)^```$", guide, re.MULTILINE | re.DOTALL)
        self.assertGreaterEqual(len(snippets), 2)
        for snippet in snippets:
            with self.subTest(snippet.splitlines()[0]):
                self.assert_runs("-c", snippet)


if __name__ == "__main__":
    unittest.main()
