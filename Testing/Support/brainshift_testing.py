# SPDX-License-Identifier: BSD-3-Clause
"""What the pvpython tests share: volumes with known voxels, fixed views, pictures as numbers."""

import contextlib
import gc
import os
import socket
import subprocess

import numpy
from paraview import simple
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkOutputWindow, vtkStringOutputWindow
from vtkmodules.vtkCommonDataModel import vtkImageData
from vtkmodules.vtkRenderingCore import vtkLight, vtkWindowToImageFilter

#: Edge of a test picture, pixels.
SIZE = 300


def load_plugin():
    simple.LoadPlugin(os.environ["BRAINSHIFT_PLUGIN"], remote=False, ns=simple.__dict__)


def data(*path):
    return os.path.join(os.environ["BRAINSHIFT_TEST_DATA"], *path)


def scratch(name):
    folder = os.environ.get("BRAINSHIFT_TEST_TEMP", "/tmp")
    return os.path.join(folder, name)


def run_tests(namespace):
    """Calls every function of a script whose name starts with test_, in the order written."""
    for name, test in list(namespace.items()):
        if name.startswith("test_"):
            print(name, flush=True)
            test()


# Volumes ------------------------------------------------------------------------------------------


def volume(voxels, origin=(0.0, 0.0, 0.0), spacing=(1.0, 1.0, 1.0), direction=None, cells=False):
    """A source of an image with scalars "Intensity" from an array indexed [z, y, x], or [z, y, x,
    component], on its points or in its cells. `direction`: 9 numbers, row by row."""
    image = vtkImageData()
    image.SetDimensions(*(side + int(cells) for side in reversed(voxels.shape[:3])))
    image.SetOrigin(*origin)
    image.SetSpacing(*spacing)
    if direction is not None:
        image.SetDirectionMatrix(*direction)
    flat = numpy.ascontiguousarray(voxels).reshape((-1,) + voxels.shape[3:])
    scalars = numpy_to_vtk(flat, deep=True)
    scalars.SetName("Intensity")
    (image.GetCellData() if cells else image.GetPointData()).SetScalars(scalars)
    source = simple.TrivialProducer()
    source.GetClientSideObject().SetOutput(image)
    source.UpdatePipeline()
    return source


def ball(side=33, radius=9.0, center=None, inside=100.0, edge=2.0):
    """Voxels of a ball: `inside` in its middle, falling to 0 over `edge` voxels about `radius`."""
    center = center or ((side - 1) / 2,) * 3
    z, y, x = numpy.mgrid[0:side, 0:side, 0:side].astype(float)
    distance = numpy.sqrt((x - center[0]) ** 2 + (y - center[1]) ** 2 + (z - center[2]) ** 2)
    return (inside * numpy.clip((radius - distance) / edge + 0.5, 0, 1)).astype(numpy.float32)


def output(proxy):
    """The image a filter made, as it lies in memory."""
    proxy.UpdatePipeline()
    return proxy.GetClientSideObject().GetOutputDataObject(0)


def voxels(proxy, name="Intensity"):
    """A point array of an image, indexed [z, y, x], or [z, y, x, component]."""
    image = output(proxy)
    array = vtk_to_numpy(image.GetPointData().GetArray(name))
    return array.reshape(tuple(reversed(image.GetDimensions())) + array.shape[1:])


def field(proxy, name):
    """A field array of a filter's output; None if there is none."""
    array = output(proxy).GetFieldData().GetArray(name)
    return None if array is None else vtk_to_numpy(array).copy()


# Views --------------------------------------------------------------------------------------------


def view_along(direction, focus, distance, up=(0, 1, 0), half_height=None, size=SIZE):
    """A black view that looks along `direction` at `focus`; parallel if `half_height` is given."""
    view = simple.CreateView("RenderView")
    view.ViewSize = [size, size]
    view.UseColorPaletteForBackground = 0
    view.Background = [0.0, 0.0, 0.0]
    view.OrientationAxesVisibility = 0
    view.CenterAxesVisibility = 0
    view.UseFXAA = 0
    look(view, direction, focus, distance, up)
    if half_height is not None:
        view.CameraParallelProjection = 1
        view.CameraParallelScale = half_height
    return view


def look(view, direction, focus, distance, up=(0, 1, 0)):
    direction = numpy.asarray(direction, float)
    direction /= numpy.linalg.norm(direction)
    view.CameraFocalPoint = list(focus)
    view.CameraPosition = list(numpy.asarray(focus) - distance * direction)
    view.CameraViewUp = list(up)


def use_headlight(view):
    """One plain light at the camera. VTK's own volume mapper turns normals by the box's aspect for
    any other light, so pictures could not be compared."""
    view.UseLight = 0
    view.SMProxy.StillRender()
    renderer = view.GetClientSideObject().GetRenderer()
    renderer.GetLights().RemoveAllItems()
    light = vtkLight()
    light.SetLightTypeToHeadlight()
    renderer.AddLight(light)


