! How near two particles are, so that E_L = 0 is the surface of hard spheres of diameter 1, and what progress is told.
module near_particles
  use check, only: dp
  implicit none
  integer :: calls = 0, fail_at = 0
  real(dp) :: told = -1

contains

  subroutine nearness(positions, energy, gradient, stat)
    real(dp), intent(in) :: positions(:, :)
    real(dp), intent(out) :: energy
    real(dp), intent(out), optional :: gradient(:, :)
    integer, intent(inout) :: stat
    real(dp) :: d(3)
    calls = calls + 1
    d = positions(:, 1) - positions(:, 2)
    energy = 1 - norm2(d)
    if (present(gradient)) then
      gradient(:, 1) = -d/norm2(d)
      gradient(:, 2) = d/norm2(d)
    end if
    if (calls == fail_at) stat = 4711
  end subroutine nearness

  subroutine until_one(done, stop)
    real(dp), intent(in) :: done
    logical, intent(inout) :: stop
    told = done
    stop = done >= 1
  end subroutine until_one
end module near_particles

! Paths made short and checked, on models and on procedures.
program shortening_test
  use lanescape
  use check
  use near_particles
  implicit none
  integer, parameter :: two(2) = [1, 1], segments = 200
  real(dp), parameter :: cube(3) = 10, pi = acos(-1.0_dp), angle = 170*pi/180, shortest = 6.1620_dp/sqrt(2.0_dp)
  real(dp) :: start(3, 2), finish_at(3, 2), taut(3, 2, segments + 3)
  integer :: stat
  character(200) :: errmsg

  call turn(3.0_dp, 0.0_dp, start)
  call turn(3.0_dp, angle, finish_at)
  call make_the_taut_path()
  call every_method_shortens_a_path("curve")
  call every_method_shortens_a_path("montecarlo")
  call a_model_has_short_paths_too()
  call a_given_path_is_shortened()
  call callbacks_end_the_work()
  call the_taut_path_has_a_certificate()
  call bad_paths_are_refused()
  call finish()

