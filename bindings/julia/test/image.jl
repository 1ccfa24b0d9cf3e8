# SPDX-License-Identifier: GPL-3.0-or-later

@testset "matrices" for T in (Float32, Float64)
    parent = reshape(T.(1:120), 12, 10)
    for pixels in (Matrix(parent), view(Matrix(parent), 3:9, 2:5),
                   view(Matrix(parent), 12:-2:1, 10:-3:1), view(Matrix(parent), 4:4, :),
                   view(Matrix(parent), :, 4:4), zeros(T, 0, 3))
        image = Image(pixels)
        @test size(image) == size(pixels)
        @test eltype(image) == T
        @test image.pixels === pixels
        @test copy(image).pixels == pixels
    end
    other = Image(T == Float32 ? Float64 : Float32, 12, 10)
    @test copyto!(other, Image(parent; oversampling = 3)) === other
    @test other.pixels == parent
    @test record(other).oversampling == 3
end

@testset "writing through strides" begin
    parent = zeros(20, 20)
    copyto!(Image(view(parent, 20:-2:2, 1:2:19)), Image(ones(10, 10)))
    @test all(parent[2:2:20, 1:2:19] .== 1)
    @test sum(parent) == 100
end

@test_throws MethodError Image(zeros(Int, 3, 3))
@test status_of(() -> copyto!(Image(zeros(3, 3)), Image(zeros(3, 4)))) == LibWfpsf.WFPSF_ERROR_SIZE
@test sprint(show, Image(Float32, 3, 4)) == "3×4 Image of Float32"

@testset "record" begin
    image = Image(Float64, 2, 2; oversampling = 4, pixel_scale_arcsec = 0.11, applied = (:ipc,))
    @test record(image) == (oversampling = 4, pixel_scale_arcsec = 0.11, applied = [:ipc])
    set_record!(image; applied = (:pixel_response, :ipc_correction))
    @test record(image) == (oversampling = 4, pixel_scale_arcsec = 0.11,
                            applied = [:pixel_response, :ipc_correction])
    @test_throws ArgumentError set_record!(image; applied = (:magic,))
    @test status_of(() -> set_record!(image; oversampling = 0)) == LibWfpsf.WFPSF_ERROR_RANGE
end

@testset "FITS" begin
    mktempdir() do folder
        path = joinpath(folder, "image.fits")
        image = Image(Float32[x + 10y for x = 1:5, y = 1:3]; oversampling = 2, applied = (:ipc,))
        write_fits(path, image)
        @test filesize(path) % 2880 == 0
        @test occursin("NAXIS1  =                    5", read(path, String))
        again = read_fits(path)
        @test again.pixels == image.pixels && eltype(again) == Float32
        @test record(again) == record(image)
        @test eltype(read_fits(path; pixel_type = Float64, hdu = 1)) == Float64
        @test status_of(() -> read_fits(path; hdu = 2)) < 0
        @test status_of(() -> read_fits(path; hdu = "SCI")) < 0
        @test status_of(() -> write_fits(path, image)) == LibWfpsf.WFPSF_ERROR_FILE_WRITE
        write_fits(path, image; fits_overwrite = true)
        @test status_of(() -> read_fits(joinpath(folder, "none"))) == LibWfpsf.WFPSF_ERROR_FILE_OPEN
    end
end
