! What the tests of the Fortran module share.
module check
  use lanescape
  implicit none
  private
  public :: expect, refused, finish, dp
  integer, parameter :: dp = kind(1.0d0)
  integer :: failures = 0

contains

  subroutine expect(condition, what)
    logical, intent(in) :: condition
    character(*), intent(in) :: what
    if (condition) return
    failures = failures + 1
    print '(2a)', "false: ", what
  end subroutine expect

  ! A call was refused as bad input, with a message that has these words.
  subroutine refused(stat, errmsg, words)
    integer, intent(in) :: stat
    character(*), intent(in) :: errmsg, words
    call expect(stat == lanescape_bad_input .and. index(errmsg, words) > 0, words//" is in: "//trim(errmsg))
  end subroutine refused

  subroutine finish()
    if (failures > 0) error stop "some expectations are false"
  end subroutine finish
end module check
