# SPDX-License-Identifier: BSD-3-Clause
"""Cases of properties: some get numbers that nobody would give them, everything is made and drawn,
and they get the old ones back. Then everything must be as it was before."""

import math

from scene import Scene, difference

#: Names of properties that take longer than a case may although they are right, or that belong to
#: ParaView and not to BrainShift.
LEFT_ALONE = {"Input", "Position", "Position2", "ScalarOpacityFunction", "LookupTable"}
INTEGERS = [-2**31, -1, 0, 1, 2, 3, 5, 7, 12, 40, 300, 5000, 2**31 - 1]
REALS = [math.nan, math.inf, -math.inf, 1e308, -1e308, 1e-308, -1.0, 0.0, 0.001, 0.5, 1.0, 3.0,
         17.0, 1e3, 1e6, 1e12]
#: Properties of our own on the representations; the others are ParaView's.
DISPLAYED = {"SampleDistance", "EmptySpaceSkipping", "VolumeNormalTexture", "AdaptiveQuality",
             "KeepPicture", "CountSamples", "DrawSegment", "DrawnLabels", "MemoryLimit",
             "AmbientOcclusion", "OcclusionRadius", "GradientOpacity", "Comparison",
             "ReferenceRange", "AgreementDistance", "SlicePosition", "ShowSagittal",
             "ShowCoronal", "ShowAxial", "CheckerSize", "WipePosition", "FullGradient",
             "SimilarityWindow", "MapSliceOpacity", "OrientationMarks", "SliceInterpolation",
             "SliceComparison", "BlendMode", "Shade", "ScalarOpacityUnitDistance",
             "IsosurfaceValues", "InterpolationType", "Opacity", "SpecularPower", "Specular",
             "Ambient", "Diffuse"}


def vectors_of(proxy, names=None):
    """The properties of a proxy that hold numbers, by their names."""
    found = {}
    kinds = ("vtkSMIntVectorProperty", "vtkSMDoubleVectorProperty")
    for name in proxy.ListProperties():
        vector = proxy.SMProxy.GetProperty(name)
        if vector is None or not any(vector.IsA(kind) for kind in kinds):
            continue
        if vector.GetInformationOnly() or vector.GetIsInternal() or name in LEFT_ALONE:
            continue
        if names is None or name in names:
            found[name] = vector
    return found


def values_of(vector):
    return [vector.GetElement(i) for i in range(vector.GetNumberOfElements())]


def give(vector, values):
    vector.SetNumberOfElements(len(values))
    for i, value in enumerate(values):
        vector.SetElement(i, value)


def strange(random, vector, values):
    """Values of the same kind, one or all of them strange; lists may be longer or shorter."""
    pool = INTEGERS if vector.IsA("vtkSMIntVectorProperty") else REALS
    changed = list(values)
    if vector.GetRepeatCommand() and random.random() < 0.4:
        size = random.choice([0, 1, 13, 14, 15, 28])
        changed = (changed * 30 + [0] * size)[:size] if changed else [random.choice(pool)] * size
    if changed and random.random() < 0.5:
        changed[random.randrange(len(changed))] = random.choice(pool)
    else:
        changed = [random.choice(pool) for _ in changed]
    return changed


class Cases:
    """One scene, whose properties are spoiled and mended case by case."""

    def __init__(self, folder):
        del folder
        self.begin()

    def begin(self):
        """Makes the scene, and notes what it shows."""
        self.scene = Scene()
        self.choices = []
        for name, proxy in self.scene.proxies.items():
            for found in vectors_of(proxy).items():
                self.choices.append((name, proxy, *found))
        for name, display in self.scene.displays.items():
            for found in vectors_of(display, DISPLAYED).items():
                self.choices.append((name, display, *found))
        self.scene.state()  # the first picture of a view may come before its marks
        self.before = self.scene.state()
        again = difference(self.before, self.scene.state())
        assert again is None, f"the scene does not repeat itself: {again}"

    def run(self, random):
        """What became of one set of properties: a word, and a sentence if it is a finding."""
        from brainshift_testing import messages
        chosen = random.sample(self.choices, random.choice([1, 1, 2, 3]))
        old = [values_of(vector) for *_, vector in chosen]
        said_values = []
        with messages() as said:
            for (name, proxy, key, vector), values in zip(chosen, old):
                new = strange(random, vector, values)
                said_values.append(f"{name}.{key} = {new}")
                give(vector, new)
                proxy.SMProxy.UpdateVTKObjects()
            self.scene.state()
            for (_, proxy, _, vector), values in zip(chosen, old):
                give(vector, values)
                proxy.SMProxy.UpdateVTKObjects()
        with messages():
            wrong = difference(self.before, self.scene.state())
        if wrong:
            self.begin()  # the next case needs a scene that is right
            return f"stuck: {wrong} after {'; '.join(said_values)}"
        return "refused" if "error" in said.text.lower() else "taken"
