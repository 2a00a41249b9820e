! Event-driven dynamics of hard spheres.
module lanescape_collisions
  use, intrinsic :: iso_c_binding
  use lanescape_objects
  implicit none
  private

  ! Time in sigma sqrt(m / k_B T), with T = 1.
  type, extends(lanescape_object), public :: lanescape_event_driven
    integer, private :: particles = 0
  contains
    procedure :: create => create_event_driven
    procedure :: draw_velocities
    procedure :: set_velocities
    procedure :: collide
    procedure :: advance_to
    procedure :: describe
    procedure :: get
    procedure :: save_state
    procedure :: restore_state
  end type lanescape_event_driven

  type, public :: lanescape_event_driven_report
    integer(c_int64_t) :: collisions = 0
    real(dp) :: time = 0, kinetic_energy = 0
    real(dp) :: compressibility = 0  ! p V / (N k_B T) since the start
  end type lanescape_event_driven_report

  ! A struct, with its members in the header's order.
  type, bind(c) :: report_c
    integer(c_size_t) :: size = 0
    integer(c_int64_t) :: collisions = 0
    real(c_double) :: time = 0, kinetic_energy = 0, compressibility = 0
  end type report_c

  interface
    integer(c_int) function create_c(particles, radii, masses, positions, box, instruction_set, dynamics) &
      bind(c, name="lanescape_event_driven_create")
      import
      integer(c_size_t), value :: particles
      real(c_double), intent(in) :: radii(*), positions(*), box(3)
      type(c_ptr), value :: masses, instruction_set
      type(c_ptr), intent(inout) :: dynamics
    end function create_c
    integer(c_int) function draw_velocities_c(dynamics, seed) bind(c, name="lanescape_event_driven_draw_velocities")
      import
      type(c_ptr), value :: dynamics
      integer(c_int64_t), value :: seed
    end function draw_velocities_c
    integer(c_int) function set_velocities_c(dynamics, velocities) bind(c, name="lanescape_event_driven_set_velocities")
      import
      type(c_ptr), value :: dynamics
      real(c_double), intent(in) :: velocities(*)
    end function set_velocities_c
    integer(c_int) function collide_c(dynamics, collisions) bind(c, name="lanescape_event_driven_collide")
      import
      type(c_ptr), value :: dynamics
      integer(c_int64_t), value :: collisions
    end function collide_c
    integer(c_int) function advance_to_c(dynamics, time) bind(c, name="lanescape_event_driven_advance_to")
      import
      type(c_ptr), value :: dynamics
      real(c_double), value :: time
    end function advance_to_c
    integer(c_int) function describe_c(dynamics, report) bind(c, name="lanescape_event_driven_describe")
      import
      type(c_ptr), value :: dynamics
      type(report_c), intent(inout) :: report
    end function describe_c
    integer(c_int) function get_c(dynamics, positions, velocities) bind(c, name="lanescape_event_driven_get")
      import
      type(c_ptr), value :: dynamics, positions, velocities
    end function get_c
    integer(c_int) function save_c(dynamics, state, capacity, needed) bind(c, name="lanescape_event_driven_save")
      import
      type(c_ptr), value :: dynamics, state
      integer(c_size_t), value :: capacity
      integer(c_size_t), intent(inout) :: needed
    end function save_c
    integer(c_int) function restore_c(dynamics, state, bytes) bind(c, name="lanescape_event_driven_restore")
      import
      type(c_ptr), value :: dynamics, state
      integer(c_size_t), value :: bytes
    end function restore_c
    integer(c_int) function destroy_event_driven_c(handle) bind(c, name="lanescape_event_driven_destroy")
      import
      type(c_ptr), value :: handle
    end function destroy_event_driven_c
  end interface

