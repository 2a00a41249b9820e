! Molecular dynamics on potentials and on landscapes of the program's own.
module lanescape_trajectories
  use, intrinsic :: iso_c_binding
  use lanescape_objects
  use lanescape_landscapes
  use lanescape_potentials, only: lanescape_potential
  implicit none
  private

  ! Newton's equations by the velocity Verlet algorithm.
  type, extends(lanescape_object), public :: lanescape_dynamics
    type(host_landscape), pointer, private :: host => null()
    integer, private :: particles = 0
  contains
    procedure :: create => create_dynamics
    procedure :: create_on => create_dynamics_on
    procedure :: draw_velocities
    procedure :: set_velocities
    procedure :: run
    procedure :: describe
    procedure :: get
    procedure :: save_state
    procedure :: restore_state
    final :: forget_host
  end type lanescape_dynamics

  type, public :: lanescape_dynamics_report
    integer(c_int64_t) :: steps = 0
    real(dp) :: temperature = 0, kinetic_energy = 0, potential_energy = 0
  end type lanescape_dynamics_report

  ! A struct, with its members in the header's order.
  type, bind(c) :: report_c
    integer(c_size_t) :: size = 0
    integer(c_int64_t) :: steps = 0
    real(c_double) :: temperature = 0, kinetic_energy = 0, potential_energy = 0
  end type report_c

  interface
    integer(c_int) function dynamics_create_c(potential, masses, positions, time_step, dynamics) &
      bind(c, name="lanescape_dynamics_create")
      import
      type(c_ptr), value :: potential, masses
      real(c_double), intent(in) :: positions(*)
      real(c_double), value :: time_step
      type(c_ptr), intent(inout) :: dynamics
    end function dynamics_create_c
    integer(c_int) function dynamics_create_on_c(landscape, masses, positions, time_step, dynamics) &
      bind(c, name="lanescape_dynamics_create_on")
      import
      type(landscape_c), intent(in) :: landscape
      type(c_ptr), value :: masses
      real(c_double), intent(in) :: positions(*)
      real(c_double), value :: time_step
      type(c_ptr), intent(inout) :: dynamics
    end function dynamics_create_on_c
    integer(c_int) function draw_velocities_c(dynamics, temperature, seed) bind(c, name="lanescape_dynamics_draw_velocities")
      import
      type(c_ptr), value :: dynamics
      real(c_double), value :: temperature
      integer(c_int64_t), value :: seed
    end function draw_velocities_c
    integer(c_int) function set_velocities_c(dynamics, velocities) bind(c, name="lanescape_dynamics_set_velocities")
      import
      type(c_ptr), value :: dynamics
      real(c_double), intent(in) :: velocities(*)
    end function set_velocities_c
    integer(c_int) function run_c(dynamics, steps) bind(c, name="lanescape_dynamics_run")
      import
      type(c_ptr), value :: dynamics
      integer(c_int64_t), value :: steps
    end function run_c
    integer(c_int) function describe_c(dynamics, report) bind(c, name="lanescape_dynamics_describe")
      import
      type(c_ptr), value :: dynamics
      type(report_c), intent(inout) :: report
    end function describe_c
    integer(c_int) function get_c(dynamics, positions, velocities) bind(c, name="lanescape_dynamics_get")
      import
      type(c_ptr), value :: dynamics, positions, velocities
    end function get_c
    integer(c_int) function save_c(dynamics, state, capacity, needed) bind(c, name="lanescape_dynamics_save")
      import
      type(c_ptr), value :: dynamics, state
      integer(c_size_t), value :: capacity
      integer(c_size_t), intent(inout) :: needed
    end function save_c
    integer(c_int) function restore_c(dynamics, state, bytes) bind(c, name="lanescape_dynamics_restore")
      import
      type(c_ptr), value :: dynamics, state
      integer(c_size_t), value :: bytes
    end function restore_c
    integer(c_int) function dynamics_destroy_c(handle) bind(c, name="lanescape_dynamics_destroy")
      import
      type(c_ptr), value :: handle
    end function dynamics_destroy_c
  end interface

