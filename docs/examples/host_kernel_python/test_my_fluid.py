"""The project's own kernel and its test. In a real project the kernel is imported from its package."""

import numpy


def my_lennard_jones(positions, box, cutoff):
    """Energy and forces of a one-component fluid, epsilon = sigma = 1, cut and shifted; all images within the cutoff count."""
    most = numpy.ceil(cutoff / box + 0.5).astype(int)
    shift = 4 * (cutoff**-12 - cutoff**-6)
    nearest = positions[:, None] - positions[None]
    nearest -= box * numpy.rint(nearest / box)
    energy, forces = 0.0, numpy.zeros_like(positions)
    for boxes in numpy.ndindex(*(2 * most + 1)):
        d = nearest + (numpy.array(boxes) - most) * box
        r2 = (d * d).sum(axis=-1)
        near = (r2 < cutoff * cutoff) & (r2 > 0)  # r = 0: the particle itself
        r2[~near] = numpy.inf
        energy += 0.5 * (4 * (r2**-6 - r2**-3) - shift)[near].sum()  # each pair is met twice
        forces += ((24 * (2 * r2**-6 - r2**-3) / r2)[..., None] * numpy.where(near[..., None], d, 0)).sum(axis=1)
    return energy, forces


def adapter(positions, box, species, parameters):
    """What lanescape_verify calls: None declines what the kernel does not do."""
    does = {"form": "lennard-jones", "truncation": "shifted", "images": "all"}
    if any(parameters[key] != value for key, value in does.items()) or len(parameters["sigma"]) > 1:
        return None
    return my_lennard_jones(positions, box, parameters["cutoff"][0, 0])


def test_the_kernel_agrees_with_the_reference(lanescape_verify):
    assert lanescape_verify(adapter)["compared"] >= 27
