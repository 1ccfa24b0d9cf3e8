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

```jldoctest
julia> kernel = IPCKernel(0.02, 0.002);

julia> taps(kernel)[1:2, 2]
[0.02, 0.912]

julia> round(properties(kernel).margin, digits = 12)
0.84
```
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
    read_kernel(path; hdu = nothing, kernel_negative = false, kernel_normalise = false)

A kernel from a FITS image of its taps; the middle pixel is K(0, 0).
"""
function read_kernel(path::AbstractString; hdu = nothing, keywords...)
    with_options((:kernel_negative, :kernel_normalise), keywords) do options
        name = hdu === nothing ? C_NULL : string(hdu)
        IPCKernel(created(out -> LibWfpsf.wfpsf_ipc_kernel_read_fits(path, name, options, out)))
    end
end

"""
    compose(first, second)

One kernel that does what `first` does and then `second`, image borders aside.
"""
compose(first::IPCKernel, second::IPCKernel) =
    IPCKernel(created(out -> LibWfpsf.wfpsf_ipc_kernel_create_composed(first, second, out)))

"""
    correction(kernel, order)

The correction of an order: it undoes the kernel to `order + 1` in the coupling.
"""
correction(kernel::IPCKernel, order::Integer) =
    IPCKernel(created(out -> LibWfpsf.wfpsf_ipc_kernel_create_neumann(kernel, order, out)))

"""
    autocorrelation(kernel)

The covariance, by lag, of white noise of variance 1 after the kernel.
"""
autocorrelation(kernel::IPCKernel) =
    IPCKernel(created(out -> LibWfpsf.wfpsf_ipc_kernel_create_autocorrelation(kernel, out)))

"""
    wfc3_deviations()

Standard deviations of the taps of [`wfc3_kernel`](@ref).
"""
function wfc3_deviations()
    numbers = Matrix{Float64}(undef, 3, 3)
    check(LibWfpsf.wfpsf_ipc_wfc3_deviations(length(numbers), numbers))
    return numbers
end

const KERNEL_PROPERTIES = constants_of("WFPSF_KERNEL_")

"""
    properties(kernel)

What is known of a kernel: sum, centroid, second moments, its asymmetries, the stability margin
`min |K^|` with its frequency, what it does to noise and to the gain and efficiency measured without
regard to it. The C header ipc.h has the list.
"""
function properties(kernel::IPCKernel)
    value = Ref{Float64}()
    return map(KERNEL_PROPERTIES) do key
        check(LibWfpsf.wfpsf_ipc_kernel_get(kernel, key, value))
        value[]
    end
end

"""
    transform(kernel, frequency_x, frequency_y)

The sum over d of K(d) exp(-2πi f·d), f in cycles per pixel.
"""
function transform(kernel::IPCKernel, frequency_x::Real, frequency_y::Real)
    re, im = Ref{Float64}(), Ref{Float64}()
    check(LibWfpsf.wfpsf_ipc_kernel_transform(kernel, frequency_x, frequency_y, re, im))
    return complex(re[], im[])
end

"""
    self_test(kernel; ipc_form = 0)

What [`apply_ipc`](@ref) makes of one unit of charge: look at it before you believe a kernel.
"""
function self_test(kernel::IPCKernel; keywords...)
    response = Matrix{Float64}(undef, size(kernel))
    with_options((:ipc_form,), keywords) do options
        check(LibWfpsf.wfpsf_ipc_kernel_self_test(kernel, options, length(response), response))
    end
    return response
end

"""
    apply_ipc!(out, kernel, image; edge = :zero, options...)
    apply_ipc(kernel, image; edge = :zero, options...)

Applies a kernel whose taps stand one native pixel apart: N samples of an image with oversampling N.
`out` has the input's type and size; it is the input, or shares no memory with it. Its record becomes
the input's with IPC, or its correction, added. An image that has been through it is refused.

`edge` says what lies beyond the border: `:zero`, `:replicate` (the nearest pixel), `:wrap` (the
other side), or what becomes of pixels within the kernel's reach of it: `:crop` (they keep their
value), `:fill` (they get `ipc_fill`), `:valid` (they are left out, and `out` is smaller by N times
`size(kernel) .÷ 2` on each side). Options: `ipc_form` (0: scatter, a convolution; 1: gather, a
correlation), `ipc_fill`, `force` (apply it again), `threads`.

`not_finite`, if it is a `Ref{Int64}`, gets the count of pixels of `out` that are NaN or infinite.
"""
function apply_ipc!(out::Image, kernel::IPCKernel, image::Image; edge::Symbol = :zero,
                    not_finite = nothing, keywords...)
    with_options((:ipc_form, :ipc_fill, :force, :threads), keywords) do options
        check(LibWfpsf.wfpsf_ipc_apply(kernel, image, choose(EDGES, :edge, edge), options, out,
                                       or_null(not_finite)))
    end
    return out
end

function apply_ipc(kernel::IPCKernel, image::Image; edge::Symbol = :zero, keywords...)
    border = edge === :valid ? record(image).oversampling .* (size(kernel) .÷ 2) : (0, 0)
    out = Image(eltype(image), max.(size(image) .- 2 .* border, 0)...)
    return apply_ipc!(out, kernel, image; edge = edge, keywords...)
end

const CORRECT_OPTIONS =
    (:ipc_form, :ipc_least_margin, :ipc_tolerance, :ipc_max_passes, :force, :threads)

"""
    correct_ipc!(out, kernel, image; edge = :zero, options...)

Undoes IPC exactly: `out` is the image that [`apply_ipc`](@ref) turns into `image`; it may be `image`
itself. `edge` is `:zero`, `:replicate` or `:wrap`. Returns `(residual, noise_amplification, passes,
not_finite)`. Options: `ipc_form`, `ipc_least_margin`, `ipc_tolerance`, `ipc_max_passes`, `force`,
`threads`.
"""
function correct_ipc!(out::Image, kernel::IPCKernel, image::Image; edge::Symbol = :zero,
                      keywords...)
    residual, noise = Ref{Float64}(), Ref{Float64}()
    passes, not_finite = Ref{Int64}(), Ref{Int64}()
    with_options(CORRECT_OPTIONS, keywords) do options
        check(LibWfpsf.wfpsf_ipc_correct(kernel, image, choose(EDGES, :edge, edge), options, out,
                                         residual, noise, passes, not_finite))
    end
    return (residual = residual[], noise_amplification = noise[], passes = passes[],
            not_finite = not_finite[])
end

"""
    covariance(kernel, variance, lag_x = 0, lag_y = 0; edge = :zero, options...)

The covariance of pixels `(lag_x, lag_y)` apart after the kernel, from the image of the variances of
independent pixels before it; 0 where there is no such pixel. `kernel` may be a [`VaryingIPC`](@ref).
`edge` is `:zero` or `:wrap`. Options: `ipc_form`, `threads`.
"""
function covariance(kernel::IPCKernel, variance::Image, lag_x::Integer = 0, lag_y::Integer = 0;
                    edge::Symbol = :zero, keywords...)
    out = Image(eltype(variance), size(variance)...)
    with_options((:ipc_form, :threads), keywords) do options
        check(LibWfpsf.wfpsf_ipc_covariance(kernel, variance, lag_x, lag_y,
                                            choose(EDGES, :edge, edge), options, out))
    end
    return out
end
