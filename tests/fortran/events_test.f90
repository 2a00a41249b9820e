! Event-driven dynamics, end points, and progress.
module reports
  use check, only: dp
  implicit none
  integer :: calls = 0
  real(dp) :: last = -1
  real(dp) :: stop_at = 2

contains

  subroutine report(done, stop)
    real(dp), intent(in) :: done
    logical, intent(inout) :: stop
    calls = calls + 1
    last = done
    stop = done >= stop_at
  end subroutine report
end module reports

program events_test
  use, intrinsic :: iso_fortran_env, only: int8, int64
  use lanescape
  use check
  use reports
  implicit none
  integer, parameter :: n = 108
  integer :: stat
  character(200) :: errmsg

  call spheres_collide()
  call bad_spheres_are_refused()
  call states_are_kept()
  call end_points_are_made()
  call progress_ends_work()
  call finish()

contains

  subroutine spheres_collide()
    type(lanescape_event_driven) :: dynamics, again
    type(lanescape_event_driven_report) :: report_
    real(dp) :: positions(3, 2), velocities(3, 2), start(3, 2)
    ! Two spheres of diameter 1 approach each other over a gap of 2.
    start = 5
    start(1, :) = [3.5_dp, 6.5_dp]
    velocities = 0
    velocities(1, :) = [1.0_dp, -1.0_dp]
    call dynamics%create([0.5_dp, 0.5_dp], start, [10.0_dp, 10.0_dp, 10.0_dp], masses=[1.0_dp, 1.0_dp])
    call dynamics%set_velocities(velocities)
    call dynamics%advance_to(0.5_dp)
    call dynamics%describe(report_)
    call expect(report_%collisions == 0 .and. abs(report_%time - 0.5_dp) < 1e-12_dp, "no collision is before its time")
    call dynamics%collide(1)
    call dynamics%describe(report_)
    call expect(report_%collisions == 1 .and. abs(report_%time - 1) < 1e-12_dp, "spheres collide when they touch")
    call expect(abs(report_%kinetic_energy - 1) < 1e-12_dp, "the kinetic energy is conserved")
    call dynamics%get(positions, velocities)
    call expect(abs(positions(1, 2) - positions(1, 1) - 1) < 1e-12_dp, "they touch")
    call expect(abs(velocities(1, 1) + 1) < 1e-12_dp .and. abs(velocities(1, 2) - 1) < 1e-12_dp, "equal masses swap velocities")
    call again%create([0.5_dp, 0.5_dp], start, [10.0_dp, 10.0_dp, 10.0_dp], instruction_set="auto")
    call again%draw_velocities(3)
    call again%describe(report_)
    call expect(abs(report_%kinetic_energy - 3) < 1e-12_dp, "velocities are drawn")
  end subroutine spheres_collide

  subroutine bad_spheres_are_refused()
    type(lanescape_event_driven) :: dynamics
    real(dp) :: overlapping(3, 2)
    overlapping = 5
    overlapping(1, 2) = 5.5_dp
    call dynamics%create([0.5_dp, 0.5_dp], overlapping, [10.0_dp, 10.0_dp, 10.0_dp], stat=stat, errmsg=errmsg)
    call refused(stat, errmsg, "overlap")
    call dynamics%create([0.5_dp], overlapping, [10.0_dp, 10.0_dp, 10.0_dp], stat=stat, errmsg=errmsg)
    call refused(stat, errmsg, "positions has the shape (3, 2): (3, 1) is needed")
    call dynamics%collide(1, stat, errmsg)
    call refused(stat, errmsg, "argument dynamics is NULL")
    overlapping(1, 2) = 7
    call dynamics%create([0.5_dp, 0.5_dp], overlapping, [10.0_dp, 10.0_dp, 10.0_dp])
    call dynamics%collide(-1, stat, errmsg)
    call refused(stat, errmsg, "below 0")
    call dynamics%set_velocities(overlapping(:, :1), stat, errmsg)
    call refused(stat, errmsg, "velocities has the shape (3, 1)")
    call dynamics%get(overlapping(:, :1), stat=stat, errmsg=errmsg)
    call refused(stat, errmsg, "positions has the shape (3, 1)")
  end subroutine bad_spheres_are_refused

  subroutine states_are_kept()
    type(lanescape_model) :: model
    type(lanescape_potential) :: potential
    type(lanescape_dynamics) :: dynamics
    type(lanescape_event_driven) :: spheres
    integer :: species(n)
    integer(int8), allocatable :: state(:), none(:)
    real(dp) :: positions(3, n), box(3), there(3, n), again(3, n), radii(n)
    call model%named("lennard-jones")
    call model%make_start(0.8_dp, species, positions, box)
    call potential%create(model, species, box)
    call dynamics%create(potential, positions, 0.002_dp)
    call dynamics%draw_velocities(1.0_dp, 7)
    call dynamics%run(10)
    call dynamics%save_state(state)
    call dynamics%run(10)
    call dynamics%get(there)
    call dynamics%restore_state(state)
    call dynamics%run(10)
    call dynamics%get(again)
    call expect(all(abs(there - again) <= 0), "molecular dynamics goes on with the same bits")
    call dynamics%restore_state(state(:3), stat, errmsg)
    call refused(stat, errmsg, "cut or changed")
    radii = 0.4_dp
    call spheres%create(radii, positions, box)
    call spheres%draw_velocities(7)
    call spheres%collide(100)
    call spheres%save_state(state)
    call spheres%collide(100)
    call spheres%get(there)
    call spheres%restore_state(state)
    call spheres%collide(100)
    call spheres%get(again)
    call expect(all(abs(there - again) <= 0), "so do spheres")
    allocate (none(0))
    call spheres%restore_state(none, stat, errmsg)
    call expect(stat == lanescape_bad_input, "no bytes are no state")
  end subroutine states_are_kept

  subroutine end_points_are_made()
    type(lanescape_model) :: model
    type(lanescape_end_points) :: ends
    type(lanescape_end_point_settings) :: settings
    integer :: species(n)
    integer(int64) :: steps
    real(dp) :: positions(3, n), box(3), start(3, n), last_one(3, n), distance, time
    call model%named("kob-andersen")
    call model%make_start(1.2_dp, species, positions, box)
    settings%quick = .true.
    settings%equilibration = 300
    settings%distance = 4
    settings%pairs = 2
    settings%progress => report
    call ends%make(model, species, positions, box, settings)
    call expect(ends%pairs == 2, "as many pairs are made as were asked for")
    call expect(calls > 0 .and. last >= 0 .and. last <= 1, "progress is told")
    call ends%get(2, start, last_one, distance, steps, time)
    call expect(distance >= 4 .and. abs(sqrt(sum((last_one - start)**2)) - distance) < 1e-6_dp, "ends are their distance apart")
    call expect(steps > 0 .and. time > 0, "the trajectory between them has its steps and time")
    call ends%get(1, start, last_one)
    call ends%get(3, start, last_one, stat=stat, errmsg=errmsg)
    call refused(stat, errmsg, "numbered from 0")
    call ends%get(1, start(:, 2:), last_one, stat=stat, errmsg=errmsg)
    call refused(stat, errmsg, "start has the shape (3, 107): (3, 108) is needed")
    settings%precision = "half"
    call ends%make(model, species, positions, box, settings, stat=stat, errmsg=errmsg)
    call refused(stat, errmsg, "half")
    settings%precision = ""
    settings%pairs = -1
    call ends%make(model, species, positions, box, settings, stat=stat, errmsg=errmsg)
    call refused(stat, errmsg, "below 0")
    call expect(ends%pairs == 2, "what was made is kept")
  end subroutine end_points_are_made

  subroutine progress_ends_work()
    type(lanescape_model) :: model
    type(lanescape_end_points) :: ends
    type(lanescape_end_point_settings) :: settings
    type(lanescape_path) :: path
    type(lanescape_path_settings) :: search
    integer :: species(n)
    real(dp) :: positions(3, n), box(3), start(3, n), last_one(3, n)
    call model%named("kob-andersen")
    call model%make_start(1.2_dp, species, positions, box)
    settings%quick = .true.
    settings%equilibration = 300
    settings%distance = 4
    call ends%make(model, species, positions, box, settings)
    call ends%get(1, start, last_one)
    calls = 0
    search%progress => report
    call path%find(model, species, box, start, last_one, search)
    call expect(path%reached .and. calls > 0, "a search tells its progress")
    stop_at = -1
    call path%find(model, species, box, start, last_one, search)
    call expect(.not. path%reached .and. path%outcome == "interrupted", "it can be ended")
    settings%progress => report
    call ends%make(model, species, positions, box, settings, stat=stat, errmsg=errmsg)
    call expect(stat == lanescape_interrupted, "so can the making of end points")
  end subroutine progress_ends_work
end program events_test
