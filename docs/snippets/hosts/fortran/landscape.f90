! A path of one particle in a plane, around a hill that it may not climb.
module hills
  implicit none
  integer, parameter :: dp = kind(1.0d0)

contains

  subroutine hill(positions, energy, gradient, stat)
    real(dp), intent(in) :: positions(:, :)
    real(dp), intent(out) :: energy
    real(dp), intent(out), optional :: gradient(:, :)
    integer, intent(inout) :: stat  ! anything but 0 ends the search and comes back
    energy = 5*exp(-sum(positions(:2, 1)**2))
    if (present(gradient)) gradient(:, 1) = [-2*positions(1, 1)*energy, -2*positions(2, 1)*energy, 0.0_dp]
    if (.not. energy >= 0) stat = 1
  end subroutine hill
end module hills

program path_around_a_hill
  use lanescape
  use hills
  implicit none
  type(lanescape_path) :: path
  type(lanescape_path_settings) :: settings
  type(lanescape_short_path) :: shortest
  type(lanescape_shorten_settings) :: shortening
  real(dp) :: start(3, 1), finish(3, 1)

  start(:, 1) = [-2.0_dp, 0.1_dp, 0.0_dp]
  finish(:, 1) = [2.0_dp, 0.1_dp, 0.0_dp]
  settings%landscape_energy = 1.0_dp
  call path%find_on(hill, start, finish, settings)
  print '(2a, f0.3)', path%outcome, ", length ", path%length

  shortening%search = settings
  call shortest%shorten_on(hill, start, finish, settings=shortening)
  print '(a, f0.3, a, es7.1)', "shortened to ", shortest%length, ", Kuhn-Tucker residual ", shortest%kuhn_tucker_residual
end program path_around_a_hill
