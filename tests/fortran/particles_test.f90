! Neighbour pairs, overlaps, starts and insertion.
program particles_test
  use lanescape
  use check
  implicit none
  real(dp), parameter :: cube(3) = 10
  real(dp) :: apart(3, 2)
  integer :: stat
  character(200) :: errmsg

  apart = reshape([9.5_dp, 1.0_dp, 2.0_dp, 0.25_dp, 1.0_dp, 2.0_dp], [3, 2])  ! 0.75 across a face of the box
  call pairs_have_their_shift()
  call species_have_their_cutoffs()
  call points_have_neighbours()
  call overlaps_are_found()
  call particles_are_inserted()
  call finish()

contains

  subroutine pairs_have_their_shift()
    type(lanescape_neighbours) :: neighbours
    type(lanescape_pairs) :: pairs
    call neighbours%create(2.5_dp)
    call neighbours%find(apart, cube, pairs)
    call expect(all(pairs%first == [1, 2]) .and. all(pairs%second == [2, 1]), "both directions are found")
    call expect(all(pairs%shift(:, 1) == [1, 0, 0]) .and. all(pairs%shift(:, 2) == [-1, 0, 0]), "shifts are whole boxes")
    call expect(abs(pairs%separation(1, 1) - 0.75_dp) < 1e-15_dp, "separations are right")
    call expect(abs(pairs%distance(2) - 0.75_dp) < 1e-15_dp, "distances are right")
    call neighbours%exclude(reshape([1, 2], [2, 1]))
    call neighbours%find(apart, cube, pairs)
    call expect(size(pairs%first) == 0, "excluded pairs are not listed")
    call neighbours%exclude(reshape([1, 2, 3], [3, 1]), stat, errmsg)
    call refused(stat, errmsg, "pairs must be (2, number of pairs)")
    call neighbours%create(2.5_dp, half=.true., sorted=.false.)
    call neighbours%find(apart, cube, pairs)
    call expect(all(pairs%first == [1]) .and. all(pairs%second == [2]), "a half list has each pair once")
    call neighbours%create(2.5_dp, periodic=[.false., .true., .true.])
    call neighbours%find(apart, cube, pairs)
    call expect(size(pairs%first) == 0, "open axes have no images")
    call neighbours%find(apart(:, :0), cube, pairs)
    call expect(size(pairs%first) == 0 .and. size(pairs%shift, 2) == 0, "no particles have no pairs")
    call neighbours%find(apart(:2, :), cube, pairs, stat=stat, errmsg=errmsg)
    call refused(stat, errmsg, "positions has the shape (2, 2)")
    call neighbours%find(apart, [10.0_dp, -1.0_dp, 10.0_dp], pairs, stat=stat, errmsg=errmsg)
    call expect(stat == lanescape_bad_input, "a negative edge is refused")
  end subroutine pairs_have_their_shift

  subroutine species_have_their_cutoffs()
    type(lanescape_neighbours) :: neighbours
    type(lanescape_pairs) :: pairs
    real(dp) :: row(3, 3)
    row = 1
    row(1, :) = [1.0_dp, 2.0_dp, 3.0_dp]
    call neighbours%create(reshape([2.5_dp, 1.5_dp, 1.5_dp, 0.0_dp], [2, 2]), half=.true.)
    call neighbours%find(row, cube, pairs, [1, 2, 1])
    call expect(all(pairs%first == [1, 1, 2]) .and. all(pairs%second == [2, 3, 3]), "each pair of species has its cutoff")
    call neighbours%find(row, cube, pairs, [2, 2, 1])
    call expect(all(pairs%first == [2]) .and. all(pairs%second == [3]), "those of cutoff 0 are never listed")
    call neighbours%find(row, cube, pairs, [1, 2], stat, errmsg)
    call refused(stat, errmsg, "species has 2 elements: 3 are needed")
    call neighbours%find(row, cube, pairs, [1, 2, 3], stat, errmsg)
    call refused(stat, errmsg, "species 2")
    call neighbours%create(reshape([1.0_dp, 2.0_dp], [2, 1]), stat=stat, errmsg=errmsg)
    call refused(stat, errmsg, "cutoffs must be (S, S)")
    call neighbours%create(reshape([1.0_dp, 2.0_dp, 3.0_dp, 1.0_dp], [2, 2]), stat=stat, errmsg=errmsg)
    call refused(stat, errmsg, "must be equal")
    call neighbours%create(1.5_dp, origin=[0.5_dp, 0.0_dp, 0.0_dp], stat=stat)
    call neighbours%find(row, cube, pairs)
    call expect(stat == lanescape_ok .and. size(pairs%first) == 4, "the box's corner is free")
  end subroutine species_have_their_cutoffs

  subroutine points_have_neighbours()
    type(lanescape_neighbours) :: neighbours
    type(lanescape_pairs) :: pairs
    real(dp) :: points(3, 2)
    points = reshape([5.0_dp, 5.0_dp, 5.0_dp, 9.9_dp, 1.0_dp, 2.0_dp], [3, 2])
    call neighbours%create(0.5_dp)
    call neighbours%find_around(points, pairs, stat=stat, errmsg=errmsg)
    call expect(stat == lanescape_bad_input, "particles are needed first")
    call neighbours%set_particles(apart, cube)
    call neighbours%find_around(points, pairs)
    call expect(all(pairs%first == [2, 2]) .and. all(pairs%second == [1, 2]), "points have the particles within the cutoff")
    call expect(all(abs(pairs%distance - [0.4_dp, 0.35_dp]) < 1e-12_dp), "at their distances")
    call expect(all(pairs%shift(:, 2) == [1, 0, 0]) .and. abs(pairs%separation(1, 1) + 0.4_dp) < 1e-12_dp, "across faces too")
    call neighbours%find_around(points(:2, :), pairs, stat=stat, errmsg=errmsg)
    call refused(stat, errmsg, "points has the shape (2, 2)")
    call neighbours%create(reshape([0.5_dp, 0.0_dp, 0.0_dp, 0.5_dp], [2, 2]))
    call neighbours%set_particles(apart, cube, [1, 2])
    call neighbours%find_around(points, pairs, [1, 2])
    call expect(all(pairs%first == [2]) .and. all(pairs%second == [2]), "and points have species")
  end subroutine points_have_neighbours

  subroutine overlaps_are_found()
    type(lanescape_hard_spheres) :: spheres
    type(lanescape_overlaps) :: pairs
    logical :: any
    real(dp) :: gap, touching(3, 2)
    call spheres%create([0.5_dp, 0.5_dp], cube, skin=0.3_dp)
    call spheres%any_overlap(apart, any)
    call spheres%overlaps(apart, pairs)
    call spheres%smallest_gap(apart, gap)
    call expect(any .and. abs(gap + 0.25_dp) < 1e-15_dp, "an overlap is seen")
    call expect(all(pairs%first == [1]) .and. all(pairs%second == [2]) .and. abs(pairs%gap(1) - gap) < 1e-15_dp, "it is listed")
    touching = apart
    touching(1, 2) = 0.5_dp
    call spheres%any_overlap(touching, any)
    call spheres%overlaps(touching, pairs)
    call expect(.not. any .and. size(pairs%gap) == 0, "touching is not overlapping")
    call spheres%any_overlap(apart(:, :1), any, stat, errmsg)
    call refused(stat, errmsg, "positions has the shape (3, 1): (3, 2) is needed")
    call spheres%create([0.5_dp, -0.5_dp], cube, stat=stat, errmsg=errmsg)
    call refused(stat, errmsg, "radius -0.5 of particle 1")
  end subroutine overlaps_are_found

  subroutine particles_are_inserted()
    integer, parameter :: n = 108
    type(lanescape_model) :: model
    type(lanescape_inserter) :: inserter
    type(lanescape_insertion_settings) :: settings
    type(lanescape_inserted) :: inserted(3)
    integer :: species(n), k
    real(dp) :: positions(3, n), box(3), energy, force(3), region(3, 2)
    logical :: removed
    call model%named("lennard-jones")
    call model%make_start(0.4_dp, species, positions, box, seed=1)
    call expect(all(species == 1) .and. abs(n/product(box) - 0.4_dp) < 1e-12_dp, "a start has its density")
    call inserter%create(model, species, positions, box, kind=1)
    settings%energy = -4
    call inserter%find(settings, inserted)
    do k = 1, 3
      call inserter%energy(inserted(k)%position, energy, force)
      call expect(inserted(k)%found .and. abs(energy - inserted(k)%energy) < 1e-9_dp, "a position has its energy")
      call expect(abs(energy + 4) <= 0.04_dp .and. inserted(k)%evaluations > 0, "the energy is the target's")
    end do
    region(:, 1) = 0
    region(:, 2) = box/2
    call inserter%insert(settings, inserted(:2), region)
    call expect(inserter%particles() == n + 2, "particles are inserted")
    call expect(all(inserted(1)%position <= box/2), "in the region")
    call inserter%remove(inserted(1)%position, removed)
    call expect(removed, "one is there to be taken away")
    call expect(inserter%particles() == n + 1, "it is taken away")
    call inserter%add(inserted(1)%position)
    call expect(inserter%particles() == n + 2, "and put back")
    settings%method = "magic"
    call inserter%find(settings, inserted, stat=stat, errmsg=errmsg)
    call refused(stat, errmsg, "magic")
    call inserter%create(model, species, positions(:, 2:), box, stat=stat, errmsg=errmsg)
    call refused(stat, errmsg, "positions has the shape (3, 107): (3, 108) is needed")
    call model%make_start(-1.0_dp, species, positions, box, stat=stat, errmsg=errmsg)
    call expect(stat == lanescape_bad_input, "a negative density is refused")
  end subroutine particles_are_inserted
end program particles_test
