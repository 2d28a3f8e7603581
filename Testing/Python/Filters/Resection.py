# SPDX-License-Identifier: BSD-3-Clause
# Proves how much tumour is left after a resection that moved the brain: volumes by fractions of
# voxels, and the interval, on 20 synthetic cases whose deformation is of another kind than the fit
# assumes; that draws of a fit have its mean and deviation; that the label maps lie in their frames.
import os

import numpy
from brainshift_testing import assert_says, ball, load_plugin, run_tests, scratch, volume

load_plugin()
import brainshift  # noqa: E402 after the plugin
from brainshift.images import Labels  # noqa: E402
from paraview import simple  # noqa: E402

SIDE, SPACING, RADIUS = 61, 2.5, 60.0  # voxels; mm; mm: a brain of 12 cm
MIDDLE = numpy.full(3, (SIDE - 1) / 2 * SPACING)
TOP = MIDDLE + (0.0, 0.0, RADIUS)
OPENING = 30.0  # mm, radius of the craniotomy
CASES = 20
LARGEST = 12.0  # mm, of the shift


def unit(vector):
    return vector / numpy.linalg.norm(vector)


class Shift:
    """Two bumps with compact support, one of them sideways: polynomials, no Gaussian process."""

    def __init__(self, random):
        self.bumps = []
        for largest, reach in ((random.uniform(4.0, 10.5), random.uniform(50.0, 75.0)),
                               (random.uniform(0.5, 2.5), random.uniform(35.0, 50.0))):
            aside = random.normal(0.0, 0.35 if not self.bumps else 1.0, 3)
            towards = unit(aside - (0, 0, 1)) if not self.bumps else unit(aside)
            centre = TOP + numpy.append(random.uniform(-12.0, 12.0, 2), 0.0)
            self.bumps.append((centre, largest * towards, reach))

    def __call__(self, rest):
        moved = numpy.zeros(rest.shape)
        for centre, largest, reach in self.bumps:
            away = numpy.minimum(1.0, numpy.linalg.norm(rest - centre, axis=-1) / reach)
            moved += ((1.0 - away ** 2) ** 2)[..., None] * largest
        return rest + moved

    def inverse(self, deformed):
        rest = deformed.copy()
        for _ in range(15):  # it contracts by a half or more
            rest = deformed - (self(rest) - rest)
        return rest


class Ellipsoid:
    def __init__(self, centre, axes):
        self.centre, self.axes = numpy.array(centre), numpy.array(axes)

    def holds(self, positions):
        return (((positions - self.centre) / self.axes) ** 2).sum(axis=-1) < 1.0


def grid(low, high, spacing):
    """Positions indexed [z, y, x], and the source properties of such a grid."""
    axes = [numpy.arange(a, b, spacing) for a, b in zip(low, high)]
    z, y, x = numpy.meshgrid(*axes[::-1], indexing="ij")
    return numpy.stack((x, y, z), axis=-1), {"origin": tuple(low), "spacing": (spacing,) * 3}


def labels(shape, positions, placed):
    return volume(shape(positions).astype(numpy.uint8), **placed)