contains

  ! Starts at rest, from spheres that do not overlap. Positions (3, N); masses: of each particle, without them 1; edges of the box
  ! are at least 2.05 of the largest diameter.
  subroutine create_event_driven(self, radii, positions, box, masses, instruction_set, stat, errmsg)
    class(lanescape_event_driven), intent(inout) :: self
    real(dp), intent(in), contiguous :: radii(:), positions(:, :)
    real(dp), intent(in) :: box(3)
    real(dp), intent(in), optional, target, contiguous :: masses(:)
    character(*), intent(in), optional :: instruction_set
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    character(kind=c_char), allocatable, target :: set_chars(:)
    type(c_ptr) :: address, set, handle
    integer(c_int) :: status
    if (.not. check_shape("positions", positions, size(radii), stat, errmsg)) return
    if (.not. fits("masses", masses, size(radii), address, stat, errmsg)) return
    call optional_word(instruction_set, set_chars, set)
    status = create_c(size(radii, kind=c_size_t), radii, address, positions, box, set, handle)
    if (status == lanescape_ok) then
      call self%hold(handle, destroy_event_driven_c)
      self%particles = size(radii)
    end if
    call conclude(status, stat, errmsg)
  end subroutine create_event_driven

  ! From Maxwell's distribution without total momentum, scaled so that K = (3/2) N.
  subroutine draw_velocities(self, seed, stat, errmsg)
    class(lanescape_event_driven), intent(inout) :: self
    integer, intent(in) :: seed
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    call conclude(draw_velocities_c(self%handle(), int(seed, c_int64_t)), stat, errmsg)
  end subroutine draw_velocities

  subroutine set_velocities(self, velocities, stat, errmsg)
    class(lanescape_event_driven), intent(inout) :: self
    real(dp), intent(in), contiguous :: velocities(:, :)
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    if (.not. check_shape("velocities", velocities, self%particles, stat, errmsg)) return
    call conclude(set_velocities_c(self%handle(), velocities), stat, errmsg)
  end subroutine set_velocities

  ! Runs over that many collisions.
  subroutine collide(self, collisions, stat, errmsg)
    class(lanescape_event_driven), intent(inout) :: self
    integer, intent(in) :: collisions
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    if (collisions < 0) then
      call refuse("a number of collisions below 0 is not allowed", stat, errmsg)
      return
    end if
    call conclude(collide_c(self%handle(), int(collisions, c_int64_t)), stat, errmsg)
  end subroutine collide

  ! Runs to a time.
  subroutine advance_to(self, time, stat, errmsg)
    class(lanescape_event_driven), intent(inout) :: self
    real(dp), intent(in) :: time
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    call conclude(advance_to_c(self%handle(), time), stat, errmsg)
  end subroutine advance_to

  subroutine describe(self, report, stat, errmsg)
    class(lanescape_event_driven), intent(in) :: self
    type(lanescape_event_driven_report), intent(out) :: report
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    type(report_c) :: r
    integer(c_int) :: status
    r%size = c_sizeof(r)
    status = describe_c(self%handle(), r)
    report = lanescape_event_driven_report(r%collisions, r%time, r%kinetic_energy, r%compressibility)
    call conclude(status, stat, errmsg)
  end subroutine describe

  ! Unwrapped positions and velocities, (3, N) each.
  subroutine get(self, positions, velocities, stat, errmsg)
    class(lanescape_event_driven), intent(in) :: self
    real(dp), intent(inout), target, contiguous :: positions(:, :)
    real(dp), intent(inout), optional, target, contiguous :: velocities(:, :)
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    type(c_ptr) :: to(2)
    to = c_null_ptr
    if (.not. check_shape("positions", positions, self%particles, stat, errmsg)) return
    if (self%particles > 0) to(1) = c_loc(positions(1, 1))
    if (present(velocities)) then
      if (.not. check_shape("velocities", velocities, self%particles, stat, errmsg)) return
      if (self%particles > 0) to(2) = c_loc(velocities(1, 1))
    end if
    call conclude(get_c(self%handle(), to(1), to(2)), stat, errmsg)
  end subroutine get

  ! The state as bytes, from which restore_state goes on with the same bits. All spheres are brought to one
  ! time first: the trajectory goes on with other bits than without.
  subroutine save_state(self, state, stat, errmsg)
    class(lanescape_event_driven), intent(inout) :: self
    integer(c_int8_t), intent(out), allocatable, target :: state(:)
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    integer(c_size_t) :: needed
    integer(c_int) :: status
    status = save_c(self%handle(), c_null_ptr, 0_c_size_t, needed)
    if (status == lanescape_ok) then
      allocate (state(needed))
      status = save_c(self%handle(), c_loc(state(1)), needed, needed)
    end if
    call conclude(status, stat, errmsg)
  end subroutine save_state

  ! Goes on from a state that an object made with the same arguments saved.
  subroutine restore_state(self, state, stat, errmsg)
    class(lanescape_event_driven), intent(inout) :: self
    integer(c_int8_t), intent(in), target, contiguous :: state(:)
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    type(c_ptr) :: address
    address = c_null_ptr
    if (size(state) > 0) address = c_loc(state(1))
    call conclude(restore_c(self%handle(), address, size(state, kind=c_size_t)), stat, errmsg)
  end subroutine restore_state
end module lanescape_collisions
