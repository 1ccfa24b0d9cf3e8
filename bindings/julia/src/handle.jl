# SPDX-License-Identifier: GPL-3.0-or-later
# What all owners of a C handle share. A handle is passed to `LibWfpsf` as it is: `ccall` takes the
# pointer out and keeps the object alive during the call.

abstract type Handle end

function Base.unsafe_convert(::Type{Ptr{Cvoid}}, handle::Handle)
    pointer = getfield(handle, :pointer)
    pointer == C_NULL && throw(ArgumentError("the $(nameof(typeof(handle))) has been closed"))
    return pointer
end

# Also the finalizer, which must not lock, print, throw or yield; the library's destroy functions do
# not.
function Base.close(handle::Handle)
    pointer = getfield(handle, :pointer)
    setfield!(handle, :pointer, C_NULL)
    destroy(handle, pointer)
    return nothing
end

Base.isopen(handle::Handle) = getfield(handle, :pointer) != C_NULL

# For the use under `GC.@preserve handles`.
handle_pointers(handles) = Ptr{Cvoid}[Base.unsafe_convert(Ptr{Cvoid}, handle) for handle in handles]

# The pointer that `call` stores into its argument.
function created(call)
    out = Ref(C_NULL)
    check(call(out))
    return out[]
end

# The text that `call(capacity, buffer, length)` stores.
function text_from(call)
    length = Ref{Int64}()
    check(call(0, C_NULL, length))
    buffer = Vector{UInt8}(undef, length[] + 1)
    check(call(length[] + 1, buffer, C_NULL))
    return String(resize!(buffer, length[]))
end

function (::Type{H})(action::Function, arguments...; keywords...) where {H<:Handle}
    handle = H(arguments...; keywords...)
    try
        return action(handle)
    finally
        close(handle)
    end
end

Base.show(io::IO, handle::Handle) =
    print(io, nameof(typeof(handle)), isopen(handle) ? "(...)" : "(closed)")

or_null(::Nothing) = C_NULL
or_null(something) = something
