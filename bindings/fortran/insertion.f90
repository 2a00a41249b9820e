! One more particle in a fluid that stands still: its energy anywhere, and positions of a given energy (doi 10.1063/1.1579475).
module lanescape_insertion
  use, intrinsic :: iso_c_binding
  use lanescape_objects
  use lanescape_models, only: lanescape_model
  implicit none
  private

  type, extends(lanescape_object), public :: lanescape_inserter
  contains
    procedure :: create
    procedure :: particles
    procedure :: energy
    procedure :: find
    procedure :: insert
    procedure :: add
    procedure :: remove
  end type lanescape_inserter

  ! How positions are searched; 0 and blanks stand for the library's own choice.
  type, public :: lanescape_insertion_settings
    real(dp) :: energy = 0                 ! the target, 0 too
    real(dp) :: tolerance = 0              ! of the error
    character(16) :: measure = ""          ! relative, absolute, running-mean
    character(16) :: method = ""           ! usher, usher-indirect, usher-near, screened, descent
    real(dp) :: largest_step = 0           ! 0: the published optimum for the density
    integer(c_int64_t) :: most_trials = 0  ! of each insertion
    integer(c_int64_t) :: seed = 1
    integer :: threads = 1
  end type lanescape_insertion_settings

  type, public :: lanescape_inserted
    logical :: found = .false.
    real(dp) :: position(3) = 0, energy = 0, error = 0
    integer(c_int64_t) :: evaluations = 0, trials = 0
  end type lanescape_inserted

  ! Structs, with their members in the header's order.
  type, bind(c) :: inserter_options_c
    integer(c_size_t) :: size = 0
    integer(c_int) :: species = 0
    real(c_double) :: diameter = 1
    type(c_ptr) :: diameters = c_null_ptr, instruction_set = c_null_ptr
  end type inserter_options_c

  type, bind(c) :: settings_c
    integer(c_size_t) :: size = 0
    real(c_double) :: energy = 0, tolerance = 0
    type(c_ptr) :: measure = c_null_ptr, method = c_null_ptr
    real(c_double) :: largest_step = 0
    integer(c_int64_t) :: most_trials = 0
    type(c_ptr) :: region = c_null_ptr
    integer(c_int64_t) :: seed = 0
    integer(c_int) :: threads = 1
  end type settings_c

  type, bind(c) :: insertions_c
    integer(c_size_t) :: size = 0
    type(c_ptr) :: found = c_null_ptr, positions = c_null_ptr, energies = c_null_ptr, errors = c_null_ptr
    type(c_ptr) :: evaluations = c_null_ptr, trials = c_null_ptr
  end type insertions_c

  abstract interface
    integer(c_int) function search_c(inserter, settings, count, insertions) bind(c)
      import
      type(c_ptr), value :: inserter
      type(settings_c), intent(in) :: settings
      integer(c_size_t), value :: count
      type(insertions_c), intent(in) :: insertions
    end function search_c
  end interface

  interface
    integer(c_int) function settings_init_c(settings, size) bind(c, name="lanescape_insertion_settings_init")
      import
      type(settings_c), intent(inout) :: settings
      integer(c_size_t), value :: size
    end function settings_init_c
    integer(c_int) function create_c(model, particles, species, positions, box, options, inserter) &
      bind(c, name="lanescape_inserter_create")
      import
      type(c_ptr), value :: model
      integer(c_size_t), value :: particles
      integer(c_int), intent(in) :: species(*)
      real(c_double), intent(in) :: positions(*), box(3)
      type(inserter_options_c), intent(in) :: options
      type(c_ptr), intent(inout) :: inserter
    end function create_c
    integer(c_int) function particles_c(inserter, particles) bind(c, name="lanescape_inserter_particles")
      import
      type(c_ptr), value :: inserter
      integer(c_size_t), intent(inout) :: particles
    end function particles_c
    integer(c_int) function energy_c(inserter, position, energy, force) bind(c, name="lanescape_inserter_energy")
      import
      type(c_ptr), value :: inserter
      real(c_double), intent(in) :: position(3)
      real(c_double), intent(inout) :: energy
      type(c_ptr), value :: force
    end function energy_c
    integer(c_int) function add_c(inserter, position) bind(c, name="lanescape_inserter_add")
      import
      type(c_ptr), value :: inserter
      real(c_double), intent(in) :: position(3)
    end function add_c
    integer(c_int) function remove_c(inserter, position, removed) bind(c, name="lanescape_inserter_remove")
      import
      type(c_ptr), value :: inserter
      real(c_double), intent(in) :: position(3)
      integer(c_int), intent(inout) :: removed
    end function remove_c
    integer(c_int) function destroy_inserter_c(handle) bind(c, name="lanescape_inserter_destroy")
      import
      type(c_ptr), value :: handle
    end function destroy_inserter_c
  end interface
  procedure(search_c), bind(c, name="lanescape_inserter_find") :: find_c
  procedure(search_c), bind(c, name="lanescape_inserter_insert") :: insert_c