class Patient:
    """A brain, a tumour in it, and a cavity after the shift."""

    def __init__(self, seed):
        random = numpy.random.default_rng(seed)
        self.shift = Shift(random)
        depth = random.uniform(16.0, 28.0)
        self.tumour = Ellipsoid(TOP + (*random.uniform(-12.0, 12.0, 2), -depth),
                                random.uniform(9.0, 15.0, 3))
        self.taken = Ellipsoid(
            self.tumour.centre + random.uniform(2.0, 8.0) * unit(random.normal(size=3)),
            self.tumour.axes * random.uniform(0.8, 1.05))
        box = self.tumour.centre - 17.0, self.tumour.centre + 17.0
        positions, placed = grid(*box, 1.0)
        self.labels = labels(self.tumour.holds, positions, placed)
        fine, _ = grid(*box, 0.5)
        inside = self.tumour.holds(fine)
        self.before = inside.sum() * 0.125 / 1000.0  # ml
        self.left = (inside & ~self.taken.holds(fine)).sum() * 0.125 / 1000.0
        positions, placed = grid(box[0] - 12.0, box[1] + 12.0, 1.0)
        self.cavity = labels(lambda deformed: self.taken.holds(self.shift.inverse(deformed)),
                             positions, placed)
        self.trace = self.traced(random)

    def traced(self, random):
        """300 points of the exposed cortex after the shift, with the noise of a pointer."""
        normals = random.normal(size=(6000, 3))
        cortex = MIDDLE + RADIUS * normals / numpy.linalg.norm(normals, axis=1)[:, None]
        exposed = cortex[numpy.linalg.norm(cortex - TOP, axis=1) < OPENING][:300]
        return self.shift(exposed) + random.normal(0.0, random.uniform(0.4, 0.8), exposed.shape)


def bent_brain():
    voxels = ball(side=SIDE, radius=RADIUS / SPACING)
    return simple.FreeFormDeformation(Input=volume(voxels, spacing=(SPACING,) * 3))


def fitted(patient):
    bent = bent_brain()
    brainshift.fit(bent, traces=patient.trace, threshold=50.0, opening=(TOP, OPENING))
    return bent


def test_draws_have_the_mean_and_the_deviation_of_the_fit():
    bent = fitted(Patient(7))
    fit = brainshift.Fit(bent.Lattice)
    points = TOP + [(0.0, 0.0, -2.0), (0.0, 0.0, -25.0), (3.0, 0.0, -25.0), (0.0, 0.0, -110.0)]
    drawn = fit.draws(points, count=4000, seed=1)
    assert drawn.shape == (4000, 4, 3)
    deviation = fit.deviation(points)
    off = numpy.abs(drawn.mean(axis=0) - fit.measured_from_rest(points)).max(axis=1)
    assert (off < 0.08 * deviation).all(), (off, deviation)
    own = numpy.sqrt(drawn.var(axis=0).mean(axis=1))
    assert numpy.allclose(own, deviation, rtol=0.04), (own, deviation)
    across = drawn[:, 0].std(axis=0)
    assert across[2] < 0.5 * min(across[:2]), "a traced cortex slides, and does not sink"
    apart = (drawn[:, 2] - drawn[:, 1]).std(axis=0)
    assert (apart < 0.25 * deviation[1]).all(), "neighbours move together"
    assert numpy.array_equal(fit.draws(points, 5, seed=3), fit.draws(points, 5, seed=3))


def test_draws_name_what_is_wrong():
    fit = brainshift.Fit(fitted(Patient(7)).Lattice)
    for points, word in ((numpy.zeros((1001, 3)), "1001"), (numpy.empty((0, 3)), "0 positions")):
        try:
            fit.draws(points)
        except ValueError as error:
            assert_says(str(error), word)
        else:
            raise AssertionError(f"{len(points)} points are drawn")


def test_without_a_bend_the_volumes_are_those_of_the_shapes():
    bent = bent_brain()
    tumour = Ellipsoid(MIDDLE, (12.0, 10.0, 9.0))
    taken = Ellipsoid(MIDDLE + (4.0, 0, 0), (9.0, 9.0, 9.0))
    positions, placed = grid(MIDDLE - 20.0, MIDDLE + 20.0, 1.0)
    source = labels(tumour.holds, positions, placed)
    coarse, other = grid(MIDDLE - 21.3, MIDDLE + 20.0, 1.7)  # voxels of another size and place
    found = brainshift.resect(bent, source, labels(taken.holds, coarse, other))
    fine, _ = grid(MIDDLE - 20.0, MIDDLE + 20.0, 0.25)
    left = (tumour.holds(fine) & ~taken.holds(fine)).sum() / 64.0 / 1000.0
    print(f"  {found}; in truth {left:.3f} ml are left")
    assert abs(found.before - tumour.holds(positions).sum() / 1000.0) < 1e-6
    assert abs(found.before - found.removed - found.left) < 1e-9
    assert abs(found.left - left) < 0.02 * left, (found.left, left)
    assert abs(found.left_after - found.left) < 1e-3 * left
    assert found.left_interval is None
    assert_says(found.reason, "no interval", "fit")


