! Procedures of the program that long work calls with the part done.
module lanescape_progress_reports
  use, intrinsic :: iso_c_binding
  use lanescape_objects
  implicit none
  private
  public :: lanescape_progress, host_progress, progress_c

  abstract interface
    ! Called now and then with the part done, 0 ... 1, or where paths are shortened with the number of iterations or trials made.
    ! stop is false on entry; true ends the work early.
    subroutine lanescape_progress(done, stop)
      import :: dp
      real(dp), intent(in) :: done
      logical, intent(inout) :: stop
    end subroutine lanescape_progress
  end interface

  ! What C passes back to progress_c.
  type :: host_progress
    procedure(lanescape_progress), pointer, nopass :: report => null()
  end type host_progress

contains

  integer(c_int) function progress_c(user, done) bind(c)
    type(c_ptr), value :: user
    real(c_double), value :: done
    type(host_progress), pointer :: host
    logical :: stop
    call c_f_pointer(user, host)
    stop = .false.
    call host%report(done, stop)
    progress_c = merge(1, 0, stop)
  end function progress_c
end module lanescape_progress_reports
