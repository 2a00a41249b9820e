! A pair of particles as a landscape of the program's own, and what its calls are made to do.
module pair_landscape
  use check, only: dp
  implicit none
  integer :: calls = 0, fail_at = 0

contains

  ! The shifted Lennard-Jones potential of two particles without images.
  subroutine evaluate(positions, energy, gradient, stat)
    real(dp), intent(in) :: positions(:, :)
    real(dp), intent(out) :: energy
    real(dp), intent(out), optional :: gradient(:, :)
    integer, intent(inout) :: stat
    real(dp) :: d(3), s6, cut6
    calls = calls + 1
    d = positions(:, 1) - positions(:, 2)
    s6 = dot_product(d, d)**(-3)
    cut6 = 2.5_dp**(-6)
    energy = 4*(s6**2 - s6 - cut6**2 + cut6)
    if (present(gradient)) then
      gradient(:, 1) = -24*(2*s6**2 - s6)/dot_product(d, d)*d
      gradient(:, 2) = -gradient(:, 1)
    end if
    if (calls == fail_at) stat = 4711
  end subroutine evaluate
end module pair_landscape

! Paths on models and procedures, and molecular dynamics.
program paths_test
  use lanescape
  use check
  use pair_landscape
  implicit none
  integer, parameter :: two(2) = [1, 1]
  real(dp), parameter :: cube(3) = 10
  real(dp) :: start(3, 2), finish_at(3, 2), zero
  integer :: stat
  character(200) :: errmsg

  call turn(1.3_dp, 0.0_dp, start)
  call turn(1.25_dp, 120.0_dp, finish_at)
  call both_landscapes_have_one_path()
  call errors_of_the_landscape_come_back()
  call bad_paths_are_refused()
  call dynamics_conserves_energy()
  call dynamics_runs_on_a_procedure()
  call finish()

