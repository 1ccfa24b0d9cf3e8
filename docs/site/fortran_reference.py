# SPDX-License-Identifier: GPL-3.0-or-later
"""The reference of the Fortran module, from its interfaces and their comments.

What an argument is, and its unit, comes from the C function that a procedure calls.
"""
import itertools
import re
from pathlib import Path
from typing import NamedTuple

import headers

SOURCES = Path(__file__).resolve().parents[2] / "bindings/fortran/src"
HEAD = re.compile(r"(?:(?:pure|impure|elemental) )*module (subroutine|function) (\w+)\((.*?)\)"
                  r"(?: result\((\w+)\))?")
OUTCOME = ("stat", "errmsg")  # of every procedure, told once


class Procedure(NamedTuple):
    kind: str
    comment: list  # lines
    arguments: list
    types: dict  # of each argument, and of the result
    result: str


class Type(NamedTuple):
    name: str
    comment: list
    bindings: list  # (name, [procedures])


def statements(text):
    """Lines, continued ones joined, with the comment above each."""
    comment = []
    for line in re.sub(r"&\n\s*", "", text).splitlines():
        line = line.strip()
        if line.startswith("!"):
            comment.append(line.removeprefix("!").removeprefix(" "))
        else:
            yield line, comment
            comment = []


def read():
    """{name: procedure}, the types, and the module's own comment."""
    text = (SOURCES / "wfpsf.f90").read_text()
    procedures, types, inside, about = {}, [], None, []
    for line, comment in statements(text):
        head = HEAD.match(line)
        declared = re.match(r"(.+?) :: (.*)", line)
        if line == "module wfpsf":
            about = comment
        elif head:
            inside = procedures[head[2]] = Procedure(
                head[1], comment, re.findall(r"\w+", head[3]), {}, head[4] or "")
        elif re.match(r"end (subroutine|function)", line):
            inside = None
        elif inside and declared:
            for name, shape in re.findall(r"(\w+)(\([^)]*\))?", declared[2]):
                inside.types[name] = f"{declared[1]} :: {name}{shape}"
        elif opened := re.match(r"type, extends\(handle\) :: (\w+)", line):
            types.append(Type(opened[1], comment, []))
        elif types and (bound := re.match(r"(?:procedure|generic) :: (\w+) => (.*)", line)):
            types[-1].bindings.append((bound[1], re.findall(r"\w+", bound[2])))
    return procedures, types, about


def called(functions):
    """{procedure: the C functions that it calls}."""
    found = {}
    for path in SOURCES.glob("wfpsf_*.f90"):
        bodies = re.findall(r"module procedure (\w+)\n(.*?)end procedure", path.read_text(), re.S)
        for name, body in bodies:
            calls = re.findall(r"\b(wfpsf_\w+)\(", body)
            found[name] = list(dict.fromkeys(call for call in calls if call in functions))
    return found


def told(calls, comments):
    """{argument: what the C functions say of it}, with the first pixel where Fortran has it."""
    texts = {}
    for call in calls:
        for name, items in headers.read(comments[call] or "").sections.items():
            if name != "Status":
                texts.update((each, item.text.replace("at (0, 0)", "at (1, 1)"))
                             for item in items for each in item.names)
    return texts


def prose(lines, linked):
    """Comment lines as paragraphs, and as code where they are indented."""
    for code, group in itertools.groupby(lines, lambda line: line.startswith("    ")):
        if code:
            yield from (".. code-block:: fortran", "", *group, "")
        else:
            for part in "\n".join(group).split("\n\n"):
                yield from (linked(" ".join(part.split())), "")


def entry(title, procedure, calls, comments, linked):
    seen = [name for name in procedure.arguments if name != "self"]
    optional = {name for name in seen if "optional" in procedure.types.get(name, "")}
    arguments = ", ".join(f"[{name}]" if name in optional else name for name in seen)
    verb = "call " if procedure.kind == "subroutine" else f"{procedure.result or 'value'} = "
    yield from (f".. describe:: {verb}{title}({arguments})", "")
    # What has no comment of its own is told in C.
    own = procedure.comment or (headers.read(comments[calls[0]]).prose[:1] if calls else [])
    yield from ("   " + line if line else "" for line in prose(own, linked))
    texts = told(calls, comments)
    for name in [*seen, *filter(None, [procedure.result])]:
        if name not in OUTCOME:
            text = linked(texts.get(name, ""))
            yield f"   - ``{procedure.types.get(name, name)}``{' — ' + text if text else ''}"
    if calls:
        links = ", ".join(f":c:func:`{call}`" for call in calls)
        yield from ("", f"   In C: {links}")
    yield ""


def page(comments, linked):
    """comments: {C function: its comment}; linked: makes links of names."""
    procedures, types, about = read()
    calls = called(comments)
    yield from ("The Fortran module", "==================", "",
                "Made from the interfaces of ``bindings/fortran/src/wfpsf.f90``, ``use wfpsf``. What "
                "an argument means, and its unit, is quoted from the C function that is called, "
                "whose page has tolerances, statuses and equations; it counts positions from "
                "(0, 0), Fortran from (1, 1). Names of options there, such as EPS, are "
                "``wfpsf_option_eps`` here. Square brackets: may be left out.", "")
    yield from prose([line for line in about if not line.startswith("SPDX")], linked)
    for each in types:
        yield from (each.name, "-" * len(each.name), "")
        yield from prose(each.comment, linked)
        noun = each.name.removeprefix("wfpsf_")
        for name, bound in each.bindings:
            for procedure in bound:
                yield from entry(f"{noun}%{name}", procedures[procedure], calls.get(procedure, []),
                                 comments, linked)
    yield from ("Without an object", "-----------------", "")
    for name, procedure in procedures.items():
        if name.startswith("wfpsf_"):
            yield from entry(name, procedure, calls.get(name, []), comments, linked)
