# SPDX-License-Identifier: GPL-3.0-or-later
# Keyword options. Their names are the library's in lower case; kinds, defaults and bounds are asked
# of the library.

const OPTIONS = let all_names = constants_of("WFPSF_OPTION_")
    kinds = (:real, :integer)
    options = Tuple(name for name in keys(all_names) if !(name in kinds))
    NamedTuple{options}(all_names)
end

# Positions count from 1 here, from 0 in the library.
const POSITIONS = (:moments_guess_x, :moments_guess_y)

# A function of the caller's, and the exception that it ended with, if any.
mutable struct Progress
    tell::Any
    failure::Any
end

# The library calls this one. Exceptions must not pass through C: they stop the work and are thrown
# afterwards.
function told_to_stop(part::Float64, user::Ptr{Cvoid})::Int32
    progress = unsafe_pointer_to_objref(user)::Progress
    try
        return progress.tell(part) === false
    catch failure
        progress.failure = failure
        return true
    end
end

mutable struct Options <: Handle
    pointer::Ptr{Cvoid}
    progress::Progress # the library holds its address
    Options() = finalizer(close, new(created(LibWfpsf.wfpsf_options_create),
                                     Progress(nothing, nothing)))
end

destroy(::Options, pointer) = LibWfpsf.wfpsf_options_destroy(pointer)

function describe(name)
    text, kind = Ref{Cstring}(), Ref{Int32}()
    standard, smallest, largest = Ref{Float64}(), Ref{Float64}(), Ref{Float64}()
    check(LibWfpsf.wfpsf_option_describe(OPTIONS[name], C_NULL, text, kind, standard, smallest,
                                         largest))
    shift = name in POSITIONS ? 1 : 0
    return (name = name, integer = kind[] == LibWfpsf.WFPSF_OPTION_INTEGER,
            default = isnan(standard[]) ? nothing : standard[] + shift,
            smallest = smallest[] + shift, largest = largest[] + shift,
            text = replace(unsafe_string(text[]), "first pixel at 0" => "first pixel at 1"))
end

"""
    options()

The keyword options: a vector of `(name, integer, default, smallest, largest, text)`. A default of
`nothing` stands for "chosen by the library", and `nothing` as a value leaves any option at its
default. Positions count from (1, 1).
"""
options() = [describe(name) for name in keys(OPTIONS)]

function set!(options, name, value)
    if name === :zernikes
        numbers = collect(Float64, value)
        check(LibWfpsf.wfpsf_options_set_zernikes(options, length(numbers), numbers))
    elseif name === :opd
        check(LibWfpsf.wfpsf_options_set_opd(options, value.map, value.scale_m, value.axis_x - 1,
                                             value.axis_y - 1))
    elseif name === :scene_store
        check(LibWfpsf.wfpsf_options_set_scene_store(options, value))
    elseif name === :progress
        options.progress.tell = value
        check(LibWfpsf.wfpsf_options_set_progress(
            options, @cfunction(told_to_stop, Int32, (Float64, Ptr{Cvoid})),
            pointer_from_objref(options.progress)))
    elseif describe(name).integer
        check(LibWfpsf.wfpsf_options_set_integer(options, OPTIONS[name], value))
    else
        shift = name in POSITIONS ? 1 : 0
        check(LibWfpsf.wfpsf_options_set_real(options, OPTIONS[name], value - shift))
    end
    return nothing
end

# Runs `call` with the options that a function was given, of those that it takes.
function with_options(call, taken, given)
    isempty(given) && return call(C_NULL)
    options = Options()
    try
        for (name, value) in pairs(given)
            name in taken || throw(ArgumentError(
                "no option $name here: there are $(join(taken, ", "))"))
            value === nothing || set!(options, name, value)
        end
        return call(options)
    catch
        options.progress.failure === nothing || throw(options.progress.failure)
        rethrow()
    finally
        close(options)
    end
end
