! Models, their potential energy, and configurations to start from.
module lanescape_models
  use, intrinsic :: iso_c_binding
  use lanescape_objects
  implicit none
  private

  ! What particles are and how they interact.
  type, extends(lanescape_object), public :: lanescape_model
  contains
    procedure :: named
    procedure :: from_file
    procedure :: from_toml
    procedure :: mixture
    procedure :: hard_spheres
    procedure :: to_toml
    procedure :: describe
    procedure :: make_start
  end type lanescape_model

  type, public :: lanescape_model_description
    character(:), allocatable :: name
    integer :: species = 0
    logical :: is_hard = .false., has_states = .false., has_diameters = .false.
    real(dp) :: largest_cutoff = 0, length_unit = 0
  end type lanescape_model_description

  ! Structs, with their members in the header's order.
  type, bind(c) :: model_changes_c
    integer(c_size_t) :: size = 0
    real(c_double) :: cutoff = 0
    type(c_ptr) :: truncation = c_null_ptr, images = c_null_ptr
  end type model_changes_c

  type, bind(c) :: pair_parameters_c
    integer(c_size_t) :: size = 0
    type(c_ptr) :: name = c_null_ptr, form = c_null_ptr
    integer(c_size_t) :: species = 0
    type(c_ptr) :: names = c_null_ptr, masses = c_null_ptr, fractions = c_null_ptr, epsilon = c_null_ptr, sigma = c_null_ptr
    integer(c_size_t) :: numbers = 0
    type(c_ptr) :: number_keys = c_null_ptr, number_values = c_null_ptr
    real(c_double) :: cutoff = 0
    type(c_ptr) :: truncation = c_null_ptr, images = c_null_ptr
  end type pair_parameters_c

  type, bind(c) :: hard_sphere_parameters_c
    integer(c_size_t) :: size = 0
    type(c_ptr) :: name = c_null_ptr
    integer(c_size_t) :: species = 0
    type(c_ptr) :: names = c_null_ptr, masses = c_null_ptr, fractions = c_null_ptr, diameters = c_null_ptr
  end type hard_sphere_parameters_c

  type, bind(c) :: model_description_c
    integer(c_size_t) :: size = 0
    type(c_ptr) :: name = c_null_ptr
    integer(c_size_t) :: species = 0
    integer(c_int) :: is_hard = 0, has_states = 0, has_diameters = 0
    real(c_double) :: largest_cutoff = 0, length_unit = 0
  end type model_description_c

  interface
    integer(c_int) function model_named_c(name, changes, model) bind(c, name="lanescape_model_named")
      import
      character(kind=c_char), intent(in) :: name(*)
      type(model_changes_c), intent(in) :: changes
      type(c_ptr), intent(inout) :: model
    end function model_named_c
    integer(c_int) function model_from_file_c(path, model) bind(c, name="lanescape_model_from_file")
      import
      character(kind=c_char), intent(in) :: path(*)
      type(c_ptr), intent(inout) :: model
    end function model_from_file_c
    integer(c_int) function model_from_toml_c(text, model) bind(c, name="lanescape_model_from_toml")
      import
      character(kind=c_char), intent(in) :: text(*)
      type(c_ptr), intent(inout) :: model
    end function model_from_toml_c
    integer(c_int) function pair_parameters_init_c(parameters, size) bind(c, name="lanescape_pair_parameters_init")
      import
      type(pair_parameters_c), intent(inout) :: parameters
      integer(c_size_t), value :: size
    end function pair_parameters_init_c
    integer(c_int) function model_mixture_c(parameters, model) bind(c, name="lanescape_model_mixture")
      import
      type(pair_parameters_c), intent(in) :: parameters
      type(c_ptr), intent(inout) :: model
    end function model_mixture_c
    integer(c_int) function model_hard_spheres_c(parameters, model) bind(c, name="lanescape_model_hard_spheres")
      import
      type(hard_sphere_parameters_c), intent(in) :: parameters
      type(c_ptr), intent(inout) :: model
    end function model_hard_spheres_c
    integer(c_int) function model_to_toml_c(model, text, capacity, needed) bind(c, name="lanescape_model_to_toml")
      import
      type(c_ptr), value :: model, text
      integer(c_size_t), value :: capacity
      integer(c_size_t), intent(inout) :: needed
    end function model_to_toml_c
    integer(c_int) function model_describe_c(model, description) bind(c, name="lanescape_model_describe")
      import
      type(c_ptr), value :: model
      type(model_description_c), intent(inout) :: description
    end function model_describe_c
    integer(c_int) function model_destroy_c(handle) bind(c, name="lanescape_model_destroy")
      import
      type(c_ptr), value :: handle
    end function model_destroy_c
    integer(c_int) function make_start_c(model, particles, density, seed, species, positions, box, diameters) &
      bind(c, name="lanescape_make_start")
      import
      type(c_ptr), value :: model
      integer(c_size_t), value :: particles
      real(c_double), value :: density
      integer(c_int64_t), value :: seed
      integer(c_int), intent(inout) :: species(*)
      real(c_double), intent(inout) :: positions(*), box(3)
      type(c_ptr), value :: diameters
    end function make_start_c
  end interface

