# SPDX-License-Identifier: GPL-3.0-or-later

const EDGES = constants_of("WFPSF_EDGE_")

"""
    IPCKernel(alpha, alpha_prime = 0, alpha_plus = 0; kernel_negative = false)
    IPCKernel(taps; kernel_negative = false, kernel_normalise = false)
    IPCKernel(instrument)
    IPCKernel(f, ...)

A kernel of interpixel capacitance: the 3 × 3 kernels of Kannawadi et al. (2016), Eqs. 7-9; one
from a matrix of odd sizes, `taps[x, y]`, whose central element is K(0, 0); or the instrument's own
default. Taps lie in [0, 1] and sum to 1 within 1e-12, unless the options say otherwise. Immutable:
threads may share it.

Kernels are convolved: out(p) = sum over d of K(d) in(p - d), the paper's Eq. 4.
"""
mutable struct IPCKernel <: Handle
    pointer::Ptr{Cvoid}
    IPCKernel(pointer::Ptr{Cvoid}) = finalizer(close, new(pointer))
end

function IPCKernel(alpha::Real, alpha_prime::Real = 0, alpha_plus::Real = 0; keywords...)
    with_options((:kernel_negative,), keywords) do options
        IPCKernel(created() do out
            LibWfpsf.wfpsf_ipc_kernel_create(alpha, alpha_prime, alpha_plus, options, out)
        end)
    end
end

function IPCKernel(taps::AbstractMatrix{<:Real}; keywords...)
    numbers = collect(Float64, taps)
    with_options((:kernel_negative, :kernel_normalise), keywords) do options
        IPCKernel(created() do out
            LibWfpsf.wfpsf_ipc_kernel_create_taps(size(taps, 1), size(taps, 2), numbers, options,
                                                  out)
        end)
    end
end

IPCKernel(instrument::Instrument) =
    IPCKernel(created(out -> LibWfpsf.wfpsf_ipc_kernel_create_default(instrument, out)))

destroy(::IPCKernel, pointer) = LibWfpsf.wfpsf_ipc_kernel_destroy(pointer)

"""
    wfc3_kernel()

The kernel measured for WFC3/IR (Kannawadi et al. 2016, Eq. 11), divided by its printed sum.
"""
wfc3_kernel() = IPCKernel(created(LibWfpsf.wfpsf_ipc_kernel_create_wfc3))

"""
    correction(kernel)

The first-order correction (Kannawadi et al. 2016, Eq. 12): it undoes the kernel to second order in
the coupling.
"""
correction(kernel::IPCKernel) =
    IPCKernel(created(out -> LibWfpsf.wfpsf_ipc_kernel_create_correction(kernel, out)))

"""
    flipped(kernel)

K(-d): convolution with it is correlation with K.
"""
flipped(kernel::IPCKernel) =
    IPCKernel(created(out -> LibWfpsf.wfpsf_ipc_kernel_create_flipped(kernel, out)))

function Base.size(kernel::IPCKernel)
    nx, ny = Ref{Int64}(), Ref{Int64}()
    check(LibWfpsf.wfpsf_ipc_kernel_taps(kernel, 0, C_NULL, nx, ny))
    return (nx[], ny[])
end

"""
    taps(kernel)

The taps as a matrix: K(dx, dy) at `[dx + (nx+1)÷2, dy + (ny+1)÷2]`.
"""
function taps(kernel::IPCKernel)
    numbers = Matrix{Float64}(undef, size(kernel))
    check(LibWfpsf.wfpsf_ipc_kernel_taps(kernel, length(numbers), numbers, C_NULL, C_NULL))
    return numbers
end

"""
    apply_ipc!(out, kernel, image; edge = :zero, options...)
    apply_ipc(kernel, image; edge = :zero, options...)

Convolves an image with a kernel whose taps stand one native pixel apart: N samples of an image with
oversampling N. `out` has the input's type and size and shares no memory with it; its record becomes
the input's with IPC, or its correction, added. An image that has been through it is refused.

`edge` says what lies beyond the border: `:zero`, `:replicate` (the nearest pixel), `:wrap` (the
other side), or what becomes of pixels within the kernel's reach of it: `:crop` (they keep their
value), `:fill` (they get `ipc_fill`), `:valid` (they are left out, and `out` is smaller by N times
`size(kernel) .÷ 2` on each side). Options: `ipc_fill`, `force` (apply it again).
"""
function apply_ipc!(out::Image, kernel::IPCKernel, image::Image; edge::Symbol = :zero, keywords...)
    with_options((:ipc_fill, :force), keywords) do options
        check(LibWfpsf.wfpsf_ipc_apply(kernel, image, choose(EDGES, :edge, edge), options, out))
    end
    return out
end

function apply_ipc(kernel::IPCKernel, image::Image; edge::Symbol = :zero, keywords...)
    border = edge === :valid ? record(image).oversampling .* (size(kernel) .÷ 2) : (0, 0)
    out = Image(eltype(image), max.(size(image) .- 2 .* border, 0)...)
    return apply_ipc!(out, kernel, image; edge = edge, keywords...)
end
