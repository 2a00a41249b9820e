! Paths as short as they can be, and the certificate of any path, on models and on landscapes of the program's own.
module lanescape_short_paths
  use, intrinsic :: iso_c_binding
  use lanescape_objects
  use lanescape_models, only: lanescape_model
  use lanescape_landscapes
  use lanescape_progress_reports
  use lanescape_paths, only: lanescape_path_settings, path_settings_c, translate_path_settings
  implicit none
  private

  ! How a path is shortened. The frames of the search have no effect, its reverse must be false, and its progress is that of all.
  type, public :: lanescape_shorten_settings
    character(16) :: method = ""                   ! curve or montecarlo; blank: the library's own choice
    integer(c_int64_t) :: starts = 1, seed = 1     ! independent runs with other random numbers, of which the shortest path is kept
    type(lanescape_path_settings) :: search        ! how the path to start from and those in between are found
  end type lanescape_shorten_settings

  ! A path in the allowed region, as short as a method made it.
  type, extends(lanescape_object), public :: lanescape_short_path
    character(:), allocatable :: outcome, reason  ! reached, step_limit, stalled, interrupted; why it is not reached
    logical :: reached = .false.
    real(dp) :: length_before = 0, length = 0, distance = 0, ratio_squared = 0, landscape_energy = 0, largest_violation = 0
    ! The first two as in lanescape_path_certificate, not allocated where the frames are only some points of the path.
    real(dp), allocatable :: kuhn_tucker_residual, multipliers(:), start_lengths(:)  ! of the path that each start found
    integer(c_int64_t) :: evaluations = 0         ! that found the path, not those of trials that failed
    real(dp) :: seconds = 0
    integer :: particles = 0, frames = 0          ! frames: ends included
  contains
    procedure :: shorten => shorten_on_model
    procedure :: shorten_on => shorten_on_landscape
    procedure :: frame
  end type lanescape_short_path

  ! How far a path leaves the allowed region, and how far it is from the Kuhn-Tucker condition of a shortest one. A small residual
  ! shows that it is stationary, not that no other is shorter.
  type, public :: lanescape_path_certificate
    real(dp) :: length = 0, distance = 0, ratio_squared = 0, landscape_energy = 0, largest_violation = 0, kuhn_tucker_residual = 0
    real(dp), allocatable :: multipliers(:)        ! of each frame; of hard spheres the sum over contacts
    real(dp), allocatable :: excess(:)             ! of each frame: V - E_L; of hard spheres the smallest gap
    real(dp), allocatable :: segment_violation(:)  ! of each segment: the largest V - E_L; of hard spheres minus the smallest gap
  contains
    procedure :: check => check_on_model
    procedure :: check_on => check_on_landscape
  end type lanescape_path_certificate

  ! Structs, with their members in the header's order.
  type, bind(c) :: shorten_settings_c
    integer(c_size_t) :: size = 0
    type(c_ptr) :: method = c_null_ptr
    integer(c_int64_t) :: starts = 1, seed = 1
    type(c_ptr) :: search = c_null_ptr
  end type shorten_settings_c

  type, bind(c) :: short_summary_c
    integer(c_size_t) :: size = 0
    type(c_ptr) :: outcome = c_null_ptr, reason = c_null_ptr
    real(c_double) :: length_before = 0, length = 0, distance = 0, ratio_squared = 0, landscape_energy = 0
    real(c_double) :: largest_violation = 0, kuhn_tucker_residual = 0
    integer(c_int64_t) :: evaluations = 0
    real(c_double) :: seconds = 0
    integer(c_size_t) :: particles = 0, frames = 0, starts = 0
    integer(c_int) :: reached = 0, has_multipliers = 0
  end type short_summary_c

  type, bind(c) :: check_settings_c
    integer(c_size_t) :: size = 0
    type(c_ptr) :: landscape_energy = c_null_ptr
    integer(c_int) :: threads = 1
    type(c_ptr) :: instruction_set = c_null_ptr
  end type check_settings_c

  type, bind(c) :: certificate_c
    integer(c_size_t) :: size = 0
    real(c_double) :: length = 0, distance = 0, ratio_squared = 0, landscape_energy = 0, largest_violation = 0
    real(c_double) :: kuhn_tucker_residual = 0
    type(c_ptr) :: multipliers = c_null_ptr, excess = c_null_ptr, segment_violation = c_null_ptr
  end type certificate_c

  interface
    integer(c_int) function shorten_settings_init_c(settings, size) bind(c, name="lanescape_shorten_settings_init")
      import
      type(shorten_settings_c), intent(inout) :: settings
      integer(c_size_t), value :: size
    end function shorten_settings_init_c
    integer(c_int) function shorten_path_c(model, particles, species, box, start, finish, diameters, frames, positions, settings, &
                                           path) bind(c, name="lanescape_shorten_path")
      import
      type(c_ptr), value :: model, diameters, positions
      integer(c_size_t), value :: particles, frames
      integer(c_int), intent(in) :: species(*)
      real(c_double), intent(in) :: box(3), start(*), finish(*)
      type(shorten_settings_c), intent(in) :: settings
      type(c_ptr), intent(inout) :: path
    end function shorten_path_c
    integer(c_int) function shorten_path_on_c(landscape, start, finish, masses, frames, positions, settings, path) &
      bind(c, name="lanescape_shorten_path_on")
      import
      type(landscape_c), intent(in) :: landscape
      real(c_double), intent(in) :: start(*), finish(*)
      type(c_ptr), value :: masses, positions
      integer(c_size_t), value :: frames
      type(shorten_settings_c), intent(in) :: settings
      type(c_ptr), intent(inout) :: path
    end function shorten_path_on_c
    integer(c_int) function summarise_short_c(path, summary) bind(c, name="lanescape_short_path_summarise")
      import
      type(c_ptr), value :: path
      type(short_summary_c), intent(inout) :: summary
    end function summarise_short_c
    integer(c_int) function short_values_c(path, multipliers, start_lengths) bind(c, name="lanescape_short_path_values")
      import
      type(c_ptr), value :: path, multipliers, start_lengths
    end function short_values_c
    integer(c_int) function short_frame_c(path, frame, positions) bind(c, name="lanescape_short_path_frame")
      import
      type(c_ptr), value :: path
      integer(c_size_t), value :: frame
      real(c_double), intent(inout) :: positions(*)
    end function short_frame_c
    integer(c_int) function short_path_destroy_c(handle) bind(c, name="lanescape_short_path_destroy")
      import
      type(c_ptr), value :: handle
    end function short_path_destroy_c
    integer(c_int) function check_settings_init_c(settings, size) bind(c, name="lanescape_check_settings_init")
      import
      type(check_settings_c), intent(inout) :: settings
      integer(c_size_t), value :: size
    end function check_settings_init_c
    integer(c_int) function check_path_c(model, particles, species, box, diameters, frames, positions, settings, certificate) &
      bind(c, name="lanescape_check_path")
      import
      type(c_ptr), value :: model, diameters
      integer(c_size_t), value :: particles, frames
      integer(c_int), intent(in) :: species(*)
      real(c_double), intent(in) :: box(3), positions(*)
      type(check_settings_c), intent(in) :: settings
      type(certificate_c), intent(inout) :: certificate
    end function check_path_c
    integer(c_int) function check_path_on_c(landscape, masses, frames, positions, settings, certificate) &
      bind(c, name="lanescape_check_path_on")
      import
      type(landscape_c), intent(in) :: landscape
      type(c_ptr), value :: masses
      integer(c_size_t), value :: frames
      real(c_double), intent(in) :: positions(*)
      type(check_settings_c), intent(in) :: settings
      type(certificate_c), intent(inout) :: certificate
    end function check_path_on_c
  end interface

