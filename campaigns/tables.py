#!/usr/bin/python3
"""Tables of docs/VALIDATION.md from data/: tables.py writes them between their marks, tables.py --check says whether they are those of the data.

A table stands between <!-- table NAME --> and <!-- end of NAME -->; NAME is a function of chapter_tables.py, chapter and table with a dash."""

import re
import sys
from pathlib import Path

import chapter_tables
from data import KEPT, Chapter

DOCUMENT = Path(__file__).resolve().parents[1] / "docs" / "VALIDATION.md"
MARKED = re.compile(r"(<!-- table (?P<name>[a-z0-9-]+) -->\n).*?(<!-- end of (?P=name) -->)", re.DOTALL)


def origin(chapter):
    p = chapter.provenance
    return f"`{p['command']}`: Lanescape {p['version']}, {p['compiler']}, {p['isa']}, {p['cpu']}, {p['date']}."


def text_of(name, folder=KEPT):
    chapter = Chapter(name.split("-")[0], folder)
    table = chapter_tables.TABLES[name](chapter)
    lines = ["| " + " | ".join(row) + " |" for row in table.rows]
    lines.insert(1, "|---" * len(table.rows[0]) + "|")
    return "\n".join(["", *lines, "", f"{table.note} {origin(chapter)}".strip(), "", ""])


def renewed(document, folder=KEPT):
    return MARKED.sub(lambda mark: mark.group(1) + text_of(mark.group("name"), folder) + mark.group(3), document)


def main(arguments):
    if arguments not in ([], ["--check"]):
        sys.exit(__doc__)
    document = DOCUMENT.read_text(encoding="utf-8")
    new = renewed(document)
    if not arguments:
        DOCUMENT.write_text(new, encoding="utf-8")
    elif new != document:
        differs = next(old for old, line in zip(document.splitlines(), new.splitlines()) if old != line)
        sys.exit(f"docs/VALIDATION.md: a table is not that of campaigns/data: {differs[:120]}")


if __name__ == "__main__":
    main(sys.argv[1:])
