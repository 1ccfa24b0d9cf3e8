#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes the low-level Fortran, Julia and Python bindings from the C headers.

usage: generate.py [output folder]

The output folder (default: the folder of this script) receives fortran/src/wfpsf_c.f90,
julia/src/LibWfpsf.jl and python/wfpsf/_lib.py. A function, list or enum that is not understood is
an error.
"""

import re
import sys
from pathlib import Path
from typing import NamedTuple

HERE = Path(__file__).resolve().parent
ROOT = HERE.parent
HEADERS = ROOT / "capi/include/wfpsf"
ORDER = ("version.h.in", "status.h", "options.h", "image.h", "instrument.h", "design.h", "sed.h",
         "psf.h", "varying_psf.h", "otf.h", "ipc.h", "varying_ipc.h", "chain.h", "sky.h", "observation.h", "moments.h", "size.h",
         "study.h", "catalogue.h", "scene.h", "exposure.h")
WITHOUT_NAMES = {"export.h", "wfpsf.h"}
WIDTH = 100
CALLBACK = "callback"  # stands for every type of pointers to functions


class Argument(NamedTuple):
    type: str  # the C type in one spelling: "double", "const double*", "wfpsf_psf**"; or CALLBACK
    name: str
    is_array: bool


class Function(NamedTuple):
    name: str
    result: str
    arguments: list


class Header(NamedTuple):
    name: str
    constants: dict
    functions: list


# ---------------------------------------------------------------------------- reading the headers

def list_constants(text):
    """Constants of the X-macro lists: the WFPSF_x_LIST and the ..._ENUM macro that names them."""
    constants = {}
    for enum in re.finditer(r"#define (WFPSF_\w+_ENUM)\(([^)]*)\) (WFPSF_\w*)##name = \(\w+\),",
                            text):
        macro, _, prefix = enum.groups()
        name = re.search(r"enum \{ (WFPSF_\w+_LIST)\(" + macro + r"\) \};", text).group(1)
        body = re.search(r"#define " + name + r"\(X\)(.*)", text).group(1)
        entries = re.findall(r"\bX\((\w+), (-?\d+),", body)
        if len(entries) != len(re.findall(r"\bX\(", body)):
            sys.exit(f"{name}: an entry is no X(NAME, number, ...)")
        constants |= {prefix + entry: int(value) for entry, value in entries}
    return constants


def enum_constants(text):
    constants = {}
    for body in re.findall(r"enum \{([^}#]*?)\};", text):
        if "_LIST(" in body:
            continue
        for entry in filter(None, (part.strip() for part in body.split(","))):
            name, value = entry.split("=")
            constants[name.strip()] = int(value)
    return constants


def macro_constants(text):
    return {name: int(value)
            for name, value in re.findall(r"^#define (WFPSF_\w+) (-?\d+)$", text, re.MULTILINE)}


def c_type(text):
    """'const wfpsf_image *const *' -> 'const wfpsf_image*const*'."""
    return re.sub(r"\s*\*\s*", "*", " ".join(text.split()))


def callbacks(paths):
    """All types of pointers to functions: {name: (type of the result, [types of the arguments])}."""
    text = "\n".join(path.read_text() for path in paths)
    found = re.findall(r"^typedef ([^;]*?)\(\*(wfpsf_\w+)\)\(([^)]*)\);", text, re.MULTILINE)
    return {name: (c_type(result), [argument.type for argument in arguments(given, "", {})])
            for result, name, given in found}


def arguments(text, documentation, callback_types):
    if text.strip() == "void":
        return []
    result = []
    count_given = False
    for part in text.split(","):
        type_text, name = re.fullmatch(r"\s*(.*?)(\w+)\s*", part, re.DOTALL).groups()
        kind = c_type(type_text)
        if kind in callback_types:
            kind = CALLBACK
        # Numbers come as arrays when const, or when their count was given before; handles and
        # integers, when the documentation says "count handles" or "count integers".
        is_array = (kind in ("const double*", "const int32_t*", "const int64_t*")
                    or (kind == "double*" and count_given)
                    or bool(re.search(rf"\b{name}\s+count (handles|integers)", documentation)))
        result.append(Argument(kind, name, is_array))
        count_given = count_given or name in ("count", "capacity")
    return result


def functions(text, callback_types):
    """Functions of a header with its comments."""
    found = re.findall(r"(?:/\*\*((?:(?!\*/).)*)\*/\s*)?"
                       r"WFPSF_EXPORT\s+([\w\s*]+?)(wfpsf_\w+)\(([^)]*)\);", text, re.DOTALL)
    return [Function(name, c_type(result), arguments(given, documentation, callback_types))
            for documentation, result, name, given in found]


def project_numbers():
    """What CMake puts into version.h."""
    text = (ROOT / "CMakeLists.txt").read_text()
    version = re.search(r"project\(wfpsf VERSION (\d+)\.(\d+)\.(\d+)", text).groups()
    names = ("PROJECT_VERSION_MAJOR", "PROJECT_VERSION_MINOR", "PROJECT_VERSION_PATCH")
    abi = re.search(r"set\(WFPSF_ABI_NUMBER (\d+)\)", text).group(1)
    return dict(zip(names, version), WFPSF_ABI_NUMBER=abi)


def read_header(path, numbers, callback_types):
    whole = re.sub(r"@(\w+)@", lambda match: numbers[match.group(1)], path.read_text())
    text = re.sub(r"/\*.*?\*/", "", whole, flags=re.DOTALL)
    text = text.replace("\\\n", " ")
    text = re.sub(r"[ \t]+", " ", text)
    text = re.sub(r" ?$", "", text, flags=re.MULTILINE)
    header = Header(path.name.removesuffix(".in"),
                    macro_constants(text) | list_constants(text) | enum_constants(text),
                    functions(whole, callback_types))
    found = len(header.functions)
    expected = text.count("WFPSF_EXPORT")
    if found != expected:
        sys.exit(f"{path}: {found} of {expected} functions understood")
    return header


# ---------------------------------------------------------------------------------------- Fortran

FORTRAN_VALUES = {
    "wfpsf_status": "integer(c_int32_t)", "int32_t": "integer(c_int32_t)",
    "int64_t": "integer(c_int64_t)", "double": "real(c_double)"}
# A function has the name that the constant would have.
FORTRAN_RENAMED = {"WFPSF_ABI_NUMBER": "wfpsf_headers_abi_number"}


def fortran_name(constant):
    return FORTRAN_RENAMED.get(constant, constant.lower())


def check_names(headers):
    """Fortran knows no case: no two names may differ by it alone."""
    seen = set()
    for header in headers:
        for name in [*map(fortran_name, header.constants), *(f.name for f in header.functions)]:
            if name in seen:
                sys.exit(f"{header.name}: {name}: the name is taken")
            seen.add(name)


def wrapped(head, items, tail, continuation=" &", indent="    "):
    """head, items, tail as statements of at most WIDTH columns."""
    lines = [head]
    for i, item in enumerate(items):
        piece = item + (", " if i + 1 < len(items) else tail)
        if len(lines[-1]) + len(piece.rstrip()) + len(continuation) > WIDTH:
            lines[-1] = lines[-1].rstrip() + continuation
            lines.append(" " * (len(head) - len(head.lstrip())) + indent + piece)
        else:
            lines[-1] += piece
    if not items:
        lines[-1] += tail
    return lines


def fortran_argument(argument):
    kind, name = argument.type, argument.name
    if kind in FORTRAN_VALUES:
        return f"{FORTRAN_VALUES[kind]}, value :: {name}"
    if kind in ("const char*", "char*"):
        intent = "in" if kind.startswith("const") else "inout"
        return f"character(kind=c_char), intent({intent}), optional :: {name}(*)"
    if kind == "const char**":
        return f"type(c_ptr), intent(inout), optional :: {name}"
    if kind == CALLBACK:
        return f"type(c_funptr), value :: {name}"
    if kind.endswith("*const*"):
        return f"type(c_ptr), intent(in), optional :: {name}(*)"
    if re.fullmatch(r"wfpsf_\w+\*\*", kind):
        return (f"type(c_ptr), intent(inout) :: {name}(*)" if argument.is_array
                else f"type(c_ptr), intent(out) :: {name}")
    if re.fullmatch(r"(const )?(wfpsf_\w+|void)\*", kind):
        return f"type(c_ptr), value :: {name}"
    base = kind.removeprefix("const ").removesuffix("*")
    intent = "in" if kind.startswith("const") else "inout"
    shape = "(*)" if argument.is_array else ""
    return f"{FORTRAN_VALUES[base]}, intent({intent}), optional :: {name}{shape}"


def fortran_result(kind):
    return "type(c_ptr)" if kind == "const char*" else FORTRAN_VALUES[kind]


def fortran_interface(function):
    names = [argument.name for argument in function.arguments]
    kind = "subroutine" if function.result == "void" else "function"
    binding = f'bind(c, name="{function.name}")'
    declarations = [fortran_argument(argument) for argument in function.arguments]
    if kind == "function":
        binding += " result(outcome)"
        declarations.append(f"{fortran_result(function.result)} :: outcome")
    used = sorted(set(re.findall(r"\bc_\w+", " ".join(declarations))))
    lines = wrapped(f"        {kind} {function.name}(", names, ")")
    if len(lines[-1]) + len(binding) < WIDTH:
        lines[-1] += " " + binding
    else:
        lines[-1] += " &"
        lines.append(f"            {binding}")
    lines += [f"            import :: {', '.join(used)}", "            implicit none"]
    lines += [f"            {declaration}" for declaration in declarations]
    lines += [f"        end {kind} {function.name}", ""]
    return lines


def fortran(headers):
    check_names(headers)
    lines = """\
