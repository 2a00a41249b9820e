! What all types of the module lanescape share: handles of the C interface (lanescape/lanescape.h), errors and strings.
module lanescape_objects
  use, intrinsic :: iso_c_binding
  use, intrinsic :: iso_fortran_env, only: error_unit
  implicit none
  private
  public :: lanescape_object, lanescape_version, lanescape_callback_error
  public :: destroy_c, conclude, refuse, check_shape, fits, from_zero, optional_word, text_at, address_of_words

  integer, parameter, public :: dp = c_double
  ! Values of stat.
  integer, parameter, public :: lanescape_ok = 0, lanescape_goal_not_reached = 1, lanescape_bad_input = 2, lanescape_internal = 3
  integer, parameter, public :: lanescape_interrupted = 4, lanescape_callback_failed = 5

  abstract interface
    integer(c_int) function destroy_c(handle) bind(c)
      import
      type(c_ptr), value :: handle
    end function destroy_c
  end interface

  ! An object of the library, freed with the variable. It has no copies: to assign one ends the program.
  type :: lanescape_object
    type(c_ptr), private :: handle_ = c_null_ptr
    procedure(destroy_c), pointer, nopass, private :: release => null()
  contains
    procedure :: handle
    procedure :: hold
    procedure :: destroy
    procedure, private :: refuse_copy
    generic :: assignment(=) => refuse_copy
    final :: finalise
  end type lanescape_object

  interface
    type(c_ptr) function last_error_c() bind(c, name="lanescape_last_error")
      import
    end function last_error_c
    integer(c_int) function last_callback_error_c() bind(c, name="lanescape_last_callback_error")
      import
    end function last_callback_error_c
    type(c_ptr) function version_c() bind(c, name="lanescape_version")
      import
    end function version_c
    integer(c_size_t) function strlen_c(text) bind(c, name="strlen")
      import
      type(c_ptr), value :: text
    end function strlen_c
  end interface

