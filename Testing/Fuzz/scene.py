# SPDX-License-Identifier: BSD-3-Clause
"""A small scene with every filter and representation of BrainShift, for cases of properties and
fields, and what it shows as numbers that can be compared."""

import numpy

#: Pixels a side: enough to see a wrong picture.
SIZE = 48
COLORS = [0, 0, 0, 1, 50, 0, 1, 0, 100, 1, 0, 0]
OPACITIES = [0, 0, 0.5, 0, 30, 0, 0.5, 0, 50, 0.6, 0.5, 0, 100, 0.9, 0.5, 0]


def picture(view):
    """The pixels of a view."""
    from brainshift_testing import picture as shown
    return shown(view)


def shown(source, kind):
    """A view of its own with one source."""
    from brainshift_testing import show_volume, view_along
    view = view_along((0.3, -0.4, -1.0), (8.0, 8.0, 8.0), 60.0, half_height=12.0, size=SIZE)
    display = show_volume(source, view, kind, COLORS, OPACITIES, shade=True)
    return view, display


def array_of(proxy):
    """All numbers of the point arrays of an output, one after the other."""
    from vtkmodules.util.numpy_support import vtk_to_numpy
    proxy.UpdatePipeline()
    data = proxy.GetClientSideObject().GetOutputDataObject(0)
    arrays = data.GetPointData()
    # By name: a second execution may add them in another order.
    names = sorted(arrays.GetArrayName(i) for i in range(arrays.GetNumberOfArrays()))
    numbers = [vtk_to_numpy(arrays.GetArray(name)).ravel().astype(float) for name in names]
    return numpy.concatenate(numbers) if numbers else numpy.zeros(0)


class Scene:
    """A bent ball, what is made of it, and three views."""

    def __init__(self):
        import brainshift
        from brainshift_testing import ball, volume
        from paraview import simple
        voxels = ball(side=17, radius=5.0)
        self.source = volume(voxels)
        mask = volume((voxels >= 0).astype(numpy.uint8))
        strokes = brainshift.stamp((8, 8, 8), (8, 8, 0), 2.0, major=7.0, minor=5.0)
        self.bent = simple.FreeFormDeformation(
            Input=self.source, Strokes=list(strokes), LatticeDimensions=[7, 7, 7])
        reference = volume(ball(side=17, radius=4.0))
        self.compared = simple.CompareVolumes(Input=self.bent, Reference=reference)
        points = simple.Sphere(Center=[8, 8, 8], Radius=6.0)
        self.proxies = {
            "bent": self.bent,
            "compared": self.compared,
            "bake": simple.BakeDeformation(Input=self.bent),
            "field": simple.DeformationField(Input=self.bent, SampleGrid="Given Dimensions",
                                             Dimensions=[6, 6, 6]),
            "mesh": simple.DeformGeometry(Input=points, Deformation=self.bent),
            "traces": simple.TraceDistance(Input=points, Deformation=self.bent, Threshold=50.0),
            "masked": simple.FreeFormDeformation(
                Input=self.source, Mask=mask, Strokes=list(strokes), LatticeDimensions=[5, 5, 5]),
        }
        self.proxies["inverse"] = simple.InvertDisplacementField(Input=self.proxies["field"])
        self.proxies["lattice"] = simple.DeformationLattice(Input=self.bent)
        self.views, self.displays = {}, {}
        for name, source, kind in (("volume", self.bent, "Deformed Volume"),
                                   ("slices", self.compared, "Deformed Slices"),
                                   ("red and green", self.compared, "Deformed Volume")):
            self.views[name], self.displays[name] = shown(source, kind)

    def state(self):
        """Numbers of all outputs and pictures, by their names."""
        found = {name: array_of(proxy) for name, proxy in self.proxies.items()}
        found.update({f"picture of {name}": picture(view) for name, view in self.views.items()})
        return found


def difference(before, after):
    """The first thing that two states do not share; None if they are alike."""
    for name, numbers in before.items():
        if after[name].shape != numbers.shape:
            return f"{name} has {after[name].shape} numbers in place of {numbers.shape}"
        if not numpy.array_equal(after[name], numbers, equal_nan=True):
            worst = numpy.nanmax(numpy.abs(after[name] - numbers))
            return f"{name} differs by {worst:g}"
    return None
