# SPDX-License-Identifier: GPL-3.0-or-later

instrument = Instrument("wfirst-afta-c5")
@test bands(instrument) == ["Z087", "Y106", "J129", "W149", "H158", "F184"]
@test "diameter" in constants(instrument)
@test constant(instrument, "pixel_scale").value ≈ 0.11
@test startswith(constant(instrument, "pixel_scale").unit, "arcsec")
@test status_of(() -> constant(instrument, "colour")) == LibWfpsf.WFPSF_ERROR_UNKNOWN_NAME

# Kannawadi et al. (2016), Table 1
@test band(instrument, "J129"; rule = :paper).effective_nm ≈ 1292 atol = 0.5
@test_throws ArgumentError band(instrument, "J129"; rule = :best)

limits = band(instrument, "J129")
@test limits.blue_nm < limits.effective_nm < limits.red_nm
values = throughput(instrument, "J129", range(1000, 1600; length = 7))
@test values[1] == values[end] == 0
@test throughput(instrument, "J129", 1300) == values[4] > 0.1

@test length(zernikes(instrument, 7)) == constant(instrument, "zernike_jmax").value
@test zernikes(instrument, 1) != zernikes(instrument, 18)
@test status_of(() -> zernikes(instrument, 19)) == LibWfpsf.WFPSF_ERROR_RANGE
