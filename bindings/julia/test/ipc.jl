# SPDX-License-Identifier: GPL-3.0-or-later

# Kannawadi et al. (2016), Eqs. 7-9: x is the first index.
@test taps(IPCKernel(0.02, 0.002, 0.001)) ≈
      [0.002 0.021 0.002; 0.019 0.912 0.019; 0.002 0.021 0.002]
@test sum(taps(wfc3_kernel())) ≈ 1
@test size(IPCKernel(Instrument())) == (3, 3)

@testset "asymmetric kernel" begin
    numbers = [1 2 3 4 5; 6 70 8 9 10; 11 12 13 14 15] / 183
    kernel = IPCKernel(numbers; kernel_normalise = true)
    @test taps(kernel) ≈ numbers
    @test taps(flipped(kernel)) ≈ reverse(reverse(numbers; dims = 1); dims = 2)
    point = zeros(11, 12)
    point[5, 6] = 1
    expected = zeros(11, 12)
    expected[4:6, 4:8] = numbers
    @test apply_ipc(kernel, Image(point)).pixels ≈ expected
    @test size(apply_ipc(kernel, Image(point); edge = :valid)) == (9, 8)
end

@testset "record and edges" begin
    kernel = IPCKernel(0.02, 0.002)
    image = Image(ones(12, 12); oversampling = 2)
    result = apply_ipc(kernel, image)
    @test record(result) == (oversampling = 2, pixel_scale_arcsec = 0, applied = [:ipc])
    @test result.pixels[6, 6] ≈ 1
    @test result.pixels[1, 6] ≈ 1 - 0.02 - 2 * 0.002
    @test all(apply_ipc(kernel, image; edge = :wrap).pixels .≈ 1)
    @test apply_ipc(kernel, image; edge = :fill, ipc_fill = -7).pixels[2, 6] == -7
    @test size(apply_ipc(kernel, image; edge = :valid)) == (8, 8)
    @test_throws ArgumentError apply_ipc(kernel, image; edge = :mirror)
    @test status_of(() -> apply_ipc(kernel, result)) == LibWfpsf.WFPSF_ERROR_ALREADY_APPLIED
    @test apply_ipc(kernel, result; force = true) isa Image

    holed = ones(12, 12)
    holed[6, 7] = NaN
    count = Ref{Int64}(-1)
    apply_ipc(kernel, Image(holed); not_finite = count)
    @test count[] == 9
    apply_ipc!(result, kernel, image; not_finite = count)
    @test count[] == 0

    corrected = apply_ipc(correction(kernel), result)
    @test record(corrected).applied == [:ipc, :ipc_correction]
end

@test status_of(() -> IPCKernel(0.5)) == LibWfpsf.WFPSF_ERROR_KERNEL
@test IPCKernel(0.5; kernel_negative = true) isa IPCKernel

@testset "algebra and correction" begin
    kernel = IPCKernel(0.02, 0.002, 0.001)
    @test properties(kernel).margin ≈ 1 - 8 * 0.02
    @test properties(kernel).variance_ratio ≈ taps(autocorrelation(kernel))[3, 3]
    @test transform(kernel, 0.5, 0.5) ≈ 1 - 8 * 0.02
    @test transform(compose(kernel, correction(kernel, 2)), 0.5, 0.5) ≈ 1 - 0.16^3
    @test self_test(kernel) ≈ taps(kernel)
    @test size(wfc3_deviations()) == (3, 3)
    image = Image(rand(15, 12))
    seen = apply_ipc(kernel, image; edge = :replicate)
    result = correct_ipc!(seen, kernel, seen; edge = :replicate, threads = 2)
    @test seen.pixels ≈ image.pixels
    @test result.residual < 1e-14 && result.not_finite == 0
    @test covariance(kernel, Image(ones(9, 9))).pixels[5, 5] ≈ properties(kernel).variance_ratio
    @test status_of(() -> correct_ipc!(image, IPCKernel(0.12499), image)) ==
          LibWfpsf.WFPSF_ERROR_KERNEL_SINGULAR
    path = joinpath(mktempdir(), "kernel.fits")
    write_fits(path, Image(taps(wfc3_kernel())))
    @test taps(read_kernel(path)) == taps(wfc3_kernel())
end
