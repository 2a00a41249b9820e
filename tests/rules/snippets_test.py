"""Code in the documents is copied exactly from the programs in docs/snippets and docs/examples."""

import pathlib
import re
import unittest

DOCS = pathlib.Path(__file__).resolve().parents[2] / "docs"


class Snippets(unittest.TestCase):
    def check_blocks(self, document, language, program, least):
        """Every block of this language is in the program, and there are at least so many."""
        text = "\n" + (DOCS / program).read_text(encoding="utf-8")
        blocks = re.findall(rf"^```{language}\n(.*?)^```", (DOCS / document).read_text(encoding="utf-8"), re.MULTILINE | re.DOTALL)
        self.assertGreaterEqual(len(blocks), least)
        for block in blocks:
            self.assertIn("\n" + block, text)

    def test_every_block_of_the_kernel_document_is_in_its_program(self):
        self.check_blocks("KERNELS.md", "cpp", "snippets/own_kernel.cpp", 4)

    def test_every_block_about_kernels_of_hosts_is_in_the_example(self):
        for language, program in (("c", "host_kernel/verification.c"), ("cmake", "host_kernel/CMakeLists.txt"), ("sh", "host_kernel/ci.sh"),
                                  ("python", "host_kernel_python/test_my_fluid.py")):
            self.check_blocks("HOST_KERNELS.md", language, f"examples/{program}", 1)


if __name__ == "__main__":
    unittest.main()
