! The module for Fortran programs. Positions, forces and velocities are arrays (3, N); particles and species are numbered from 1,
! though messages count from 0. Procedures have optional arguments stat, 0 for success and lanescape_bad_input or another for
! failure, and errmsg, which says what is wrong; a failure without stat ends the program with the message. Objects free what they
! hold when they go out of scope. Lengths, energies and masses are in any consistent units; k_B = 1.
module lanescape
  use lanescape_objects, only: lanescape_bad_input, lanescape_callback_error, lanescape_callback_failed, &
    lanescape_goal_not_reached, lanescape_internal, lanescape_interrupted, lanescape_ok, lanescape_version
  use lanescape_models
  use lanescape_potentials, only: lanescape_potential
  use lanescape_monte_carlo
  use lanescape_particles
  use lanescape_insertion
  use lanescape_landscapes, only: lanescape_landscape
  use lanescape_progress_reports, only: lanescape_progress
  use lanescape_end_point_pairs
  use lanescape_paths, only: lanescape_path, lanescape_path_settings
  use lanescape_short_paths
  use lanescape_trajectories
  use lanescape_collisions
  implicit none
end module lanescape
