! Models and their potential energy.
program systems_test
  use, intrinsic :: iso_c_binding, only: c_int, c_long
  use lanescape
  use check
  implicit none
  integer, parameter :: two(2) = [1, 1]
  real(dp), parameter :: cube(3) = 10
  real(dp) :: apart(3, 2)
  integer :: stat
  character(200) :: errmsg

  apart = reshape([9.5_dp, 1.0_dp, 2.0_dp, 1.0_dp, 1.0_dp, 2.0_dp], [3, 2])  ! 1.5 across a face of the box
  call models_are_made_and_described()
  call two_particles_have_the_pair_potential()
  call strided_arrays_are_taken()
  call bad_input_is_refused()
  call objects_free_what_they_hold()
  call finish()

contains

  subroutine models_are_made_and_described()
    type(lanescape_model) :: model, copy, argon, spheres
    type(lanescape_model_description) :: d
    character(:), allocatable :: text, again
    integer :: unit
    call expect(len(lanescape_version()) >= 5, "a version is given")
    call model%named("kob-andersen", cutoff=2.0_dp)
    call model%describe(d)
    call expect(d%name == "kob-andersen" .and. d%species == 2 .and. .not. d%is_hard, "a named model is described")
    call expect(abs(d%largest_cutoff - 2) < 1e-15_dp, "a cutoff reaches the model")
    call model%to_toml(text)
    call copy%from_toml(text)
    call copy%to_toml(again)
    call expect(text == again, "a text makes the same model")
    open (newunit=unit, file="fortran_systems_test.toml", status="replace", access="stream")
    write (unit) text
    close (unit)
    call copy%from_file("fortran_systems_test.toml")
    call copy%to_toml(again)
    call expect(text == again, "a file makes the same model")
    open (newunit=unit, file="fortran_systems_test.toml")
    close (unit, status="delete")
    call argon%mixture("inverse-power", ["Ar", "Kr"], reshape([1.0_dp, 1.0_dp, 1.0_dp, 1.0_dp], [2, 2]), &
      reshape([1.0_dp, 1.1_dp, 1.1_dp, 1.2_dp], [2, 2]), fractions=[0.5_dp, 0.5_dp], keys=["exponent"], values=[10.0_dp], &
      cutoff=2.0_dp, name="argon and krypton")
    call argon%describe(d)
    call expect(d%name == "argon and krypton" .and. abs(d%largest_cutoff - 2.4_dp) < 1e-12_dp, "parameters make a mixture")
    call argon%mixture("inverse-power", ["Ar"], reshape([1.0_dp], [1, 1]), reshape([1.0_dp], [1, 1]), keys=["hardness"], &
      values=[10.0_dp], stat=stat, errmsg=errmsg)
    call refused(stat, errmsg, "has no number 'hardness': it has exponent")
    call argon%mixture("yukawa", ["Ar"], reshape([1.0_dp, 1.0_dp], [2, 1]), reshape([1.0_dp], [1, 1]), stat=stat, errmsg=errmsg)
    call refused(stat, errmsg, "epsilon and sigma must be (S, S)")
    call spheres%hard_spheres(["A"], [2.0_dp])
    call spheres%describe(d)
    call expect(d%is_hard .and. abs(d%length_unit - 2) < 1e-15_dp, "diameters make hard spheres")
    call spheres%hard_spheres(["A"], [2.0_dp, 1.0_dp], stat=stat, errmsg=errmsg)
    call refused(stat, errmsg, "diameters has 2 elements: 1 are needed")
  end subroutine models_are_made_and_described

  subroutine two_particles_have_the_pair_potential()
    type(lanescape_model) :: model
    type(lanescape_potential) :: potential
    real(dp) :: energy, alone, virial, stress(6), forces(3, 2), energies(2), s6, slope
    call model%named("lennard-jones", truncation="plain")
    call potential%create(model, two, cube, threads=2, precision="double", instruction_set="auto")
    call potential%evaluate(apart, energy, virial, stress, forces, energies, stat=stat)
    s6 = 1.5_dp**(-6)
    slope = -24*(2*s6**2 - s6)/1.5_dp
    call expect(stat == lanescape_ok, "a potential is evaluated")
    call expect(potential%particles() == 2, "and has two particles")
    call expect(abs(energy - 4*(s6**2 - s6)) < 1e-15_dp, "the energy is that of the pair")
    call expect(abs(forces(1, 1) - slope) + abs(forces(1, 2) + slope) < 1e-14_dp, "the forces are those of the pair")
    call expect(abs(virial + 1.5_dp*slope) < 1e-14_dp, "the virial is that of the pair")
    call expect(abs(stress(1) + virial/1000) < 1e-17_dp, "the stress is that of the pair")
    call expect(all(abs(energies - energy/2) < 1e-15_dp), "each particle has half of the energy")
    call potential%evaluate(apart, alone)
    call expect(abs(alone - energy) < 1e-15_dp, "the energy alone is the same")
    call potential%set_box([20.0_dp, 10.0_dp, 10.0_dp])
    call potential%evaluate(apart, alone)
    call expect(abs(alone) < 1e-15_dp, "another box changes the energy")
  end subroutine two_particles_have_the_pair_potential

  ! Sections that are not contiguous.
  subroutine strided_arrays_are_taken()
    type(lanescape_model) :: model
    type(lanescape_potential) :: potential
    real(dp) :: wide(4, 4), wide_forces(4, 4), energy, expected, forces(3, 2)
    call model%named("lennard-jones")
    call potential%create(model, two, cube)
    wide = 7
    wide(2:4, 1:3:2) = apart
    call potential%evaluate(apart, expected, forces=forces)
    call potential%evaluate(wide(2:4, 1:3:2), energy, forces=wide_forces(2:4, 1:3:2))
    call expect(abs(energy - expected) <= 0 .and. all(abs(wide_forces(2:4, 1:3:2) - forces) <= 0), "sections give the same")
  end subroutine strided_arrays_are_taken

  subroutine bad_input_is_refused()
    type(lanescape_model) :: model, none
    type(lanescape_potential) :: potential
    real(dp) :: energy, bad(3, 2), zero
    call model%named("no-such-model", stat=stat, errmsg=errmsg)
    call refused(stat, errmsg, "no-such-model")
    call model%from_toml("[model", stat, errmsg)
    call expect(stat == lanescape_bad_input, "bad text is refused")
    call model%from_file("/no/such/file", stat, errmsg)
    call refused(stat, errmsg, "/no/such/file")
    call model%named("kob-andersen")
    call potential%create(model, [1, 3], cube, stat=stat, errmsg=errmsg)
    call refused(stat, errmsg, "species 2 is not allowed")
    call potential%create(model, two, [10.0_dp, 0.0_dp, 10.0_dp], stat=stat, errmsg=errmsg)
    call refused(stat, errmsg, "box edge 0")
    call potential%create(none, two, cube, stat=stat, errmsg=errmsg)
    call refused(stat, errmsg, "argument model is NULL")
    call potential%create(model, two, cube, precision="half", stat=stat, errmsg=errmsg)
    call refused(stat, errmsg, "unknown precision 'half'")
    call potential%create(model, two, cube, diameters=[1.0_dp], stat=stat, errmsg=errmsg)
    call refused(stat, errmsg, "diameters has 1 elements: 2 are needed")
    call potential%evaluate(apart, energy, stat=stat, errmsg=errmsg)
    call refused(stat, errmsg, "argument potential is NULL")
    call potential%create(model, two, cube)
    call potential%evaluate(apart(:2, :), energy, stat=stat, errmsg=errmsg)
    call refused(stat, errmsg, "positions has the shape (2, 2): (3, 2) is needed")
    call potential%evaluate(apart, energy, forces=bad(:, :1), stat=stat, errmsg=errmsg)
    call refused(stat, errmsg, "forces has the shape (3, 1): (3, 2) is needed")
    zero = 0
    bad = apart
    bad(2, 2) = zero/zero
    call potential%evaluate(bad, energy, stat=stat, errmsg=errmsg)
    call refused(stat, errmsg, "y coordinate")
    call potential%destroy()
    call potential%evaluate(apart, energy, stat=stat, errmsg=errmsg)
    call refused(stat, errmsg, "argument potential is NULL")
  end subroutine bad_input_is_refused

  ! Finalizers: resident memory does not grow over many objects.
  subroutine objects_free_what_they_hold()
    integer :: round, before, after
    do round = 1, 1000
      call make_and_leave()
    end do
    before = resident_pages()
    do round = 1, 3000
      call make_and_leave()
    end do
    after = resident_pages()
    call expect(after - before < 200, "objects free what they hold")
  end subroutine objects_free_what_they_hold

  subroutine make_and_leave()
    type(lanescape_model) :: model
    type(lanescape_potential) :: potential
    real(dp) :: energy
    call model%named("kob-andersen")
    call potential%create(model, two, cube)
    call potential%evaluate(apart, energy)
    call potential%create(model, two, cube)  ! in place of the first
  end subroutine make_and_leave

  integer function resident_pages()
    integer :: unit, total
    open (newunit=unit, file="/proc/self/statm", action="read", status="old")
    read (unit, *) total, resident_pages
    close (unit)
  end function resident_pages
end program systems_test
