# SPDX-License-Identifier: GPL-3.0-or-later
# The library's constants by lower-case name: WFPSF_EDGE_WRAP is EDGES.wrap, or :wrap to the user.

function constants_of(prefix)
    found = [name for name in names(LibWfpsf; all = true) if startswith(String(name), prefix)]
    sort!(found; by = name -> getfield(LibWfpsf, name))
    short = Tuple(Symbol(lowercase(chop(String(name); head = length(prefix), tail = 0)))
                  for name in found)
    return NamedTuple{short}(Tuple(getfield(LibWfpsf, name) for name in found))
end

function choose(table, argument, name)
    haskey(table, name) && return table[name]
    allowed = join(repr.(keys(table)), ", ")
    throw(ArgumentError("$argument = $(repr(name)): must be one of $allowed"))
end
