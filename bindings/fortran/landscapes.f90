! Procedures of the program as potential-energy landscapes.
module lanescape_landscapes
  use, intrinsic :: iso_c_binding
  use lanescape_objects
  implicit none
  private
  public :: lanescape_landscape, landscape_of

  abstract interface
    ! A potential-energy landscape: V of unwrapped positions (3, N) and, where it is present, dV/dR. stat is 0 on entry; another
    ! value ends the search or run with lanescape_callback_failed.
    subroutine lanescape_landscape(positions, energy, gradient, stat)
      import :: dp
      real(dp), intent(in) :: positions(:, :)
      real(dp), intent(out) :: energy
      real(dp), intent(out), optional :: gradient(:, :)
      integer, intent(inout) :: stat
    end subroutine lanescape_landscape
  end interface
  ! What C passes back to evaluate_host.
  type, public :: host_landscape
    procedure(lanescape_landscape), pointer, nopass :: evaluate => null()
    integer :: particles = 0
  end type host_landscape

  type, bind(c), public :: landscape_c
    integer(c_size_t) :: size = 0
    type(c_ptr) :: user = c_null_ptr
    integer(c_size_t) :: particles = 0
    type(c_funptr) :: evaluate = c_null_funptr
  end type landscape_c

contains

  ! The struct of the header for a procedure; the host must outlive its use.
  function landscape_of(host) result(landscape)
    type(host_landscape), intent(in), target :: host
    type(landscape_c) :: landscape
    landscape = landscape_c(c_sizeof(landscape), c_loc(host), int(host%particles, c_size_t), c_funloc(evaluate_host))
  end function landscape_of

  integer(c_int) function evaluate_host(user, positions, gradient, energy) bind(c)
    type(c_ptr), value :: user, positions, gradient
    real(c_double), intent(inout) :: energy
    type(host_landscape), pointer :: host
    real(dp), pointer :: r(:, :), g(:, :)
    integer :: stat
    call c_f_pointer(user, host)
    call c_f_pointer(positions, r, [3, host%particles])
    stat = 0
    if (c_associated(gradient)) then
      call c_f_pointer(gradient, g, [3, host%particles])
      call host%evaluate(r, energy, g, stat=stat)
    else
      call host%evaluate(r, energy, stat=stat)
    end if
    evaluate_host = int(stat, c_int)
  end function evaluate_host
end module lanescape_landscapes
