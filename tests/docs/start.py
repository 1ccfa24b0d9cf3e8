#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""start.py BUILD WORK PYTHON JULIA: does what docs/start.md says, word for word.

Installs BUILD into WORK/prefix. Then, in an empty folder for each language, saves its program and
runs its commands. All outputs must be one, and the page's. PYTHON and JULIA are programs, or empty
to leave the language out.
"""
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
PAGE = ROOT / "docs/start.md"


def sections():
    """{title: text} of the page."""
    parts = re.split(r"^## (.*)\n", PAGE.read_text(), flags=re.MULTILINE)
    return dict(zip(parts[1::2], parts[2::2]))


def block(text, language):
    return re.search(r"^```" + language + r"\n(.*?)^```", text, re.DOTALL | re.MULTILINE).group(1)


def numbers(output):
    return [float(number) for number in re.findall(r"-?\d+\.\d+", output)]


def main():
    build, work, python, julia = sys.argv[1:]
    work = Path(work)
    shutil.rmtree(work, ignore_errors=True)
    (work / "bin").mkdir(parents=True)
    prefix = work / "prefix"
    subprocess.run(["cmake", "--install", build, "--prefix", prefix], check=True,
                   stdout=subprocess.DEVNULL)

    # The page says python3 and julia: these ones.
    for name, program in (("python3", python), ("julia", julia)):
        if program:
            (work / "bin" / name).symlink_to(program)
    environment = {name: value for name, value in os.environ.items()
                   if name not in ("PYTHONPATH", "WFPSF_LIBRARY", "LD_LIBRARY_PATH")}
    environment |= {"PREFIX": str(prefix), "PATH": f"{work}/bin:{os.environ['PATH']}",
                    "JULIA_DEPOT_PATH": f"{work}/depot:"}

    page = sections()
    expected = block(page["What is printed"], "text")
    outputs = {}
    for title, needed in (("C", "cc"), ("Fortran", "gfortran"), ("Julia", julia),
                          ("Python", python)):
        if not needed or not shutil.which(needed):
            print(f"{title}: left out")
            continue
        folder = work / title
        folder.mkdir()
        included = re.search(r"\{literalinclude\} (\S+)", page[title]).group(1)
        shutil.copy(PAGE.parent / included, folder)
        commands = block(page[title], "sh")
        outputs[title] = subprocess.run(["bash", "-e", "-c", commands], cwd=folder, check=True,
                                        env=environment, capture_output=True, text=True).stdout
        print(f"{title}:\n{outputs[title]}")

    if len(set(outputs.values())) != 1:
        sys.exit("the outputs differ")
    output = outputs["C"]
    if re.sub(r"\d", "", output) != re.sub(r"\d", "", expected):
        sys.exit("the page shows another output")
    # Vector instructions differ from machine to machine in the last bits.
    if any(abs(a - b) > 2.5e-6 for a, b in zip(numbers(output), numbers(expected))):
        sys.exit("the page shows other figures")


if __name__ == "__main__":
    main()
