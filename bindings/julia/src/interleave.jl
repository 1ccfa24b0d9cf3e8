# SPDX-License-Identifier: GPL-3.0-or-later

const DITHERS = constants_of("WFPSF_DITHER_")

function check_offsets(images, dx, dy)
    size(images) == size(dx) == size(dy) || throw(DimensionMismatch(
        "images, dx and dy of sizes $(size(images)), $(size(dx)), $(size(dy)): must be one size"))
end

"""
    interleave!(out, images, dx, dy; convention = :detector)
    interleave(images, dx, dy; convention = :detector)

Interleaves a matrix of `n_x × n_y` dithered images into one that is sampled `n_x`, `n_y` times
finer, with the same pixel response (Kannawadi et al. 2016, Eqs. 26-29). Values are kept, so the
flux grows `n_x n_y` times.

`dx`, `dy` are matrices of the offset of each image in native pixels. `convention`: `:detector`, the
detector moved by (dx, dy), 0 <= dx < 1; `:object`, the object did, -1/2 < dx < 1/2.
"""
function interleave!(out::Image, images::AbstractMatrix{<:Image}, dx::AbstractMatrix,
                     dy::AbstractMatrix; convention::Symbol = :detector)
    check_offsets(images, dx, dy)
    GC.@preserve images check(LibWfpsf.wfpsf_image_interleave(
        size(images, 1), size(images, 2), handle_pointers(images), collect(Float64, dx),
        collect(Float64, dy), choose(DITHERS, :convention, convention), out))
    return out
end

function interleave(images::AbstractMatrix{<:Image}, dx::AbstractMatrix, dy::AbstractMatrix;
                    keywords...)
    isempty(images) && throw(ArgumentError("images is empty: must hold at least one"))
    out = Image(eltype(first(images)), (size(images) .* size(first(images)))...)
    return interleave!(out, images, dx, dy; keywords...)
end

"""
    deinterleave!(images, image, dx, dy; convention = :detector)
    deinterleave(image, dx, dy; convention = :detector)

The inverse of [`interleave`](@ref).
"""
function deinterleave!(images::AbstractMatrix{<:Image}, image::Image, dx::AbstractMatrix,
                       dy::AbstractMatrix; convention::Symbol = :detector)
    check_offsets(images, dx, dy)
    GC.@preserve images check(LibWfpsf.wfpsf_image_deinterleave(
        image, size(images, 1), size(images, 2), collect(Float64, dx), collect(Float64, dy),
        choose(DITHERS, :convention, convention), handle_pointers(images)))
    return images
end

function deinterleave(image::Image, dx::AbstractMatrix, dy::AbstractMatrix; keywords...)
    isempty(dx) && throw(ArgumentError("dx is empty: must hold at least one offset"))
    nx, ny = size(image) .÷ size(dx)
    images = [Image(eltype(image), nx, ny) for _ in CartesianIndices(dx)]
    return deinterleave!(images, image, dx, dy; keywords...)
end
