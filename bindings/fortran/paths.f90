! Paths on models and on landscapes of the program's own.
module lanescape_paths
  use, intrinsic :: iso_c_binding
  use lanescape_objects
  use lanescape_models, only: lanescape_model
  use lanescape_landscapes
  use lanescape_progress_reports
  implicit none
  private
  public :: translate_path_settings

  ! How a path is searched; 0 and blanks stand for the library's own choice.
  type, public :: lanescape_path_settings
    character(16) :: method = ""                   ! contour or escape (soft), avoidance or away (hard spheres)
    logical :: adaptive = .false.                  ! contour: steps as long as their error allows; avoidance: slides along contacts
    real(dp) :: step = 0, avoidance_step = 0       ! length of a direct step in 3N space; of each sphere that an avoidance step moves
    character(16) :: fictitious = ""               ! force between overlapping spheres: harmonic, linear, cubic
    real(dp), allocatable :: landscape_energy      ! E_L; not allocated: the higher of the two ends
    logical :: reverse = .false.                   ! search from the far end too and keep the shorter path
    integer(c_int64_t) :: max_steps = 0, patience = 0
    integer :: frames = -1                         ! configurations kept between the two ends; below 0: the library's own choice
    integer :: threads = 1
    character(16) :: precision = "", instruction_set = ""
    procedure(lanescape_progress), pointer, nopass :: progress => null()
  end type lanescape_path_settings

  ! A path that never leaves the allowed region: V(R) <= E_L, or no overlaps.
  type, extends(lanescape_object), public :: lanescape_path
    character(:), allocatable :: outcome, reason  ! reached, step_limit, stalled, interrupted; why it did not reach its goal
    logical :: reached = .false., reversed = .false.
    real(dp) :: length = 0, distance = 0, ratio_squared = 0, participation_ratio = 0
    integer(c_int64_t) :: direct_steps = 0, detour_steps = 0, evaluations = 0
    real(dp) :: landscape_energy = 0, largest_violation = 0, seconds = 0
    integer :: particles = 0, frames = 0  ! frames: ends included
  contains
    procedure :: find => find_on_model
    procedure :: find_on => find_on_landscape
    procedure :: frame
  end type lanescape_path

  ! Structs, with their members in the header's order.
  type, bind(c), public :: path_settings_c
    integer(c_size_t) :: size = 0
    type(c_ptr) :: method = c_null_ptr
    real(c_double) :: step = 0, avoidance_step = 0
    type(c_ptr) :: fictitious = c_null_ptr, landscape_energy = c_null_ptr
    integer(c_int) :: reverse = 0
    integer(c_int64_t) :: max_steps = 0, patience = 0
    integer(c_size_t) :: frames = 0
    integer(c_int) :: threads = 1
    type(c_ptr) :: precision = c_null_ptr, instruction_set = c_null_ptr
    type(c_funptr) :: progress = c_null_funptr
    type(c_ptr) :: progress_user = c_null_ptr
    integer(c_int) :: adaptive = 0
  end type path_settings_c

  type, bind(c) :: summary_c
    integer(c_size_t) :: size = 0
    type(c_ptr) :: outcome = c_null_ptr, reason = c_null_ptr
    real(c_double) :: length = 0, distance = 0, ratio_squared = 0, participation_ratio = 0
    integer(c_int64_t) :: direct_steps = 0, detour_steps = 0, evaluations = 0
    real(c_double) :: landscape_energy = 0, largest_violation = 0, seconds = 0
    integer(c_size_t) :: particles = 0, frames = 0
    integer(c_int) :: reached = 0, reversed = 0
  end type summary_c

  interface
    integer(c_int) function settings_init_c(settings, size) bind(c, name="lanescape_path_settings_init")
      import
      type(path_settings_c), intent(inout) :: settings
      integer(c_size_t), value :: size
    end function settings_init_c
    integer(c_int) function find_path_c(model, particles, species, box, start, finish, diameters, settings, path) &
      bind(c, name="lanescape_find_path")
      import
      type(c_ptr), value :: model, diameters
      integer(c_size_t), value :: particles
      integer(c_int), intent(in) :: species(*)
      real(c_double), intent(in) :: box(3), start(*), finish(*)
      type(path_settings_c), intent(in) :: settings
      type(c_ptr), intent(inout) :: path
    end function find_path_c
    integer(c_int) function find_path_on_c(landscape, start, finish, masses, settings, path) bind(c, name="lanescape_find_path_on")
      import
      type(landscape_c), intent(in) :: landscape
      real(c_double), intent(in) :: start(*), finish(*)
      type(c_ptr), value :: masses
      type(path_settings_c), intent(in) :: settings
      type(c_ptr), intent(inout) :: path
    end function find_path_on_c
    integer(c_int) function summarise_c(path, summary) bind(c, name="lanescape_path_summarise")
      import
      type(c_ptr), value :: path
      type(summary_c), intent(inout) :: summary
    end function summarise_c
    integer(c_int) function frame_c(path, frame, positions) bind(c, name="lanescape_path_frame")
      import
      type(c_ptr), value :: path
      integer(c_size_t), value :: frame
      real(c_double), intent(inout) :: positions(*)
    end function frame_c
    integer(c_int) function path_destroy_c(handle) bind(c, name="lanescape_path_destroy")
      import
      type(c_ptr), value :: handle
    end function path_destroy_c
  end interface

