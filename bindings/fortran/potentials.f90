! The potential energy of soft models.
module lanescape_potentials
  use, intrinsic :: iso_c_binding
  use lanescape_objects
  use lanescape_models, only: lanescape_model
  implicit none
  private

  ! The potential energy of a soft model in a periodic orthorhombic box.
  type, extends(lanescape_object), public :: lanescape_potential
  contains
    procedure :: create => create_potential
    procedure :: particles
    procedure :: evaluate
    procedure :: set_box
    procedure :: set_exclusions
    procedure :: states
  end type lanescape_potential

  ! Structs, with their members in the header's order.
  type, bind(c), public :: potential_options_c
    integer(c_size_t) :: size = 0
    integer(c_int) :: threads = 1
    type(c_ptr) :: precision = c_null_ptr, instruction_set = c_null_ptr, diameters = c_null_ptr
  end type potential_options_c

  type, bind(c) :: outputs_c
    integer(c_size_t) :: size = 0
    type(c_ptr) :: energy = c_null_ptr, virial = c_null_ptr, stress = c_null_ptr, forces = c_null_ptr, energies = c_null_ptr
  end type outputs_c

  interface
    integer(c_int) function potential_create_c(model, particles, species, box, options, potential) &
      bind(c, name="lanescape_potential_create")
      import
      type(c_ptr), value :: model
      integer(c_size_t), value :: particles
      integer(c_int), intent(in) :: species(*)
      real(c_double), intent(in) :: box(3)
      type(potential_options_c), intent(in) :: options
      type(c_ptr), intent(inout) :: potential
    end function potential_create_c
    integer(c_int) function potential_particles_c(potential, particles) bind(c, name="lanescape_potential_particles")
      import
      type(c_ptr), value :: potential
      integer(c_size_t), intent(inout) :: particles
    end function potential_particles_c
    integer(c_int) function potential_evaluate_c(potential, positions, outputs) bind(c, name="lanescape_potential_evaluate")
      import
      type(c_ptr), value :: potential
      real(c_double), intent(in) :: positions(*)
      type(outputs_c), intent(in) :: outputs
    end function potential_evaluate_c
    integer(c_int) function potential_set_box_c(potential, box) bind(c, name="lanescape_potential_set_box")
      import
      type(c_ptr), value :: potential
      real(c_double), intent(in) :: box(3)
    end function potential_set_box_c
    integer(c_int) function set_exclusions_c(potential, pairs, particles) bind(c, name="lanescape_potential_set_exclusions")
      import
      type(c_ptr), value :: potential
      integer(c_size_t), value :: pairs
      integer(c_size_t), intent(in) :: particles(*)
    end function set_exclusions_c
    integer(c_int) function states_c(potential, states, order_parameters, probabilities) &
      bind(c, name="lanescape_potential_states")
      import
      type(c_ptr), value :: potential, order_parameters, probabilities
      integer(c_size_t), intent(inout) :: states
    end function states_c
    integer(c_int) function potential_destroy_c(handle) bind(c, name="lanescape_potential_destroy")
      import
      type(c_ptr), value :: handle
    end function potential_destroy_c
  end interface

