# SPDX-License-Identifier: GPL-3.0-or-later

roman = Instrument("roman-c9")
chain = Chain(roman)
@test first.(steps(chain))[[1, 6, 8]] == [:clip_negative, :persistence_fermi, :ipc]
@test last(steps(chain)[4]) == [0.0065, 139.8, 1]
@test last(steps(Chain(roman; exposure_time = 10))[5])[2] == 10

one, two = Image(fill(1000.0, 30, 20)), Image(fill(1000.0, 30, 20))
previous = [Image(fill(60000.0f0, 30, 20))]
@test apply_chain!(one, chain; previous = previous, seed = 5) == (not_finite = 0, saturated = 0)
apply_chain!(two, chain; previous = previous, seed = 5, threads = 3)
@test one.pixels == two.pixels
@test :poisson_noise in record(one).applied && :ipc in record(one).applied
@test status_of(() -> apply_chain!(one, chain)) == LibWfpsf.WFPSF_ERROR_ALREADY_APPLIED

own = add!(add!(add!(Chain(), :nonlinearity, -1e-6), IPCKernel(0.02); edge = :wrap), :pixel_mask,
           Image([1.0 0.0; 0.0 2.0]), -1, 99)
image = Image(fill(1000.0, 2, 2))
apply_chain!(image, own)
@test image.pixels ≈ [-1 999; 999 99]
@test_throws ArgumentError add!(own, :magic)
@test status_of(() -> add!(own, :nonlinearity, 1)) == LibWfpsf.WFPSF_ERROR_ALREADY_APPLIED

noise = add_noise!(Image(zeros(50, 50)), 2; kernel = IPCKernel(0.02), seed = 1)
@test 1 < sqrt(sum(noise.pixels .^ 2) / 2500) < 2.5
level = sky_level(roman, "F184", 180, 90)
@test level ≈ 16.0572
@test sky_background(roman, "F184", 180, 90; exposure_time = 10, pixel_area = 0.0121) ≈
      10 * (1.1 * 0.0121 * level + 0.17)
