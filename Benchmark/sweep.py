# SPDX-License-Identifier: BSD-3-Clause
"""Ultrasound of a T1 head, simulated to be as hard to register as a real sweep. Numpy alone.

What makes it hard: interfaces that are silent at random, scatter that the MR does not show, stray
bright sheets, gain that varies with depth and across, shadows, speckle. Each of them that is left
out makes registrations succeed that fail on patients. The knobs are calibrated to how clearly the
right position stands out (separation.py), not to pictures.

Positions `local` are mm along the axes of the sweep's grid, from its first point. Arrays are
indexed z, y, x; positions are x, y, z.
"""

import dataclasses
import gzip
import struct

import numpy

STEP_MM = 0.5
SIDES = (94, 107, 107)  # points along z, y, x
LANDMARKS = 60
PARTS = ("place", "move", "lesion", "scatter", "echo", "gain", "speckle", "noise", "landmarks")


@dataclasses.dataclass(frozen=True)
class Knobs:
    """Lengths are mm. 0 leaves a part out, if nothing else is said."""

    depth: float = 46.0  # of the fan
    width: float = 44.0  # of the fan, across its slices
    lift: float = 30.0  # of the fan's apex above the probe
    sulci: float = 2.2  # loudness of sulci
    facing: float = 2.0  # loudness of interfaces that face the probe
    silent: float = 1.6  # deviation of the logarithm of the loudness of interfaces
    unrelated: float = 0.6  # deviation of the logarithm of scatter that the MR does not show
    strays: float = 1.5  # loudness of bright sheets that the MR does not show
    lesion: float = 0.5
    tail: float = 1.5  # an echo rings on over so many mm
    gain: float = 0.5  # deviation of the logarithm of the gain
    depth_loss: float = 0.35
    shadows: int = 3
    speckle: float = 0.7
    bend: float = 0.9  # root mean square of a smooth deformation
    bend_width: float = 18.0
    slide: float = 0.0  # the sides of a plane along the beam move apart by so much
    cavity: float = 0.0  # radius of a resection with air on top
    press: float = 0.0  # the probe presses tissue inwards by so much


def smooth(values, sigmas):
    """Gaussian along each axis; beyond the border the nearest value holds. Sigmas in points."""
    for axis, sigma in enumerate(numpy.broadcast_to(sigmas, values.ndim)):
        radius = int(numpy.ceil(3.5 * sigma))
        if sigma <= 0 or radius == 0:
            continue
        kernel = numpy.exp(-0.5 * (numpy.arange(-radius, radius + 1) / sigma) ** 2)
        kernel = (kernel / kernel.sum()).astype(numpy.float32)
        count = values.shape[axis]
        padded = numpy.pad(values, [(radius, radius) if a == axis else (0, 0)
                                    for a in range(values.ndim)], "edge")
        lines = numpy.moveaxis(padded, axis, 0)
        values = numpy.moveaxis(sum(weight * lines[i : i + count]
                                    for i, weight in enumerate(kernel)), 0, axis)
    return values


def trilinear(values, index):
    """Values at positions in points (x, y, z), clamped to the border."""
    last = numpy.array(values.shape[::-1]) - 1
    at = numpy.clip(index, 0, last).astype(numpy.float32)
    low = numpy.minimum(at.astype(numpy.int32), last - 1)
    x, y, z = numpy.moveaxis(at - low, -1, 0)
    flat = numpy.ascontiguousarray(values).ravel()
    row = values.shape[2]
    first = (low[..., 2] * values.shape[1] + low[..., 1]) * row + low[..., 0]

    def line(offset):
        return flat[first + offset] * (1 - x) + flat[first + offset + 1] * x

    def plane(offset):
        return line(offset) * (1 - y) + line(offset + row) * y
    return plane(0) * (1 - z) + plane(row * values.shape[1]) * z