contains

  ! Between two configurations of a model, (3, N) and unwrapped; species from 1. diameters: of each particle, for models that have
  ! them. A path that does not reach its goal is a result too.
  subroutine find_on_model(self, model, species, box, start, finish, settings, diameters, stat, errmsg)
    class(lanescape_path), intent(inout) :: self
    class(lanescape_model), intent(in) :: model
    integer, intent(in) :: species(:)
    real(dp), intent(in) :: box(3)
    real(dp), intent(in), contiguous :: start(:, :), finish(:, :)
    type(lanescape_path_settings), intent(in), optional, target :: settings
    real(dp), intent(in), optional, target, contiguous :: diameters(:)
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    type(host_progress), target :: progress
    character(kind=c_char), allocatable, target :: chars(:, :)
    type(path_settings_c) :: s
    type(c_ptr) :: address, handle
    integer(c_int) :: status
    if (.not. check_shape("start", start, size(species), stat, errmsg)) return
    if (.not. check_shape("finish", finish, size(species), stat, errmsg)) return
    if (.not. fits("diameters", diameters, size(species), address, stat, errmsg)) return
    call translate_path_settings(settings, progress, s, chars)
    status = find_path_c(model%handle(), size(species, kind=c_size_t), species - 1, box, start, finish, address, s, handle)
    call keep(self, status, handle, stat, errmsg)
  end subroutine find_on_model

  ! On a landscape of the program's own; masses: of each particle, without them equal.
  subroutine find_on_landscape(self, landscape, start, finish, settings, masses, stat, errmsg)
    class(lanescape_path), intent(inout) :: self
    procedure(lanescape_landscape) :: landscape
    real(dp), intent(in), contiguous :: start(:, :), finish(:, :)
    type(lanescape_path_settings), intent(in), optional, target :: settings
    real(dp), intent(in), optional, target, contiguous :: masses(:)
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    type(host_landscape), target :: host
    type(host_progress), target :: progress
    character(kind=c_char), allocatable, target :: chars(:, :)
    type(path_settings_c) :: s
    type(c_ptr) :: address, handle
    integer(c_int) :: status
    host%evaluate => landscape
    host%particles = size(start, 2)
    if (.not. check_shape("start", start, host%particles, stat, errmsg)) return
    if (.not. check_shape("finish", finish, host%particles, stat, errmsg)) return
    if (.not. fits("masses", masses, host%particles, address, stat, errmsg)) return
    call translate_path_settings(settings, progress, s, chars)
    status = find_path_on_c(landscape_of(host), start, finish, address, s, handle)
    call keep(self, status, handle, stat, errmsg)
  end subroutine find_on_landscape

  ! Settings for C, whose words are in `chars` and whose procedure is in `progress`.
  subroutine translate_path_settings(settings, progress, s, chars)
    type(lanescape_path_settings), intent(in), optional, target :: settings
    type(host_progress), target, intent(inout) :: progress
    type(path_settings_c), intent(out) :: s
    character(kind=c_char), allocatable, target, intent(out) :: chars(:, :)
    type(c_ptr), allocatable :: addresses(:)
    if (settings_init_c(s, c_sizeof(s)) /= lanescape_ok .or. .not. present(settings)) return
    call address_of_words([settings%method, settings%fictitious, settings%precision, settings%instruction_set], chars, addresses)
    if (settings%method /= "") s%method = addresses(1)
    if (settings%fictitious /= "") s%fictitious = addresses(2)
    if (settings%precision /= "") s%precision = addresses(3)
    if (settings%instruction_set /= "") s%instruction_set = addresses(4)
    s%adaptive = merge(1, 0, settings%adaptive)
    s%step = settings%step
    s%avoidance_step = settings%avoidance_step
    if (allocated(settings%landscape_energy)) s%landscape_energy = c_loc(settings%landscape_energy)
    s%reverse = merge(1, 0, settings%reverse)
    if (settings%max_steps /= 0) s%max_steps = settings%max_steps
    if (settings%patience /= 0) s%patience = settings%patience
    if (settings%frames >= 0) s%frames = settings%frames
    s%threads = settings%threads
    if (.not. associated(settings%progress)) return
    progress%report => settings%progress
    s%progress = c_funloc(progress_c)
    s%progress_user = c_loc(progress)
  end subroutine translate_path_settings

  ! Keeps a path that was found, and ends the call.
  subroutine keep(self, status, handle, stat, errmsg)
    class(lanescape_path), intent(inout) :: self
    integer(c_int), intent(in) :: status
    type(c_ptr), intent(in) :: handle
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    type(summary_c) :: s
    integer(c_int) :: ended
    ended = status
    if (status == lanescape_ok) then
      call self%hold(handle, path_destroy_c)
      s%size = c_sizeof(s)
      ended = summarise_c(handle, s)
      self%outcome = text_at(s%outcome)
      self%reason = text_at(s%reason)
      self%reached = s%reached /= 0
      self%reversed = s%reversed /= 0
      self%length = s%length
      self%distance = s%distance
      self%ratio_squared = s%ratio_squared
      self%participation_ratio = s%participation_ratio
      self%direct_steps = s%direct_steps
      self%detour_steps = s%detour_steps
      self%evaluations = s%evaluations
      self%landscape_energy = s%landscape_energy
      self%largest_violation = s%largest_violation
      self%seconds = s%seconds
      self%particles = int(s%particles)
      self%frames = int(s%frames)
    end if
    call conclude(ended, stat, errmsg)
  end subroutine keep

  ! Positions (3, N) of one frame, from 1.
  subroutine frame(self, number, positions, stat, errmsg)
    class(lanescape_path), intent(in) :: self
    integer, intent(in) :: number
    real(dp), intent(inout), contiguous :: positions(:, :)
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    if (.not. check_shape("positions", positions, self%particles, stat, errmsg)) return
    call conclude(frame_c(self%handle(), int(number - 1, c_size_t), positions), stat, errmsg)
  end subroutine frame
end module lanescape_paths