contains

  ! kind: species of the particle, from 1 as those of the fluid. diameter: of the particle, diameters: of the fluid's, for models
  ! whose particles have them.
  subroutine create(self, model, species, positions, box, kind, diameter, diameters, instruction_set, stat, errmsg)
    class(lanescape_inserter), intent(inout) :: self
    class(lanescape_model), intent(in) :: model
    integer, intent(in) :: species(:)
    real(dp), intent(in), contiguous :: positions(:, :)
    real(dp), intent(in) :: box(3)
    integer, intent(in), optional :: kind
    real(dp), intent(in), optional :: diameter
    real(dp), intent(in), optional, target, contiguous :: diameters(:)
    character(*), intent(in), optional :: instruction_set
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    type(inserter_options_c) :: options
    character(kind=c_char), allocatable, target :: set_chars(:)
    type(c_ptr) :: handle
    integer(c_int) :: status
    options%size = c_sizeof(options)
    if (present(kind)) options%species = kind - 1
    if (present(diameter)) options%diameter = diameter
    call optional_word(instruction_set, set_chars, options%instruction_set)
    if (.not. check_shape("positions", positions, size(species), stat, errmsg)) return
    if (.not. fits("diameters", diameters, size(species), options%diameters, stat, errmsg)) return
    status = create_c(model%handle(), size(species, kind=c_size_t), species - 1, positions, box, options, handle)
    if (status == lanescape_ok) call self%hold(handle, destroy_inserter_c)
    call conclude(status, stat, errmsg)
  end subroutine create

  ! Of the fluid; 0 without one.
  integer function particles(self)
    class(lanescape_inserter), intent(in) :: self
    integer(c_size_t) :: count
    particles = 0
    if (particles_c(self%handle(), count) == lanescape_ok) particles = int(count)
  end function particles

  ! What the fluid's energy would rise by with a particle there, and the force on it.
  subroutine energy(self, position, value, force, stat, errmsg)
    class(lanescape_inserter), intent(in) :: self
    real(dp), intent(in) :: position(3)
    real(dp), intent(inout) :: value
    real(dp), intent(inout), optional, target :: force(3)
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    type(c_ptr) :: address
    address = c_null_ptr
    if (present(force)) address = c_loc(force(1))
    call conclude(energy_c(self%handle(), position, value, address), stat, errmsg)
  end subroutine energy

  ! As many independent searches as `inserted` has elements, in the fluid as it is. region: low and high corner, (3, 2).
  subroutine find(self, settings, inserted, region, stat, errmsg)
    class(lanescape_inserter), intent(inout) :: self
    type(lanescape_insertion_settings), intent(in) :: settings
    type(lanescape_inserted), intent(out) :: inserted(:)
    real(dp), intent(in), optional, target :: region(3, 2)
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    call search(self, find_c, settings, inserted, region, stat, errmsg)
  end subroutine find

  ! Inserts as many particles one after the other; each becomes part of the fluid.
  subroutine insert(self, settings, inserted, region, stat, errmsg)
    class(lanescape_inserter), intent(inout) :: self
    type(lanescape_insertion_settings), intent(in) :: settings
    type(lanescape_inserted), intent(out) :: inserted(:)
    real(dp), intent(in), optional, target :: region(3, 2)
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    call search(self, insert_c, settings, inserted, region, stat, errmsg)
  end subroutine insert

  subroutine search(self, how, settings, inserted, region, stat, errmsg)
    class(lanescape_inserter), intent(inout) :: self
    procedure(search_c) :: how
    type(lanescape_insertion_settings), intent(in) :: settings
    type(lanescape_inserted), intent(inout) :: inserted(:)
    real(dp), intent(in), optional, target :: region(3, 2)
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    type(settings_c) :: s
    type(insertions_c) :: out
    character(kind=c_char), allocatable, target :: measure_chars(:), method_chars(:)
    integer(c_int), target :: found(size(inserted) + 1)
    real(dp), target :: positions(3, size(inserted) + 1), energies(size(inserted) + 1), errors(size(inserted) + 1)
    integer(c_int64_t), target :: evaluations(size(inserted) + 1), trials(size(inserted) + 1)
    integer(c_int) :: status
    integer :: k
    status = settings_init_c(s, c_sizeof(s))
    s%energy = settings%energy
    if (.not. abs(settings%tolerance) <= 0) s%tolerance = settings%tolerance
    if (settings%measure /= "") call optional_word(settings%measure, measure_chars, s%measure)
    if (settings%method /= "") call optional_word(settings%method, method_chars, s%method)
    if (.not. abs(settings%largest_step) <= 0) s%largest_step = settings%largest_step
    if (settings%most_trials /= 0) s%most_trials = settings%most_trials
    s%seed = settings%seed
    s%threads = settings%threads
    if (present(region)) s%region = c_loc(region(1, 1))
    out = insertions_c(c_sizeof(out), c_loc(found(1)), c_loc(positions(1, 1)), c_loc(energies(1)), c_loc(errors(1)), &
      c_loc(evaluations(1)), c_loc(trials(1)))
    status = how(self%handle(), s, size(inserted, kind=c_size_t), out)
    do k = 1, merge(size(inserted), 0, status == lanescape_ok)
      inserted(k) = lanescape_inserted(found(k) /= 0, positions(:, k), energies(k), errors(k), evaluations(k), trials(k))
    end do
    call conclude(status, stat, errmsg)
  end subroutine search

  ! Puts a particle there.
  subroutine add(self, position, stat, errmsg)
    class(lanescape_inserter), intent(inout) :: self
    real(dp), intent(in) :: position(3)
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    call conclude(add_c(self%handle(), position), stat, errmsg)
  end subroutine add

  ! Takes a particle away; whether there was one, to the bit once wrapped.
  subroutine remove(self, position, removed, stat, errmsg)
    class(lanescape_inserter), intent(inout) :: self
    real(dp), intent(in) :: position(3)
    logical, intent(out) :: removed
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    integer(c_int) :: was_there
    was_there = 0
    call conclude(remove_c(self%handle(), position, was_there), stat, errmsg)
    removed = was_there /= 0
  end subroutine remove
end module lanescape_insertion
