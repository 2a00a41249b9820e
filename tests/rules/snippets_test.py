"""Code in the documents is copied exactly from the programs in docs/snippets."""

import pathlib
import re
import unittest

DOCS = pathlib.Path(__file__).resolve().parents[2] / "docs"


class Snippets(unittest.TestCase):
    def test_every_block_of_the_kernel_document_is_in_its_program(self):
        program = (DOCS / "snippets" / "own_kernel.cpp").read_text(encoding="utf-8")
        blocks = re.findall(r"^```cpp\n(.*?)^```", (DOCS / "KERNELS.md").read_text(encoding="utf-8"), re.MULTILINE | re.DOTALL)
        self.assertGreater(len(blocks), 3)
        for block in blocks:
            self.assertIn("\n" + block, program)


if __name__ == "__main__":
    unittest.main()
