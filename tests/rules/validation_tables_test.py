"""The tables of docs/VALIDATION.md are those of campaigns/data, and one that is not is noticed."""

import re
import subprocess
import sys
import unittest
from pathlib import Path

CAMPAIGNS = Path(__file__).resolve().parents[2] / "campaigns"
sys.path.insert(0, str(CAMPAIGNS))
import chapter_tables  # noqa: E402
import tables  # noqa: E402


class ValidationTables(unittest.TestCase):
    def setUp(self):
        self.document = tables.DOCUMENT.read_text(encoding="utf-8")

    def test_they_are_those_of_the_data(self):
        run = subprocess.run([sys.executable, CAMPAIGNS / "tables.py", "--check"], capture_output=True, text=True)
        self.assertEqual((run.returncode, run.stderr), (0, ""))

    def test_each_table_is_shown_once(self):
        shown = [mark.group("name") for mark in tables.MARKED.finditer(self.document)]
        self.assertEqual(sorted(shown), sorted(chapter_tables.TABLES))

    def test_a_changed_figure_is_noticed_in_every_table(self):
        for mark in tables.MARKED.finditer(self.document):
            block = mark.group(0)
            figure = re.search(r"\d\.\d+", block)
            changed = block[:figure.start()] + str(round(float(figure.group(0)) + 0.1, 4)) + block[figure.end():]
            self.assertNotEqual(changed, block)
            self.assertEqual(tables.renewed(changed), block, mark.group("name"))

    def test_each_table_names_what_made_it(self):
        for mark in tables.MARKED.finditer(self.document):
            self.assertRegex(mark.group(0), r"`snakemake [^`]+`: Lanescape \d+\.\d+\.\d+, g\+\+ [\d.]+, \w+, [^|\n]+, \d{4}-\d\d-\d\d\.\n")


if __name__ == "__main__":
    unittest.main()
