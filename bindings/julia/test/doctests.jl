# SPDX-License-Identifier: GPL-3.0-or-later
# The examples in the package's docstrings: what stands behind `julia>` is run, and what Julia shows
# is compared with the lines that follow.

examples(text) = [match.captures[1] for match in eachmatch(r"```jldoctest\n(.*?)```"s, text)]

function try_example(example)
    place = Module()
    Core.eval(place, :(using Wfpsf))
    for step in split(example, "julia> "; keepempty = false)
        code, shown = split(step, '\n'; limit = 2)
        value = include_string(place, code)
        endswith(code, ';') || @test sprint(show, value) == strip(shown)
    end
end

let tried = 0
    for (_, documentation) in Base.Docs.meta(Wfpsf), (_, docstring) in documentation.docs,
        example in examples(join(docstring.text))

        try_example(example)
        tried += 1
    end
    @test tried >= 8
end