contains

  ! Species from 1, one per particle; box: edge lengths; diameters: of each particle, for models that have them.
  subroutine create_potential(self, model, species, box, threads, precision, instruction_set, diameters, stat, errmsg)
    class(lanescape_potential), intent(inout) :: self
    class(lanescape_model), intent(in) :: model
    integer, intent(in) :: species(:)
    real(dp), intent(in) :: box(3)
    integer, intent(in), optional :: threads
    character(*), intent(in), optional :: precision, instruction_set
    real(dp), intent(in), optional, target, contiguous :: diameters(:)
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    type(potential_options_c) :: options
    character(kind=c_char), allocatable, target :: precision_chars(:), set_chars(:)
    type(c_ptr) :: handle
    integer(c_int) :: status
    options%size = c_sizeof(options)
    if (present(threads)) options%threads = threads
    call optional_word(precision, precision_chars, options%precision)
    call optional_word(instruction_set, set_chars, options%instruction_set)
    if (.not. fits("diameters", diameters, size(species), options%diameters, stat, errmsg)) return
    status = potential_create_c(model%handle(), size(species, kind=c_size_t), species - 1, box, options, handle)
    if (status == lanescape_ok) call self%hold(handle, potential_destroy_c)
    call conclude(status, stat, errmsg)
  end subroutine create_potential

  ! How many there are; 0 without a potential.
  integer function particles(self)
    class(lanescape_potential), intent(in) :: self
    integer(c_size_t) :: count
    particles = 0
    if (potential_particles_c(self%handle(), count) == lanescape_ok) particles = int(count)
  end function particles

  ! Positions (3, N), anywhere. What is present is computed: stress xx yy zz yz xz xy, minus sum r_a f_b over the volume; forces
  ! (3, N); energies of each particle, half of each of its pairs.
  subroutine evaluate(self, positions, energy, virial, stress, forces, energies, stat, errmsg)
    class(lanescape_potential), intent(inout) :: self
    real(dp), intent(in), contiguous :: positions(:, :)
    real(dp), intent(out), optional, target :: energy, virial, stress(6)
    real(dp), intent(out), optional, target, contiguous :: forces(:, :), energies(:)
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    type(outputs_c) :: outputs
    integer :: n
    n = self%particles()
    outputs%size = c_sizeof(outputs)
    if (present(energy)) outputs%energy = c_loc(energy)
    if (present(virial)) outputs%virial = c_loc(virial)
    if (present(stress)) outputs%stress = c_loc(stress(1))
    if (c_associated(self%handle())) then
      if (.not. check_shape("positions", positions, n, stat, errmsg)) return
      if (present(forces)) then
        if (.not. check_shape("forces", forces, n, stat, errmsg)) return
        if (n > 0) outputs%forces = c_loc(forces(1, 1))
      end if
      if (.not. fits("energies", energies, n, outputs%energies, stat, errmsg)) return
    end if
    call conclude(potential_evaluate_c(self%handle(), positions, outputs), stat, errmsg)
  end subroutine evaluate

  subroutine set_box(self, box, stat, errmsg)
    class(lanescape_potential), intent(inout) :: self
    real(dp), intent(in) :: box(3)
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    call conclude(potential_set_box_c(self%handle(), box), stat, errmsg)
  end subroutine set_box

  ! Pairs of particles, (2, pairs), that do not interact, such as bonded ones, in place of those before. Only the nearest image of a
  ! pair is left out. Of pair potentials.
  subroutine set_exclusions(self, pairs, stat, errmsg)
    class(lanescape_potential), intent(inout) :: self
    integer, intent(in) :: pairs(:, :)
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    if (size(pairs, 1) /= 2) then
      call refuse("pairs must be (2, number of pairs)", stat, errmsg)
      return
    end if
    call conclude(set_exclusions_c(self%handle(), size(pairs, 2, kind=c_size_t), int(pairs - 1, c_size_t)), stat, errmsg)
  end subroutine set_exclusions

  ! Of the last evaluation of sites in states: order parameters, (N), and probabilities, (states, N).
  subroutine states(self, order_parameters, probabilities, stat, errmsg)
    class(lanescape_potential), intent(in) :: self
    real(dp), intent(out), optional, allocatable, target :: order_parameters(:), probabilities(:, :)
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    type(c_ptr) :: to(2)
    integer(c_size_t) :: count
    integer(c_int) :: status
    integer :: n
    to = c_null_ptr
    n = self%particles()
    status = states_c(self%handle(), count, to(1), to(2))
    if (status == lanescape_ok) then
      if (present(order_parameters)) allocate (order_parameters(n))
      if (present(order_parameters) .and. n > 0) to(1) = c_loc(order_parameters(1))
      if (present(probabilities)) allocate (probabilities(count, n))
      if (present(probabilities) .and. n > 0) to(2) = c_loc(probabilities(1, 1))
      status = states_c(self%handle(), count, to(1), to(2))
    end if
    call conclude(status, stat, errmsg)
  end subroutine states
end module lanescape_potentials
