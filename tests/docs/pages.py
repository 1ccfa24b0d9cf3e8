#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""What pages name is there: files, functions and constants, and every equation of the theory."""
import re
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
FOLDERS = "bench|bindings|capi|cmake|cpp|docs|examples|scripts|tests"
EQUATIONS = 35  # of Kannawadi et al. 2016, subequations as one


def pages():
    return [*ROOT.glob("*.md"), *ROOT.glob("docs/*.md")]


def files_named(text):
    """Paths in backticks; a name alone stands for a file beside the last path with a folder."""
    for code in re.findall(r"`([^`\n]+)`", text):
        path = re.match(rf"(?:{FOLDERS})/[\w./*<>-]*", code)
        if path and not re.search("[*<>]", path.group()):
            yield path.group()


def missing_files():
    for page in pages():
        for path in set(files_named(page.read_text())):
            if not (ROOT / path).exists():
                yield f"{page.name}: {path}: no such file"


def missing_names():
    """Functions and constants of the C interface."""
    known = "\n".join(path.read_text() for path in (ROOT / "capi/include/wfpsf").iterdir())
    known += "\n".join(path.read_text() for path in ROOT.glob("bindings/fortran/src/*.f90"))
    for page in pages():
        # Fenced programs are compiled elsewhere.
        text = re.sub(r"^```.*?^```", "", page.read_text(), flags=re.DOTALL | re.MULTILINE)
        for name in set(re.findall(r"\bwfpsf_\w+\(\)", text)):
            if not re.search(rf"\b{name[:-2]}\(", known):
                yield f"{page.name}: {name}: no such function"
        for name in set(re.findall(r"`WFPSF_(?!LIBRARY)([A-Z]\w+)`", text)):
            suffix = re.sub(r"^(OPTION|PSF|KERNEL|MOMENTS|STUDY|OTF|VARYING_PSF)_", "", name)
            if not re.search(rf"\bWFPSF_{name}\b|\bX\(({name}|{suffix}),", known):
                yield f"{page.name}: WFPSF_{name}: no such constant"


def theory():
    text = (ROOT / "docs/theory.md").read_text()
    rows = [[cell.strip() for cell in line.strip("| ").split(" | ")]
            for line in text.splitlines() if line.startswith("|") and "`" in line]
    numbers = [int(row[0]) for row in rows if row[0].isdigit()]
    if numbers != list(range(1, EQUATIONS + 1)):
        yield f"theory.md: equations {numbers}"
    for row in rows:
        files = [ROOT / path for path in files_named(row[-1])]
        # A declaration may stand beside the definitions.
        sources = [other for path in files for other in path.parent.glob(path.stem + ".*")]
        body = "\n".join(path.read_text() for path in sources)
        if not files:
            yield f"theory.md: {row[0]}: names no file"
        for name in re.findall(r"`(\w+)`", row[-2]):
            if not re.search(rf"\b{name}\b|_{name}\b", body):
                yield f"theory.md: {row[0]}: {name} is in none of its files"


def main():
    found = [*missing_files(), *missing_names(), *theory()]
    print("\n".join(found) or f"{len(pages())} pages are right")
    sys.exit(bool(found))


if __name__ == "__main__":
    main()
