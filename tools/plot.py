#!/usr/bin/python3
"""Draw the figures of a run's folder: tools/plot.py DIR

Reads the files that `lanescape path`, `shorten`, `endpoints`, `diffusion`, `insert`, `flow`, `slab` and `analyze` write into DIR:
  result.json               outcome, length, landscape energy, ... of each path (required)
  run.toml                  the target temperature; for insertion also the model and the number of particles (optional)
  path-0001-trace.csv ...   one for each path in result.json
  path-0001.extxyz ...      only the first line, the number of particles (optional)
  path-0001-steps.csv, path-0001-particles.csv     histograms over steps, path lengths of particles (optional)
  initial-0001-nodes.csv, path-0001-nodes.csv      nodes of a path before and after shortening
  path-0001-trials.csv      lengths that the trials of a shortening found
  endpoints-trace.csv, radial-distribution.csv     if the run made end points
  diffusion.csv             correlations and displacements
  relaxation.csv            scattering function, alpha_2, chi_4 and displacements at lags spaced by factors
  densification.csv         growth at constant energy
  profiles.csv              density and states of a slab
  flow.csv, balance.csv, insertions.csv            a flow through a slab with open faces
  continuum.csv, alone.csv  the fluid on both sides of it, and the solver without the slab
  groups.csv, means.csv, distributions.csv, fits.csv, scaling.csv, scaling_points.csv     an analysis of finished runs
  scan.csv, holes.csv, errors.csv     cost of insertion, sizes of holes, convergence of errors
  map.csv                   energy of one more particle over a plane

Writes into DIR:
  path-0001.png ...   energy, distance to the goal, share of direct steps and participation ratio along the path
  paths.png           (DeltaR/g)^2 and n/N of all paths with mean and standard error, if two or more paths reached their goal
  statistics.png      distributions over the steps of all paths, and of the path lengths of particles over their displacements
  shortened.png       gap to the boundary, distance to the goal, multipliers and participation ratio along the path before and after
                      shortening
  shortening.png      path length against trials
  diffusion.png       velocity correlation, its integral and the mean squared displacement
  relaxation.png      scattering function, mean squared displacement, alpha_2 and chi_4 against the logarithm of time
  equilibration.png   temperature, potential energy, energy drift and radial distribution functions; for hard spheres
                      compressibility, collision rate and radial distribution functions
  analysis-scaling.png        D beside (DeltaR/g)^2 times one constant, against packing fraction or temperature
  analysis-fits.png           both with fits that vanish at a critical state, beside published ones
  analysis-participation.png, analysis-heterogeneity.png, analysis-overlaps.png     distributions over steps and particles of all groups
  densification.png   energy, pressure, temperature and excess energy against density; for the Lennard-Jones model with long-range
                      corrections also three equations of state at constant energy, from the density and temperature of the first row
  profiles.png        density and mean state probabilities along a slab
  flow.png, flow-profiles.png, flow-balance.png, flow-insertions.png     temperature, density and velocity against time; means along the
                      slab; balances of particles, energy and momentum; evaluations per insertion against density
  wave.png            a wave that passes from the fluid outside through the particles
  insertion-cost.png       evaluations by method and tolerance against density, and against temperature at densities with several
                           temperatures (at most the three highest such densities)
  insertion-distance.png   mean and largest distance between the start of a search and its result, against density
  insertion-step.png       evaluations against the largest step, if there are three or more largest steps
  insertion-holes.png      radii, anisotropy and eccentricity of regions of low energy against density
  insertion-errors.png     error at an evaluation and at the next one
  insertion-map.png        energy of one more particle over the plane x = 0, at four states at most
If a density has several temperatures, insertion figures show the temperature with most densities; only the panels against temperature,
insertion-errors.png and insertion-map.png show all. If there are several largest steps, they show the default, or else the first;
insertion-step.png shows all.

Exit status: 0; or 2 with one line on stderr if input is missing or cannot be read. Then nothing is drawn.
Lengths are in sigma, energies in epsilon, temperatures in epsilon/k_B.
"""

import sys
from pathlib import Path

from plot_analysis import draw_analysis, read_analysis
from plot_diffusion import draw_diffusion, read_diffusion
from plot_equilibration import draw_equilibration, read_equilibration
from plot_flow import draw_flow, read_flow
from plot_insertion import draw_insertion, read_insertion
from plot_path import draw_path, draw_paths, read_paths
from plot_path_statistics import draw_statistics, read_histograms, read_particle_ratios
from plot_relaxation import draw_relaxation, read_relaxation
from plot_shortening import draw_shortened, draw_shortening, read_shortened, read_trials
from plot_slab import draw_slab, read_slab
from plot_style import read_result, read_run_file
from unusable import Unusable, exit_status


def target_temperature(run):
    value = run.get("temperature")
    return float(value) if isinstance(value, (int, float)) else None


def draw_folder(folder):
    """All figures of a folder. All tables are read first: if one is missing or damaged, nothing is drawn."""
    result, run = read_result(folder), read_run_file(folder)
    analysis = read_analysis(folder)
    if analysis is not None:
        draw_analysis(folder, analysis)
        return
    paths = read_paths(folder, result)
    histograms, ratios = read_histograms(folder, paths), read_particle_ratios(folder, paths)
    equilibration, diffusion, relaxation = read_equilibration(folder), read_diffusion(folder), read_relaxation(folder)
    insertion, slab = read_insertion(folder), read_slab(folder)
    flow = read_flow(folder)
    trials, shortened = read_trials(folder), read_shortened(folder, result)
    if not paths and not insertion and all(table is None for table in (equilibration, diffusion, flow, relaxation, slab, trials, shortened)):
        raise Unusable(
            f"{folder}: neither paths in result.json nor a table of a shortening, end points, diffusion, insertion, a flow or a slab: nothing to draw")
    made = {**result, "model": result.get("model") or run.get("model", "")}
    temperature = target_temperature(run)
    for path in paths:
        draw_path(folder, path, made, temperature)
    draw_paths(folder, paths, made, temperature)
    draw_statistics(folder, paths, histograms, ratios, made, temperature)
    if diffusion is not None:
        draw_diffusion(folder, diffusion, made, temperature)
    if relaxation is not None:
        draw_relaxation(folder, relaxation, made, temperature)
    draw_insertion(folder, insertion, made, run)
    if shortened is not None:
        draw_shortened(folder, shortened, made, temperature)
    if trials is not None:
        draw_shortening(folder, trials, result)
    if flow is not None:
        draw_flow(folder, flow, run)
    if slab is not None:
        draw_slab(folder, slab)
    if equilibration is not None:
        draw_equilibration(folder, *equilibration, made, temperature, paths[0]["particles"] if paths else None)


def main(arguments):
    if len(arguments) != 1 or arguments[0].startswith("-"):
        wanted_help = arguments in (["-h"], ["--help"])
        text = __doc__ if wanted_help else "plot.py: needs one argument, the folder of a run"
        print(text, file=sys.stdout if wanted_help else sys.stderr)
        return 0 if wanted_help else 2
    return exit_status("plot.py", lambda: draw_folder(Path(arguments[0])))


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
