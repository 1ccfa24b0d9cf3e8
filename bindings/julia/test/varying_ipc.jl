# SPDX-License-Identifier: GPL-3.0-or-later

numbers = fill(0.01, 9, 7)
numbers[8, 3] = 0.05
varying = VaryingIPC(Image(numbers))
@test weakest(varying).margin ≈ 0.6
@test (weakest(varying).x, weakest(varying).y) == (8, 3)
@test taps(varying[8, 3])[1, 2] == 0.05
point = zeros(9, 7)
point[8, 3] = 1
seen = apply_ipc(varying, Image(point))
@test seen.pixels[7, 3] == 0.05 && seen.pixels[8, 3] ≈ 0.8
@test apply_ipc(varying, Image(point); ipc_form = 1).pixels[7, 3] == 0.01
result = correct_ipc!(seen, varying, seen)
@test seen.pixels ≈ point
@test result.residual < 1e-14 && result.noise_amplification > 1

count = Ref{Int64}(-1)
holed = fill(NaN32, 9, 7)
apply_ipc(varying, Image(holed); not_finite = count)
@test count[] == 63
white = Image(ones(9, 7))
for form in (0, 1)
    table = autocorrelation(varying, 8, 3; ipc_form = form)
    @test size(table) == (5, 5)
    @test table[3, 3] ≈ (form == 0 ? 0.8^2 + 4 * 0.01^2 : 0.8^2 + 4 * 0.05^2)
    @test covariance(varying, white; ipc_form = form).pixels[8, 3] ≈ table[3, 3]
    @test covariance(varying, white, -1, 0; ipc_form = form).pixels[8, 3] ≈ table[2, 3]
    @test table == autocorrelation(varying, 8, 3, white; ipc_form = form)
    @test table[5, 3] == 0 && all(covariance(varying, white, 1, 0).pixels[9, :] .== 0)
end
@test status_of(() -> autocorrelation(varying, 10, 1)) == LibWfpsf.WFPSF_ERROR_RANGE

kernels = [IPCKernel(0.01), IPCKernel(0.02)]
regions = VaryingIPC(Image([y > 4 ? 2.0 : 1.0 for x = 1:9, y = 1:7]), kernels)
@test taps(regions[1, 5]) == taps(kernels[2])
smooth = VaryingIPC(9, 7, 1, [0.02, 0.009, 0], nothing, [0.001, 0, 0])
@test taps(smooth[9, 4])[1, 2] ≈ 0.029
@test_throws DimensionMismatch VaryingIPC(9, 7, 2, [0.02])
@test status_of(() -> smooth[10, 1]) == LibWfpsf.WFPSF_ERROR_RANGE
@test status_of(() -> VaryingIPC(Image(fill(0.3, 2, 2)))) == LibWfpsf.WFPSF_ERROR_KERNEL
image = Image(rand(9, 7))
before = sum(image.pixels)
apply_chain!(image, add!(Chain(), regions; edge = :wrap))
@test sum(image.pixels) ≈ before
