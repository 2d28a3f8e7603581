# SPDX-License-Identifier: BSD-3-Clause
# Proves that ParaView opens .nii.gz with our reader and puts the volume at the right place, and
# that a missing file gives an error that names it, and that reading can be stopped.
import os
import tempfile

from paraview.simple import LoadPlugin, OpenDataFile
from vtkmodules.vtkCommonCore import vtkOutputWindow, vtkStringOutputWindow

LoadPlugin(os.environ["BRAINSHIFT_PLUGIN"], remote=False, ns=globals())

HEAD = os.path.join(os.environ["BRAINSHIFT_TEST_DATA"], "seg3d-utah", "seg3d_mr_t1.nii.gz")
BOUNDS_MM = (-388.26001, -229.26001, -81.119957, 126.418995, 405.42099, 548.272477)
LARGEST_INTENSITY = 512.00003  # 255 times scl_slope


def assert_near(values, expected, tolerance):
    assert len(values) == len(expected), (values, expected)
    for value, known in zip(values, expected):
        assert abs(value - known) <= tolerance, (values, expected)


def test_opens_with_our_reader():
    reader = OpenDataFile(HEAD)
    assert reader is not None, "no reader for " + HEAD
    assert reader.GetXMLName() == "NIFTIVolumeReader", reader.GetXMLName()
    reader.UpdatePipeline()
    information = reader.GetDataInformation()
    assert_near(information.GetBounds(), BOUNDS_MM, 1e-4)
    assert tuple(information.GetExtent()) == (0, 159, 0, 231, 0, 159), information.GetExtent()
    assert_near(reader.PointData["Intensity"].GetRange(), (0.0, LARGEST_INTENSITY), 1e-3)
    assert len(reader.TimestepValues or []) == 0, reader.TimestepValues


def test_missing_file_is_named():
    missing = os.path.join(tempfile.gettempdir(), "brainshift-no-such-file.nii.gz")
    previous = vtkOutputWindow.GetInstance()
    window = vtkStringOutputWindow()
    vtkOutputWindow.SetInstance(window)
    try:
        reader = NIFTIVolumeReader(FileName=missing)  # noqa: F821 from the plugin
        reader.UpdatePipeline()
    finally:
        vtkOutputWindow.SetInstance(previous)
    message = window.GetOutput()
    assert missing + " does not exist" in message, message
    assert reader.GetDataInformation().GetNumberOfPoints() == 0


def test_reading_can_be_stopped():
    reader = NIFTIVolumeReader(FileName=HEAD).GetClientSideObject()  # noqa: F821 from the plugin
    reader.UpdateInformation()
    seen = []

    def stop(caller, _):
        seen.append(caller.GetProgress())
        if len(seen) == 5:
            caller.SetAbortExecute(1)
    observer = reader.AddObserver("ProgressEvent", stop)
    previous = vtkOutputWindow.GetInstance()
    window = vtkStringOutputWindow()
    vtkOutputWindow.SetInstance(window)
    try:
        reader.Update()
    finally:
        vtkOutputWindow.SetInstance(previous)
    assert "was stopped. Nothing is shown" in window.GetOutput(), window.GetOutput()
    assert reader.GetOutput().GetNumberOfPoints() == 0
    assert seen == sorted(seen) and 0.0 < seen[3] < 0.5, seen
    reader.RemoveObserver(observer)
    reader.Modified()
    reader.Update()
    assert reader.GetOutput().GetDimensions() == (160, 232, 160)
    assert abs(reader.GetOutput().GetScalarRange()[1] - LARGEST_INTENSITY) < 1e-3


test_opens_with_our_reader()
test_missing_file_is_named()
test_reading_can_be_stopped()
