# SPDX-License-Identifier: BSD-3-Clause
"""Makes what is measured: the sample head, one stroke, one view, and the volumes shown in turn."""

import dataclasses
import math
import os

import numpy
from measure import rendering_threads
from paraview import simple
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkMultiThreader
from vtkmodules.vtkCommonDataModel import vtkImageData
from vtkmodules.vtkCommonTransforms import vtkTransform  # noqa: F401 the base class of the next
from vtkmodules.vtkFiltersHybrid import vtkBSplineTransform
from vtkmodules.vtkImagingCore import vtkImageReslice
from vtkmodules.vtkRenderingCore import vtkLight, vtkVolume
from vtkmodules.vtkRenderingVolumeOpenGL2 import vtkOpenGLGPUVolumeRayCastMapper

DATA = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "Testing", "Data")
ARRAY = "Intensity"
STEP = 0.5  # voxels along the ray: our default
COARSE_STEP = 1.0  # voxels
SAMPLES = 4  # nodes of the offset field between two control points
AIR = 20    # of 255: below is air and noise

# Scalar, opacity for 1 mm. Opaque: rays end in the skin. Translucent: two per cent a millimetre
# wherever there is tissue, so that no ray gets near the opacity at which both sides stop.
OPACITIES = {"opaque": (0, 0, AIR, 0, 3 * AIR, 1, 255, 1),
             "translucent": (0, 0, AIR, 0, AIR + 5, 0.02, 255, 0.02)}
COLORS = (0, 0.35, 0.20, 0.15, 40, 0.75, 0.50, 0.40, 130, 0.95, 0.78, 0.65, 255, 1.0, 0.95, 0.9)

OCCLUSION = 0.5  # the default of our representation; off unless a side says so

TOWARDS_EYE = (0.55, 0.70, 0.45)  # from the head's middle
VIEW_ANGLE = 24.0                 # degrees

# One stroke, for a volume whose longest side has 256 voxels of 1 mm. Others are scaled.
AMOUNT, MAJOR, MINOR = -20.0, 80.0, 56.0


def load_plugin():
    simple.LoadPlugin(os.environ["BRAINSHIFT_PLUGIN"], remote=False, ns=vars(simple))


def image_of(voxels, spacing=(1.0, 1.0, 1.0)):
    """Point scalars [z, y, x] from 0 0 0; spacing in mm, x first."""
    image = vtkImageData()
    image.SetDimensions(*reversed(voxels.shape))
    image.SetSpacing(*spacing)
    scalars = numpy_to_vtk(numpy.ascontiguousarray(voxels).ravel(), deep=True)
    scalars.SetName(ARRAY)
    image.GetPointData().SetScalars(scalars)
    return image


def voxels_of(image):
    array = vtk_to_numpy(image.GetPointData().GetScalars())
    return array.reshape(tuple(reversed(image.GetDimensions())))


def sample_voxels(name):
    """A sample file's voxels [z, y, x] as floats, a head from 0 to 255, and its spacing (mm)."""
    reader = simple.NIFTIVolumeReader(FileName=os.path.join(DATA, "seg3d-utah", f"{name}.nii.gz"))
    reader.UpdatePipeline()
    image = reader.GetClientSideObject().GetOutputDataObject(0)
    voxels = voxels_of(image).astype(numpy.float32)
    spacing = numpy.array(image.GetSpacing())
    simple.Delete(reader)
    if voxels.max() > 1.0:  # no mask
        voxels = numpy.clip(voxels * (255.0 / numpy.percentile(voxels, 99.9)), 0, 255)
    return voxels, spacing


def head(dimensions):
    """The sample MRI over all of a grid of these dimensions: uint8, 1 mm."""
    whole = sample_voxels("seg3d_mr_t1")[0]
    reslice = vtkImageReslice()
    reslice.SetInputData(image_of(whole))
    reslice.SetOutputExtent(0, dimensions[0] - 1, 0, dimensions[1] - 1, 0, dimensions[2] - 1)
    reslice.SetOutputOrigin(0, 0, 0)
    reslice.SetOutputSpacing(*((old - 1) / (new - 1)
                               for old, new in zip(reversed(whole.shape), dimensions)))
    reslice.SetInterpolationModeToLinear()
    reslice.Update()
    return image_of(voxels_of(reslice.GetOutput()).round().astype(numpy.uint8))


@dataclasses.dataclass
class Volume:
    """What a scene draws. `surface`: the scalar above which the stroke finds the skin."""
    image: vtkImageData
    opacities: dict
    colors: tuple
    surface: float


def reference_volume(dimensions):
    return Volume(head(dimensions), OPACITIES, COLORS, 2 * AIR)


