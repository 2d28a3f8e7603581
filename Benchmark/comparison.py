# SPDX-License-Identifier: BSD-3-Clause
"""Measures a bent volume and a reference in one picture, and two stock volumes in one renderer.

Our side draws the scene's bent volume red and the volume as loaded green, along the same rays.
Stock draws two volumes of the same voxels and property with VTK's GPU mapper at our step, in two
ways. Drawn one after the other, the second lies over the first wherever it is. vtkMultiVolume is
VTK's one way to composite two volumes along one ray. Neither bends, and neither shows agreement.
"""

from measure import Side, interleaved
from paraview import simple
from scene import ARRAY, STEP
from vtkmodules.vtkRenderingCore import vtkVolume
from vtkmodules.vtkRenderingVolume import vtkMultiVolume
from vtkmodules.vtkRenderingVolumeOpenGL2 import vtkOpenGLGPUVolumeRayCastMapper

OURS, ALONE = "ours, bent and reference", "ours, bent alone"
STOCK, TOGETHER = "stock, two volumes", "stock, two in a vtkMultiVolume"
KIND = "reference rendering (two volumes)"
PARTS = ("opaque", "translucent")


def _pinned_mapper():
    mapper = vtkOpenGLGPUVolumeRayCastMapper()
    mapper.SetAutoAdjustSampleDistances(False)
    mapper.SetLockSampleDistanceToInputSpacing(False)
    mapper.SetSampleDistance(STEP)
    mapper.SetImageSampleDistance(1.0)
    mapper.SetUseJittering(False)
    return mapper


class Comparison:
    """Ours and stock's two volumes in the scene's view; one side is shown at a time."""

    def __init__(self, scene):
        self.scene = scene
        self.compare = simple.CompareVolumes(Input=scene.bent, Reference=scene.source)
        self.ours = simple.Show(self.compare, scene.view, "UniformGridRepresentation")
        self.ours.SetRepresentationType("Deformed Volume")
        simple.ColorBy(self.ours, ("POINTS", ARRAY))
        self.ours.SetScalarBarVisibility(scene.view, False)
        self.ours.Shade = 1
        self.ours.Opacity = 0.0  # of the outline
        self.ours.ScalarOpacityUnitDistance = 1.0
        self.stock = {STOCK: [self._volume(), self._volume()], TOGETHER: [self._multi_volume()]}
        for volumes in self.stock.values():
            for volume in volumes:
                volume.SetVisibility(False)
                scene.renderer.AddVolume(volume)

    def _volume(self):
        mapper = _pinned_mapper()
        mapper.SetInputData(self.scene.image)
        volume = vtkVolume()
        volume.SetMapper(mapper)
        volume.SetProperty(self.scene.property)
        return volume

    def _multi_volume(self):
        mapper = _pinned_mapper()
        together = vtkMultiVolume()
        together.SetMapper(mapper)
        for port in range(2):
            mapper.SetInputDataObject(port, self.scene.image)
            volume = vtkVolume()
            volume.SetProperty(self.scene.property)
            together.SetVolume(volume, port)
        return together

    def close(self):
        for volumes in self.stock.values():
            for volume in volumes:
                self.scene.renderer.RemoveVolume(volume)
        simple.Delete(self.ours)
        simple.Delete(self.compare)
        self.scene.show("ours")

    def show(self, kind):
        self.scene.show("ours" if kind == ALONE else None)
        # An invisible outline makes the view include the stock volumes.
        self.ours.Visibility = int(kind != ALONE)
        self.ours.SetRepresentationType("Deformed Volume" if kind == OURS else "Outline")
        for name, volumes in self.stock.items():
            for volume in volumes:
                volume.SetVisibility(name == kind)
        self.scene.view.SMProxy.Update()

    def sides(self):
        return [Side(kind, self.scene.frame, lambda kind=kind: self.show(kind))
                for kind in (OURS, ALONE, STOCK, TOGETHER)]

    def edit_sides(self):
        """From a changed stroke to both volumes in the picture."""

        def run():
            self.scene.edit()
            self.scene.frame()

        return [Side(OURS, run, lambda: self.show(OURS)),
                Side(ALONE, run, lambda: self.show(ALONE))]


def measure_comparison(scene, report, options, about):
    """Adds groups of rows: steady frames, and a stroke changes."""
    window = options.windows[0]
    for opacities in PARTS:
        scene.use(opacities, window)
        comparison = Comparison(scene)
        groups = [(f"{KIND}, {opacities}", comparison.sides())]
        if opacities == PARTS[0]:
            groups.append((f"{KIND}, edited", comparison.edit_sides()))
        for kind, sides in groups:
            report.group(kind, f"{kind}, {window}x{window}", {**about, "window": window},
                         interleaved(sides, options.rounds, options.seconds))
        comparison.close()
