# SPDX-License-Identifier: BSD-3-Clause
"""Proves that the cross beside the progress bar can be pressed while a DICOM series is read, that
the series which was shown before stays, and that the cross is for nothing else.

ParaView's window runs this file as a script; play_window.py reports what did not hold."""
import time

import test_hand as hand
import window_testing as window
from dicom_testing import folder, numbered, write_slices
from paraview import simple
from vtkmodules.vtkCommonCore import vtkCommand

SLICES = 300
scene = {}


def set_up():
    path = write_slices(folder("window"), numbered(SLICES))

    def other(image, _):
        image.SeriesInstanceUID, image.SeriesNumber = "1.2.3.4.6", 4

    write_slices(path, numbered(SLICES, 7, 8), change=other, start=SLICES + 1)
    reader = scene["reader"] = simple.DICOMVolumeReader(FileName=path)
    scene["view"] = simple.CreateView("RenderView")
    simple.Show(reader, scene["view"])
    simple.Render(scene["view"])
    scene["shown"] = reader.GetDataInformation().GetExtent()


def the_cross_waits_for_a_reader():
    assert not hand.click("AbortButton")


def the_cross_stops_a_reader():
    reader, pressed = scene["reader"], []
    source = reader.GetClientSideObject()

    def press(*_):
        time.sleep(0.02)  # ParaView tells its window of progress a few times in a second
        if source.GetProgress() > 0.3 and hand.click("AbortButton"):
            pressed.append(source.GetProgress())

    observer = source.AddObserver(vtkCommand.ProgressEvent, press)
    reader.Series = list(reader.GetProperty("SeriesList"))[1]
    reader.UpdatePipeline()
    simple.Render(scene["view"])
    source.RemoveObserver(observer)
    assert pressed and pressed[0] < 1.0, pressed
    assert reader.GetDataInformation().GetExtent() == scene["shown"]
    assert not hand.click("AbortButton")


def the_series_can_be_read_afterwards():
    reader = scene["reader"]
    reader.Series = list(reader.GetProperty("SeriesList"))[0]
    reader.UpdatePipeline()
    reader.Series = list(reader.GetProperty("SeriesList"))[1]
    reader.UpdatePipeline()
    assert reader.GetDataInformation().GetExtent() != scene["shown"]


window.main("StopReading", [
    (set_up,), (the_cross_waits_for_a_reader,), (the_cross_stops_a_reader,),
    (the_series_can_be_read_afterwards,)])
