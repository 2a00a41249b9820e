! The energy and forces of a liquid.
program energy_of_a_liquid
  use lanescape
  implicit none
  integer, parameter :: dp = kind(1.0d0), n = 108
  type(lanescape_model) :: model
  type(lanescape_potential) :: potential
  integer :: species(n), stat
  real(dp) :: positions(3, n), box(3), energy, forces(3, n)
  character(200) :: errmsg

  call model%named("kob-andersen")
  call model%make_start(1.2_dp, species, positions, box)
  call potential%create(model, species, box)
  call potential%evaluate(positions, energy, forces=forces, stat=stat, errmsg=errmsg)
  if (stat /= lanescape_ok) error stop "no energy"  ! errmsg says why; without stat the library's call would end the program
  print '(a, f0.6)', "V = ", energy
end program energy_of_a_liquid