def _normalised(vector):
    return numpy.asarray(vector, float) / numpy.linalg.norm(vector)


class Scene:
    """Ours, ParaView's own and a pinned stock mapper in one view; `show` picks the one drawn."""

    def __init__(self, dimensions, lattice, volume=None):
        self.dimensions, self.lattice = dimensions, lattice
        self.volume = volume or reference_volume(dimensions)
        self.image = self.volume.image
        self.spacing = numpy.array(self.image.GetSpacing())
        self.centre = (numpy.array(dimensions) - 1) / 2 * self.spacing
        self.longest = max(self.dimensions * self.spacing)
        self.edits = 0
        self.source = simple.TrivialProducer()
        self.source.GetClientSideObject().SetOutput(self.image)
        self.bent = simple.FreeFormDeformation(Input=self.source, LatticeDimensions=[lattice] * 3,
                                               Samples=SAMPLES)
        self._place_stroke()
        self.edit()
        self.bake = simple.BakeDeformation(Input=self.bent)
        self.bake.UpdatePipeline()
        self._make_view()
        self.ours = self._represent(self.bent, "Deformed Volume")
        self.own = self._represent(self.source, "Volume")
        self.view.SMProxy.StillRender()
        self._find_volumes()
        self.reslice, self.coefficients = self._make_reslice()

    def close(self):
        for volume in self.added:
            self.renderer.RemoveVolume(volume)
        for proxy in (self.view, self.bake, self.bent, self.source):
            simple.Delete(proxy)

    # The volumes ----------------------------------------------------------------------------------

    def _place_stroke(self):
        """Anchors the stamp in the skin that faces the eye."""
        voxels = voxels_of(self.image)
        direction = _normalised(TOWARDS_EYE)
        for distance in numpy.arange(self.longest, 0, -0.5):
            point = self.centre + distance * direction
            index = tuple(int(round(value)) for value in reversed(point / self.spacing))
            inside = all(0 <= i < n for i, n in zip(index, voxels.shape))
            if inside and voxels[index] > self.volume.surface:
                break
        self.anchor = tuple(point)

    def edit(self):
        """Another stroke each time, or nothing would be redone."""
        import brainshift
        scale = self.longest / 256.0
        amount = AMOUNT * (1.0 - 0.01 * (self.edits % 10))
        self.edits += 1
        self.bent.Strokes = brainshift.stamp(self.anchor, tuple(self.centre), amount * scale,
                                             major=MAJOR * scale, minor=MINOR * scale)

    def change_everything(self):
        """The other kernel: all of the offset field is made anew, on as many nodes."""
        self.bent.Kernel = "B-Spline" if self.bent.Kernel == "Catmull-Rom" else "Catmull-Rom"

    def _make_view(self):
        self.view = simple.CreateView("RenderView")
        self.view.UseColorPaletteForBackground = 0
        self.view.Background = [0.0, 0.0, 0.0]
        self.view.OrientationAxesVisibility = 0
        self.view.CenterAxesVisibility = 0
        self.view.UseFXAA = 0
        # Above this limit of 20 MB ParaView shows no changing volume while the view moves.
        self.view.LODThreshold = 1e6
        self.view.UseLight = 0
        self.view.CameraViewAngle = VIEW_ANGLE
        radius = numpy.linalg.norm(self.centre)
        distance = radius / math.sin(math.radians(15.0))
        self.view.CameraFocalPoint = list(self.centre)
        self.view.CameraPosition = list(self.centre + distance * _normalised(TOWARDS_EYE))
        self.view.CameraViewUp = [0, 0, 1]
        self.view.SMProxy.StillRender()
        self.renderer = self.view.GetClientSideObject().GetRenderer()
        self.window = self.renderer.GetRenderWindow()
        self.renderer.GetLights().RemoveAllItems()
        light = vtkLight()
        light.SetLightTypeToHeadlight()
        self.renderer.AddLight(light)
        self.added = []

    def _represent(self, source, kind):
        display = simple.Show(source, self.view, "UniformGridRepresentation")
        display.SetRepresentationType(kind)
        simple.ColorBy(display, ("POINTS", ARRAY))
        display.SetScalarBarVisibility(self.view, False)
        display.Shade = 1
        display.AmbientOcclusion = 0.0  # as ParaView's own volumes
        display.ScalarOpacityUnitDistance = 1.0
        color = simple.GetColorTransferFunction(ARRAY)
        color.ColorSpace = "RGB"
        color.RGBPoints = self.volume.colors
        return display

    def _find_volumes(self):
        """A representation has a vtkVolume for each way to draw it; two of them are in use."""
        volumes = self.renderer.GetVolumes()
        volumes = [volumes.GetItemAsObject(i) for i in range(volumes.GetNumberOfItems())]
        self.volumes = {}
        for volume in volumes:
            if volume.GetVisibility() and volume.GetMapper():
                ours = volume.GetMapper().IsA("vtkDeformedVolumeMapper")
                self.volumes["ours" if ours else "own"] = volume
        assert len(self.volumes) == 2, [volume.GetMapper() for volume in volumes]
        self.property = self.volumes["ours"].GetProperty()

    def _add_stock(self, name):
        """Made when first shown, since each holds the volume once more."""
        mapper = vtkOpenGLGPUVolumeRayCastMapper()
        mapper.SetAutoAdjustSampleDistances(False)
        mapper.SetLockSampleDistanceToInputSpacing(False)
        step = COARSE_STEP if name == "stock coarse" else STEP
        mapper.SetSampleDistance(step * float(self.spacing.min()))
        mapper.SetImageSampleDistance(1.0)
        mapper.SetUseJittering(False)
        if name == "stock resliced":
            mapper.SetInputConnection(self.reslice.GetOutputPort())
        elif name == "stock baked":
            self.bake.UpdatePipeline()
            baked = vtkImageData()
            baked.DeepCopy(self.bake.GetClientSideObject().GetOutputDataObject(0))
            mapper.SetInputData(baked)
        else:
            mapper.SetInputData(self.image)
        volume = vtkVolume()
        volume.SetMapper(mapper)
        volume.SetProperty(self.property)
        self.renderer.AddVolume(volume)
        self.volumes[name] = volume
        self.added.append(volume)

    def _make_reslice(self):
        """ParaView's present road. Its coefficients are the lattice's displacements, negated: the
        work is the same as for any others. ParaView holds VTK to one thread; here it gets all."""
        bent = self.bent.GetClientSideObject().GetOutputDataObject(0)
        displacements = vtk_to_numpy(bent.GetFieldData().GetArray("FFDDisplacements"))
        grid = vtkImageData()
        grid.SetDimensions(*[self.lattice] * 3)
        grid.SetSpacing(*((n - 1) / (self.lattice - 1) * side
                          for n, side in zip(self.dimensions, self.spacing)))
        grid.GetPointData().SetScalars(numpy_to_vtk(-displacements, deep=True))
        transform = vtkBSplineTransform()
        transform.SetCoefficientData(grid)
        reslice = vtkImageReslice()
        reslice.SetInputData(self.image)
        reslice.SetResliceTransform(transform)
        reslice.SetInterpolationModeToLinear()
        vtkMultiThreader.SetGlobalMaximumNumberOfThreads(0)
        reslice.SetNumberOfThreads(rendering_threads())
        return reslice, grid

    def edit_coefficients(self):
        scalars = self.coefficients.GetPointData().GetScalars()
        self.edits += 1
        vtk_to_numpy(scalars)[:] *= 0.99 if self.edits % 2 else 1 / 0.99
        scalars.Modified()
        self.coefficients.Modified()

    # The view -------------------------------------------------------------------------------------

    def use(self, opacities, window):
        """Colour map and size of the picture (pixels) for all."""
        points = self.volume.opacities[opacities]
        flat = []
        for scalar, opacity in zip(points[0::2], points[1::2]):
            flat += [scalar, opacity, 0.5, 0.0]
        simple.GetOpacityTransferFunction(ARRAY).Points = flat
        self.view.ViewSize = [window, window]
        self.show("ours")
        self.view.SMProxy.StillRender()

    def show(self, shown):
        """Shows one of the volumes; None: none of them."""
        if shown and shown not in self.volumes:
            self._add_stock(shown)
        for name, volume in self.volumes.items():
            if name in ("ours", "own"):  # ParaView sets the visibility of its own at every frame
                getattr(self, name).Visibility = int(name == shown)
            else:
                volume.SetVisibility(name == shown)
        self.view.SMProxy.Update()

    def frame(self):
        """A picture in full quality, finished."""
        self.view.SMProxy.StillRender()
        self.window.WaitForCompletion()

    def picture(self):
        """What is drawn, indexed [row from below, column, colour], 0 to 1."""
        self.frame()
        image = self.view.SMProxy.CaptureWindow(1)
        width, height, _ = image.GetDimensions()
        pixels = vtk_to_numpy(image.GetPointData().GetScalars()).reshape(height, width, -1)
        result = pixels[:, :, :3].astype(float) / 255.0
        image.UnRegister(None)
        return result


def mean_difference(left, right):
    """Mean absolute difference over the object's pixels, as a share of full scale."""
    object_pixels = numpy.maximum(left, right).max(axis=2) > 0.02
    return float(numpy.abs(left - right)[object_pixels].mean())
