# SPDX-License-Identifier: GPL-3.0-or-later

ratio(sed, numerator, denominator) = /(photon_density(sed, [numerator, denominator])...)

table = SED([500, 1000, 2000], Float32[1, 3, 1])
@test ratio(table, 750, 500) ≈ 2
@test ratio(SED([500, 1000], [1, 1]; unit = :energy), 1000, 500) ≈ 2
@test ratio(power_law(-2), 2000, 1000) ≈ 1 / 4
@test ratio(power_law(-2; unit = :energy), 1000, 2000) ≈ 2
sun = black_body(5772)
@test ratio(sun, 650, 630) < 1 < ratio(sun, 634, 600)
red = redshifted(table, 1)
close(table)
@test ratio(red, 1500, 1000) ≈ 2
@test photon_density(sun, 700) == photon_density(sun, [600 700])[1, 2]
@test photon_density(sun, Float64[]) == []
@test SED(sed -> ratio(sed, 3, 1), 1:4, 1:4) ≈ 3

@test_throws ArgumentError redshifted(table, 1)
@test_throws ArgumentError power_law(0; unit = :magnitudes)
@test_throws DimensionMismatch SED([1, 2], [1])
@test status_of(() -> SED([2, 1], [1, 1])) == LibWfpsf.WFPSF_ERROR_RANGE
@test status_of(() -> SED([1], [1])) == LibWfpsf.WFPSF_ERROR_SIZE
@test status_of(() -> black_body(NaN)) == LibWfpsf.WFPSF_ERROR_RANGE
@test status_of(() -> redshifted(red, -1)) == LibWfpsf.WFPSF_ERROR_RANGE
@test status_of(() -> photon_density(red, Inf)) == LibWfpsf.WFPSF_ERROR_NOT_FINITE
