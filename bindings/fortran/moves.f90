! Monte Carlo moves.
module lanescape_monte_carlo
  use, intrinsic :: iso_c_binding
  use lanescape_objects
  use lanescape_models, only: lanescape_model
  use lanescape_potentials, only: potential_options_c
  implicit none
  private

  ! Moves of one particle at a time, with a pair potential: what a move changes costs the particle's neighbours, whatever N.
  type, extends(lanescape_object), public :: lanescape_moves
    integer, private :: particles = 0
  contains
    procedure :: create => create_moves
    procedure :: energy_change
    procedure :: accept
    procedure :: get => get_positions
  end type lanescape_moves

  interface
    integer(c_int) function moves_create_c(model, particles, species, positions, box, options, moves) &
      bind(c, name="lanescape_moves_create")
      import
      type(c_ptr), value :: model
      integer(c_size_t), value :: particles
      integer(c_int), intent(in) :: species(*)
      real(c_double), intent(in) :: positions(*), box(3)
      type(potential_options_c), intent(in) :: options
      type(c_ptr), intent(inout) :: moves
    end function moves_create_c
    integer(c_int) function energy_change_c(moves, particle, to, change) bind(c, name="lanescape_moves_energy_change")
      import
      type(c_ptr), value :: moves
      integer(c_size_t), value :: particle
      real(c_double), intent(in) :: to(3)
      real(c_double), intent(inout) :: change
    end function energy_change_c
    integer(c_int) function accept_c(moves) bind(c, name="lanescape_moves_accept")
      import
      type(c_ptr), value :: moves
    end function accept_c
    integer(c_int) function positions_c(moves, positions) bind(c, name="lanescape_moves_positions")
      import
      type(c_ptr), value :: moves
      real(c_double), intent(inout) :: positions(*)
    end function positions_c
    integer(c_int) function moves_destroy_c(handle) bind(c, name="lanescape_moves_destroy")
      import
      type(c_ptr), value :: handle
    end function moves_destroy_c
  end interface

contains

  ! Species from 1; positions (3, N), anywhere; diameters: of each particle, for models that have them.
  subroutine create_moves(self, model, species, positions, box, diameters, instruction_set, stat, errmsg)
    class(lanescape_moves), intent(inout) :: self
    class(lanescape_model), intent(in) :: model
    integer, intent(in) :: species(:)
    real(dp), intent(in), contiguous :: positions(:, :)
    real(dp), intent(in) :: box(3)
    real(dp), intent(in), optional, target, contiguous :: diameters(:)
    character(*), intent(in), optional :: instruction_set
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    type(potential_options_c) :: options
    character(kind=c_char), allocatable, target :: set_chars(:)
    type(c_ptr) :: handle
    integer(c_int) :: status
    options%size = c_sizeof(options)
    call optional_word(instruction_set, set_chars, options%instruction_set)
    if (.not. check_shape("positions", positions, size(species), stat, errmsg)) return
    if (.not. fits("diameters", diameters, size(species), options%diameters, stat, errmsg)) return
    status = moves_create_c(model%handle(), size(species, kind=c_size_t), species - 1, positions, box, options, handle)
    if (status == lanescape_ok) then
      call self%hold(handle, moves_destroy_c)
      self%particles = size(species)
    end if
    call conclude(status, stat, errmsg)
  end subroutine create_moves

  ! By how much the energy rises if particle `particle`, from 1, goes there while all others stand still.
  subroutine energy_change(self, particle, to, change, stat, errmsg)
    class(lanescape_moves), intent(inout) :: self
    integer, intent(in) :: particle
    real(dp), intent(in) :: to(3)
    real(dp), intent(out) :: change
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    change = 0
    call conclude(energy_change_c(self%handle(), int(particle - 1, c_size_t), to, change), stat, errmsg)
  end subroutine energy_change

  ! Makes the last move that was asked for; the next one starts from there.
  subroutine accept(self, stat, errmsg)
    class(lanescape_moves), intent(inout) :: self
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    call conclude(accept_c(self%handle()), stat, errmsg)
  end subroutine accept

  ! Positions (3, N), with the moves that were made.
  subroutine get_positions(self, positions, stat, errmsg)
    class(lanescape_moves), intent(in) :: self
    real(dp), intent(inout), contiguous :: positions(:, :)
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    if (.not. check_shape("positions", positions, self%particles, stat, errmsg)) return
    call conclude(positions_c(self%handle(), positions), stat, errmsg)
  end subroutine get_positions
end module lanescape_monte_carlo
