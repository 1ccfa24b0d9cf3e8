# SPDX-License-Identifier: GPL-3.0-or-later

const PixelType = Union{Float32,Float64}
const EFFECTS = constants_of("WFPSF_EFFECT_")

pixel_type_code(::Type{Float32}) = LibWfpsf.WFPSF_FLOAT32
pixel_type_code(::Type{Float64}) = LibWfpsf.WFPSF_FLOAT64

"""
    Image(pixels; oversampling = 1, pixel_scale_arcsec = 0, applied = ())
    Image(T, nx, ny; ...)
    Image(f, ...)

A view of a strided matrix of `Float32` or `Float64`, which is not copied: what the library writes
appears in `image.pixels`, the matrix itself. The second form makes zeros of type `T`.

Size `(nx, ny)`: `pixels[x, y]`, x along the first axis; the centre of the first pixel is (1, 1),
that of the image ((nx+1)/2, (ny+1)/2). `oversampling` is the number of samples per native detector
pixel along each axis; "pixels of the image" are its samples. `applied` lists the effects that the
image has been through (`:pixel_response`, `:ipc`, `:ipc_correction`, `:read_noise`, ...), so that none is applied
twice.
"""
mutable struct Image{T<:PixelType,A<:StridedMatrix{T}} <: Handle
    pointer::Ptr{Cvoid}
    pixels::A

    function Image(pixels::StridedMatrix{T}; oversampling::Integer = 1,
                   pixel_scale_arcsec::Real = 0, applied = ()) where {T<:PixelType}
        nx, ny = size(pixels)
        pointer_to_image = GC.@preserve pixels created() do out
            LibWfpsf.wfpsf_image_wrap(pixel_type_code(T), pointer(pixels), nx, ny,
                                      stride(pixels, 1), stride(pixels, 2), oversampling, out)
        end
        image = finalizer(close, new{T,typeof(pixels)}(pointer_to_image, pixels))
        return set_record!(image; oversampling = oversampling,
                           pixel_scale_arcsec = pixel_scale_arcsec, applied = applied)
    end
end

Image(::Type{T}, nx::Integer, ny::Integer; keywords...) where {T<:PixelType} =
    Image(zeros(T, nx, ny); keywords...)

destroy(::Image, pointer) = LibWfpsf.wfpsf_image_destroy(pointer)

Base.size(image::Image) = size(image.pixels)
Base.eltype(::Type{<:Image{T}}) where {T} = T
Base.show(io::IO, image::Image{T}) where {T} = print(io, join(size(image), "×"), " Image of ", T,
                                                     isopen(image) ? "" : " (closed)")

"""
    record(image)

`(oversampling, pixel_scale_arcsec, applied)`: samples per native pixel, scale of a native pixel (0:
not stated), and the effects applied.
"""
function record(image::Image)
    oversampling, scale, applied = Ref{Int64}(), Ref{Float64}(), Ref{Int32}()
    check(LibWfpsf.wfpsf_image_record(image, oversampling, scale, applied))
    effects = [name for (name, bit) in pairs(EFFECTS) if applied[] & bit != 0]
    return (oversampling = oversampling[], pixel_scale_arcsec = scale[], applied = effects)
end

"""
    set_record!(image; oversampling, pixel_scale_arcsec, applied)

States the record of an image whose pixels come from elsewhere; what is not given stays.
"""
function set_record!(image::Image; oversampling::Integer = record(image).oversampling,
                     pixel_scale_arcsec::Real = record(image).pixel_scale_arcsec,
                     applied = record(image).applied)
    bits = mapreduce(name -> choose(EFFECTS, :applied, name), |, applied; init = Int32(0))
    check(LibWfpsf.wfpsf_image_set_record(image, oversampling, pixel_scale_arcsec, bits))
    return image
end

"""
    copyto!(to::Image, from::Image)

Copies pixels, converting their type, and the record. The images have one size and share no memory.
"""
function Base.copyto!(to::Image, from::Image)
    check(LibWfpsf.wfpsf_image_copy(from, to))
    return to
end

Base.copy(image::Image) = copyto!(Image(eltype(image), size(image)...), image)

"""
    read_fits(path; hdu = nothing, pixel_type = nothing)

Reads a two-dimensional FITS image, plain or gzipped, with the record that this library wrote.
`hdu` is the name of an extension or its number, the primary HDU being 1; `nothing` takes the first
image found. `pixel_type` is `Float32` or `Float64`; `nothing` chooses by the file's BITPIX.
"""
function read_fits(path::AbstractString; hdu::Union{Nothing,Integer,AbstractString} = nothing,
                   pixel_type::Union{Nothing,Type{Float32},Type{Float64}} = nothing)
    name = hdu === nothing ? C_NULL : hdu isa Integer ? string(hdu - 1) : hdu
    asked = pixel_type === nothing ? 0 : pixel_type_code(pixel_type)
    source = created(out -> LibWfpsf.wfpsf_image_read_fits(path, name, asked, out))
    try
        code, nx, ny = Ref{Int32}(), Ref{Int64}(), Ref{Int64}()
        check(LibWfpsf.wfpsf_image_shape(source, code, nx, ny))
        image = Image(code[] == LibWfpsf.WFPSF_FLOAT32 ? Float32 : Float64, nx[], ny[])
        check(LibWfpsf.wfpsf_image_copy(source, image))
        return image
    finally
        LibWfpsf.wfpsf_image_destroy(source)
    end
end

"""
    write_fits(path, image; fits_overwrite = false)

Writes an image and its record as the primary HDU of a FITS file, gzipped if the path ends in
`.gz`. The file appears whole or not at all.
"""
function write_fits(path::AbstractString, image::Image; keywords...)
    with_options((:fits_overwrite,), keywords) do options
        check(LibWfpsf.wfpsf_image_write_fits(image, path, options))
    end
end
