# SPDX-License-Identifier: GPL-3.0-or-later
"""Reads the comments of the public headers: their prose, and what is given, returned and answered.

    Given:    names  text, further lines of it
                     deeper than the names
    Returned: names  text
    Status:   text
"""
import re
import sys
from pathlib import Path
from typing import NamedTuple

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "bindings"))
import generate  # noqa: E402  the bindings' reader of the same headers

HEADERS = [name.removesuffix(".in") for name in generate.ORDER]
SECTIONS = ("Given", "Returned", "Status")
COMMENT = re.compile(r"/\*\*(?!<)((?:(?!\*/).)*)\*/", re.DOTALL)
FUNCTION = re.compile(r"(?:static inline|WFPSF_EXPORT)\s+[\w\s*]+?(wfpsf_\w+)\([^)]*\)\s*[;{]")


class Item(NamedTuple):
    names: list  # empty where a sentence stands by itself
    text: str


class Comment(NamedTuple):
    prose: list  # paragraphs, and lists of lines that stand as they are
    sections: dict  # "Given": items; "Status": one item


class XList(NamedTuple):
    name: str
    prefix: str  # of the constants
    columns: list
    rows: list
    span: tuple  # where it stands in the header, the enum that is made from it included


def text_of(name):
    path = generate.HEADERS / name
    if not path.exists():
        path = path.with_suffix(".h.in")
    numbers = generate.project_numbers()
    return re.sub(r"@([A-Z]\w+)@", lambda match: numbers[match.group(1)], path.read_text())


def lines_of(comment):
    return [re.sub(r"^\s*\* ?", "", line).rstrip() if i else line.strip()
            for i, line in enumerate(comment.rstrip().split("\n"))]


def items_of(lines, column):
    """Items whose names begin at the column; deeper lines go on with the text of the last."""
    items = []
    for line in lines:
        depth = len(line) - len(line.lstrip())
        head = re.match(r"(\S+(?: \S+)*?)(?:  +(.*))?$", line.strip())
        names = head.group(1)
        is_names = re.fullmatch(r"[A-Za-z_]\w*(?:(?:, | \.\.\. )[A-Za-z_]\w*)*", names)
        if depth > column and items:
            items[-1] = Item(items[-1].names, f"{items[-1].text} {line.strip()}".strip())
        elif is_names and (head.group(2) or "," in names or " " not in names):
            items.append(Item(re.split(r", | \.\.\. ", names), head.group(2) or ""))
        elif items and not items[-1].names:
            items[-1] = Item([], f"{items[-1].text} {line.strip()}")
        else:
            items.append(Item([], line.strip()))
    return items


def read(comment):
    prose, sections, block = [], {}, []

    def close():
        if not block:
            return
        label = re.match(r"(\w+):(\s+)", block[0])
        if label and label.group(1) in SECTIONS:
            starts = [i for i, line in enumerate(block)
                      if re.match("(" + "|".join(SECTIONS) + r"):\s", line)] + [len(block)]
            for begin, end in zip(starts, starts[1:]):
                head = re.match(r"(\w+:\s+)(.*)", block[begin])
                column = len(head.group(1))
                lines = [" " * column + head.group(2), *block[begin + 1:end]]
                name = head.group(1).rstrip(": ")
                sections[name] = ([Item([], " ".join(map(str.strip, lines)))] if name == "Status"
                                  else items_of(lines, column))
        else:
            paragraph = []
            for line in block:
                if line.startswith("  "):
                    if paragraph:
                        prose.append(" ".join(paragraph))
                        paragraph = []
                    if prose and isinstance(prose[-1], list):
                        prose[-1].append(line)
                    else:
                        prose.append([line])
                else:
                    paragraph.append(line)
            if paragraph:
                prose.append(" ".join(paragraph))
        block.clear()

    for line in lines_of(comment):
        if line.strip():
            block.append(line)
        else:
            close()
    close()
    return Comment(prose, sections)


def lists(text):
    """The X-macro lists of a header."""
    result = []
    for define in re.finditer(r"#define (WFPSF_\w+_LIST)\(X\)((?:.*\\\n)*.*)\n", text):
        name = define.group(1)
        enum = re.compile(r"\s*#define (WFPSF_\w+)\(([^)]*)\)\s*(?:\\\n)?\s*(WFPSF_\w*)##name = "
                          r"\(\w+\),\nenum \{ " + name + r"\(\1\) \};\n#undef \1\n")
        made = enum.search(text, define.end())
        columns = [column.strip() for column in made.group(2).split(",")]
        rows = []
        for entry in re.finditer(r'\bX\(((?:"[^"]*"|[^()"])*)\)', define.group(2)):
            fields = re.findall(r'((?:\s*"[^"]*"\s*)+|[^,"]+)(?:,|$)',
                                entry.group(1).replace("\\\n", " "))
            rows.append(["".join(re.findall(r'"([^"]*)"', field)) if '"' in field
                         else field.strip() for field in fields])
            if len(rows[-1]) != len(columns):
                sys.exit(f"{name}: {rows[-1]}: {len(columns)} fields expected")
        result.append(XList(name, made.group(3), columns, rows, (define.start(), made.end())))
    return result


def functions(text):
    """{function: its comment}; those that follow without one share the last."""
    result, last, end = {}, None, 0
    for match in FUNCTION.finditer(text):
        comments = list(COMMENT.finditer(text, end, match.start()))
        if comments and not text[comments[-1].end():match.start()].strip():
            last = comments[-1].group(1)
        result[match.group(1)] = last
        end = match.end()
    return result


def callers():
    """{function: [examples and tests in C that call it]}, the examples first."""
    result = {}
    for pattern in ("examples/c/*.c", "tests/golden/*.c", "tests/package/consumer/*.c",
                    "tests/capi/*.c"):
        for path in sorted(ROOT.glob(pattern)):
            for name in set(re.findall(r"\b(wfpsf_\w+)\(", path.read_text())):
                result.setdefault(name, []).append(str(path.relative_to(ROOT)))
    return result