! SPDX-License-Identifier: GPL-3.0-or-later
! Made by bindings/generate.py from the headers in capi/include/wfpsf: change those.
!
! The C interface as it stands, described in the C headers. The module wfpsf is the comfortable way.

! Every constant.
module wfpsf_constants
    use, intrinsic :: iso_c_binding, only: c_int32_t
    implicit none
    private :: c_int32_t
""".splitlines()
    for header in headers:
        if header.constants:
            lines += ["", f"    ! {header.name}"]
        for name, value in header.constants.items():
            lines.append(f"    integer(c_int32_t), parameter :: {fortran_name(name)} = {value}")
    lines += """\

end module wfpsf_constants

! Every function. Positions count from (0, 0) here. Handles are values of type(c_ptr), text ends
! with c_null_char. An optional argument that is absent is a NULL. Outputs are intent(inout) because
! an error leaves them alone.
module wfpsf_c
    use, intrinsic :: iso_c_binding, only: c_char, c_double, c_funptr, c_int32_t, c_int64_t, c_ptr
    use wfpsf_constants
    implicit none
    private :: c_char, c_double, c_funptr, c_int32_t, c_int64_t, c_ptr

    interface""".splitlines()
    for header in headers:
        if header.functions:
            lines.append(f"        ! {header.name}")
        for function in header.functions:
            lines += fortran_interface(function)
    lines.pop()
    lines += ["    end interface", "", "end module wfpsf_c"]
    return lines


# ------------------------------------------------------------------------------------------ Julia

JULIA_TYPES = {
    "wfpsf_status": "Int32", "int32_t": "Int32", "int64_t": "Int64", "double": "Float64",
    "void": "Cvoid", "const char*": "Cstring", "const char**": "Ptr{Cstring}",
    "char*": "Ptr{UInt8}", "void*": "Ptr{Cvoid}", CALLBACK: "Ptr{Cvoid}"}
JULIA_RENAMED = {"in": "input"}


def julia_type(kind):
    if kind in JULIA_TYPES:
        return JULIA_TYPES[kind]
    if kind.endswith("*const*") or re.fullmatch(r"wfpsf_\w+\*\*", kind):
        return "Ptr{Ptr{Cvoid}}"
    if re.fullmatch(r"(const )?wfpsf_\w+\*", kind):
        return "Ptr{Cvoid}"
    return f"Ptr{{{JULIA_TYPES[kind.removeprefix('const ').removesuffix('*')]}}}"


def julia_function(function):
    names = [JULIA_RENAMED.get(argument.name, argument.name) for argument in function.arguments]
    types = [julia_type(argument.type) for argument in function.arguments]
    if len(types) == 1:
        types = [types[0] + ","]
    call = f"    return ccall({function.name}_pointer[], {julia_type(function.result)}, ("
    lines = [f"const {function.name}_pointer = Ref(C_NULL)"]
    lines += wrapped(f"function {function.name}(", names, ")", continuation="")
    lines += wrapped(call, types, ")," if names else "))", continuation="")
    if names:
        lines += wrapped("        ", names, ")", continuation="", indent="")
    lines += ["end", ""]
    return lines


def julia(headers):
    lines = """\