contains

  function handle(self)
    class(lanescape_object), intent(in) :: self
    type(c_ptr) :: handle
    handle = self%handle_
  end function handle

  ! Takes a new handle in place of the one before.
  subroutine hold(self, handle, release)
    class(lanescape_object), intent(inout) :: self
    type(c_ptr), intent(in) :: handle
    procedure(destroy_c) :: release
    call self%destroy()
    self%handle_ = handle
    self%release => release
  end subroutine hold

  ! Frees the object; calls that use it afterwards are refused.
  subroutine destroy(self)
    class(lanescape_object), intent(inout) :: self
    integer(c_int) :: ignored
    if (c_associated(self%handle_)) ignored = self%release(self%handle_)
    self%handle_ = c_null_ptr
  end subroutine destroy

  subroutine finalise(self)
    type(lanescape_object), intent(inout) :: self
    call self%destroy()
  end subroutine finalise

  subroutine refuse_copy(self, other)
    class(lanescape_object), intent(inout) :: self
    class(lanescape_object), intent(in) :: other
    if (c_associated(self%handle_) .or. c_associated(other%handle_)) &
      call refuse("objects of lanescape cannot be assigned: create another one")
  end subroutine refuse_copy

  ! Ends a call: with a status in stat and a message in errmsg, or the program if it failed and there is no stat.
  subroutine conclude(status, stat, errmsg)
    integer(c_int), intent(in) :: status
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    if (status == lanescape_ok) then
      if (present(stat)) stat = lanescape_ok
    else
      call fail(int(status), text_at(last_error_c()), stat, errmsg)
    end if
  end subroutine conclude

  ! The same for input that this module refuses.
  subroutine refuse(message, stat, errmsg)
    character(*), intent(in) :: message
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    call fail(lanescape_bad_input, message, stat, errmsg)
  end subroutine refuse

  subroutine fail(status, message, stat, errmsg)
    integer, intent(in) :: status
    character(*), intent(in) :: message
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    if (present(errmsg)) errmsg = message
    if (present(stat)) then
      stat = status
    else
      write (error_unit, '(2a)') "lanescape: ", message
      error stop
    end if
  end subroutine fail

  ! Whether an array is (3, particles); if not, the call is refused.
  logical function check_shape(what, array, particles, stat, errmsg)
    character(*), intent(in) :: what
    real(dp), intent(in) :: array(:, :)
    integer, intent(in) :: particles
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    character(120) :: message
    check_shape = size(array, 1) == 3 .and. size(array, 2) == particles
    if (check_shape) return
    write (message, '(2a, i0, a, i0, a, i0, a)') what, " has the shape (", size(array, 1), ", ", size(array, 2), &
      "): (3, ", particles, ") is needed"
    call refuse(trim(message), stat, errmsg)
  end function check_shape

  ! The address of an optional array of n numbers; if it has another length, the call is refused.
  logical function fits(what, array, n, address, stat, errmsg)
    character(*), intent(in) :: what
    real(dp), intent(in), optional, target, contiguous :: array(:)
    integer, intent(in) :: n
    type(c_ptr), intent(out) :: address
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    character(80) :: message
    address = c_null_ptr
    fits = .true.
    if (.not. present(array)) return
    fits = size(array) == n
    if (fits .and. n > 0) address = c_loc(array(1))
    if (fits) return
    write (message, '(2a, i0, a, i0, a)') what, " has ", size(array), " elements: ", n, " are needed"
    call refuse(trim(message), stat, errmsg)
  end function fits

  ! Optional species of n particles as C numbers them, and their address; if there are more or fewer, the call is refused.
  logical function from_zero(species, n, kept, address, stat, errmsg)
    integer, intent(in), optional :: species(:)
    integer, intent(in) :: n
    integer(c_int), allocatable, target, intent(out) :: kept(:)
    type(c_ptr), intent(out) :: address
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    character(80) :: message
    address = c_null_ptr
    from_zero = .true.
    if (.not. present(species)) return
    from_zero = size(species) == n
    if (from_zero) then
      kept = species - 1
      if (n > 0) address = c_loc(kept(1))
    else
      write (message, '(a, i0, a, i0, a)') "species has ", size(species), " elements: ", n, " are needed"
      call refuse(trim(message), stat, errmsg)
    end if
  end function from_zero

  ! A word for C, or nothing, which stays unallocated.
  subroutine optional_word(word, chars, address)
    character(*), intent(in), optional :: word
    character(kind=c_char), allocatable, target, intent(out) :: chars(:)
    type(c_ptr), intent(out) :: address
    integer :: k
    address = c_null_ptr
    if (.not. present(word)) return
    allocate (chars(len_trim(word) + 1))
    do k = 1, len_trim(word)
      chars(k) = word(k:k)
    end do
    chars(len_trim(word) + 1) = c_null_char
    address = c_loc(chars(1))
  end subroutine optional_word

  ! Words of one length as C has them: characters that end with a null, one word per column, and their addresses.
  subroutine address_of_words(words, chars, addresses)
    character(*), intent(in) :: words(:)
    character(kind=c_char), allocatable, target, intent(out) :: chars(:, :)
    type(c_ptr), allocatable, intent(out) :: addresses(:)
    integer :: k, w
    allocate (chars(len(words) + 1, size(words)), addresses(size(words)))
    chars = c_null_char
    do w = 1, size(words)
      do k = 1, len_trim(words(w))
        chars(k, w) = words(w)(k:k)
      end do
      addresses(w) = c_loc(chars(1, w))
    end do
  end subroutine address_of_words

  ! A string of C.
  function text_at(address) result(text)
    type(c_ptr), intent(in) :: address
    character(:), allocatable :: text
    character(kind=c_char), pointer :: chars(:)
    integer :: k, length
    length = int(strlen_c(address))
    call c_f_pointer(address, chars, [length])
    allocate (character(length) :: text)
    do k = 1, length
      text(k:k) = chars(k)
    end do
  end function text_at

  ! The version of the library that runs, such as "0.1.0".
  function lanescape_version() result(version)
    character(:), allocatable :: version
    version = text_at(version_c())
  end function lanescape_version

  ! What the program's own procedure gave as its stat in the last call that failed with lanescape_callback_failed.
  integer function lanescape_callback_error()
    lanescape_callback_error = int(last_callback_error_c())
  end function lanescape_callback_error
end module lanescape_objects