contains

  subroutine turn(r, degrees, positions)
    real(dp), intent(in) :: r, degrees
    real(dp), intent(out) :: positions(3, 2)
    real(dp) :: half(3)
    half = 0.5_dp*r*[cos(degrees*acos(-1.0_dp)/180), sin(degrees*acos(-1.0_dp)/180), 0.0_dp]
    positions(:, 1) = 5 + half
    positions(:, 2) = 5 - half
  end subroutine turn

  subroutine both_landscapes_have_one_path()
    type(lanescape_model) :: model
    type(lanescape_path) :: of_model, of_procedure, adaptive
    type(lanescape_path_settings) :: settings
    real(dp) :: frame(3, 2)
    call model%named("lennard-jones")
    call of_model%find(model, two, cube, start, finish_at)
    call of_procedure%find_on(evaluate, start, finish_at)
    call expect(of_model%reached .and. of_model%outcome == "reached" .and. of_model%length > of_model%distance, "a path is found")
    call expect(of_procedure%reached .and. calls > 0, "and on a procedure")
    call expect(abs(of_model%length - of_procedure%length) < 1e-3_dp*of_model%length, "both are equally long")
    call expect(abs(of_model%landscape_energy - of_procedure%landscape_energy) < 1e-12_dp, "at one landscape energy")
    call of_procedure%frame(1, frame)
    call expect(all(abs(frame - start) <= 0), "the first frame is the start")
    call of_procedure%frame(of_procedure%frames, frame)
    call expect(all(abs(frame - finish_at) <= 0), "the last frame is the finish")
    call of_procedure%frame(of_procedure%frames + 1, frame, stat, errmsg)
    call refused(stat, errmsg, "numbered from 0")
    call of_procedure%frame(0, frame, stat, errmsg)
    call refused(stat, errmsg, "numbered from 0")
    settings%adaptive = .true.
    call adaptive%find_on(evaluate, start, finish_at, settings)
    call expect(adaptive%reached, "adaptive steps reach the goal")
    call expect(abs(adaptive%length - of_model%length) < 0.01_dp*of_model%length, "by a path of the same length")
    call expect(10*adaptive%evaluations < of_procedure%evaluations, "with fewer evaluations")
    settings%adaptive = .false.
    settings%method = "escape"
    settings%frames = 3
    settings%landscape_energy = of_model%landscape_energy + 0.1_dp
    settings%reverse = .true.
    call of_procedure%find_on(evaluate, start, finish_at, settings, masses=[1.0_dp, 1.0_dp])
    call expect(of_procedure%reached .and. of_procedure%frames <= 5, "settings reach the search")
    call expect(abs(of_procedure%landscape_energy - settings%landscape_energy) < 1e-12_dp, "a landscape energy is taken")
  end subroutine both_landscapes_have_one_path

  subroutine errors_of_the_landscape_come_back()
    type(lanescape_path) :: path
    fail_at = calls + 20
    call path%find_on(evaluate, start, finish_at, stat=stat, errmsg=errmsg)
    call expect(stat == lanescape_callback_failed, "a failure of the landscape is one")
    call expect(lanescape_callback_error() == 4711, "its code comes back")
    call expect(index(errmsg, "4711") > 0 .and. calls == fail_at, "and ends the search")
  end subroutine errors_of_the_landscape_come_back

  subroutine bad_paths_are_refused()
    type(lanescape_model) :: model, none
    type(lanescape_path) :: path
    type(lanescape_path_settings) :: settings
    real(dp) :: bad(3, 2)
    call model%named("lennard-jones")
    zero = 0
    bad = start
    bad(3, 1) = zero/zero
    call path%find(model, two, cube, bad, finish_at, stat=stat, errmsg=errmsg)
    call refused(stat, errmsg, "finite")
    call path%find(model, two, cube, start(:, :1), finish_at, stat=stat, errmsg=errmsg)
    call refused(stat, errmsg, "start has the shape (3, 1): (3, 2) is needed")
    call path%find(none, two, cube, start, finish_at, stat=stat, errmsg=errmsg)
    call refused(stat, errmsg, "argument model is NULL")
    call path%find_on(evaluate, start, start, stat=stat, errmsg=errmsg)
    call refused(stat, errmsg, "coincide")
    call path%find_on(evaluate, start, finish_at, masses=[1.0_dp], stat=stat, errmsg=errmsg)
    call refused(stat, errmsg, "masses has 1 elements: 2 are needed")
    settings%method = "magic"
    call path%find_on(evaluate, start, finish_at, settings, stat=stat, errmsg=errmsg)
    call refused(stat, errmsg, "magic")
  end subroutine bad_paths_are_refused

  subroutine dynamics_conserves_energy()
    integer, parameter :: n = 108
    type(lanescape_model) :: model
    type(lanescape_potential) :: potential
    type(lanescape_dynamics) :: dynamics
    type(lanescape_dynamics_report) :: first, last
    integer :: species(n)
    real(dp) :: positions(3, n), velocities(3, n), box(3)
    call model%named("lennard-jones")
    call model%make_start(0.8_dp, species, positions, box)
    call potential%create(model, species, box)
    call dynamics%create(potential, positions, 0.002_dp)
    call potential%destroy()  ! the dynamics keeps what it needs
    call dynamics%draw_velocities(1.0_dp, 7)
    call dynamics%describe(first)
    call dynamics%run(100)
    call dynamics%describe(last)
    call expect(abs(first%temperature - 1) < 1e-12_dp .and. last%steps == 100, "steps are made")
    call expect(abs(last%kinetic_energy + last%potential_energy - first%kinetic_energy - first%potential_energy) < 0.1_dp, &
      "the energy is conserved")
    call dynamics%get(positions, velocities)
    call expect(abs(sum(velocities**2)/2 - last%kinetic_energy) < 1e-9_dp, "velocities are those of the kinetic energy")
    call dynamics%set_velocities(velocities(:, 2:), stat, errmsg)
    call refused(stat, errmsg, "velocities has the shape (3, 107)")
    call dynamics%run(-1, stat, errmsg)
    call refused(stat, errmsg, "below 0")
  end subroutine dynamics_conserves_energy

  subroutine dynamics_runs_on_a_procedure()
    type(lanescape_dynamics) :: dynamics
    type(lanescape_dynamics_report) :: first, last
    real(dp) :: moved(3, 2)
    call dynamics%create_on(evaluate, start, 0.001_dp, masses=[1.0_dp, 2.0_dp])
    call dynamics%describe(first)
    call dynamics%run(500)
    call dynamics%describe(last)
    call dynamics%get(moved)
    call expect(last%kinetic_energy > 0 .and. abs(last%kinetic_energy + last%potential_energy - first%potential_energy) < 1e-4_dp, &
      "a pair falls inwards")
    call expect(maxval(abs(moved - start)) > 0.01_dp, "and moves")
    fail_at = calls + 3
    call dynamics%run(10, stat, errmsg)
    call expect(stat == lanescape_callback_failed .and. index(errmsg, "4711") > 0, "an error ends the run")
  end subroutine dynamics_runs_on_a_procedure
end program paths_test
