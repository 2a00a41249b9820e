"""Code in docs/HOSTS.md is copied exactly from files of docs/snippets/hosts, which are built and run by tests; Python runs from the page."""

import pathlib
import re
import unittest

DOCS = pathlib.Path(__file__).resolve().parents[2] / "docs"
FILES = {"c": "*.c", "cmake": "CMakeLists.txt", "cpp": "*.cpp", "fortran": "*.f90", "lammps": "in.*", "sh": "*.sh"}


class HostsDocument(unittest.TestCase):
    def test_every_block_is_in_a_file(self):
        blocks = re.findall(r"^```(\w+)\n(.*?)^```", (DOCS / "HOSTS.md").read_text(encoding="utf-8"), re.MULTILINE | re.DOTALL)
        self.assertGreaterEqual({language for language, _ in blocks}, {"c", "cmake", "cpp", "fortran", "sh"})
        for language, block in blocks:
            if language == "python":  # tests/python_package/examples_test.py
                continue
            self.assertIn(language, FILES)
            files = sorted((DOCS / "snippets" / "hosts").rglob(FILES[language]))
            found = any("\n" + block in "\n" + file.read_text(encoding="utf-8") for file in files)
            self.assertTrue(found, f"no {FILES[language]} of docs/snippets/hosts has:\n{block}")


if __name__ == "__main__":
    unittest.main()
