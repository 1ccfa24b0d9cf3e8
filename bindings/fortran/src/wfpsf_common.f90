! SPDX-License-Identifier: GPL-3.0-or-later
! Statuses, text and handles on their way between C and Fortran.
module wfpsf_common
    use, intrinsic :: iso_c_binding, only: c_char, c_f_pointer, c_int64_t, c_null_char, c_ptr, &
        c_associated, c_size_t
    use wfpsf_c
    implicit none
    private
    public :: report, c_text, f_text

    interface
        pure function strlen(text) bind(c) result(length)
            import :: c_ptr, c_size_t
            implicit none
            type(c_ptr), value :: text
            integer(c_size_t) :: length
        end function strlen
    end interface

contains

    ! What becomes of the status of a C function.
    subroutine report(status, stat, errmsg)
        integer, intent(in) :: status
        integer, intent(out), optional :: stat
        character(len=*), intent(inout), optional :: errmsg
        character(len=:), allocatable :: line

        if (present(stat)) stat = status
        if (status == wfpsf_ok) return
        line = last_error()
        if (present(errmsg)) errmsg = line
        if (status < 0 .and. .not. present(stat)) error stop line
    end subroutine report

    function last_error() result(line)
        character(len=:), allocatable :: line
        character(kind=c_char) :: none(1)
        integer(c_int64_t) :: length

        length = wfpsf_last_error(none, 0_c_int64_t)
        block
            character(kind=c_char, len=length + 1) :: buffer
            length = wfpsf_last_error(buffer, length + 1)
            line = buffer(:length)
        end block
    end function last_error

    ! Text for C; trailing blanks do not count.
    pure function c_text(text)
        character(len=*), intent(in) :: text
        character(kind=c_char, len=len_trim(text) + 1) :: c_text

        c_text = trim(text) // c_null_char
    end function c_text

    ! Text from C; empty for NULL.
    function f_text(pointer) result(text)
        type(c_ptr), intent(in) :: pointer
        character(len=:), allocatable :: text
        character(kind=c_char), pointer :: characters(:)
        integer :: i

        if (.not. c_associated(pointer)) then
            text = ""
            return
        end if
        call c_f_pointer(pointer, characters, [strlen(pointer)])
        allocate (character(len=size(characters)) :: text)
        do i = 1, size(characters)
            text(i:i) = characters(i)
        end do
    end function f_text

end module wfpsf_common
