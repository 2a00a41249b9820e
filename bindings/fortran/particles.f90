! Neighbour pairs, overlaps of hard spheres, and insertion.
module lanescape_particles
  use, intrinsic :: iso_c_binding
  use lanescape_objects
  use lanescape_models, only: lanescape_model
  implicit none
  private

  ! Finds pairs within a cutoff, with ASE's conventions (neighbor_list("ijSDd")).
  type, extends(lanescape_object), public :: lanescape_neighbours
  contains
    procedure, private :: create_with_cutoff
    procedure, private :: create_with_cutoffs
    generic :: create => create_with_cutoff, create_with_cutoffs
    procedure :: exclude
    procedure :: find => find_pairs
    procedure :: set_particles
    procedure :: find_around
  end type lanescape_neighbours

  ! A particle's own images are among the pairs.
  type, public :: lanescape_pairs
    integer, allocatable :: first(:), second(:)  ! i and j, from 1
    integer, allocatable :: shift(:, :)          ! (3, pairs), whole boxes, for the positions as they were given
    real(dp), allocatable :: separation(:, :)    ! (3, pairs), r_j - r_i + shift * box
    real(dp), allocatable :: distance(:)
  end type lanescape_pairs

  ! Overlaps of hard spheres. Touching is not overlapping.
  type, extends(lanescape_object), public :: lanescape_hard_spheres
    integer, private :: particles = 0
  contains
    procedure :: create => create_spheres
    procedure :: any_overlap
    procedure :: overlaps
    procedure :: smallest_gap
  end type lanescape_hard_spheres

  ! All overlapping pairs, first < second, in rising order.
  type, public :: lanescape_overlaps
    integer, allocatable :: first(:), second(:)  ! from 1
    real(dp), allocatable :: gap(:)              ! distance minus the sum of radii, below 0
  end type lanescape_overlaps

  ! Structs, with their members in the header's order.
  type, bind(c) :: neighbour_options_c
    integer(c_size_t) :: size = 0
    real(c_double) :: cutoff = 0
    integer(c_size_t) :: species = 0
    type(c_ptr) :: cutoffs = c_null_ptr
    integer(c_int) :: periodic(3) = 1
    real(c_double) :: origin(3) = 0
    integer(c_int) :: half = 0, sorted = 1, shifts = 1, separations = 1, distances = 1, segments = 0, threads = 1
    type(c_ptr) :: instruction_set = c_null_ptr
  end type neighbour_options_c

  type, bind(c) :: neighbour_pairs_c
    integer(c_size_t) :: size = 0, count = 0
    type(c_ptr) :: first = c_null_ptr, second = c_null_ptr, shift = c_null_ptr, separation = c_null_ptr, distance = c_null_ptr
    type(c_ptr) :: segments = c_null_ptr
  end type neighbour_pairs_c

  type, bind(c) :: hard_sphere_options_c
    integer(c_size_t) :: size = 0
    type(c_ptr) :: instruction_set = c_null_ptr
    real(c_double) :: skin = 0
  end type hard_sphere_options_c

  type, bind(c) :: overlaps_c
    integer(c_size_t) :: size = 0, count = 0
    type(c_ptr) :: first = c_null_ptr, second = c_null_ptr, gap = c_null_ptr
  end type overlaps_c

  interface
    integer(c_int) function neighbour_options_init_c(options, size) bind(c, name="lanescape_neighbour_options_init")
      import
      type(neighbour_options_c), intent(inout) :: options
      integer(c_size_t), value :: size
    end function neighbour_options_init_c
    integer(c_int) function neighbours_create_c(options, neighbours) bind(c, name="lanescape_neighbours_create")
      import
      type(neighbour_options_c), intent(in) :: options
      type(c_ptr), intent(inout) :: neighbours
    end function neighbours_create_c
    integer(c_int) function neighbours_exclude_c(neighbours, pairs, particles) bind(c, name="lanescape_neighbours_exclude")
      import
      type(c_ptr), value :: neighbours
      integer(c_size_t), value :: pairs
      integer(c_int64_t), intent(in) :: particles(*)
    end function neighbours_exclude_c
    integer(c_int) function neighbours_find_c(neighbours, particles, positions, box, species, pairs) &
      bind(c, name="lanescape_neighbours_find")
      import
      type(c_ptr), value :: neighbours, species
      integer(c_size_t), value :: particles
      real(c_double), intent(in) :: positions(*), box(3)
      type(neighbour_pairs_c), intent(inout) :: pairs
    end function neighbours_find_c
    integer(c_int) function set_particles_c(neighbours, particles, positions, box, species) &
      bind(c, name="lanescape_neighbours_set_particles")
      import
      type(c_ptr), value :: neighbours, species
      integer(c_size_t), value :: particles
      real(c_double), intent(in) :: positions(*), box(3)
    end function set_particles_c
    integer(c_int) function of_points_c(neighbours, points, positions, species, pairs) &
      bind(c, name="lanescape_neighbours_of_points")
      import
      type(c_ptr), value :: neighbours, species
      integer(c_size_t), value :: points
      real(c_double), intent(in) :: positions(*)
      type(neighbour_pairs_c), intent(inout) :: pairs
    end function of_points_c
    integer(c_int) function neighbours_destroy_c(handle) bind(c, name="lanescape_neighbours_destroy")
      import
      type(c_ptr), value :: handle
    end function neighbours_destroy_c
    integer(c_int) function hard_spheres_create_c(particles, radii, box, options, spheres) &
      bind(c, name="lanescape_hard_spheres_create")
      import
      integer(c_size_t), value :: particles
      real(c_double), intent(in) :: radii(*), box(3)
      type(hard_sphere_options_c), intent(in) :: options
      type(c_ptr), intent(inout) :: spheres
    end function hard_spheres_create_c
    integer(c_int) function hard_spheres_any_overlap_c(spheres, positions, any) &
      bind(c, name="lanescape_hard_spheres_any_overlap")
      import
      type(c_ptr), value :: spheres
      real(c_double), intent(in) :: positions(*)
      integer(c_int), intent(inout) :: any
    end function hard_spheres_any_overlap_c
    integer(c_int) function hard_spheres_overlaps_c(spheres, positions, overlaps) bind(c, name="lanescape_hard_spheres_overlaps")
      import
      type(c_ptr), value :: spheres
      real(c_double), intent(in) :: positions(*)
      type(overlaps_c), intent(inout) :: overlaps
    end function hard_spheres_overlaps_c
    integer(c_int) function hard_spheres_smallest_gap_c(spheres, positions, gap) &
      bind(c, name="lanescape_hard_spheres_smallest_gap")
      import
      type(c_ptr), value :: spheres
      real(c_double), intent(in) :: positions(*)
      real(c_double), intent(inout) :: gap
    end function hard_spheres_smallest_gap_c
    integer(c_int) function hard_spheres_destroy_c(handle) bind(c, name="lanescape_hard_spheres_destroy")
      import
      type(c_ptr), value :: handle
    end function hard_spheres_destroy_c
  end interface

