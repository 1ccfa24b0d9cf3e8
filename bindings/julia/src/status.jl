# SPDX-License-Identifier: GPL-3.0-or-later
# Status codes become exceptions and warnings.

"""
    WfpsfError(code, message)

A call of the library failed. `code` is the status, such as `LibWfpsf.WFPSF_ERROR_RANGE`; the
message names the argument, its value and the allowed range. Positions in it count from (0, 0), the
library's own convention.
"""
struct WfpsfError <: Exception
    code::Int32
    message::String
end

Base.showerror(io::IO, e::WfpsfError) =
    print(io, "WfpsfError: ", e.message, " (", status_name(e.code), ")")

"Name of a status code, such as `\"WFPSF_ERROR_RANGE\"`."
status_name(code) = unsafe_string(LibWfpsf.wfpsf_status_name(code))

function last_error()
    size = LibWfpsf.wfpsf_last_error(C_NULL, 0)
    buffer = Vector{UInt8}(undef, size + 1)
    LibWfpsf.wfpsf_last_error(buffer, length(buffer))
    return String(resize!(buffer, size))
end

# Comes straight after the call: the text belongs to the thread, and a task may change threads.
function check(status)
    status < 0 && throw(WfpsfError(status, last_error()))
    status > 0 && @warn "$(last_error()) ($(status_name(status)))"
    return nothing
end