contains

  ! Starts at rest. Positions (3, N); masses: of each particle, without them 1.
  subroutine create_dynamics(self, potential, positions, time_step, masses, stat, errmsg)
    class(lanescape_dynamics), intent(inout) :: self
    class(lanescape_potential), intent(in) :: potential
    real(dp), intent(in), contiguous :: positions(:, :)
    real(dp), intent(in) :: time_step
    real(dp), intent(in), optional, target, contiguous :: masses(:)
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    type(c_ptr) :: address, handle
    integer(c_int) :: status
    if (.not. check_shape("positions", positions, potential%particles(), stat, errmsg)) return
    if (.not. fits("masses", masses, size(positions, 2), address, stat, errmsg)) return
    status = dynamics_create_c(potential%handle(), address, positions, time_step, handle)
    call keep(self, status, handle, size(positions, 2), stat, errmsg)
  end subroutine create_dynamics

  ! On a landscape of the program's own, a procedure that lasts as long as the object: of a module, or the caller's own for as long as
  ! the caller runs.
  subroutine create_dynamics_on(self, landscape, positions, time_step, masses, stat, errmsg)
    class(lanescape_dynamics), intent(inout) :: self
    procedure(lanescape_landscape) :: landscape
    real(dp), intent(in), contiguous :: positions(:, :)
    real(dp), intent(in) :: time_step
    real(dp), intent(in), optional, target, contiguous :: masses(:)
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    type(host_landscape), pointer :: host
    type(c_ptr) :: address, handle
    integer(c_int) :: status
    if (.not. check_shape("positions", positions, size(positions, 2), stat, errmsg)) return
    if (.not. fits("masses", masses, size(positions, 2), address, stat, errmsg)) return
    allocate (host)
    host%evaluate => landscape
    host%particles = size(positions, 2)
    status = dynamics_create_on_c(landscape_of(host), address, positions, time_step, handle)
    if (status == lanescape_ok) then
      call keep(self, status, handle, size(positions, 2), stat, errmsg)
      self%host => host
    else
      deallocate (host)
      call conclude(status, stat, errmsg)
    end if
  end subroutine create_dynamics_on

  ! Keeps a handle that was made, and ends the call.
  subroutine keep(self, status, handle, particles, stat, errmsg)
    class(lanescape_dynamics), intent(inout) :: self
    integer(c_int), intent(in) :: status
    type(c_ptr), intent(in) :: handle
    integer, intent(in) :: particles
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    if (status == lanescape_ok) then
      call self%hold(handle, dynamics_destroy_c)
      if (associated(self%host)) deallocate (self%host)
      self%host => null()
      self%particles = particles
    end if
    call conclude(status, stat, errmsg)
  end subroutine keep

  subroutine forget_host(self)
    type(lanescape_dynamics), intent(inout) :: self
    call self%destroy()  ! it refers to the host
    if (associated(self%host)) deallocate (self%host)
    self%host => null()
  end subroutine forget_host

  ! From Maxwell's distribution without total momentum, scaled so that K = (3/2) N T.
  subroutine draw_velocities(self, temperature, seed, stat, errmsg)
    class(lanescape_dynamics), intent(inout) :: self
    real(dp), intent(in) :: temperature
    integer, intent(in) :: seed
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    call conclude(draw_velocities_c(self%handle(), temperature, int(seed, c_int64_t)), stat, errmsg)
  end subroutine draw_velocities

  subroutine set_velocities(self, velocities, stat, errmsg)
    class(lanescape_dynamics), intent(inout) :: self
    real(dp), intent(in), contiguous :: velocities(:, :)
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    if (.not. check_shape("velocities", velocities, self%particles, stat, errmsg)) return
    call conclude(set_velocities_c(self%handle(), velocities), stat, errmsg)
  end subroutine set_velocities

  subroutine run(self, steps, stat, errmsg)
    class(lanescape_dynamics), intent(inout) :: self
    integer, intent(in) :: steps
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    if (steps < 0) then
      call refuse("a number of steps below 0 is not allowed", stat, errmsg)
      return
    end if
    call conclude(run_c(self%handle(), int(steps, c_int64_t)), stat, errmsg)
  end subroutine run

  subroutine describe(self, report, stat, errmsg)
    class(lanescape_dynamics), intent(inout) :: self
    type(lanescape_dynamics_report), intent(out) :: report
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    type(report_c) :: r
    integer(c_int) :: status
    r%size = c_sizeof(r)
    status = describe_c(self%handle(), r)
    report = lanescape_dynamics_report(r%steps, r%temperature, r%kinetic_energy, r%potential_energy)
    call conclude(status, stat, errmsg)
  end subroutine describe

  ! Unwrapped positions and velocities, (3, N) each.
  subroutine get(self, positions, velocities, stat, errmsg)
    class(lanescape_dynamics), intent(in) :: self
    real(dp), intent(inout), target, contiguous :: positions(:, :)
    real(dp), intent(inout), optional, target, contiguous :: velocities(:, :)
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    type(c_ptr) :: address
    address = c_null_ptr
    if (.not. check_shape("positions", positions, self%particles, stat, errmsg)) return
    if (present(velocities)) then
      if (.not. check_shape("velocities", velocities, self%particles, stat, errmsg)) return
      if (self%particles > 0) address = c_loc(velocities(1, 1))
    end if
    if (self%particles > 0) then
      call conclude(get_c(self%handle(), c_loc(positions(1, 1)), address), stat, errmsg)
    else
      call conclude(get_c(self%handle(), c_null_ptr, c_null_ptr), stat, errmsg)
    end if
  end subroutine get

  ! The state as bytes, from which restore_state goes on with the same bits.
  subroutine save_state(self, state, stat, errmsg)
    class(lanescape_dynamics), intent(inout) :: self
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
    class(lanescape_dynamics), intent(inout) :: self
    integer(c_int8_t), intent(in), target, contiguous :: state(:)
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    type(c_ptr) :: address
    address = c_null_ptr
    if (size(state) > 0) address = c_loc(state(1))
    call conclude(restore_c(self%handle(), address, size(state, kind=c_size_t)), stat, errmsg)
  end subroutine restore_state
end module lanescape_trajectories