def opened(values, side):
    """What is left of bright parts that are narrower than `side` points: nothing."""
    def extremes(values, pick):
        for axis in range(3):
            moved = numpy.moveaxis(numpy.pad(values, [(side // 2,) * 2 if a == axis else (0, 0)
                                                      for a in range(3)], "edge"), axis, 0)
            covered, count = 1, values.shape[axis]
            while covered < side:
                by = min(covered, side - covered)
                moved = pick(moved[:-by], moved[by:])
                covered += by
            values = numpy.moveaxis(moved[:count], 0, axis)
        return values
    return extremes(extremes(values, numpy.minimum), numpy.maximum)


def field(random, mm, sides=SIDES, step=STEP_MM):
    """Smooth noise that is correlated over about `mm`: mean 0, deviation 1."""
    sigma = mm / step / 2
    coarser = max(1, int(sigma / 2))
    coarse = [int(numpy.ceil(side / coarser)) + 8 for side in sides]
    noise = smooth(random.normal(size=coarse).astype(numpy.float32), sigma / coarser)
    noise = (noise - noise.mean()) / noise.std()
    if coarser == 1:
        return noise[tuple(slice(3, 3 + side) for side in sides)]
    axes = [numpy.arange(side, dtype=numpy.float32) / coarser + 3 for side in sides]
    return trilinear(noise, numpy.stack(numpy.meshgrid(*axes, indexing="ij")[::-1], -1))


def unit(vector):
    return vector / numpy.linalg.norm(vector)


def logistic(values):
    return 1 / (1 + numpy.exp(numpy.clip(values, -40, 40)))


def read_nifti(path):
    """Values (z, y, x) and the affine from points to mm, RAS, of an upright NIfTI file."""
    data = (gzip.open if str(path).endswith(".gz") else open)(path, "rb").read()
    sides = struct.unpack("<3h", data[42:48])
    kinds = {2: "u1", 4: "<i2", 8: "<i4", 16: "<f4", 256: "i1", 512: "<u2"}
    kind = numpy.dtype(kinds[struct.unpack("<h", data[70:72])[0]])
    values = numpy.frombuffer(data, kind, numpy.prod(sides),
                              int(struct.unpack("<f", data[108:112])[0]))
    affine = numpy.vstack([numpy.array(struct.unpack("<12f", data[280:328])).reshape(3, 4),
                           [0, 0, 0, 1]])
    return values.reshape(sides[::-1]).astype(numpy.float32), affine


def write_nifti(path, values, affine):
    """Writes a volume of numbers as float32 or uint8 NIfTI."""
    kind, bits = (2, 8) if values.dtype == numpy.uint8 else (16, 32)
    header = bytearray(352)
    header[0:4] = struct.pack("<i", 348)
    header[40:56] = struct.pack("<8h", 3, *values.shape[::-1], 1, 1, 1, 1)
    header[70:74] = struct.pack("<2h", kind, bits)
    steps = numpy.linalg.norm(affine[:3, :3], axis=0)
    header[76:108] = struct.pack("<8f", 1, *steps, 1, 1, 1, 1)
    header[108:120] = struct.pack("<3f", 352, 1, 0)
    header[123] = 2  # mm
    header[252:256] = struct.pack("<2h", 0, 1)
    header[280:328] = struct.pack("<12f", *affine[:3].ravel())
    header[344:348] = b"n+1\0"
    values = values if kind == 2 else values.astype("<f4")
    with open(path, "wb") as file:
        file.write(bytes(header) + numpy.ascontiguousarray(values).tobytes())


class Head:
    """A T1 volume and the mask of its brain, on one grid."""

    def __init__(self, volume, mask):
        self.values, self.affine = read_nifti(volume)
        self.mask = (read_nifti(mask)[0] > 0).astype(numpy.float32)
        self.inverse = numpy.linalg.inv(self.affine)
        brain = self.values[self.mask > 0.5]
        self.top = numpy.percentile(self.values, 99)
        self.centres = _three_means(brain[:: max(1, len(brain) // 100000)])

    def points(self, world):
        return world @ self.inverse[:3, :3].T + self.inverse[:3, 3]

    def fractions(self, values):
        """How much of each value is fluid, grey and white."""
        width = 0.45 * numpy.diff(self.centres).mean()
        weights = numpy.exp(-((values[..., None] - self.centres) / width) ** 2) + 1e-6
        weights[..., 0] = numpy.where(values < self.centres[0], 1, weights[..., 0])
        return (weights / weights.sum(-1, keepdims=True)).astype(numpy.float32)

    def middle(self):
        return numpy.argwhere(self.mask > 0.5).mean(0)[::-1] @ self.affine[:3, :3].T \
            + self.affine[:3, 3]


def _three_means(values):
    centres = numpy.percentile(values, [2, 35, 85])
    for _ in range(15):
        nearest = numpy.abs(values[:, None] - centres).argmin(1)
        centres = numpy.array([values[nearest == k].mean() for k in range(3)])
    return centres


class Sweep:
    """A sweep over a head.

    - `ultrasound`: uint8, 0 outside the fan; `affine` from its points to mm
    - `mr(contrast)`: values and affine, "t1" or "flair"
    - `rest`, `measured`: the same tissue in the MR and in the ultrasound (n x 3, mm)
    """

    def __init__(self, head, seed, **knobs):
        self.head, self.seed = head, seed
        self.knobs = Knobs(**knobs)
        self.randoms = {part: numpy.random.default_rng((seed, number))
                        for number, part in enumerate(PARTS)}
        self._place()
        self._beam()
        self._move()
        self._tissue()
        self._lesion()
        self._image()
        self._landmarks()

    def _place(self):
        """The probe on the brain, its beam inwards, not at the middle; an oblique grid."""
        random, head = self.randoms["place"], self.head
        down = unit(random.normal(size=3))
        while down[2] <= 0.1:
            down = unit(random.normal(size=3))
        middle, away = head.middle(), 30.0
        while trilinear(head.mask, head.points(middle + down * away)) > 0.5:
            away += 0.5
        aside = random.normal(size=3)
        aside = unit(aside - aside @ down * down)
        self.beam = unit(-down + 0.25 * aside)
        second = unit(numpy.cross(-self.beam, aside))
        third = numpy.cross(-self.beam, second)
        c, s = numpy.cos(numpy.deg2rad(25)), numpy.sin(numpy.deg2rad(25))
        axes = numpy.stack([-c * self.beam + s * second, s * self.beam + c * second, third], 1)
        self.affine = numpy.eye(4)
        self.affine[:3, :3] = STEP_MM * axes
        self.centre = (numpy.array(SIDES[::-1]) - 1) * STEP_MM / 2
        centre_world = middle + down * away + self.beam * (self.knobs.depth / 2 - 2)
        self.affine[:3, 3] = centre_world - axes @ self.centre
        self.axes = axes
        index = numpy.stack(numpy.meshgrid(*[numpy.arange(n) for n in SIDES], indexing="ij")[::-1],
                            -1)
        self.local = index.astype(numpy.float32) * numpy.float32(STEP_MM)

    def world(self, local):
        return local @ self.axes.T + self.affine[:3, 3]

    def _beam(self):
        """Depth and angles of each point, as the probe sees it."""
        knobs = self.knobs
        self.ahead = self.axes.T @ self.beam
        self.apex = self.centre - self.ahead * (knobs.depth / 2 + knobs.lift)
        self.aside = unit(numpy.cross(self.ahead, [0, 0, 1.0]))
        self.across = numpy.cross(self.ahead, self.aside)
        rays = (self.local - self.apex).astype(numpy.float32)
        distance = numpy.linalg.norm(rays, axis=-1)
        self.rays = rays / distance[..., None]
        self.depth = distance - knobs.lift
        self.angle = numpy.arctan2(self.rays @ self.aside, self.rays @ self.ahead)
        self.slice = self.rays @ self.across * distance
        fan = (self.depth > 0) & (self.depth < knobs.depth - 1)
        fan &= numpy.abs(self.angle) < 0.42 + 0.03 * numpy.sin(self.slice / 4)
        fan &= numpy.abs(self.slice) < knobs.width / 2 - 8
        last = (numpy.array(SIDES[::-1]) - 2) * STEP_MM
        self.fan = fan & numpy.all((self.local > STEP_MM) & (self.local < last), -1)

    def _move(self):
        """What moved since the MR, in the ultrasound's frame: tissue at x was at x - moved(x)."""
        random, knobs = self.randoms["move"], self.knobs
        moved = numpy.stack([field(random, knobs.bend_width) for _ in range(3)], -1)
        moved *= knobs.bend / numpy.sqrt((moved**2).sum(-1).mean())
        if knobs.slide:
            side = numpy.sign((self.local - self.centre) @ self.aside)
            along = unit(self.ahead + self.across)
            moved += 0.5 * knobs.slide * side[..., None] * along
        if knobs.press:
            near = numpy.exp(-numpy.maximum(self.depth, 0) / 15 - (self.angle / 0.35) ** 2)
            moved += knobs.press * near[..., None] * self.ahead
        self.moved = moved.astype(numpy.float32)
        self.was = self.head.points(self.world(self.local - self.moved)).astype(numpy.float32)

    def _tissue(self):
        self.brain = numpy.clip(trilinear(self.head.mask, self.was), 0, 1)
        self.fractions = self.head.fractions(trilinear(self.head.values, self.was))
        self.fractions *= self.brain[..., None]
        fluid = self.fractions[..., 0] + 0.5 * (1 - self.brain)
        self.thin = numpy.clip(fluid - opened(fluid, 13), 0, 1)

    def _lesion(self):
        """A lesion in the ultrasound; the one of the MR has another shape and place."""
        random = self.randoms["lesion"]
        inside = numpy.argwhere(self.brain > 0.9)
        at = 0.5 * self.local[tuple(inside[random.integers(len(inside))])] \
            + 0.5 * (self.centre + 2 * self.ahead)
        self.lesion_at, self.lesion_radius = at, random.uniform(6, 9)
        away = numpy.linalg.norm((self.local - at) * [1, 0.8, 1.1], axis=-1)
        self.lesion = logistic(
            (away - self.lesion_radius * (1 + 0.2 * field(random, 8))) / 0.7)

    def _scatter(self):
        """Tissues differ by chance, and by something that the MR does not show."""
        random, knobs = self.randoms["scatter"], self.knobs
        of_tissue = random.uniform(0.35, 0.65, 3)
        of_tissue[0] = 0.15
        scatter = self.fractions @ of_tissue + 0.3 * (1 - self.brain)
        unrelated = field(random, 10) + 0.7 * field(random, 4)
        return scatter * numpy.exp(knobs.unrelated * unrelated) * (
            1 + knobs.lesion * 1.6 * self.lesion)

    def _loudness(self, mm):
        silent = self.knobs.silent
        return numpy.exp(silent * field(self.randoms["echo"], mm) - 0.5 * silent**2)

    def _echo(self):
        """Sulci, interfaces that face the probe, stray sheets; all ring on in the depth."""
        random, knobs = self.randoms["echo"], self.knobs
        impedance = smooth(self.fractions @ numpy.array([1, 0, 0.25], numpy.float32)
                           + 0.8 * (1 - self.brain), 0.8)
        slope = numpy.stack(numpy.gradient(impedance)[::-1], -1)
        steep = numpy.linalg.norm(slope, axis=-1) + 1e-6
        faces = numpy.abs((slope * self.rays).sum(-1)) / steep
        echo = knobs.sulci * 1.2 * self.thin * (0.4 + 0.6 * faces**2) * self._loudness(7)
        echo += knobs.facing * 4 * steep * faces**3 * self._loudness(6)
        echo += 1.5 * numpy.clip(field(random, 1.5) - 2.3, 0, None) * (self.thin > 0.15)
        for _ in range(2):
            sheet = field(random, 9)
            sheet /= numpy.linalg.norm(numpy.gradient(sheet, STEP_MM), axis=0) + 0.05
            echo += knobs.strays * self.brain * numpy.exp(-(sheet / 0.5) ** 2) * numpy.clip(
                field(random, 9) - 0.6, 0, 1.5)
        return self._ringing(echo) if knobs.tail else echo

    # Depth, angle and slice: the axes along which a probe makes its picture.
    def _polar_sides(self):
        return int(self.knobs.depth / STEP_MM) + 8, 111, 111

    def _to_polar(self, values):
        depths, angles, slices = self._polar_sides()
        d, a, s = numpy.meshgrid(
            STEP_MM * numpy.arange(depths), numpy.linspace(-0.62, 0.62, angles),
            numpy.linspace(-30, 30, slices), indexing="ij")
        ahead = numpy.sqrt(numpy.maximum((d + self.knobs.lift) ** 2 - s**2, 1))
        at = self.apex + (ahead * numpy.cos(a))[..., None] * self.ahead \
            + (ahead * numpy.sin(a))[..., None] * self.aside + s[..., None] * self.across
        return trilinear(values, at / STEP_MM)

    def _from_polar(self, polar):
        _, angles, slices = polar.shape
        return trilinear(polar, numpy.stack(
            [(self.slice + 30) / 60 * (slices - 1), (self.angle + 0.62) / 1.24 * (angles - 1),
             self.depth / STEP_MM], -1))

    def _ringing(self, echo):
        polar = self._to_polar(echo)
        weights = numpy.exp(-STEP_MM * numpy.arange(12) / self.knobs.tail)
        tail = numpy.zeros_like(polar)
        for i, weight in enumerate(weights / weights.sum()):
            tail[i:] += weight * polar[: polar.shape[0] - i]
        return self._from_polar(0.5 * polar + 0.8 * tail)

    def _gain(self):
        """Gain along and across the beam, and shadows."""
        random, knobs = self.randoms["gain"], self.knobs
        gain = knobs.gain * numpy.interp(
            self.depth.ravel(), numpy.linspace(0, knobs.depth, 7), random.normal(size=7))
        gain += 0.5 * knobs.gain * numpy.interp(
            self.angle.ravel(), numpy.linspace(-0.6, 0.6, 6), random.normal(size=6))
        gain = gain.reshape(SIDES) - knobs.depth_loss * (2 * self.depth / knobs.depth - 1)
        light = numpy.exp(gain)
        for _ in range(knobs.shadows):
            angle, across, begin = (random.uniform(*limits)
                                    for limits in ((-0.5, 0.5), (-20, 20), (0, 25)))
            wide, long, dark = (random.uniform(*limits)
                                for limits in ((0.05, 0.12), (4, 9), (0.4, 0.85)))
            light *= 1 - dark * logistic(-(self.depth - begin) / 1.5) * numpy.exp(
                -((self.angle - angle) / wide) ** 2 - ((self.slice - across) / long) ** 2)
        return light

    def _speckle(self):
        """Grains of a point spread along the beam, across, and between slices."""
        if not self.knobs.speckle:
            return 1.0
        random, spread = self.randoms["speckle"], (0.4, 0.8, 1.02)  # points
        parts = [smooth(random.normal(size=self._polar_sides()).astype(numpy.float32), spread)
                 for _ in range(2)]
        grains = numpy.hypot(*[part / part.std() for part in parts]) / 1.25
        return self._from_polar(grains) ** self.knobs.speckle

    def _resect(self, amplitude):
        """A cavity of fluid with a bright wall. Air at its top, near the probe, hides the rest."""
        radius = self.knobs.cavity
        away = numpy.linalg.norm(
            self.local - (self.apex + self.ahead * (self.knobs.lift + radius + 2)), axis=-1)
        self.cavity = away < radius
        amplitude = numpy.where(self.cavity, 0.02, amplitude)
        amplitude = amplitude + 1.5 * numpy.exp(-((away - radius) / 0.7) ** 2)
        hidden = numpy.exp(-((self.angle - 0.05) / 0.09) ** 2 - (self.slice / 6) ** 2)
        return amplitude * (1 - 0.95 * hidden * (self.depth > 5)) \
            + hidden * (self.depth > 5) * 0.8 * numpy.exp(-((self.depth % 5) / 0.7) ** 2)

    def _image(self):
        speckle = self._speckle()
        amplitude = self._scatter() * speckle + self._echo() * (0.6 + 0.4 * speckle)
        self.cavity = numpy.zeros(SIDES, bool)
        if self.knobs.cavity:
            amplitude = self._resect(amplitude)
        noise = numpy.abs(self.randoms["noise"].normal(size=SIDES)).astype(numpy.float32)
        values = numpy.log1p(amplitude * self._gain() + 0.02 * noise) / numpy.log1p(3)
        values = numpy.clip(120 * smooth(values.astype(numpy.float32), 0.3), 1, 255)
        self.ultrasound = numpy.where(self.fan, values, 0).astype(numpy.uint8)

    def _landmarks(self):
        inner = self.fan & (self.brain > 0.9) & ~self.cavity
        for axis in range(3):
            for by in (-6, 6):
                inner &= numpy.roll(self.fan, by, axis)
        places = numpy.argwhere(inner)
        chosen = tuple(places[self.randoms["landmarks"].choice(len(places), LANDMARKS, False)].T)
        measured = self.local[chosen].astype(float)
        self.measured = self.world(measured)
        self.rest = self.world(measured - self.moved[chosen])

    def mr(self, contrast):
        """The MR of the whole head, on its grid: values and affine."""
        head, knobs = self.head, self.knobs
        values, brain, affine = head.values, head.mask, head.affine
        index = numpy.stack(numpy.meshgrid(*[numpy.arange(n, dtype=numpy.float32)
                                             for n in values.shape], indexing="ij")[::-1], -1)
        local = (index @ affine[:3, :3].T + affine[:3, 3] - self.affine[:3, 3]) @ self.axes
        random = numpy.random.default_rng((len(contrast), int(1e6 * self.lesion_radius)))
        away = numpy.linalg.norm((local - self.lesion_at + random.normal(size=3) * 1.5)
                                 * [0.9, 1, 1], axis=-1)
        step = numpy.linalg.norm(affine[:3, :3], axis=0).mean()
        uneven = 1 + 0.2 * field(random, 12, values.shape, step)
        lesion = logistic((away - 1.2 * self.lesion_radius * uneven) / 1.5) * (knobs.lesion > 0)
        noise = 0.01 * random.normal(size=values.shape)
        if contrast == "flair":
            tissue = head.fractions(values) @ numpy.array([0.12, 0.75, 0.55])
            return (brain * tissue + 0.1 + 0.3 * lesion + noise).astype(numpy.float32), affine
        return (values / head.top - 0.15 * lesion + noise).astype(numpy.float32), affine