# SPDX-License-Identifier: GPL-3.0-or-later
# Made by bindings/generate.py from the headers in capi/include/wfpsf: change those.

\"\"\"
The C interface as it stands: every function and constant, described in the C headers. Positions
count from (0, 0) here, handles are `Ptr{Cvoid}`. [`load`](@ref) comes first.
\"\"\"
module LibWfpsf

using Libdl
""".splitlines()
    for header in headers:
        lines += ["", f"# {header.name}"]
        for name, value in header.constants.items():
            lines.append(f"const {name} = Int32({value})")
        if header.constants:
            lines.append("")
        for function in header.functions:
            lines += julia_function(function)
        lines.pop()
    lines += ["", "const pointers = ["]
    for header in headers:
        for function in header.functions:
            lines.append(f"    :{function.name} => {function.name}_pointer,")
    lines += """\
]

\"\"\"
    load(path)

Opens the shared library and finds its functions. Call it when the program starts, as `__init__`
does: pointers do not outlive a process.
\"\"\"
function load(path::AbstractString)
    # Without Julia's default RTLD_DEEPBIND: it would give the library another unwinder than the one
    # that libstdc++ has in this process, and the first C++ exception would abort.
    library = Libdl.dlopen(path, Libdl.RTLD_LAZY | Libdl.RTLD_LOCAL)
    for (name, pointer) in pointers
        pointer[] = Libdl.dlsym(library, name)
    end
    return nothing
