! Pairs of configurations of one trajectory, the ends of paths.
module lanescape_end_point_pairs
  use, intrinsic :: iso_c_binding
  use lanescape_objects
  use lanescape_models, only: lanescape_model
  use lanescape_progress_reports
  implicit none
  private

  ! The protocol: melt, cool, check the temperature, settle, and follow the trajectory over a distance; hard spheres: equilibrate and
  ! follow. Counts are steps, or collisions of hard spheres; 0 and blanks stand for the library's own choice.
  type, public :: lanescape_end_point_settings
    real(dp) :: temperature = 0              ! of soft models
    real(dp) :: distance = 0                 ! 108 at N = 108, else 10 sqrt(N), in the model's unit of length
    integer :: pairs = 1
    logical :: quick = .false.               ! shorter counts
    integer(c_int64_t) :: equilibration = 0  ! of melting, cooling, checking and settling each
    integer(c_int64_t) :: between = 0        ! from the end of one pair to the start of the next
    integer(c_int64_t) :: seed = 1
    integer :: threads = 1
    character(16) :: precision = "", instruction_set = ""
    procedure(lanescape_progress), pointer, nopass :: progress => null()
  end type lanescape_end_point_settings

  type, extends(lanescape_object), public :: lanescape_end_points
    integer :: pairs = 0
    integer, private :: particles = 0
  contains
    procedure :: make
    procedure :: get
  end type lanescape_end_points

  ! A struct, with its members in the header's order.
  type, bind(c) :: settings_c
    integer(c_size_t) :: size = 0
    real(c_double) :: temperature = 0, distance = 0
    integer(c_size_t) :: pairs = 0
    integer(c_int) :: quick = 0
    integer(c_int64_t) :: equilibration = 0, between = 0, seed = 0
    integer(c_int) :: threads = 1
    type(c_ptr) :: precision = c_null_ptr, instruction_set = c_null_ptr
    type(c_funptr) :: progress = c_null_funptr
    type(c_ptr) :: progress_user = c_null_ptr
  end type settings_c

  interface
    integer(c_int) function settings_init_c(settings, size) bind(c, name="lanescape_end_point_settings_init")
      import
      type(settings_c), intent(inout) :: settings
      integer(c_size_t), value :: size
    end function settings_init_c
    integer(c_int) function make_c(model, particles, species, positions, box, diameters, settings, ends) &
      bind(c, name="lanescape_make_end_points")
      import
      type(c_ptr), value :: model, diameters
      integer(c_size_t), value :: particles
      integer(c_int), intent(in) :: species(*)
      real(c_double), intent(in) :: positions(*), box(3)
      type(settings_c), intent(in) :: settings
      type(c_ptr), intent(inout) :: ends
    end function make_c
    integer(c_int) function count_c(ends, pairs) bind(c, name="lanescape_end_points_count")
      import
      type(c_ptr), value :: ends
      integer(c_size_t), intent(inout) :: pairs
    end function count_c
    integer(c_int) function get_c(ends, pair, start, finish, distance, steps, time) bind(c, name="lanescape_end_points_get")
      import
      type(c_ptr), value :: ends
      integer(c_size_t), value :: pair
      real(c_double), intent(inout) :: start(*), finish(*), distance, time
      integer(c_int64_t), intent(inout) :: steps
    end function get_c
    integer(c_int) function ends_destroy_c(handle) bind(c, name="lanescape_end_points_destroy")
      import
      type(c_ptr), value :: handle
    end function ends_destroy_c
  end interface

contains

  ! From a configuration such as a start's: species from 1, positions (3, N); diameters: of each particle, for models that have them.
  ! lanescape_goal_not_reached if the temperature does not hold or the distance is not reached, lanescape_interrupted if progress
  ! ends the work.
  subroutine make(self, model, species, positions, box, settings, diameters, stat, errmsg)
    class(lanescape_end_points), intent(inout) :: self
    class(lanescape_model), intent(in) :: model
    integer, intent(in) :: species(:)
    real(dp), intent(in), contiguous :: positions(:, :)
    real(dp), intent(in) :: box(3)
    type(lanescape_end_point_settings), intent(in), optional :: settings
    real(dp), intent(in), optional, target, contiguous :: diameters(:)
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    type(host_progress), target :: host
    character(kind=c_char), allocatable, target :: chars(:, :)
    type(settings_c) :: s
    type(c_ptr) :: address, handle
    integer(c_size_t) :: pairs
    integer(c_int) :: status
    if (.not. check_shape("positions", positions, size(species), stat, errmsg)) return
    if (.not. fits("diameters", diameters, size(species), address, stat, errmsg)) return
    if (present(settings)) then
      if (settings%pairs < 0) then
        call refuse("a number of pairs below 0 is not allowed", stat, errmsg)
        return
      end if
    end if
    call translate(settings, host, s, chars)
    status = make_c(model%handle(), size(species, kind=c_size_t), species - 1, positions, box, address, s, handle)
    if (status == lanescape_ok) then
      call self%hold(handle, ends_destroy_c)
      self%particles = size(species)
      status = count_c(handle, pairs)
      self%pairs = int(pairs)
    end if
    call conclude(status, stat, errmsg)
  end subroutine make

  ! Settings for C, whose words are in `chars` and whose procedure is in `host`.
  subroutine translate(settings, host, s, chars)
    type(lanescape_end_point_settings), intent(in), optional :: settings
    type(host_progress), target, intent(inout) :: host
    type(settings_c), intent(out) :: s
    character(kind=c_char), allocatable, target, intent(out) :: chars(:, :)
    type(c_ptr), allocatable :: addresses(:)
    if (settings_init_c(s, c_sizeof(s)) /= lanescape_ok .or. .not. present(settings)) return
    call address_of_words([settings%precision, settings%instruction_set], chars, addresses)
    if (settings%precision /= "") s%precision = addresses(1)
    if (settings%instruction_set /= "") s%instruction_set = addresses(2)
    if (abs(settings%temperature) > 0) s%temperature = settings%temperature
    s%distance = settings%distance
    s%pairs = settings%pairs
    s%quick = merge(1, 0, settings%quick)
    s%equilibration = settings%equilibration
    if (settings%between /= 0) s%between = settings%between
    s%seed = settings%seed
    s%threads = settings%threads
    if (.not. associated(settings%progress)) return
    host%report => settings%progress
    s%progress = c_funloc(progress_c)
    s%progress_user = c_loc(host)
  end subroutine translate

  ! One pair, from 1: unwrapped positions of each end, (3, N), their distance in 3N space, steps or collisions and time between them.
  subroutine get(self, pair, start, finish, distance, steps, time, stat, errmsg)
    class(lanescape_end_points), intent(in) :: self
    integer, intent(in) :: pair
    real(dp), intent(inout), contiguous :: start(:, :), finish(:, :)
    real(dp), intent(out), optional :: distance, time
    integer(c_int64_t), intent(out), optional :: steps
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    real(dp) :: apart, lasted
    integer(c_int64_t) :: made
    integer(c_int) :: status
    if (.not. check_shape("start", start, self%particles, stat, errmsg)) return
    if (.not. check_shape("finish", finish, self%particles, stat, errmsg)) return
    status = get_c(self%handle(), int(pair - 1, c_size_t), start, finish, apart, made, lasted)
    if (status == lanescape_ok) then
      if (present(distance)) distance = apart
      if (present(steps)) steps = made
      if (present(time)) time = lasted
    end if
    call conclude(status, stat, errmsg)
  end subroutine get
end module lanescape_end_point_pairs
