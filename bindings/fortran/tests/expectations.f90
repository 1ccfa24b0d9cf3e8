! SPDX-License-Identifier: GPL-3.0-or-later
! What every test says when something is not so.
module expectations
    implicit none
    private
    public :: expect

contains

    subroutine expect(truth, what)
        logical, intent(in) :: truth
        character(len=*), intent(in) :: what

        if (.not. truth) error stop "failed: " // what
    end subroutine expect

end module expectations
