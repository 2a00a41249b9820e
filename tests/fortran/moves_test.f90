! Monte Carlo moves, excluded pairs and sites in states.
program moves_test
  use lanescape
  use check
  implicit none
  integer, parameter :: n = 108
  real(dp), parameter :: cube(3) = 10
  integer :: stat
  character(200) :: errmsg

  call moves_change_the_energy()
  call bad_moves_are_refused()
  call excluded_pairs_do_not_interact()
  call sites_have_states()
  call finish()

contains

  subroutine moves_change_the_energy()
    type(lanescape_model) :: model
    type(lanescape_potential) :: potential
    type(lanescape_moves) :: moves
    integer :: species(n), k
    real(dp) :: positions(3, n), there(3, n), box(3), before, after, change
    call model%named("kob-andersen")
    call model%make_start(1.2_dp, species, positions, box)
    call potential%create(model, species, box)
    call moves%create(model, species, positions, box)
    call potential%evaluate(positions, before)
    do k = 1, n, 9
      there = positions
      there(:, k) = there(:, k) + [0.1_dp, -0.05_dp, 0.02_dp]
      call potential%evaluate(there, after)
      call moves%energy_change(k, there(:, k), change)
      call expect(abs(change - (after - before)) < 1e-9_dp*abs(before), "a move changes the energy as the potential tells")
      if (mod(k, 2) == 0) cycle
      call moves%accept()
      positions = there
      before = after
    end do
    call moves%get(there)
    call expect(all(abs(there - positions) <= 0), "moves that were made are kept")
  end subroutine moves_change_the_energy

  subroutine bad_moves_are_refused()
    type(lanescape_model) :: model
    type(lanescape_moves) :: moves, none
    real(dp) :: apart(3, 2), change, zero
    apart = reshape([9.5_dp, 1.0_dp, 2.0_dp, 1.0_dp, 1.0_dp, 2.0_dp], [3, 2])
    call model%named("lennard-jones")
    call moves%create(model, [1, 1], apart, cube, instruction_set="auto")
    call moves%accept(stat, errmsg)
    call refused(stat, errmsg, "no move to accept")
    call moves%energy_change(3, [1.0_dp, 1.0_dp, 1.0_dp], change, stat, errmsg)
    call refused(stat, errmsg, "particle 2 is not allowed")
    call moves%energy_change(0, [1.0_dp, 1.0_dp, 1.0_dp], change, stat, errmsg)
    call expect(stat == lanescape_bad_input, "particles are numbered from 1")
    zero = 0
    call moves%energy_change(1, [1.0_dp, 1.0_dp, zero/zero], change, stat, errmsg)
    call expect(stat == lanescape_bad_input, "coordinates are finite")
    call moves%get(apart(:, :1), stat, errmsg)
    call refused(stat, errmsg, "positions has the shape (3, 1): (3, 2) is needed")
    call moves%create(model, [1], apart, cube, stat=stat, errmsg=errmsg)
    call refused(stat, errmsg, "positions has the shape (3, 2): (3, 1) is needed")
    call none%accept(stat, errmsg)
    call refused(stat, errmsg, "argument moves is NULL")
  end subroutine bad_moves_are_refused

  subroutine excluded_pairs_do_not_interact()
    type(lanescape_model) :: model
    type(lanescape_potential) :: potential
    real(dp) :: three(3, 3), energy, pair
    three = 1
    three(1, :) = [1.0_dp, 2.0_dp, 3.0_dp]
    call model%named("lennard-jones")
    call potential%create(model, [1, 1], cube)
    call potential%evaluate(three(:, :2), pair)
    call potential%create(model, [1, 1, 1], cube)
    call potential%set_exclusions(reshape([1, 3, 2, 3], [2, 2]))
    call potential%evaluate(three, energy)
    call expect(abs(energy - pair) < 1e-12_dp, "excluded pairs do not interact")
    call potential%set_exclusions(reshape([integer ::], [2, 0]))
    call potential%evaluate(three, energy)
    call expect(abs(energy - pair) > 0.01_dp, "they can be taken back")
    call potential%set_exclusions(reshape([1, 4], [2, 1]), stat, errmsg)
    call expect(stat == lanescape_bad_input, "particles of pairs are there")
    call potential%set_exclusions(reshape([1, 2, 3], [3, 1]), stat, errmsg)
    call refused(stat, errmsg, "pairs must be (2, number of pairs)")
  end subroutine excluded_pairs_do_not_interact

  subroutine sites_have_states()
    type(lanescape_model) :: model
    type(lanescape_potential) :: potential
    integer :: species(n)
    real(dp) :: positions(3, n), box(3), energy
    real(dp), allocatable :: order(:), p(:, :)
    call model%named("ucg")
    call model%make_start(0.5_dp, species, positions, box)
    call potential%create(model, species, box)
    call potential%evaluate(positions, energy)
    call potential%states(order, p)
    call expect(size(order) == n .and. all(shape(p) == [2, n]), "each site has an order parameter and two states")
    call expect(all(abs(sum(p, dim=1) - 1) < 1e-14_dp) .and. minval(p) >= 0, "probabilities add up to one")
    call expect(minval(order) > 0, "order parameters are densities")
    call potential%states(probabilities=p)
    call expect(all(shape(p) == [2, n]), "one of both can be asked for")
    call model%named("lennard-jones")
    call potential%create(model, [1, 1], cube)
    call potential%states(order, stat=stat, errmsg=errmsg)
    call refused(stat, errmsg, "sites in states")
  end subroutine sites_have_states
end program moves_test