contains

  ! Between two configurations of a model, as lanescape_path%find takes them. path: the one to shorten, (3, N, frames), at least
  ! three, which begin and end at the two ends in either order and are allowed; without it the one that the search finds.
  subroutine shorten_on_model(self, model, species, box, start, finish, path, settings, diameters, stat, errmsg)
    class(lanescape_short_path), intent(inout) :: self
    class(lanescape_model), intent(in) :: model
    integer, intent(in) :: species(:)
    real(dp), intent(in) :: box(3)
    real(dp), intent(in), contiguous :: start(:, :), finish(:, :)
    real(dp), intent(in), optional, target, contiguous :: path(:, :, :)
    type(lanescape_shorten_settings), intent(in), optional, target :: settings
    real(dp), intent(in), optional, target, contiguous :: diameters(:)
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    type(host_progress), target :: progress
    character(kind=c_char), allocatable, target :: chars(:, :), words(:)
    type(path_settings_c), target :: search
    type(shorten_settings_c) :: s
    type(c_ptr) :: sizes, positions, handle
    integer(c_size_t) :: frames
    integer(c_int) :: status
    if (.not. check_shape("start", start, size(species), stat, errmsg)) return
    if (.not. check_shape("finish", finish, size(species), stat, errmsg)) return
    if (.not. check_frames(size(species), positions, frames, path, stat, errmsg)) return
    if (.not. fits("diameters", diameters, size(species), sizes, stat, errmsg)) return
    call translate(settings, progress, search, s, chars, words)
    status = shorten_path_c(model%handle(), size(species, kind=c_size_t), species - 1, box, start, finish, sizes, frames, &
      positions, s, handle)
    call keep(self, status, handle, stat, errmsg)
  end subroutine shorten_on_model

  ! On a landscape of the program's own; masses: of each particle, without them equal.
  subroutine shorten_on_landscape(self, landscape, start, finish, path, settings, masses, stat, errmsg)
    class(lanescape_short_path), intent(inout) :: self
    procedure(lanescape_landscape) :: landscape
    real(dp), intent(in), contiguous :: start(:, :), finish(:, :)
    real(dp), intent(in), optional, target, contiguous :: path(:, :, :)
    type(lanescape_shorten_settings), intent(in), optional, target :: settings
    real(dp), intent(in), optional, target, contiguous :: masses(:)
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    type(host_landscape), target :: host
    type(host_progress), target :: progress
    character(kind=c_char), allocatable, target :: chars(:, :), words(:)
    type(path_settings_c), target :: search
    type(shorten_settings_c) :: s
    type(c_ptr) :: weights, positions, handle
    integer(c_size_t) :: frames
    integer(c_int) :: status
    host%evaluate => landscape
    host%particles = size(start, 2)
    if (.not. check_shape("start", start, host%particles, stat, errmsg)) return
    if (.not. check_shape("finish", finish, host%particles, stat, errmsg)) return
    if (.not. check_frames(host%particles, positions, frames, path, stat, errmsg)) return
    if (.not. fits("masses", masses, host%particles, weights, stat, errmsg)) return
    call translate(settings, progress, search, s, chars, words)
    status = shorten_path_on_c(landscape_of(host), start, finish, weights, frames, positions, s, handle)
    call keep(self, status, handle, stat, errmsg)
  end subroutine shorten_on_landscape

  ! The address and number of the frames of an optional path; if it is not (3, particles, frames), or has none, the call is refused.
  logical function check_frames(particles, address, frames, path, stat, errmsg)
    integer, intent(in) :: particles
    type(c_ptr), intent(out) :: address
    integer(c_size_t), intent(out) :: frames
    real(dp), intent(in), optional, target, contiguous :: path(:, :, :)
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    character(120) :: message
    address = c_null_ptr
    frames = 0
    check_frames = .true.
    if (.not. present(path)) return
    check_frames = size(path, 1) == 3 .and. size(path, 2) == particles .and. size(path, 3) > 0
    frames = size(path, 3, kind=c_size_t)
    if (check_frames .and. size(path) > 0) address = c_loc(path(1, 1, 1))
    if (check_frames) return
    write (message, '(3(a, i0), a, i0, a)') "path has the shape (", size(path, 1), ", ", size(path, 2), ", ", size(path, 3), &
      "): (3, ", particles, ", frames) is needed"
    call refuse(trim(message), stat, errmsg)
  end function check_frames

  ! Settings for C, whose words are in `chars` and `words`, and whose search and procedure are in `search` and `progress`.
  subroutine translate(settings, progress, search, s, chars, words)
    type(lanescape_shorten_settings), intent(in), optional, target :: settings
    type(host_progress), target, intent(inout) :: progress
    type(path_settings_c), target, intent(inout) :: search
    type(shorten_settings_c), intent(out) :: s
    character(kind=c_char), allocatable, target, intent(out) :: chars(:, :), words(:)
    if (shorten_settings_init_c(s, c_sizeof(s)) /= lanescape_ok .or. .not. present(settings)) return
    if (settings%method /= "") call optional_word(settings%method, words, s%method)
    s%starts = settings%starts
    s%seed = settings%seed
    call translate_path_settings(settings%search, progress, search, chars)
    s%search = c_loc(search)
  end subroutine translate

  ! Keeps a path that was found, and ends the call.
  subroutine keep(self, status, handle, stat, errmsg)
    class(lanescape_short_path), intent(inout) :: self
    integer(c_int), intent(in) :: status
    type(c_ptr), intent(in) :: handle
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    type(short_summary_c) :: s
    integer(c_int) :: ended
    ended = status
    if (status == lanescape_ok) then
      call self%hold(handle, short_path_destroy_c)
      s%size = c_sizeof(s)
      ended = summarise_short_c(handle, s)
      self%outcome = text_at(s%outcome)
      self%reason = text_at(s%reason)
      self%reached = s%reached /= 0
      self%length_before = s%length_before
      self%length = s%length
      self%distance = s%distance
      self%ratio_squared = s%ratio_squared
      self%landscape_energy = s%landscape_energy
      self%largest_violation = s%largest_violation
      self%evaluations = s%evaluations
      self%seconds = s%seconds
      self%particles = int(s%particles)
      self%frames = int(s%frames)
      if (ended == lanescape_ok) ended = keep_values(self, s)
    end if
    call conclude(ended, stat, errmsg)
  end subroutine keep

  integer(c_int) function keep_values(self, s)
    class(lanescape_short_path), intent(inout) :: self
    type(short_summary_c), intent(in) :: s
    real(dp), allocatable, target :: multipliers(:), lengths(:)
    type(c_ptr) :: to_multipliers, to_lengths
    to_multipliers = c_null_ptr
    to_lengths = c_null_ptr
    allocate (multipliers(s%frames), lengths(s%starts))
    if (s%has_multipliers /= 0) to_multipliers = c_loc(multipliers(1))
    if (s%starts > 0) to_lengths = c_loc(lengths(1))
    keep_values = short_values_c(self%handle(), to_multipliers, to_lengths)
    self%start_lengths = lengths
    if (allocated(self%multipliers)) deallocate (self%multipliers, self%kuhn_tucker_residual)
    if (s%has_multipliers == 0) return
    self%multipliers = multipliers
    self%kuhn_tucker_residual = s%kuhn_tucker_residual
  end function keep_values

  ! Positions (3, N) of one frame, from 1.
  subroutine frame(self, number, positions, stat, errmsg)
    class(lanescape_short_path), intent(in) :: self
    integer, intent(in) :: number
    real(dp), intent(inout), contiguous :: positions(:, :)
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    if (.not. check_shape("positions", positions, self%particles, stat, errmsg)) return
    call conclude(short_frame_c(self%handle(), int(number - 1, c_size_t), positions), stat, errmsg)
  end subroutine frame

  ! Of a path of a model, (3, N, frames), at least three frames, unwrapped; no two neighbouring ones are the same. species from 1.
  ! landscape_energy: E_L; without it the higher of the two ends. diameters: of each particle, for models that have them.
  subroutine check_on_model(self, model, species, box, path, landscape_energy, threads, diameters, stat, errmsg)
    class(lanescape_path_certificate), intent(inout) :: self
    class(lanescape_model), intent(in) :: model
    integer, intent(in) :: species(:)
    real(dp), intent(in) :: box(3)
    real(dp), intent(in), target, contiguous :: path(:, :, :)
    real(dp), intent(in), optional, target :: landscape_energy
    integer, intent(in), optional :: threads
    real(dp), intent(in), optional, target, contiguous :: diameters(:)
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    real(dp), allocatable, target :: values(:, :)
    type(check_settings_c) :: s
    type(certificate_c) :: certificate
    type(c_ptr) :: sizes, positions
    integer(c_size_t) :: frames
    integer(c_int) :: status
    if (.not. check_frames(size(species), positions, frames, path, stat, errmsg)) return
    if (.not. fits("diameters", diameters, size(species), sizes, stat, errmsg)) return
    call prepare(frames, landscape_energy, threads, s, certificate, values)
    status = check_path_c(model%handle(), size(species, kind=c_size_t), species - 1, box, sizes, frames, path, s, certificate)
    call keep_certificate(self, status, certificate, values, stat, errmsg)
  end subroutine check_on_model

  ! On a landscape of the program's own; masses: of each particle, without them equal.
  subroutine check_on_landscape(self, landscape, path, landscape_energy, masses, stat, errmsg)
    class(lanescape_path_certificate), intent(inout) :: self
    procedure(lanescape_landscape) :: landscape
    real(dp), intent(in), target, contiguous :: path(:, :, :)
    real(dp), intent(in), optional, target :: landscape_energy
    real(dp), intent(in), optional, target, contiguous :: masses(:)
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    type(host_landscape), target :: host
    real(dp), allocatable, target :: values(:, :)
    type(check_settings_c) :: s
    type(certificate_c) :: certificate
    type(c_ptr) :: weights, positions
    integer(c_size_t) :: frames
    integer(c_int) :: status
    host%evaluate => landscape
    host%particles = size(path, 2)
    if (.not. check_frames(host%particles, positions, frames, path, stat, errmsg)) return
    if (.not. fits("masses", masses, host%particles, weights, stat, errmsg)) return
    call prepare(frames, landscape_energy, s=s, certificate=certificate, values=values)
    status = check_path_on_c(landscape_of(host), weights, frames, path, s, certificate)
    call keep_certificate(self, status, certificate, values, stat, errmsg)
  end subroutine check_on_landscape

  ! Settings for C, and room for what a certificate says of each frame, a column for each kind of number.
  subroutine prepare(frames, landscape_energy, threads, s, certificate, values)
    integer(c_size_t), intent(in) :: frames
    real(dp), intent(in), optional, target :: landscape_energy
    integer, intent(in), optional :: threads
    type(check_settings_c), intent(out) :: s
    type(certificate_c), intent(out) :: certificate
    real(dp), allocatable, target, intent(out) :: values(:, :)
    if (check_settings_init_c(s, c_sizeof(s)) /= lanescape_ok) return
    if (present(landscape_energy)) s%landscape_energy = c_loc(landscape_energy)
    if (present(threads)) s%threads = threads
    allocate (values(frames, 3))
    certificate%size = c_sizeof(certificate)
    certificate%multipliers = c_loc(values(1, 1))
    certificate%excess = c_loc(values(1, 2))
    certificate%segment_violation = c_loc(values(1, 3))
  end subroutine prepare

  subroutine keep_certificate(self, status, certificate, values, stat, errmsg)
    class(lanescape_path_certificate), intent(inout) :: self
    integer(c_int), intent(in) :: status
    type(certificate_c), intent(in) :: certificate
    real(dp), intent(in) :: values(:, :)
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    if (status == lanescape_ok) then
      self%length = certificate%length
      self%distance = certificate%distance
      self%ratio_squared = certificate%ratio_squared
      self%landscape_energy = certificate%landscape_energy
      self%largest_violation = certificate%largest_violation
      self%kuhn_tucker_residual = certificate%kuhn_tucker_residual
      self%multipliers = values(:, 1)
      self%excess = values(:, 2)
      self%segment_violation = values(:size(values, 1) - 1, 3)
    end if
    call conclude(status, stat, errmsg)
  end subroutine keep_certificate
end module lanescape_short_paths
