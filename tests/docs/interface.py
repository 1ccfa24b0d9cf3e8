#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Every public function tells what a caller must know: what is given and returned, each argument by
its name; units of its numbers; statuses; which threads may call it; and something calls it that can
be copied from.

What a function shares with others may stand in their comments ("as for wfpsf_x()") or in that of
the file.
"""
import re
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "docs/site"))
import headers  # noqa: E402

# Units, or what makes a number one without a unit.
UNITS = re.compile(
    r"pixel|arcsec|degree|\bnm\b|metre|kelvin|\bs\b|\be-|cycle|wave|byte|radian|\bdays\b|\bunits?\b"
    r"|dimensionless|fraction|transmission|shares?\b|residual|rms|coefficient|Gregorian"
    r"|K\(dx, dy\)")
UNIT_NAMES = re.compile(r"_(deg|nm|m|k|arcsec|pix|s|date)$")
# alpha and its like are shares of charge; a property's unit stands in its list.
WITHOUT = re.compile(r"alpha|value|standard|smallest|largest|^expected$|^M[xy][xy]$")


def told(function, comments, seen=()):
    """The comment of a function with those it refers to."""
    text = comments[function] or ""
    for other in re.findall(r"\b(wfpsf_\w+)\(\)", text):
        if other in comments and other != function and other not in seen:
            text += told(other, comments, (*seen, function))
    return text


def main():
    texts = {name: headers.text_of(name) for name in headers.HEADERS}
    comments, home = {}, {}
    for name, text in texts.items():
        for function, comment in headers.functions(text).items():
            comments[function], home[function] = comment, name
    callers = headers.callers()
    declared = {function.name: function for text in texts.values()
                for function in headers.generate.functions(text, {})}
    faults = []
    for function, comment in comments.items():
        header = texts[home[function]]
        file_comment = re.search(r"@file.*?\*/", header, re.DOTALL).group()
        if not comment:
            faults.append(f"{function}: no comment")
            continue
        near = told(function, comments)
        shape = declared.get(function)
        arguments = shape.arguments if shape else []
        noun = re.match(r"(wfpsf_(?:varying_|ipc_)?[a-z]+)", function).group(1)
        for argument in arguments:
            is_self = argument.type.replace("const ", "").rstrip("*").startswith(noun)
            if not is_self and not re.search(rf"\b{argument.name}\b", near):
                faults.append(f"{function}: {argument.name} is not told")
            if (argument.type.startswith(("double", "const double"))
                    and not UNIT_NAMES.search(argument.name)
                    and not WITHOUT.search(argument.name)):
                about = " ".join(item.text for text in [comment, *(
                    comments[other] for other in re.findall(r"\b(wfpsf_\w+)\(\)", comment)
                    if comments.get(other))] for items in headers.read(text).sections.values()
                    for item in items if argument.name in item.names)
                if not UNITS.search(about) and not re.search(
                        r"(Lengths|lengths|RA and Dec|x and y|positions)", file_comment):
                    faults.append(f"{function}: {argument.name}: no unit: {about}")
        if shape and shape.result == "wfpsf_status" and not re.search(
                r"Status|statuses|WFPSF_OK|status with which", near):
            faults.append(f"{function}: no statuses")
        if shape and shape.result != "void" and "Status" not in comment and not re.search(
                r"NULL|string|Returned|status", comment):
            faults.append(f"{function}: what comes back is not told")
        if not re.search(r"[Tt]hread", comment + file_comment):
            faults.append(f"{function}: nothing of threads")
        if function not in callers and not function.endswith("_check_version"):
            faults.append(f"{function}: no example or test in C calls it")
    print("\n".join(faults) or f"{len(comments)} functions are told whole")
    sys.exit(bool(faults))


if __name__ == "__main__":
    main()
