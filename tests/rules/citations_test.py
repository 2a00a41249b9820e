#!/usr/bin/env python3
"""Every label in brackets, section of PHYSICS and document that code and documents cite exists."""

import pathlib
import re
import subprocess
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
FOLDERS = ("kernels", "reference", "src", "tools", "bench", "tests", "docs", "README.md", "CHANGELOG.md")
SOURCES = {".cpp", ".hpp", ".h", ".py", ".md", ".smk", ".sh"}
LABEL = re.compile(r"(?<![\w\])\"'])\[([A-Z]{1,3})\](?![\[(:=])")
# Comments and prose only: in code, [N] may be an index.
COMMENT = re.compile(r"(?://|#|\"\"\"|^\s*\*)(.*)")
SECTION = re.compile(r"PHYSICS(?:\.md)?,? (\d+(?:\.\d+)?)")
DOCUMENT = re.compile(r"docs/([A-Z]+\.md)")


def labels_there():
    return set(re.findall(r"^\| \[([A-Z]+)\] \|", (ROOT / "docs/REFERENCES.md").read_text(), re.MULTILINE))


def sections_there():
    return set(re.findall(r"^#+ (\d+(?:\.\d+)?)[. ]", (ROOT / "docs/PHYSICS.md").read_text(), re.MULTILINE))


def prose(path, line):
    if path.suffix == ".md":
        return line
    comment = COMMENT.search(line)
    return comment[1] if comment else ""


def unresolved(path, lines):
    labels, sections = labels_there(), sections_there()
    found = []
    for number, line in enumerate(lines, 1):
        text = prose(path, line)
        found += [(number, f"[{label}]") for label in LABEL.findall(text) if label not in labels]
        found += [(number, f"PHYSICS {s}") for s in SECTION.findall(line) if s not in sections]
        found += [(number, f"docs/{d}") for d in DOCUMENT.findall(line) if not (ROOT / "docs" / d).is_file()]
    return found


class Citations(unittest.TestCase):
    def test_every_citation_of_the_tree_resolves(self):
        paths = [ROOT / f for f in subprocess.run(["git", "ls-files", *FOLDERS], cwd=ROOT, capture_output=True, text=True,
                                                  check=True).stdout.split()] if (ROOT / ".git").exists() else [
            p for f in FOLDERS for p in ([ROOT / f] if (ROOT / f).is_file() else (ROOT / f).rglob("*"))]
        bad = [f"{path.relative_to(ROOT)}:{number}: {what}" for path in paths
               if path.suffix in SOURCES and path.is_file() and path != pathlib.Path(__file__).resolve()
               for number, what in unresolved(path, path.read_text(encoding="utf-8").splitlines())]
        self.assertEqual(bad, [])

    def test_a_label_a_section_and_a_document_that_are_not_there_are_found(self):
        lines = ["// as [Q] says", "// PHYSICS 9.9", "// see docs/NOWHERE.md", "// [G] and PHYSICS 1.1 and docs/PHYSICS.md"]
        self.assertEqual(unresolved(pathlib.Path("a.cpp"), lines), [(1, "[Q]"), (2, "PHYSICS 9.9"), (3, "docs/NOWHERE.md")])


if __name__ == "__main__":
    unittest.main()
