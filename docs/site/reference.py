#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""reference.py FOLDER: writes what the API reference is made from.

FOLDER/headers has the public headers as Doxygen shall read them, their comments turned into
reStructuredText; FOLDER/tree/docs/api has a page for each, and the indices.
"""
import re
import sys
from pathlib import Path

import fortran_reference
import headers
import julia_reference
import python_reference

CONSTANTS = {}
OPTIONS = {}


def escaped(text):
    return re.sub(r"([*|\\]|_(?!\w)|(?<!\w)_)", r"\\\1", text)


def linked(text, options=False):
    """A sentence of a comment as reStructuredText, its names as links."""
    words = re.compile(r"(`[^`]+`|\bwfpsf_\w+\(\)|\bWFPSF_\w+\*?|\b(?:ERROR|WARNING)_\w+\*?"
                       + (r"|\b[A-Z][A-Z_]+\b" if options else "") + ")")
    out = []
    for part in words.split(text):
        if part.startswith("`"):
            out.append(f"`{part}`")
        elif part.startswith("wfpsf_") and part.endswith("()"):
            out.append(f":c:func:`{part[:-2]}`")
        elif part in CONSTANTS:
            out.append(f":c:enumerator:`{part}`")
        elif f"WFPSF_{part}" in CONSTANTS and not options:
            out.append(f":c:enumerator:`{part} <WFPSF_{part}>`")
        elif options and part in OPTIONS:
            out.append(f":c:enumerator:`{part} <{OPTIONS[part]}>`")
        elif part.startswith("WFPSF_"):
            out.append(f"``{part}``")
        else:
            out.append(escaped(part))
    # A role ends at its backtick: a letter that follows needs an escaped space.
    return re.sub(r"(:c:\w+:`[^`]+`)(?=\w)", r"\1\\ ", "".join(out))


def section(name, items):
    if name == "Status":
        return [f":Status: {linked(items[0].text)}"]
    lines = [f":{name}:"]
    for item in items:
        names = ", ".join(f"``{each}``" for each in item.names)
        text = linked(item.text, options="options" in item.names)
        lines.append("   - " + " — ".join(filter(None, (names, text))))
    return lines


def parted(prose):
    """What is said of threads stands by itself."""
    for part in prose:
        yield from re.split(r" (?=Thread-safe)", part) if isinstance(part, str) else [part]


def rst(comment, more=()):
    lines = []
    for part in parted(comment.prose):
        if isinstance(part, list):
            least = min(len(line) - len(line.lstrip()) for line in part)
            language = "c" if any(line.endswith(";") for line in part) else "none"
            lines += [f".. code-block:: {language}", ""]
            lines += [*("   " + line[least:] for line in part), ""]
        else:
            lines += [linked(re.sub(r"^@file \S+ ", "", part)), ""]
    for name, items in comment.sections.items():
        lines += section(name, items)
    lines += more
    # Blank lines between sentences and fields are needed, others do no harm.
    return "\n".join(lines)


def doxygen(text):
    return f"/**\n@verbatim embed:rst\n{text}\n@endverbatim\n*/"


def number(text):
    """A bound as one reads it."""
    if text == "WFPSF_AUTOMATIC":
        return "automatic"
    if "e-308" in text:
        return "above 0"
    return "any" if "e308" in text else text.lower()


def cells(xlist, row):
    """Titles and cells of a row after the constant; what bounds a value is one cell."""
    fields = dict(zip(xlist.columns, row))
    for column, value in list(fields.items())[1:]:
        if column == "standard":
            kind = "integer " if fields["kind"] == "INTEGER" else ""
            yield "default; bounds", (f"{kind}{number(value)}; {number(fields['smallest'])} to "
                                      f"{number(fields['largest'])}")
        elif column == "text":
            yield "what it is", linked(value)
        elif column not in ("kind", "smallest", "largest"):
            yield column, number(value)


def table(xlist):
    # The constants belong to no macro.
    lines = [".. c:namespace:: NULL", "", ".. list-table::", "   :header-rows: 1",
             "   :class: wfpsf-list", "", "   * - constant"]
    lines += [f"     - {title}" for title, _ in cells(xlist, xlist.rows[0])]
    for row in xlist.rows:
        lines += [f"   * - .. c:enumerator:: {xlist.prefix}{row[0]}", ""]
        lines += [f"     - {cell}" for _, cell in cells(xlist, row)]
    return "\n".join(lines)


def rewritten(name, text, callers):
    """A header with its comments in reStructuredText and its lists as tables."""
    for xlist in reversed(headers.lists(text)):
        begin = text.rindex("/**", 0, xlist.span[0])
        comment = headers.read(headers.COMMENT.match(text, begin).group(1))
        text = (text[:begin] + doxygen(rst(comment, ["", table(xlist)]))
                + f"\n#define {xlist.name}(X)\n" + text[xlist.span[1]:])

    file_comment = re.search(r"/\*\*\s*\* @file.*?\*/", text, re.DOTALL)
    shown = doxygen(rst(headers.read(file_comment.group()[3:-2])))
    text = text.replace(file_comment.group(), f"/** @file */\n{shown}".replace("*/\n/**", ""), 1)

    for function, comment in headers.functions(text).items():
        if "@verbatim" in comment:
            sys.exit(f"{function}: no comment of its own to be found")
    comments = headers.functions(text)
    done = set()
    for match in reversed(list(headers.FUNCTION.finditer(text))):
        function = match.group(1)
        where = callers.get(function, [])
        example = [f":Example: ``{where[0]}``"] if where else []
        new = doxygen(rst(headers.read(comments[function]), example))
        before = text[:match.start()].rstrip()
        if before.endswith("*/"):
            before = before[:before.rindex("/**")]
        text = before + "\n" + new + "\n" + text[match.start():]
        done.add(function)

    def other(match):
        if "@verbatim" in match.group() or "@file" in match.group():
            return match.group()
        return doxygen(rst(headers.read(match.group(1))))

    # Comments of enums as wholes and of callbacks, but not those inside enums.
    text = re.sub(headers.COMMENT.pattern + r"(?=\n(?:enum|typedef|#define))", other, text,
                  flags=re.DOTALL)
    text = re.sub(r"(?<!\*/\n)(typedef struct (wfpsf_\w+) \2;)", r"/** An opaque handle. */\n\1",
                  text)
    return text.replace("WFPSF_EXPORT ", "")


def pages(folder, callers):
    names = [name for name in headers.HEADERS]
    index = ["# The C interface", "",
             "One page for each header, made from its comments. [Fortran](fortran),",
             "[Julia](julia) and [Python](python) have the same nouns and verbs.", "",
             "```{toctree}", ":maxdepth: 1", "", *(name.removesuffix(".h") for name in names),
             "examples", "```", ""]
    (folder / "index.md").write_text("\n".join(index))
    for name in names:
        stem = name.removesuffix(".h")
        title = f"wfpsf/{name}"
        (folder / f"{stem}.rst").write_text(
            f"{title}\n{'=' * len(title)}\n\n.. doxygenfile:: {name}\n"
            "   :sections: briefdescription detaileddescription define enum typedef func\n")
    comments = {function: comment for name in names
                for function, comment in headers.functions(headers.text_of(name)).items()}
    (folder / "python.rst").write_text("\n".join(python_reference.page()) + "\n")
    (folder / "fortran.rst").write_text("\n".join(fortran_reference.page(comments, linked)) + "\n")
    (folder / "julia.md").write_text("\n".join(julia_reference.page()) + "\n")
    lines = ["# Where each function is used", "",
             "Examples and tests that call it, the shortest way to see it at work. Found in the",
             "sources as this page was made.", "", "| Function | Used in |", "|---|---|"]
    for name in names:
        for function in headers.functions(headers.text_of(name)):
            files = ", ".join(f"`{path}`" for path in callers.get(function, [])[:4])
            lines.append(f"| {{c:func}}`{function}` | {files} |")
    (folder / "examples.md").write_text("\n".join(lines) + "\n")


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    folder = Path(sys.argv[1])
    texts = {name: headers.text_of(name) for name in headers.HEADERS}
    for name, text in texts.items():
        header = headers.generate.read_header(
            headers.generate.HEADERS / (name if name != "version.h" else "version.h.in"),
            headers.generate.project_numbers(), {})
        CONSTANTS.update(dict.fromkeys(header.constants))
    OPTIONS.update({name.removeprefix("WFPSF_OPTION_"): name for name in CONSTANTS
                    if name.startswith("WFPSF_OPTION_")})
    callers = headers.callers()
    (folder / "headers").mkdir(parents=True, exist_ok=True)
    api = folder / "tree/docs/api"
    api.mkdir(parents=True, exist_ok=True)
    for name, text in texts.items():
        (folder / "headers" / name).write_text(rewritten(name, text, callers))
    pages(api, callers)


if __name__ == "__main__":
    main()