def show_volume(source, view, kind, colors, opacities, array="Intensity", shade=False,
                unit=1.0, association="POINTS"):
    """Shows a volume with a colour map (scalar, r, g, b, ...) and an opacity curve (scalar,
    opacity, 0.5, 0, ...) of its own; opacities hold for `unit` mm."""
    display = simple.Show(source, view, "UniformGridRepresentation")
    display.SetRepresentationType(kind)
    simple.ColorBy(display, (association, array), separate=True)
    display.SetScalarBarVisibility(view, False)
    color = simple.GetColorTransferFunction(array, display, separate=True)
    color.ColorSpace = "RGB"
    color.RGBPoints = colors
    opacity = simple.GetOpacityTransferFunction(array, display, separate=True)
    opacity.Points = opacities
    display.Shade = int(shade)
    display.AmbientOcclusion = 0.0  # as ParaView's own volumes
    display.ScalarOpacityUnitDistance = unit
    return display


def picture(view):
    """What the view shows, indexed [row from below, column, colour], 0 to 1."""
    view.SMProxy.StillRender()
    image = view.SMProxy.CaptureWindow(1)
    width, height, _ = image.GetDimensions()
    pixels = vtk_to_numpy(image.GetPointData().GetScalars())
    result = pixels.reshape(height, width, -1)[:, :, :3].astype(float) / 255.0
    image.UnRegister(None)
    return result


def on_screen(view):
    """The pixels of the window as they are, indexed [row from below, column, colour], 0 to 255. A
    capture would draw a still picture first."""
    reader = vtkWindowToImageFilter()
    reader.SetInput(view.GetRenderWindow())
    reader.ReadFrontBufferOff()
    reader.ShouldRerenderOff()
    reader.Update()
    image = reader.GetOutput()
    width, height, _ = image.GetDimensions()
    return vtk_to_numpy(image.GetPointData().GetScalars()).reshape(height, width, -1).astype(float)


# Pictures -----------------------------------------------------------------------------------------


def object_pixels(*pictures):
    """Where at least one picture shows more than the black background."""
    return numpy.any([image.max(axis=2) > 0.02 for image in pictures], axis=0)


def mean_difference(left, right):
    """Mean absolute difference over the object's pixels, as a share of full scale."""
    return float(numpy.abs(left - right)[object_pixels(left, right)].mean())


def structural_similarity(left, right, window=7):
    """Mean SSIM (Wang et al., 2004) of the pictures' grey values; 1 for the same picture."""

    def local_mean(grey):
        sums = numpy.pad(grey, ((1, 0), (1, 0))).cumsum(0).cumsum(1)
        return (sums[window:, window:] - sums[:-window, window:] - sums[window:, :-window]
                + sums[:-window, :-window]) / window ** 2

    x, y = left.mean(axis=2), right.mean(axis=2)
    mean_x, mean_y = local_mean(x), local_mean(y)
    variance_x = local_mean(x * x) - mean_x ** 2
    variance_y = local_mean(y * y) - mean_y ** 2
    covariance = local_mean(x * y) - mean_x * mean_y
    c1, c2 = 0.01 ** 2, 0.03 ** 2
    similarity = ((2 * mean_x * mean_y + c1) * (2 * covariance + c2)) / (
        (mean_x ** 2 + mean_y ** 2 + c1) * (variance_x + variance_y + c2))
    return float(similarity.mean())


# Messages -----------------------------------------------------------------------------------------


class Messages:
    text = ""


@contextlib.contextmanager
def messages():
    """Collects what ParaView's output window is told: afterwards in `.text`."""
    previous = vtkOutputWindow.GetInstance()
    window = vtkStringOutputWindow()
    vtkOutputWindow.SetInstance(window)
    collected = Messages()
    try:
        yield collected
    finally:
        vtkOutputWindow.SetInstance(previous)
        collected.text = window.GetOutput()


def assert_says(text, *words):
    for word in words:
        assert word in text, f"{word!r} is not in {text!r}"


# Servers ------------------------------------------------------------------------------------------


@contextlib.contextmanager
def server(environment, launcher=(), options=()):
    """A pvserver on this machine: its port and its process. `launcher`: what starts it, such as
    mpirun -np 2. `options`: of the server, beside the port."""
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        port = probe.getsockname()[1]
    inherited = {name: value for name, value in os.environ.items() if name != "PV_PLUGIN_PATH"}
    process = subprocess.Popen(
        [*launcher, os.environ["BRAINSHIFT_PVSERVER"], "--force-offscreen-rendering",
         f"--server-port={port}", *options],
        stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
        env={**inherited, **environment})
    try:
        said = ""
        while "Accepting connection" not in said:
            line = process.stdout.readline()
            assert line, f"pvserver ended: {said}"
            said += line
        yield port, process
    finally:
        process.terminate()
        process.wait()


def on_server(question, launcher=(), **environment):
    """What a function returns while connected to a server. The connection ends with the last proxy,
    so the function keeps none."""
    with server(environment, launcher) as (port, _):
        assert simple.Connect("localhost", port).IsRemote()
        try:
            return question()
        finally:
            simple.Disconnect()
            gc.collect()


def server_finds_plugin():
    """The environment in which a server loads the plugin by itself."""
    return {"PV_PLUGIN_PATH": os.path.dirname(os.environ["BRAINSHIFT_PLUGIN"])}
