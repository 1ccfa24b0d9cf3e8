# SPDX-License-Identifier: GPL-3.0-or-later
"""The reference of the Julia package, from its docstrings: no Julia is needed."""
import re
from pathlib import Path

SOURCES = Path(__file__).resolve().parents[2] / "bindings/julia/src"
DOCSTRING = re.compile(r'^"""\n(.*?)^"""\n|^"([^"\n][^\n]*)"\n', re.DOTALL | re.MULTILINE)
SIGNATURE = re.compile(r"    (.*)")


def unescaped(text):
    return re.sub(r"\\([\"\\$])", r"\1", text)


def docstrings(path):
    """(docstring, what follows it up to the next one)."""
    text = path.read_text()
    found = list(DOCSTRING.finditer(text))
    ends = [match.start() for match in found[1:]] + [len(text)]
    for match, end in zip(found, ends):
        yield unescaped(match[1] or match[2]), text[match.end():end]


def names_of(documentation, code):
    """What is documented: the names of the signatures, or of what follows."""
    block = re.match(r"(?:    .*\n)*", documentation)[0]
    names = re.findall(r"^    ([\w!]+)[({]", block, re.MULTILINE)
    named = re.match(r"(?:mutable )?(?:struct |function |abstract type |module |const )?([\w!]+)",
                     code)
    return list(dict.fromkeys(names)) or [named[1]]


def label(name):
    return "julia-" + name.replace("!", "-in-place").lower()


def calls_of(names, code):
    """The C functions that the definitions of these names call."""
    own = [part for part in re.split(r"\n\n(?=\S)", code)
           if any(re.search(rf"\b{name.rstrip('!')}\b", part) for name in names)]
    calls = dict.fromkeys(re.findall(r"LibWfpsf\.(wfpsf_\w+)", "\n".join(own)))
    return [call for call in calls if not call.endswith("_destroy")]


def entry(documentation, code, names, known):
    for name in names:
        if known[name] is documentation:  # the first of several methods
            yield f"({label(name)})="
    yield from (f"## {', '.join(names)}", "")
    block = re.match(r"(?:    .*\n)*", documentation)[0]
    if block:
        yield from ("```julia", *(line[4:] for line in block.splitlines()), "```", "")
    body = documentation[len(block):].strip("\n")
    body = body.replace("```jldoctest", "```julia")
    # An indented block of code needs a language.
    body = re.sub(r"(?<=\n\n)((?:    .*\n|\n(?=    ))+)",
                  lambda match: "```julia\n" + re.sub("^    ", "", match[1], flags=re.M).rstrip("\n")
                  + "\n```\n", body + "\n")
    body = re.sub(r"\[`([\w!]+)`\]\(@ref\)",
                  lambda match: f"[`{match[1]}`]({label(match[1])})" if match[1] in known
                  else f"`{match[1]}`", body)
    yield from (body.strip("\n"), "")
    calls = calls_of(names, code)
    if calls:
        yield from ("In C: " + ", ".join(f"{{c:func}}`{call}`" for call in calls), "")


def page():
    module = (SOURCES / "Wfpsf.jl").read_text()
    order = ["Wfpsf.jl", *re.findall(r'include\("(\w+\.jl)"\)', module)]
    entries = [(text, code, names_of(text, code)) for name in order if name != "LibWfpsf.jl"
               for text, code in docstrings(SOURCES / name)]
    known = {}
    for text, _, names in entries:
        for name in names:
            known.setdefault(name, text)
    yield from ("# The Julia package", "",
                "Made from the docstrings, which `?name` shows in Julia too. Units, tolerances and "
                "statuses stand at the C functions that each calls; those count positions from "
                "(0, 0), Julia from (1, 1).", "")
    for text, code, names in entries:
        yield from entry(text, code, names, known)