contains

  subroutine turn(r, by, positions)
    real(dp), intent(in) :: r, by
    real(dp), intent(out) :: positions(3, 2)
    real(dp) :: half(3)
    half = 0.5_dp*r*[cos(by), sin(by), 0.0_dp]
    positions(:, 1) = 5 + half
    positions(:, 2) = 5 - half
  end subroutine turn

  ! Straight, along the contact, straight.
  subroutine make_the_taut_path()
    real(dp) :: tangent
    integer :: k
    tangent = acos(1.0_dp/3)
    taut(:, :, 1) = start
    do k = 0, segments
      call turn(1.0_dp, tangent + (angle - 2*tangent)*k/segments, taut(:, :, k + 2))
    end do
    taut(:, :, segments + 3) = finish_at
  end subroutine make_the_taut_path

  function on_the_surface(method) result(settings)
    character(*), intent(in) :: method
    type(lanescape_shorten_settings) :: settings
    settings%method = method
    settings%search%landscape_energy = 0.0_dp
    settings%search%adaptive = .true.
  end function on_the_surface

  subroutine every_method_shortens_a_path(method)
    character(*), intent(in) :: method
    type(lanescape_short_path) :: path
    type(lanescape_shorten_settings) :: settings
    real(dp) :: frame(3, 2)
    settings = on_the_surface(method)
    settings%starts = 2
    call path%shorten_on(nearness, start, finish_at, settings=settings)
    call expect(path%reached .and. path%outcome == "reached", method // " ends by its own rule")
    call expect(path%length <= path%length_before .and. path%length > path%distance, "with a shorter path")
    call expect(size(path%start_lengths) == 2, "of both starts")
    call expect(abs(path%length - minval(path%start_lengths)) <= 0, "the shorter one")
    call expect(allocated(path%multipliers) .eqv. allocated(path%kuhn_tucker_residual), "multipliers come with a residual")
    call expect(allocated(path%multipliers) .eqv. method == "curve", "of methods whose frames are the path")
    if (method == "curve") then
      call expect(abs(path%length - shortest) < 1e-4_dp*shortest, "which is the shortest of all")
      call expect(size(path%multipliers) == path%frames .and. path%kuhn_tucker_residual < 1e-2_dp, "and stationary")
    end if
    call path%frame(1, frame)
    call expect(all(abs(frame - start) <= 0), "the first frame is the start")
    call path%frame(path%frames, frame)
    call expect(all(abs(frame - finish_at) <= 0), "the last frame is the finish")
    call path%frame(path%frames + 1, frame, stat, errmsg)
    call refused(stat, errmsg, "numbered from 0")
  end subroutine every_method_shortens_a_path

  subroutine a_model_has_short_paths_too()
    type(lanescape_model) :: model
    type(lanescape_short_path) :: path
    type(lanescape_shorten_settings) :: settings
    call model%named("hard-sphere")
    settings%method = "montecarlo"
    settings%search%method = "away"
    call path%shorten(model, two, cube, start, finish_at, settings=settings)
    call expect(path%reached .and. path%length > shortest - 1e-4_dp, "hard spheres go around each other")
    call expect(path%length <= path%length_before .and. path%largest_violation < 1e-9_dp, "on a shorter way without overlaps")
  end subroutine a_model_has_short_paths_too

  subroutine a_given_path_is_shortened()
    type(lanescape_short_path) :: path
    type(lanescape_shorten_settings) :: settings
    settings = on_the_surface("montecarlo")
    settings%search%landscape_energy = 1e-4_dp  ! of the corners of the contact
    call path%shorten_on(nearness, start, finish_at, taut, settings, masses=[1.0_dp, 1.0_dp])
    call expect(path%reached .and. abs(path%length_before - shortest) < 1e-2_dp, "a given path is the one to shorten")
    call path%shorten_on(nearness, start, finish_at, taut(:, :, :2), settings, stat=stat, errmsg=errmsg)
    call refused(stat, errmsg, "at least 3")
    call path%shorten_on(nearness, start, finish_at, taut(:, :, :0), settings, stat=stat, errmsg=errmsg)
    call refused(stat, errmsg, "path has the shape (3, 2, 0): (3, 2, frames) is needed")
    call path%shorten_on(nearness, start, finish_at, taut(:, :1, :), settings, stat=stat, errmsg=errmsg)
    call refused(stat, errmsg, "path has the shape (3, 1, 203): (3, 2, frames) is needed")
    call path%shorten_on(nearness, start, finish_at, taut(:, :, :100), settings, stat=stat, errmsg=errmsg)
    call refused(stat, errmsg, "are not the end points")
  end subroutine a_given_path_is_shortened

  subroutine callbacks_end_the_work()
    type(lanescape_short_path) :: path
    type(lanescape_shorten_settings) :: settings
    settings = on_the_surface("")
    settings%search%progress => until_one
    call path%shorten_on(nearness, start, finish_at, settings=settings)
    call expect(path%outcome == "interrupted" .and. abs(told - 1) <= 0, "progress is told what was made, and ends the work")
    fail_at = calls + 30
    call path%shorten_on(nearness, start, finish_at, stat=stat, errmsg=errmsg)
    call expect(stat == lanescape_callback_failed, "a failure of the landscape is one")
    call expect(lanescape_callback_error() == 4711, "its code comes back")
  end subroutine callbacks_end_the_work

  subroutine the_taut_path_has_a_certificate()
    type(lanescape_model) :: model
    type(lanescape_path_certificate) :: of_spheres, of_procedure
    call model%named("hard-sphere")
    call of_spheres%check(model, two, cube, taut, threads=2)
    call of_procedure%check_on(nearness, taut, landscape_energy=0.0_dp)
    call expect(abs(of_spheres%length - shortest) < 1e-4_dp, "it is the shortest")
    call expect(abs(of_procedure%length - shortest) < 1e-4_dp, "on a procedure too")
    call expect(of_spheres%kuhn_tucker_residual < 1e-2_dp .and. of_procedure%kuhn_tucker_residual < 1e-2_dp, "it is stationary")
    call expect(of_spheres%largest_violation < 1e-4_dp .and. of_procedure%largest_violation < 1e-4_dp, "it is allowed")
    call expect(size(of_spheres%multipliers) == segments + 3, "each frame has a multiplier")
    call expect(size(of_spheres%excess) == segments + 3, "and an excess")
    call expect(size(of_procedure%segment_violation) == segments + 2, "each segment too")
    call expect(abs(of_spheres%excess(1) - 2) < 1e-12_dp .and. abs(of_procedure%excess(1) + 2) < 1e-12_dp, "of both ends, too")
  end subroutine the_taut_path_has_a_certificate

  subroutine bad_paths_are_refused()
    type(lanescape_model) :: model, none
    type(lanescape_path_certificate) :: certificate
    type(lanescape_short_path) :: path
    type(lanescape_shorten_settings) :: settings
    call model%named("hard-sphere")
    call certificate%check(model, two, cube, taut(:, :, :2), stat=stat, errmsg=errmsg)
    call refused(stat, errmsg, "at least 3 are needed")
    call certificate%check(model, two, cube, taut, landscape_energy=0.0_dp, stat=stat, errmsg=errmsg)
    call refused(stat, errmsg, "no landscape energy")
    call certificate%check(model, two, cube, taut, threads=0, stat=stat, errmsg=errmsg)
    call refused(stat, errmsg, "0 threads are not allowed")
    call certificate%check(none, two, cube, taut, stat=stat, errmsg=errmsg)
    call refused(stat, errmsg, "argument model is NULL")
    call certificate%check_on(nearness, taut(:, :, [1, 1, 2]), stat=stat, errmsg=errmsg)
    call refused(stat, errmsg, "coincide")
    call certificate%check_on(nearness, taut, masses=[1.0_dp], stat=stat, errmsg=errmsg)
    call refused(stat, errmsg, "masses has 1 elements: 2 are needed")
    settings%method = "walk"
    call path%shorten(model, two, cube, start, finish_at, settings=settings, stat=stat, errmsg=errmsg)
    call refused(stat, errmsg, "unknown method 'walk'")
    settings%method = ""
    settings%starts = 0
    call path%shorten(model, two, cube, start, finish_at, settings=settings, stat=stat, errmsg=errmsg)
    call refused(stat, errmsg, "0 starts are not allowed")
    call path%shorten(model, two, cube, start(:, :1), finish_at, stat=stat, errmsg=errmsg)
    call refused(stat, errmsg, "start has the shape (3, 1): (3, 2) is needed")
  end subroutine bad_paths_are_refused
end program shortening_test
