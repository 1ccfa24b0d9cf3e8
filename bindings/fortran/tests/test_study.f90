! SPDX-License-Identifier: GPL-3.0-or-later
! The study: tables read from row and column 1 on, and what is refused.
program test_study
    use, intrinsic :: iso_fortran_env, only: int64, real64
    use expectations, only: expect
    use wfpsf
    implicit none
    type(wfpsf_instrument) :: instrument
    type(wfpsf_options) :: options
    type(wfpsf_study) :: study
    character(len=200) :: line
    real(real64) :: value
    integer(int64) :: rows, columns
    integer :: stat

    call instrument%create("wfirst-afta-c5")
    call options%create()
    call options%set(wfpsf_option_eps, 1e-4_real64)
    call study%create(instrument, 7, options)

    call study%size(wfpsf_study_bands, rows, columns)
    call expect(rows == 6 .and. columns == 7, "a row for every band")
    call expect(study%column(wfpsf_study_bands, 4_int64) == "effective_nm", "names of columns")
    call expect(study%column(wfpsf_study_bands, 8_int64) == "", "no name past the last column")
    call expect(study%text(wfpsf_study_bands, 3_int64, 1_int64) == "J129", "names of bands")
    call study%value(wfpsf_study_bands, 3_int64, 4_int64, value)
    call expect(abs(value - 1292.11_real64) < 5e-3_real64, "the paper's wavelength")

    call study%value(wfpsf_study_bands, 7_int64, 1_int64, value, stat, line)
    call expect(stat == wfpsf_error_range, "a row past the last one")
    call study%size(99, stat=stat)
    call expect(stat == wfpsf_error_unknown_name, "no such table")
    call study%write_csv("no/such/folder", stat)
    call expect(stat == wfpsf_error_file_write, "no such folder")
    call study%create(instrument, 19, stat=stat)
    call expect(stat == wfpsf_error_range .and. study%is_empty(), "no such detector")
end program test_study
