# SPDX-License-Identifier: GPL-3.0-or-later

"""
    VaryingIPC(alpha, alpha_prime = nothing, alpha_plus = nothing; kernel_negative = false)
    VaryingIPC(nx, ny, degree, alpha, alpha_prime = nothing, alpha_plus = nothing; ...)
    VaryingIPC(regions, kernels)
    VaryingIPC(f, ...)

Interpixel capacitance whose kernel varies over a detector: from images of the parameters of each
pixel's kernel; from polynomials over `nx` × `ny` pixels, coefficients of 1, X, Y, X², XY, Y², ... with
X and Y from -1 to 1 between the borders; or from an image of regions, numbered from 1, and a kernel
for each. [`apply_ipc`](@ref), [`correct_ipc!`](@ref) and [`add!`](@ref) take it in place of a kernel;
`varying[x, y]` is one pixel's kernel.

`ipc_form = 0`, scatter, spreads each charge by its own pixel's kernel and conserves it; 1, gather,
collects by the kernel of the pixel that collects.
"""
mutable struct VaryingIPC <: Handle
    pointer::Ptr{Cvoid}
    VaryingIPC(pointer::Ptr{Cvoid}) = finalizer(close, new(pointer))
end

function VaryingIPC(alpha::Image, alpha_prime = nothing, alpha_plus = nothing; keywords...)
    with_options((:kernel_negative,), keywords) do options
        VaryingIPC(created() do out
            LibWfpsf.wfpsf_varying_ipc_create_maps(alpha, or_null(alpha_prime), or_null(alpha_plus),
                                                   options, out)
        end)
    end
end

function VaryingIPC(nx::Integer, ny::Integer, degree::Integer, alpha, alpha_prime = nothing,
                    alpha_plus = nothing; keywords...)
    wanted = (degree + 1) * (degree + 2) ÷ 2
    function coefficients(given)
        given === nothing && return C_NULL
        length(given) == wanted ||
            throw(DimensionMismatch("a polynomial of degree $degree has $wanted coefficients"))
        return collect(Float64, given)
    end
    numbers = coefficients.((alpha, alpha_prime, alpha_plus))
    with_options((:kernel_negative,), keywords) do options
        VaryingIPC(created() do out
            LibWfpsf.wfpsf_varying_ipc_create_polynomials(nx, ny, degree, numbers..., options, out)
        end)
    end
end

function VaryingIPC(regions::Image, kernels::AbstractVector{IPCKernel})
    from_zero = Image(Float64.(regions.pixels) .- 1)
    GC.@preserve kernels VaryingIPC(created() do out
        LibWfpsf.wfpsf_varying_ipc_create_regions(from_zero, length(kernels),
                                                  handle_pointers(kernels), out)
    end)
end

destroy(::VaryingIPC, pointer) = LibWfpsf.wfpsf_varying_ipc_destroy(pointer)

Base.getindex(varying::VaryingIPC, x::Integer, y::Integer) =
    IPCKernel(created(out -> LibWfpsf.wfpsf_varying_ipc_kernel(varying, x - 1, y - 1, out)))

"""
    weakest(varying)

The least stability margin, `min |K^|`, of any pixel's kernel, and that pixel: `(margin, x, y)`.
"""
function weakest(varying::VaryingIPC)
    margin, x, y = Ref{Float64}(), Ref{Int64}(), Ref{Int64}()
    check(LibWfpsf.wfpsf_varying_ipc_margin(varying, margin, x, y))
    return (margin = margin[], x = x[] + 1, y = y[] + 1)
end

function apply_ipc!(out::Image, varying::VaryingIPC, image::Image; edge::Symbol = :zero,
                    not_finite = nothing, keywords...)
    with_options((:ipc_form, :ipc_fill, :force, :threads), keywords) do options
        check(LibWfpsf.wfpsf_varying_ipc_apply(varying, image, choose(EDGES, :edge, edge), options,
                                               out, or_null(not_finite)))
    end
    return out
end

apply_ipc(varying::VaryingIPC, image::Image; keywords...) =
    apply_ipc!(Image(eltype(image), size(image)...), varying, image; keywords...)

function correct_ipc!(out::Image, varying::VaryingIPC, image::Image; edge::Symbol = :zero,
                      keywords...)
    residual, noise = Ref{Float64}(), Ref{Float64}()
    passes, not_finite = Ref{Int64}(), Ref{Int64}()
    with_options(CORRECT_OPTIONS, keywords) do options
        check(LibWfpsf.wfpsf_varying_ipc_correct(varying, image, choose(EDGES, :edge, edge),
                                                 options, out, residual, noise, passes,
                                                 not_finite))
    end
    return (residual = residual[], noise_amplification = noise[], passes = passes[],
            not_finite = not_finite[])
end

function covariance(varying::VaryingIPC, variance::Image, lag_x::Integer = 0, lag_y::Integer = 0;
                    edge::Symbol = :zero, keywords...)
    out = Image(eltype(variance), size(variance)...)
    with_options((:ipc_form, :threads), keywords) do options
        check(LibWfpsf.wfpsf_varying_ipc_covariance(varying, variance, lag_x, lag_y,
                                                    choose(EDGES, :edge, edge), options, out))
    end
    return out
end

"""
    autocorrelation(varying, x, y, variance = nothing; edge = :zero, ipc_form = 0)

The covariance of pixel `(x, y)` with its neighbours after varying IPC: with the pixel `(dx, dy)` from
it at `[dx + (nx+1)÷2, dy + (ny+1)÷2]`. `variance` is the image of the variances of independent pixels
before IPC; without it they are 1.
"""
function autocorrelation(varying::VaryingIPC, x::Integer, y::Integer, variance = nothing;
                         edge::Symbol = :zero, keywords...)
    which = choose(EDGES, :edge, edge)
    given = or_null(variance)
    nx, ny = Ref{Int64}(), Ref{Int64}()
    with_options((:ipc_form,), keywords) do options
        ask(capacity, numbers) =
            check(LibWfpsf.wfpsf_varying_ipc_autocorrelation(varying, given, x - 1, y - 1, which,
                                                             options, capacity, numbers, nx, ny))
        ask(0, C_NULL)
        numbers = Matrix{Float64}(undef, nx[], ny[])
        ask(length(numbers), numbers)
        return numbers
    end
end
