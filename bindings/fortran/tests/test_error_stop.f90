! SPDX-License-Identifier: GPL-3.0-or-later
! Must end in an error stop.
program test_error_stop
    use wfpsf
    implicit none
    type(wfpsf_instrument) :: instrument

    call instrument%create("no-such")
end program test_error_stop
