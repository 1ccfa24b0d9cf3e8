# SPDX-License-Identifier: GPL-3.0-or-later
"""The reference of the Fortran module, from its interfaces and their comments.

What an argument is, and its unit, comes from the C function that a procedure calls.
"""
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
    comment: str
    arguments: list
    types: dict  # of each argument, and of the result
    result: str


class Type(NamedTuple):
    name: str
    comment: str
    bindings: list  # (name, [procedures])


def statements(text):
    """Lines, continued ones joined, with the comment above each."""
    comment = []
    for line in re.sub(r"&\n\s*", "", text).splitlines():
        line = line.strip()
        if line.startswith("!"):
            comment.append(line.lstrip("! "))
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
                head[1], " ".join(comment), re.findall(r"\w+", head[3]), {}, head[4] or "")
        elif re.match(r"end (subroutine|function)", line):
            inside = None
        elif inside and declared:
            for name, shape in re.findall(r"(\w+)(\([^)]*\))?", declared[2]):
                inside.types[name] = f"{declared[1]} :: {name}{shape}"
        elif opened := re.match(r"type, extends\(handle\) :: (\w+)", line):
            types.append(Type(opened[1], " ".join(comment), []))
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


def paragraphs(lines, linked):
    """Comment lines; an empty one parts two paragraphs."""
    text = "\n".join(lines).strip("\n")
    return [linked(" ".join(part.split())) for part in text.split("\n\n")]


def entry(title, procedure, calls, comments, linked):
    seen = [name for name in procedure.arguments if name != "self"]
    optional = {name for name in seen if "optional" in procedure.types.get(name, "")}
    arguments = ", ".join(f"[{name}]" if name in optional else name for name in seen)
    verb = "call " if procedure.kind == "subroutine" else f"{procedure.result or 'value'} = "
    yield from (f".. describe:: {verb}{title}({arguments})", "")
    if procedure.comment:
        yield from (f"   {linked(procedure.comment)}", "")
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
    for text in paragraphs(about[1:], linked):
        yield from (text, "")
    for each in types:
        yield from (each.name, "-" * len(each.name), "", linked(each.comment), "")
        noun = each.name.removeprefix("wfpsf_")
        for name, bound in each.bindings:
            for procedure in bound:
                yield from entry(f"{noun}%{name}", procedures[procedure], calls.get(procedure, []),
                                 comments, linked)
    yield from ("Without an object", "-----------------", "")
    for name, procedure in procedures.items():
        if name.startswith("wfpsf_"):
            yield from entry(name, procedure, calls.get(name, []), comments, linked)
