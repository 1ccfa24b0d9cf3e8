# SPDX-License-Identifier: GPL-3.0-or-later
"""The reference of the Python package, from its sources: nothing is imported, no build needed."""
import ast
import inspect
import re
from pathlib import Path

from sphinx.ext.napoleon import Config, NumpyDocstring

PACKAGE = Path(__file__).resolve().parents[2] / "bindings/python/wfpsf"
STYLE = Config(napoleon_use_param=False, napoleon_use_rtype=False, napoleon_use_ivar=True)


def public():
    """{module: names}, in the order of the package's own imports."""
    tree = ast.parse((PACKAGE / "__init__.py").read_text())
    listed = next(ast.literal_eval(node.value) for node in tree.body
                  if isinstance(node, ast.Assign) and node.targets[0].id == "__all__")
    found = {}
    for node in tree.body:
        if isinstance(node, ast.ImportFrom) and node.level == 1 and node.module:
            names = [alias.name for alias in node.names if alias.name in listed]
            if names:
                found[node.module] = names
    return found


def indented(text, spaces):
    return [" " * spaces + line if line else "" for line in text.splitlines()]


def sections(documentation):
    """Paragraphs that come after a list of parameters do not belong to it."""
    paragraphs, after = documentation.split("\n\n"), False
    for i, paragraph in enumerate(paragraphs):
        first, *rest = paragraph.split("\n")
        is_title = bool(rest) and set(rest[0]) == {"-"}
        if after and not is_title:
            if paragraph.startswith(">>>"):
                paragraphs[i] = f"Examples\n--------\n{paragraph}"
            elif not first.startswith(" ") and " : " not in first:
                paragraphs[i] = f"Notes\n-----\n{paragraph}"
        after = after or is_title
    return "\n\n".join(paragraphs)


def entry(node, kind, depth, options=()):
    arguments = "" if kind in ("property", "class") else f"({ast.unparse(node.args)})"
    if kind == "class":
        made = [part for part in node.body if getattr(part, "name", "") == "__init__"]
        arguments = f"({ast.unparse(made[0].args)})" if made else ""
    arguments = re.sub(r"\((?:self|cls)(?:, )?", "(", arguments)
    yield from indented(f".. py:{kind}:: {node.name}{arguments}", depth)
    yield from indented("\n".join(f"   :{option}:" for option in options), depth)
    yield ""
    documentation = inspect.cleandoc(ast.get_docstring(node) or "")
    yield from indented(str(NumpyDocstring(sections(documentation), STYLE)), depth + 3)
    yield ""


def members(node):
    for part in node.body:
        if isinstance(part, ast.FunctionDef) and not part.name.startswith("_"):
            marks = [ast.unparse(mark) for mark in part.decorator_list]
            kind = "property" if "property" in marks else "method"
            yield from entry(part, kind, 3, ["classmethod"] if "classmethod" in marks else [])


def page():
    yield from ("The Python package", "==================", "", ".. py:module:: wfpsf", "",
                "Made from the docstrings; :doc:`wfpsf from Python </python>` introduces it, and "
                "``help()`` shows the same.", "")
    for module, names in public().items():
        tree = ast.parse((PACKAGE / f"{module}.py").read_text())
        for node in tree.body:
            if getattr(node, "name", None) not in names:
                continue
            if isinstance(node, ast.ClassDef):
                yield from entry(node, "class", 0)
                yield from members(node)
            else:
                yield from entry(node, "function", 0)