end

end""".splitlines()
    return lines


# ----------------------------------------------------------------------------------------- Python

PYTHON_VALUES = {
    "wfpsf_status": "c_int32", "int32_t": "c_int32", "int64_t": "c_int64", "double": "c_double",
    "void": "None", "const char*": "c_char_p", "char*": "c_char_p",
    "const char**": "POINTER(c_char_p)"}


def python_type(argument):
    """Arrays of numbers and functions are addresses; all else is typed, so that ctypes checks it."""
    kind = argument.type
    if kind in PYTHON_VALUES:
        return PYTHON_VALUES[kind]
    base = kind.removeprefix("const ").removesuffix("*")
    if re.fullmatch(r"wfpsf_\w+", base) and base not in PYTHON_VALUES:
        return base + "_p"
    handles = re.fullmatch(r"(wfpsf_\w+)\*(const)?", base)
    if handles:
        return f"POINTER({handles.group(1)}_p)"
    if base in PYTHON_VALUES and base != "void" and not argument.is_array:
        return f"POINTER({PYTHON_VALUES[base]})"
    return "c_void_p"


def python(headers, callback_types):
    lines = """\
# SPDX-License-Identifier: GPL-3.0-or-later
# Made by bindings/generate.py from the headers in capi/include/wfpsf: change those.
\"\"\"The C interface as it stands: every constant and function, described in the C headers.

Arrays of numbers and functions are addresses (``c_void_p``), text is bytes.
\"\"\"
import ctypes
from ctypes import CFUNCTYPE, POINTER, c_char_p, c_double, c_int32, c_int64, c_void_p


def _handle(name):
    \"\"\"The type of pointers to an opaque struct.\"\"\"
    return POINTER(type(name, (ctypes.Structure,), {}))

""".splitlines()
    numbers = project_numbers()
    version = ".".join(numbers[f"PROJECT_VERSION_{part}"] for part in ("MAJOR", "MINOR", "PATCH"))
    lines += ["", f'VERSION = "{version}"  # of the headers']
    for header in headers:
        if header.constants:
            lines += ["", f"# {header.name}"]
        for name, value in header.constants.items():
            lines.append(f"{name} = {value}")
    lines.append("")
    types = [python_type(argument) for header in headers for function in header.functions
             for argument in function.arguments]
    for name in dict.fromkeys(re.findall(r"\bwfpsf_\w+_p\b", " ".join(types))):
        lines.append(f'{name} = _handle("{name.removesuffix("_p")}")')
    lines.append("")
    for name, (result, kinds) in callback_types.items():
        types = [result] + kinds
        lines.append(f"{name} = CFUNCTYPE("
                     + ", ".join(python_type(Argument(kind, "", False)) for kind in types) + ")")
    lines += ["", "# name: (type of the result, types of the arguments)", "FUNCTIONS = {"]
    for header in headers:
        for function in header.functions:
            types = [python_type(argument) for argument in function.arguments]
            head = f'    "{function.name}": ({PYTHON_VALUES[function.result]}, ['
            lines += wrapped(head, types, "]),", continuation="")
    lines += """\
}


def load(path):
    \"\"\"The library with all of its functions declared.\"\"\"
    library = ctypes.CDLL(path)
    for name, (result, arguments) in FUNCTIONS.items():
        function = getattr(library, name)
        function.restype = result
        function.argtypes = arguments
    return library""".splitlines()
    return lines


# ------------------------------------------------------------------------------------------------

def main():
    if len(sys.argv) > 2 or sys.argv[1:] and sys.argv[1].startswith("-"):
        sys.exit(__doc__)
    output = Path(sys.argv[1]) if len(sys.argv) > 1 else HERE
    numbers = project_numbers()
    there = {path.name for path in HEADERS.iterdir()} - WITHOUT_NAMES
    if there != set(ORDER):
        sys.exit(f"{HEADERS}: headers unknown or missing: {there ^ set(ORDER)}")
    paths = [HEADERS / name for name in ORDER]
    callback_types = callbacks(paths)
    headers = [read_header(path, numbers, callback_types) for path in paths]
    for path, lines in ((output / "fortran/src/wfpsf_c.f90", fortran(headers)),
                        (output / "julia/src/LibWfpsf.jl", julia(headers)),
                        (output / "python/wfpsf/_lib.py", python(headers, callback_types))):
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text("\n".join(lines) + "\n")


if __name__ == "__main__":
    main()