def test_a_rigid_motion_beside_the_deformation_is_refused():
    bent = bent_brain()
    rest = MIDDLE + numpy.random.default_rng(1).uniform(-30.0, 30.0, (8, 3))
    fit = brainshift.fit(bent, rest=rest, measured=rest + (9.0, 0.0, 0.0))
    assert abs(fit.rigid[0, 3]) > 5.0, fit.rigid
    positions, placed = grid(MIDDLE - 20.0, MIDDLE + 20.0, 2.0)
    source = labels(Ellipsoid(MIDDLE, (12.0, 10.0, 9.0)).holds, positions, placed)
    try:
        brainshift.resect(bent, source, source, fields=50)
    except ValueError as error:
        assert_says(str(error), "rigid motion", "align")
    else:
        raise AssertionError("a rigid motion is ignored")


def test_twenty_cases():
    errors, hits, widths, moved = [], [], [], []
    for seed in range(CASES):
        patient = Patient(2000 + seed)
        found = brainshift.resect(fitted(patient), patient.labels, patient.cavity, seed=seed)
        low, high = found.left_interval
        errors.append((found.left - patient.left, patient.left))
        hits.append(low <= patient.left <= high)
        widths.append(high - low)
        top = patient.shift(TOP[None]) - TOP
        moved.append(numpy.linalg.norm(top))
        print(f"  {seed}: {found}; in truth {patient.left:.2f} ml; moved {moved[-1]:.1f} mm")
        assert found.fields == 100 and abs(found.before / patient.before - 1.0) < 0.01
    off, left = numpy.array(errors).T
    print(f"  off {off.mean():+.3f} ml in the mean, {numpy.abs(off).mean():.3f} without sign, "
          f"{numpy.abs(off).max():.3f} at most, of {left.mean():.2f}; {sum(hits)} of {CASES} in "
          f"the interval of {numpy.mean(widths):.2f} ml; moved {max(moved):.1f} mm")
    assert max(moved) <= LARGEST
    assert abs(off.mean()) < max(0.5, 0.1 * left.mean()), off
    assert 0.80 <= numpy.mean(hits) <= 0.98, hits


def test_the_maps_lie_in_their_frames():
    patient = Patient(8)
    bent = fitted(patient)
    found = brainshift.resect(bent, patient.labels, patient.cavity, fields=50)
    rest, after = (Labels(image, [1, 2]) for image in (found.map, found.map_after))
    assert abs(rest.inside.sum() / 1000.0 - found.before) < 1e-6

    def middle(labels):
        z, y, x = numpy.nonzero(labels.inside)
        return labels.positions(numpy.stack((x, y, z), axis=1)).mean(axis=0)
    expected = brainshift.deformed_from_rest(bent, middle(rest)[None])[0]
    assert numpy.linalg.norm(middle(after) - expected) < 0.3, (middle(after), expected)
    assert numpy.linalg.norm(expected - middle(rest)) > 1.0
    left = Labels(found.map, [1]).inside.sum() / 1000.0
    assert abs(left - found.left_by_fit) < 0.05 * found.before, (left, found.left_by_fit)
    after_ml = Labels(found.map_after, [1]).inside.sum() / 1000.0
    assert abs(after_ml - found.left_after) < 0.05 * found.before, (after_ml, found.left_after)
    found.save(scratch("left.nii.gz"), "deformed", world="RAS")
    assert os.path.getsize(scratch("left.nii.gz")) > 100


run_tests(globals())