contains

  ! periodic: axes, all without it; boxes have no meaning along others. half: of (i, j) and (j, i) the one with j > i only. sorted: by
  ! particles and shift, which is so without it. origin: the box's corner.
  subroutine create_with_cutoff(self, cutoff, periodic, half, sorted, threads, instruction_set, origin, stat, errmsg)
    class(lanescape_neighbours), intent(inout) :: self
    real(dp), intent(in) :: cutoff
    logical, intent(in), optional :: periodic(3), half, sorted
    integer, intent(in), optional :: threads
    character(*), intent(in), optional :: instruction_set
    real(dp), intent(in), optional :: origin(3)
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    real(dp) :: cutoffs(1, 1)
    cutoffs = cutoff
    call create_with_cutoffs(self, cutoffs, periodic, half, sorted, threads, instruction_set, origin, stat, errmsg)
  end subroutine create_with_cutoff

  ! Cutoffs (species, species), symmetric; pairs of cutoff 0 are never listed.
  subroutine create_with_cutoffs(self, cutoffs, periodic, half, sorted, threads, instruction_set, origin, stat, errmsg)
    class(lanescape_neighbours), intent(inout) :: self
    real(dp), intent(in), target, contiguous :: cutoffs(:, :)
    logical, intent(in), optional :: periodic(3), half, sorted
    integer, intent(in), optional :: threads
    character(*), intent(in), optional :: instruction_set
    real(dp), intent(in), optional :: origin(3)
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    type(neighbour_options_c) :: options
    character(kind=c_char), allocatable, target :: set_chars(:)
    type(c_ptr) :: handle
    integer(c_int) :: status
    if (size(cutoffs, 1) /= size(cutoffs, 2) .or. size(cutoffs) == 0) then
      call refuse("cutoffs must be (S, S) for S species, at least one", stat, errmsg)
      return
    end if
    status = neighbour_options_init_c(options, c_sizeof(options))
    options%species = size(cutoffs, 1)
    options%cutoffs = c_loc(cutoffs(1, 1))
    if (present(periodic)) options%periodic = merge(1, 0, periodic)
    if (present(half)) options%half = merge(1, 0, half)
    if (present(sorted)) options%sorted = merge(1, 0, sorted)
    if (present(threads)) options%threads = threads
    if (present(origin)) options%origin = origin
    call optional_word(instruction_set, set_chars, options%instruction_set)
    status = neighbours_create_c(options, handle)
    if (status == lanescape_ok) call self%hold(handle, neighbours_destroy_c)
    call conclude(status, stat, errmsg)
  end subroutine create_with_cutoffs

  ! Pairs of particles, (2, pairs), that are never listed, such as bonded ones, in place of those before.
  subroutine exclude(self, pairs, stat, errmsg)
    class(lanescape_neighbours), intent(inout) :: self
    integer, intent(in) :: pairs(:, :)
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    if (size(pairs, 1) /= 2) then
      call refuse("pairs must be (2, number of pairs)", stat, errmsg)
      return
    end if
    call conclude(neighbours_exclude_c(self%handle(), size(pairs, 2, kind=c_size_t), int(pairs - 1, c_int64_t)), stat, errmsg)
  end subroutine exclude

  ! Positions (3, N); box: edge lengths; species from 1, where there are several cutoffs.
  subroutine find_pairs(self, positions, box, pairs, species, stat, errmsg)
    class(lanescape_neighbours), intent(inout) :: self
    real(dp), intent(in), contiguous :: positions(:, :)
    real(dp), intent(in) :: box(3)
    type(lanescape_pairs), intent(out) :: pairs
    integer, intent(in), optional :: species(:)
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    type(neighbour_pairs_c) :: found
    integer(c_int), allocatable, target :: kept(:)
    type(c_ptr) :: address
    integer(c_int) :: status
    if (.not. check_shape("positions", positions, size(positions, 2), stat, errmsg)) return
    if (.not. from_zero(species, size(positions, 2), kept, address, stat, errmsg)) return
    found%size = c_sizeof(found)
    status = neighbours_find_c(self%handle(), size(positions, 2, kind=c_size_t), positions, box, address, found)
    if (status == lanescape_ok) call copy_pairs(found, pairs)
    call conclude(status, stat, errmsg)
  end subroutine find_pairs

  ! Prepares the search around other points, by find_around, among these particles; arguments as those of find.
  subroutine set_particles(self, positions, box, species, stat, errmsg)
    class(lanescape_neighbours), intent(inout) :: self
    real(dp), intent(in), contiguous :: positions(:, :)
    real(dp), intent(in) :: box(3)
    integer, intent(in), optional :: species(:)
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    integer(c_int), allocatable, target :: kept(:)
    type(c_ptr) :: address
    if (.not. check_shape("positions", positions, size(positions, 2), stat, errmsg)) return
    if (.not. from_zero(species, size(positions, 2), kept, address, stat, errmsg)) return
    call conclude(set_particles_c(self%handle(), size(positions, 2, kind=c_size_t), positions, box, address), stat, errmsg)
  end subroutine set_particles

  ! The particles within the cutoff of each point, (3, points), all of them: pairs%first numbers the points, pairs%second the
  ! particles.
  subroutine find_around(self, points, pairs, species, stat, errmsg)
    class(lanescape_neighbours), intent(inout) :: self
    real(dp), intent(in), contiguous :: points(:, :)
    type(lanescape_pairs), intent(out) :: pairs
    integer, intent(in), optional :: species(:)
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    type(neighbour_pairs_c) :: found
    integer(c_int), allocatable, target :: kept(:)
    type(c_ptr) :: address
    integer(c_int) :: status
    if (.not. check_shape("points", points, size(points, 2), stat, errmsg)) return
    if (.not. from_zero(species, size(points, 2), kept, address, stat, errmsg)) return
    found%size = c_sizeof(found)
    status = of_points_c(self%handle(), size(points, 2, kind=c_size_t), points, address, found)
    if (status == lanescape_ok) call copy_pairs(found, pairs)
    call conclude(status, stat, errmsg)
  end subroutine find_around

  subroutine copy_pairs(found, pairs)
    type(neighbour_pairs_c), intent(in) :: found
    type(lanescape_pairs), intent(out) :: pairs
    integer(c_int32_t), pointer :: shift(:, :)
    real(dp), pointer :: separation(:, :)
    pairs%first = particles_at(found%first, found%count)
    pairs%second = particles_at(found%second, found%count)
    pairs%distance = numbers_at(found%distance, found%count)
    allocate (pairs%shift(3, found%count), pairs%separation(3, found%count))
    if (found%count == 0) return
    call c_f_pointer(found%shift, shift, [3_c_size_t, found%count])
    call c_f_pointer(found%separation, separation, [3_c_size_t, found%count])
    pairs%shift = shift
    pairs%separation = separation
  end subroutine copy_pairs

  ! Numbers of particles, which the library counts from 0.
  function particles_at(address, count) result(particles)
    type(c_ptr), intent(in) :: address
    integer(c_size_t), intent(in) :: count
    integer, allocatable :: particles(:)
    integer(c_int64_t), pointer :: from_zero(:)
    allocate (particles(count))
    if (count == 0) return
    call c_f_pointer(address, from_zero, [count])
    particles = int(from_zero) + 1
  end function particles_at

  function numbers_at(address, count) result(numbers)
    type(c_ptr), intent(in) :: address
    integer(c_size_t), intent(in) :: count
    real(dp), allocatable :: numbers(:)
    real(dp), pointer :: there(:)
    allocate (numbers(count))
    if (count == 0) return
    call c_f_pointer(address, there, [count])
    numbers = there
  end function numbers_at

  ! skin: above 0, any_overlap keeps a list of pairs for configurations that follow each other in small steps.
  subroutine create_spheres(self, radii, box, skin, instruction_set, stat, errmsg)
    class(lanescape_hard_spheres), intent(inout) :: self
    real(dp), intent(in), contiguous :: radii(:)
    real(dp), intent(in) :: box(3)
    real(dp), intent(in), optional :: skin
    character(*), intent(in), optional :: instruction_set
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    type(hard_sphere_options_c) :: options
    character(kind=c_char), allocatable, target :: set_chars(:)
    type(c_ptr) :: handle
    integer(c_int) :: status
    options%size = c_sizeof(options)
    if (present(skin)) options%skin = skin
    call optional_word(instruction_set, set_chars, options%instruction_set)
    status = hard_spheres_create_c(size(radii, kind=c_size_t), radii, box, options, handle)
    if (status == lanescape_ok) then
      call self%hold(handle, hard_spheres_destroy_c)
      self%particles = size(radii)
    end if
    call conclude(status, stat, errmsg)
  end subroutine create_spheres

  subroutine any_overlap(self, positions, any, stat, errmsg)
    class(lanescape_hard_spheres), intent(inout) :: self
    real(dp), intent(in), contiguous :: positions(:, :)
    logical, intent(out) :: any
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    integer(c_int) :: found
    any = .false.
    if (.not. check_shape("positions", positions, self%particles, stat, errmsg)) return
    found = 0
    call conclude(hard_spheres_any_overlap_c(self%handle(), positions, found), stat, errmsg)
    any = found /= 0
  end subroutine any_overlap

  subroutine overlaps(self, positions, pairs, stat, errmsg)
    class(lanescape_hard_spheres), intent(inout) :: self
    real(dp), intent(in), contiguous :: positions(:, :)
    type(lanescape_overlaps), intent(out) :: pairs
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    type(overlaps_c) :: found
    integer(c_int) :: status
    if (.not. check_shape("positions", positions, self%particles, stat, errmsg)) return
    found%size = c_sizeof(found)
    status = hard_spheres_overlaps_c(self%handle(), positions, found)
    if (status == lanescape_ok) then
      pairs%first = particles_at(found%first, found%count)
      pairs%second = particles_at(found%second, found%count)
      pairs%gap = numbers_at(found%gap, found%count)
    end if
    call conclude(status, stat, errmsg)
  end subroutine overlaps

  ! The smallest distance minus sum of radii; infinity for a single sphere.
  subroutine smallest_gap(self, positions, gap, stat, errmsg)
    class(lanescape_hard_spheres), intent(inout) :: self
    real(dp), intent(in), contiguous :: positions(:, :)
    real(dp), intent(out) :: gap
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    gap = 0
    if (.not. check_shape("positions", positions, self%particles, stat, errmsg)) return
    call conclude(hard_spheres_smallest_gap_c(self%handle(), positions, gap), stat, errmsg)
  end subroutine smallest_gap
end module lanescape_particles