contains

  ! Keeps a handle that was made, and ends the call.
  subroutine keep(self, status, handle, stat, errmsg)
    class(lanescape_model), intent(inout) :: self
    integer(c_int), intent(in) :: status
    type(c_ptr), intent(in) :: handle
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    if (status == lanescape_ok) call self%hold(handle, model_destroy_c)
    call conclude(status, stat, errmsg)
  end subroutine keep

  ! A model by its name, such as "kob-andersen"; cutoff in units of sigma.
  subroutine named(self, name, cutoff, truncation, images, stat, errmsg)
    class(lanescape_model), intent(inout) :: self
    character(*), intent(in) :: name
    real(dp), intent(in), optional :: cutoff
    character(*), intent(in), optional :: truncation, images
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    type(model_changes_c) :: changes
    character(kind=c_char), allocatable, target :: truncation_chars(:), images_chars(:)
    type(c_ptr) :: handle
    changes%size = c_sizeof(changes)
    if (present(cutoff)) changes%cutoff = cutoff
    call optional_word(truncation, truncation_chars, changes%truncation)
    call optional_word(images, images_chars, changes%images)
    call keep(self, model_named_c(trim(name)//c_null_char, changes, handle), handle, stat, errmsg)
  end subroutine named

  ! A model file.
  subroutine from_file(self, path, stat, errmsg)
    class(lanescape_model), intent(inout) :: self
    character(*), intent(in) :: path
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    type(c_ptr) :: handle
    call keep(self, model_from_file_c(trim(path)//c_null_char, handle), handle, stat, errmsg)
  end subroutine from_file

  ! The text of a model file.
  subroutine from_toml(self, text, stat, errmsg)
    class(lanescape_model), intent(inout) :: self
    character(*), intent(in) :: text
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    type(c_ptr) :: handle
    call keep(self, model_from_toml_c(text//c_null_char, handle), handle, stat, errmsg)
  end subroutine from_toml

  ! A mixture with a pair potential of one form: S chemical symbols, energies and lengths of each pair of species, (S, S). keys and
  ! values: what the form has beside these.
  subroutine mixture(self, form, names, epsilon, sigma, masses, fractions, keys, values, cutoff, truncation, images, name, stat, &
                     errmsg)
    class(lanescape_model), intent(inout) :: self
    character(*), intent(in) :: form, names(:)
    real(dp), intent(in), target, contiguous :: epsilon(:, :), sigma(:, :)
    real(dp), intent(in), optional, target, contiguous :: masses(:), fractions(:), values(:)
    character(*), intent(in), optional :: keys(:), truncation, images, name
    real(dp), intent(in), optional :: cutoff
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    type(pair_parameters_c) :: p
    character(kind=c_char), allocatable, target :: form_chars(:), truncation_chars(:), images_chars(:), name_chars(:)
    character(kind=c_char), allocatable, target :: names_chars(:, :), keys_chars(:, :)
    type(c_ptr), allocatable, target :: names_addresses(:), keys_addresses(:)
    type(c_ptr) :: handle
    integer :: s
    s = size(names)
    if (any([shape(epsilon), shape(sigma)] /= s) .or. s == 0) then
      call refuse("epsilon and sigma must be (S, S) for S names, at least one", stat, errmsg)
      return
    end if
    if (pair_parameters_init_c(p, c_sizeof(p)) /= lanescape_ok) then
      call conclude(int(lanescape_bad_input, c_int), stat, errmsg)
      return
    end if
    call optional_word(form, form_chars, p%form)
    call optional_word(name, name_chars, p%name)
    call optional_word(truncation, truncation_chars, p%truncation)
    call optional_word(images, images_chars, p%images)
    call address_of_words(names, names_chars, names_addresses)
    p%species = s
    p%names = c_loc(names_addresses(1))
    p%epsilon = c_loc(epsilon(1, 1))
    p%sigma = c_loc(sigma(1, 1))
    if (.not. fits("masses", masses, s, p%masses, stat, errmsg)) return
    if (.not. fits("fractions", fractions, s, p%fractions, stat, errmsg)) return
    if (present(cutoff)) p%cutoff = cutoff
    if (present(keys)) then
      if (.not. fits("values", values, size(keys), p%number_values, stat, errmsg)) return
      call address_of_words(keys, keys_chars, keys_addresses)
      p%numbers = size(keys)
      if (size(keys) > 0) p%number_keys = c_loc(keys_addresses(1))
    end if
    call keep(self, model_mixture_c(p, handle), handle, stat, errmsg)
  end subroutine mixture

  ! Additive hard spheres of S species.
  subroutine hard_spheres(self, names, diameters, masses, fractions, stat, errmsg)
    class(lanescape_model), intent(inout) :: self
    character(*), intent(in) :: names(:)
    real(dp), intent(in), target, contiguous :: diameters(:)
    real(dp), intent(in), optional, target, contiguous :: masses(:), fractions(:)
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    type(hard_sphere_parameters_c) :: p
    character(kind=c_char), allocatable, target :: names_chars(:, :)
    type(c_ptr), allocatable, target :: names_addresses(:)
    type(c_ptr) :: handle
    p%size = c_sizeof(p)
    p%species = size(names)
    call address_of_words(names, names_chars, names_addresses)
    if (size(names) > 0) p%names = c_loc(names_addresses(1))
    if (.not. fits("diameters", diameters, size(names), p%diameters, stat, errmsg)) return
    if (.not. fits("masses", masses, size(names), p%masses, stat, errmsg)) return
    if (.not. fits("fractions", fractions, size(names), p%fractions, stat, errmsg)) return
    call keep(self, model_hard_spheres_c(p, handle), handle, stat, errmsg)
  end subroutine hard_spheres

  ! The text from which from_toml makes the same model, bit for bit.
  subroutine to_toml(self, text, stat, errmsg)
    class(lanescape_model), intent(in) :: self
    character(:), allocatable, intent(out) :: text
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    character(kind=c_char), allocatable, target :: chars(:)
    integer(c_size_t) :: needed
    integer(c_int) :: status
    status = model_to_toml_c(self%handle(), c_null_ptr, 0_c_size_t, needed)
    if (status == lanescape_ok) then
      allocate (chars(needed))
      status = model_to_toml_c(self%handle(), c_loc(chars(1)), needed, needed)
      text = text_at(c_loc(chars(1)))
    end if
    call conclude(status, stat, errmsg)
  end subroutine to_toml

  subroutine describe(self, description, stat, errmsg)
    class(lanescape_model), intent(in) :: self
    type(lanescape_model_description), intent(out) :: description
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    type(model_description_c) :: d
    integer(c_int) :: status
    d%size = c_sizeof(d)
    status = model_describe_c(self%handle(), d)
    if (status == lanescape_ok) then
      description%name = text_at(d%name)
      description%species = int(d%species)
      description%is_hard = d%is_hard /= 0
      description%has_states = d%has_states /= 0
      description%has_diameters = d%has_diameters /= 0
      description%largest_cutoff = d%largest_cutoff
      description%length_unit = d%length_unit
    end if
    call conclude(status, stat, errmsg)
  end subroutine describe

  ! A lattice at a number density, of hard spheres at a packing fraction: as many particles as species and positions, (3, N), have
  ! room for. Diameters of models that have them or are made of hard spheres.
  subroutine make_start(self, density, species, positions, box, seed, diameters, stat, errmsg)
    class(lanescape_model), intent(in) :: self
    real(dp), intent(in) :: density
    integer, intent(out), contiguous :: species(:)
    real(dp), intent(out), contiguous :: positions(:, :)
    real(dp), intent(out) :: box(3)
    integer, intent(in), optional :: seed
    real(dp), intent(out), optional, target, contiguous :: diameters(:)
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    integer(c_int) :: status
    integer(c_int64_t) :: chosen
    type(c_ptr) :: address
    chosen = 1
    if (present(seed)) chosen = seed
    if (.not. check_shape("positions", positions, size(species), stat, errmsg)) return
    if (.not. fits("diameters", diameters, size(species), address, stat, errmsg)) return
    status = make_start_c(self%handle(), size(species, kind=c_size_t), density, chosen, species, positions, box, address)
    if (status == lanescape_ok) species = species + 1
    call conclude(status, stat, errmsg)
  end subroutine make_start
end module lanescape_models
