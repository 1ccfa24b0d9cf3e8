# SPDX-License-Identifier: GPL-3.0-or-later

const STUDY_TABLES = constants_of("WFPSF_STUDY_")
const STUDY_OPTIONS = (:eps, :struts, :piston_tilt, :frame, :jitter_xx, :jitter_xy, :jitter_yy,
                       :charge_diffusion, :pixel_response, :memory_limit, :zernikes, :opd,
                       :progress)

"""
    Study(instrument, sca; options...)
    Study(f, ...)

The tables of Kannawadi et al. (2016) for the PSFs of detector `sca`, made in one go: read them with
[`study_table`](@ref), or write them with [`write_csv`](@ref). Immutable: threads may share it.
"""
mutable struct Study <: Handle
    pointer::Ptr{Cvoid}

    function Study(instrument::Instrument, sca::Integer; keywords...)
        pointer = with_options(STUDY_OPTIONS, keywords) do options
            created() do out
                LibWfpsf.wfpsf_study_create(instrument, sca, options, out)
            end
        end
        return finalizer(close, new(pointer))
    end
end

destroy(::Study, pointer) = LibWfpsf.wfpsf_study_destroy(pointer)

"""
    study_table(study, name)

A table as a named tuple of columns, of numbers or of words: `study_table(study, :sizes).value`.
Names are `:bands`, `:sizes`, `:sensitivities`, `:linear_law`, `:figure_3` to `:figure_11`,
`:requirements`, `:comparison` and `:convergence`; what they hold is told in the header study.h.
"""
function study_table(study::Study, name::Symbol)
    table = choose(STUDY_TABLES, :name, name)
    rows, columns = Ref{Int64}(), Ref{Int64}()
    check(LibWfpsf.wfpsf_study_size(study, table, rows, columns))
    words(row, column) =
        convert(Ptr{UInt8}, LibWfpsf.wfpsf_study_text(study, table, row, column))
    function values(column)
        rows[] > 0 && words(0, column) != C_NULL &&
            return [unsafe_string(words(row, column)) for row in 0:(rows[] - 1)]
        return map(0:(rows[] - 1)) do row
            value = Ref{Float64}()
            check(LibWfpsf.wfpsf_study_value(study, table, row, column, value))
            value[]
        end
    end
    GC.@preserve study begin
        names = Tuple(Symbol(unsafe_string(convert(
            Ptr{UInt8}, LibWfpsf.wfpsf_study_column(study, table, column))))
                      for column in 0:(columns[] - 1))
        return NamedTuple{names}(Tuple(values(column) for column in 0:(columns[] - 1)))
    end
end

"""
    write_csv(study, folder)

Writes every table as CSV into a folder that exists, replacing files that are there.
"""
write_csv(study::Study, folder::AbstractString) =
    check(LibWfpsf.wfpsf_study_write_csv(study, folder))
